#!/usr/bin/env python3
"""Every C++ file is as clang-format leaves it.

usage: format.py [ROOT]
"""

import concurrent.futures
import os
import re
import subprocess
import sys

import sources

TOOL = "clang-format-14"
BATCH = 100  # starting the tool costs more than one file does


def findings_of(root, paths):
    run = subprocess.run([TOOL, "--dry-run", "--ferror-limit=0", *paths], cwd=root, capture_output=True, text=True, check=False)
    if run.returncode != 0:
        return [run.stderr.strip()]
    first = {}
    for path, line in re.findall(r"(?m)^(\S+?):(\d+):\d+: warning: code should be clang-formatted", run.stderr):
        first.setdefault(path, line)
    return [f"{path}:{line}: not formatted: {TOOL} -i {path}" for path, line in first.items()]


def check_tree(root):
    paths = sources.cxx(root)
    batches = [paths[i : i + BATCH] for i in range(0, len(paths), BATCH)]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        findings = [one for found in pool.map(lambda batch: findings_of(root, batch), batches) for one in found]
    return findings, len(paths), "source files"


if __name__ == "__main__":
    tree = sys.argv[1] if len(sys.argv) > 1 else os.path.join(os.path.dirname(__file__), "..", "..")
    sources.report(*check_tree(tree))
