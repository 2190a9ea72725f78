// What the program is built with is what its sources make of it, and small enough.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { cpSync, mkdtempSync, readdirSync, readFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { gzipSync } from "node:zlib";
import { root } from "./machine.mjs";

const source = join(root, "firmware", "faces", "panel");
const folder = process.env.PAGE; // with the packages of the lock file

/** A part of the page by itself. */
async function part(name) {
  const made = join(mkdtempSync(join(tmpdir(), "part-")), `${name}.mjs`);
  execFileSync(join(folder, "node_modules", ".bin", "esbuild"), [join(source, "page", "src", `${name}.ts`), "--bundle", "--format=esm", `--outfile=${made}`, "--log-level=warning"]);
  return import(made);
}

test("the trend does not draw a tremble as high as a move", async () => {
  const { spanOf } = await part("span");
  const [low, high] = spanOf(41.9987, 41.999, 0.25); // a count at rest
  assert.ok(high - low >= 0.25 && low < 41.9987 && high > 41.999);
  assert.deepEqual(spanOf(0, 60, 0.25), [-3, 63]);
  assert.deepEqual(spanOf(null, null, 20), [-10, 10]);
});

const term = (step, next, error = false) => ({ step, next, input: error ? 0x80 : 0, index: 0 });
/** Wait (1) blinks and sees an edge; Work (2) and Fault (3) do not. */
const kBlinker = [
  { number: 0, name: "POWER_UP" }, { number: 1, name: "Wait" }, { number: 2, name: "Work" }, { number: 3, name: "Fault" },
  { number: 4, name: "Wait_Lamp_dark", made_for: "copy of 'Wait' for: Lamp dark", copy_of: 1 },
  { number: 5, name: "Wait_Go_off", made_for: "copy of 'Wait' for: Go was off", copy_of: 1 },
];

test("a step and the copies that the compiler made of it are one box", async () => {
  const { Boxes, numbersInWords, waysBetween, waysOut } = await part("boxes");
  const { stepsOf } = await part("table");
  const boxes = new Boxes([0, 1, 2, 3, 4, 5], kBlinker);
  assert.deepEqual([...boxes.steps], [[0, [0]], [1, [1, 4, 5]], [2, [2]], [3, [3]]]);
  assert.deepEqual([0, 1, 2, 3, 4, 5].map((step) => boxes.of(step)), [0, 1, 2, 3, 1, 1]);
  const steps = stepsOf([term(0, 1), term(1, 4), term(1, 5), term(1, 3, true), term(2, 1), term(2, 4), term(2, 2), term(3, 1), term(4, 1), term(4, 3, true), term(5, 2), term(5, 3)]);
  const ways = waysBetween(steps.values(), boxes).map((way) => `${way.from}>${way.to}${way.isError ? " error" : ""}`);
  assert.deepEqual(ways.sort(), ["0>1", "1>2", "1>3", "2>1", "2>2", "3>1"]); // 5>3 needs no ERROR
  const out = (step) => waysOut(steps.get(step), boxes).map((way) => [way.to, way.terms.length]);
  assert.deepEqual(out(1), [[4, 1], [5, 1], [3, 1]]); // within the box each apart
  assert.deepEqual(out(2), [[1, 2], [2, 1]]); // to all copies as one
  assert.equal(numbersInWords([9, 1, 4, 5, 7, 6]), "1, 4–7, 9");
  assert.equal(numbersInWords([1, 2]), "1, 2");
});

test("only a step that is there is the original of a copy", async () => {
  const { Boxes } = await part("boxes");
  const of = (numbers, named) => Object.fromEntries(new Boxes(numbers, named).steps);
  assert.deepEqual(of([1, 4], []), { 1: [1], 4: [4] });
  assert.deepEqual(of([4], kBlinker), { 4: [4] });
  // A step of a later CALL is one of its own, and its copies are its own.
  const call = [
    { number: 1, name: "A" }, { number: 2, name: "B", made_for: "SEQUENCE Stamp", copy_of: 1 },
    { number: 3, name: "A_dark", made_for: "copy of 'A' for: Lamp dark", copy_of: 1 }, { number: 4, name: "B_dark", made_for: "copy of 'B' for: Lamp dark", copy_of: 2 },
  ];
  assert.deepEqual(of([1, 2, 3, 4], call), { 1: [1, 3], 2: [2, 4] });
  // Names from elsewhere may be anything.
  const round = [{ number: 1, name: "A", made_for: "copy of 'B' for: x" }, { number: 2, name: "B", made_for: "copy of 'A' for: x" }, { number: 0, name: "C", made_for: "copy of 'A' for: x" }];
  assert.deepEqual(of([0, 1, 2], round), { 0: [0], 1: [1], 2: [2] });
  assert.deepEqual(of([0, 1], [{ number: 1, name: "A", made_for: "copy of 'Z' for: x", copy_of: 1 }]), { 0: [0], 1: [1] });
});

