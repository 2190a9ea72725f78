// The state of each axis, as received.
import { Boxes, type NamedStep } from "./boxes";
import { decodeTable, keyOf, stepsOf, type Step, type Term } from "./table";
import type { Cause } from "./why";
import { kReasons, kRunStates, hex } from "./words";

export interface Symbols {
  program?: string;
  source?: string;
  motor?: string;
  scale?: { revolutions: number; length: number; unit: string };
  steps?: (NamedStep & { line: number; outputs: number })[];
  inputs?: string[];
  inverted_inputs?: number[]; // their names are true while the wire is off
  outputs?: string[];
  registers?: { name: string; register: string; number: number }[];
}

/** Of a file or the wire only what has its form: a name that is none is shown as the number. */
export function symbolsOf(given: unknown): Symbols {
  const object = (value: unknown): Record<string, unknown> | null =>
    (typeof value === "object" && value !== null && !Array.isArray(value) ? (value as Record<string, unknown>) : null);
  const list = (value: unknown): unknown[] => (Array.isArray(value) ? value : []);
  const from = object(given);
  if (!from) return {};
  const text = (name: string): string | undefined => (typeof from[name] === "string" ? from[name] : undefined);
  const texts = (name: string): string[] => list(from[name]).map((one) => (typeof one === "string" ? one : ""));
  const scale = object(from.scale);
  const isScale = typeof scale?.unit === "string" && Number(scale.revolutions) > 0 && Number(scale.length) > 0;
  const named = (name: string): Record<string, unknown>[] =>
    list(from[name]).map(object).filter((one) => typeof one?.number === "number" && typeof one.name === "string") as Record<string, unknown>[];
  return {
    ...(from as Symbols), program: text("program"), source: text("source"), motor: text("motor"), inputs: texts("inputs"), outputs: texts("outputs"),
    inverted_inputs: list(from.inverted_inputs).filter((one): one is number => typeof one === "number"),
    scale: isScale ? { unit: scale!.unit as string, revolutions: Number(scale!.revolutions), length: Number(scale!.length) } : undefined,
    steps: named("steps").map((one) => ({ ...one, outputs: Number(one.outputs) || 0, made_for: typeof one.made_for === "string" ? one.made_for : undefined,
      copy_of: typeof one.copy_of === "number" ? one.copy_of : undefined })) as Symbols["steps"],
    registers: named("registers").filter((one) => typeof one.register === "string") as Symbols["registers"],
  };
}

export interface RegisterInfo {
  name: string;
  signed: boolean;
  long: boolean;
  unit: string; // "" without one
  per_unit: number;
}

export interface Program {
  file: string;
  crc: number;
  bytes: Uint8Array;
  proof: string;
  since: number; // UPTIME at which it became active; -1: not known
  symbols: Symbols;
  hasSymbols: boolean;
  registers: Record<string, RegisterInfo>;
  terms: Term[];
  steps: Map<number, Step>;
  boxes: Boxes;
}

export interface LogEvent {
  n: number;
  ms: number;
  code: number;
  step: number;
  detail: number;
  text: string;
}

export interface Value {
  raw: number;
  good: boolean;
  at: number; // performance.now() at which it was read
}

export interface AxisInfo {
  name: string;
  motor: string;
  counts_per_rev: number;
  samples_per_second: number;
  unit?: string; // in which other faces show positions
  per_revolution?: number;
  error_bits: { bit: number; name: string; text: string }[]; // of ERR_STAT
  modes: Record<string, string>; // of MODE_REG
}

export interface SetPoint {
  name: string;
  unit: string; // "" without one
  value: number; // the wanted value, which is stored
  in_force: number;
  lowest: number;
  highest: number;
  step: number; // 0: every value of the range
  initial: number;
}

export interface Recipe {
  number: number;
  name: string;
  values: Record<string, number>; // those that fit the program
}

export interface SetPointsNews {
  crc: number;
  values: SetPoint[];
  waits: boolean;
  damaged: boolean;
  recipe: number; // loaded last; 0: none
  differs: boolean; // from it
  takes: number[]; // steps that take changes
  room: number;
  recipes: Recipe[];
}

export interface Seat {
  holder: string; // "" if free
  mine: boolean;
}

