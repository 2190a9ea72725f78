// The picture follows the sequence, in all examples; what the page shows; old data; lost connections.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { after, test } from "node:test";
import { Client, closeBrowser, examples, file, halt, hasText, inStep, openPage, operate, painted, programs, quietLine, simulator, textOf } from "./machine.mjs";

after(closeBrowser);

const kCycle = "every 3 s pulse Start 50 ms\n";

async function withMachine(program, options, use) {
  const machine = await simulator(program, options);
  try {
    return await use(machine);
  } finally {
    await machine.stop();
  }
}

test("a page shows the program by its names and follows it", () =>
  withMachine(join(examples, "pick_and_place.seq"), { scenario: kCycle }, async (machine) => {
    const page = await openPage(machine.url);
    await painted(page);
    assert.equal(await textOf(page, "#program"), "PickAndPlace");
    assert.match(await textOf(page, "#loaded"), /MAC140 · \d+ terms · CRC-32 [0-9A-F]{8} · no certificate/);
    for (const name of ["Idle", "Travel", "Hold", "Return"]) {
      await page.waitForFunction((n) => document.querySelector(".box.active .name")?.textContent === n, name);
      await hasText(page, "#waits-title", name);
    }
    assert.equal(await page.locator(".box.active").count(), 1);
    assert.ok((await page.locator(".way.taken").count()) >= 2, "the last path is drawn");
    assert.deepEqual(page.complaints, []);
    await page.context().close();
  }));

test("every condition of every way out is true or false as the machine is", () =>
  withMachine(join(examples, "pick_and_place.seq"), { scenario: "at 1 s Guard := 1\n" }, async (machine) => {
    const page = await openPage(machine.url);
    await painted(page);
    await inStep(page, 1);
    // Idle: Start AND NOT Guard goes to Travel; the guard is open from 1 s on.
    const chip = (text) => page.locator(".card", { hasText: "→ Travel" }).locator(".chip", { hasText: text });
    await page.waitForFunction(() => [...document.querySelectorAll(".chip.no")].some((c) => c.textContent.includes("NOT Guard")));
    assert.match(await chip("Start").getAttribute("class"), /no/);
    assert.match(await textOf(page, ".card .badge >> nth=0"), /waits for Start, NOT Guard/);
    await page.context().close();
  }));

test("an inverted input has its conditions by name, and its lamp and switch as the wire", () => {
  const program = file("seq", "PROGRAM Guarded\nMOTOR MAC140;\nVAR_INPUT Estop AT NOT IN2 : BOOL; END_VAR\n" +
    "STEP A: OWN ERROR; IF NOT Estop THEN NEXT := B; END_IF END_STEP\nSTEP B: OWN ERROR; IF Estop THEN NEXT := A; END_IF END_STEP\nEND_PROGRAM\n");
  return withMachine(program, {}, async (machine) => {
    const page = await openPage(machine.url);
    await painted(page);
    await inStep(page, 1);
    const row = page.locator("li", { has: page.locator('.signal-name[title="IN2"]') });
    assert.equal(await row.locator(".signal-name").textContent(), "NOT Estop");
    assert.equal(await row.locator(".lamp").textContent(), "0");
    assert.match(await textOf(page, ".card .badge >> nth=0"), /waits for NOT Estop/);
    await operate(page, machine.token);
    await page.click('.press[aria-label="switch NOT Estop"]');
    await inStep(page, 2);
    assert.equal(await row.locator(".lamp").textContent(), "1");
    assert.match(await textOf(page, ".card .badge >> nth=0"), /waits for Estop/);
    await page.selectOption('select[aria-label="force NOT Estop"]', "0");
    await inStep(page, 1);
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#sim-save")]);
    const recorded = readFileSync(await download.path(), "utf8");
    assert.match(recorded, /ms toggle Estop\nat [\d.]+ ms gateway force Estop := 1\n/);
    const wanted = `${recorded}expect at end step = A and IN2\n`;
    execFileSync(join(programs, "nanoplc-sim"), ["run", program, "--scenario", file("scn", wanted)], { encoding: "utf8" });
    assert.deepEqual(page.complaints, []);
    await page.context().close();
  });
});

