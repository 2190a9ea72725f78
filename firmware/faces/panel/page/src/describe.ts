// Terms in the program's own words.
import type { Axis } from "./state";
import type { Condition, Term } from "./table";
import { commandInWords, duration } from "./words";

export function conditionInWords(axis: Axis, c: Condition): string {
  switch (c.kind) {
    case "input": return axis.inputText(c.bit, c.wanted);
    case "inpos": return c.wanted ? "INPOS" : "NOT INPOS";
    case "error": return c.wanted ? "ERROR" : "no ERROR";
    case "timer": return "timer has run down";
    case "counter": return "counter is 0";
  }
}

function valueInWords(axis: Axis, term: Term): string {
  const info = axis.program?.registers[term.register];
  const bits = term.isLong ? 32 : 16;
  const raw = info?.signed && term.value >= 2 ** (bits - 1) ? term.value - 2 ** bits : term.value;
  if (!info?.unit) return String(raw);
  if (info.unit === "rev") {
    const { value, unit } = axis.position(raw);
    return `${Number(value.toPrecision(6))} ${unit}`;
  }
  return `${Number((raw / info.per_unit).toPrecision(4))} ${info.unit}`;
}

/** What the program has in a register: of a set-point the value in force, else what all its writes give it. */
function contentOf(axis: Axis, plain: string, own: string | undefined): string {
  const setPoint = axis.setPoints.values.find((one) => one.name === own);
  if (setPoint) return `${setPoint.in_force} ${setPoint.unit}`.trim();
  const writes = axis.program?.terms.filter((term) => term.isWrite && axis.program?.registers[term.register]?.name === plain) ?? [];
  const values = new Set(writes.map((term) => valueInWords(axis, term)));
  return values.size === 1 ? [...values][0] : "";
}

/** The register behind POSITION(P2) by its own name, and what is in it: POSITION(Place): 60 mm. */
function withNames(axis: Axis, order: string): string {
  return order.replace(/\(([PVATLZ]\d)\)/, (_, plain: string) => {
    const own = axis.program?.symbols.registers?.find((r) => r.register === plain)?.name;
    const content = contentOf(axis, plain, own);
    return `(${own ?? plain})${content && `: ${content}`}`;
  });
}

/** What a true term does, beside its next step. */
export function actionsOf(axis: Axis, term: Term): string[] {
  if (term.isWrite) return [`${axis.registerName(term.register)} := ${valueInWords(axis, term)}`];
  const list: string[] = [];
  if (term.command !== null) list.push(withNames(axis, commandInWords(term.command)));
  if (term.timerPreset) list.push(`TIMER := ${duration(term.timerPreset)}`);
  if (term.clearsCounter) list.push("COUNTER := 0");
  else if (term.counterPreset) list.push(`COUNTER := ${term.counterPreset}`);
  else if (term.countsDown) list.push("COUNT_DOWN");
  return list;
}

/** A whole term on one line, as `compare` shows it. */
export function termInWords(axis: Axis, term: Term, conditions: Condition[]): string {
  const when = conditions.map((c) => conditionInWords(axis, c)).join(" AND ");
  const then = actionsOf(axis, term);
  if (!term.isWrite) then.push(`OUT ${axis.outputNames(term.outputs).join(", ") || "none"}`);
  if (term.next !== null) then.push(`NEXT ${axis.stepName(term.next)}`);
  return `${axis.stepName(term.step)}: ${when} → ${then.join("; ")}`;
}