export class Axis {
  r: Record<string, number> = {};
  m = new Map<string, Value>();
  program: Program | null = null;
  events: LogEvent[] = [];
  setPoints: SetPointsNews = { crc: 0, values: [], waits: false, damaged: false, recipe: 0, differs: false, takes: [], room: 0, recipes: [] };
  why: Cause[] | null = null; // null: not known yet
  seat: Seat = { holder: "", mine: false };
  path: { step: number; at: number }[] = []; // newest last; of copies in a row the last one
  imageAt = 0; // performance.now() at which the image was true
  visits = 0;

  constructor(readonly info: AxisInfo) {}

  get runState(): number { return (this.r.STATUS ?? 0) & 7; }
  get isRunning(): boolean { return this.runState === 2; }
  get isHeld(): boolean { return this.runState >= 3; }
  get isStopped(): boolean { return this.runState === 0; }
  status(bit: number): boolean { return ((this.r.STATUS ?? 0) >>> bit & 1) === 1; }
  get inputs(): number { return (this.r.INPUTS ?? 0) & 0x3f; }
  get terminals(): number { return ((this.r.INPUTS ?? 0) >> 8) & 0x3f; }
  get inPosition(): boolean { return this.status(5); }
  get error(): boolean { return this.status(4); }
  get outputs(): number { return (this.r.OUTPUTS ?? 0) & 0xf; }
  get written(): number { return ((this.r.OUTPUTS ?? 0) >> 8) & 0xf; }
  get step(): number { return this.r.STEP ?? 0; }
  get key(): number {
    const image = this.inputs | (this.inPosition ? 0x40 : 0) | (this.error ? 0x80 : 0);
    return keyOf(image, this.r.TIMER ?? 0, this.r.COUNTER ?? 0);
  }
  /** The motor was told to stop and has not confirmed it. */
  get stopUnconfirmed(): boolean { return this.status(19); }
  get hasTable(): boolean { return this.status(11); }
  get forcedInputs(): number { return ((this.r.FORCE_IN ?? 0) >> 8) & 0x3f; }
  get forcedInputLevels(): number { return (this.r.FORCE_IN ?? 0) & 0x3f; }
  get forcedOutputLevels(): number { return (this.r.FORCE_OUT ?? 0) & 0xf; }
  get forcedOutputs(): number { return ((this.r.FORCE_OUT ?? 0) >> 8) & 0xf; }
  /** In any step of the box: while it is drawn as one, they are set together. */
  breaksAt(box: number): boolean {
    const isSet = (step: number): boolean => ((((step < 32 ? this.r.BREAK_LOW : this.r.BREAK_HIGH) ?? 0) >>> (step & 31)) & 1) === 1;
    return this.stepsOf(box).some(isSet);
  }

  /** A step and its copies are one box: its number is that of the step as it was written. */
  boxOf(step: number): number { return this.program?.boxes.of(step) ?? step; }
  stepsOf(box: number): number[] { return this.program?.boxes.stepsOf(box) ?? [box]; }
  get box(): number { return this.boxOf(this.step); }
  /** Boxes that were active, newest last. */
  get boxPath(): number[] {
    return this.path.map((one) => this.boxOf(one.step)).filter((box, i, all) => i === 0 || box !== all[i - 1]);
  }

  takeProgram(m: Record<string, unknown>): void {
    const bytes = Uint8Array.from(atob(m.table as string), (c) => c.charCodeAt(0));
    const terms = decodeTable(bytes);
    const steps = stepsOf(terms);
    const symbols = symbolsOf(m.symbols);
    if (this.program && this.program.crc !== m.crc) this.path = []; // its steps are others
    this.program = {
      file: (m.file as string) ?? "", crc: m.crc as number, bytes, proof: (m.proof as string) ?? "",
      since: (m.since as number) ?? -1, symbols, hasSymbols: m.symbols !== null,
      registers: (m.registers as Record<string, RegisterInfo>) ?? {}, terms, steps, boxes: new Boxes(steps.keys(), symbols.steps),
    };
  }

  takeImage(m: Record<string, unknown>, now: number): void {
    const registers = m.r as Record<string, number> | undefined;
    if (registers?.UPTIME !== undefined && registers.UPTIME < (this.r.UPTIME ?? 0)) this.path = []; // it began anew
    if (m.full) this.r = {};
    Object.assign(this.r, registers);
    this.imageAt = now - (m.age as number);
    for (const [name, value] of Object.entries((m.m as Record<string, [number, number, boolean]>) ?? {}))
      this.m.set(name, { raw: value[0], at: now - value[1], good: value[2] });
    for (const step of (m.path as number[] | undefined) ?? []) this.visit(step, now);
    if (!this.path.length || this.path[this.path.length - 1].step !== this.step) this.visit(this.step, now);
  }

