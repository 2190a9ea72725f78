// The sequence as a drawing: the active step lit, the last path, breakpoints; zoom, drag, search, follow.
import { numbersInWords, waysBetween } from "./boxes";
import { setAttribute, setClass, setText, svg } from "./dom";
import { kBoxHeight, kBoxWidth, layOut, pathOf, type Drawing } from "./layout";
import type { Axis } from "./state";
import type { Way } from "./table";

interface View {
  x: number;
  y: number;
  width: number;
  height: number;
}

const kPathShown = 6;
const kLeastWidth = 220;
// px of the screen for one of the drawing, where the page's text is as large as kText.
const kReadable = 0.7; // a drawing that would be smaller is shown in part
const kPleasant: [number, number] = [0.8, 1]; // such a part, larger the less lies beside it
const kText = 15;

export class StepDrawing {
  selected: number | null = null; // a box; null: the active step
  private pointed: number | null = null; // by mouse or keyboard
  get shown(): number | null { return this.pointed ?? this.selected; }
  follows = true;
  onSelect: (step: number | null) => void = () => {};
  private drawing: Drawing | null = null;
  private boxes = new Map<number, SVGGElement>();
  private lines = new Map<string, SVGPathElement>();
  private view: View = { x: 0, y: 0, width: 400, height: 300 };
  private target: View | null = null;
  private lastBox = -1;
  private axis: Axis | null = null;
  private showsErrors = false;
  private shows: "readable" | "all" | "chosen" = "readable"; // chosen: the user has moved or zoomed
  private drag: { x: number; y: number; view: View; moved: boolean } | null = null;
  private pinch = new Map<number, { x: number; y: number }>();

  constructor(private readonly root: SVGSVGElement) {
    root.addEventListener("wheel", (e) => this.wheel(e), { passive: false });
    root.addEventListener("pointerdown", (e) => this.pointerDown(e));
    root.addEventListener("pointermove", (e) => this.pointerMove(e));
    for (const end of ["pointerup", "pointercancel", "pointerleave"] as const)
      root.addEventListener(end, (e) => this.pointerUp(e));
    new ResizeObserver(() => this.resized()).observe(root);
  }

  /** A new table, or new names. */
  show(axis: Axis): void {
    this.axis = axis;
    this.boxes.clear();
    this.lines.clear();
    this.lastBox = -1;
    this.pointed = null;
    this.root.replaceChildren();
    if (!axis.program || !axis.program.terms.length) {
      this.drawing = null;
      return;
    }
    const { steps, boxes } = axis.program;
    if (this.selected !== null) this.selected = steps.has(this.selected) ? boxes.of(this.selected) : null;
    const ways = waysBetween(steps.values(), boxes);
    const pairs = ways.filter((way) => !this.isAside(way)).map((way): [number, number] => [way.from, way.to]);
    this.drawing = layOut([...boxes.steps.keys()], pairs);
    this.root.append(this.marker("arrow"), this.marker("arrow-path"), this.marker("arrow-error"));
    for (const line of this.drawing.lines) this.addLine(line.from, line.to, pathOf(line.points), false);
    for (const way of ways) if (this.isAside(way)) this.addAside(way);
    for (const box of boxes.steps.keys()) this.addBox(box, ways.some((way) => way.from === box && way.to === box));
    this.begin();
  }

  /** ERROR's ways would cross everything: they are shown for the step that is looked at. */
  private isAside(way: Way): boolean {
    return way.isError && way.from !== way.to;
  }

  private marker(id: string): SVGDefsElement {
    return svg("defs", {}, svg("marker", { id, viewBox: "0 0 8 8", refX: 7, refY: 4, markerWidth: 11, markerHeight: 11, markerUnits: "userSpaceOnUse", orient: "auto" },
      svg("path", { d: "M0 0L8 4L0 8z", class: id })));
  }

  private addLine(from: number, to: number, d: string, aside: boolean): void {
    const line = svg("path", { d, class: aside ? "way aside" : "way", fill: "none" });
    this.lines.set(`${from}>${to}`, line);
    this.root.append(line);
  }

  private addAside(way: Way): void {
    const from = this.drawing!.boxes.get(way.from)!;
    const to = this.drawing!.boxes.get(way.to)!;
    const right = to.x >= from.x;
    const a = { x: from.x + (right ? kBoxWidth : 0), y: from.y + kBoxHeight / 2 };
    const b = { x: to.x + (right ? 0 : kBoxWidth), y: to.y + kBoxHeight / 2 };
    const bend = Math.max(40, Math.abs(b.x - a.x) / 2) * (right ? 1 : -1);
    this.addLine(way.from, way.to, `M${a.x} ${a.y}C${a.x + bend} ${a.y} ${b.x - bend} ${b.y} ${b.x} ${b.y}`, true);
  }

