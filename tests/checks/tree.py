#!/usr/bin/env python3
"""Checks on the tree itself: READMEs, lengths of files, scripts.

usage: tree.py readmes|file_length|scripts [ROOT]
"""

import os
import re
import subprocess
import sys

import sources

MAX_LINES = 500
MEASURED = (".h", ".cpp", ".py", ".cmake", ".sh")
LINK = re.compile(r"\]\(([^)#\s]+)[^)]*\)")


def readmes(root):
    """Every folder with a CMakeLists.txt has a README.md; the first one names both commands; no link is dead."""
    paths = sources.files(root)
    findings = []
    folders = [os.path.dirname(path) for path in paths if os.path.basename(path) == "CMakeLists.txt"]
    for folder in folders:
        readme = os.path.join(folder, "README.md")
        if readme not in paths:
            findings.append(f"{readme}: missing: every folder says what lives there, what may not, where to start")
    if "README.md" in paths:
        text = sources.read(root, "README.md")
        findings += [f"README.md: does not name {c}" for c in ("tools/demo", "tools/test") if c not in text]
    for path in paths:
        if path.endswith(".md"):
            findings += dead_links(root, path)
    return findings, len(folders), "folders"


def dead_links(root, path):
    for target in LINK.findall(sources.read(root, path)):
        if "://" in target or target.startswith("mailto:"):
            continue
        if not os.path.exists(os.path.join(root, os.path.dirname(path), target)):
            yield f"{path}: dead link: {target}"


def file_length(root):
    """No source file is longer than MAX_LINES."""
    paths = [p for p in sources.files(root) if p.endswith(MEASURED) or is_script(root, p)]
    findings = []
    for path in paths:
        lines = sources.read(root, path).count("\n")
        if lines > MAX_LINES:
            findings.append(f"{path}: {lines} lines, {MAX_LINES} at the most: split it by purpose")
    return findings, len(paths), "files"


def is_script(root, path):
    with open(os.path.join(root, path), "rb") as file:
        first = file.readline()
    return first.startswith(b"#!") and b"bash" in first


def scripts(root):
    """Scripts parse and may be executed; those a user calls answer --help; Python compiles."""
    findings, checked = [], 0
    for path in sources.files(root):
        if path.endswith(".py"):
            checked += 1
            findings += python_errors(root, path)
        elif is_script(root, path) or path.endswith(".sh"):
            checked += 1
            findings += bash_errors(root, path)
    return findings, checked, "scripts"


def python_errors(root, path):
    try:
        compile(sources.read(root, path), path, "exec")
    except SyntaxError as error:
        yield f"{path}:{error.lineno}: {error.msg}"


def bash_errors(root, path):
    full = os.path.join(root, path)
    parsed = subprocess.run(["bash", "-n", full], capture_output=True, text=True, check=False)
    if parsed.returncode != 0:
        yield f"{path}: {parsed.stderr.strip()}"
        return
    if not is_script(root, path):
        return
    if not os.access(full, os.X_OK):
        yield f"{path}: not executable: chmod +x {path}"
    elif os.path.dirname(path) == "tools":
        helped = subprocess.run([full, "--help"], capture_output=True, text=True, check=False, timeout=30)
        if helped.returncode != 0 or not helped.stdout.startswith("usage:"):
            yield f'{path}: --help must print "usage: ..." and exit 0'


CHECKS = {check.__name__: check for check in (readmes, file_length, scripts)}

if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[1] not in CHECKS:
        sys.exit(__doc__)
    tree = sys.argv[2] if len(sys.argv) > 2 else os.path.join(os.path.dirname(__file__), "..", "..")
    sources.report(*CHECKS[sys.argv[1]](tree))
