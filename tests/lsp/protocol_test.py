#!/usr/bin/env python3
"""Every kind of message of `seqc lsp` and `seqc dap`, held against the protocols' own types by TypeScript.

usage: protocol_test.py SEQC EXAMPLES EXTENSION-FOLDER

The types are those of the npm packages vscode-languageserver-protocol and @vscode/debugprotocol, in the
versions of the extension's package-lock.json. Object literals are checked for excess members too.
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile

import client as lsp

SEQC, EXAMPLES, EXTENSION = (os.path.abspath(path) for path in sys.argv[1:4])

# method: the type of its result
RESULTS = {
    "initialize": "lsp.InitializeResult",
    "textDocument/hover": "lsp.Hover | null",
    "textDocument/completion": "lsp.CompletionList",
    "completionItem/resolve": "lsp.CompletionItem",
    "textDocument/signatureHelp": "lsp.SignatureHelp | null",
    "textDocument/definition": "lsp.Location | null",
    "textDocument/references": "lsp.Location[]",
    "textDocument/documentHighlight": "lsp.DocumentHighlight[]",
    "textDocument/documentSymbol": "lsp.DocumentSymbol[]",
    "workspace/symbol": "lsp.SymbolInformation[]",
    "textDocument/documentLink": "lsp.DocumentLink[]",
    "textDocument/foldingRange": "lsp.FoldingRange[]",
    "textDocument/selectionRange": "lsp.SelectionRange[]",
    "textDocument/semanticTokens/full": "lsp.SemanticTokens",
    "textDocument/semanticTokens/range": "lsp.SemanticTokens",
    "textDocument/inlayHint": "lsp.InlayHint[]",
    "textDocument/codeLens": "lsp.CodeLens[]",
    "textDocument/codeAction": "lsp.CodeAction[]",
    "textDocument/formatting": "lsp.TextEdit[]",
    "textDocument/rangeFormatting": "lsp.TextEdit[]",
    "textDocument/onTypeFormatting": "lsp.TextEdit[]",
    "textDocument/prepareRename": "{ range: lsp.Range, placeholder: string } | null",
    "textDocument/rename": "lsp.WorkspaceEdit",
    "shutdown": "null",
}
NOTIFICATIONS = {
    "textDocument/publishDiagnostics": "lsp.PublishDiagnosticsParams",
    "window/logMessage": "lsp.LogMessageParams",
}
SERVER_REQUESTS = {"workspace/codeLens/refresh"}  # without parameters
DAP_EVENTS = {
    "initialized": "InitializedEvent", "stopped": "StoppedEvent", "output": "OutputEvent",
    "terminated": "TerminatedEvent", "exited": "ExitedEvent", "seqc/state": "Event",
}


def dap_type(message):
    if message["type"] == "event":
        return DAP_EVENTS[message["event"]]
    if not message["success"]:
        return "ErrorResponse"
    return message["command"][0].upper() + message["command"][1:] + "Response"


def language_messages(folder):
    """(type, message) of a session that uses every feature."""
    for name in ("pick_and_place.seq", "pick_and_place.scn"):
        shutil.copy(os.path.join(EXAMPLES, name), folder)
    with open(os.path.join(folder, "shared.seqi"), "w", encoding="utf-8") as file:
        file.write("CONST Longest := 2 s;\n")
    client = lsp.Client(SEQC, folder, {"workspace": {"codeLens": {"refreshSupport": True}}}, {"verify": True})
    path = os.path.join(folder, "pick_and_place.seq")
    uri = lsp.uri_of(path)
    with open(path, encoding="utf-8") as file:
        text = file.read().replace("END_PROGRAM", "INCLUDE 'shared.seqi';\nPROPERTY Wrong: NEVER Lamp;\nEND_PROGRAM")
    client.open(uri, text)
    client.diagnostics(uri, where=lambda told: any(d["source"] == "seqc verify" for d in told))
    document = {"textDocument": {"uri": uri}}
    everything = {"start": {"line": 0, "character": 0}, "end": {"line": 9999, "character": 0}}
    layout = {"tabSize": 4, "insertSpaces": True}
    for method in ("hover", "completion", "definition", "references", "documentHighlight", "prepareRename"):
        client.at(f"textDocument/{method}", uri, lsp.place_of(text, "Grip AT"), context={"includeDeclaration": True})
    item = client.at("textDocument/completion", uri, lsp.place_of(text, "POSITION(Place", 9))["items"][0]
    client.request("completionItem/resolve", item)
    client.at("textDocument/signatureHelp", uri, lsp.place_of(text, "POSITION(Place", 10))
    client.at("textDocument/rename", uri, lsp.place_of(text, "Grip AT"), newName="Gripper")
    client.request("textDocument/selectionRange", {**document, "positions": [lsp.place_of(text, "T#500ms")]})
    for method in ("documentSymbol", "foldingRange", "semanticTokens/full", "semanticTokens/range", "inlayHint", "codeLens", "formatting", "rangeFormatting"):
        client.request(f"textDocument/{method}", {**document, "range": everything, "options": layout})
    assert client.request("textDocument/documentLink", document), "no link to the included file"
    client.request("workspace/symbol", {"query": "travel"})
    broken = text.replace("NEXT := Travel;", "NEXT = Travle", 1)
    client.change(uri, 2, [{"text": broken}])
    told = client.diagnostics(uri, 2)
    client.request("textDocument/codeAction", {**document, "range": everything, "context": {"diagnostics": told}})
    client.at("textDocument/onTypeFormatting", uri, {"line": 40, "character": 0}, ch="\n", options=layout)
    client.change(uri, 3, [{"range": 7, "text": ""}])
    client.end()
    methods = {m["id"]: m["method"] for side, m in client.transcript if side == "client" and "id" in m}
    for side, message in client.transcript:
        if side == "server" and message.get("method") in SERVER_REQUESTS:
            yield "lsp.RequestMessage", message
        elif side == "server" and "method" in message:
            yield NOTIFICATIONS[message["method"]], message["params"]
        elif side == "server" and methods[message["id"]] in RESULTS:
            yield RESULTS[methods[message["id"]]], message["result"]


def adapter_messages():
    """Those of a rehearsal."""
    sys.argv[1:] = [SEQC, "", "", EXAMPLES]
    from dap_test import Debugger, Refused  # noqa: PLC0415: it reads sys.argv

    debugger = Debugger()
    program = os.path.join(EXAMPLES, "pick_and_place.seq")
    debugger.request("launch", {"program": program, "scenario": os.path.join(EXAMPLES, "pick_and_place.scn")})
    debugger.request("setBreakpoints", {"source": {"path": program}, "breakpoints": [{"line": 45}, {"line": 1}]})
    debugger.request("setFunctionBreakpoints", {"breakpoints": [{"name": "Hold"}, {"name": "None"}]})
    debugger.request("setExceptionBreakpoints", {"filters": ["error", "expectation"]})
    debugger.request("configurationDone")
    debugger.wait_for("stopped")
    for command in ("threads", "stackTrace", "scopes"):
        debugger.request(command, {"threadId": 1, "frameId": 1})
    for scope in ("Sequence", "Inputs", "Outputs", "Motor"):
        debugger.values(scope)
    debugger.set("Inputs", "Ack", "1")
    debugger.request("evaluate", {"expression": "TIMER"})
    try:
        debugger.request("evaluate", {"expression": "Nothing"})
    except Refused:
        pass
    for command in ("next", "stepIn"):
        debugger.request(command, {"threadId": 1})
        debugger.wait_for("stopped")
    debugger.request("setBreakpoints", {"source": {"path": program}, "breakpoints": []})
    debugger.request("setFunctionBreakpoints", {"breakpoints": []})
    debugger.request("setExceptionBreakpoints", {"filters": []})
    debugger.request("continue", {"threadId": 1})
    debugger.wait_for("exited")
    debugger.end()
    for message in debugger.transcript:
        yield "DebugProtocol." + dap_type(message), message


def main():
    compiler = os.path.join(EXTENSION, "node_modules", ".bin", "tsc")
    if not os.path.exists(compiler):
        subprocess.run(["npm", "ci", "--no-audit", "--no-fund", "--silent"], cwd=EXTENSION, check=True)
    with tempfile.TemporaryDirectory(prefix="seqc-protocol-") as folder:
        messages = [*language_messages(folder), *adapter_messages()]
        os.symlink(os.path.join(EXTENSION, "node_modules"), os.path.join(folder, "node_modules"))
        source = os.path.join(folder, "messages.ts")
        with open(source, "w", encoding="utf-8") as file:
            file.write('import * as lsp from "vscode-languageserver-protocol";\nimport { DebugProtocol } from "@vscode/debugprotocol";\n')
            for i, (kind, message) in enumerate(messages):
                file.write(f"export const m{i}: {kind} = {json.dumps(message)};\n")
        done = subprocess.run(
            [compiler, "--noEmit", "--strict", "--skipLibCheck", "--module", "nodenext", "--moduleResolution", "nodenext", "--target", "es2022", source],
            capture_output=True, text=True, check=False, cwd=folder)
        if done.returncode != 0:
            sys.exit(done.stdout[:6000])
    missing = {"lsp.RequestMessage", *RESULTS.values()} - {kind for kind, _ in messages}
    if missing:
        sys.exit(f"never answered: {sorted(missing)}")
    print(f"{len(messages)} messages fit their types")


if __name__ == "__main__":
    main()