test("hover and focus tell a step's terms in the program's names and units, and no longer than that", () =>
  withMachine(join(examples, "pick_and_place.seq"), {}, async (machine) => {
    const page = await openPage(machine.url);
    await painted(page);
    await inStep(page, 1);
    await page.hover('.box[data-step="0"]');
    await hasText(page, "#waits-title", "Step POWER_UP (not active)");
    await hasText(page, "#waits", "Place (P2) := 60 mm");
    await page.hover('.box[data-step="3"]');
    await hasText(page, "#waits", "POSITION(Home): 0 mm");
    await page.mouse.move(2, 2);
    await hasText(page, "#waits-title", "Active step: Idle");
    await page.focus("#search");
    for (let i = 0; i < 12 && !(await page.evaluate(() => document.activeElement.classList.contains("box"))); ++i) await page.keyboard.press("Tab");
    await page.keyboard.press("ArrowDown");
    await page.keyboard.press("ArrowDown");
    await hasText(page, "#waits-title", "(not active)");
    await page.keyboard.press("Tab");
    await hasText(page, "#waits-title", "Active step: Idle");
    assert.deepEqual(page.complaints, []);
    await page.context().close();
  }));

for (const name of readdirSync(examples).filter((n) => n.endsWith(".seq")).map((n) => n.replace(".seq", ""))) {
  test(`the picture follows ${name} through its scenario`, async () => {
    // Its own scenario without an end, in real time; the messages to another client give the expected values.
    const scenario = readFileSync(join(examples, `${name}.scn`), "utf8").replace(/^\s*end .*$/gm, "").replace(/^.*\bat end\b.*$/gm, "");
    await withMachine(join(examples, `${name}.seq`), { scenario }, async (machine) => {
      const client = new Client(machine.url);
      await client.opened;
      const page = await openPage(machine.url);
      await painted(page);
      const steps = () => client.messages.filter((m) => m.t === "image" && m.r?.STEP !== undefined).map((m) => m.r.STEP);
      // Three changes in those messages, or ten seconds of a program that rests.
      const since = client.messages.length;
      await Promise.race([
        client.until(() => client.messages.slice(since).filter((m) => m.t === "image" && m.r?.STEP !== undefined).length >= 3),
        page.waitForTimeout(8000),
      ]);
      // A step may be shorter than a frame: at some moment the page shows the last one of those messages.
      const end = Date.now() + 30_000;
      while (Number(await page.evaluate(() => document.body.dataset.step)) !== steps().at(-1)) assert.ok(Date.now() < end, "it never shows the active step");
      const program = client.messages.find((m) => m.t === "program");
      assert.equal(await textOf(page, "#program"), program.symbols.program);
      const numbers = new Set([...Buffer.from(program.table, "base64")].filter((_, i) => i % 8 === 0).map((b) => b & 63).filter((s) => s !== 63));
      const copies = program.symbols.steps.filter((step) => step.made_for?.startsWith("copy of "));
      assert.equal(await page.locator(".box").count(), numbers.size - copies.length);
      assert.deepEqual(page.complaints, []);
      client.close();
      await page.context().close();
    });
  });
}

const kBlinker = `PROGRAM Blinker
MOTOR MAC140;
VAR_INPUT Go AT IN0 : BOOL; Ack AT IN1 : BOOL; END_VAR
VAR_OUTPUT Lamp AT OUT0 : BOOL; Ready AT OUT1 : BOOL; END_VAR
ON ERROR NEXT := Fault;
POWER_UP NEXT := Wait; END_POWER_UP
STEP Wait: OUT Ready; OUT Lamp BLINKING T#300ms; IF R_TRIG(Go) THEN NEXT := Work; END_IF END_STEP
STEP Work: OUT Ready; IF Ack THEN NEXT := Wait; END_IF END_STEP
STEP Fault: OWN ERROR; IF ANY ERROR AND Ack THEN RESET_ERROR; NEXT := Wait; END_IF END_STEP
END_PROGRAM
`;

