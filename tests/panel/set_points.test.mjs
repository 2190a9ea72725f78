// Set-points and recipes on the page: shown to all, changed together, refused whole, kept, and sent to every client.
import assert from "node:assert/strict";
import { execFile, execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, test } from "node:test";
import { promisify } from "node:util";
import { Client, closeBrowser, examples, file, hasText, inStep, openPage, operate, pagesOf, painted, path, programs, textOf, withService } from "./machine.mjs";

after(closeBrowser);

const cut = join(examples, "cut_to_length.seq");
const kIdle = 1; // its steps are numbered as they stand there: Idle, Feed, Cut, Counted, Done, Fault

const withPages = (count, use, program = cut) => pagesOf(program, count, use);

const row = (name) => `#set-points tr:has(#range-${name})`;
const input = (name) => `${row(name)} input`;
const value = (page, name, text) => hasText(page, `${row(name)} .set-point-value`, text);
const event = (page, text) => hasText(page, "#events", text);

async function change(page, values) {
  for (const [name, text] of Object.entries(values)) await page.fill(input(name), text);
  await page.click("#set-points-change");
}

test("who watches sees name, value, unit, range and step, and can change nothing", () =>
  withPages(1, async (machine, page) => {
    await value(page, "Length", "80 mm");
    assert.equal(await textOf(page, "#range-Length"), "10 mm to 200 mm in steps of 0.1 mm");
    await value(page, "Speed", "1500 rpm");
    await value(page, "Blade_Time", "300 ms");
    await value(page, "Pieces", "3");
    assert.equal(await textOf(page, "#range-Pieces"), "1 to 999");
    for (const what of [input("Length"), "#set-points-change", "#recipe-load", "#recipe-save", "#recipe-import"])
      assert.equal(await page.locator(what).isVisible(), false, what);
    const client = new Client(machine.url);
    await client.opened;
    const answer = await client.ask({ do: "set_points", values: { Length: "90 mm" } });
    assert.equal(answer.result, "no_right");
    client.close();
  }));

test("a program without set-points has no such part", () =>
  withPages(1, async (machine, page) => assert.equal(await page.locator(".set-points-panel").isVisible(), false), join(examples, "pick_and_place.seq")));

test("several values are changed as one; every client sees it, a reload keeps it, the log says who and what", () =>
  withPages(2, async (machine, page, watcher) => {
    await operate(page, machine.token);
    assert.equal(await page.locator("#set-points-change").isDisabled(), true);
    await change(page, { Length: "25.5", Pieces: "5" });
    await value(watcher, "Length", "25.5 mm");
    await value(watcher, "Pieces", "5");
    for (const one of [page, watcher]) await event(one, "set-points changed by the panel: Length 80 mm to 25.5 mm, Pieces 3 to 5");
    await watcher.reload();
    await value(watcher, "Length", "25.5 mm");
    await event(watcher, "Length 80 mm to 25.5 mm");
  }));

test("one value out of its range, and nothing is changed; what was typed stays to be mended", () =>
  withPages(2, async (machine, page, watcher) => {
    await operate(page, machine.token);
    await change(page, { Length: "300", Pieces: "5" });
    await hasText(page, "#set-points-problem", "Length takes 10 mm to 200 mm in steps of 0.1 mm; nothing was changed");
    await value(watcher, "Length", "80 mm");
    await value(watcher, "Pieces", "3");
    assert.equal(await page.inputValue(input("Length")), "300");
    assert.equal(await page.inputValue(input("Pieces")), "5");
    for (const [text, why] of [["20 rpm", "'rpm' is no unit of Length"], ["long", "'long' is no value"], ["", "is no value"], ["20.05", "between two steps"]]) {
      await change(page, { Length: text });
      await hasText(page, "#set-points-problem", why);
    }
    await change(page, { Length: "120 mm" });
    await value(watcher, "Length", "120 mm");
    await value(watcher, "Pieces", "5");
    await hasText(page, "#set-points-problem", "");
    await page.fill(input("Pieces"), "7");
    await page.click("#set-points-undo");
    assert.equal(await page.inputValue(input("Pieces")), "5");
    assert.equal(await textOf(page, "#set-points-problem"), "");
  }));

