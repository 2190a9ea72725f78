#!/usr/bin/env python3
"""Prints the sources of tests that depend on when something happens, a line each.

usage: real_time.py FOLDER

Looks at every source in the folders of FOLDER, and at what it imports or includes from its own folder and from the others.
"""

import functools
import os
import re
import sys

PYTHON = {"asyncio", "pty", "select", "selectors", "socket", "socketserver", "threading", "time"}
IMPORT = re.compile(r"^(?:import|from) (\w+)", re.MULTILINE)
CPP = re.compile(r"<(?:thread|sys/socket\.h|poll\.h|sys/epoll\.h|pty\.h|pthread\.h|sys/un\.h)>|\bopenpty\b|\bposix_openpt\b|\bsleep_for\b"
                 r"|\bnanosleep\b|\busleep\b|\b(?:steady|system|high_resolution)_clock::now\b|\bstd::clock\(|\"(?:hal_)?linux/")
INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)


@functools.cache
def folders(tests):
    return sorted(entry.path for entry in os.scandir(tests) if entry.is_dir())


@functools.cache
def neighbour(path, name):
    """The file of that name beside it, or in another folder of the tests."""
    folder = os.path.dirname(path)
    tests = os.path.dirname(folder)
    for place in [folder, *folders(tests)]:
        candidate = os.path.join(place, name)
        if os.path.isfile(candidate):
            return candidate
    return None


@functools.cache
def content(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def reason(path, seen):
    """Why, or None."""
    if path in seen:
        return None
    seen.add(path)
    text = content(path)
    name = os.path.basename(path)
    if path.endswith(".py"):
        imported = IMPORT.findall(text)
        found = sorted(PYTHON.intersection(imported))
        if found:
            return f"{name} imports {found[0]}"
        if "timeout=" in text:
            return f"{name} sets a deadline"
        used = [neighbour(path, module + ".py") for module in imported]
    else:
        found = CPP.search(text)
        if found:
            return f"{name} uses {found[0]}"
        used = [neighbour(path, header) for header in INCLUDE.findall(text)]
        used += [header.removesuffix(".h") + ".cpp" for header in used if header and os.path.isfile(header.removesuffix(".h") + ".cpp")]
    for other in used:
        why = other and reason(other, seen)
        if why:
            return why
    return None


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    for folder in folders(os.path.abspath(sys.argv[1])):
        for entry in os.scandir(folder):
            if entry.name.endswith((".py", ".cpp")) and reason(entry.path, set()):
                print(entry.path)


if __name__ == "__main__":
    main()
