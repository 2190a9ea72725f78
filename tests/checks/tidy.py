#!/usr/bin/env python3
"""clang-tidy over the core, with the checks of .clang-tidy.

usage: tidy.py ROOT

Configures preset tidy, whose compile_commands.json names the flags of each file.
"""

import concurrent.futures
import json
import os
import subprocess
import sys

import sources

TOOL = "clang-tidy-14"
FOLDERS = ("hal/", "sequencer/", "firmware/")


def core_files(root, build):
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        commands = json.load(file)
    paths = {os.path.relpath(os.path.join(c["directory"], c["file"]), root) for c in commands}
    return sorted(path for path in paths if path.startswith(FOLDERS))


def tidy(root, build, path):
    run = subprocess.run(
        [TOOL, "--quiet", "-p", build, path], cwd=root, capture_output=True, text=True, check=False
    )
    if run.returncode == 0:
        return None
    return run.stdout.strip() or run.stderr.strip() or f"{path}: {TOOL} ended with {run.returncode}"


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    root = os.path.abspath(sys.argv[1])
    configured = subprocess.run(["cmake", "--preset", "tidy"], cwd=root, capture_output=True, text=True, check=False)
    if configured.returncode != 0:
        sys.exit(f"{configured.stdout}{configured.stderr}\ncmake --preset tidy failed")
    build = os.path.join(root, "build", "tidy")
    paths = core_files(root, build)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        findings = list(pool.map(lambda path: tidy(root, build, path), paths))
    sources.report([finding for finding in findings if finding], len(paths), "source files")


if __name__ == "__main__":
    main()