test("what another client changes does not overwrite what is being typed", () =>
  withPages(1, async (machine, page) => {
    await operate(page, machine.token);
    await page.fill(input("Pieces"), "7");
    await page.fill("#sim-action", "set Pieces := 9 and Length := 50 mm");
    await page.click("#sim-form button");
    await hasText(page, `${row("Pieces")} .set-point-note`, "by now 9");
    assert.equal(await page.inputValue(input("Pieces")), "7");
    assert.equal(await page.inputValue(input("Length")), "50");
    await event(page, "set-points changed by the scenario: Length 80 mm to 50 mm, Pieces 3 to 9");
  }));

test("a change waits for a step that takes it, and is in force there", () =>
  withPages(2, async (machine, page, watcher) => {
    await operate(page, machine.token);
    await inStep(page, kIdle);
    await page.fill("#sim-action", "Start := 1");
    await page.click("#sim-form button");
    await page.waitForFunction((idle) => document.body.dataset.step !== String(idle), kIdle);
    await change(page, { Length: "40" });
    await hasText(watcher, "#set-points-state", "a change waits: it is taken in POWER_UP, Idle or when the sequence stops");
    await hasText(watcher, `${row("Length")} .set-point-note`, "in force: 80 mm");
    await hasText(watcher, "#why", "Changed set-points wait");
    await page.fill("#sim-action", "Start := 0");
    await page.click("#sim-form button");
    await inStep(page, kIdle);
    await page.waitForFunction(() => !document.getElementById("set-points-state").textContent.includes("waits"));
    await hasText(watcher, `${row("Length")} .set-point-note`, "");
    await event(watcher, "set-points taken");
  }));

test("recipes are saved, loaded, deleted, and say what they would bring", () =>
  withPages(2, async (machine, page, watcher) => {
    await operate(page, machine.token);
    assert.equal(await page.locator("#recipe-load").isDisabled(), true);
    const save = async (name) => {
      await page.click("#recipe-save");
      await page.fill("#recipe-name", name);
      await page.click("#recipe-do");
    };
    await save("Standard");
    await event(watcher, "recipe saved by the panel: 1 'Standard'");
    await change(page, { Length: "25.5", Speed: "2000" });
    await value(watcher, "Length", "25.5 mm");
    await save("Short");
    await hasText(watcher, "#recipe", "Short");
    await page.selectOption("#recipe", "Standard");
    await hasText(page, "#recipe-values", "Length 80 mm, Speed 1500 rpm, Blade_Time 300 ms, Pieces 3");
    await page.click("#recipe-load");
    await value(watcher, "Length", "80 mm");
    await hasText(watcher, "#set-points-state", "recipe Standard");
    await event(watcher, "recipe loaded by the panel: 1 'Standard': Length 25.5 mm to 80 mm, Speed 2000 rpm to 1500 rpm");
    await change(page, { Length: "81" });
    await hasText(watcher, "#set-points-state", "recipe Standard, changed since it was loaded");
    await page.selectOption("#recipe", "Short");
    await page.click("#recipe-delete");
    await hasText(page, "#recipe-title", "Delete recipe Short");
    await page.click("#recipe-do");
    await event(watcher, "recipe deleted by the panel: 2");
    await page.waitForFunction(() => document.querySelectorAll("#recipe option").length === 1);
    await page.click("#recipe-save");
    await page.fill("#recipe-name", "Größe");
    await page.click("#recipe-do");
    await hasText(page, "#recipe-problem", "plain ASCII");
    await page.fill("#recipe-name", "STANDARD");
    await hasText(page, "#recipe-text", "This replaces recipe Standard.");
    await page.click("#recipe-dialog [data-stop=stop]");
    await hasText(page, "#state-text", "stopped: stop command");
  }));

const kToml = '[[recipe]]\nname = "Long"\n[recipe.values]\nLength = "150 mm"\nPieces = "1"\n';

