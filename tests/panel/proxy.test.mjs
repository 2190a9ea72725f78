// Beyond this machine: `nanoplc` behind the TLS proxy of the README, its example taken from there and run.
import assert from "node:assert/strict";
import { execFileSync, spawn, spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, test } from "node:test";
import { Client, closeBrowser, file, freePort, hasText, openBrowser, openPage, path, root, withService } from "./machine.mjs";

after(closeBrowser);

const nginx = ["/usr/sbin/nginx", "/usr/bin/nginx"].find((name) => spawnSync(name, ["-v"]).status === 0);

/** The README's server block with this run's ports and certificate, in as much of a configuration as nginx needs. */
function configuration(panel, port, certificate, key) {
  const text = readFileSync(join(root, "firmware", "faces", "panel", "README.md"), "utf8");
  const block = text.split("\n").filter((line) => line.startsWith("    ")).join("\n").match(/ {4}server \{[^]*?\n {4}\}/)[0];
  const replaced = block.replace("listen 443 ssl", `listen 127.0.0.1:${port} ssl`).replace("/etc/ssl/cell4.pem", certificate).replace("/etc/ssl/private/cell4.key", key)
    .replace("http://127.0.0.1:8080", panel);
  for (const gone of ["443 ssl", "/etc/ssl", ":8080"]) assert.ok(!replaced.includes(gone), gone);
  const folders = ["client_body", "proxy", "fastcgi", "uwsgi", "scgi"].map((name) => `${name}_temp_path ${path(name)};`).join(" ");
  return `daemon off; pid ${path("nginx.pid")}; error_log stderr;\nevents {}\nhttp { access_log off; ${folders}\n${replaced}\n}\n`;
}

test("the README's proxy: TLS outside, the page and its wire inside, stops without a login", { skip: nginx ? false : "nginx is missing: apt-get install nginx-light" }, async () => {
  const [key, certificate] = [path("cell4.key"), path("cell4.pem")];
  execFileSync("openssl", ["req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2", "-subj", "/CN=cell4.example", "-addext", "subjectAltName=DNS:cell4.example", "-keyout", key, "-out", certificate], { stdio: "ignore" });
  const token = file("token", "operate-this-machine\n");
  const password = file("password", "watch-this-machine\n");
  await withService(`token_file = "${token}"\npassword_file = "${password}"\nhosts = ["cell4.example"]`, async ({ url }) => {
    const port = await freePort();
    const proxy = spawn(nginx, ["-c", file("conf", configuration(url.slice(0, -1), port, certificate, key))]);
    let said = "";
    proxy.stderr.on("data", (data) => (said += data));
    try {
      const outside = `https://cell4.example:${port}/`;
      for (;;) {
        if (spawnSync("curl", ["-sk", "--resolve", `cell4.example:${port}:127.0.0.1`, outside]).status === 0) break;
        assert.equal(proxy.exitCode, null, said);
        await new Promise((later) => setTimeout(later, 50));
      }
      await openBrowser(["--host-resolver-rules=MAP cell4.example 127.0.0.1"]);
      const page = await openPage(outside, { ignoreHTTPSErrors: true });
      await page.waitForSelector("#token-dialog[open]");
      await page.click("#token-dialog [data-stop=stop]"); // needs no login
      for (const axis of ["x", "y"]) await hasText(page, "#notices", `${axis}: Stopped`);
      await page.click("#mode");
      await page.fill("#token", "watch-this-machine");
      await page.click("#token-form button[type=submit]");
      await hasText(page, "#state-text", "stopped: stop command");
      await hasText(page, "#program", "PickAndPlace");
      assert.deepEqual(page.complaints, []);
      await page.context().close();
      // Another name at the proxy is none of ours.
      const other = spawnSync("curl", ["-sk", "-o", "/dev/null", "-w", "%{http_code}", "-H", "Host: other.example", `https://127.0.0.1:${port}/`]);
      assert.equal(other.stdout.toString(), "403");
      const client = new Client(`https://127.0.0.1:${port}/`, { rejectUnauthorized: false, headers: { Host: "cell4.example", Origin: "https://other.example" } });
      await assert.rejects(client.opened);
    } finally {
      proxy.kill();
      await new Promise((later) => proxy.on("exit", later));
    }
  });
});
