"use strict";

const { execFile } = require("node:child_process");
const fs = require("node:fs");
const path = require("node:path");
const vscode = require("vscode");

/** The .seq in a scenario's folder whose name its name begins with, or the only one. */
function programOf(scenario) {
    const folder = path.dirname(scenario);
    const programs = fs.readdirSync(folder).filter((name) => name.endsWith(".seq"));
    const stem = path.basename(scenario, ".scn");
    const fitting = programs.filter((name) => stem.startsWith(path.basename(name, ".seq"))).sort((a, b) => b.length - a.length);
    const chosen = fitting[0] || (programs.length === 1 ? programs[0] : undefined);
    return chosen && path.join(folder, chosen);
}

/** Failures as `nanoplc-sim run` prints them: FILE:LINE: expected: ...; seen: ... */
function failuresIn(output) {
    return [...output.matchAll(/^\s*(.+?):(\d+): (expected: .*)$/gm)].map((found) => ({ line: Number(found[2]), text: found[3] }));
}

/** Scenarios in the testing view. */
class ScenarioTests {
    constructor(simulator) {
        this.simulator = simulator;
        this.controller = vscode.tests.createTestController("seqc", "NanoPLC scenarios");
        this.controller.createRunProfile("Run", vscode.TestRunProfileKind.Run, (request, token) => this.run(request, token), true);
        this.controller.createRunProfile("Rehearse", vscode.TestRunProfileKind.Debug, (request) => this.debug(request), true);
        this.controller.refreshHandler = () => this.find();
    }

    async find() {
        const files = await vscode.workspace.findFiles("**/*.scn");
        this.controller.items.replace(
            files.map((uri) => this.controller.createTestItem(uri.toString(), path.basename(uri.fsPath), uri)),
        );
    }

    chosen(request) {
        const items = [];
        if (request.include) items.push(...request.include);
        else this.controller.items.forEach((item) => items.push(item));
        return items.filter((item) => !(request.exclude || []).includes(item));
    }

    async run(request, token) {
        const run = this.controller.createTestRun(request);
        for (const item of this.chosen(request)) {
            if (token.isCancellationRequested) break;
            run.started(item);
            await this.runOne(run, item, token);
        }
        run.end();
    }

    runOne(run, item, token) {
        const program = programOf(item.uri.fsPath);
        if (program === undefined) {
            run.errored(item, new vscode.TestMessage("no program in this folder fits the scenario's name"));
            return Promise.resolve();
        }
        return new Promise((resolve) => {
            const process = execFile(this.simulator(), ["run", program, "--scenario", item.uri.fsPath], (problem, output, errors) => {
                run.appendOutput((output + errors).replaceAll("\n", "\r\n"), undefined, item);
                if (!problem) run.passed(item);
                else if (problem.code === 1) run.failed(item, this.messages(item, output));
                else run.errored(item, new vscode.TestMessage(errors || problem.message));
                resolve();
            });
            token.onCancellationRequested(() => process.kill());
        });
    }

    messages(item, output) {
        return failuresIn(output).map(({ line, text }) => {
            const message = new vscode.TestMessage(text);
            message.location = new vscode.Location(item.uri, new vscode.Position(line - 1, 0));
            return message;
        });
    }

    async debug(request) {
        for (const item of this.chosen(request)) {
            await vscode.debug.startDebugging(undefined, {
                type: "seqc",
                request: "launch",
                name: item.label,
                program: programOf(item.uri.fsPath),
                scenario: item.uri.fsPath,
            });
        }
    }

    dispose() {
        this.controller.dispose();
    }
}

module.exports = { ScenarioTests, failuresIn, programOf };
