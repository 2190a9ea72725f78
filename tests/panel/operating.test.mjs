// Everything that the page can do to the machine; the token, the seat, and stops that need neither.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, test } from "node:test";
import { Client, closeBrowser, examples, file, hasText, inStep, operate, pagesOf, path, programs, textOf } from "./machine.mjs";

after(closeBrowser);

const pick = join(examples, "pick_and_place.seq");

const withPages = (count, use, options = {}, program = pick) => pagesOf(program, count, use, options);

const isReadable = async (page, selector) => {
  const [words, ground] = await page.locator(selector).evaluate((e) => [getComputedStyle(e).color, getComputedStyle(e).backgroundColor]);
  assert.notEqual(words, ground, `${selector} can be read`);
};
const state = (page, text) => hasText(page, "#state-text", text);
const lamp = (page, name, level) =>
  page.waitForFunction(([n, l]) => document.querySelector(`.lamp[aria-label="${n} is ${l}"]`) !== null, [name, level]);

test("stop, safe and hold need neither token nor seat", () =>
  withPages(2, async (machine, operator, watcher) => {
    await operate(operator, machine.token);
    await watcher.click("#do-hold");
    await state(operator, "held");
    await operator.click("#do-run");
    await state(watcher, "running");
    await watcher.click("#do-stop");
    await state(operator, "stopped: stop command");
    await operator.click("#do-run");
    await state(watcher, "running");
    await watcher.click("#do-safe");
    await state(operator, "stopped: safe command");
  }));

test("a dialog leaves the stops within reach", () =>
  withPages(1, async (machine, page) => {
    await page.click("#mode");
    await page.waitForSelector("#token-dialog[open]");
    await page.click("#token-dialog [data-stop=stop]");
    await hasText(page, "#state-text", "stopped: stop command");
    assert.equal(await page.locator("dialog[open]").count(), 0, "what comes of it is seen");
  }));

test("a wrong token lets nobody operate, five close the connection", () =>
  withPages(1, async (machine, page) => {
    await page.click("#mode");
    await page.fill("#token", "guess");
    await page.click("#token-form button[type=submit]");
    await hasText(page, "#token-problem", "neither the token nor the password");
    assert.equal(await page.evaluate(() => document.body.classList.contains("operating")), false);
    await page.click("#token-cancel");
    const client = new Client(machine.url);
    await client.opened;
    assert.equal((await client.ask({ do: "command", name: "run" })).result, "no_right");
    assert.equal((await client.ask({ do: "write", register: "FORCE_IN", value: 257 })).result, "no_right");
    for (let i = 0; i < 5; ++i) client.ask({ do: "login", secret: `${i}` });
    assert.equal((await client.closed).code, 1008);
  }));

test("one operates, the other sees who; the seat is free when the page goes", () =>
  withPages(2, async (machine, first, second) => {
    await operate(first, machine.token);
    await hasText(second, "#seat", "panel 1 at 127.0.0.1 operates");
    await second.click("#mode");
    await second.fill("#token", machine.token);
    await second.click("#token-form button[type=submit]");
    await hasText(second, "#notices", "Not operating");
    assert.equal(await second.evaluate(() => document.body.classList.contains("operating")), false);
    await first.goto("about:blank");
    await hasText(second, "#seat", "Nobody operates");
    await second.click("#mode");
    await second.waitForFunction(() => document.body.classList.contains("operating"));
  }));

test("who operates is taken over on request, and told so", () =>
  withPages(2, async (machine, first, second) => {
    await operate(first, machine.token);
    await second.click("#mode");
    await second.fill("#token", machine.token);
    await second.click("#token-form button[type=submit]");
    await isReadable(second, "#notices button:has-text('Take over')");
    await second.click("#notices button:has-text('Take over')");
    await second.waitForFunction(() => document.body.classList.contains("operating"));
    await hasText(first, "#notices", "panel 2 at 127.0.0.1 has taken over; you are watching");
    await hasText(first, "#seat", "panel 2 at 127.0.0.1 operates");
    await first.waitForFunction(() => !document.body.classList.contains("operating"));
  }));

