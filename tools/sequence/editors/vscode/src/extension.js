"use strict";

const vscode = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");
const { GraphView } = require("./graph");
const { LiveView } = require("./live");
const { ScenarioTests } = require("./scenarios");
const commands = require("./commands");
const { configurations } = require("./configurations");

let client;

function setting(name) {
    return vscode.workspace.getConfiguration("seqc").get(name);
}

/** The server, the debug adapter, and what is shown beside the text. */
async function activate(context) {
    const seqc = setting("path") || "seqc";
    client = new LanguageClient(
        "seqc",
        "NanoPLC sequences",
        { command: seqc, args: ["lsp"] },
        {
            documentSelector: ["seqc", "seqc-scenario", "seqc-property"].map((language) => ({ language })),
            initializationOptions: { verify: setting("verify") },
            synchronize: {
                configurationSection: "seqc",
                fileEvents: vscode.workspace.createFileSystemWatcher("**/*.{seq,seqi,scn,prop}"),
            },
        },
    );
    const ask = (command, ...parameters) =>
        client.sendRequest("workspace/executeCommand", { command, arguments: parameters });
    const graph = new GraphView(ask);
    const live = new LiveView();
    const tests = new ScenarioTests(() => setting("simulator") || "nanoplc-sim");
    context.subscriptions.push(
        graph,
        live,
        tests,
        vscode.debug.registerDebugAdapterDescriptorFactory("seqc", {
            createDebugAdapterDescriptor: () => new vscode.DebugAdapterExecutable(setting("path") || "seqc", ["dap"]),
        }),
        vscode.debug.registerDebugConfigurationProvider("seqc", configurations(setting)),
        vscode.languages.registerInlineValuesProvider("seqc", live),
        ...commands.register({ ask, graph, setting }),
    );
    try {
        await client.start();
    } catch (problem) {
        vscode.window.showErrorMessage(
            `${seqc} cannot be started (${problem.message}): install the package seqc, or name the program in the setting seqc.path`,
        );
    }
    await tests.find().catch((problem) => vscode.window.showWarningMessage(`Scenarios cannot be found: ${problem.message}`));
}

function deactivate() {
    return client === undefined ? undefined : client.stop();
}

module.exports = { activate, deactivate };
