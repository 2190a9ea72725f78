"use strict";

// The extension's own code in Node, against a thin stand-in of the vscode module, with the real seqc and nanoplc-sim.
//   SEQC=... SIMULATOR=... EXAMPLES=... node --test test/

const assert = require("node:assert");
const { execFileSync, spawn } = require("node:child_process");
const fs = require("node:fs");
const Module = require("node:module");
const os = require("node:os");
const path = require("node:path");
const test = require("node:test");

const vscode = require("./vscode");
const load = Module._load;
Module._load = (request, ...more) => (request === "vscode" ? vscode : load(request, ...more));

const { GraphView, stepAt } = require("../src/graph");
const { LiveView } = require("../src/live");
const { ScenarioTests, failuresIn, programOf } = require("../src/scenarios");
const commands = require("../src/commands");
const { configurations, rehearsalOf } = require("../src/configurations");

const { SEQC, SIMULATOR, EXAMPLES } = process.env;
const program = path.join(EXAMPLES, "pick_and_place.seq");
const uri = vscode.Uri.file(program).toString();

/** A question to a server of its own. */
function ask(command, ...parameters) {
    return new Promise((resolve, reject) => {
        const server = spawn(SEQC, ["lsp"]);
        const send = (message) => {
            const text = JSON.stringify({ jsonrpc: "2.0", ...message });
            server.stdin.write(`Content-Length: ${Buffer.byteLength(text)}\r\n\r\n${text}`);
        };
        let output = "";
        server.stdout.on("data", (part) => {
            output += part;
            const at = output.indexOf('{"id":2');
            const end = at < 0 ? -1 : output.indexOf("Content-Length", at);
            const whole = at < 0 ? "" : output.slice(at, end < 0 ? undefined : end);
            try {
                const answer = JSON.parse(whole);
                server.kill();
                if (answer.error) reject(new Error(answer.error.message));
                else resolve(answer.result);
            } catch {
                // more is to come
            }
        });
        send({ id: 1, method: "initialize", params: { capabilities: {}, initializationOptions: { verify: false } } });
        const text = fs.readFileSync(program, "utf8");
        send({ method: "textDocument/didOpen", params: { textDocument: { uri, languageId: "seqc", version: 1, text } } });
        send({ id: 2, method: "workspace/executeCommand", params: { command, arguments: parameters } });
    });
}

test("the graph follows the cursor", async () => {
    const view = new GraphView(ask);
    await view.show(uri);
    const panel = vscode.told.panels.at(-1);
    assert.match(panel.webview.html, /<svg/);
    const text = fs.readFileSync(program, "utf8");
    const line = text.slice(0, text.indexOf("ENTRY POSITION(Place)")).split("\n").length - 1;
    const editor = { document: { uri: vscode.Uri.file(program) }, selection: { active: { line } } };
    vscode.selection.fire({ textEditor: editor });
    assert.deepStrictEqual(panel.webview.sent.at(-1), { step: "Travel" });
});

test("before the first step there is none", () => {
    assert.strictEqual(stepAt([{ name: "A", line: 3 }], 2), undefined);
});

test("a step is sought in the file in which the cursor is", () => {
    const steps = [{ name: "A", line: 3, uri: "file:///a.seq" }, { name: "B", line: 1, uri: "file:///b.seqi" }];
    assert.strictEqual(stepAt(steps, 5, "file:///a.seq").name, "A");
    assert.strictEqual(stepAt(steps, 5, "file:///b.seqi").name, "B");
    assert.strictEqual(stepAt(steps, 0, "file:///b.seqi"), undefined);
});

test("scenarios are tests, and a failed expectation is told at its line", async () => {
    const folder = fs.mkdtempSync(path.join(os.tmpdir(), "seqc-vscode-"));
    fs.copyFileSync(program, path.join(folder, "pick_and_place.seq"));
    fs.copyFileSync(path.join(EXAMPLES, "pick_and_place.scn"), path.join(folder, "pick_and_place.scn"));
    fs.writeFileSync(path.join(folder, "pick_and_place-wrong.scn"), "# wrong\nnever Lamp from 100 ms\nend at 1 s\n");
    vscode.files = ["pick_and_place.scn", "pick_and_place-wrong.scn"].map((name) => vscode.Uri.file(path.join(folder, name)));
    const tests = new ScenarioTests(() => SIMULATOR);
    await tests.find();
    await tests.run({}, { isCancellationRequested: false, onCancellationRequested() {} });
    const seen = (what) => vscode.told.tests.filter((one) => one.what === what);
    assert.deepStrictEqual(seen("passed").map((one) => one.label), ["pick_and_place.scn"]);
    assert.strictEqual(seen("failed")[0].label, "pick_and_place-wrong.scn");
    assert.strictEqual(seen("failed")[0].messages[0].location.place.line, 1);
    assert.strictEqual(programOf(vscode.files[1].fsPath), path.join(folder, "pick_and_place.seq"));
    fs.rmSync(folder, { recursive: true });
    assert.deepStrictEqual(failuresIn("nothing"), []);
});