test("a stop that the motor does not confirm says that it may be moving", () =>
  withPages(1, async (machine, page) => {
    await operate(page, machine.token);
    await page.click("#sim-cut");
    await page.click("#do-stop");
    await hasText(page, "#link-bar", "has not confirmed it: it may be moving");
    await state(page, "stop not confirmed: the motor may be moving");
    await hasText(page, "#why li:first-child", "It may be moving");
    assert.doesNotMatch(await textOf(page, "#why"), /“Run” starts/);
    await isReadable(page, "#do-give-up");
    for (const id of ["#do-run", "#do-step", "#do-scan"]) assert.equal(await page.getAttribute(id, "aria-disabled"), "true", id);
    await hasText(page, "#notices", "the motor may be moving; mend its supply or line");
    assert.doesNotMatch(await textOf(page, "#notices"), /not confirmed.*not confirmed/i);
    for (let i = 0; i < 6; ++i) { // other notices do not push it out
      await page.fill("#sim-action", `motor lod ${i}`);
      await page.click("#sim-form button");
      await hasText(page, "#notices", `motor lod ${i}:`);
    }
    await hasText(page, "#notices", "the motor may be moving; mend its supply or line");
    await page.click("#sim-cut");
    await page.waitForFunction(() => document.querySelector("#link-bar").hidden);
    assert.doesNotMatch(await textOf(page, "#notices"), /may be moving/, "it goes with its reason");
  }));

test("a stop while the simulated time is paused says why nothing comes of it", () =>
  withPages(2, async (machine, page, watcher) => {
    await operate(page, machine.token);
    await page.click("#sim-pause");
    await hasText(page, "#sim-pause", "Go on");
    await watcher.click("#do-stop");
    await hasText(watcher, "#link-bar", "The simulated time is paused");
    await page.click("#sim-pause");
    await state(watcher, "stopped: stop command");
    await watcher.waitForFunction(() => document.querySelector("#link-bar").hidden);
  }));

test("a stop that the motor does not confirm is given up after a question", () =>
  withPages(1, async (machine, page) => {
    await operate(page, machine.token);
    await page.click("#sim-cut");
    await page.click("#do-stop");
    await page.click("#do-give-up");
    await isReadable(page, "#notices button:has-text('Give the stop up')");
    await page.click("#notices button:has-text('Give the stop up')");
    await page.waitForFunction(() => document.querySelector("#link-bar").hidden);
    await hasText(page, "#sim-cut", "Restore the line");
  }));

test("a page that comes later knows that the line is cut and the shaft blocked, whoever did it", () =>
  withPages(2, async (machine, first, second) => {
    await operate(first, machine.token);
    await first.fill("#sim-action", "line cut");
    await first.press("#sim-action", "Enter");
    await hasText(second, "#sim-cut", "Restore the line");
    await first.click("#sim-block");
    await hasText(second, "#sim-block", "Free the shaft");
    await second.reload();
    await hasText(second, "#sim-cut", "Restore the line");
    await first.click("#sim-cut");
    await first.click("#sim-block");
    await hasText(second, "#sim-cut", "Cut the line");
    await hasText(second, "#sim-block", "Block the shaft");
  }));

test("run, step, scan and breakpoints", () =>
  withPages(1, async (machine, page) => {
    await operate(page, machine.token);
    await page.click('.box[data-step="2"]');
    await page.click("#break");
    await page.waitForSelector(".box.breaks");
    await page.fill("#sim-action", "pulse Start 50 ms");
    await page.click("#sim-form button");
    await state(page, "held at a breakpoint");
    await page.click("#show-active");
    await hasText(page, "#waits-title", "Travel");
    await page.click("#break");
    await page.waitForFunction(() => !document.querySelector(".box.breaks"));
    await page.click("#do-run");
    await state(page, "running");
    await inStep(page, 1);
    await page.click("#do-hold");
    await state(page, "held");
    await page.click("#do-scan");
    await page.click("#do-stop");
    await state(page, "stopped");
  }));

test("forces are shown with their time, last while the page is there, and end with it", () =>
  withPages(2, async (machine, page, watcher) => {
    await operate(page, machine.token);
    await page.selectOption('select[aria-label="force Guard"]', "1");
    await lamp(watcher, "Guard", 1);
    for (const one of [page, watcher]) { // what is noted of it leaves its name on one line
      const name = await one.locator(".signal-name", { hasText: "Guard" }).boundingBox();
      assert.ok(name.height < 30, `${name.height} px`);
    }
    await page.selectOption('select[aria-label="force OUT1"]', "1");
    await lamp(watcher, "OUT1", 1);
    await hasText(watcher, "#fact-forces", "end in");
    const times = new Set();
    for (let i = 0; i < 7; ++i) {
      await page.waitForTimeout(1000); // longer than force_timeout in all: the page renews them
      times.add(await textOf(watcher, "#fact-forces"));
    }
    assert.ok([...times].every((t) => /end in/.test(t)), [...times].join());
    await page.goto("about:blank");
    await hasText(watcher, "#fact-forces", "none");
    await lamp(watcher, "Guard", 0);
    await hasText(watcher, "#events", "forces ended: the client was silent");
  }));

