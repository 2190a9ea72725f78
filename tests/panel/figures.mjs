// What the panel costs and how fast it is. Nothing is asserted but that a day leaves nothing behind.
//   run.py ROOT PROGRAMS BUILD --figure latency|memory|jitter|day
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { Client, closeBrowser, examples, file, openPage, painted, simulator } from "./machine.mjs";
import { jitter, memory } from "./figures_service.mjs";

const sorted = (list) => [...list].sort((a, b) => a - b);
const quantile = (list, q) => sorted(list)[Math.min(list.length - 1, Math.floor(list.length * q))];
const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
const resident = (pid) => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${pid}/status`, "utf8"))[1]);

/** Makes of any text of the same origin a page that takes the same wire and paints the step's number, and nothing else. */
const barePage = () => {
  document.body.replaceChildren(document.createElement("h1"));
  new WebSocket(`${location.origin.replace("http", "ws")}/live`).onmessage = (event) => {
    const message = JSON.parse(event.data);
    if (message.t !== "image" || message.r?.STEP === undefined) return;
    requestAnimationFrame(() => { document.body.firstChild.textContent = document.body.dataset.step = message.r.STEP; });
  };
};

/** Notes when a step was painted: the frame after the one that changed it has begun. */
function watchPaints(page) {
  return page.evaluate(() => {
    window.paints = [];
    let shown = document.body.dataset.step;
    const look = () => {
      const now = document.body.dataset.step;
      if (now !== shown) {
        shown = now;
        requestAnimationFrame(() => window.paints.push([Number(now), performance.timeOrigin + performance.now()]));
      }
      requestAnimationFrame(look);
    };
    look();
  });
}

/** From the request that switches the input to the frame that shows the step, on both pages in one run. */
async function latency() {
  const program = file("seq", "PROGRAM Edge\nMOTOR MAC140;\nVAR_INPUT Go AT %IX0.0 : BOOL; END_VAR\nON ERROR NEXT := Low;\nPOWER_UP NEXT := Low; END_POWER_UP\n"
    + "STEP Low: OWN ERROR; IF Go THEN NEXT := High; END_IF END_STEP\nSTEP High: IF NOT Go THEN NEXT := Low; END_IF END_STEP\nEND_PROGRAM\n");
  const machine = await simulator(program);
  const panel = await openPage(machine.url);
  await painted(panel);
  const bare = await openPage(`${machine.url}panel.css`);
  await bare.evaluate(barePage);
  await bare.waitForFunction(() => document.body.dataset.step !== undefined);
  const client = new Client(machine.url);
  await client.opened;
  await client.ask({ do: "login", secret: machine.token });
  for (const page of [panel, bare]) await watchPaints(page);
  const edges = [];
  for (let i = 0; i < 300; ++i) {
    await pause(150 + ((i * 37) % 101)); // no multiple of a frame or of an image
    edges.push([performance.timeOrigin + performance.now(), i % 2 === 0]);
    await client.ask({ do: "sim", action: `Go := ${i % 2 === 0 ? 1 : 0}` });
  }
  await pause(500);
  const delays = {};
  for (const [name, page] of [["panel", panel], ["bare page", bare]]) {
    const paints = await page.evaluate(() => window.paints);
    delays[name] = edges.map(([at], i) => paints.find(([, time]) => time > at && time < (edges[i + 1]?.[0] ?? Infinity))?.[1] - at);
    const missing = delays[name].filter(Number.isNaN).length;
    const list = delays[name].filter((d) => !Number.isNaN(d));
    console.log(`${name}: median ${quantile(list, 0.5).toFixed(1)} ms, p95 ${quantile(list, 0.95).toFixed(1)} ms of ${list.length} edges${missing ? `, ${missing} not painted before the next` : ""}`);
  }
  const more = delays.panel.map((d, i) => d - delays["bare page"][i]).filter((d) => !Number.isNaN(d));
  console.log(`the panel after the bare page: median ${quantile(more, 0.5).toFixed(1)} ms, p95 ${quantile(more, 0.95).toFixed(1)} ms`);
  client.close();
  await machine.stop();
}

/** 24 hours of the machine, a hundred times as fast, a page and a client looking on. */
async function day() {
  const machine = await simulator(join(examples, "pick_and_place.seq"), { scenario: "every 4 s pulse Start 50 ms\nevery 600 s pulse Guard 300 ms\nevery 600 s from 2 s pulse Ack 100 ms\n" });
  const page = await openPage(machine.url);
  await painted(page);
  const session = await page.context().newCDPSession(page);
  await session.send("Performance.enable");
  const client = new Client(machine.url);
  await client.opened;
  await client.ask({ do: "login", secret: machine.token });
  await client.ask({ do: "sim", speed: 100 });
  const rows = [];
  for (let hour = 1; hour <= Number(process.env.HOURS ?? 24); ++hour) {
    client.messages.length = 0; // of the client's own
    await client.until((m) => m.t === "sim" && m.ms >= hour * 3_600_000);
    await session.send("HeapProfiler.collectGarbage");
    const { metrics } = await session.send("Performance.getMetrics");
    const metric = (name) => metrics.find((m) => m.name === name).value;
    const row = { hour, service: resident(machine.child.pid), heap: Math.round(metric("JSHeapUsedSize") / 1024), nodes: metric("Nodes"), listeners: metric("JSEventListeners") };
    rows.push(row);
    console.log(`${hour} h: service ${row.service} kB, page ${row.heap} kB of objects, ${row.nodes} nodes, ${row.listeners} listeners`);
  }
  assert.deepEqual(page.complaints, []);
  const least = (list, name) => Math.min(...list.map((row) => row[name])); // what garbage there is comes and goes
  const [middle, end] = [rows.slice(rows.length / 2 - 3, rows.length / 2), rows.slice(-3)];
  for (const [name, slack] of [["service", 256], ["heap", 256], ["nodes", 200], ["listeners", 0]]) {
    const [before, after] = [least(middle, name), least(end, name)];
    assert.ok(after <= before * 1.02 + slack, `${name} grew from ${before} to ${after} in the second half of the day`);
  }
  client.close();
  await machine.stop();
}

const figures = { latency, memory, jitter, day };
await figures[process.argv[2]]();
await closeBrowser();
