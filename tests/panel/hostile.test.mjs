// Pages of other sites, malformed messages, too many of everything.
import assert from "node:assert/strict";
import { createServer } from "node:http";
import { request } from "node:http";
import { join } from "node:path";
import { after, test } from "node:test";
import { spawnSync } from "node:child_process";
import { Client, closeBrowser, examples, hasText, openPage, painted, programs, simulator } from "./machine.mjs";

after(closeBrowser);

const pick = join(examples, "pick_and_place.seq");

async function withMachine(use) {
  const machine = await simulator(pick, { scenario: "every 2 s pulse Start 50 ms\n" });
  try {
    await use(machine);
  } finally {
    await machine.stop();
  }
}

/** The status of an answer to a bare request. */
const fetchStatus = (url, headers = {}, method = "GET") =>
  new Promise((resolve, reject) => {
    request(url, { headers, method }, (answer) => {
      answer.resume();
      resolve(answer);
    }).on("error", reject).end();
  });

test("a page of another origin reaches nothing", () =>
  withMachine(async (machine) => {
    const hostile = createServer((_, answer) => answer.setHeader("content-type", "text/html").end("<title>hostile</title>"));
    await new Promise((resolve) => hostile.listen(0, "127.0.0.1", resolve));
    const page = await openPage(`http://localhost:${hostile.address().port}/`);
    const outcome = await page.evaluate((url) => new Promise((resolve) => {
      const socket = new WebSocket(url.replace("http", "ws") + "live");
      socket.onopen = () => resolve("open");
      socket.onerror = () => resolve("refused");
    }), machine.url);
    assert.equal(outcome, "refused");
    assert.equal(await page.evaluate((url) => fetch(url).then(() => "read", () => "refused"), machine.url), "refused");
    await page.evaluate((url) => void document.body.append(Object.assign(document.createElement("iframe"), { src: url })), machine.url);
    const frame = await page.waitForSelector("iframe");
    assert.equal(await (await frame.contentFrame())?.$("#do-stop"), null);
    await page.context().close();
    hostile.close();
  }));

test("names that are not its own, origins, methods and paths", () =>
  withMachine(async (machine) => {
    const own = new URL(machine.url).host;
    assert.equal((await fetchStatus(machine.url)).statusCode, 200);
    assert.equal((await fetchStatus(machine.url, { host: "panel.attacker.example" })).statusCode, 403); // DNS rebinding
    assert.equal((await fetchStatus(machine.url, { host: own, origin: "http://attacker.example" })).statusCode, 403);
    assert.equal((await fetchStatus(machine.url, { host: own, origin: `http://${own}` })).statusCode, 200);
    assert.equal((await fetchStatus(machine.url, {}, "POST")).statusCode, 405);
    assert.equal((await fetchStatus(`${machine.url}../../etc/passwd`)).statusCode, 404);
    const headers = (await fetchStatus(machine.url)).headers;
    assert.match(headers["content-security-policy"], /default-src 'none'.*frame-ancestors 'none'/);
    assert.equal(headers["x-content-type-options"], "nosniff");
    const foreign = new Client(machine.url, { origin: "https://attacker.example" });
    foreign.closed.catch(() => {});
    await assert.rejects(foreign.opened);
  }));

test("1,000 malformed messages: answered or sent away, and the others feel nothing", () =>
  withMachine(async (machine) => {
    const page = await openPage(machine.url);
    await painted(page);
    const seed = Number(process.env.SEED ?? 24);
    console.log(`seed ${seed}`);
    let state = seed;
    const random = (below) => (state = (state * 1103515245 + 12345) % 2147483648) % below;
    const kinds = [
      () => "", () => "{", () => "null", () => "[]", () => `"${"x".repeat(random(2000))}"`, () => "[".repeat(1 + random(20000)),
      () => '{"id":1}', () => '{"id":-1,"do":"command","name":"run"}', () => '{"id":1e400,"do":"seat"}', () => '{"id":"1","do":{}}',
      () => `{"id":2,"do":"${"do".repeat(random(50))}"}`, () => '{"id":3,"do":"write","register":"COMMAND","value":1}',
      () => '{"id":4,"do":"write","register":999,"value":1}', () => '{"id":5,"do":"upload","table":"%%%%"}', () => '{"id":6,"do":"command","name":"run","axis":"nobody"}',
      () => '{"id":7,"do":"sim","speed":1e9}', () => "\u0000\u0001\ufffd", () => JSON.stringify({ id: 8, do: "motor_read", register: "P_IST\n" }),
    ];
    let sent = 0;
    while (sent < 1000) {
      const client = new Client(machine.url);
      await client.opened;
      let open = true;
      void client.closed.then(() => (open = false));
      while (open && sent < 1000) {
        client.socket.send(kinds[random(kinds.length)]());
        if (++sent % 20 === 0) await new Promise((resolve) => setImmediate(resolve));
      }
      client.close();
      await client.closed;
    }
    const tooLong = new Client(machine.url);
    await tooLong.opened;
    tooLong.socket.send(`{"id":1,"do":"${"x".repeat(70 * 1024)}"}`);
    assert.equal((await tooLong.closed).code, 1009);
    const binary = new Client(machine.url);
    await binary.opened;
    binary.socket.send(Buffer.from([1, 2, 3]));
    assert.equal((await binary.closed).code, 1003);
    await painted(page);
    assert.equal(await page.evaluate(() => document.getElementById("link-bar").hidden), true);
    await page.click("#do-stop");
    await hasText(page, "#state-text", "stopped");
    await page.context().close();
  }));

test("one client more than there are places takes the quietest one's; a stop is heard among all", () =>
  withMachine(async (machine) => {
    const clients = [];
    for (let i = 0; i < 33; ++i) {
      const client = new Client(machine.url);
      await client.opened;
      await client.until((m) => m.t === "hello");
      clients.push(client);
    }
    assert.equal((await clients[0].closed).code, 4001);
    assert.equal((await clients[32].ask({ do: "command", name: "stop" })).result, "done");
    for (const client of clients) client.close();
  }));

test("beyond this machine it is not served without a password and a token", () => {
  const run = spawnSync(join(programs, "nanoplc-sim"), ["run", pick, "--realtime", "--panel", "0.0.0.0:0"], { encoding: "utf8" });
  assert.equal(run.status, 2);
  assert.match(run.stderr, /a simulator has no password: write 127\.0\.0\.1:0/);
  for (const wrong of ["127.0.0.1", "127.0.0.1:99999", ":80", "nowhere:80"]) {
    const bad = spawnSync(join(programs, "nanoplc-sim"), ["run", pick, "--realtime", "--panel", wrong], { encoding: "utf8" });
    assert.equal(bad.status, 2, wrong);
    assert.equal(bad.stderr.trim().split("\n").filter((l) => /panel/.test(l)).length, 1, bad.stderr);
  }
});
