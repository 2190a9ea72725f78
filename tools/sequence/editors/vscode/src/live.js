"use strict";

const vscode = require("vscode");

const kNames = /\b[A-Za-z_]\w*(\.Q)?\b/g;

/** Behind the line of each condition: whether it holds, and what its signals are. */
function valuesOf(conditions, document) {
    const byLine = new Map();
    const isHere = (condition) => condition.file === undefined || condition.file === document.uri.fsPath;
    for (const condition of conditions.filter(isHere)) {
        const parts = condition.parts.map((part) => `${part.text} ${part.holds ? 1 : 0}`).join(", ");
        const text = `${condition.holds ? "\u2713" : "\u2717"} ${parts}`;
        byLine.set(condition.line - 1, [...(byLine.get(condition.line - 1) || []), text]);
    }
    return [...byLine].filter(([line]) => line < document.lineCount).map(([line, texts]) => {
        const end = document.lineAt(line).text.length;
        return { range: new vscode.Range(line, end, line, end), renderOptions: { after: { contentText: texts.join("   ") } } };
    });
}

/** What a machine does now: the active step marked, and in its lines what each name is. */
class LiveView {
    constructor() {
        this.mark = vscode.window.createTextEditorDecorationType({
            isWholeLine: true,
            backgroundColor: new vscode.ThemeColor("editor.stackFrameHighlightBackground"),
            overviewRulerColor: "#d35400",
        });
        this.values = vscode.window.createTextEditorDecorationType({
            after: { margin: "0 0 0 2em", color: new vscode.ThemeColor("editorInlayHint.foreground") },
        });
        this.item = vscode.window.createStatusBarItem();
        this.subscriptions = [
            this.mark,
            this.values,
            this.item,
            vscode.debug.onDidReceiveDebugSessionCustomEvent((event) => this.told(event)),
            vscode.debug.onDidTerminateDebugSession(() => this.clear()),
        ];
    }

    told({ event, body, session }) {
        if (event !== "seqc/state") return;
        this.item.text = `$(circuit-board) ${body.name || body.step} ${body.error ? "ERROR " : ""}${body.state}`;
        this.item.show();
        const program = session.configuration.program;
        const files = new Set([program, body.file, ...(body.conditions || []).map((condition) => condition.file)]);
        for (const editor of vscode.window.visibleTextEditors) {
            const path = editor.document.uri.fsPath;
            if (!files.has(path)) continue;
            const line = path === (body.file || program) ? body.line - 1 : -1;
            editor.setDecorations(this.mark, line < 0 ? [] : [new vscode.Range(line, 0, line, 0)]);
            editor.setDecorations(this.values, valuesOf(body.conditions || [], editor.document));
        }
    }

    clear() {
        this.item.hide();
        for (const editor of vscode.window.visibleTextEditors) {
            editor.setDecorations(this.mark, []);
            editor.setDecorations(this.values, []);
        }
    }

    provideInlineValues(document, range, context) {
        const values = [];
        for (let number = context.stoppedLocation.start.line; number <= Math.min(range.end.line, document.lineCount - 1); ++number) {
            const text = document.lineAt(number).text.replace(/\/\/.*$/, "");
            for (const found of text.matchAll(kNames)) {
                const at = new vscode.Range(number, found.index, number, found.index + found[0].length);
                values.push(new vscode.InlineValueEvaluatableExpression(at, found[0]));
            }
            if (/^\s*END_STEP\b/i.test(text)) break;
        }
        return values;
    }

    dispose() {
        for (const subscription of this.subscriptions) subscription.dispose();
    }
}

module.exports = { LiveView };
