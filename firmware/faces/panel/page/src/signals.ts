// Inputs and outputs as lamps; in operation they are forced here, in a simulation inputs are clicked.
import { h, setAttribute, setClass, setText } from "./dom";
import type { Axis } from "./state";
import { duration } from "./words";

export interface SignalActions {
  force(isInput: boolean, bit: number, level: 0 | 1 | null): void;
  press(bit: number): void;
}

interface Row {
  element: HTMLElement;
  lamp: HTMLElement;
  name: HTMLElement;
  note: HTMLElement;
  choice: HTMLSelectElement;
  press: HTMLButtonElement | null;
}

const forceOf = (forced: number, levels: number, bit: number): number | null => (forced >> bit & 1 ? levels >> bit & 1 : null);

export class Signals {
  private inputs: Row[] = [];
  private outputs: Row[] = [];

  constructor(root: HTMLElement, private readonly actions: SignalActions) {
    const column = (title: string, rows: Row[]) =>
      h("div", { class: "signal-column" }, h("h3", {}, title), h("ul", { class: "signals" }, ...rows.map((row) => row.element)));
    for (let bit = 0; bit < 6; ++bit) this.inputs.push(this.row(true, bit));
    for (let bit = 0; bit < 4; ++bit) this.outputs.push(this.row(false, bit));
    root.append(column("Inputs", this.inputs), column("Outputs", this.outputs));
  }

  private row(isInput: boolean, bit: number): Row {
    const lamp = h("span", { class: "lamp", role: "img" });
    const name = h("span", { class: "signal-name" });
    const note = h("span", { class: "signal-note" });
    const choice = h("select", { class: "operating-only", "aria-label": "force" },
      h("option", { value: "" }, "real"), h("option", { value: "0" }, "force 0"), h("option", { value: "1" }, "force 1"));
    choice.addEventListener("change", () =>
      this.actions.force(isInput, bit, choice.value === "" ? null : choice.value === "1" ? 1 : 0));
    const press = isInput ? h("button", { class: "sim-only press", type: "button", onclick: () => this.actions.press(bit) }, "switch") : null;
    return { element: h("li", {}, lamp, name, note, h("span", { class: "signal-acts" }, choice, press)), lamp, name, note, choice, press };
  }

  update(axis: Axis): void {
    this.inputs.forEach((row, bit) => this.show(row, axis.inputText(bit, true), `IN${bit}`, axis.inputs >> bit & 1, forceOf(axis.forcedInputs, axis.forcedInputLevels, bit),
      (axis.terminals >> bit & 1) !== (axis.inputs >> bit & 1) ? `terminal ${axis.terminals >> bit & 1}` : ""));
    this.outputs.forEach((row, bit) => this.show(row, axis.outputName(bit), `OUT${bit}`, axis.outputs >> bit & 1, forceOf(axis.forcedOutputs, axis.forcedOutputLevels, bit),
      (axis.written >> bit & 1) !== (axis.outputs >> bit & 1) ? `sequence wrote ${axis.written >> bit & 1}` : ""));
  }

  /** `forced`: the level that was asked for; what is shown may be another, as an output's safe value. */
  private show(row: Row, name: string, plain: string, level: number, forced: number | null, note: string): void {
    setText(row.name, name);
    setAttribute(row.name, "title", plain);
    setClass(row.lamp, "on", level === 1);
    setAttribute(row.lamp, "aria-label", `${name} is ${level}`);
    setText(row.lamp, String(level));
    setClass(row.element, "forced", forced !== null);
    setText(row.note, [forced === null ? "" : `forced ${forced}${forced === level ? "" : `, now ${level}`}`, note].filter(Boolean).join(", "));
    setAttribute(row.choice, "aria-label", `force ${name}`);
    if (row.press) setAttribute(row.press, "aria-label", `switch ${name}`);
    const value = forced === null ? "" : String(forced);
    if (document.activeElement !== row.choice && row.choice.value !== value) row.choice.value = value;
  }
}

/** INPOS, ERROR, timer, counter, link, forces. */
export class Facts {
  private readonly cells = new Map<string, { element: HTMLElement; value: HTMLElement; bar: HTMLElement | null }>();
  private timerFrom = 0;
  private counterFrom = 0;
  private forcesFrom = 0;

  constructor(root: HTMLElement) {
    for (const [id, label, bar] of [["timer", "Timer", 1], ["counter", "Counter", 1], ["inpos", "IN_POS", 0], ["error", "ERROR", 0],
      ["link", "Link to the motor", 0], ["forces", "Forces", 1]] as const) {
      const value = h("span", { class: "fact-value" });
      const filled = bar ? h("span", { class: "gauge-fill" }) : null;
      const element = h("div", { class: "fact", id: `fact-${id}` }, h("span", { class: "fact-label" }, label), value,
        filled && h("span", { class: "gauge" }, filled));
      this.cells.set(id, { element, value, bar: filled });
      root.append(element);
    }
  }

  private set(id: string, text: string, kind = "", part = 0): void {
    const cell = this.cells.get(id)!;
    setText(cell.value, text);
    setAttribute(cell.element, "data-kind", kind);
    if (cell.bar) cell.bar.style.width = `${Math.max(0, Math.min(1, part)) * 100}%`;
  }

  /** `elapsed`: since the values were true. */
  update(axis: Axis, links: string[], elapsed: number): void {
    const runs = axis.isRunning && elapsed < 1000;
    const timer = Math.max(0, (axis.r.TIMER ?? 0) - (runs ? elapsed : 0));
    this.timerFrom = timer > this.timerFrom || timer === 0 ? timer : this.timerFrom;
    this.set("timer", timer === 0 ? "0" : duration(timer), "", this.timerFrom ? timer / this.timerFrom : 0);
    const counter = axis.r.COUNTER ?? 0;
    this.counterFrom = counter > this.counterFrom || counter === 0 ? counter : this.counterFrom;
    this.set("counter", String(counter), "", this.counterFrom ? counter / this.counterFrom : 0);
    this.set("inpos", axis.inPosition ? "yes" : "no", axis.inPosition ? "good" : "");
    this.set("error", axis.error ? "ERROR" : "no", axis.error ? "bad" : "");
    const link = axis.r.LINK ?? 0;
    this.set("link", links[link] ?? "unknown", link === 3 ? "good" : "bad");
    const left = axis.r.FORCE_LEFT ?? 0;
    const forced = axis.forcedInputs || axis.forcedOutputs;
    this.forcesFrom = forced ? Math.max(left, this.forcesFrom) : 0;
    this.set("forces", forced ? `end in ${duration(left)}` : "none", forced ? "warn" : "", this.forcesFrom ? left / this.forcesFrom : 0);
  }
}