  private addBox(step: number, self: boolean): void {
    const axis = this.axis!;
    const at = this.drawing!.boxes.get(step)!;
    const name = axis.stepName(step);
    const box = svg("g", { class: "box", transform: `translate(${at.x} ${at.y})`, tabindex: step === 0 ? 0 : -1, role: "button", "data-step": step },
      svg("rect", { width: kBoxWidth, height: kBoxHeight, rx: 8 }),
      svg("circle", { cx: 0, cy: kBoxHeight / 2, r: 6, class: "break" }),
      svg("text", { x: kBoxWidth / 2, y: 20, class: "name" }, name),
      " ",  // else readers take name and number for one word
      svg("text", { x: kBoxWidth / 2, y: 36, class: "number" }, this.note(step, self)));
    box.addEventListener("keydown", (e) => this.key(e, step));
    box.addEventListener("focus", () => {
      this.roving(step);
      if (box.matches(":focus-visible")) this.point(step);
    });
    box.addEventListener("blur", () => this.point(null));
    box.addEventListener("pointerenter", (e) => { if (e.pointerType === "mouse") this.point(step); });
    box.addEventListener("pointerleave", () => this.point(null));
    this.boxes.set(step, box);
    this.root.append(box);
    for (const text of box.querySelectorAll("text")) this.fitText(text);
  }

  /** How wide a name is depends on the machine's fonts. */
  private fitText(text: SVGTextElement): void {
    const room = kBoxWidth - 12;
    if (text.getComputedTextLength() > room) text.classList.add("long");
    if (text.getComputedTextLength() <= room) return;
    setAttribute(text, "textLength", String(room));
    setAttribute(text, "lengthAdjust", "spacingAndGlyphs");
  }

  /** What the mouse is on or the keyboard has come to is told, without being chosen. */
  private point(step: number | null): void {
    this.pointed = step;
    this.onSelect(this.selected);
  }

  private note(box: number, self: boolean): string {
    const outputs = this.outputsOf(box);
    return `${numbersInWords(this.axis!.stepsOf(box))}${self ? " ↻" : ""}${outputs ? ` · ${outputs}` : ""}`.slice(0, 26);
  }

  /** Those that are on in some of its copies only, as a lamp that blinks, in brackets. */
  private outputsOf(box: number): string {
    const axis = this.axis!;
    const masks = axis.stepsOf(box).map((step) => axis.program!.symbols.steps?.find((s) => s.number === step)?.outputs ?? 0);
    const always = masks.reduce((all, mask) => all & mask, 0xf);
    const some = masks.reduce((all, mask) => all | mask, 0) & ~always;
    return [...axis.outputNames(always), ...axis.outputNames(some).map((name) => `(${name})`)].join(" ");
  }

  private roving(step: number): void {
    for (const [number, box] of this.boxes) setAttribute(box, "tabindex", number === step ? "0" : "-1");
  }

  private key(event: KeyboardEvent, step: number): void {
    if (event.key === "Enter" || event.key === " ") {
      event.preventDefault();
      return this.select(step);
    }
    const at = this.drawing!.boxes.get(step)!;
    const turn: Record<string, [number, number]> = { ArrowUp: [0, -1], ArrowDown: [0, 1], ArrowLeft: [-1, 0], ArrowRight: [1, 0] };
    const direction = turn[event.key];
    if (!direction) return;
    event.preventDefault();
    let best = -1;
    let least = Infinity;
    for (const box of this.drawing!.boxes.values()) {
      const along = (box.x - at.x) * direction[0] + (box.y - at.y) * direction[1];
      const aside = Math.abs((box.x - at.x) * direction[1]) + Math.abs((box.y - at.y) * direction[0]);
      if (along > 1 && along + 2 * aside < least) [best, least] = [box.id, along + 2 * aside];
    }
    if (best < 0) return;
    this.boxes.get(best)!.focus();
    this.reveal(best);
  }

  select(step: number | null): void {
    this.selected = step;
    if (step !== null) this.reveal(step);
    this.onSelect(step);
    this.update(this.axis!);
  }

  setErrors(on: boolean): void {
    this.showsErrors = on;
    if (this.axis) this.update(this.axis);
  }

