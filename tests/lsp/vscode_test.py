#!/usr/bin/env python3
"""The extension in a real VS Code server (from the npm package code-server), used in Chromium.

usage: vscode_test.py SEQC NANOPLC-SIM NANOCTL EXAMPLES VSIX PLAYWRIGHT-CORE BUILD-FOLDER

Writes pictures to the folder of the environment variable PICTURES. Exit code 77: that server cannot be had here.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

SEQC, SIM, NANOCTL, EXAMPLES, VSIX, PLAYWRIGHT, BUILD = (os.path.abspath(path) for path in sys.argv[1:8])
HERE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "vscode")
WRONG = "PROPERTY Wrong: NEVER Lamp AND Start;\n"


def line_of(text, words):
    return text[: text.index(words)].count("\n") + 1


def printed(process, pattern):
    for line in process.stdout:
        if found := re.search(pattern, line):
            return found
    sys.exit(f"{process.args[0]} ended without {pattern}")


def main():
    for program in ("node", "npm", "chromium", "dot"):
        if shutil.which(program) is None:
            sys.exit(f"{program} is missing: tools/setup full installs it")
    installed = subprocess.run([os.path.join(HERE, "install"), BUILD], check=False)
    if installed.returncode:
        return installed.returncode
    server = os.path.join(BUILD, "package", "lib", "vscode", "out", "server-main.js")
    with tempfile.TemporaryDirectory(prefix="seqc-vscode-") as folder, open(os.path.join(folder, "log"), "w", encoding="utf-8") as log:
        workspace, data, extensions = (os.path.join(folder, name) for name in ("sequences", "data", "extensions"))
        os.mkdir(workspace)
        for name in ("pick_and_place.seq", "pick_and_place.scn"):
            shutil.copy(os.path.join(EXAMPLES, name), workspace)
        with open(os.path.join(workspace, "pick_and_place.prop"), "w", encoding="utf-8") as file:
            file.write(WRONG)
        endpoint = "unix:" + os.path.join(folder, "gateway")
        settings = {"seqc.path": SEQC, "seqc.simulator": SIM, "seqc.nanoctl": NANOCTL, "seqc.endpoint": endpoint,
                    "workbench.startupEditor": "none", "workbench.colorTheme": "Default Light Modern", "window.commandCenter": False,
                    "editor.minimap.enabled": False}
        for kind in ("Machine", "User"):
            os.makedirs(os.path.join(data, "data", kind))
            with open(os.path.join(data, "data", kind, "settings.json"), "w", encoding="utf-8") as file:
                json.dump(settings, file)
        common = ["node", server, "--accept-server-license-terms", "--server-data-dir", data, "--extensions-dir", extensions]
        environment = {**os.environ, "HOME": folder}
        subprocess.run([*common, "--install-extension", VSIX], check=True, env=environment, stdout=log, stderr=log)
        table = os.path.join(folder, "p.bin")
        subprocess.run([SEQC, "build", os.path.join(workspace, "pick_and_place.seq"), "-o", table, "--quiet"], check=True)
        sim = subprocess.Popen([SIM, "run", "--realtime", "--mactalk", endpoint, "--flash", os.path.join(folder, "flash")],
                               stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True)
        code = subprocess.Popen([*common, "--host", "127.0.0.1", "--port", "0", "--without-connection-token", "--disable-workspace-trust",
                                 "--disable-telemetry"], stdout=subprocess.PIPE, stderr=log, text=True, env=environment)
        try:
            printed(sim, "^ready")
            subprocess.run([NANOCTL, "--port", endpoint, "--patience", "20000", "upload", table, "--run"], check=True, stdout=log)
            port = printed(code, r"listening on (\d+)").group(1)
            with open(os.path.join(workspace, "pick_and_place.seq"), encoding="utf-8") as file:
                text = file.read()
            environment = {**os.environ, "PLAYWRIGHT": PLAYWRIGHT, "URL": f"http://127.0.0.1:{port}/?folder={workspace}",
                           "TRAVEL": str(line_of(text, "ENTRY POSITION(Place)")), "IDLE": str(line_of(text, "IF Start AND"))}
            return subprocess.run(["node", os.path.join(HERE, "vscode.mjs")], env=environment, check=False).returncode
        finally:
            for process in (code, sim):
                process.terminate()
                process.wait(30)


if __name__ == "__main__":
    sys.exit(main())
