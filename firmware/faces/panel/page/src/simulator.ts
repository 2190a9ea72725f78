// What one can do to a simulated machine: inputs, the shaft, the line, time, and a record of it all.
import { byId, saveFile, setAttribute, setText } from "./dom";
import type { Operation } from "./operate";
import type { Axis } from "./state";
import { clock } from "./words";

export class Simulator {
  get isPaused(): boolean { return this.paused; }
  private paused = false;
  private blocked = false;
  private cut = false;

  constructor(private readonly operation: Operation, private readonly axis: () => Axis | null) {
    byId("sim-block").addEventListener("click", () => void this.block());
    byId("sim-cut").addEventListener("click", () => void this.cutLine());
    byId("sim-pause").addEventListener("click", () => void this.operation.ask({ do: "sim", pause: !this.paused }, "pause"));
    byId<HTMLSelectElement>("sim-speed").addEventListener("change", (e) =>
      void this.operation.ask({ do: "sim", speed: Number((e.target as HTMLSelectElement).value) }, "speed"));
    byId("sim-save").addEventListener("click", () => void this.save());
    byId("sim-clear").addEventListener("click", () => void this.operation.ask({ do: "sim", record: "clear" }, "record"));
    byId<HTMLFormElement>("sim-form").addEventListener("submit", (e) => {
      e.preventDefault();
      void this.act(byId<HTMLInputElement>("sim-action").value);
    });
  }

  async act(action: string): Promise<boolean> {
    return (await this.operation.ask({ do: "sim", action }, action)).result === "done";
  }

  press(bit: number): void {
    const axis = this.axis();
    if (axis) void this.act(`toggle ${axis.inputName(bit)}`);
  }

  private async block(): Promise<void> {
    await this.act(this.blocked ? "motor stop none" : "motor blocked");
  }

  private async cutLine(): Promise<void> {
    await this.act(this.cut ? "line restored" : "line cut");
  }

  private async save(): Promise<void> {
    const answer = await this.operation.ask({ do: "sim", record: "get" }, "record");
    if (answer.result === "done") saveFile("clicked.scn", answer.text, "text/plain");
  }

  private show(): void {
    setAttribute(byId("sim-block"), "aria-pressed", String(this.blocked));
    setText(byId("sim-block"), this.blocked ? "Free the shaft" : "Block the shaft");
    setAttribute(byId("sim-cut"), "aria-pressed", String(this.cut));
    setText(byId("sim-cut"), this.cut ? "Restore the line" : "Cut the line");
  }

  take(m: Record<string, unknown>): void {
    this.paused = m.paused as boolean;
    this.blocked = m.blocked as boolean;
    this.cut = m.cut as boolean;
    this.show();
    setText(byId("sim-time"), clock(m.ms as number));
    setText(byId("sim-pause"), this.paused ? "Go on" : "Pause time");
    setAttribute(byId("sim-pause"), "aria-pressed", String(this.paused));
    setText(byId("sim-recorded"), `${m.recorded as number} recorded`);
    const speed = byId<HTMLSelectElement>("sim-speed");
    if (document.activeElement !== speed) speed.value = String(m.speed);
  }
}
