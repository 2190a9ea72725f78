// What clients of the panel cost the service `nanoplc`: its memory, and the scan's regularity.
import { spawn } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { Client, file, root, withService } from "./machine.mjs";

const kMany = 20;
const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
const resident = (pid) => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${pid}/status`, "utf8"))[1]);

/** An order every 20 ms. */
const kTicks = "PROGRAM Ticks\nMOTOR MAC140;\nVAR_MOTOR A AT P1 := 0; B AT P2 := 0; END_VAR\nON ERROR NEXT := Fault;\nPOWER_UP NEXT := Tick; END_POWER_UP\n"
  + "STEP Tick: ENTRY TIMER := T#20ms; ENTRY POSITION(A); IF TIMER.Q THEN NEXT := Tock; END_IF END_STEP\n"
  + "STEP Tock: ENTRY TIMER := T#20ms; ENTRY POSITION(B); IF TIMER.Q THEN NEXT := Tick; END_IF END_STEP\n"
  + "STEP Fault: OWN ERROR; IF ANY ERROR THEN RESET_ERROR; NEXT := Tick; END_IF END_STEP\nEND_PROGRAM\n";

async function open(url, count) {
  const clients = Array.from({ length: count }, () => new Client(url));
  await Promise.all(clients.map((client) => client.opened));
  for (const client of clients) client.messages.push = () => 0; // nothing is kept here
  return clients;
}

export async function memory() {
  await withService("", async ({ url, service }) => {
    console.log(`no client: ${resident(service.pid)} kB`);
    const first = await open(url, 1);
    await pause(5000);
    console.log(`1 client: ${resident(service.pid)} kB`);
    const others = await open(url, kMany - 1);
    await pause(5000);
    console.log(`${kMany} clients: ${resident(service.pid)} kB`);
    for (const client of [...first, ...others]) client.close();
  });
}

const quantile = (list, q) => [...list].sort((a, b) => a - b)[Math.min(list.length - 1, Math.floor(list.length * q))];

/** What the gateway sent to the motor, each with its time in seconds. */
function tapOf(sent) {
  return (link, line, children) => new Promise((resolve) => {
    const relay = spawn("python3", ["-B", join(root, "tests", "panel", "line_relay.py"), link, line]);
    children.push(relay);
    createInterface({ input: relay.stdout }).on("line", (text) => {
      if (text === "ready") return resolve();
      const [time, bytes] = text.split(" ");
      sent.push([Number(time), bytes]);
    });
  });
}

/** From one step's order to the next one's: 20 ms of the timer, and what the scan and the line add. */
function periods(sent) {
  const kPosition = /^(40|41|c0|c1)/; // select P1 or P2 with or without the toggle bit; each order is sent twice
  const positions = sent.filter(([, bytes]) => kPosition.test(bytes));
  const orders = positions.filter(([, bytes], i) => i === 0 || bytes.slice(0, 2) !== positions[i - 1][1].slice(0, 2)).map(([time]) => time);
  return orders.slice(1).map((time, i) => (time - orders[i]) * 1000).filter((period) => period < 100);
}

/** In turns with no client, with one and with 20, so that other work on this machine falls on all. */
async function ordersBesideClients(control) {
  const program = file("seq", kTicks);
  const sent = [];
  const found = new Map();
  await withService("", async ({ url }) => {
    const first = new Client(url);
    await first.opened;
    await first.until((m) => m.t === "image" && [1, 2].includes(m.r?.STEP)); // it runs by itself
    first.close();
    for (let turn = 0; turn < Number(process.env.TURNS ?? 12); ++turn) {
      const count = [0, 1, kMany][turn % 3];
      const clients = await open(url, count);
      await pause(2500); // the motor's values are read for a while after the last client
      sent.length = 0;
      await pause(5000);
      found.set(count, [...(found.get(count) ?? []), ...periods(sent)]);
      for (const client of clients) client.close();
    }
  }, { axes: { x: program }, control, tap: tapOf(sent) });
  for (const [count, list] of found) {
    const [early, half, late, last] = [0.05, 0.5, 0.95, 0.99].map((q) => quantile(list, q).toFixed(2));
    console.log(`  ${count} clients: ${list.length} orders, half of them ${half} ms after the one before, 5 % to 95 %: ${early} to ${late}, 99 %: ${last}`);
  }
}

export async function jitter() {
  console.log("the service alone (motor_period = 0: the motor's values are not read)");
  await ordersBesideClients("motor_period = 0");
  console.log("as configured (motor_period = 100: position and velocity for the trend, on the line that the orders take)");
  await ordersBesideClients("motor_period = 100");
}
