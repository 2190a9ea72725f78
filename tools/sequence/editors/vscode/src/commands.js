"use strict";

const vscode = require("vscode");

function uriOf(given) {
    if (typeof given === "string") return given;
    if (given && given.scheme) return given.toString();
    return vscode.window.activeTextEditor && vscode.window.activeTextEditor.document.uri.toString();
}

function pathOf(uri) {
    return uri === undefined ? undefined : vscode.Uri.parse(uri).fsPath;
}

async function rehearse(program, scenario) {
    const configuration = { type: "seqc", request: "launch", name: "Rehearse", program: pathOf(uriOf(program)) };
    if (scenario) {
        configuration.scenario = pathOf(scenario);
    } else {
        configuration.stopOnEntry = true;
    }
    return vscode.debug.startDebugging(undefined, configuration);
}

/** In a terminal, where one sees what it asks and answers. */
async function upload(program, setting) {
    const endpoint =
        setting("endpoint") ||
        (await vscode.window.showInputBox({
            prompt: "The gateway: /dev/ttyUSB0, pty:PATH, unix:PATH or tcp:127.0.0.1:PORT",
        }));
    if (!endpoint) return;
    const file = pathOf(uriOf(program));
    const sure = await vscode.window.showWarningMessage(
        `Store ${file} in the gateway at ${endpoint}? It becomes active when the sequence is stopped and the motor stands still.`,
        { modal: true },
        "Upload",
    );
    if (sure !== "Upload") return;
    const table = file.replace(/\.seq$/, ".bin");
    const terminal = vscode.window.createTerminal("NanoPLC");
    terminal.show();
    const quoted = (text) => `'${text.replaceAll("'", "'\\''")}'`;
    terminal.sendText(
        `${quoted(setting("path") || "seqc")} build ${quoted(file)} -o ${quoted(table)} && ` +
            `${quoted(setting("nanoctl") || "nanoctl")} --port ${quoted(endpoint)} upload ${quoted(table)}`,
    );
}

async function verify(program, ask) {
    const report = await ask("seqc.verify.results", uriOf(program));
    const broken = report.results.filter((result) => result.level === "error");
    if (broken.length === 0) {
        vscode.window.showInformationMessage(`Nothing is broken; ${report.states} states${report.complete ? ", all there are" : ""}.`);
        return;
    }
    const named = broken.find((result) => result.counterexample);
    const choice = await vscode.window.showWarningMessage(
        `${broken.length} broken: ${broken.map((result) => result.name).join(", ")}`,
        ...(named ? ["Rehearse the counter-example"] : []),
    );
    if (choice) await counterexample(program, named.name, ask);
}

/** Its scenario beside the program, to be kept or not, and rehearsed. */
async function counterexample(program, name, ask) {
    const uri = uriOf(program);
    const shown = await ask("seqc.counterexample", uri, name || "");
    const file = vscode.Uri.parse(shown.program.replace(/\.seq$/, `-${shown.name}.scn`));
    await vscode.workspace.fs.writeFile(file, Buffer.from(shown.scenario));
    await vscode.window.showTextDocument(await vscode.workspace.openTextDocument(file), { preview: true });
    return rehearse(shown.program, file.toString());
}

async function attach(program, setting) {
    const configuration = { type: "seqc", request: "attach", name: "Gateway", program: pathOf(uriOf(program)) };
    return vscode.debug.startDebugging(undefined, setting("endpoint") ? { ...configuration, endpoint: setting("endpoint") } : configuration);
}

/** The machine's own run and stop; starting one asks first, stopping never does. */
async function switchMachine(run) {
    const session = vscode.debug.activeDebugSession;
    if (session === undefined || session.type !== "seqc" || session.configuration.request !== "attach") {
        throw new Error("no gateway is attached: start the launch configuration \"attach to a gateway\" first");
    }
    if (run) {
        const sure = await vscode.window.showWarningMessage("Start the sequence? The machine may move.", { modal: true }, "Run");
        if (sure !== "Run") return undefined;
    }
    return session.customRequest(run ? "seqc/run" : "seqc/stop");
}

function register({ ask, graph, setting }) {
    const told = (work) => async (...given) => {
        try {
            return await work(...given);
        } catch (problem) {
            vscode.window.showErrorMessage(problem.message);
        }
    };
    return [
        vscode.commands.registerCommand("seqc.rehearse", told(rehearse)),
        vscode.commands.registerCommand("seqc.graph", told((program) => graph.show(uriOf(program)))),
        vscode.commands.registerCommand("seqc.attach", told((program) => attach(program, setting))),
        vscode.commands.registerCommand("seqc.run", told(() => switchMachine(true))),
        vscode.commands.registerCommand("seqc.stop", told(() => switchMachine(false))),
        vscode.commands.registerCommand("seqc.verify", told((program) => verify(program, ask))),
        vscode.commands.registerCommand("seqc.upload", told((program) => upload(program, setting))),
        vscode.commands.registerCommand("seqc.counterexample.open", told((program, name) => counterexample(program, name, ask))),
    ];
}

module.exports = { register };
