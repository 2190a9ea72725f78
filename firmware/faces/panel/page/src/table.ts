// The sequence table (001 §6.1): terms of 8 bytes, decoded as the folder sequencer does.

export const kNoSwitch = 0x3e;
export const kEnd = 0x3f;

export interface Term {
  index: number;
  step: number;
  timerZero: boolean;
  counterZero: boolean;
  input: number;
  care: number;
  isWrite: boolean;
  next: number | null;
  command: number | null;
  outputs: number;
  clearsCounter: boolean;
  countsDown: boolean;
  timerPreset: number;
  counterPreset: number;
  register: number;
  isLong: boolean;
  value: number;
  bytes: Uint8Array;
}

function decode(bytes: Uint8Array, index: number): Term {
  const b = bytes.subarray(index * 8, index * 8 + 8);
  const isWrite = (b[2] & 0x80) !== 0;
  const next = b[3] & 0x3f;
  const preset = b[6] | (b[7] << 8);
  const forCounter = (b[3] & 0x40) !== 0;
  const isLong = isWrite && (b[3] & 0x80) !== 0;
  const low = b[4] | (b[5] << 8);
  return {
    index,
    step: b[0] & 0x3f,
    timerZero: (b[0] & 0x80) === 0,
    counterZero: (b[0] & 0x40) === 0,
    input: b[1],
    care: b[2] & 0x7f,
    isWrite,
    next: isWrite || next === kNoSwitch ? null : next,
    command: isWrite || (b[4] & 0x80) !== 0 ? null : b[4] & 0x7f,
    outputs: isWrite ? 0 : b[5] & 0x0f,
    clearsCounter: !isWrite && (b[5] & 0x40) !== 0,
    countsDown: !isWrite && (b[5] & 0x80) !== 0,
    timerPreset: isWrite || forCounter ? 0 : preset,
    counterPreset: !isWrite && forCounter ? preset : 0,
    register: isWrite ? b[3] & 0x7f : 0,
    isLong,
    value: isWrite ? low + (isLong ? preset * 65536 : 0) : 0,
    bytes: b.slice(),
  };
}

/** All terms up to the end term; nothing of a table without one. */
export function decodeTable(bytes: Uint8Array): Term[] {
  const terms: Term[] = [];
  for (let index = 0; (index + 1) * 8 <= bytes.length; ++index) {
    const term = decode(bytes, index);
    if (term.step === kEnd) return terms;
    terms.push(term);
  }
  return [];
}

/** Where a table ends, its end term included; 0 if it has no end. */
export function tableLength(bytes: Uint8Array): number {
  for (let at = 0; at + 8 <= bytes.length; at += 8) if ((bytes[at] & 0x3f) === kEnd) return at + 8;
  return 0;
}

export interface Condition {
  kind: "input" | "inpos" | "error" | "timer" | "counter";
  bit: number;
  wanted: boolean;
}

/** ERROR is always compared (001 §6.1.5). */
export function conditionsOf(term: Term): Condition[] {
  const list: Condition[] = [];
  for (let bit = 0; bit < 6; ++bit)
    if (term.care & (1 << bit)) list.push({ kind: "input", bit, wanted: (term.input & (1 << bit)) !== 0 });
  if (term.care & 0x40) list.push({ kind: "inpos", bit: 6, wanted: (term.input & 0x40) !== 0 });
  if (term.timerZero) list.push({ kind: "timer", bit: 8, wanted: true });
  if (term.counterZero) list.push({ kind: "counter", bit: 9, wanted: true });
  list.push({ kind: "error", bit: 7, wanted: (term.input & 0x80) !== 0 });
  return list;
}

/** Bits 7..0 HW_INP, bit 8 timer = 0, bit 9 counter = 0. */
export function keyOf(image: number, timer: number, counter: number): number {
  return (image & 0xff) | (timer === 0 ? 0x100 : 0) | (counter === 0 ? 0x200 : 0);
}

export const isTrue = (condition: Condition, key: number): boolean => ((key >> condition.bit) & 1) === (condition.wanted ? 1 : 0);

/** A way out of a step: all terms that name the same next step. */
export interface Way {
  from: number;
  to: number;
  terms: Term[];
  isError: boolean; // all of its terms require ERROR
}

export interface Step {
  number: number;
  terms: Term[];
  ways: Way[];
  acts: Term[]; // terms that name no next step
}

export function stepsOf(terms: Term[]): Map<number, Step> {
  const steps = new Map<number, Step>();
  const step = (number: number): Step => {
    let found = steps.get(number);
    if (!found) steps.set(number, (found = { number, terms: [], ways: [], acts: [] }));
    return found;
  };
  step(0);
  for (const term of terms) {
    const from = step(term.step);
    from.terms.push(term);
    if (term.next === null) {
      from.acts.push(term);
      continue;
    }
    step(term.next);
    let way = from.ways.find((w) => w.to === term.next);
    if (!way) from.ways.push((way = { from: from.number, to: term.next, terms: [], isError: false }));
    way.terms.push(term);
  }
  for (const one of steps.values())
    for (const way of one.ways) way.isError = way.terms.every((t) => (t.input & 0x80) !== 0);
  return new Map([...steps.entries()].sort(([a], [b]) => a - b));
}

/** CRC-32 as of Ethernet and zip, as TABLE_CRC has it. */
export function crc32(bytes: Uint8Array): number {
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; ++bit) crc = crc & 1 ? (crc >>> 1) ^ 0xedb88320 : crc >>> 1;
  }
  return ~crc >>> 0;
}

/** Data of an Intel HEX file, from address 0 on; throws with what is wrong. */
export function readHex(text: string): Uint8Array {
  const bytes: number[] = [];
  for (const [number, line] of text.split(/\r?\n/).entries()) {
    if (line.trim() === "") continue;
    const match = /^:((?:[0-9A-Fa-f]{2})+)$/.exec(line.trim());
    const data = match ? match[1].match(/../g)!.map((pair) => parseInt(pair, 16)) : [];
    if (data.length < 5 || data.length !== data[0] + 5 || data.reduce((sum, byte) => sum + byte, 0) % 256 !== 0)
      throw new Error(`line ${number + 1} is no record of Intel HEX, or its check sum is wrong`);
    if (data[3] === 1) return Uint8Array.from(bytes, (byte) => byte ?? 0xff);
    if (data[3] === 0) for (let i = 0; i < data[0]; ++i) bytes[data[1] * 256 + data[2] + i] = data[4 + i];
  }
  throw new Error("the end record is missing");
}
