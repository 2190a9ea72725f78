// The real programs and a real browser, for the tests beside it. run.py names the folders: ROOT, PROGRAMS.
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { connect, createServer } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromium } from "playwright-core";
import { WebSocket } from "ws";

export const root = process.env.ROOT;
export const programs = process.env.PROGRAMS;
export const examples = join(root, "tools", "sequence", "examples");
const kLongest = 30_000; // until something is a failure

/** `promise`, unless it takes longer than anything may; `what` it is, then. */
function within(promise, what) {
  let timer;
  const late = new Promise((_, reject) => (timer = setTimeout(() => reject(new Error(`never came: ${what()}`)), kLongest)));
  return Promise.race([promise, late]).finally(() => clearTimeout(timer));
}

const children = new Set(); // of a test that failed before it stopped its own: they would keep this process alive

/** A program that prints what it serves and `ready`; `url` and `token` as it printed them. */
export async function start(name, args, options = {}) {
  const child = spawn(join(programs, name), args, { stdio: ["ignore", "pipe", "pipe"], ...options });
  children.add(child);
  child.on("exit", () => children.delete(child));
  const machine = { child, text: "", url: "", token: "", ended: new Promise((resolve) => child.on("exit", (code, signal) => resolve(code ?? signal))) };
  await within(new Promise((resolve, reject) => {
    const take = (data) => {
      machine.text += data;
      const url = /panel: (http:\S+)/.exec(machine.text)?.[1];
      const token = /token: (\S+)/.exec(machine.text)?.[1];
      if (!url || !token || !/^ready$/m.test(machine.text)) return;
      Object.assign(machine, { url, token });
      resolve();
    };
    child.stdout.on("data", take);
    child.stderr.on("data", take);
    child.on("exit", (code) => reject(new Error(`${name} ended with ${code}: ${machine.text}`)));
  }), () => `${name} is ready: ${machine.text}`);
  machine.stop = async () => {
    child.kill("SIGCONT");
    child.kill("SIGTERM");
    return machine.ended;
  };
  return machine;
}

const folder = mkdtempSync(join(tmpdir(), "panel-"));
process.on("exit", () => rmSync(folder, { recursive: true, force: true }));
let files = 0;

/** A file for this run of the tests. */
export function file(ending, text) {
  const path = join(folder, `${++files}.${ending}`);
  writeFileSync(path, text);
  return path;
}
export const path = (name) => join(folder, name);

/** Ends when all threads of the process stand: a signal takes its time, in which they go on. */
export async function halt(child) {
  child.kill("SIGSTOP");
  const tasks = `/proc/${child.pid}/task`;
  const stands = (task) => {
    const stat = readFileSync(join(tasks, task, "stat"), "latin1");
    return "Tt".includes(stat.slice(stat.lastIndexOf(")") + 2)[0]);
  };
  while (!readdirSync(tasks).every(stands)) await new Promise((done) => setTimeout(done, 5));
}

/** The simulator with an example, or a program of the test. `scenario`: text. */
export function simulator(program, { scenario, port = 0, more = [], cwd } = {}) {
  const args = ["run", program, "--realtime", "--quiet", "--panel", `127.0.0.1:${port}`, ...more];
  if (scenario) args.push("--scenario", file("scn", scenario));
  return start("nanoplc-sim", args, { cwd });
}

let browser = null;
export async function openBrowser(more = []) {
  browser ??= await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox", "--disable-gpu", ...more] });
  return browser;
}
export async function closeBrowser() {
  await browser?.close();
  browser = null;
  for (const child of children) child.kill("SIGKILL");
}

/** A page in a browser of its own; what it complains of fails the test at the end. */
export async function openPage(url, options = {}) {
  const context = await (await openBrowser()).newContext({ viewport: { width: 1440, height: 1000 }, acceptDownloads: true, ...options });
  const page = await context.newPage();
  page.setDefaultTimeout(kLongest);
  page.complaints = [];
  page.on("pageerror", (error) => page.complaints.push(error.message));
  page.on("console", (message) => {
    if (message.type() === "error" && !/WebSocket|ERR_CONNECTION/.test(message.text())) page.complaints.push(message.text());
  });
  await page.goto(url);
  return page;
}

/** Connected, and the first image painted. */
export const painted = (page) => page.waitForFunction(() => document.body.dataset.step !== undefined && !document.body.classList.contains("old"));

export async function operate(page, token) {
  await page.click("#mode");
  if (await page.locator("#token-dialog").isVisible()) {
    await page.fill("#token", token);
    await page.click("#token-form button[type=submit]");
  }
  await page.waitForFunction(() => document.body.classList.contains("operating"));
}

/** Pages of a simulated machine, in browsers of their own. */
export async function pagesOf(program, count, use, options = {}) {
  const machine = await simulator(program, options);
  const pages = [];
  try {
    for (let i = 0; i < count; ++i) pages.push(await openPage(machine.url));
    for (const page of pages) await painted(page);
    await use(machine, ...pages);
    for (const page of pages) assert.deepEqual(page.complaints, []);
  } finally {
    for (const page of pages) await page.context().close();
    await machine.stop();
  }
}

