// The extension in a real VS Code server, seen in Chromium. vscode_test.py names the folders.
//   PLAYWRIGHT, URL, PICTURES: folders and the page; PICTURES may be empty
import assert from "node:assert";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const { chromium } = await import(pathToFileURL(join(process.env.PLAYWRIGHT, "index.mjs")));
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox", "--disable-gpu"] });
const page = await (await browser.newContext({ viewport: { width: 1600, height: 900 } })).newPage();
page.setDefaultTimeout(Number(process.env.LONGEST ?? 120_000));

const text = (words) => page.locator(`text=${words}`).first();
async function picture(name) {
  if (process.env.PICTURES) await page.screenshot({ path: join(process.env.PICTURES, name) });
}
async function command(title) {
  await page.keyboard.press("F1");
  await page.locator(".quick-input-widget input").first().fill(`>${title}`);
  await page.locator(".quick-input-list .monaco-list-row", { hasText: title }).first().click();
}
async function go(line) {
  await page.keyboard.press("Control+g");
  await page.locator(".quick-input-widget input").first().fill(`:${line}`);
  await page.keyboard.press("Enter");
}

await page.goto(process.env.URL);
await page.locator(".explorer-folders-view .monaco-list-row", { hasText: "pick_and_place.seq" }).dblclick();

// The server: lenses, raw values in the text, the verdict on a property and what it says of a broken one.
await text("Upload to gateway").waitFor();
await page.locator(".view-line", { hasText: "= 49152" }).first().waitFor();
console.log("lenses and raw values are shown");
await page.locator(".explorer-folders-view .monaco-list-row", { hasText: "pick_and_place.prop" }).dblclick();
await text("Rehearse how it breaks: Wrong").waitFor();
await page.locator(".squiggly-error").first().waitFor();
console.log("a broken property is shown, with its lens");
await picture("property.png");

// A mistake while typing, and its quick fix.
await page.keyboard.press("Control+End");
await page.keyboard.type("PROPERTY Typed: NEVER Girp;");
await text("Rehearse how it breaks: Wrong").waitFor({ state: "hidden" }); // nothing is proved of what cannot be read
await page.locator(".squiggly-error").first().waitFor();
await page.keyboard.press("Escape");
await page.keyboard.press("F8");
await page.keyboard.press("Control+.");
await page.locator(".action-widget .monaco-list-row", { hasText: "Write 'Grip'" }).first().waitFor();
await page.keyboard.press("Enter");
await page.locator(".view-line", { hasText: "Typed: NEVER Grip;" }).waitFor();
console.log("a misspelt name is mended");
await page.keyboard.press("Control+s");

// The graph beside the text.
await page.locator(".tab", { hasText: "pick_and_place.seq" }).click();
await command("NanoPLC: Show the Graph");
const graph = page.frameLocator("iframe.webview").frameLocator("iframe");
await graph.locator("g.node").first().waitFor();
await page.locator(".tab", { hasText: "pick_and_place.seq" }).click();
await go(Number(process.env.TRAVEL));
await graph.locator("g.node.here", { hasText: "Travel" }).waitFor();
console.log("the graph follows the cursor");

// A gateway: what the conditions of its active step are.
await command("NanoPLC: Attach to the Gateway");
await page.locator(".statusbar-item", { hasText: "Idle running" }).waitFor();
await go(Number(process.env.IDLE));
const values = page.locator(".view-line", { hasText: "IF Start AND NOT Guard" });
await page.waitForFunction(() => [...document.styleSheets].some((sheet) => [...sheet.cssRules].some((rule) => /Start 0, Guard 0/.test(rule.cssText))));
assert.ok(await values.isVisible());
console.log("a gateway's conditions are shown");
await command("View: Toggle Primary Side Bar Visibility");
await command("View: Toggle Panel Visibility");
await page.waitForTimeout(1000); // the workbench slides
await picture("vscode.png");
await command("Debug: Disconnect");
await page.locator(".statusbar-item", { hasText: "Idle running" }).waitFor({ state: "hidden" });

// Scenarios as tests.
await command("Test: Run All Tests");
await text("expectations: 10 passed, 0 failed").waitFor();
console.log("the scenario passes in the testing view");
await browser.close();
