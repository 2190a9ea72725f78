// Numbers in words. Codes: firmware/gateway/REGISTERS.md; commands: 001 §5.2.1.4.

export const kRunStates = ["stopped", "waits for the motor", "running", "about to be held", "held"];
export const kLinks = ["down", "starting", "not acknowledged", "up"];

interface Reason {
  short: string;
  remedy: string;
}

export const kReasons: Record<number, Reason> = {
  0: { short: "none", remedy: "" },
  1: { short: "not started", remedy: "Nobody has started the sequence: run it." },
  2: { short: "stop command", remedy: "Somebody stopped it: run it when the machine is clear." },
  3: { short: "link down", remedy: "The motor does not answer. Look at its supply and its line; then the sequence must send “reset error”." },
  4: { short: "motor stuck", remedy: "A scan waited too long for the motor. Look at the motor, then run it again." },
  5: { short: "bad table", remedy: "There is no table that is whole and for this motor: upload one." },
  6: { short: "watchdog", remedy: "The last run did not end in order. Look at the machine, then run it." },
  7: { short: "enable lost", remedy: "The enable input is off: switch it on, then run." },
  8: { short: "safe command", remedy: "Somebody asked for the safe state: run it when the machine is clear." },
  9: { short: "bad settings", remedy: "The stored settings are damaged: look at them, set and keep them." },
  10: { short: "bad run mark", remedy: "Nobody knows how the last run ended. Look at the machine, then run it." },
  11: { short: "GPIO lines missing", remedy: "Inputs or outputs of the board cannot be had; the journal names them." },
  12: { short: "no store", remedy: "The folder for tables and settings cannot be had; the journal names it." },
  13: { short: "user's port missing", remedy: "The axis's own port cannot be had; the journal names it." },
  14: { short: "no certificate", remedy: "The setting require_proof asks for a certificate: upload the table with --proof." },
  15: { short: "bad set-points", remedy: "The stored set-points are damaged; older values or the defaults stand in. Look at them, change some or load a recipe, then run." },
};

const kCommands = [
  "NOP", "RESET_ERROR", "CLEAR_P_SOLL", "CLEAR_P_IST", "CLEAR_P_FNC", "STOP", "CLEAR_T_SOLL", "CLEAR_IN_POS",
  "MOVE_P7_BY_P_FNC", "MOVE_P8_BY_P_FNC", "RAPID_COMMUNICATION", "SAFE_COMMUNICATION", "USE_SET(1)", "USE_SET(2)",
  "USE_SET(3)", "USE_SET(4)", "HOME", "MOVE_P7_BY_P_SOLL", "MOVE_P8_BY_P_SOLL", "TRANSMIT_SLOWLY",
  "POSITIONS_ABSOLUTE", "POSITIONS_RELATIVE_P_SOLL", "POSITIONS_RELATIVE_P_FNC",
];

/** Bits 6..5 the mode, 3 is a command; 4..0 the register or the command's number (001 §5.2.1.4). */
export function commandInWords(byte: number): string {
  const mode = byte >> 5;
  const low = byte & 0x1f;
  if (mode === 3) return kCommands[low] ?? `NOP(${low.toString(16).toUpperCase()}h)`;
  return `${["INIT", "VELOCITY", "POSITION"][mode]}(${groupOf(low)})`;
}

/** P 00xxx, V 01xxx, A 100xx, T 101xx, L 110xx, Z 111xx. */
function groupOf(low: number): string {
  if (low < 16) return `${low < 8 ? "P" : "V"}${(low & 7) + 1}`;
  return `${"ATLZ"[(low >> 2) & 3]}${(low & 3) + 1}`;
}

export const hex = (value: number, digits = 8): string => (value >>> 0).toString(16).toUpperCase().padStart(digits, "0");

export function clock(milliseconds: number): string {
  const seconds = Math.floor(milliseconds / 1000);
  const two = (n: number) => String(n).padStart(2, "0");
  return `${two(Math.floor(seconds / 3600))}:${two(Math.floor(seconds / 60) % 60)}:${two(seconds % 60)}.${String(milliseconds % 1000).padStart(3, "0")}`;
}

/** When UPTIME was `then`, if it is `now`, by this machine's clock. */
export const wallTime = (now: number, then: number): Date => new Date(Date.now() - ((now - then) >>> 0));

/** `0.35 s`, `120 ms` */
export function duration(milliseconds: number): string {
  if (milliseconds < 1000) return `${Math.round(milliseconds)} ms`;
  return `${(milliseconds / 1000).toFixed(milliseconds < 10_000 ? 2 : 1)} s`;
}
