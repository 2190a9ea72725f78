// Position, velocity and current of the last minutes: pause, zoom, CSV.
import uPlot from "uplot";
import { h, saveFile, setClass, setText } from "./dom";
import { spanOf } from "./span";
import type { Axis } from "./state";
import { duration } from "./words";

const kKept = 6000; // samples: ten minutes at ten a second
const kWindows = [10, 60, 300];
const kOld = 1000; // ms: a value that was read before is shown with its age
const kPause = 2; // seconds without a sample are a gap in the lines
const kAnswers = 2; // LINK from here on: the motor answers, acknowledged by the sequence or not
const kNarrow = 560; // px
// An axis shows at least so much: what a shaft at rest trembles is not drawn as high as the plot.
const kLeastTurns = 0.05; // revolutions
const kLeastSpeed = 20; // rpm
const kLeastCurrent = 20; // %
const kFullCurrent = 1023; // VF_OUT of the peak (001 §3.2.7)

type Samples = (number | null | undefined)[];

interface Series {
  time: number[]; // seconds of the gateway's uptime
  position: Samples; // null: a gap; undefined: no new value, the line continues
  speed: Samples;
  torque: Samples;
  step: number[];
  readonly taken: Map<string, number>; // when the last value came, by register
}

const empty = (): Series => ({ time: [], position: [], speed: [], torque: [], step: [], taken: new Map() });

export class Trend {
  private plot: uPlot | null = null;
  private readonly data = new Map<string, Series>();
  private axis: Axis | null = null;
  private paused = false;
  private zoomed = false;
  private window = kWindows[1];
  private drawn = 0;
  private isNarrow = false;
  private readonly watch = new ResizeObserver(() => this.resized());
  private readonly pauseButton: HTMLButtonElement;

