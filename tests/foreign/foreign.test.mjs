// The simulator's faces towards the plant, with programs of others: modbus-serial, sparkplug-payload with mqtt.
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { connect as dial, createServer } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";
import test from "node:test";

import Modbus from "modbus-serial";
import mqtt from "mqtt";
import sparkplug from "sparkplug-payload";

const { ROOT: root, PROGRAMS: programs } = process.env;
const { decodePayload, encodePayload } = sparkplug.get("spBv1.0");
const NOT_KNOWN = 11;

async function until(come, what) {
  for (let i = 0; i < 1200; ++i) {
    const found = await come();
    if (found) return found;
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
  throw new Error(`never came: ${what}`);
}

/** What the simulator prints up to "ready". */
async function simulateProgram(t, program, ...options) {
  const child = spawn(join(programs, "nanoplc-sim"), ["run", join(root, program), "--realtime", "--quiet", ...options]);
  t.after(() => child.kill());
  let said = "";
  for (const stream of [child.stdout, child.stderr]) stream.on("data", (data) => (said += data));
  await until(() => /^ready$/m.test(said), "ready");
  return said;
}

const simulate = (t, ...options) => simulateProgram(t, "tests/e2e/shuttle.seq", ...options);

/** The cutter with its set-points as declared, one changed, and both as recipes: 1 "Short" with 25.5 mm, 2 "Long" with 80 mm. */
async function simulateCutter(t, ...options) {
  const folder = mkdtempSync(join(tmpdir(), "cutter"));
  t.after(() => rmSync(folder, { recursive: true }));
  const port = join(folder, "port");
  const said = await simulateProgram(t, "tools/sequence/examples/cut_to_length.seq", "--mactalk", `unix:${port}`, ...options);
  const nanoctl = (...words) => execFileSync(join(programs, "nanoctl"), ["--port", `unix:${port}`, ...words]);
  nanoctl("stop");
  nanoctl("set-points", "set", "Length=25.5mm");
  nanoctl("recipe", "save", "Short");
  nanoctl("set-points", "set", "Length=80mm");
  nanoctl("recipe", "save", "Long");
  return said;
}

async function startBroker(t) {
  const free = createServer().listen(0, "127.0.0.1");
  await new Promise((resolve) => free.on("listening", resolve));
  const { port } = free.address();
  await new Promise((resolve) => free.close(resolve));
  const folder = mkdtempSync(join(tmpdir(), "broker"));
  writeFileSync(join(folder, "conf"), `listener ${port} 127.0.0.1\nallow_anonymous true\n`);
  const broker = spawn("mosquitto", ["-c", join(folder, "conf")]);
  t.after(() => {
    broker.kill();
    rmSync(folder, { recursive: true });
  });
  const answers = () =>
    new Promise((resolve) => {
      const line = dial(port, "127.0.0.1", () => resolve(true)).on("error", () => resolve(false));
      line.on("connect", () => line.end());
    });
  await until(answers, "the broker");
  return port;
}

test("modbus-serial runs, stops and reads it", async (t) => {
  const said = await simulate(t, "--modbus", "tcp:127.0.0.1:0");
  const master = new Modbus();
  t.after(() => master.close(() => {}));
  await master.connectTCP("127.0.0.1", { port: Number(/modbus: tcp:127\.0\.0\.1:(\d+)/.exec(said)[1]) });
  master.setID(1);
  const status = async (bit) => (await master.readDiscreteInputs(bit, 1)).data[0];
  await until(() => status(1), "running");
  await master.writeRegisters(0, [2, 0]); // stop; from here on another number carries a command out
  assert.equal(await status(4), true);
  await master.writeRegisters(0, [1, 7]); // run
  assert.deepEqual((await master.readInputRegisters(41, 2)).data, [7, 0]);
  await until(() => status(1), "running again");
  await master.writeCoil(1, true);
  assert.equal(await status(4), true);
  await assert.rejects(master.readInputRegisters(140, 1), { modbusCode: NOT_KNOWN }); // a MAC140 does not report a temperature
});

test("modbus-serial reads, changes and loads set-points", async (t) => {
  const said = await simulateCutter(t, "--modbus", "tcp:127.0.0.1:0");
  const master = new Modbus();
  t.after(() => master.close(() => {}));
  await master.connectTCP("127.0.0.1", { port: Number(/modbus: tcp:127\.0\.0\.1:(\d+)/.exec(said)[1]) });
  master.setID(1);
  const inputs = async (address, count) => (await master.readInputRegisters(address, count)).buffer;
  const text = (bytes) => bytes.toString("latin1").replace(/\0+$/, "");
  await until(async () => text(await inputs(828, 8)) === "Long", "the second recipe");
  assert.equal((await inputs(202, 1)).readUInt16BE(), 0); // none has been loaded
  const length = async () => (await inputs(210, 2)).readInt32BE();
  assert.equal(text(await inputs(316, 16)), "Length");
  assert.equal(text(await inputs(310, 6)), "mm");
  assert.deepEqual([(await inputs(300, 2)).readInt32BE(), (await inputs(302, 2)).readInt32BE(), (await inputs(308, 1)).readUInt16BE()], [100, 2000, 1]);
  assert.equal(text(await inputs(820, 8)), "Short");
  let number = 0;
  const order = async (command, ...words) => {
    await master.writeRegisters(0, [command, ++number, ...words]);
    const [done, result, detail] = (await master.readInputRegisters(41, 3)).data;
    assert.equal(done, number);
    return [result, detail];
  };
  await master.writeRegisters(0, [2, 0]); // a stop; from here on another number carries a command out
  assert.deepEqual(await order(34, 0, 0, 0, 0, 0, 1234), [0, 0]); // 123.4 mm
  assert.equal(await length(), 1234);
  assert.deepEqual(await order(34, 0, 0, 0, 0, 0, 2001), [23, 0]); // 200.1 mm is out of the range of number 0
  assert.equal(await length(), 1234);
  await master.writeRegister(4, 1);
  assert.deepEqual(await order(35), [0, 0]);
  assert.equal(await length(), 255);
  assert.equal((await inputs(202, 1)).readUInt16BE(), 1);
});

test("sparkplug-payload changes set-points and loads recipes", async (t) => {
  const port = await startBroker(t);
  const host = await mqtt.connectAsync(`mqtt://127.0.0.1:${port}`);
  t.after(() => host.end(true));
  const view = { names: new Map(), values: new Map() };
  host.on("message", (topic, bytes) => {
    const [, , type, , device] = topic.split("/");
    if (device === undefined || type === "DCMD") return;
    for (const { name, alias, value, isNull } of decodePayload(bytes).metrics) {
      if (name) view.names.set(String(alias), name);
      view.values.set(view.names.get(String(alias)), isNull ? null : value);
    }
  });
  await host.subscribeAsync("spBv1.0/#");
  await simulateCutter(t, "--mqtt", `127.0.0.1:${port}`);
  const shows = (name, value) => until(() => Number(view.values.get(name)) === value, `${name} ${value}`);
  const tell = (name, type, value) => {
    const timestamp = Date.now();
    const payload = Buffer.from(encodePayload({ timestamp, metrics: [{ name, type, value, timestamp }] }));
    return host.publishAsync("spBv1.0/nanoplc/DCMD/sim/sim", payload, { qos: 1 });
  };
  await shows("Set Points/Recipe", 0);
  await shows("Set Points/Length", 80);
  await tell("Set Points/Length", "Double", 123.4);
  await shows("Set Points/Length", 123.4);
  await tell("Set Points/Length", "Double", 200.1);
  await until(() => /^Length: .*10 mm to 200 mm/.test(view.values.get("Command/text")), "what was wrong, with the limits");
  assert.equal(view.values.get("Set Points/Length"), 123.4);
  await tell("Set Points/Recipe", "Int64", 1);
  await shows("Set Points/Length", 25.5);
  await shows("Set Points/Recipe", 1);
});

test("sparkplug-payload reads births and data, and commands", async (t) => {
  const port = await startBroker(t);
  const host = await mqtt.connectAsync(`mqtt://127.0.0.1:${port}`);
  t.after(() => host.end(true));
  const heard = [];
  host.on("message", (topic, bytes) => heard.push({ type: topic.split("/")[2], topic, payload: decodePayload(bytes) }));
  await host.subscribeAsync("spBv1.0/#");
  await simulate(t, "--mqtt", `127.0.0.1:${port}`);
  const birth = await until(() => heard.find(({ type }) => type === "NBIRTH"), "the node's birth");
  assert.equal(birth.topic, "spBv1.0/nanoplc/NBIRTH/sim");
  assert.equal(Number(birth.payload.seq), 0);
  assert.equal(birth.payload.metrics.find(({ name }) => name === "Node Control/Rebirth").value, false);
  const born = await until(() => heard.find(({ type }) => type === "DBIRTH"), "the device's birth");
  const metric = (name) => born.payload.metrics.find((one) => one.name === name);
  assert.equal(metric("position").type, "Double");
  assert.equal(metric("position").properties.engUnit.value, "rev");
  assert.equal(metric("position").metadata.description, "P_IST");
  assert.equal(metric("running").type, "Boolean");
  assert.equal(metric("temperature").value, null);
  assert.equal(metric("step").type, "Int64");
  const now = (name) => {
    const { alias } = metric(name);
    const values = heard.filter(({ type }) => /^D(BIRTH|DATA)$/.test(type)).flatMap(({ payload }) => payload.metrics);
    return values.filter((one) => String(one.alias) === String(alias)).at(-1).value;
  };
  await until(() => now("running") === true, "running");
  const command = (name) => {
    const timestamp = Date.now();
    const metrics = [{ name, type: "Boolean", value: true, timestamp }];
    return host.publishAsync("spBv1.0/nanoplc/DCMD/sim/sim", Buffer.from(encodePayload({ timestamp, metrics })), { qos: 1 });
  };
  await command("Command/stop");
  await until(() => now("safe") === true, "the stop");
  await command("Command/run");
  await until(() => now("running") === true, "the run");
});
