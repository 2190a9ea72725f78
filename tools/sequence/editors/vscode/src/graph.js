"use strict";

const vscode = require("vscode");

/** The step in whose lines a place of a file is; steps of included files say in which. */
function stepAt(steps, line, uri) {
    const here = (step) => uri === undefined || vscode.Uri.parse(step.uri).toString() === uri;
    return steps.filter((step) => step.line <= line && here(step)).reduce((last, step) => (last === undefined || step.line >= last.line ? step : last), undefined);
}

function page(svg) {
    const drawing = svg.slice(svg.indexOf("<svg"));
    return `<!DOCTYPE html><html><head><meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'">
<style>body { background: white } svg { max-width: 100%; height: auto } .here > rect { stroke: #d35400; stroke-width: 3 }</style></head>
<body>${drawing}<script>
window.addEventListener("message", (event) => {
    for (const node of document.querySelectorAll("g.node")) {
        const here = [...node.querySelectorAll("text")].some((text) => text.textContent.trim() === event.data.step);
        node.classList.toggle("here", here);
        if (here) node.scrollIntoView({ block: "center" });
    }
});
</script></body></html>`;
}

/** The graph beside the text; it follows the cursor. */
class GraphView {
    constructor(ask) {
        this.ask = ask;
        this.steps = [];
        this.subscriptions = [
            vscode.window.onDidChangeTextEditorSelection((event) => this.follow(event.textEditor)),
            vscode.workspace.onDidSaveTextDocument((document) => {
                if (this.shows(document.uri.toString())) this.draw().catch(() => {});
            }),
        ];
    }

    shows(uri) {
        return uri === this.uri || this.steps.some((step) => vscode.Uri.parse(step.uri).toString() === uri);
    }

    async show(uri) {
        this.uri = uri;
        if (this.panel === undefined) {
            this.panel = vscode.window.createWebviewPanel("seqc.graph", "Graph", { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true }, { enableScripts: true });
            this.panel.onDidDispose(() => (this.panel = undefined));
        }
        await this.draw();
    }

    async draw() {
        if (this.panel === undefined) return;
        const { svg, steps } = await this.ask("seqc.dot", this.uri);
        this.steps = steps;
        this.panel.webview.html = page(svg);
    }

    follow(editor) {
        const uri = editor.document.uri.toString();
        if (this.panel === undefined || !this.shows(uri)) return;
        const step = stepAt(this.steps, editor.selection.active.line, uri);
        if (step !== undefined) this.panel.webview.postMessage({ step: step.name });
    }

    dispose() {
        if (this.panel !== undefined) this.panel.dispose();
        for (const subscription of this.subscriptions) subscription.dispose();
    }
}

module.exports = { GraphView, page, stepAt };
