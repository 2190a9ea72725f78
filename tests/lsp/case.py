"""What tests of the language server begin with: a server with a folder of its own, and the examples.

The first arguments of such a test are SEQC and EXAMPLES.
"""

import os
import shutil
import sys
import tempfile
import unittest

from client import Client, uri_of

SEQC, EXAMPLES = sys.argv[1:3]
START = {"line": 0, "character": 0}
ALL = {"start": START, "end": {"line": 10_000, "character": 0}}


def example(name):
    with open(os.path.join(EXAMPLES, name), encoding="utf-8") as file:
        return file.read()


class Case(unittest.TestCase):
    options = {"verify": False}
    client_capabilities = {}

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="seqc-lsp-")
        self.addCleanup(shutil.rmtree, self.folder)
        self.client = Client(SEQC, self.folder, self.client_capabilities, self.options)
        self.addCleanup(lambda: self.assertEqual(self.client.end(), 0))

    def open(self, text, name="machine.seq"):
        path = os.path.join(self.folder, name)
        with open(path + ".new", "w", encoding="utf-8") as file:
            file.write(text)
        os.replace(path + ".new", path)  # the server may be reading it
        uri = uri_of(path)
        self.client.open(uri, text)
        return uri

    def labels(self, uri, place):
        return [item["label"] for item in self.client.at("textDocument/completion", uri, place)["items"]]

    def codes(self, uri, version=None):
        return [told.get("code") for told in self.client.diagnostics(uri, version)]

    def actions(self, uri, told):
        return self.client.request(
            "textDocument/codeAction", {"textDocument": {"uri": uri}, "range": told["range"], "context": {"diagnostics": [told]}}
        )
