// The page: what comes over the wire goes into the axes, and once a frame onto the screen.
import { byId, h, setAttribute, setClass, setText, withCode } from "./dom";
import { StepDrawing } from "./drawing";
import { Operation } from "./operate";
import { SetPoints } from "./set_points";
import { Facts, Signals } from "./signals";
import { Simulator } from "./simulator";
import { Axis, type AxisInfo, type LogEvent, type SetPointsNews } from "./state";
import { Trend } from "./trend";
import { Upload } from "./upload";
import { Waits } from "./waits";
import { type Cause, whyNot } from "./why";
import { Wire, type LinkState, type Message } from "./wire";
import { clock, duration, hex, kLinks, kReasons, wallTime } from "./words";

const kProtocol = 1;
const kOld = 1000; // ms: data older than this is shown as old
const kDropped = 35; // event: set-points fell back to their defaults

const axes = new Map<string, Axis>();
let current: Axis | null = null;
let painted = false;
let simulated = false;
let shownEvents = 0;
let shownWhy = "";

const drawing = new StepDrawing(document.getElementById("drawing") as unknown as SVGSVGElement);
const waits = new Waits(byId("waits"), byId("waits-title"));
const facts = new Facts(byId("facts"));
const trend = new Trend(byId("trend"), byId("trend-tools"), byId("trend-now"));
const wire = new Wire(take, linkChanged);
const operation = new Operation(wire, () => repaint());
const upload = new Upload(wire, operation);
const setPoints = new SetPoints(operation);
const simulator = new Simulator(operation, () => current);
const signals = new Signals(byId("signals"), {
  force: (isInput, bit, level) => void operation.force(isInput, bit, level),
  press: (bit) => simulator.press(bit),
});

function take(message: Message): void {
  const now = performance.now();
  if (message.t === "hello") return hello(message);
  if (message.t === "sim") return simulator.take(message);
  if (message.t === "beat") {
    for (const [name, age] of Object.entries(message.ages as Record<string, number>)) {
      const axis = axes.get(name);
      if (axis) axis.imageAt = now - age;
    }
    return repaint();
  }
  const axis = axes.get(message.axis as string);
  if (!axis) return;
  if (message.t === "image") {
    axis.takeImage(message, now);
    trend.add(axis, (axis.r.UPTIME ?? 0) / 1000);
  } else if (message.t === "program") {
    axis.takeProgram(message);
    if (axis === current) showAxis(axis);
  } else if (message.t === "events") axis.takeEvents(message.events as LogEvent[], false);
  else if (message.t === "seat") takeSeat(axis, message);
  else if (message.t === "why") axis.why = message.causes as Cause[] | null;
  else if (message.t === "set_points") axis.setPoints = message as unknown as SetPointsNews;
  repaint();
}

function takeSeat(axis: Axis, message: Message): void {
  const had = axis.seat.mine;
  axis.seat = { holder: message.holder as string, mine: message.mine as boolean };
  if (axis === current && had && !axis.seat.mine) operation.lostSeat();
}

function hello(message: Message): void {
  if ((message.protocol as number) !== kProtocol) {
    bar(`This page speaks protocol ${kProtocol}, the program ${String(message.protocol)}: load the page anew.`);
    return;
  }
  simulated = message.simulator as boolean;
  setClass(document.body, "simulated", simulated);
  const infos = message.axes as AxisInfo[];
  const wanted = current?.info.name ?? new URLSearchParams(location.search).get("axis");
  axes.clear(); // the steps in between are unknown: no path across the gap
  for (const info of infos) axes.set(info.name, new Axis(info));
  const choice = byId<HTMLSelectElement>("axis");
  choice.replaceChildren(...infos.map((info) => h("option", { value: info.name }, info.name)));
  byId("axis-choice").hidden = infos.length < 2;
  const axis = axes.get(wanted ?? "") ?? axes.values().next().value ?? null;
  if (axis) {
    choice.value = axis.info.name;
    showAxis(axis);
  }
  void operation.greeted(message.rights as { read: boolean; operate: boolean }, (message.stops as string[] | undefined) ?? []);
}