test("files of recipes go out and in as nanoctl's do, whole or not at all", () =>
  withPages(1, async (machine, page) => {
    await operate(page, machine.token);
    const take = async (ending, text) => {
      await page.click("#recipe-import");
      await page.setInputFiles("#import-file", file(ending, text));
      await page.click("#import-form button[type=submit]");
    };
    await take("toml", kToml);
    await hasText(page, "#notices", "1 recipe stored");
    await page.selectOption("#recipe", "Long");
    await hasText(page, "#recipe-values", "Length 150 mm, Speed 1500 rpm, Blade_Time 300 ms, Pieces 1");
    for (const [ending, text, why] of [
      ["csv", "recipe,set_point,value,unit\nA,Length,20,mm\nA,Pieces,1000,\n", "line 3: "],
      ["csv", "recipe,set_point,value,unit\nA,Width,20,mm\n", "line 2: the table has no set-point 'Width'"],
      ["csv", "recipe,set_point,value,unit\nA,Length,20,rpm\n", "'rpm' is no unit of Length"],
      ["csv", "a table\n", "line 1: the header is not recipe,set_point,value,unit"],
      ["toml", "[[recipe\n", "this is not TOML"],
    ]) {
      await take(ending, text);
      await hasText(page, "#import-problem", why);
      await hasText(page, "#import-problem", "nothing was imported");
      await page.click("#import-cancel");
    }
    await page.waitForFunction(() => document.querySelectorAll("#recipe option").length === 1);
    const downloads = [];
    for (const format of ["csv", "toml"]) {
      const [download] = await Promise.all([page.waitForEvent("download"), page.click(`#recipe-${format}`)]);
      assert.equal(download.suggestedFilename(), `Cut_to_Length_recipes.${format}`);
      downloads.push(readFileSync(await download.path(), "utf8"));
    }
    assert.equal(downloads[0], "recipe,set_point,value,unit\nLong,Length,150,mm\nLong,Speed,1500,rpm\nLong,Blade_Time,300,ms\nLong,Pieces,1,\n");
    assert.equal(downloads[1], '[[recipe]]\nname = "Long"\n[recipe.values]\nLength = "150 mm"\nSpeed = "1500 rpm"\nBlade_Time = "300 ms"\nPieces = "1"\n');
    await take("csv", downloads[0]);
    await hasText(page, "#notices", "1 recipe stored");
  }));

test("what was set in a simulation is recorded, and the record is a scenario", () =>
  withPages(1, async (machine, page) => {
    await operate(page, machine.token);
    await change(page, { Length: "25.5", Pieces: "2" });
    await hasText(page, "#sim-recorded", "1 recorded");
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#sim-save")]);
    const scenario = readFileSync(await download.path(), "utf8");
    assert.match(scenario, /^at [0-9.]+ ms set Length := 25\.5 mm and Pieces := 2$/m);
    execFileSync(join(programs, "nanoplc-sim"), ["run", cut, "--quiet", "--scenario", file("scn", scenario)]);
  }));

test("a table that is uploaded here brings its set-points with its names", () =>
  withPages(1, async (machine, page) => {
    const table = path("uploaded.bin");
    execFileSync(join(programs, "seqc"), ["build", cut, "-o", table]);
    await operate(page, machine.token);
    await page.click("#do-upload");
    await page.setInputFiles("#upload-files", [table, path("uploaded.sym")]);
    await page.click("#upload-activate");
    await value(page, "Length", "80 mm");
    await change(page, { Length: "90" });
    await event(page, "Length 80 mm to 90 mm");
  }, join(examples, "pick_and_place.seq")));

