#!/usr/bin/env python3
"""Counts instructions of the firmware on the emulated board: counts_test.py BUILD_FOLDER BOARD_README [--write]

Counts twice, and fails unless both counts are equal and are those of the README; --write puts them there."""

import pathlib
import re
import sys

import emulated

ROW = re.compile(r"\W*(.+): (\d+)$")
BEGIN, END = "| instructions | |\n| --- | --- |\n", "\n\n"


def count(image):
    # Time is instructions, 1024 ns each.
    lines = emulated.run("lm3s6965evb", str(image), "-icount", "shift=10,sleep=off", "-chardev", "stdio,id=line,signal=off",
                         "-serial", "chardev:line", characters="U" * 60000)
    rows = [match.groups() for match in map(ROW.match, lines) if match]
    return "".join(f"| {name} | {int(number):,} |\n" for name, number in rows)


def main():
    folder, readme = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    emulated.build(folder)
    first, second = (count(folder / "units" / "counts.elf") for _ in range(2))
    print(first)
    if first != second or not first:
        sys.exit(f"counted again, it is not the same:\n{second}")
    text = readme.read_text(encoding="utf-8")
    begin = text.index(BEGIN) + len(BEGIN)
    end = text.index(END, begin) + 1
    if "--write" in sys.argv:
        readme.write_text(text[:begin] + first + text[end:], encoding="utf-8")
    elif text[begin:end] != first:
        sys.exit(f"{readme} has other figures:\n{text[begin:end]}\n{sys.argv[0]} ... --write puts these there")


if __name__ == "__main__":
    main()
