// Upload of another table: compared with the active one, and confirmed by the user before anything is sent.
import { Boxes } from "./boxes";
import { termInWords } from "./describe";
import { byId, h, saveFile, setClass, setText } from "./dom";
import type { Operation } from "./operate";
import { Axis, symbolsOf, type Symbols } from "./state";
import { conditionsOf, crc32, decodeTable, readHex, stepsOf, tableLength, type Term } from "./table";
import type { Wire } from "./wire";
import { hex } from "./words";

interface Chosen {
  name: string;
  bytes: Uint8Array;
  symbols: Symbols | null;
}

interface Difference {
  kind: "+" | "−";
  text: string;
}

const kMostSize = 48 * 1024;
const kTermBytes = 8;
const kSmall = /^MAC(50|95|140|141)$/; // their registers are the same, so the gateway cannot distinguish them

function readNames(name: string, text: string): Symbols {
  try {
    const names = JSON.parse(text) as { format?: unknown } | null;
    if (names?.format === "nanoplc-symbols") return names as Symbols;
  } catch {
    // reported below, as any other invalid file
  }
  throw new Error(`${name} holds no names of a program: take the F.sym that seqc build wrote beside the table`);
}

async function readFiles(files: FileList): Promise<Chosen> {
  let table: { name: string; bytes: Uint8Array } | null = null;
  let symbols: Symbols | null = null;
  for (const file of files) {
    if (file.size > 4 * kMostSize) throw new Error(`${file.name} is too long for a table or its names`);
    const isNames = /\.sym$/i.test(file.name);
    if (isNames ? symbols : table) throw new Error(`${[...files].map((one) => one.name).join(", ")}: choose one table and its names, not more`);
    if (isNames) symbols = readNames(file.name, await file.text());
    else if (/\.(hex|ihex)$/i.test(file.name)) table = { name: file.name, bytes: readHex(await file.text()) };
    else table = { name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) };
  }
  if (!table) throw new Error("choose the table, F.bin or F.hex; F.sym beside it brings the names");
  const length = tableLength(table.bytes);
  if (length === 0) throw new Error(`${table.name} is no table: it has no end term. Compile the program first: seqc build F.seq -o F.bin`);
  if (length <= kTermBytes) throw new Error(`${table.name} is an empty table: nothing stands before its end term`);
  if (length !== table.bytes.length)
    throw new Error(`${table.name} has ${table.bytes.length - length} bytes behind what looks like its end term: it is no table, or has a certificate, which nanoctl upload takes along`);
  const crc = (symbols as { table?: { crc32?: string } } | null)?.table?.crc32;
  if (crc && parseInt(crc, 16) !== crc32(table.bytes)) throw new Error("the names are those of another table (their CRC-32 differs)");
  return { ...table, symbols };
}

/** Terms that only one of the two tables has, in the words of each. */
function compare(now: Axis, next: Axis): Difference[] {
  const key = (axis: Axis, term: Term): string => termInWords(axis, term, conditionsOf(term));
  const list = (axis: Axis): string[] => (axis.program?.terms ?? []).map((term) => key(axis, term));
  const before = list(now);
  const after = list(next);
  const count = new Map<string, number>();
  for (const text of before) count.set(text, (count.get(text) ?? 0) + 1);
  const added = after.filter((text) => {
    const left = count.get(text) ?? 0;
    count.set(text, left - 1);
    return left <= 0;
  });
  const gone = before.filter((text) => {
    const left = count.get(text) ?? 0;
    if (left <= 0) return false;
    count.set(text, left - 1);
    return true;
  });
  return [...gone.map((text): Difference => ({ kind: "−", text })), ...added.map((text): Difference => ({ kind: "+", text }))];
}

const base64 = (bytes: Uint8Array): string => btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""));

export class Upload {
  private chosen: Chosen | null = null;
  private axis: Axis | null = null;
  private readonly dialog = byId<HTMLDialogElement>("upload-dialog");
  private readonly text = byId("upload-text");
  private readonly list = byId("upload-diff");
  private readonly progress = byId<HTMLProgressElement>("upload-progress");
  private readonly files = byId<HTMLInputElement>("upload-files");

