#!/usr/bin/env python3
"""Every C++ file is as clang-format leaves it.

usage: format.py [ROOT]
"""

import os
import subprocess
import sys

import sources

TOOL = "clang-format-14"


def check_tree(root):
    paths = sources.cxx(root)
    findings = []
    for path in paths:
        text = sources.read(root, path)
        formatted = subprocess.run(
            [TOOL, f"--assume-filename={path}"], input=text, cwd=root, capture_output=True, text=True, check=True
        ).stdout
        if formatted != text:
            pairs = zip(text.splitlines() + [""], formatted.splitlines() + [""])
            line = next((n for n, (old, new) in enumerate(pairs, 1) if old != new), 1)
            findings.append(f"{path}:{line}: not formatted: {TOOL} -i {path}")
    return findings, len(paths), "source files"


if __name__ == "__main__":
    tree = sys.argv[1] if len(sys.argv) > 1 else os.path.join(os.path.dirname(__file__), "..", "..")
    sources.report(*check_tree(tree))