test("the last path and the breakpoints are those of boxes", async () => {
  const { Axis } = await part("state");
  const axis = new Axis({ name: "x", motor: "MAC140", counts_per_rev: 4096, samples_per_second: 520.83, error_bits: [], modes: {} });
  const byte = (step, next) => [0xc0 | step, 0, 0, next, 0x80, 0, 0, 0];
  const table = Uint8Array.from([...byte(0, 1), ...byte(1, 4), ...byte(4, 5), ...byte(5, 2), ...byte(2, 1), ...byte(3, 1), 0x3f, 0, 0, 0, 0, 0, 0, 0]);
  axis.takeProgram({ table: btoa(String.fromCharCode(...table)), crc: 1, symbols: { steps: kBlinker } });
  const image = (step, path = []) => axis.takeImage({ full: false, age: 0, r: { STEP: step, UPTIME: 0 }, path }, 0);
  image(0);
  image(1);
  for (let i = 0; i < 100; ++i) image([1, 4][i % 2]); // a lamp that blinks
  image(5);
  assert.equal(axis.box, 1);
  assert.equal(axis.boxName(5), "Wait");
  image(2, [2]);
  image(4);
  assert.deepEqual(axis.boxPath, [0, 1, 2, 1]);
  assert.equal(axis.breaksAt(1), false);
  axis.r.BREAK_LOW = 1 << 5;
  assert.equal(axis.breaksAt(1), true);
  assert.equal(axis.breaksAt(2), false);
  assert.equal(axis.boxNames([1, 4, 2]), "Wait, Work");
});

test("a sequence that is held while its outputs are safe is not called stopped", async () => {
  const { Axis } = await part("state");
  const axis = new Axis({ name: "x", motor: "MAC140", counts_per_rev: 4096, samples_per_second: 520.83, error_bits: [], modes: {} });
  const words = (run, safe) => {
    axis.r = { STATUS: run | (safe ? 1 << 6 : 0), SAFE_REASON: 3 };
    return axis.stateInWords();
  };
  assert.equal(words(4, true), "held, outputs safe: link down");
  assert.equal(words(4, false), "held");
  assert.equal(words(0, true), "stopped: link down");
  assert.equal(words(2, true), "outputs safe: link down");
});

test("POWER_UP stands above all, also where only a fault leads back to it", async () => {
  const { layOut } = await part("layout");
  // Fault (9) is entered by ERROR alone, whose ways are not laid out.
  const { boxes } = layOut([9, 10, 0, 1], [[9, 10], [10, 0], [0, 1], [1, 0]]);
  assert.equal(boxes.get(0).y, Math.min(...[...boxes.values()].map((box) => box.y)));
});

test("the bundle that is checked in is made from its sources", () => {
  for (const name of ["src", "build.mjs", "tsconfig.json"]) cpSync(join(source, "page", name), join(folder, name), { recursive: true });
  execFileSync(join(folder, "node_modules", ".bin", "tsc"), ["--noEmit"], { cwd: folder, stdio: "inherit" });
  const made = mkdtempSync(join(tmpdir(), "bundle-"));
  execFileSync("node", ["build.mjs", "--to", made], { cwd: folder, stdio: "inherit" });
  const names = readdirSync(made).sort();
  assert.deepEqual(readdirSync(join(source, "bundle")).filter((n) => n !== "README.md").sort(), names);
  for (const name of names)
    assert.ok(readFileSync(join(made, name)).equals(readFileSync(join(source, "bundle", name))), `${name} is not what its sources make; run npm ci && npm run build in firmware/faces/panel/page`);
});

test("the remedies that the gateway tells name the page's own buttons instead of nanoctl", async () => {
  const texts = [];
  const causes = join(root, "firmware", "causes");
  for (const name of readdirSync(causes).filter((n) => n.endsWith(".cpp"))) {
    const joined = readFileSync(join(causes, name), "utf8").replaceAll(/"\s*\n\s*"/g, "");
    texts.push(...[...joined.matchAll(/"((?:[^"\\\n]|\\.)*`(?:nanoctl|macreg set ERR_STAT)(?:[^"\\\n]|\\.)*)"/g)].map((m) => m[1]));
  }
  assert.ok(texts.length > 15, `${texts.length} texts`);
  const { inPanel } = await part("remedies");
  const page = ["index.html", "operate.ts"].map((name) => readFileSync(join(source, "page", "src", name), "utf8")).join();
  for (const text of [...texts, "clear it: `macreg set ERR_STAT 0x4000`, and choose the mode again"]) {
    const told = inPanel(text, false, true);
    assert.doesNotMatch(told, /`nanoctl (?!settings)|`macreg set ERR_STAT/, text);
    assert.doesNotMatch(told, /Operate/);
    for (const [, name] of told.matchAll(/“([^”]+)”/g)) assert.ok(page.includes(`>${name}<`) || page.includes(`"${name}"`), `there is no ${name} on the page`);
  }
  assert.equal(inPanel("`nanoctl run` starts it.", false, true), "“Run” starts it.");
  assert.equal(inPanel("`nanoctl run` lets it go on, `nanoctl step` goes a step.", true, true), "“Go on” lets it go on, “Step” goes a step.");
  assert.equal(inPanel("`nanoctl run` starts it.", false, false), "“Run” starts it. Press “Operate…” for that.");
});

test("page with script is under 150 kB compressed, and names no other server", () => {
  const files = readdirSync(join(source, "bundle")).map((name) => readFileSync(join(source, "bundle", name)));
  const size = files.reduce((sum, data) => sum + gzipSync(data).length, 0);
  console.log(`${size} bytes compressed`);
  assert.ok(size < 150_000);
  for (const data of files) assert.doesNotMatch(data.toString().replaceAll("http://www.w3.org/2000/svg", "").replaceAll(/https:\/\/github\.com\/leeoniya\/uPlot[^\s]*/g, ""), /(src|href|import|url)\W{1,3}(https?:)?\/\/\w/);
});