// Wait is 1; its copies are 4 (Lamp dark), 5 (Go was off) and 6 (both), as the compiler numbers them behind all steps.
test("a step that blinks and sees an edge is one box with all its copies", () =>
  withMachine(file("seq", kBlinker), {}, async (machine) => {
    const client = new Client(machine.url);
    await client.opened;
    const page = await openPage(machine.url);
    await painted(page);
    const boxes = () => page.$$eval(".box", (all) => all.map((box) => [box.dataset.step, box.querySelector(".name").textContent, box.querySelector(".number").textContent]));
    assert.deepEqual(await boxes(), [["0", "POWER_UP", "0"], ["1", "Wait", "1, 4–6 · Ready (Lamp)"], ["2", "Work", "2 · Ready"], ["3", "Fault", "3"]]);
    // Lit whichever copy is active.
    await page.waitForFunction(() => {
      const seen = (window.seen ??= new Set());
      const step = document.body.dataset.step;
      if (step !== "0") seen.add(`${step} ${[...document.querySelectorAll(".box.active")].map((box) => box.dataset.step)}`);
      return seen.has("5 1") && seen.has("6 1");
    });
    assert.deepEqual(await page.evaluate(() => [...window.seen].filter((one) => !one.endsWith(" 1"))), []);
    assert.match(await page.getAttribute('.box[data-step="1"]', "aria-label"), /^Wait 1, 4–6 · Ready \(Lamp\), with 3 copies, active$/);
    assert.equal(await page.getAttribute('.box[data-step="2"]', "aria-label"), "Work 2 · Ready");
    assert.equal(await textOf(page, "#drawing-words"), "Active step: Wait");
    // The branches are those of the active copy: only a copy that has seen Go off leads to Work.
    assert.equal(await textOf(page, "#waits-title"), "Active step: Wait");
    await hasText(page, "#waits .quiet", "copy of 'Wait' for: Go was off");
    await page.waitForFunction(() => [...document.querySelectorAll(".card")].some((card) => card.textContent.includes("→ Work") && card.querySelector(".chip.no")?.textContent.includes("Go")));
    await page.hover('.box[data-step="2"]');
    await hasText(page, "#waits-title", "Step Work (not active)");
    await hasText(page, "#waits", "→ Wait");
    await page.hover('.box[data-step="1"]');
    await hasText(page, "#waits-title", "Active step: Wait");
    await page.mouse.move(2, 2);
    // Found by the name and the number of a copy too.
    for (const text of ["wait_lamp_dark", "6", "Wait"]) {
      await page.fill("#search", text);
      assert.equal(await textOf(page, "#search-count"), "1 found");
      assert.equal(await page.getAttribute(".box.found", "data-step"), "1");
    }
    await page.fill("#search", "");
    // What was opened stays open while it blinks.
    await page.focus("#waits .term");
    const before = await page.evaluate(() => document.body.dataset.step);
    await page.waitForFunction((step) => document.body.dataset.step !== step, before);
    assert.ok(await page.evaluate(() => document.activeElement.classList.contains("term")), "the keyboard stays");
    // The last path is one of boxes, and blinking does not push it out.
    await operate(page, machine.token);
    const act = async (action) => {
      await page.fill("#sim-action", action);
      await page.click("#sim-form button");
    };
    await act("pulse Go 100 ms");
    await inStep(page, 2);
    await act("pulse Ack 100 ms");
    await page.waitForFunction(() => document.querySelector(".box.active")?.dataset.step === "1");
    await page.evaluate(() => (window.changes = { count: 0, last: "" }));
    await page.waitForFunction(() => {
      const step = document.body.dataset.step;
      if (step !== window.changes.last) window.changes = { count: window.changes.count + 1, last: step };
      return window.changes.count > 8;
    });
    assert.equal(await page.locator(".way.taken").count(), 2); // from Wait to Work and back
    // A breakpoint is one of all copies.
    await page.click('.box[data-step="1"]');
    await page.click("#break");
    const bits = (1 << 1) | (1 << 4) | (1 << 5) | (1 << 6);
    await client.until((m) => m.t === "image" && m.r?.BREAK_LOW === bits);
    await hasText(page, "#state-text", "held at a breakpoint");
    assert.match(await page.getAttribute('.box[data-step="1"]', "aria-label"), /, active, breakpoint$/);
    const since = client.messages.length;
    await page.click("#break");
    await client.until((m) => client.messages.indexOf(m) >= since && m.t === "image" && m.r?.BREAK_LOW === 0);
    await page.waitForFunction(() => !document.querySelector(".box.breaks"));
    assert.deepEqual(page.complaints, []);
    client.close();
    await page.context().close();
  }));