function showAxis(axis: Axis): void {
  const changes = current?.info.name !== axis.info.name;
  current = axis;
  shownEvents = 0;
  if (changes) drawing.selected = null;
  drawing.show(axis);
  trend.show(axis);
  operation.show(axis);
  upload.show(axis);
  setPoints.show(axis);
  repaint();
}

function linkChanged(state: LinkState): void {
  if (state === "lost") operation.setOperates(false);
  repaint();
}

function bar(text: string, tellsOfStop = false): void {
  byId("link-bar").hidden = text === "";
  setText(byId("link-text"), text);
  byId("do-give-up").hidden = !tellsOfStop;
}

/** However much comes, the screen is written once a frame. */
function repaint(): void {
  if (painted) return;
  painted = true;
  requestAnimationFrame(() => {
    painted = false;
    paint();
  });
}

function paintLink(age: number): void {
  const old = wire.state !== "open" || age > kOld;
  setClass(document.body, "old", old);
  if (wire.state === "replaced") bar("Another client took this page's place: there were too many. Load the page anew to watch again.");
  else if (wire.state === "lost") bar("The connection is lost. What you see is old; the page connects again by itself.");
  else if (wire.state === "connecting") bar("Connecting…");
  else if (simulated && simulator.isPaused && (age > kOld || current?.stopUnconfirmed)) bar("The simulated time is paused: nothing goes on, not even a stop, until “Go on” beside the time.");
  else if (current && current.imageAt > 0 && age > kOld) bar(`No news of the axis for ${duration(age)}: what you see is old.`);
  else if (current?.stopUnconfirmed) bar("The motor was told to stop and has not confirmed it: it may be moving. Look at its supply and its line.", true);
  else bar("");
}

function paint(): void {
  for (const one of axes.values()) operation.resolveDoubt(one);
  const axis = current;
  const age = axis ? performance.now() - axis.imageAt : Infinity;
  paintLink(age);
  if (!axis || axis.imageAt === 0) return;
  const isOld = document.body.classList.contains("old");
  const words = `${axis.stateInWords()}${isOld ? " (old)" : ""}`;
  setText(byId("state-text"), words);
  const kind = axis.stopUnconfirmed ? "bad" : axis.status(6) || axis.error ? (axis.runState === 0 && [1, 2].includes(axis.r.SAFE_REASON) ? "stopped" : "bad") : axis.isRunning ? "run" : "held";
  setAttribute(byId("state"), "data-kind", isOld ? "old" : kind);
  setAttribute(byId("state"), "title", kReasons[axis.r.SAFE_REASON]?.remedy ?? "");
  paintProgram(axis, words);
  drawing.update(axis);
  drawing.tell(byId("drawing-words"), axis);
  waits.update(axis, drawing.shown);
  facts.update(axis, kLinks, age);
  signals.update(axis);
  setPoints.update(axis);
  operation.update(axis);
  byId("show-active").hidden = drawing.selected === null;
  const looked = drawing.selected ?? axis.box;
  setText(byId("break"), axis.breaksAt(looked) ? "Clear breakpoint" : "Breakpoint");
  paintEvents(axis);
  paintWhy(axis);
  trend.draw();
  document.body.dataset.step = String(axis.step);
}

