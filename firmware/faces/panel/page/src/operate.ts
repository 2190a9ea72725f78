// From watching to operating and back: token, seat, commands. Stop, safe and hold need neither.
import { byId, h, setAttribute, setClass, setText } from "./dom";
import type { Axis } from "./state";
import type { Answer, Wire } from "./wire";
import { hex } from "./words";

const kTokenKey = "nanoplc-token";
const kStopPatience = 1000; // ms, as PROTOCOL.md asks for
// Of an answer: firmware/gateway/REGISTERS.md.
const kNoTable = 6;
const kMoving = 7;
const kNotRunning = 17;
const kTooLate = 19;
const kSeatTaken = 22;
const kNotConfirmed = 43;
const kStillWait = 5000; // ms for the motor to come to rest, as nanoctl has it
const kStillPause = 100; // ms
const kStoredDiffers = 13; // bit of STATUS
const kMostNotices = 4; // that pass by themselves

export class Operation {
  operates = false;
  mayOperate = false;
  needsPassword = false;
  private axis: Axis | null = null;
  private stoppable: string[] = []; // names of all axes, known without a login
  private readonly dialog = byId<HTMLDialogElement>("token-dialog");
  private readonly input = byId<HTMLInputElement>("token");
  private readonly problem = byId("token-problem");
  private readonly toggle = byId<HTMLButtonElement>("mode");
  private readonly notices = byId("notices");
  private readonly doubts = new Map<string, { line: HTMLElement; isHold: boolean; since: number }>(); // stops not known to be done, by axis

  constructor(private readonly wire: Wire, private readonly changed: () => void) {
    const fragment = new URLSearchParams(location.hash.slice(1)).get("token");
    if (fragment) {
      sessionStorage.setItem(kTokenKey, fragment);
      history.replaceState(null, "", location.pathname + location.search);
    }
    this.toggle.addEventListener("click", () => void (this.operates ? this.leave() : this.enter()));
    byId("token-form").addEventListener("submit", (e) => {
      e.preventDefault();
      void this.login(this.input.value.trim());
    });
    byId("token-cancel").addEventListener("click", () => this.dialog.close());
    // In the dialogs too, which cover the page.
    for (const button of document.querySelectorAll<HTMLElement>("[data-stop]")) button.addEventListener("click", () => void this.stop(button.dataset.stop!));
    for (const name of ["run", "step", "scan"]) byId(`do-${name}`).addEventListener("click", () => void this.command(name));
    byId("do-give-up").addEventListener("click", () => this.giveUpStop());
    byId("do-activate").addEventListener("click", () => this.offerStored());
    byId("do-reset-error").addEventListener("click", () => void this.resetError());
    setInterval(() => this.alive(), 1000);
  }

  /** After every hello: the connection is new, and so are rights and seat. */
  async greeted(rights: { read: boolean; operate: boolean }, stoppable: string[]): Promise<void> {
    this.stoppable = stoppable;
    this.mayOperate = rights.operate;
    this.needsPassword = !rights.read;
    this.setOperates(false);
    const token = sessionStorage.getItem(kTokenKey);
    if (token && (!rights.operate || !rights.read)) await this.tryLogin(token);
    else if (this.needsPassword) this.askToken("This panel asks for its password, or for the token to operate.");
  }

  show(axis: Axis): void {
    if (this.axis && this.axis !== axis && this.operates) void this.leave();
    this.axis = axis;
  }

  private askToken(text: string): void {
    setText(byId("token-text"), text);
    setText(this.problem, "");
    if (!this.dialog.open) this.dialog.showModal();
    this.input.focus();
  }

  private async tryLogin(secret: string): Promise<Answer> {
    const answer = await this.wire.ask({ do: "login", secret });
    if (answer.result === "done") {
      this.mayOperate = (answer.rights as { operate: boolean }).operate;
      this.needsPassword = false;
      sessionStorage.setItem(kTokenKey, secret);
    } else if (answer.result === "wrong_secret") sessionStorage.removeItem(kTokenKey);
    return answer;
  }

  private async login(secret: string): Promise<void> {
    const answer = await this.tryLogin(secret);
    if (answer.result !== "done") return setText(this.problem, answer.text);
    this.dialog.close();
    this.input.value = "";
    if (this.mayOperate && this.axis) await this.enter();
  }

  async enter(): Promise<void> {
    if (!this.axis) return this.needsPassword ? this.askToken("This panel asks for its password, or for the token to operate.") : undefined;
    if (!this.mayOperate) return this.askToken("Commands move the machine. Give the token that the program printed when it started.");
    await this.takeSeat(false);
  }

