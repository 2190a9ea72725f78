#!/usr/bin/env python3
"""The Debian package `seqc`: what is in it, and that its programs and files work from there.

usage: seqc_test.py BUILD_FOLDER
"""

import glob
import gzip
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

import bill
import deb
from deb import run

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
BUILD = os.path.abspath(sys.argv[1])
SKIPPED = 77


def build():
    """The package; one without the extension is not what is tested here."""
    if shutil.which("npm") is None:
        sys.exit("npm is missing: tools/setup full installs it")
    shutil.rmtree(os.path.join(BUILD, "package_seqc"), ignore_errors=True)
    done = run("cmake", "--build", BUILD, "--target", "seqc_debian_package")
    found = glob.glob(os.path.join(BUILD, "package_seqc", "seqc_*.deb"))
    if "cannot be downloaded" in done.stdout + done.stderr:
        print("skipped: npm's packages cannot be downloaded")
        sys.exit(SKIPPED)
    if done.returncode != 0 or len(found) != 1:
        sys.exit(f"{done.stdout}\n{done.stderr}\nthe package cannot be built")
    return found[0]


DEB = build()


class Package(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="seqc-package-")
        self.addCleanup(folder.cleanup)
        self.root = folder.name
        subprocess.run(["dpkg-deb", "-x", DEB, self.root], check=True)

    def path(self, name):
        return os.path.join(self.root, name)

    def test_its_programs_run_on_its_examples(self):
        program = self.path("usr/share/doc/seqc/examples/press.seq")
        scenario = self.path("usr/share/doc/seqc/examples/press.scn")
        self.assertEqual(run(self.path("usr/bin/seqc"), "check", program).returncode, 0)
        done = run(self.path("usr/bin/nanoplc-sim"), "run", program, "--scenario", scenario, "--quiet")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        for name in ("seqc", "nanoplc-sim"):
            self.assertRegex(run(self.path("usr/bin/" + name), "--version").stdout,
                             rf"^{name} \d+\.\d+\.\d+ \(commit ([0-9a-f]{{12}}(-changed)?|unknown)\)\n$")

    def test_the_server_and_the_adapter_answer(self):
        requests = (("lsp", {"jsonrpc": "2.0", "id": 1, "method": "initialize", "params": {"capabilities": {}}}),
                    ("dap", {"seq": 1, "type": "request", "command": "initialize", "arguments": {"adapterID": "seqc"}}))
        for name, request in requests:
            text = json.dumps(request)
            done = run(self.path("usr/bin/seqc"), name, input=f"Content-Length: {len(text)}\r\n\r\n{text}")
            self.assertIn("upports" if name == "dap" else "capabilities", done.stdout)

    def test_the_extension_is_whole_and_of_the_same_version(self):
        with zipfile.ZipFile(self.path("usr/share/seqc/seqc.vsix")) as extension:
            self.assertIsNone(extension.testzip())
            manifest = json.loads(extension.read("extension/package.json"))
            self.assertIn("extension/" + manifest["main"].removeprefix("./"), extension.namelist())
        self.assertIn(f"Version: {manifest['version']}\n", run("dpkg-deb", "-I", DEB).stdout.replace("\n ", "\n"))

    def test_neovim_starts_the_server_with_the_packages_folder(self):
        if shutil.which("nvim") is None:
            sys.exit("neovim is missing: tools/setup full installs it")
        report = self.path("report")
        lua = (f"vim.opt.runtimepath:append('{self.path('usr/share/seqc/nvim')}') require('seqc').setup() "
               f"vim.cmd('edit {self.path('usr/share/doc/seqc/examples/press.seq')}') "
               "local ok = vim.wait(10000, function() local c = vim.lsp.get_active_clients()[1] "
               "return c ~= nil and c.server_capabilities.hoverProvider ~= nil end, 20) "
               f"vim.fn.writefile({{ok and 'attached' or 'nothing'}}, '{report}') vim.cmd('qall!')")
        environment = {**os.environ, "PATH": self.path("usr/bin") + ":" + os.environ["PATH"], "XDG_STATE_HOME": self.root,
                       "XDG_CACHE_HOME": self.root, "XDG_DATA_HOME": self.root}
        run("nvim", "--headless", "--clean", "-n", "-c", "lua " + lua, env=environment, timeout=60)
        with open(report, encoding="utf-8") as file:
            self.assertEqual(file.read().strip(), "attached")

    def test_lintian_says_nothing(self):
        deb.expect_lintian_silent(self, DEB)

    def test_the_bill_of_materials_is_true(self):
        path = DEB.removesuffix(".deb") + ".spdx.json"
        self.assertEqual(bill.problems(path, DEB), [])
        document = bill.read(path)
        self.assertEqual(bill.related(document, "DYNAMIC_LINK"), deb.needed(DEB))
        self.assertLess({"vscode-languageclient", "vscode-jsonrpc", "semver", "minimatch"}, bill.related(document, "CONTAINS"))
        with open(os.path.join(ROOT, "tools/sequence/editors/vscode/package.json"), encoding="utf-8") as file:
            tools = set(json.load(file)["devDependencies"]) - {"vscode-languageserver-protocol"}
        self.assertEqual(bill.related(document, "CONTAINS") & tools, set())

    def test_its_manuals_name_every_command(self):
        for program in ("seqc", "nanoplc-sim"):
            with gzip.open(self.path(f"usr/share/man/man1/{program}.1.gz"), "rt", encoding="utf-8") as file:
                manual = file.read()
            commands = re.findall(r"(?m)^  (\w+) ", run(self.path("usr/bin/" + program), "--help").stdout.split("Subcommands:")[1])
            for command in commands:
                self.assertIn(f'.SH "{program.upper()} {command.upper()}"', manual)

    def test_it_has_no_trace_of_where_and_when_it_was_built(self):
        self.assertEqual(list(bill.build_traces(self.root, BUILD, ROOT)), [])
        with zipfile.ZipFile(self.path("usr/share/seqc/seqc.vsix")) as extension:
            extension.extractall(self.path("extension"))
            self.assertEqual({entry.date_time for entry in extension.infolist()}, {(1980, 1, 1, 0, 0, 0)})
        self.assertEqual(list(bill.build_traces(self.path("extension"), BUILD, ROOT)), [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
