// axe-core, contrast in both schemes, a phone of 360 px, a 4k screen, and the pictures for README.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { after, test } from "node:test";
import { closeBrowser, examples, file, halt, inStep, openPage, operate, painted, root, simulator } from "./machine.mjs";

after(closeBrowser);

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const pictures = process.env.PICTURES; // a folder: pictures are written there

async function seriousFindings(page) {
  await painted(page);
  return findings(page);
}

async function findings(page) {
  const session = await page.context().newCDPSession(page); // the page's own policy lets no other script in
  await session.send("Runtime.evaluate", { expression: axe });
  const { result } = await session.send("Runtime.evaluate", { expression: "axe.run(document).then((r) => JSON.stringify(r.violations))", awaitPromise: true });
  return JSON.parse(result.value).filter((v) => ["serious", "critical"].includes(v.impact)).map((v) => `${v.id}: ${v.nodes.map((n) => n.html).join(" | ").slice(0, 400)}`);
}

const screens = [
  { name: "wide", viewport: { width: 1440, height: 1000 }, colorScheme: "light" },
  { name: "dark", viewport: { width: 1440, height: 1000 }, colorScheme: "dark" },
  { name: "phone", viewport: { width: 360, height: 780 }, colorScheme: "light", deviceScaleFactor: 2 },
  { name: "4k", viewport: { width: 3840, height: 2160 }, colorScheme: "light" },
];

for (const { name, ...options } of screens) {
  test(`${name}: axe-core finds nothing serious, nothing is wider than the screen`, async () => {
    const machine = await simulator("tools/sequence/examples/pick_and_place.seq", { cwd: root, scenario: "every 4 s pulse Start 50 ms\n" });
    const page = await openPage(machine.url, { ...options, reducedMotion: "reduce" });
    await painted(page);
    const width = () => page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
    assert.ok((await width()) <= 0, "watching");
    const bottom = async (selector) => page.$eval(selector, (e) => e.getBoundingClientRect().bottom);
    assert.ok((await bottom(".u-legend")) <= (await bottom(".trend-panel")), "the legend is in its panel");
    assert.deepEqual(await seriousFindings(page), []);
    await operate(page, machine.token);
    assert.ok((await width()) <= 0, "operating");
    const gauges = await page.$$eval(".fact", (all) => all.map((fact) => fact.children[2]?.getBoundingClientRect().height).filter(Boolean));
    assert.deepEqual(gauges, [4, 4, 4]); // as style.css has them: a frame would look like a full one
    await page.waitForFunction(() => document.querySelectorAll(".notice").length === 0);
    assert.deepEqual(await seriousFindings(page), []);
    await inStep(page, 2);
    await inStep(page, 3);
    if (pictures) { // with enough to see in the trend
      await page.waitForTimeout(12_000);
      await inStep(page, 2);
      await page.screenshot({ path: join(pictures, `panel_${name}.png`), fullPage: name !== "phone" });
    }
    await page.click("#do-upload");
    assert.deepEqual(await seriousFindings(page), []);
    await page.click("#upload-cancel");
    await page.click("#do-stop");
    await page.waitForFunction(() => document.getElementById("state-text").textContent.includes("stopped"));
    assert.deepEqual(await seriousFindings(page), []);
    await halt(machine.child); // old values are read too
    await page.waitForFunction(() => document.body.classList.contains("old"));
    await page.evaluate(() => scrollTo(0, document.body.scrollHeight));
    await page.waitForFunction(() => { // wherever one has scrolled to
      const bar = document.getElementById("link-bar").getBoundingClientRect();
      return bar.height > 0 && bar.top >= 0 && bar.bottom <= innerHeight;
    });
    assert.deepEqual(await findings(page), []);
    await page.context().close();
    await machine.stop();
  });
}