test("60 steps: laid out without boxes that overlap, found by name, followed", async () => {
  const steps = Array.from({ length: 60 }, (_, i) => `STEP S${i}:\n    ${i === 59 ? "OWN ERROR;\n    " : ""}ENTRY TIMER := T#${i % 7 === 0 ? 300 : 40}ms;\n    IF Go THEN NEXT := S${(i * 7 + 3) % 60}; ELSIF TIMER.Q THEN NEXT := S${(i + 1) % 60}; END_IF\nEND_STEP\n`);
  const program = file("seq", `PROGRAM Sixty\nMOTOR MAC140;\nVAR_INPUT Go AT %IX0.0 : BOOL; END_VAR\nON ERROR NEXT := S59;\nPOWER_UP NEXT := S0; END_POWER_UP\n${steps.join("")}END_PROGRAM\n`);
  await withMachine(program, {}, async (machine) => {
    const page = await openPage(machine.url);
    await painted(page);
    const boxes = await page.$$eval(".box", (all) => all.map((b) => b.getAttribute("transform").match(/[-\d.]+/g).map(Number)));
    assert.ok(boxes.length >= 60);
    for (const [i, a] of boxes.entries())
      for (const b of boxes.slice(0, i)) assert.ok(Math.abs(a[0] - b[0]) >= 150 || Math.abs(a[1] - b[1]) >= 46, `${a} and ${b} overlap`);
    // The active step stays in view.
    for (let i = 0; i < 5; ++i) {
      const before = await page.evaluate(() => document.body.dataset.step);
      await page.waitForFunction((b) => document.body.dataset.step !== b, before);
      await page.waitForFunction(() => {
        const box = document.querySelector(".box.active").getBoundingClientRect();
        const area = document.getElementById("drawing").getBoundingClientRect();
        return box.left >= area.left && box.right <= area.right && box.top >= area.top && box.bottom <= area.bottom;
      });
    }
    await page.click("#zoom-fit");
    const outside = () => page.evaluate(() => {
      const area = document.getElementById("drawing").getBoundingClientRect();
      return [...document.querySelectorAll(".box")].map((box) => box.getBoundingClientRect())
        .filter((b) => b.left < area.left || b.right > area.right || b.top < area.top || b.bottom > area.bottom).length;
    });
    assert.equal(await outside(), 0, "all of it is seen");
    await page.setViewportSize({ width: 900, height: 900 });
    await page.waitForFunction((width) => document.getElementById("drawing").clientWidth < width, 700);
    await page.waitForTimeout(300); // longer than a frame: the size is reported after it
    assert.equal(await outside(), 0, "in another size too");
    await page.setViewportSize({ width: 1440, height: 1000 });
    await page.fill("#search", "S42");
    assert.equal(await textOf(page, "#search-count"), "1 found");
    await page.press("#search", "Enter");
    await hasText(page, "#waits-title", "S42");
    await page.click("#zoom-fit");
    await page.press("#search", "Enter");
    await page.waitForFunction(() => document.querySelector('.box.selected').getBoundingClientRect().width >= 70, null); // large enough to read
    await page.context().close();
  });
});

test("the server is killed and started again: the page says so and comes back by itself", async () => {
  const program = join(examples, "pick_and_place.seq");
  let machine = await simulator(program, { scenario: kCycle });
  const port = new URL(machine.url).port;
  const page = await openPage(machine.url);
  await painted(page);
  machine.child.kill("SIGKILL");
  await machine.ended;
  await hasText(page, "#link-bar", "connection is lost");
  assert.match(await page.evaluate(() => document.body.className), /old/);
  assert.match(await textOf(page, "#state-text"), /\(old\)$/);
  assert.match(await page.title(), /\(old\)$/);
  await hasText(page, "#seat", "not known");
  await page.click("#do-stop");
  await hasText(page, "#notices", "there is no connection; nothing was sent. Not confirmed: the machine may still be running.");
  machine = await simulator(join(examples, "cut_to_length.seq"), { port });
  await painted(page);
  await page.waitForFunction(() => document.getElementById("link-bar").hidden);
  await hasText(page, "#program", "Cut_to_Length");
  await inStep(page, 1);
  const taken = await page.$$eval(".way.taken", (all) => all.length);
  assert.ok(taken <= 1, `${taken} ways: the path of the program before is not drawn into this one`);
  await page.click("#do-stop");
  await page.waitForFunction(() => document.querySelectorAll(".notice.alarm").length === 0);
  await machine.stop();
  await page.context().close();
});