function paintProgram(axis: Axis, state: string): void {
  const name = axis.programName();
  setText(byId("program"), name);
  const title = `${name}${axes.size > 1 ? ` (${axis.info.name})` : ""}: ${state}`;
  if (document.title !== title) document.title = title;
  const program = axis.program;
  const active = [...axis.events].reverse().find((event) => event.code === 22);
  const parts = [axis.info.motor];
  if (program && axis.hasTable) {
    parts.push(`${program.terms.length} terms`, `CRC-32 ${hex(program.crc)}`, program.proof ? `proved (${program.proof.slice(0, 8)}…)` : "no certificate");
    if (program.file) parts.push(program.file.replace(/^.*\//, ""));
    if (active) parts.push(`active since ${clock(active.ms)} of uptime${dateOf(axis, active.ms)}`);
    else if (axis.events[0]?.n === 1) parts.push(`active since the start${dateOf(axis, 0)}`);
    if (axis.status(13)) parts.push("another table is stored");
    if (axis.otherScale()) parts.push(`Modbus, MQTT and metrics show positions at ${axis.otherScale()}`);
  }
  setText(byId("loaded"), parts.filter(Boolean).join(" · "));
}

/** A simulation has a time of its own. */
function dateOf(axis: Axis, uptime: number): string {
  return simulated ? "" : `, ${wallTime(axis.r.UPTIME ?? 0, uptime).toLocaleString([], { dateStyle: "medium", timeStyle: "short" })}`;
}

function paintEvents(axis: Axis): void {
  const last = axis.events[axis.events.length - 1]?.n ?? 0;
  if (last === shownEvents) return;
  shownEvents = last;
  const rows = [...axis.events].reverse().slice(0, 100).map((event) =>
    h("li", { class: (event.code > 2 && event.code < 16) || event.code === kDropped ? "event bad" : "event" },
      h("time", { title: simulated ? null : wallTime(axis.r.UPTIME ?? 0, event.ms).toLocaleString() }, clock(event.ms)), h("span", { class: "event-text" }, event.text), h("span", { class: "event-step" }, axis.boxName(event.step))));
  byId("events").replaceChildren(...(rows.length ? rows : [h("li", { class: "quiet" }, "Nothing has happened yet.")]));
}

function paintWhy(axis: Axis): void {
  const findings = whyNot(axis, waits, operation.operates);
  const text = JSON.stringify(findings);
  if (text === shownWhy) return;
  shownWhy = text;
  byId("why").replaceChildren(...(findings.length ? findings : [{ text: "Nothing keeps it from moving.", basis: "", remedy: "" }]).map((f) =>
    h("li", {}, h("strong", {}, ...withCode(f.text)), " ", ...withCode(f.remedy), f.basis && h("span", { class: "quiet" }, ` ${f.basis}`))));
}

// What the user does.

drawing.onSelect = () => repaint();
byId("axis").addEventListener("change", (e) => {
  const axis = axes.get((e.target as HTMLSelectElement).value);
  if (axis) showAxis(axis);
});
byId("show-active").addEventListener("click", () => drawing.select(null));
byId("break").addEventListener("click", () => {
  if (!current || !operation.operates) return;
  const box = drawing.selected ?? current.box;
  void operation.setBreak(current.stepsOf(box), !current.breaksAt(box));
});
byId("zoom-in").addEventListener("click", () => drawing.zoom(0.8));
byId("zoom-out").addEventListener("click", () => drawing.zoom(1.25));
byId("zoom-fit").addEventListener("click", () => drawing.fit());
byId<HTMLInputElement>("follow").addEventListener("change", (e) => (drawing.follows = (e.target as HTMLInputElement).checked));
byId<HTMLInputElement>("errors").addEventListener("change", (e) => drawing.setErrors((e.target as HTMLInputElement).checked));
byId<HTMLInputElement>("search").addEventListener("input", (e) => {
  const text = (e.target as HTMLInputElement).value;
  const count = drawing.search(text);
  setText(byId("search-count"), text.trim() ? `${count} found` : "");
});
byId<HTMLInputElement>("search").addEventListener("keydown", (e) => {
  const found = drawing.firstFound();
  if (e.key === "Enter" && found !== null) drawing.goTo(found);
});
document.addEventListener("visibilitychange", () => {
  if (document.hidden) return;
  wire.hurry();
  repaint();
});
window.addEventListener("online", () => wire.hurry());
setInterval(() => repaint(), 250); // ages, and the timer

wire.connect();
