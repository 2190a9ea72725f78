#!/usr/bin/env python3
"""Runs the core's own tests on an emulated Cortex-M3: units_test.py BUILD_FOLDER

Fails when a test fails, and when an image or a suite has run none. What is left out: units/README.md."""

import pathlib
import re
import sys

import emulated

SUITE = re.compile(r"suite (\w+): (\d+) tests, (\d+) checks, (\d+) failures")
IMAGES = ("sequencer", "protocol", "motor", "gateway", "store", "hal_mcu")


def main():
    folder = pathlib.Path(sys.argv[1])
    emulated.build(folder)
    total = 0
    for name in IMAGES:
        lines = emulated.run("mps2-an385", str(folder / "units" / f"units_{name}.elf"))
        suites = [match.groups() for match in map(SUITE.match, lines) if match]
        tests = sum(int(count) for _, count, _, _ in suites)
        if not suites or any(int(tests) == 0 or int(checks) == 0 for _, tests, checks, _ in suites):
            sys.exit(f"{name}: a suite without tests or checks:\n" + "\n".join(lines))
        for suite, count, checks, _ in suites:
            print(f"  {name:10} {suite:24} {count:>4} tests {checks:>8} checks")
        total += tests
    print(f"{total} tests on the emulated Cortex-M3")


if __name__ == "__main__":
    main()