  /** What has changed in the machine. */
  update(axis: Axis): void {
    if (!this.drawing) return;
    const active = axis.hasTable ? axis.box : -1;
    const looked = this.selected ?? active;
    const recent = axis.boxPath.slice(-kPathShown - 1);
    const ways = new Map<string, number>();
    for (let i = 1; i < recent.length; ++i) ways.set(`${recent[i - 1]}>${recent[i]}`, i);
    for (const [step, box] of this.boxes) {
      setClass(box, "active", step === active);
      setClass(box, "alarm", step === active && axis.error);
      setClass(box, "paused", step === active && !axis.isRunning);
      setClass(box, "selected", step === this.selected);
      setClass(box, "breaks", axis.breaksAt(step));
      const copies = axis.stepsOf(step).length - 1;
      const label = `${axis.stepName(step)} ${box.querySelector(".number")!.textContent}${copies ? `, with ${copies} ${copies === 1 ? "copy" : "copies"}` : ""}${step === active ? ", active" : ""}${axis.breaksAt(step) ? ", breakpoint" : ""}`;
      setAttribute(box, "aria-label", label);
    }
    for (const [key, line] of this.lines) {
      const order = ways.get(key);
      setClass(line, "taken", order !== undefined);
      setClass(line, "latest", order === recent.length - 1);
      setClass(line, "shown", this.showsErrors || key.startsWith(`${looked}>`));
    }
    if (active !== this.lastBox) {
      this.lastBox = active;
      if (this.follows && this.selected === null && active >= 0) this.reveal(active);
    }
  }

  /** Boxes with a step whose name or number matches; the first one is shown. */
  search(text: string): number {
    const wanted = text.trim().toLowerCase();
    let first: number | null = null;
    let count = 0;
    for (const [step, box] of this.boxes) {
      const matches = (one: number): boolean => this.axis!.stepName(one).toLowerCase().includes(wanted) || String(one) === wanted;
      const hit = wanted !== "" && this.axis!.stepsOf(step).some(matches);
      setClass(box, "found", hit);
      if (!hit) continue;
      ++count;
      first ??= step;
    }
    if (first !== null) this.reveal(first);
    return count;
  }

  firstFound(): number | null {
    const found = this.root.querySelector(".box.found");
    return found ? Number(found.getAttribute("data-step")) : null;
  }

  // The part that is seen.

  private aspect(): number {
    return (this.root.clientHeight || 300) / (this.root.clientWidth || 400);
  }

  private apply(view: View): void {
    this.view = view;
    this.root.setAttribute("viewBox", `${view.x} ${view.y} ${view.width} ${view.height}`);
  }

  /** All steps, however small. */
  fit(): void {
    if (!this.drawing) return;
    const width = Math.max(this.drawing.width, this.drawing.height / this.aspect(), kLeastWidth * 2);
    const height = width * this.aspect();
    this.target = null;
    this.shows = "all";
    this.apply({ x: (this.drawing.width - width) / 2, y: Math.min(0, (this.drawing.height - height) / 2), width, height });
  }

  /** All steps, or if nobody could read them then a part around the active one. */
  private begin(): void {
    this.fit();
    this.shows = "readable";
    const part = this.partFor();
    if (part !== null) this.magnify(part);
    if (this.lastBox >= 0) this.reveal(this.lastBox);
  }

  /** By what to magnify what is too small to read; null: nothing is. */
  private partFor(): number | null {
    const text = parseFloat(getComputedStyle(document.documentElement).fontSize) / kText;
    const scale = this.root.clientWidth / this.view.width;
    if (scale >= kReadable * text) return null;
    const whole = this.root.clientWidth / (this.drawing!.width * text);
    return scale / (Math.min(Math.max(whole, kPleasant[0]), kPleasant[1]) * text);
  }

  /** Shows it and selects it, as large as can be read. */
  goTo(step: number): void {
    const part = this.partFor();
    if (part !== null) this.zoom(part);
    this.select(step);
  }

  private resized(): void {
    if (this.shows === "all") return this.fit();
    if (this.shows === "readable") return this.begin();
    this.apply({ ...this.view, height: this.view.width * this.aspect() });
    if (this.lastBox >= 0 && this.follows) this.reveal(this.lastBox);
  }

  zoom(factor: number, at?: { x: number; y: number }): void {
    this.shows = "chosen";
    this.magnify(factor, at);
  }

