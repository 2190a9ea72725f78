#!/usr/bin/env python3
"""Checks on the tree itself: READMEs, sizes of classes and functions, scripts.

usage: tree.py readmes|sizes|scripts [ROOT]
"""

import os
import re
import subprocess
import sys

import large_classes
import sources

MAX_LINES = 60
MAX_METHODS = 40
MAX_MEMBERS = 20
NO_CODE = re.compile(
    r"""//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])'|^[ \t]*\#[^\n]*""", re.DOTALL | re.MULTILINE
)
CLASS = re.compile(r"(?<!enum )\b(?:class|struct)\s+(\w+(?:::\w+)*)[^;{}()=]*\{")
ACCESS = re.compile(r"^(?:(?:public|private|protected) ?: ?)+")
NO_METHOD = re.compile(r"(?:using|friend|static_assert|typedef|enum|struct|class|union)\b|.*= ?(?:default|delete)$")
METHOD = re.compile(r"[^={]*?(?:\w|operator ?\S+?) ?\(")
MEMBER = re.compile(r".*\w_(?:\[.*\])?(?: ?\{| ?=.*)?$")
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


def sizes(root, large=large_classes.CLASSES):
    """No class has more than MAX_METHODS methods or MAX_MEMBERS data members, except the large ones within their own limits,
    and no function of the product more than MAX_LINES lines."""
    paths = [p for p in sources.files(root) if p.endswith((".h", ".cpp"))]
    findings, met = [], set()
    for path in paths:
        text = sources.read(root, path)
        for name, methods, members in classes(text):
            entry = f"{path}:{name}"
            if methods > MAX_METHODS or members > MAX_MEMBERS:
                met.add(entry)
            findings += too_large(entry, methods, members, large.get(entry))
        for line, count in functions(text.split("\n")):
            if count > MAX_LINES and not path.startswith("tests/"):
                findings.append(f"{path}:{line}: {count} lines of one function, {MAX_LINES} at the most")
    for entry in sorted(set(large) - met):
        findings.append(f"{entry}: within the limits or gone: take it out of tests/checks/large_classes.py")
    return findings, len(paths), "files"


def too_large(entry, methods, members, exception):
    most_methods = exception.methods if exception and exception.methods else MAX_METHODS
    most_members = exception.members if exception and exception.members else MAX_MEMBERS
    for count, most, what in ((methods, most_methods, "methods"), (members, most_members, "data members")):
        if count > most:
            yield f"{entry}: {count} {what}, {most} at the most: split it by what it is responsible for"


def classes(text):
    """Name, number of methods and number of data members (named with a _ at the end) of each class."""
    code = NO_CODE.sub(" ", text)
    for begun in CLASS.finditer(code):
        methods = members = 0
        for declaration in declarations(code, begun.end()):
            if is_method(declaration):
                methods += 1
            elif MEMBER.match(declaration):
                members += 1
        yield begun[1], methods, members


def declarations(code, at):
    """The declarations of the class whose { ends in front of `at`, without the contents of braces."""
    depth, current, found = 0, "", []
    for position in range(at, len(code)):
        c = code[position]
        if c == "{":
            depth += 1
            current += c if depth == 1 else ""
        elif c == "}" and depth == 0:
            break
        elif c == "}":
            depth -= 1
        elif depth == 0:
            current += c
        ends_body = c == "}" and depth == 0 and not code[position + 1 :].lstrip()[:1] in (";", ",", "{")
        if (c == ";" and depth == 0) or ends_body:
            found.append(ACCESS.sub("", " ".join(current.strip(";").split())))
            current = ""
    return found


def is_method(declaration):
    if NO_METHOD.match(declaration):
        return False
    before, rest = "", re.sub(r"->|<=>|operator ?<+", "", declaration)
    while before != rest:
        before, rest = rest, re.sub(r"<[^<>]*>", "", rest)
    return METHOD.match(rest) is not None


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