test("a line that falls silent without an end: a stop says so, and the page comes back over a new one", () =>
  withMachine(join(examples, "pick_and_place.seq"), { scenario: kCycle }, async (machine) => {
    const line = await quietLine(machine.url);
    const page = await openPage(line.url);
    await painted(page);
    line.hush();
    await page.click("#do-stop");
    await hasText(page, "#notices", "No answer to stop yet: the machine may still be running.");
    await hasText(page, "#link-bar", "connection is lost");
    await hasText(page, "#notices", "whether it was done is not known");
    await painted(page);
    await page.waitForFunction(() => document.getElementById("link-bar").hidden);
    assert.deepEqual(page.complaints, []);
    await page.context().close();
    line.close();
  }));

test("the motor's values are shown with their age once its line is cut, and leave a gap in the trend", () =>
  withMachine(join(examples, "pick_and_place.seq"), { scenario: kCycle }, async (machine) => {
    const page = await openPage(machine.url);
    await painted(page);
    await hasText(page, "#trend-now", "rpm");
    assert.doesNotMatch(await textOf(page, "#trend-now"), /old/);
    await operate(page, machine.token);
    await page.click("#sim-cut");
    await hasText(page, "#trend-now", "s old");
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#trend-tools >> text=CSV")]);
    assert.match(readFileSync(await download.path(), "utf8").trimEnd().split("\n").at(-1), /,,,$/);
    await page.click("#sim-cut");
    await page.waitForFunction(() => !document.getElementById("trend-now").textContent.includes("old"));
    // The motor answers, whether the sequence has acknowledged the loss or not.
    await hasText(page, "#fact-link", "not acknowledged");
    const end = Date.now() + 30_000;
    for (;;) {
      const [table] = await Promise.all([page.waitForEvent("download"), page.click("#trend-tools >> text=CSV")]);
      const rows = readFileSync(await table.path(), "utf8").trimEnd().split("\n");
      if (rows.slice(rows.findLastIndex((row) => row.endsWith(",,,")) + 1).some((row) => /^[\d.]+,Fault,-?\d/.test(row))) break;
      assert.ok(Date.now() < end, "the trend goes on with the motor's values");
    }
    assert.deepEqual(page.complaints, []);
    await page.context().close();
  }));

test("the trend has an axis for each of position, velocity and current, and reads each about as often", () =>
  withMachine(join(examples, "pick_and_place.seq"), { scenario: kCycle }, async (machine) => {
    const page = await openPage(machine.url);
    await painted(page);
    assert.equal(await page.locator("#trend .u-axis").count(), 4);
    await hasText(page, "#trend-now", "%");
    const counts = async () => {
      const [download] = await Promise.all([page.waitForEvent("download"), page.click("#trend-tools >> text=CSV")]);
      const lines = readFileSync(await download.path(), "utf8").trimEnd().split("\n").slice(1).map((line) => line.split(","));
      return [2, 3, 4].map((column) => lines.filter((line) => line[column] !== "").length);
    };
    const before = await counts();
    await page.waitForTimeout(6_000); // reads to count
    const [positions, velocities, currents] = (await counts()).map((count, i) => count - before[i]);
    // Without a page that draws the trend it is one current to four positions.
    assert.ok(currents >= 6 && 2 * currents > positions && 2 * velocities > positions, `${positions} positions, ${velocities} velocities, ${currents} currents`);
    assert.deepEqual(page.complaints, []);
    await page.context().close();
  }));

test("names as long as they may be stay in their boxes", async () => {
  const long = (i) => `Step_${i}_WITH_MANY_WIDE_LETTERS_MW`.slice(0, [15, 16, 17, 32][i]);
  const steps = Array.from({ length: 4 }, (_, i) => `STEP ${long(i)}:\n    ${i === 0 ? "OWN ERROR;\n    " : ""}OUT Left_gripper, Right_gripper, Warning_lamp;\n    IF Go THEN NEXT := ${long((i + 1) % 4)}; END_IF\nEND_STEP\n`);
  const program = file("seq", `PROGRAM Long\nMOTOR MAC140;\nVAR_INPUT Go AT %IX0.0 : BOOL; END_VAR\nVAR_OUTPUT Left_gripper AT %QX0.0 : BOOL; Right_gripper AT %QX0.1 : BOOL; Warning_lamp AT %QX0.2 : BOOL; END_VAR\nON ERROR NEXT := ${long(0)};\nPOWER_UP NEXT := ${long(0)}; END_POWER_UP\n${steps.join("")}END_PROGRAM\n`);
  await withMachine(program, {}, async (machine) => {
    const page = await openPage(machine.url);
    await painted(page);
    const sizes = await page.$$eval(".box", (all) => all.flatMap((box) => [...box.querySelectorAll("text")].map((t) => [t.textContent, t.getBBox().width, box.querySelector("rect").getBBox().width])));
    for (const [text, width, room] of sizes) assert.ok(width < room, `${text}: ${width} in ${room}`);
    await page.context().close();
  });
});

