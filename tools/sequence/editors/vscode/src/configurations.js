"use strict";

const fs = require("node:fs");
const vscode = require("vscode");
const { programOf } = require("./scenarios");

/** What a launch configuration leaves open. F5 without any rehearses the file that is shown. */
function configurations(setting) {
    return {
        async resolveDebugConfigurationWithSubstitutedVariables(folder, configuration) {
            if (configuration.request !== "attach" || configuration.endpoint) return configuration;
            const endpoint = setting("endpoint");
            if (endpoint) return { ...configuration, endpoint };
            const answer = "Open Settings";
            const chosen = await vscode.window.showErrorMessage("No gateway is named: give \"endpoint\", or the setting seqc.endpoint", answer);
            if (chosen === answer) await vscode.commands.executeCommand("workbench.action.openSettings", "seqc.endpoint");
            return undefined;
        },
        resolveDebugConfiguration(folder, configuration) {
            if (configuration.type) return configuration;
            const editor = vscode.window.activeTextEditor;
            return editor ? rehearsalOf(editor.document.uri.fsPath) : undefined;
        },
        provideDebugConfigurations() {
            return [
                { type: "seqc", request: "launch", name: "Rehearse", program: "${file}" },
                { type: "seqc", request: "attach", name: "Gateway", program: "${file}" },
            ];
        },
    };
}

/** Of a program with the scenario of its name, if there is one; of a scenario with its program. */
function rehearsalOf(file) {
    const launch = { type: "seqc", request: "launch", name: "Rehearse" };
    if (file.endsWith(".scn")) return { ...launch, program: programOf(file), scenario: file };
    if (!file.endsWith(".seq")) return undefined;
    const scenario = file.replace(/\.seq$/, ".scn");
    return fs.existsSync(scenario) ? { ...launch, program: file, scenario } : { ...launch, program: file, stopOnEntry: true };
}

module.exports = { configurations, rehearsalOf };
