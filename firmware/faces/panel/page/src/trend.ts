// Position, velocity and current of the last minutes: pause, zoom, CSV.
import uPlot from "uplot";
import { h, saveFile, setText } from "./dom";
import type { Axis } from "./state";

const kKept = 6000; // samples: ten minutes at ten a second
const kWindows = [10, 60, 300];

interface Series {
  time: number[]; // seconds of the gateway's uptime
  position: (number | null)[];
  speed: (number | null)[];
  torque: (number | null)[];
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
  private readonly pauseButton: HTMLButtonElement;

  constructor(private readonly root: HTMLElement, tools: HTMLElement, private readonly table: HTMLElement) {
    this.pauseButton = h("button", { type: "button", onclick: () => this.pause() }, "Pause");
    const choice = h("select", { "aria-label": "time shown", onchange: () => this.setWindow(Number(choice.value)) },
      ...kWindows.map((s) => h("option", { value: s, selected: s === this.window }, s < 60 ? `${s} s` : `${s / 60} min`)));
    tools.append(choice, this.pauseButton,
      h("button", { type: "button", onclick: () => this.unzoom() }, "Whole"),
      h("button", { type: "button", onclick: () => this.export() }, "CSV"));
    new ResizeObserver(() => this.plot?.setSize(this.size())).observe(root);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.make());
  }

  private size(): { width: number; height: number } {
    const legend = this.root.querySelector<HTMLElement>(".u-legend")?.offsetHeight ?? 24;
    return { width: Math.max(200, this.root.clientWidth), height: Math.max(160, this.root.clientHeight - legend) };
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
    const line = (label: string, scale: string, name: string): uPlot.Series => ({ label, scale, stroke: colour(name), width: 1.5, points: { show: false }, spanGaps: true });
    const side = (scale: string, label: string, right: boolean): uPlot.Axis => ({
      scale, label, side: right ? 1 : 3, stroke: colour("--quiet"), grid: { show: !right, stroke: colour("--line"), width: 1 }, ticks: { show: false },
      size: 52, labelSize: 16, font: "11px system-ui", labelFont: "11px system-ui",
    });
    this.plot = new uPlot({
      ...this.size(), cursor: { drag: { x: true, y: false } }, legend: { live: true },
      scales: { x: { time: false } },
      axes: [{ stroke: colour("--quiet"), grid: { stroke: colour("--line"), width: 1 }, ticks: { show: false }, font: "11px system-ui",
        values: (_, ticks) => ticks.map((t) => `${Number(t.toFixed(2))} s`) }, side("position", `position, ${unit}`, false), side("speed", "velocity, rpm", true)],
      series: [{ label: "time", value: (_, v) => (v === null ? "" : `${v.toFixed(2)} s`) }, line(`position (${unit})`, "position", "--trend-1"), line("velocity (rpm)", "speed", "--trend-2"),
        { ...line("current (% of peak)", "torque", "--trend-3") }],
      hooks: { setSelect: [(u) => { if (u.select.width > 0) this.zoomed = true; }] },
    }, [[], [], [], []], this.root);
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
    // The motor is asked for one value after the other: only what has come since the sample before is one.
    const value = (name: string): number | null => {
      const found = axis.m.get(name);
      if (!found || !found.good || found.at === series.taken.get(name)) return null;
      series.taken.set(name, found.at);
      return found.raw;
    };
    const [p, v, t] = [value("P_IST"), value("V_IST"), value("VF_OUT")];
    series.time.push(seconds);
    series.position.push(p === null ? null : axis.position(p).value);
    series.speed.push(v === null ? null : axis.speed(v));
    series.torque.push(t === null ? null : (t / 1023) * 100);
    series.step.push(axis.step);
    if (series.time.length > kKept) for (const list of [series.time, series.position, series.speed, series.torque, series.step]) list.shift();
  }

  draw(force = false): void {
    if (!this.plot || !this.axis || (!force && (this.paused || document.hidden || performance.now() - this.drawn < 90))) return;
    this.drawn = performance.now();
    const series = this.data.get(this.axis.info.name) ?? empty();
    this.plot.setData([series.time, series.position, series.speed, series.torque], false);
    const last = series.time[series.time.length - 1] ?? 0;
    if (!this.zoomed) this.plot.setScale("x", { min: Math.max(series.time[0] ?? 0, last - this.window), max: last || 1 });
    const [p, v] = [this.axis.m.get("P_IST"), this.axis.m.get("V_IST")];
    const position = p?.good ? this.axis.position(p.raw) : null;
    setText(this.table, position === null ? "no values of the motor" : `${position.value.toFixed(3)} ${position.unit}, ${v?.good ? this.axis.speed(v.raw).toFixed(1) : "?"} rpm`);
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