  private magnify(factor: number, at?: { x: number; y: number }): void {
    const most = this.drawing ? Math.max(this.drawing.width, this.drawing.height / this.aspect()) * 1.5 : 2000;
    const width = Math.min(Math.max(this.view.width * factor, kLeastWidth), Math.max(most, kLeastWidth * 2));
    const real = width / this.view.width;
    const x = at ? at.x : this.view.x + this.view.width / 2;
    const y = at ? at.y : this.view.y + this.view.height / 2;
    this.target = null;
    this.apply({ x: x - (x - this.view.x) * real, y: y - (y - this.view.y) * real, width, height: width * this.aspect() });
  }

  /** Moves only if the step is not well inside. */
  reveal(step: number): void {
    const box = this.drawing?.boxes.get(step);
    if (!box) return;
    const { x, y, width, height } = this.target ?? this.view;
    const edge = 12;
    const inside = box.x >= x + edge && box.x + kBoxWidth <= x + width - edge && box.y >= y + edge && box.y + kBoxHeight <= y + height - edge;
    if (inside) return;
    const within = (wanted: number, seen: number, all: number): number => (seen >= all ? (all - seen) / 2 : Math.min(Math.max(wanted, 0), all - seen));
    this.target = {
      x: within(box.x + kBoxWidth / 2 - width / 2, width, this.drawing!.width),
      y: within(box.y + kBoxHeight / 2 - height / 2, height, this.drawing!.height), width, height,
    };
    if (matchMedia("(prefers-reduced-motion: reduce)").matches || document.hidden) {
      this.apply(this.target);
      this.target = null;
    } else requestAnimationFrame(() => this.glide());
  }

  private glide(): void {
    if (!this.target) return;
    const far = Math.hypot(this.target.x - this.view.x, this.target.y - this.view.y);
    const part = far < 1 ? 1 : 0.35;
    this.apply({ ...this.view, x: this.view.x + (this.target.x - this.view.x) * part, y: this.view.y + (this.target.y - this.view.y) * part });
    if (part === 1) this.target = null;
    else requestAnimationFrame(() => this.glide());
  }

  private at(event: { clientX: number; clientY: number }): { x: number; y: number } {
    const area = this.root.getBoundingClientRect();
    return {
      x: this.view.x + ((event.clientX - area.left) / area.width) * this.view.width,
      y: this.view.y + ((event.clientY - area.top) / area.height) * this.view.height,
    };
  }

  /** Ctrl and the wheel zoom, as in maps; the wheel alone scrolls the page. */
  private wheel(event: WheelEvent): void {
    if (!event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    this.zoom(Math.exp(event.deltaY / 400), this.at(event));
  }

  private pointerDown(event: PointerEvent): void {
    this.pinch.set(event.pointerId, { x: event.clientX, y: event.clientY });
    this.drag = { x: event.clientX, y: event.clientY, view: this.view, moved: false };
  }

  private pointerMove(event: PointerEvent): void {
    if (!this.drag || !this.pinch.has(event.pointerId)) return;
    if (this.pinch.size === 2) {
      const [a, b] = [...this.pinch.values()];
      const before = Math.hypot(a.x - b.x, a.y - b.y);
      this.pinch.set(event.pointerId, { x: event.clientX, y: event.clientY });
      const [c, d] = [...this.pinch.values()];
      this.drag.moved = true;
      return this.zoom(before / Math.max(1, Math.hypot(c.x - d.x, c.y - d.y)));
    }
    const dx = event.clientX - this.drag.x;
    const dy = event.clientY - this.drag.y;
    if (!this.drag.moved && Math.hypot(dx, dy) < 5) return;
    this.drag.moved = true;
    this.shows = "chosen";
    this.target = null;
    const scale = this.view.width / this.root.clientWidth;
    this.apply({ ...this.view, x: this.drag.view.x - dx * scale, y: this.drag.view.y - dy * scale });
  }

  private pointerUp(event: PointerEvent): void {
    this.pinch.delete(event.pointerId);
    if (!this.drag || event.type !== "pointerup") return void (this.drag = null);
    const moved = this.drag.moved;
    this.drag = null;
    if (moved) return;
    const box = (event.target as Element).closest?.(".box");
    if (box) this.select(Number(box.getAttribute("data-step")));
    else if (this.selected !== null) this.select(null);
  }

  /** What the drawing says in words, for those who do not see it. */
  tell(element: Element, axis: Axis): void {
    setText(element, axis.hasTable ? `Active step: ${axis.boxName(axis.step)}` : "There is no table.");
  }
}
