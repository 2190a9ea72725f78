// Steps that are drawn as one box: a step with the copies that the compiler made of it.
import type { Step, Term, Way } from "./table";

export interface NamedStep {
  number: number;
  name: string;
  made_for?: string;
  copy_of?: number;
}

const kCopy = /^copy of '([^']+)'/;

export class Boxes {
  /** By box, whose number is that of the step as it was written: all its steps, that one first. */
  readonly steps = new Map<number, number[]>();
  private readonly boxes = new Map<number, number>();

  constructor(numbers: Iterable<number>, named: NamedStep[] = []) {
    const present = new Set(numbers);
    const byNumber = new Map(named.map((one) => [one.number, one]));
    const copied = (one: NamedStep | undefined): string | undefined => kCopy.exec(one?.made_for ?? "")?.[1];
    const originalOf = (step: number): number => {
      const own = byNumber.get(step);
      const name = copied(own);
      if (step === 0 || name === undefined) return step;
      // `copy_of` is the step copied from; in a step of a later CALL, which is no copy, it is the step of the first CALL.
      const original = named.find((one) => one.name === name)?.number ?? own?.copy_of;
      return original !== undefined && present.has(original) && copied(byNumber.get(original)) === undefined ? original : step;
    };
    for (const step of present) this.boxes.set(step, originalOf(step));
    for (const [step, box] of this.boxes) if (step === box) this.steps.set(box, [box]);
    for (const [step, box] of this.boxes) if (step !== box) this.steps.get(box)!.push(step);
  }

  /** The box that a step is drawn in. */
  of(step: number): number {
    return this.boxes.get(step) ?? step;
  }
  stepsOf(box: number): number[] {
    return this.steps.get(box) ?? [box];
  }
  /** From one copy to another: the way is within the box. */
  isWithin(way: { from: number; to: number }): boolean {
    return way.from !== way.to && this.of(way.from) === this.of(way.to);
  }
}

/** Ways between boxes, each once. Of a box to itself: a step begins anew. */
export function waysBetween(steps: Iterable<Step>, boxes: Boxes): Way[] {
  const ways = new Map<string, Way>();
  for (const step of steps) {
    for (const way of step.ways) {
      if (boxes.isWithin(way)) continue;
      const [from, to] = [boxes.of(way.from), boxes.of(way.to)];
      const known = ways.get(`${from}>${to}`);
      if (!known) ways.set(`${from}>${to}`, { from, to, terms: [...way.terms], isError: way.isError });
      else {
        known.terms.push(...way.terms);
        known.isError &&= way.isError;
      }
    }
  }
  return [...ways.values()];
}

/** Ways out of one step: to all copies of another as one, to each of its own copies apart. */
export function waysOut(step: Step, boxes: Boxes): Way[] {
  const ways: Way[] = [];
  for (const way of step.ways) {
    const to = boxes.of(way.to) === boxes.of(way.from) ? way.to : boxes.of(way.to);
    const known = ways.find((one) => one.to === to);
    if (!known) ways.push({ ...way, to, terms: [...way.terms] });
    else {
      known.terms.push(...way.terms);
      known.terms.sort((a: Term, b: Term) => a.index - b.index);
      known.isError &&= way.isError;
    }
  }
  return ways;
}

/** `3, 7–9` */
export function numbersInWords(numbers: number[]): string {
  const runs: [number, number][] = [];
  for (const number of [...numbers].sort((a, b) => a - b)) {
    const last = runs[runs.length - 1];
    if (last && last[1] === number - 1) last[1] = number;
    else runs.push([number, number]);
  }
  return runs.map(([first, last]) => (first === last ? String(first) : last === first + 1 ? `${first}, ${last}` : `${first}–${last}`)).join(", ");
}
