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