test("a program that is halted: data older than a second are shown as old", () =>
  withMachine(join(examples, "pick_and_place.seq"), { scenario: kCycle }, async (machine) => {
    const page = await openPage(machine.url);
    await painted(page);
    await halt(machine.child);
    await hasText(page, "#link-bar", "what you see is old");
    machine.child.kill("SIGCONT");
    await painted(page);
    await page.context().close();
  }));

test("who operates does so after a short halt of the program, and is not told that he took over from himself", () =>
  withMachine(join(examples, "pick_and_place.seq"), {}, async (machine) => {
    const page = await openPage(machine.url);
    await painted(page);
    await operate(page, machine.token);
    await halt(machine.child);
    await page.waitForTimeout(2500); // the page asks once a second to keep the seat
    machine.child.kill("SIGCONT");
    await painted(page);
    await page.click("#do-hold");
    await hasText(page, "#notices", "The sequence is held");
    assert.doesNotMatch(await textOf(page, "#notices"), /has taken over/);
    assert.match(await textOf(page, "#mode-text"), /OPERATING/);
    assert.deepEqual(page.complaints, []);
    await page.context().close();
  }));

test("a stop without an answer is told after a second, as the protocol asks of a client", () =>
  withMachine(join(examples, "pick_and_place.seq"), {}, async (machine) => {
    const page = await openPage(machine.url);
    await painted(page);
    await page.clock.install();
    await halt(machine.child);
    await page.click("#do-stop");
    await page.clock.runFor(1000);
    assert.match(await textOf(page, "#notices"), /No answer to stop yet: the machine may still be running/);
    machine.child.kill("SIGCONT");
    await page.context().close();
  }));

test("what waited while the program was halted is not carried out, a stop is", () =>
  withMachine(join(examples, "pick_and_place.seq"), { scenario: kCycle }, async (machine) => {
    const client = new Client(machine.url);
    const { axes } = await client.until((m) => m.t === "hello");
    const axis = axes[0].name;
    await client.ask({ do: "login", secret: machine.token });
    await client.ask({ do: "seat", axis });
    await client.ask({ do: "command", axis, name: "stop" });
    await halt(machine.child);
    const late = client.ask({ do: "command", axis, name: "run" });
    await new Promise((done) => setTimeout(done, 2000));
    machine.child.kill("SIGCONT");
    assert.equal((await late).result, "refused");
    assert.equal((await late).code, 19);
    await new Promise((done) => setTimeout(done, 300));
    assert.equal((await client.ask({ do: "command", axis, name: "run" })).result, "done");
    await halt(machine.child);
    const stop = client.ask({ do: "command", axis, name: "stop" });
    await new Promise((done) => setTimeout(done, 2000));
    machine.child.kill("SIGCONT");
    assert.equal((await stop).result, "done");
    client.close();
  }));

test("a tab that was suspended catches up", () =>
  withMachine(join(examples, "pick_and_place.seq"), { scenario: kCycle }, async (machine) => {
    const page = await openPage(machine.url);
    await painted(page);
    const session = await page.context().newCDPSession(page);
    await session.send("Page.setWebLifecycleState", { state: "frozen" });
    const client = new Client(machine.url);
    await client.opened;
    const since = client.messages.length;
    await client.until(() => client.messages.slice(since).filter((m) => m.t === "image" && m.r?.STEP !== undefined).length >= 4);
    await session.send("Page.setWebLifecycleState", { state: "active" });
    await painted(page);
    for (const step of [1, 2]) await inStep(page, step);
    client.close();
    await page.context().close();
  }));