test("an upload is compared and asked about, then stored, made active, and its names come along", () =>
  withPages(1, async (machine, page) => {
    const source = file("seq", readFileSync(pick, "utf8").replace("T#500ms", "T#700ms").replaceAll("Travel", "Outward").replace("PickAndPlace", "Slower"));
    const table = path("slower.bin");
    execFileSync(join(programs, "seqc"), ["build", source, "-o", table]);
    await operate(page, machine.token);
    await page.click("#do-upload");
    await page.setInputFiles("#upload-files", [pick]);
    await hasText(page, "#upload-text", "is no table");
    await page.setInputFiles("#upload-files", [table, path("slower.sym")]);
    await hasText(page, "#upload-diff", "TIMER := 700 ms");
    await hasText(page, "#upload-text", "Making it active stops the sequence");
    await hasText(page, "#program", "PickAndPlace");
    await page.click("#upload-activate");
    await hasText(page, "#program", "Slower");
    await state(page, "stopped");
    await hasText(page, "#events", "table activated");
    await page.click("#do-run");
    await state(page, "running");
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#do-download")]);
    assert.deepEqual(readFileSync(await download.path()), readFileSync(table));
  }));

test("who does not operate renames nothing: the upload is refused, and its names with it", () =>
  withPages(1, async (machine, page) => {
    const table = path("running.bin");
    execFileSync(join(programs, "seqc"), ["build", pick, "-o", table]);
    const symbols = JSON.parse(readFileSync(path("running.sym"), "utf8"));
    symbols.program = "Renamed";
    await operate(page, machine.token);
    const other = new Client(machine.url);
    await other.opened;
    await other.ask({ do: "login", secret: machine.token });
    const request = { do: "upload", table: readFileSync(table).toString("base64"), symbols };
    const refused = await other.ask(request);
    assert.equal(refused.result, "refused");
    assert.match(refused.text, /another client operates/);
    await page.reload();
    await hasText(page, "#program", "PickAndPlace");
    await other.ask({ do: "seat", take_over: true });
    assert.equal((await other.ask(request)).result, "done");
    await hasText(page, "#program", "Renamed");
    other.close();
  }));

test("a force that the safe state overrules is shown as it was asked for", () =>
  withPages(1, async (machine, page) => {
    await operate(page, machine.token);
    await page.click("#do-stop");
    await state(page, "stopped: stop command");
    await page.selectOption('select[aria-label="force Lamp"]', "1");
    await hasText(page, "#fact-forces", "end in");
    await page.locator("#search").focus();
    await hasText(page, ".signals li.forced .signal-note", "forced 1, now 0");
    assert.equal(await page.inputValue('select[aria-label="force Lamp"]'), "1");
  }));

test("an upload is compared with what is active when it is confirmed, not with what was", () =>
  withPages(1, async (machine, page) => {
    const build = (name) => {
      execFileSync(join(programs, "seqc"), ["build", join(examples, `${name}.seq`), "-o", path(`${name}.bin`)]);
      return [path(`${name}.bin`), path(`${name}.sym`)];
    };
    const files = build("cut_to_length");
    const [table, symbols] = build("fill_and_count");
    await operate(page, machine.token);
    await page.click("#do-upload");
    await page.setInputFiles("#upload-files", files);
    await hasText(page, "#upload-text", "differs from what is active (PickAndPlace");
    const client = new Client(machine.url);
    await client.opened;
    await client.ask({ do: "login", secret: machine.token });
    await client.ask({ do: "seat", take_over: true });
    const answer = await client.ask({ do: "upload", table: readFileSync(table).toString("base64"), symbols: JSON.parse(readFileSync(symbols, "utf8")), activate: true });
    assert.equal(answer.result, "done", answer.text);
    await hasText(page, "#upload-text", "differs from what is active (FillAndCount");
    client.close();
  }));

