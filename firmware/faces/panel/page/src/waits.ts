// What the active or the selected step waits for: every way out, each condition true or false now.
import { numbersInWords, waysOut } from "./boxes";
import { actionsOf, conditionInWords } from "./describe";
import { h, setClass, setText } from "./dom";
import type { Axis } from "./state";
import { conditionsOf, isTrue, type Condition, type Term, type Way } from "./table";

interface Live {
  term: Term;
  chips: { element: HTMLElement; mark: HTMLElement; condition: Condition }[];
  row: HTMLElement;
}

export class Waits {
  private shown = "";
  private box = -1;
  private live: Live[] = [];
  private cards: { element: HTMLElement; badge: HTMLElement; terms: Term[] }[] = [];

  constructor(private readonly root: HTMLElement, private readonly title: HTMLElement) {}

  /** `selected`: a box; of the active one its active copy is told. */
  update(axis: Axis, selected: number | null): void {
    const isActive = selected === null || selected === axis.box;
    const number = isActive ? axis.step : selected;
    const shown = `${axis.info.name} ${axis.program?.crc} ${axis.program?.hasSymbols} ${axis.hasTable} ${number}`;
    if (shown !== this.shown) {
      this.shown = shown;
      this.rebuild(axis, number);
    }
    setText(this.title, !axis.hasTable ? "No table" : isActive ? `Active step: ${axis.boxName(number)}` : `Step ${axis.boxName(number)} (not active)`);
    setClass(this.root, "idle", !isActive);
    this.judge(axis);
  }

  /** From copy to copy of a step that blinks, what a person opened stays open and the keyboard where it is. */
  private rebuild(axis: Axis, number: number): void {
    const staysInBox = axis.boxOf(number) === this.box;
    const wasOpen = this.root.querySelector("details")?.open ?? false;
    const focused = this.live.findIndex(({ row }) => row === document.activeElement);
    this.box = axis.boxOf(number);
    this.build(axis, number);
    if (!staysInBox) return;
    const acts = this.root.querySelector("details");
    if (acts) acts.open = wasOpen;
    if (focused >= 0) this.live[Math.min(focused, this.live.length - 1)]?.row.focus({ preventScroll: true });
  }

  private build(axis: Axis, number: number): void {
    this.live = [];
    this.cards = [];
    const step = axis.hasTable ? axis.program?.steps.get(number) : undefined;
    if (!step) {
      this.root.replaceChildren(h("p", { class: "quiet" }, "Upload a table, or let the configuration name one."));
      return;
    }
    const made = this.madeFor(axis, number);
    this.root.replaceChildren(
      ...(made ? [h("p", { class: "quiet" }, made)] : []),
      ...waysOut(step, axis.program!.boxes).map((way) => this.card(axis, way)),
      ...(step.ways.length ? [] : [h("p", { class: "quiet" }, "No way leads out of this step.")]),
      ...(step.acts.length ? [this.acts(axis, step.acts)] : []));
  }

  private madeFor(axis: Axis, number: number): string {
    const made = axis.madeFor(number);
    if (axis.boxOf(number) !== number) return `Now in step ${number}, which the compiler made: ${made}`;
    const copies = axis.stepsOf(number).slice(1);
    if (copies.length) return `The compiler made ${copies.length === 1 ? "a copy" : `${copies.length} copies`} of this step for what it remembers: ${numbersInWords(copies)}.`;
    return made && `The compiler made this step: ${made}`;
  }

  private wayInWords(axis: Axis, way: Way): string {
    if (way.to === way.from) return "begins anew";
    return axis.program!.boxes.isWithin(way) ? `stays, as ${axis.stepName(way.to)}` : axis.stepName(way.to);
  }

  private card(axis: Axis, way: Way): HTMLElement {
    const badge = h("span", { class: "badge" });
    const element = h("section", { class: `card${way.isError ? " error-way" : ""}` },
      h("h3", {}, `→ ${this.wayInWords(axis, way)}`, badge),
      ...way.terms.map((term) => this.term(axis, term)));
    this.cards.push({ element, badge, terms: way.terms });
    return element;
  }

  private term(axis: Axis, term: Term): HTMLElement {
    const list = conditionsOf(term);
    const chips = list.map((condition) => {
      const mark = h("span", { class: "mark" });
      return { element: h("li", { class: "chip" }, mark, conditionInWords(axis, condition)), mark, condition };
    });
    const does = actionsOf(axis, term);
    const out = term.isWrite ? "" : axis.outputNames(term.outputs).join(", ");
    const bytes = [...term.bytes].map((b) => b.toString(16).toUpperCase().padStart(2, "0")).join(" ");
    const row = h("div", { class: "term", tabindex: 0, title: `term ${term.index}: ${bytes}` },
      h("ul", { class: "chips", "aria-label": "conditions" }, ...chips.map((c) => c.element)),
      !!(does.length || out) && h("p", { class: "does" }, does.join("; "), out && `${does.length ? "; " : ""}outputs: ${out}`),
      h("p", { class: "bytes" }, `term ${term.index}: ${bytes}`));
    this.live.push({ term, chips, row });
    return row;
  }

  private acts(axis: Axis, terms: Term[]): HTMLElement {
    return h("details", { class: "card acts" }, h("summary", {}, `While in the step: ${terms.length} ${terms.length === 1 ? "term" : "terms"}`),
      ...terms.map((term) => this.term(axis, term)));
  }

  private judge(axis: Axis): void {
    const key = axis.key;
    const holding = new Set<Term>();
    for (const { term, chips, row } of this.live) {
      let all = true;
      for (const chip of chips) {
        const holds = isTrue(chip.condition, key);
        all &&= holds;
        setClass(chip.element, "yes", holds);
        setClass(chip.element, "no", !holds);
        // ERROR is compared in every term; it is worth a word only where it matters.
        setClass(chip.element, "usual", chip.condition.kind === "error" && holds && !chip.condition.wanted);
        setText(chip.mark, holds ? "✓ " : "✗ ");
      }
      setClass(row, "holds", all);
      if (all) holding.add(term);
    }
    for (const { element, badge, terms } of this.cards) {
      const open = terms.some((term) => holding.has(term));
      setClass(element, "open", open);
      setText(badge, open ? "true now" : `waits for ${this.missing(axis, terms, key)}`);
    }
  }

  /** The conditions that lack in the term that lacks the fewest. */
  private missing(axis: Axis, terms: Term[], key: number): string {
    let best: Condition[] | null = null;
    for (const term of terms) {
      const lacking = conditionsOf(term).filter((c) => !isTrue(c, key));
      if (best === null || lacking.length < best.length) best = lacking;
    }
    return (best ?? []).map((c) => conditionInWords(axis, c)).join(", ");
  }

  /** The same in one sentence. */
  summary(axis: Axis): string {
    const step = axis.program?.steps.get(axis.step);
    if (!step) return "";
    const all = waysOut(step, axis.program!.boxes);
    const isWithin = (way: Way): boolean => axis.program!.boxes.isWithin(way);
    // The branches that lead out of the box; for a copy without any, those that lead to another copy.
    const ways = [all.filter((way) => !way.isError && !isWithin(way)), all.filter(isWithin), all].find((list) => list.length) ?? [];
    return ways.map((way) => `for ${axis.stepName(way.to)}: ${this.missing(axis, way.terms, axis.key) || "nothing, it is true now"}`).join("; ");
  }
}
