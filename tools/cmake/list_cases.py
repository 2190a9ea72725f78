#!/usr/bin/env python3
"""Prints the test cases of a script, a line each, as unittest names them on the command line.

usage: list_cases.py SCRIPT
"""

import importlib
import os
import sys
import unittest


def cases(suite):
    for one in suite:
        if isinstance(one, unittest.TestSuite):
            yield from cases(one)
        else:
            yield one.id().split(".", 1)[1]


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    path = os.path.abspath(sys.argv[1])
    sys.path.insert(0, os.path.dirname(path))
    name = os.path.basename(path).removesuffix(".py")
    module = importlib.import_module(name)
    print("\n".join(cases(unittest.defaultTestLoader.loadTestsFromModule(module))))


if __name__ == "__main__":
    main()