test("a table that is only stored: the page says so, and makes it active after a question", () =>
  withPages(1, async (machine, page) => {
    execFileSync(join(programs, "seqc"), ["build", join(examples, "cut_to_length.seq"), "-o", path("later.bin")]);
    await operate(page, machine.token);
    assert.equal(await page.locator("#do-activate").isVisible(), false);
    await page.click("#do-upload");
    await page.setInputFiles("#upload-files", [path("later.bin"), path("later.sym")]);
    await page.click("#upload-store");
    await hasText(page, "#notices", "by “Use stored table…”");
    await hasText(page, "#loaded", "another table is stored");
    await page.click("#do-activate");
    await hasText(page, "#notices", "That stops the sequence");
    await state(page, "running");
    await page.click("#notices button:has-text('Stop and use it')");
    await hasText(page, "#notices", "The stored table is active");
    await hasText(page, "#program", "Cut_to_Length");
    await page.waitForFunction(() => document.getElementById("do-activate").hidden);
    await page.click("#do-run");
    await state(page, "running");
  }));

test("the inputs of an uploaded program are clicked by its names, of one without names by their numbers", () =>
  withPages(1, async (machine, page) => {
    const source = file("seq", readFileSync(pick, "utf8").replaceAll(/\bStart\b/g, "Begin").replaceAll("PickAndPlace", "Renamed"));
    execFileSync(join(programs, "seqc"), ["build", source, "-o", path("renamed.bin")]);
    execFileSync(join(programs, "seqc"), ["build", join(examples, "cut_to_length.seq"), "-o", path("nameless.bin")]);
    await operate(page, machine.token);
    const upload = async (files, button, text) => {
      await page.click("#do-upload");
      await page.setInputFiles("#upload-files", files);
      await page.click(button);
      await hasText(page, "#notices", text);
    };
    await upload([path("renamed.bin"), path("renamed.sym")], "#upload-activate", "stored and active");
    await page.click('.press[aria-label="switch Begin"]');
    await lamp(page, "Begin", 1);
    await upload([path("nameless.bin"), path("nameless.sym")], "#upload-store", "The table is stored.");
    await page.click('.press[aria-label="switch Begin"]');
    await lamp(page, "Begin", 0);
    assert.equal(await textOf(page, "#program"), "Renamed", "that of the active table");
    execFileSync(join(programs, "seqc"), ["build", join(examples, "fill_and_count.seq"), "-o", path("nameless.bin")]);
    await upload([path("nameless.bin")], "#upload-activate", "stored and active");
    await page.click('.press[aria-label="switch IN0"]');
    await lamp(page, "IN0", 1);
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#sim-save")]);
    assert.match(readFileSync(await download.path(), "utf8"), /^# at \d+ ms another table became active/m);
  }));

test("files that are no table, an empty one, two, foreign names and another motor's program are told before anything is sent", () =>
  withPages(1, async (machine, page) => {
    const build = (name) => {
      execFileSync(join(programs, "seqc"), ["build", join(examples, `${name}.seq`), "-o", path(`${name}.bin`)]);
      return [path(`${name}.bin`), path(`${name}.sym`)];
    };
    const [table, names] = build("pick_and_place");
    const others = build("cut_to_length");
    const midi = build("midi_pick_and_place");
    const bytes = readFileSync(table);
    await operate(page, machine.token);
    await page.click("#do-upload");
    const told = async (files, text) => {
      await page.setInputFiles("#upload-files", files);
      await hasText(page, "#upload-text", text);
      assert.equal(await page.locator("#upload-activate").isDisabled(), true, text);
    };
    await told([file("bin", Buffer.alloc(8, 255))], "is an empty table");
    await told([file("bin", Buffer.concat([bytes, Buffer.alloc(5)]))], "it is no table, or has a certificate");
    await told([table, others[0]], "choose one table and its names, not more");
    await told([table, others[1]], "the names are those of another table");
    await told([table, file("sym", "{ hello")], "holds no names of a program");
    await told([table, file("sym", "[1, 2]")], "holds no names of a program");
    await page.setInputFiles("#upload-files", midi);
    await hasText(page, "#upload-text", "It was compiled for a MAC34, and this axis has a MAC140");
    await page.setInputFiles("#upload-files", [table, names]);
    await hasText(page, "#upload-text", "is the table that is active already");
    assert.doesNotMatch(await textOf(page, "#upload-text"), /compiled for/);
  }));

test("names of another form than seqc's, from any client, leave the page at work", () =>
  withPages(1, async (machine, page) => {
    const table = path("strange.bin");
    execFileSync(join(programs, "seqc"), ["build", join(examples, "cut_to_length.seq"), "-o", table]);
    const client = new Client(machine.url);
    await client.opened;
    await client.ask({ do: "login", secret: machine.token });
    await client.ask({ do: "command", name: "stop" });
    await client.ask({ do: "seat" });
    const crc = JSON.parse(readFileSync(path("strange.sym"), "utf8")).table;
    const symbols = { table: crc, program: 7, steps: [null, { number: 1, name: 5 }, 3], inputs: { a: 1 }, outputs: [1, 2], scale: "mm", registers: {}, motor: [] };
    const answer = await client.ask({ do: "upload", table: readFileSync(table).toString("base64"), symbols, activate: true });
    assert.equal(answer.result, "done", answer.text);
    await hasText(page, "#loaded", crc.crc32);
    await hasText(page, "#waits-title", "Active step: Step 0");
    await client.ask({ do: "command", name: "run" });
    await state(page, "running");
    client.close();
  }));

test("an upload with another SCALE: the page shows it, and says what the other faces keep to", () =>
  withPages(1, async (machine, page) => {
    assert.doesNotMatch(await textOf(page, "#loaded"), /Modbus/);
    const source = file("seq", readFileSync(pick, "utf8").replace(/SCALE [^;]*;/, "SCALE 1 rev = 360 deg;").replaceAll(/([\d.]+) mm/g, "$1 deg"));
    const table = path("degrees.bin");
    execFileSync(join(programs, "seqc"), ["build", source, "-o", table]);
    await operate(page, machine.token);
    await page.click("#do-upload");
    await page.setInputFiles("#upload-files", [table, path("degrees.sym")]);
    await page.click("#upload-activate");
    await hasText(page, "#loaded", "Modbus, MQTT and metrics show positions at 5 mm a revolution");
    await hasText(page, "#trend-now", "deg");
    assert.match(machine.text, /the uploaded program's SCALE is 360 deg a revolution.*Modbus, MQTT and metrics keep to 5 mm a revolution/s);
  }));

test("why, the trend's CSV, and reset error", () =>
  withPages(1, async (machine, page) => {
    await hasText(page, "#why", "The sequence waits in Idle, for Travel: Start");
    await hasText(page, "#trend-now", "rpm");
    await page.click("text=Pause >> nth=0");
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#trend-tools >> text=CSV")]);
    assert.match(readFileSync(await download.path(), "utf8"), /^uptime_s,step,position_mm,velocity_rpm,current_percent\n[\d.]+,Idle,/);
    await operate(page, machine.token);
    await page.click("#do-stop");
    await state(page, "stopped");
    await hasText(page, "#why", "gateway_safe (11)"); // as every other interface shows it
    await hasText(page, "#why", "“Run” starts it.");
    assert.doesNotMatch(await textOf(page, "#why"), /nanoctl/);
    await page.click("#do-reset-error");
    await hasText(page, "#notices", "The motor's errors were cleared");
  }));

test("a cause is told once, with the remedy for a sequence that runs", () =>
  withPages(1, async (machine, page) => {
    await hasText(page, "#waits-title", "Fault");
    await hasText(page, "#why", "the gateway's sequence has stopped the motor");
    assert.equal((await textOf(page, "#why")).split("velocity_zero").length - 1, 1);
    assert.doesNotMatch(await textOf(page, "#why"), /macreg set V_SOLL/);
  }, { scenario: "at 1 s pulse Start 50 ms\nat 1.2 s Guard := 1\n" }));

test("reset error keeps the settings in ERR_STAT: relative positions stay relative", () =>
  withPages(1, async (machine, page) => {
    const kRelative = 0x200; // RELPOSPSOLL (001 §3.2.35)
    const client = new Client(machine.url);
    await client.opened;
    await client.ask({ do: "login", secret: machine.token });
    await client.ask({ do: "command", name: "stop" });
    await client.ask({ do: "seat" });
    assert.equal((await client.ask({ do: "motor_write", register: "ERR_STAT", value: kRelative })).result, "done");
    await client.ask({ do: "leave" });
    await operate(page, machine.token);
    await page.click("#do-reset-error");
    await hasText(page, "#notices", "The motor's errors were cleared");
    const now = await client.ask({ do: "motor_read", register: "ERR_STAT" });
    assert.equal(now.value & kRelative, kRelative);
    client.close();
  }));

test("the simulated machine: inputs, line, shaft, time, and a scenario that does the same", () =>
  withPages(1, async (machine, page) => {
    await operate(page, machine.token);
    await page.click('.press[aria-label="switch Start"]');
    await lamp(page, "Start", 1);
    await inStep(page, 2);
    await page.click('.press[aria-label="switch Start"]');
    await inStep(page, 1);
    await page.click("#do-stop");
    await state(page, "stopped: stop command");
    await page.click("#do-run");
    await inStep(page, 1);
    await state(page, "running");
    await page.click("#sim-cut");
    await hasText(page, "#fact-link", "down");
    await page.click("#sim-cut");
    await hasText(page, "#fact-error", "ERROR");
    await page.click("#sim-block");
    await page.click("#sim-block");
    await page.click("#sim-form button"); // nothing is asked for, and nothing complained of
    await page.fill("#sim-action", "motor lod 3");
    await page.click("#sim-form button");
    await hasText(page, "#notices", "motor lod 3:");
    assert.doesNotMatch(await textOf(page, "#notices"), /"sim" takes/);
    await page.click("#sim-pause");
    await hasText(page, "#sim-pause", "Go on");
    const stands = async () => {
      const before = await textOf(page, "#sim-time");
      await page.waitForTimeout(600); // longer than a beat of the wire
      return (await textOf(page, "#sim-time")) === before;
    };
    assert.ok((await stands()) || (await stands()));
    const time = await textOf(page, "#sim-time");
    await page.selectOption("#sim-speed", "10");
    await page.click("#sim-pause");
    await page.waitForFunction((t) => document.getElementById("sim-time").textContent > t, time);
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#sim-save")]);
    const recorded = readFileSync(await download.path(), "utf8");
    assert.match(recorded, /^at [\d.]+ ms toggle Start$/m);
    assert.match(recorded, /^at [\d.]+ ms gateway stop\nat [\d.]+ ms gateway run$/m);
    assert.match(recorded, /^at [\d.]+ ms motor stop above -?\d+ counts, motor stop below -?\d+ counts$/m);
    const again = execFileSync(join(programs, "nanoplc-sim"), ["run", pick, "--scenario", file("scn", recorded)], { encoding: "utf8" });
    assert.match(again, /Idle -> Travel/);
    assert.match(again, /stop command/);
    assert.match(again, /link/);
  }));

test("commands, forces and breakpoints are recorded too, and their scenario ends as the machine did", () =>
  withPages(1, async (machine, page) => {
    const forced = (page, name, level) => page.selectOption(`select[aria-label="force ${name}"]`, level);
    await operate(page, machine.token);
    await page.click("#do-hold");
    await state(page, "held");
    await page.click('.press[aria-label="switch Start"]');
    await lamp(page, "Start", 1);
    await page.click("#do-step");
    await inStep(page, 2);
    await state(page, "held");
    await forced(page, "Lamp", "1");
    await lamp(page, "Lamp", 1);
    await page.click('.press[aria-label="switch Start"]');
    await lamp(page, "Start", 0);
    await page.click('.box[data-step="4"]');
    await page.click("#break");
    await page.waitForSelector(".box.breaks");
    await page.click("#do-run");
    await state(page, "held at a breakpoint");
    await inStep(page, 4);
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#sim-save")]);
    const recorded = readFileSync(await download.path(), "utf8");
    for (const action of ["gateway hold", "toggle Start", "gateway step", "gateway force Lamp := 1", "gateway break Return", "gateway run"])
      assert.match(recorded, new RegExp(`^at [\\d.]+ ms ${action}$`, "m"));
    const wanted = `${recorded}expect at end step = Return and not RUNNING and Lamp\n`;
    const again = execFileSync(join(programs, "nanoplc-sim"), ["run", pick, "--scenario", file("scn", wanted)], { encoding: "utf8" });
    assert.match(again, /Idle -> Travel/);
    await forced(page, "Lamp", "");
    await page.click("#do-safe");
    await state(page, "stopped: safe command");
    const [more] = await Promise.all([page.waitForEvent("download"), page.click("#sim-save")]);
    assert.match(readFileSync(await more.path(), "utf8"), /gateway release Lamp\nat [\d.]+ ms gateway safe$/m);
  }));

test("a keyboard is enough", () =>
  withPages(1, async (machine, page) => {
    await page.focus('.box[tabindex="0"]');
    await page.keyboard.press("ArrowDown");
    await page.keyboard.press("Enter");
    await hasText(page, "#waits-title", "Idle");
    await page.focus("#do-stop");
    await page.keyboard.press("Enter");
    await state(page, "stopped");
  }));