test("commands start the adapter with what they are given", async () => {
    const said = [];
    commands.register({ ask, graph: { show: (shown) => said.push(shown) }, setting: () => "" });
    await vscode.told.commands["seqc.rehearse"](uri, "file:///a/b.scn");
    assert.deepStrictEqual(vscode.told.debugging.at(-1), { type: "seqc", request: "launch", name: "Rehearse", program, scenario: "/a/b.scn" });
    await vscode.told.commands["seqc.graph"](uri);
    assert.deepStrictEqual(said, [uri]);
    await vscode.told.commands["seqc.verify"](uri);
    assert.match(vscode.told.messages.at(-1), /Nothing is broken/);
});

test("the active step is marked, and its names have values", () => {
    const view = new LiveView();
    const lines = ["STEP A:", "    IF Start AND TIMER.Q THEN NEXT := B; END_IF", "END_STEP", "STEP B:"];
    const marks = [];
    const values = [];
    const document = { uri: { fsPath: "/p.seq" }, lineCount: lines.length, lineAt: (number) => ({ text: lines[number] }) };
    vscode.window.visibleTextEditors = [{ document, setDecorations: (type, ranges) => (type === view.mark ? marks : values).push(ranges) }];
    const parts = [{ text: "Start", holds: true }, { text: "TIMER.Q", holds: false }];
    const conditions = [{ line: 2, text: "Start AND TIMER.Q", holds: false, parts }];
    vscode.custom.fire({ event: "seqc/state", body: { name: "A", line: 1, state: "running", conditions }, session: { configuration: { program: "/p.seq" } } });
    assert.strictEqual(marks.at(-1)[0].start.line, 0);
    assert.strictEqual(values.at(-1)[0].range.start.line, 1);
    assert.match(values.at(-1)[0].renderOptions.after.contentText, /^\u2717 Start 1, TIMER\.Q 0$/);
    const context = { stoppedLocation: { start: { line: 0 } } };
    const names = view.provideInlineValues(document, { end: { line: 3 } }, context).map((value) => value.expression);
    assert.ok(names.includes("Start") && names.includes("TIMER.Q") && !names.includes("STEP B"));
    vscode.ended.fire();
    assert.deepStrictEqual([marks.at(-1), values.at(-1)], [[], []]);
});

test("what a launch configuration leaves open comes from the settings and the file", async () => {
    const provider = configurations((name) => (name === "endpoint" ? "pty:/tmp/g" : ""));
    const attach = { type: "seqc", request: "attach", name: "G", program: "/p.seq" };
    assert.strictEqual((await provider.resolveDebugConfigurationWithSubstitutedVariables(undefined, attach)).endpoint, "pty:/tmp/g");
    const own = { ...attach, endpoint: "unix:/a" };
    assert.strictEqual((await provider.resolveDebugConfigurationWithSubstitutedVariables(undefined, own)).endpoint, "unix:/a");
    const unnamed = await configurations(() => "").resolveDebugConfigurationWithSubstitutedVariables(undefined, attach);
    assert.strictEqual(unnamed, undefined);
    assert.match(vscode.told.messages.at(-1), /seqc\.endpoint/);
    const scenario = program.replace(".seq", ".scn");
    for (const file of [program, scenario]) {
        assert.deepStrictEqual(rehearsalOf(file), { type: "seqc", request: "launch", name: "Rehearse", program, scenario });
    }
    assert.strictEqual(rehearsalOf("/a/none.seq").stopOnEntry, true);
    assert.strictEqual(rehearsalOf("/a/b.txt"), undefined);
});

test("a machine is started with a question and stopped without", async () => {
    const asked = [];
    commands.register({ ask, graph: {}, setting: () => "" });
    await vscode.told.commands["seqc.stop"]();
    assert.match(vscode.told.messages.at(-1), /no gateway is attached/);
    vscode.debug.activeDebugSession = { type: "seqc", configuration: { request: "attach" }, customRequest: async (name) => asked.push(name) };
    await vscode.told.commands["seqc.run"]();  // nobody answers
    assert.match(vscode.told.messages.at(-1), /may move/);
    await vscode.told.commands["seqc.stop"]();
    assert.deepStrictEqual(asked, ["seqc/stop"]);
    vscode.debug.activeDebugSession = undefined;
});

test("the grammar colours each word of the language", () => {
    const grammar = fs.readFileSync(path.join(__dirname, "../syntaxes/seqc.tmLanguage.json"), "utf8");
    const text = fs.readFileSync(path.join(__dirname, "../../../LANGUAGE.md"), "utf8");
    const rules = text.slice(text.indexOf("    program     ="), text.indexOf("How characters make tokens"));
    const words = new Set([...rules.matchAll(/"([A-Z_]{2,})"/g)].map((found) => found[1]));
    assert.ok(words.size > 50);
    const missing = [...words].filter((word) => !new RegExp(`[(|]${word}[)|]`).test(grammar));
    assert.deepStrictEqual(missing, []);
});

test("the package is what the server and the adapter are called", () => {
    const manifest = JSON.parse(fs.readFileSync(path.join(__dirname, "../package.json"), "utf8"));
    assert.ok(execFileSync(SEQC, ["--help"], { encoding: "utf8" }).includes("lsp"));
    assert.strictEqual(manifest.contributes.debuggers[0].type, "seqc");
});
