#!/usr/bin/env python3
"""Neovim, headless, as a foreign client of `seqc lsp`.

usage: neovim_test.py SEQC EXAMPLES NVIM-FOLDER
"""

import os
import shutil
import subprocess
import sys
import tempfile

SEQC, EXAMPLES, FOLDER = (os.path.abspath(path) for path in sys.argv[1:4])


def main():
    if shutil.which("nvim") is None:
        sys.exit("neovim is missing: tools/setup installs it")
    here = os.path.dirname(os.path.abspath(__file__))
    with tempfile.TemporaryDirectory(prefix="seqc-nvim-") as folder:
        for name in ("pick_and_place.seq", "pick_and_place.scn"):
            shutil.copy(os.path.join(EXAMPLES, name), folder)
        with open(os.path.join(folder, "pick_and_place.prop"), "w", encoding="utf-8") as file:
            file.write("PROPERTY Wrong: NEVER Lamp;\n")
        report = os.path.join(folder, "report")
        environment = {
            **os.environ,
            "SEQC": SEQC,
            "SEQC_NVIM": FOLDER,
            "PROGRAM": os.path.join(folder, "pick_and_place.seq"),
            "REPORT": report,
            "XDG_STATE_HOME": folder,
            "XDG_DATA_HOME": folder,
            "XDG_CACHE_HOME": folder,
        }
        script = os.path.join(here, "neovim.lua")
        done = subprocess.run(
            ["nvim", "--headless", "--clean", "-n", "-c", f"luafile {script}", "-c", "cquit"],
            env=environment, capture_output=True, text=True, timeout=120, check=False, cwd=folder)
        if not os.path.exists(report):
            sys.exit("neovim wrote no report:\n" + done.stdout + done.stderr)
        with open(report, encoding="utf-8") as file:
            wrong = file.read()
        if wrong:
            sys.exit(wrong)
    print("all features answered")


if __name__ == "__main__":
    main()
