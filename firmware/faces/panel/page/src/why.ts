// Why the motor does not move: the gateway's findings, as in all faces, and those that only the page has.
import { inPanel } from "./remedies";
import type { Axis } from "./state";
import type { Waits } from "./waits";

/** As the wire has it. */
export interface Cause {
  code: string;
  number: number;
  severity: "stops" | "hinders" | "tells";
  text: string;
  sources: string[];
  remedy: string;
}

export interface Finding {
  text: string;
  basis: string; // the registers behind it
  remedy: string;
}

/** What to mend first in front. `operates`: the buttons that act are on the page. */
export function whyNot(axis: Axis, waits: Waits, operates: boolean): Finding[] {
  const causes = (axis.why ?? []).filter((cause, i, all) => all.findIndex((one) => one.code === cause.code) === i); // the nearest of each
  const findingOf = (cause: Cause): Finding => {
    const remedy = inPanel(cause.remedy, axis.isHeld, operates);
    const isRefused = axis.stopUnconfirmed && /“(Run|Go on|Step)”/.test(remedy);
    return { text: cause.text, basis: `${[...cause.sources, cause.code].join(", ")} (${cause.number})`, remedy: isRefused ? "" : remedy };
  };
  const isFirst = (cause: Cause): boolean => cause.severity !== "tells" || cause.code === "moves";
  const list = causes.filter(isFirst).map(findingOf);
  const add = (text: string, basis: string, remedy: string): void => void list.push({ text, basis, remedy });
  if (axis.stopUnconfirmed) list.unshift({ text: "It may be moving: the motor was told to stop and has not confirmed it.", basis: "STATUS bit 19 = 1",
    remedy: "Look at the machine, and at the motor's supply and line. “Run” is refused until the motor has confirmed the stop or the stop was given up." });
  if (!axis.why) add("What keeps the motor from moving is not known yet.", "", "Its registers are read, 2 to 5 seconds long, while it answers.");
  if (!axis.hasTable) add("There is no table.", "STATUS bit 11 = 0", "Upload one.");
  if ((axis.r.LINK ?? 0) === 2) add("The link was lost and is back, but the sequence has not acknowledged it.", "LINK = 2", "The sequence must send “reset error” (01h).");
  else if (axis.error) add("The sequence reads ERROR.", "STATUS bit 4 = 1", "Look at the event log for the cause.");
  if (axis.status(10)) add(`It is a breakpoint that holds it, in ${axis.boxName(axis.step)}.`, "STATUS bit 10 = 1", "Clear the breakpoint and run on.");
  if (axis.status(18)) add("It cannot go on from where it is held.", "STATUS bit 18 = 1", "Stop, then run from the start.");
  if (axis.setPoints.waits) add("Changed set-points wait.", "SET_POINT_STATE bit 0 = 1", `They are taken in ${axis.boxNames(axis.setPoints.takes)} or when the sequence stops.`);
  if (axis.forcedInputs || axis.forcedOutputs) add("Signals are forced.", "FORCE_IN, FORCE_OUT", "End the forces if they are not meant.");
  if (axis.isRunning && causes[0]?.code !== "moves") add(`The sequence waits in ${axis.boxName(axis.step)}, ${waits.summary(axis)}.`, `STEP = ${axis.step}`, "Give it what it waits for.");
  return [...list, ...causes.filter((cause) => !isFirst(cause)).map(findingOf)];
}
