"use strict";

/** As much of the vscode module as the extension uses; what it is told is kept. */
const told = { commands: {}, messages: [], debugging: [], panels: [], decorations: [], factories: {}, tests: [] };

class Event {
    constructor() {
        this.listeners = [];
        this.on = (listener) => {
            this.listeners.push(listener);
            return { dispose() {} };
        };
    }
    fire(value) {
        for (const listener of this.listeners) listener(value);
    }
}

class Uri {
    constructor(path) {
        this.scheme = "file";
        this.fsPath = path;
    }
    static parse(text) {
        return new Uri(decodeURIComponent(text.replace(/^file:\/\//, "")));
    }
    static file(path) {
        return new Uri(path);
    }
    toString() {
        return "file://" + this.fsPath;
    }
}

class Place {
    constructor(line, character) {
        Object.assign(this, { line, character });
    }
}
class Range {
    constructor(a, b, c, d) {
        this.start = new Place(a, b);
        this.end = new Place(c, d);
    }
}

class Items {
    constructor() {
        this.list = [];
    }
    replace(list) {
        this.list = list;
    }
    forEach(visit) {
        this.list.forEach(visit);
    }
}

const selection = new Event();
const saved = new Event();
const custom = new Event();
const ended = new Event();
const settings = {};

module.exports = {
    told,
    settings,
    selection,
    custom,
    ended,
    files: [],
    Uri,
    Position: Place,
    Range,
    Location: class {
        constructor(uri, place) {
            Object.assign(this, { uri, place });
        }
    },
    ThemeColor: class {},
    ViewColumn: { Beside: -2 },
    TestRunProfileKind: { Run: 1, Debug: 2 },
    TestMessage: class {
        constructor(message) {
            this.message = message;
        }
    },
    InlineValueEvaluatableExpression: class {
        constructor(range, expression) {
            Object.assign(this, { range, expression });
        }
    },
    DebugAdapterExecutable: class {
        constructor(command, args) {
            Object.assign(this, { command, args });
        }
    },
    workspace: {
        getConfiguration: () => ({ get: (name) => settings[name] }),
        createFileSystemWatcher: () => ({ dispose() {} }),
        onDidSaveTextDocument: saved.on,
        findFiles: async () => module.exports.files,
    },
    languages: { registerInlineValuesProvider: () => ({ dispose() {} }) },
    commands: {
        registerCommand(name, work) {
            told.commands[name] = work;
            return { dispose() {} };
        },
    },
    debug: {
        registerDebugConfigurationProvider(type, provider) {
            told.configurations = provider;
            return { dispose() {} };
        },
        registerDebugAdapterDescriptorFactory(type, factory) {
            told.factories[type] = factory;
            return { dispose() {} };
        },
        onDidReceiveDebugSessionCustomEvent: custom.on,
        onDidTerminateDebugSession: ended.on,
        async startDebugging(folder, configuration) {
            told.debugging.push(configuration);
        },
    },
    tests: {
        createTestController: () => ({
            items: new Items(),
            createTestItem: (id, label, uri) => ({ id, label, uri }),
            createRunProfile() {},
            createTestRun() {
                const run = { output: "" };
                for (const what of ["started", "passed", "failed", "errored"]) {
                    run[what] = (item, messages) => told.tests.push({ what, label: item.label, messages });
                }
                run.appendOutput = (text) => (run.output += text);
                run.end = () => told.tests.push({ what: "end" });
                return run;
            },
            dispose() {},
        }),
    },
    window: {
        visibleTextEditors: [],
        onDidChangeTextEditorSelection: selection.on,
        createTextEditorDecorationType: () => ({ dispose() {} }),
        createStatusBarItem: () => ({ show() {}, hide() {}, dispose() {} }),
        createWebviewPanel() {
            const panel = { webview: { html: "", sent: [], postMessage: (m) => panel.webview.sent.push(m) }, onDidDispose() {}, dispose() {} };
            told.panels.push(panel);
            return panel;
        },
        showErrorMessage: async (text) => void told.messages.push(text),
        showInformationMessage: async (text) => void told.messages.push(text),
        showWarningMessage: async (text) => void told.messages.push(text),
    },
};