export const textOf = (page, selector) => page.locator(selector).innerText();
export const hasText = (page, selector, text) =>
  page.waitForFunction(([s, t]) => document.querySelector(s)?.textContent.includes(t), [selector, text])
    .catch(async (error) => {
      throw new Error(`${selector} never had "${text}"; it has "${await page.locator(selector).first().innerText()}"`, { cause: error });
    });
export const inStep = (page, step) => page.waitForFunction((s) => document.body.dataset.step === String(s), step);

/** The wire itself, as another client has it. */
export class Client {
  constructor(url, options) {
    this.messages = [];
    this.waiting = [];
    this.socket = new WebSocket(url.replace("http", "ws") + "live", options);
    this.closed = new Promise((resolve) => (this.socket.onclose = resolve));
    this.socket.onmessage = (event) => {
      const message = JSON.parse(event.data);
      this.messages.push(message);
      this.waiting = this.waiting.filter(({ wanted, resolve }) => !wanted(message) || void resolve(message));
    };
    this.opened = new Promise((resolve, reject) => {
      this.socket.onopen = resolve;
      this.socket.onerror = reject;
    });
    this.last = 0;
  }
  until(wanted) {
    const found = this.messages.find(wanted);
    if (found) return Promise.resolve(found);
    const heard = () => this.messages.slice(-5).map((m) => JSON.stringify(m).slice(0, 300)).join("\n");
    return within(new Promise((resolve) => this.waiting.push({ wanted, resolve })), () => `${wanted}; the last of ${this.messages.length} messages:\n${heard()}`);
  }
  ask(request) {
    const id = ++this.last;
    this.socket.send(JSON.stringify({ id, ...request }));
    return this.until((m) => m.t === "answer" && m.id === id);
  }
  close() {
    this.socket.close();
  }
}

export const freePort = () =>
  new Promise((resolve) => {
    const server = createServer().listen(0, "127.0.0.1", () => {
      const { port } = server.address();
      server.close(() => resolve(port));
    });
  });

/** The same server over a line of its own. `hush`: what is connected falls silent without an end, as if a cable was
    pulled; new connections are served. */
export async function quietLine(url) {
  const pairs = new Set();
  const server = createServer((socket) => {
    const other = connect(Number(new URL(url).port), "127.0.0.1");
    const pair = [socket, other];
    pairs.add(pair);
    socket.pipe(other);
    other.pipe(socket);
    for (const [one, rest] of [pair, [other, socket]]) one.on("error", () => {}).on("close", () => pairs.delete(pair) && rest.destroy());
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  return {
    url: `http://127.0.0.1:${server.address().port}/`,
    hush() {
      for (const pair of pairs) for (const one of pair) one.unpipe().pause();
      pairs.clear();
    },
    close: () => server.close(),
  };
}

const kAxes = { x: join(examples, "pick_and_place.seq"), y: join(examples, "fill_and_count.seq") };

/** `nanoplc` with a virtual motor and a program for each axis. `panel`: lines of [panel]; `control`: lines of
    [axis.control]; `tap`: between an axis and its motor; `user`: what a person's port is, unix or pty. */
export async function withService(panel, use, { axes: programOf = kAxes, control = "", tap, user = "unix" } = {}) {
  const folder = path(`service${Math.random().toString(36).slice(2)}`);
  mkdirSync(folder);
  const port = await freePort();
  const children = [];
  const axes = [];
  for (const [name, program] of Object.entries(programOf)) {
    const table = join(folder, `${name}.bin`);
    execFileSync(join(programs, "seqc"), ["build", program, "-o", table]);
    children.push(spawn(join(programs, "macsim"), ["--model", "MAC140", "--fastmac", `pty:${join(folder, `${name}.line`)}`, "--mactalk", `pty:${join(folder, `${name}.motor`)}`]));
    let text = "";
    await within(new Promise((resolve) => children.at(-1).stdout.on("data", (data) => /^ready$/m.test((text += data)) && resolve())), () => `macsim is ready: ${text}`);
    if (tap) await tap(join(folder, `${name}.tap`), join(folder, `${name}.line`), children);
    axes.push(`[[axis]]\nname = "${name}"\ntable = "${table}"\nsymbols = "${join(folder, `${name}.sym`)}"\n[axis.motor]\nport = "${join(folder, `${name}.${tap ? "tap" : "line"}`)}"\n[axis.user]\nport = "${user}:${join(folder, `${name}.port`)}"\n[axis.settings]\nmotor_silence = 200\npoll_limit = 1000000\n[axis.control]\n${control}\n`);
  }
  const config = file("toml", `[service]\nstate_directory = "${folder}/state"\n[panel]\nlisten = "127.0.0.1:${port}"\n${panel}\n${axes.join("")}`);
  const service = spawn(join(programs, "nanoplc"), ["--config", config]);
  let said = "";
  for (const stream of [service.stdout, service.stderr]) stream.on("data", (data) => (said += data));
  children.push(service);
  try {
    const url = `http://127.0.0.1:${port}/`;
    for (;;) {
      if (await fetch(url, { signal: AbortSignal.timeout(kLongest) }).then(() => true, () => false)) break;
      assert.equal(service.exitCode, null, said);
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
    await use({ url, folder, service, said: () => said });
  } finally {
    const ended = new Promise((resolve) => service.on("exit", resolve));
    service.kill("SIGTERM");
    await ended;
    for (const child of children) child.kill("SIGTERM");
  }
}