  private async takeSeat(takesOver: boolean): Promise<void> {
    const axis = this.axis;
    if (!axis) return;
    const answer = await this.wire.ask({ do: "seat", axis: axis.info.name, take_over: takesOver });
    if (answer.result !== "done") {
      const isTaken = !takesOver && answer.code === kSeatTaken && axis.seat.holder !== "";
      this.notice(`Not operating: ${answer.text}${axis.seat.holder ? ` (${axis.seat.holder} operates)` : ""}`, false, isTaken
        ? { label: "Take over", act: () => { if (this.axis === axis) void this.takeSeat(true); } } : undefined);
      return;
    }
    this.setOperates(true);
    this.notice("You operate this axis now. Commands move the machine.");
  }

  async leave(): Promise<void> {
    this.setOperates(false);
    if (this.axis) await this.wire.ask({ do: "leave", axis: this.axis.info.name });
  }

  /** The seat went to somebody else, or its time ran out. */
  lostSeat(): void {
    if (!this.operates) return;
    this.setOperates(false);
    const holder = this.axis?.seat.mine ? "" : this.axis?.seat.holder; // mine: its end is not known here yet
    this.notice(`${holder ? `${holder} has taken over` : "The operator's seat is no longer yours"}; you are watching.`, true);
  }

  setOperates(on: boolean): void {
    this.operates = on;
    setClass(document.body, "operating", on);
    setAttribute(this.toggle, "aria-pressed", String(on));
    setText(this.toggle, on ? "Stop operating" : "Operate…");
    setText(byId("mode-text"), on ? "OPERATING" : "Watching");
    this.changed();
  }

  /** Keeps the seat, and the forces that were set here, as long as the page is there. */
  private alive(): void {
    if (!this.operates || !this.axis || this.wire.state !== "open") return;
    const axis = this.axis.info.name;
    void this.wire.ask({ do: "seat", axis }).then((answer) => {
      if (answer.result === "refused" && answer.code !== kTooLate) this.lostSeat(); // too late: asked again in a second
    });
    if (this.axis.forcedInputs || this.axis.forcedOutputs) void this.wire.ask({ do: "write", axis, register: "FORCE_LEFT", value: 1 });
  }

  /** A `lasting` one goes with its reason, or when it is dismissed. */
  notice(text: string, alarm = false, offer?: { label: string; act: () => void }, lasting = false): HTMLElement {
    const button = offer ? [h("button", { type: "button", onclick: () => { line.remove(); offer.act(); } }, offer.label)] : [];
    const line: HTMLElement = h("div", { class: `notice${alarm ? " alarm" : ""}${lasting ? " lasting" : ""}`, role: alarm ? "alert" : "status" }, text, ...button,
      h("button", { type: "button", class: "plain", "aria-label": "dismiss", onclick: () => line.remove() }, "×"));
    this.notices.append(line);
    const passing = this.notices.querySelectorAll(".notice:not(.lasting)");
    for (const old of [...passing].slice(0, Math.max(0, passing.length - kMostNotices))) old.remove();
    if (!lasting) setTimeout(() => line.remove(), alarm || offer ? 20_000 : 6_000);
    return line;
  }

  /** Of the axis that is shown; the caller says what was refused. */
  wireAsk(request: Record<string, unknown>): Promise<Answer> {
    return this.wire.ask({ axis: this.axis?.info.name, ...request });
  }

  async ask(request: Record<string, unknown>, what: string): Promise<Answer> {
    const answer = await this.wireAsk(request);
    if (answer.result !== "done") this.notice(`${what}: ${answer.text}`, true);
    return answer;
  }

  /** Of the axis that is shown; before a login shows one, of all. What comes of it is told where no dialog covers it. */
  async stop(name: string): Promise<void> {
    for (const dialog of document.querySelectorAll("dialog")) dialog.close();
    await Promise.all((this.axis ? [this.axis.info.name] : this.stoppable).map((axis) => this.stopAxis(name, axis)));
  }

  private async stopAxis(name: string, axis: string): Promise<boolean> {
    const of = this.axis && this.stoppable.length < 2 ? "" : `${axis}: `;
    const late = setTimeout(() => this.doubt(axis, name, `${of}No answer to ${name} yet: the machine may still be running.`), kStopPatience);
    const answer = await this.wireAsk({ do: "command", name, axis });
    clearTimeout(late);
    if (answer.result === "done") {
      this.endDoubt(axis);
      this.notice(of + (name === "hold" ? "The sequence is held." : "Stopped; the outputs have their safe values."));
    } else if (answer.code === kNotRunning || answer.code === kNoTable) this.notice(`${of}${name}: ${answer.text}`, true);
    else this.doubt(axis, name, `${of}${name}: ${answer.text}.${answer.code === kNotConfirmed ? "" : " Not confirmed: the machine may still be running."}`);
    return answer.result === "done";
  }

  /** Stays until the axis is seen to stand still, or somebody dismisses it. */
  private doubt(axis: string, name: string, text: string): void {
    this.endDoubt(axis);
    this.doubts.set(axis, { line: this.notice(text, true, undefined, true), isHold: name === "hold", since: performance.now() });
  }

