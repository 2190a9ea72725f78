#!/usr/bin/env python3
"""Fetches and builds what the tests on the virtual board are made of, all at once: CTest's build.board. They need not
look after it then, and may run side by side.

usage: build_programs.py

Failed downloads are reported; the tests that need it are skipped.
"""

import sys

import board
from board_run import compile_for_board

TARGETS = ("board_tests", "nanoplc", "midisim", "macreg")


def main():
    try:
        board.prepare()
        compile_for_board("board", targets=TARGETS)
    except board.CannotBeHad:
        print("vm: packages for the virtual board cannot be downloaded (see above)")
        return
    try:
        compile_for_board("board-libgpiod2", "--libgpiod2")
    except board.CannotBeHad:
        print("vm: libgpiod 2 is not in the backports (see above)")


if __name__ == "__main__":
    sys.exit(main())