  constructor(private readonly root: HTMLElement, tools: HTMLElement, private readonly table: HTMLElement) {
    this.pauseButton = h("button", { type: "button", onclick: () => this.pause() }, "Pause");
    const choice = h("select", { "aria-label": "time shown", onchange: () => this.setWindow(Number(choice.value)) },
      ...kWindows.map((s) => h("option", { value: s, selected: s === this.window }, s < 60 ? `${s} s` : `${s / 60} min`)));
    tools.append(choice, this.pauseButton,
      h("button", { type: "button", onclick: () => this.unzoom() }, "Whole"),
      h("button", { type: "button", onclick: () => this.export() }, "CSV"));
    this.watch.observe(root);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.make());
  }

  private size(): { width: number; height: number } {
    const legend = this.root.querySelector<HTMLElement>(".u-legend")?.offsetHeight ?? 24;
    return { width: Math.max(200, this.root.clientWidth), height: Math.max(160, this.root.clientHeight - legend) };
  }

  private resized(): void {
    if (this.plot && this.isNarrow !== this.root.clientWidth < kNarrow) return this.make();
    this.plot?.setSize(this.size());
  }

  private pause(): void {
    this.paused = !this.paused;
    setText(this.pauseButton, this.paused ? "Go on" : "Pause");
    this.pauseButton.setAttribute("aria-pressed", String(this.paused));
  }

  private setWindow(seconds: number): void {
    this.window = seconds;
    this.unzoom();
  }

  private unzoom(): void {
    this.zoomed = false;
    this.draw(true);
  }

  show(axis: Axis): void {
    this.axis = axis;
    this.make();
  }

  /** Colours follow the page's scheme. */
  make(): void {
    const axis = this.axis;
    if (!axis) return;
    this.plot?.destroy();
    const style = getComputedStyle(document.documentElement);
    const colour = (name: string): string => style.getPropertyValue(name).trim();
    const unit = axis.position(0).unit;
    const em = parseFloat(style.fontSize);
    const font = `${Math.round(0.73 * em)}px system-ui`;
    const line = (label: string, scale: string, name: string): uPlot.Series => ({ label, scale, stroke: colour(name), width: 1.5, points: { show: false } });
    // In the colour of its line; on a phone without words, which stand below.
    const isNarrow = (this.isNarrow = this.root.clientWidth < kNarrow);
    const side = (scale: string, label: string, name: string, right: boolean): uPlot.Axis => ({
      scale, ...(isNarrow ? {} : { label }), side: right ? 1 : 3, stroke: colour(name), grid: { show: scale === "position", stroke: colour("--line"), width: 1 }, ticks: { show: false },
      size: (isNarrow ? 2.6 : 3.5) * em, gap: isNarrow ? 2 : 5, labelSize: 1.1 * em, font, labelFont: font,
    });
    const range = (least: number) => (_: uPlot, low: number | null, high: number | null) => spanOf(low, high, least);
    const told = (unit: string, digits: number) => (_: uPlot, v: number | null | undefined): string => (v === null || v === undefined ? "" : `${v.toFixed(digits)} ${unit}`);
    this.plot = new uPlot({
      ...this.size(), cursor: { drag: { x: true, y: false } }, legend: { live: true },
      scales: { x: { time: false }, position: { range: range(kLeastTurns * axis.position(axis.info.counts_per_rev).value) }, speed: { range: range(kLeastSpeed) }, torque: { range: range(kLeastCurrent) } },
      axes: [{ stroke: colour("--quiet"), grid: { stroke: colour("--line"), width: 1 }, ticks: { show: false }, font,
        values: (_, ticks) => ticks.map((t) => `${Number(t.toFixed(2))} s`) }, side("position", `position, ${unit}`, "--trend-1", false), side("speed", "velocity, rpm", "--trend-2", true),
        side("torque", "current, % of peak", "--trend-3", true)],
      series: [{ label: "time", value: (_, v) => (v === null ? "" : `${v.toFixed(2)} s`) }, 
        { ...line(`position (${unit})`, "position", "--trend-1"), value: told(unit, 3) }, { ...line("velocity (rpm)", "speed", "--trend-2"), value: told("rpm", 1) },
        { ...line("current (% of peak)", "torque", "--trend-3"), value: told("%", 1) }],
      hooks: { setSelect: [(u) => { if (u.select.width > 0) this.zoomed = true; }] },
    }, [[], [], [], []], this.root);
    this.watch.observe(this.root.querySelector(".u-legend")!); // its lines wrap
    this.draw(true);
  }

  add(axis: Axis, seconds: number): void {
    let series = this.data.get(axis.info.name);
    if (!series) this.data.set(axis.info.name, (series = empty()));
    const last = series.time[series.time.length - 1];
    if (last !== undefined && seconds <= last) {
      if (last - seconds < 1) return;
      this.data.set(axis.info.name, (series = empty())); // the gateway has started anew
    }
    if (last !== undefined && seconds - last > kPause) this.put(series, (last + seconds) / 2, axis.step, null, null, null);
    // The motor's values are read one after the other: a value counts only if it was read since the previous
    // sample.
    const value = (name: string): number | null | undefined => {
      const found = axis.m.get(name);
      if (!found?.good || (axis.r.LINK ?? 0) < kAnswers) return null;
      if (found.at === series.taken.get(name)) return undefined;
      series.taken.set(name, found.at);
      return found.raw;
    };
    const [p, v, t] = [value("P_IST"), value("V_IST"), value("VF_OUT")];
    const turn = (raw: number | null | undefined, into: (raw: number) => number): number | null | undefined => (typeof raw === "number" ? into(raw) : raw);
    this.put(series, seconds, axis.step, turn(p, (raw) => axis.position(raw).value), turn(v, (raw) => axis.speed(raw)), turn(t, (raw) => (raw / kFullCurrent) * 100));
  }

  private put(series: Series, time: number, step: number, position: Samples[0], speed: Samples[0], torque: Samples[0]): void {
    series.time.push(time);
    series.step.push(step);
    series.position.push(position);
    series.speed.push(speed);
    series.torque.push(torque);
    if (series.time.length > kKept) for (const list of [series.time, series.position, series.speed, series.torque, series.step]) list.shift();
  }

  draw(force = false): void {
    this.tell();
    if (!this.plot || !this.axis || (!force && (this.paused || document.hidden || performance.now() - this.drawn < 90))) return;
    this.drawn = performance.now();
    const series = this.data.get(this.axis.info.name) ?? empty();
    this.plot.setData([series.time, series.position, series.speed, series.torque], false);
    const last = series.time[series.time.length - 1] ?? 0;
    if (!this.zoomed) this.plot.setScale("x", { min: Math.max(series.time[0] ?? 0, last - this.window), max: last || 1 });
  }

  /** Where it is, also while the trend is paused. */
  private tell(): void {
    const axis = this.axis;
    const [p, v, t] = [axis?.m.get("P_IST"), axis?.m.get("V_IST"), axis?.m.get("VF_OUT")];
    if (!axis || !p) return setText(this.table, "no values of the motor");
    const { value, unit } = axis.position(p.raw);
    const age = performance.now() - Math.min(p.at, v?.at ?? p.at, t?.at ?? p.at);
    setText(this.table, `${value.toFixed(3)} ${unit}, ${v ? axis.speed(v.raw).toFixed(1) : "?"} rpm, ${t ? ((t.raw / kFullCurrent) * 100).toFixed(1) : "?"} %${age > kOld ? `, ${duration(age)} old` : ""}`);
    setClass(this.table, "stale", age > kOld);
  }

  private export(): void {
    const axis = this.axis;
    const series = axis && this.data.get(axis.info.name);
    if (!axis || !series) return;
    const unit = axis.position(0).unit;
    const lines = [`uptime_s,step,position_${unit},velocity_rpm,current_percent`];
    series.time.forEach((time, i) => lines.push([time.toFixed(3), axis.stepName(series.step[i]), series.position[i] ?? "", series.speed[i] ?? "", series.torque[i] ?? ""].join(",")));
    saveFile(`${axis.info.name}-trend.csv`, `${lines.join("\n")}\n`, "text/csv");
  }
}