  constructor(private readonly wire: Wire, private readonly operation: Operation) {
    byId("do-upload").addEventListener("click", () => this.open());
    byId("do-download").addEventListener("click", () => this.download());
    this.files.addEventListener("change", () => void this.choose());
    byId("upload-cancel").addEventListener("click", () => this.dialog.close());
    byId("upload-store").addEventListener("click", () => void this.send(false));
    byId("upload-activate").addEventListener("click", () => void this.send(true));
  }

  /** Of a table that comes while the user is asked, the differences are from that one. */
  show(axis: Axis): void {
    this.axis = axis;
    if (this.dialog.open && this.chosen) this.tell(this.chosen);
  }

  private open(): void {
    if (!this.operation.operates) return void this.operation.notice("Switch to operating first.");
    this.chosen = null;
    this.files.value = "";
    this.list.replaceChildren();
    setText(this.text, "Choose a table (F.bin or F.hex) and, if there is one, its names (F.sym).");
    this.enable(false);
    this.progress.hidden = true;
    this.dialog.showModal();
  }

  private enable(on: boolean): void {
    for (const id of ["upload-store", "upload-activate"]) byId<HTMLButtonElement>(id).disabled = !on;
  }

  private async choose(): Promise<void> {
    this.enable(false);
    this.list.replaceChildren();
    setClass(this.text, "warning", false);
    try {
      this.chosen = await readFiles(this.files.files!);
    } catch (error) {
      this.chosen = null;
      return setText(this.text, (error as Error).message);
    }
    this.tell(this.chosen);
    this.enable(true);
  }

  /** What it changes in the active table. */
  private tell(chosen: Chosen): void {
    const now = this.axis!;
    const next = new Axis(now.info);
    const terms = decodeTable(chosen.bytes);
    const steps = stepsOf(terms);
    const symbols = symbolsOf(chosen.symbols);
    next.program = {
      file: chosen.name, crc: crc32(chosen.bytes), bytes: chosen.bytes, proof: "", since: -1,
      symbols, hasSymbols: chosen.symbols !== null, registers: now.program?.registers ?? {}, terms, steps, boxes: new Boxes(steps.keys(), symbols.steps),
    };
    const differences = now.program?.crc === next.program.crc ? [] : compare(now, next);
    const { program, motor } = next.program.symbols;
    const name = program ?? chosen.name;
    const isForAnother = motor !== undefined && !now.info.motor.startsWith(motor) && !(kSmall.test(motor) && kSmall.test(now.info.motor));
    const warning = isForAnother ? `It was compiled for a ${motor}, and this axis has a ${now.info.motor}: its moves may be others. ` : "";
    setClass(this.text, "warning", isForAnother);
    setText(this.text, warning + (differences.length
      ? `${name}, ${terms.length} terms, CRC-32 ${hex(next.program.crc)}, differs from what is active (${now.programName()}, ${hex(now.program?.crc ?? 0)}) in ${differences.length} terms. Making it active stops the sequence.`
      : `${name} is the table that is active already (CRC-32 ${hex(next.program.crc)}).`));
    this.list.replaceChildren(...differences.map((d) => h("li", { class: d.kind === "+" ? "added" : "gone" }, `${d.kind} ${d.text}`)));
  }

  private async send(activate: boolean): Promise<void> {
    if (!this.chosen || !this.axis) return;
    this.enable(false);
    this.progress.hidden = false;
    this.progress.value = 0;
    const answer = await this.wire.ask(
      { do: "upload", axis: this.axis.info.name, table: base64(this.chosen.bytes), activate, ...(this.chosen.symbols ? { symbols: this.chosen.symbols } : {}) },
      (m) => {
        this.progress.max = m.of as number;
        this.progress.value = m.bytes as number;
      });
    this.progress.hidden = true;
    if (answer.result !== "done") {
      this.enable(true);
      return setText(this.text, `Not done. ${answer.text}`);
    }
    this.dialog.close();
    this.operation.notice(activate ? "The table is stored and active. Run it when the machine is clear." : "The table is stored. It becomes active when the gateway starts again, or by “Use stored table…”.");
  }

  private download(): void {
    const program = this.axis?.program;
    if (!this.axis || !program?.bytes.length) return;
    const name = program.symbols.program ?? this.axis.info.name;
    saveFile(`${name}.bin`, program.bytes as BlobPart, "application/octet-stream");
    if (program.hasSymbols) saveFile(`${name}.sym`, `${JSON.stringify(program.symbols, null, 1)}\n`, "application/json");
  }
}
