// axe-core, contrast in both schemes, a phone of 360 px, a 4k screen, and the pictures for README.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { after, test } from "node:test";
import { closeBrowser, inStep, openPage, operate, painted, root, simulator } from "./machine.mjs";

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
    machine.child.kill("SIGSTOP"); // old values are read too
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
