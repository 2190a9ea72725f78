"""A language client on the standard input and output of `seqc lsp`."""

import json
import os
import subprocess


class Refused(Exception):
    """The server answered a request with an error."""

    def __init__(self, error):
        super().__init__(f"{error['code']}: {error['message']}")
        self.code = error["code"]


class Client:
    def __init__(self, seqc, folder=None, capabilities=None, options=None):
        self.process = subprocess.Popen([seqc, "lsp"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.next_id = 0
        self.transcript = []
        self.notifications = []
        result = self.request(
            "initialize",
            {
                "processId": os.getpid(),
                "rootUri": uri_of(folder) if folder else None,
                "capabilities": capabilities or {},
                "initializationOptions": options if options is not None else {"verify": False},
            },
        )
        self.capabilities = result["capabilities"]
        self.notify("initialized", {})

    def send(self, message):
        self.transcript.append(("client", message))
        content = json.dumps(message).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(content) + content)
        self.process.stdin.flush()

    def receive(self):
        length = None
        while True:
            line = self.process.stdout.readline()
            if not line:
                raise EOFError("the server ended")
            if line in (b"\r\n", b"\n"):
                break
            name, _, value = line.partition(b":")
            if name.lower() == b"content-length":
                length = int(value)
        message = json.loads(self.process.stdout.read(length))
        self.transcript.append(("server", message))
        return message

    def notify(self, method, params):
        self.send({"jsonrpc": "2.0", "method": method, "params": params})

    def request(self, method, params):
        self.next_id += 1
        self.send({"jsonrpc": "2.0", "id": self.next_id, "method": method, "params": params})
        while True:
            message = self.receive()
            if "method" in message:
                self.notifications.append(message)
            elif message["id"] == self.next_id:
                if "error" in message:
                    raise Refused(message["error"])
                return message["result"]

    def open(self, uri, text, language="seqc", version=1):
        self.notify(
            "textDocument/didOpen",
            {"textDocument": {"uri": uri, "languageId": language, "version": version, "text": text}},
        )

    def change(self, uri, version, changes):
        self.notify("textDocument/didChange", {"textDocument": {"uri": uri, "version": version}, "contentChanges": changes})

    def diagnostics(self, uri, version=None, where=lambda told: True):
        """Waits for those of a text, of one version if named."""
        while True:
            for i, message in enumerate(self.notifications):
                told = message.get("params")
                fits = message["method"] == "textDocument/publishDiagnostics" and told["uri"] == uri
                if fits and (version is None or told.get("version") == version) and where(told["diagnostics"]):
                    del self.notifications[: i + 1]
                    return told["diagnostics"]
            message = self.receive()
            assert "method" in message, message
            self.notifications.append(message)

    def at(self, method, uri, place, **more):
        return self.request(method, {"textDocument": {"uri": uri}, "position": place, **more})

    def end(self):
        self.request("shutdown", None)
        self.notify("exit", None)
        self.process.stdin.close()
        code = self.process.wait(30)
        self.process.stdout.close()
        return code


def uri_of(path):
    return "file://" + os.path.abspath(path)


def place_of(text, words, shift=0):
    """Line and character of the first place of `words`, in UTF-16 units."""
    at = text.index(words) + shift
    line = text.count("\n", 0, at)
    begin = text.rfind("\n", 0, at) + 1
    return {"line": line, "character": len(text[begin:at].encode("utf-16-le")) // 2}


def offset_of(text, place):
    lines = text.split("\n")
    before = sum(len(line) + 1 for line in lines[: place["line"]])
    units = lines[place["line"]].encode("utf-16-le")[: 2 * place["character"]]
    return before + len(units.decode("utf-16-le"))


def edited(text, edits):
    """A text with the edits of one answer, which all mean the text before."""
    for edit in sorted(edits, key=lambda e: offset_of(text, e["range"]["start"]), reverse=True):
        begin, end = (offset_of(text, edit["range"][side]) for side in ("start", "end"))
        text = text[:begin] + edit["newText"] + text[end:]
    return text
