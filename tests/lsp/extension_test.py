#!/usr/bin/env python3
"""Builds the VS Code extension in a folder of its own, looks into the .vsix, and runs the extension's tests in Node.

usage: extension_test.py SEQC NANOPLC-SIM EXAMPLES EXTENSION-FOLDER BUILD-FOLDER
"""

import json
import os
import shutil
import subprocess
import sys
import zipfile

SEQC, SIM, EXAMPLES, SOURCE, BUILD = (os.path.abspath(path) for path in sys.argv[1:6])


def main():
    if shutil.which("npm") is None:
        sys.exit("npm is missing: tools/setup installs it")
    vsix = os.path.join(BUILD, "seqc.vsix")
    subprocess.run([os.path.join(SOURCE, "build"), vsix, BUILD], check=True, stdout=subprocess.DEVNULL)
    with zipfile.ZipFile(vsix) as package:
        names = package.namelist()
        manifest = json.loads(package.read("extension/package.json"))
    for wanted in (manifest["main"], *(g["path"] for g in manifest["contributes"]["grammars"])):
        assert "extension/" + wanted.removeprefix("./") in names, (wanted, names)
    assert not any("node_modules" in name for name in names), names
    environment = {**os.environ, "SEQC": SEQC, "SIMULATOR": SIM, "EXAMPLES": EXAMPLES}
    # Beside LANGUAGE.md, which the grammar is held against.
    return subprocess.run(["node", "--test", os.path.join(SOURCE, "test")], cwd=BUILD, env=environment, check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
