// The page as `nanoplc` serves it: two axes, virtual motors on their lines, secrets in files.
import assert from "node:assert/strict";
import { existsSync, readFileSync, symlinkSync } from "node:fs";
import { join } from "node:path";
import { after, test } from "node:test";
import { Client, closeBrowser, file, halt, hasText, inStep, openPage, operate, painted, textOf, withService } from "./machine.mjs";

after(closeBrowser);

/** A busy machine can lose the link to a virtual motor, which is a fault of the sequence: it is then run anew. */
async function runs(page) {
  for (let i = 0; i < 20; ++i) {
    await hasText(page, "#fact-link", "up").catch(() => {});
    if ((await textOf(page, "#state-text")) === "running") return;
    await page.click("#do-stop");
    await hasText(page, "#state-text", "stopped");
    await page.click("#do-run");
    await hasText(page, "#state-text", "running").catch(() => {});
  }
}

test("two axes, each with its program; a token of the start in the journal", () =>
  withService("", async ({ url, folder, said }) => {
    const token = /token: (\S+)/.exec(said())[1];
    const page = await openPage(url);
    await painted(page);
    assert.equal(await textOf(page, "#program"), "PickAndPlace");
    await page.selectOption("#axis", "y");
    await hasText(page, "#program", "FillAndCount");
    const other = await textOf(page, "#state-text");
    await page.selectOption("#axis", "x");
    await operate(page, token);
    await runs(page);
    await page.selectOption('select[aria-label="force Start"]', "1");
    await inStep(page, 2);
    await page.click("#do-stop");
    await hasText(page, "#state-text", "stopped: stop command");
    await page.selectOption("#axis", "y");
    await hasText(page, "#state-text", other); // what is done to one axis leaves the other
    assert.deepEqual(page.complaints, []);
    // An upload's names are kept, and found again by the next start.
    const client = new Client(url);
    await client.opened;
    await client.ask({ do: "login", secret: token });
    const table = join(folder, "y.bin");
    const answer = await client.ask({ do: "upload", axis: "x", table: readFileSync(table).toString("base64"), symbols: JSON.parse(readFileSync(join(folder, "y.sym"), "utf8")), activate: true });
    assert.equal(answer.result, "done", answer.text);
    assert.ok(existsSync(join(folder, "state", "x", "names.sym")));
    await page.selectOption("#axis", "x");
    await hasText(page, "#program", "FillAndCount");
    assert.equal((await client.ask({ do: "upload", axis: "x", table: readFileSync(join(folder, "x.bin")).toString("base64"), symbols: { table: { crc32: "00000000" } } })).text, "the names are those of another table");
    // What came without names is not called by the configuration's file.
    const crc = JSON.parse(readFileSync(join(folder, "y.sym"), "utf8")).table.crc32;
    assert.equal((await client.ask({ do: "upload", axis: "y", table: readFileSync(join(folder, "x.bin")).toString("base64"), activate: true })).result, "done");
    const newer = JSON.parse(readFileSync(join(folder, "x.sym"), "utf8")).table.crc32;
    const program = await client.until((m) => m.t === "program" && m.axis === "y" && m.crc === parseInt(newer, 16));
    assert.equal(program.file, "");
    assert.ok(client.messages.some((m) => m.t === "program" && m.axis === "y" && m.crc === parseInt(crc, 16) && m.file === "y.bin"));
    client.close();
    await page.context().close();
  }));

test("a stop that was not confirmed goes from the page once its axis is at rest, also while it shows another", async () => {
  const motors = [];
  const tap = (to, from, children) => void (symlinkSync(from, to), motors.push(children.at(-1)));
  await withService("", async ({ url }) => {
    const page = await openPage(url);
    await painted(page);
    await page.selectOption("#axis", "y");
    await hasText(page, "#program", "FillAndCount");
    await halt(motors[1]);
    await hasText(page, "#fact-link", "down");
    await page.click("#do-stop");
    await hasText(page, "#notices", "y: stop: not confirmed");
    await page.selectOption("#axis", "x");
    await hasText(page, "#program", "PickAndPlace");
    motors[1].kill("SIGCONT");
    await page.waitForFunction(() => !document.getElementById("notices").textContent.includes("y: stop"));
    assert.deepEqual(page.complaints, []);
    await page.context().close();
  }, { tap });
});

test("with a password nothing is shown without it, and a stop is still heard", async () => {
  const token = file("token", "operate-this-machine\n");
  const password = file("password", "watch-this-machine\n");
  await withService(`token_file = "${token}"\npassword_file = "${password}"\nhosts = ["cell4.example"]`, async ({ url, said }) => {
    assert.doesNotMatch(said(), /operate-this-machine|watch-this-machine/);
    const client = new Client(url);
    await client.opened;
    const hello = await client.until((m) => m.t === "hello");
    assert.deepEqual(hello.axes, []);
    assert.equal((await client.ask({ do: "motor_read", axis: "x", register: "P_IST" })).result, "not_logged_in");
    assert.equal((await client.ask({ do: "command", axis: "x", name: "stop" })).result, "done");
    assert.ok(!client.messages.some((m) => ["image", "program", "events"].includes(m.t)), "nothing was shown");
    assert.deepEqual((await client.ask({ do: "login", secret: "watch-this-machine" })).rights, { read: true, operate: false });
    await client.until((m) => m.t === "image" && m.full && m.axis === "x" && m.r.SAFE_REASON === 2);
    assert.equal((await client.ask({ do: "command", axis: "x", name: "run" })).result, "no_right");
    client.close();
    const page = await openPage(url);
    await page.waitForSelector("#token-dialog[open]");
    // The dialog covers the page, and leaves the stops within reach: of all axes, for none is shown.
    await page.click("#token-dialog [data-stop=safe]");
    for (const axis of ["x", "y"]) await hasText(page, "#notices", `${axis}: Stopped`);
    await page.click("#mode");
    await page.waitForSelector("#token-dialog[open]");
    await page.fill("#token", "operate-this-machine");
    await page.click("#token-form button[type=submit]");
    await hasText(page, "#state-text", "stopped: safe command");
    await page.context().close();
  });
});
