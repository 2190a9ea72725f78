#!/usr/bin/env python3
"""Checks on the tree itself: READMEs, sizes of classes and functions, scripts.

usage: tree.py readmes|sizes|scripts [ROOT]
"""

import os
import re
import subprocess
import sys

import sources

MAX_LINES = 60
MAX_MEMBERS = 30
CLASS = re.compile(r"^( *)(?:class|struct)\s+(\w+)[^;{]*\{$")
MEMBER = re.compile(r"^\s+(?!return\b|using\b)[\w:<>,&*.\s()+-]+\b\w+_\s*(?:\{.*\}|=.*)?;")
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


def sizes(root):
    """No class has more than MAX_MEMBERS data members, no function of the product more than MAX_LINES lines."""
    paths = [p for p in sources.files(root) if p.endswith((".h", ".cpp"))]
    findings = []
    for path in paths:
        lines = sources.read(root, path).split("\n")
        for name, count in members(lines):
            if count > MAX_MEMBERS:
                findings.append(f"{path}: {name} has {count} data members, {MAX_MEMBERS} at the most: split it by what it is responsible for")
        for line, count in functions(lines):
            if count > MAX_LINES and not path.startswith("tests/"):
                findings.append(f"{path}:{line}: {count} lines of one function, {MAX_LINES} at the most")
    return findings, len(paths), "files"


def members(lines):
    """The data members of each class, as clang-format lays them out: one a line, named with a _ at the end."""
    open_classes = []
    for line in lines:
        begun = CLASS.match(line)
        if begun:
            open_classes.append([begun[1], begun[2], 0])
        elif open_classes:
            indent = open_classes[-1][0]
            if re.match(rf"{indent}\}}.*;$", line):
                yield open_classes.pop()[1:]
            elif re.match(rf"{indent}    \S", line) and MEMBER.match(line):
                open_classes[-1][2] += 1


def functions(lines):
    """First line, counted from 1, and length of each function outside a class: from column 1 to a } there."""
    begin = None
    for number, line in enumerate(lines, 1):
        if line == "}" and begin is not None:
            yield begin, number - begin + 1
            begin = None
        elif line.endswith(") {") or line.endswith(") const {"):
            if not line[0].isspace():
                begin = number


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


CHECKS = {check.__name__: check for check in (readmes, sizes, scripts)}

if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[1] not in CHECKS:
        sys.exit(__doc__)
    tree = sys.argv[2] if len(sys.argv) > 2 else os.path.join(os.path.dirname(__file__), "..", "..")
    sources.report(*CHECKS[sys.argv[1]](tree))