  private endDoubt(axis: string): void {
    this.doubts.get(axis)?.line.remove();
    this.doubts.delete(axis);
  }

  /** Of any axis, shown or not. */
  resolveDoubt(axis: Axis): void {
    const doubt = this.doubts.get(axis.info.name);
    if (!doubt || this.wire.state !== "open" || axis.imageAt <= doubt.since || axis.stopUnconfirmed) return;
    if (axis.isStopped || (doubt.isHold && axis.isHeld)) this.endDoubt(axis.info.name);
  }

  async command(name: string): Promise<void> {
    await this.ask({ do: "command", name }, name);
  }

  /** The motor is not told to stop any more: only a person who looks at it can say that this is right. */
  private giveUpStop(): void {
    if (!this.operates) return void this.notice("Giving a stop up needs operating: press Operate… first.");
    this.notice("Once given up, the motor is not told to stop any more. Make sure that it stands, or is without power.", true, {
      label: "Give the stop up", act: () => void this.command("give_up_stop") });
  }

  private offerStored(): void {
    const axis = this.axis!;
    const crc = axis.r.STORED_CRC ?? 0;
    this.notice(`The stored table (CRC-32 as uploaded ${hex(crc)}) becomes the active one. That stops the sequence.`, false, {
      label: "Stop and use it", act: () => void this.useStored(axis, crc) });
  }

  private async useStored(axis: Axis, crc: number): Promise<void> {
    const isAnother = (): boolean => (axis.r.STORED_CRC ?? 0) !== crc;
    const another = "Another table was stored meanwhile; nothing was made active.";
    if (isAnother()) return void this.notice(another, true);
    if (!(await this.stopAxis("stop", axis.info.name))) return;
    const end = performance.now() + kStillWait;
    for (;;) {
      if (isAnother()) return void this.notice(another, true);
      const answer = await this.wireAsk({ do: "command", name: "activate", axis: axis.info.name });
      if (answer.result === "done") return void this.notice("The stored table is active. Run it when the machine is clear.");
      if (answer.code !== kMoving || performance.now() >= end) return void this.notice(`use stored table: ${answer.text}`, true);
      await new Promise((resolve) => setTimeout(resolve, kStillPause));
    }
  }

  /** In the motor; the sequence's own way is command 01h. */
  private async resetError(): Promise<void> {
    const answer = await this.ask({ do: "command", name: "reset_error" }, "reset error");
    if (answer.result === "done") this.notice("The motor's errors were cleared; one whose cause is still there comes back.");
  }

  /** In all of these steps, or in none of them. */
  async setBreak(steps: number[], on: boolean): Promise<void> {
    const axis = this.axis!;
    for (const [register, first] of [["BREAK_LOW", 0], ["BREAK_HIGH", 32]] as const) {
      const bits = steps.filter((step) => step >= first && step < first + 32).reduce((mask, step) => mask | (1 << (step - first)), 0);
      const now = axis.r[register] ?? 0;
      const value = (on ? now | bits : now & ~bits) >>> 0;
      if (value === now) continue;
      const answer = await this.ask({ do: "write", axis: axis.info.name, register, value }, "breakpoint");
      if (answer.result !== "done") return;
    }
  }

  async force(isInput: boolean, bit: number, level: 0 | 1 | null): Promise<void> {
    const axis = this.axis!;
    const now = (isInput ? axis.r.FORCE_IN : axis.r.FORCE_OUT) ?? 0;
    const cleared = now & ~((1 << bit) | (1 << (bit + 8)));
    const value = level === null ? cleared : cleared | (1 << (bit + 8)) | (level << bit);
    await this.ask({ do: "write", register: isInput ? "FORCE_IN" : "FORCE_OUT", value }, "force");
  }

  /** Which buttons are of use now. */
  update(axis: Axis): void {
    const enable = (id: string, on: boolean): void => setAttribute(byId(id), "aria-disabled", String(!on));
    const may = this.operates;
    enable("do-run", may && axis.hasTable && !axis.stopUnconfirmed && (axis.isStopped || axis.isHeld));
    enable("do-step", may && axis.hasTable && !axis.stopUnconfirmed && !axis.isRunning);
    enable("do-scan", may && axis.hasTable && !axis.stopUnconfirmed && !axis.isRunning);
    enable("do-reset-error", may);
    enable("do-give-up", may);
    enable("do-activate", may);
    byId("do-activate").hidden = !axis.status(kStoredDiffers);
    setText(byId("do-run"), axis.isHeld ? "Go on" : "Run");
    setText(byId("seat"), this.wire.state !== "open" ? "Who operates is not known" : axis.seat.mine ? "You operate" : axis.seat.holder ? `${axis.seat.holder} operates` : "Nobody operates");
  }
}
