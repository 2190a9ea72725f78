#!/usr/bin/env python3
"""Runs tests with programs of others from npm: modbus-serial as a master, sparkplug-payload as a host.

usage: run.py ROOT PROGRAMS BUILD

Exit code 77, skipped: the packages cannot be downloaded here.
"""

import os
import shutil
import subprocess
import sys

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "panel"))
from npm_packages import install  # noqa: E402

SKIPPED = 77


def main():
    root, programs, build = sys.argv[1:]
    for program in ("node", "npm"):
        if not shutil.which(program):
            sys.exit(f"tests/foreign: {program} is missing; run tools/setup full")
    source = os.path.join(root, "tests", "foreign")
    if not install(source, build):
        print("tests/foreign: skipped: its packages cannot be downloaded")
        sys.exit(SKIPPED)
    shutil.copy(os.path.join(source, "foreign.test.mjs"), build)
    environment = {**os.environ, "ROOT": root, "PROGRAMS": programs, "PATH": os.environ["PATH"] + ":/usr/sbin"}
    sys.exit(subprocess.run(["node", "--test", "foreign.test.mjs"], cwd=build, env=environment).returncode)


if __name__ == "__main__":
    main()
