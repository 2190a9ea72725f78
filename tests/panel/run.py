#!/usr/bin/env python3
"""Runs tests of the panel in a browser, with their npm packages in the build folder.

usage: run.py ROOT PROGRAMS BUILD --packages|NAME...|--figure latency|memory|jitter|day

NAME.test.mjs is run with node's own runner; figures.mjs measures. Exit code 77, skipped: the packages cannot be downloaded here.
"""

import os
import shutil
import subprocess
import sys

from npm_packages import install

SKIPPED = 77
NEEDED = ("node", "npm", "chromium")


def fail(text):
    print(f"tests/panel: {text}", file=sys.stderr)
    sys.exit(1)


def copy_whole(source, target):
    """Others of these tests may be reading the target."""
    part = f"{target}.{os.getpid()}"
    shutil.copy(source, part)
    os.replace(part, target)


def main():
    root, programs, build = (os.path.abspath(path) for path in sys.argv[1:4])
    names = sys.argv[4:]
    for program in NEEDED:
        if not shutil.which(program):
            fail(f"{program} is missing; run tools/setup full")
    source = os.path.join(root, "tests", "panel")
    tests, page = os.path.join(build, "tests"), os.path.join(build, "page")
    if not install(source, tests) or not install(os.path.join(root, "firmware", "faces", "panel", "page"), page):
        print("tests/panel: skipped: its packages cannot be downloaded")
        sys.exit(SKIPPED)
    if names == ["--packages"]:
        return
    for name in os.listdir(source):
        if name.endswith(".mjs"):
            copy_whole(os.path.join(source, name), os.path.join(tests, name))
    environment = {**os.environ, "ROOT": root, "PROGRAMS": programs, "PAGE": page}
    if names[0] == "--figure":
        sys.exit(subprocess.run(["node", "figures.mjs", *names[1:]], cwd=tests, env=environment).returncode)
    files = [f"{name}.test.mjs" for name in names]
    sys.exit(subprocess.run(["node", "--test", "--test-concurrency=1", *files], cwd=tests, env=environment).returncode)


if __name__ == "__main__":
    main()