test("a new table keeps what still fits; what was dropped is said, and of a recipe what it lacks", () =>
  withPages(1, async (machine, page) => {
    const source = file("seq", readFileSync(cut, "utf8").replaceAll("Length", "Feed_Length").replace("RANGE 1 .. 999", "RANGE 1 .. 4"));
    const table = path("renamed.bin");
    execFileSync(join(programs, "seqc"), ["build", source, "-o", table]);
    await operate(page, machine.token);
    await change(page, { Length: "33", Speed: "2000", Pieces: "5" });
    await value(page, "Pieces", "5");
    await page.click("#recipe-save");
    await page.fill("#recipe-name", "Old");
    await page.click("#recipe-do");
    await hasText(page, "#recipe-values", "Length 33 mm");
    await page.click("#do-upload");
    await page.setInputFiles("#upload-files", [table, path("renamed.sym")]);
    await page.click("#upload-activate");
    await value(page, "Feed_Length", "80 mm");
    await value(page, "Speed", "2000 rpm");
    await value(page, "Pieces", "3");
    await event(page, "set-points fell back to their defaults: Feed_Length, Pieces");
    await hasText(page, "#recipe-values", "Speed 2000 rpm, Blade_Time 300 ms; the default of Feed_Length, Pieces, of which it has no value that fits");
    await page.click("#recipe-load");
    await event(page, "recipe loaded by the panel: 1 'Old'");
  }));

const tokenOf = (said) => /token: (\S+)/.exec(said)[1];