  private visit(step: number, at: number): void {
    const last = this.path[this.path.length - 1];
    if (last && last.step !== step && this.boxOf(last.step) === this.boxOf(step)) this.path.pop(); // a lamp that blinks for an hour is no path
    this.path.push({ step, at });
    ++this.visits;
    if (this.path.length > 40) this.path.shift();
  }

  takeEvents(list: LogEvent[], fresh: boolean): void {
    this.events = [...(fresh ? [] : this.events), ...list].slice(-200);
  }

  // Names of the program.
  stepName(step: number): string {
    return this.program?.symbols.steps?.find((s) => s.number === step)?.name ?? `Step ${step}`;
  }
  /** As it was written: of a copy the name of its original. */
  boxName(step: number): string { return this.stepName(this.boxOf(step)); }
  boxNames(steps: number[]): string { return [...new Set(steps.map((step) => this.boxName(step)))].join(", "); }
  madeFor(step: number): string {
    return this.program?.symbols.steps?.find((s) => s.number === step)?.made_for ?? "";
  }
  inputName(bit: number): string { return this.program?.symbols.inputs?.[bit] || `IN${bit}`; }
  /** What is true while the wire has this level: `Start`, `NOT Start`, and of an inverted input the other way round. */
  inputText(bit: number, level: boolean): string {
    const isInverted = this.program?.symbols.inverted_inputs?.includes(bit) ?? false;
    return level === isInverted ? `NOT ${this.inputName(bit)}` : this.inputName(bit);
  }
  outputName(bit: number): string { return this.program?.symbols.outputs?.[bit] || `OUT${bit}`; }
  outputNames(bits: number): string[] {
    return [0, 1, 2, 3].filter((bit) => bits & (1 << bit)).map((bit) => this.outputName(bit));
  }
  /** A motor register by the program's own name, `P2 (Place)`. */
  registerName(number: number): string {
    const plain = this.program?.registers[number]?.name ?? `REG(${number})`;
    const own = this.program?.symbols.registers?.find((r) => r.number === number)?.name;
    return own && own !== plain ? `${own} (${plain})` : plain;
  }
  programName(): string {
    if (!this.program || !this.hasTable) return "no table";
    return this.program.symbols.program ?? (this.program.file || `table ${hex(this.program.crc)}`);
  }

  /** What Modbus, MQTT and metrics show positions in, where it is not the program's SCALE: `1 rev a revolution`. */
  otherScale(): string {
    const { unit, per_revolution: other } = this.info;
    if (!this.program?.hasSymbols || unit === undefined || other === undefined) return "";
    const scale = this.program.symbols.scale ?? { unit: "rev", length: 1, revolutions: 1 };
    const own = scale.length / scale.revolutions;
    return unit === scale.unit && Math.abs(own - other) <= 1e-9 * own ? "" : `${Number(other.toPrecision(9))} ${unit} a revolution`;
  }

  stateInWords(): string {
    if (this.stopUnconfirmed) return "stop not confirmed: the motor may be moving";
    const reason = kReasons[this.r.SAFE_REASON]?.short ?? "safe";
    if (this.status(6) && this.isHeld) return `held, outputs safe: ${reason}`;
    if (this.status(6)) return `${this.isRunning ? "outputs safe" : "stopped"}: ${reason}`;
    if (this.status(10)) return "held at a breakpoint";
    return kRunStates[this.runState] ?? "unknown";
  }

  /** Of a motor's value, in the machine's unit where the program names one. */
  position(counts: number): { value: number; unit: string } {
    const scale = this.program?.symbols.scale;
    const turns = counts / (this.info.counts_per_rev || 4096);
    return scale ? { value: (turns * scale.length) / scale.revolutions, unit: scale.unit } : { value: turns, unit: "rev" };
  }
  /** V_IST is in counts/sample. */
  speed(raw: number): number {
    return ((raw * this.info.samples_per_second) / (this.info.counts_per_rev || 4096)) * 60;
  }
}