for (const { name, ...options } of screens) {
  test(`${name}: set-points and recipes, watching, operating and with their dialogs`, async () => {
    const machine = await simulator("tools/sequence/examples/cut_to_length.seq", { cwd: root });
    const page = await openPage(machine.url, { ...options, reducedMotion: "reduce" });
    await painted(page);
    await page.waitForSelector("#set-points tr");
    const width = () => page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
    assert.ok((await width()) <= 0, "watching");
    assert.deepEqual(await seriousFindings(page), []);
    await operate(page, machine.token);
    await page.click("#recipe-save");
    await page.fill("#recipe-name", "Standard");
    assert.deepEqual(await seriousFindings(page), []);
    await page.click("#recipe-do");
    await page.waitForFunction(() => document.querySelector("#recipe").value === "Standard");
    await page.fill('#set-points input[aria-label="Length in mm"]', "300");
    await page.click("#set-points-change");
    await page.waitForFunction(() => document.getElementById("set-points-problem").textContent !== "");
    assert.ok((await width()) <= 0, "operating");
    await page.waitForFunction(() => document.querySelectorAll(".notice").length === 0);
    assert.deepEqual(await seriousFindings(page), []);
    await page.click("#recipe-import");
    assert.deepEqual(await seriousFindings(page), []);
    await page.click("#import-cancel");
    if (pictures && name === "wide") {
      await page.fill('#set-points input[aria-label="Length in mm"]', "25.5");
      await page.locator(".set-points-panel").screenshot({ path: join(pictures, "panel_set_points.png") });
    }
    await page.context().close();
    await machine.stop();
  });
}

const kNames = ["Guard_closed", "Part_present", "Clamp_closed", "Acknowledged", "Pallet_at_it", "Start_button"];
const kChain = `PROGRAM Chain
MOTOR MAC140;
VAR_INPUT ${kNames.map((name, i) => `${name} AT IN${i} : BOOL;`).join(" ")} END_VAR
ON ERROR NEXT := S57;
POWER_UP NEXT := S0; END_POWER_UP
${Array.from({ length: 58 }, (_, i) => `STEP S${i}: ${i === 57 ? "OWN ERROR; " : ""}IF Guard_closed THEN NEXT := S${(i + 1) % 57}; END_IF END_STEP`).join("\n")}
END_PROGRAM
`;

test("names of twelve letters are not torn on a laptop's screen while one operates", async () => {
  const machine = await simulator(file("seq", kChain));
  const page = await openPage(machine.url, { viewport: { width: 1280, height: 800 } });
  await painted(page);
  await operate(page, machine.token);
  const lines = await page.$$eval(".signal-name", (all) => all.map((name) => [name.textContent, Math.round(name.getBoundingClientRect().height / parseFloat(getComputedStyle(name).lineHeight))]));
  assert.deepEqual(lines.slice(0, 6), kNames.map((name) => [name, 1]));
  const apart = await page.$$eval(".signals li:has(.press)", (all) => all.filter((row) => row.querySelector("select").getBoundingClientRect().top !== row.querySelector(".press").getBoundingClientRect().top).length);
  assert.equal(apart, 0, "what belongs to a signal stands side by side");
  await page.context().close();
  await machine.stop();
});

test("what stands in the boxes of the drawing is large enough to read", async () => {
  const sizes = [[1280, 800, 10], [360, 780, 10], [3840, 2160, 12]]; // 4k: the page's own text is larger too
  for (const program of [join(examples, "board_stacker.seq"), file("seq", kChain)]) {
    const machine = await simulator(program);
    for (const [width, height, least] of sizes) {
      const page = await openPage(machine.url, { viewport: { width, height } });
      await painted(page);
      const size = await page.$eval("#drawing", (drawing) => drawing.getScreenCTM().a * parseFloat(getComputedStyle(drawing.querySelector(".name")).fontSize));
      assert.ok(size >= least, `${width} px, ${program}: ${size}`);
      await page.context().close();
    }
    await machine.stop();
  }
});