test("the service: the panel and a person's port change the same values", () =>
  withService("", async ({ url, folder, said }) => {
    const nanoctl = (...words) => execFileSync(join(programs, "nanoctl"), ["--port", `unix:${join(folder, "x.port")}`, ...words], { encoding: "utf8" });
    const page = await openPage(url);
    await painted(page);
    await operate(page, tokenOf(said()));
    await change(page, { Length: "33", Pieces: "4" });
    await event(page, "by the panel: Length 80 mm to 33 mm, Pieces 3 to 4");
    assert.match(nanoctl("set-points"), /Length\s+33 mm/);
    await page.click("#mode"); // gives the seat back
    await hasText(page, "#seat", "Nobody operates");
    nanoctl("set-points", "set", "Length=44mm");
    await value(page, "Length", "44 mm");
    await event(page, "set-points changed by the user's port: Length 33 mm to 44 mm");
    while (!/set-points: 1 set over the user's port: Length 33 mm to 44 mm/.test(said())) await new Promise((resolve) => setTimeout(resolve, 50));
    assert.deepEqual(page.complaints, []);
    await page.context().close();
  }, { axes: { x: cut } }));

test("a page that is halted in the middle of an import leaves whole recipes, and others operate soon", () =>
  withService("", async ({ url, folder, said }) => {
    const nanoctl = (...words) => promisify(execFile)(join(programs, "nanoctl"), ["--port", `unix:${join(folder, "x.port")}`, "--json", ...words]);
    const client = new Client(url);
    await client.opened;
    await client.until((m) => m.t === "set_points" && m.values.length > 0);
    assert.equal((await client.ask({ do: "login", secret: tokenOf(said()) })).result, "done");
    const names = ["A", "B", "C", "D", "E", "F"];
    const lines = names.flatMap((name, i) => [`${name},Length,${20 + i},mm`, `${name},Speed,${200 + i},rpm`, `${name},Blade_Time,${200 + i},ms`, `${name},Pieces,${10 + i},`]);
    client.ask({ do: "recipe", action: "import", format: "csv", text: ["recipe,set_point,value,unit", ...lines, ""].join("\n") });
    client.socket.pause();
    for (;;) {
      const refused = await nanoctl("set-points", "set", "Pieces=7").then(() => null, (error) => error.stdout + error.stderr);
      if (refused === null) break;
      assert.match(refused, /another client operates/);
    }
    const { recipes } = JSON.parse((await nanoctl("recipe", "list")).stdout);
    for (const { name, values } of recipes) {
      const i = names.indexOf(name);
      assert.deepEqual(values, { Length: 20 + i, Speed: 200 + i, Blade_Time: 200 + i, Pieces: 10 + i });
    }
    client.socket.terminate();
  }, { axes: { x: cut } }));

/** All values of a change say which one it is: writer and number. */
const setOf = (writer, i) => ({ Length: 20 + 50 * writer + i, Speed: 200 + 1000 * (writer - 1) + 10 * i, Blade_Time: 100 + 1000 * writer + i, Pieces: 300 * writer + i });
const kChanges = 6; // of each writer

for (const user of ["pty", "unix"])
  test(`a person's port (${user}) and the panel's socket write at once: every set is whole, and the log tells who`, () =>
    withService("", async ({ url, folder, said }) => {
      const run = promisify(execFile);
      const nanoctl = (...words) => run(join(programs, "nanoctl"), ["--port", `${user}:${join(folder, "x.port")}`, ...words]);
      const [client, watcher] = [new Client(url), new Client(url)];
      await Promise.all([client.opened, watcher.opened]);
      for (const one of [client, watcher]) await one.until((m) => m.t === "set_points" && m.values.length > 0);
      assert.equal((await client.ask({ do: "login", secret: tokenOf(said()) })).result, "done");
      const done = { panel: 0, port: 0, refused: 0 };
      const saved = new Set();
      const panel = async () => {
        for (let i = 0; i < kChanges; ++i) {
          for (;;) {
            const answer = await client.ask({ do: "set_points", values: setOf(2, i) });
            await client.ask({ do: "leave" });
            if (answer.result === "done") break;
            ++done.refused;
            assert.ok([10, 19, 22].includes(answer.code), `busy, too_late or seat_taken: ${JSON.stringify(answer)}`);
            await client.ask({ do: "ping" });
            await new Promise((resolve) => setTimeout(resolve, 100)); // not too many messages
          }
          ++done.panel;
          const answer = await client.ask({ do: "recipe", action: "save", name: `Panel ${i % 3}` });
          assert.ok(answer.result === "done" || [10, 19, 22].includes(answer.code), JSON.stringify(answer));
          if (answer.result === "done") saved.add(`Panel ${i % 3}`);
          await client.ask({ do: "leave" });
        }
      };
      const port = async () => {
        for (let i = 0; i < kChanges; ++i) {
          const words = Object.entries(setOf(1, i)).map(([name, number]) => `${name}=${number}`);
          while (await nanoctl("set-points", "set", ...words).then(() => false, (error) => {
            assert.match(error.stderr, /another client|not now|too long|waited/i);
            return true;
          })) ++done.refused;
          ++done.port;
          await nanoctl("recipe", "save", `Port ${i % 3}`).then(
            () => saved.add(`Port ${i % 3}`),
            (error) => assert.match(error.stderr, /another client|not now|waited/i));
        }
      };
      await Promise.all([panel(), port()]);
      await watcher.until((m) => m.t === "events" && watcher.messages.filter((e) => e.t === "events").flatMap((e) => e.events).filter((e) => e.code === 33).length >= 2 * kChanges);
      const events = watcher.messages.filter((m) => m.t === "events").flatMap((m) => m.events);
      const by = (who) => events.filter((e) => e.code === 33 && e.detail >> 8 === who).length;
      assert.ok(by(1) >= kChanges && by(2) >= kChanges, JSON.stringify(events));
      let seen = 0;
      const isWhole = (values) => {
        const { Pieces } = values;
        const expected = Pieces === 3 ? { Length: 80, Speed: 1500, Blade_Time: 300, Pieces } : setOf(Math.floor(Pieces / 300), Pieces % 300);
        assert.deepEqual(values, expected, "a mixture");
        ++seen;
      };
      for (const message of watcher.messages.filter((m) => m.t === "set_points" && m.values.length)) {
        for (const member of ["value", "in_force"]) isWhole(Object.fromEntries(message.values.map((v) => [v.name, v[member]])));
        for (const recipe of message.recipes) isWhole(recipe.values);
      }
      const kept = JSON.parse((await nanoctl("--json", "recipe", "list")).stdout).recipes.map((recipe) => recipe.name);
      assert.deepEqual(kept.sort(), [...saved].sort(), "no new recipe in another one's place");
      assert.ok(seen > 2 * kChanges, `${seen} sets were seen; refused for the moment: ${done.refused}`);
      client.close();
      watcher.close();
    }, { axes: { x: cut }, user }));
