#!/usr/bin/env python3
"""The Linux side of the firmware on the virtual board: GPIO lines with both generations of libgpiod, CAN, the watchdog.

usage: board_test.py

Fetches and builds what is missing. 77: the virtual board is not to be had; the reason is printed.
"""

import os
import shutil
import subprocess
import sys
import tempfile
import time

import board

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
PROGRAMS = {
    "gpio_libgpiod1": "build/board/bin/board_gpio_test",
    "gpio_libgpiod2": "build/board-libgpiod2/bin/board_gpio_test",
    "can": "build/board/bin/board_can_test",
    "watchdog": "build/board/bin/board_watchdog_test",
}

# After the watchdog has reset the board this runs again.
SCRIPT = """
if [ -e before ]; then exec ./watchdog --gtest_filter='AfterTheReset.*'; fi
touch before
export GTEST_COLOR=no
failed=''
for part in gpio_libgpiod1 gpio_libgpiod2 can; do ./$part --gtest_filter=-GpioGone.* || failed="$failed $part"; done
for part in gpio_libgpiod1 gpio_libgpiod2; do ./$part --gtest_filter=GpioGone.* || failed="$failed $part"; done
./watchdog --gtest_filter='BoardWatchdog.*' || failed="$failed watchdog"
if [ -n "$failed" ]; then echo "failed:$failed"; exit 1; fi
./watchdog --gtest_filter='StarvedWatchdog.*'
echo 'the watchdog did not reset the board'; exit 1
"""


class Phases:
    """Says how long each part took."""

    def __init__(self):
        self.start = time.monotonic()

    def say(self, words):
        print(f"vm: {words} (after {time.monotonic() - self.start:.0f} s)", flush=True)


def build(preset, *sysroot):
    subprocess.run([os.path.join(ROOT, "tools", "sysroot"), *sysroot, "arm64"], check=True)
    for step in (["cmake", "--preset", preset], ["cmake", "--build", "--preset", preset, "--parallel", "2"]):
        done = subprocess.run(step, cwd=ROOT, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"{done.stdout}{done.stderr}\nvm: {' '.join(step)} failed")


def main():
    phases = Phases()
    try:
        board.prepare()
    except board.CannotBeHad:
        return 77
    phases.say("building the tests for the board")
    build("board")
    build("board-libgpiod2", "--libgpiod2")
    phases.say("starting the board")
    with tempfile.TemporaryDirectory(prefix="share") as share:
        for name, path in PROGRAMS.items():
            shutil.copy(os.path.join(ROOT, path), os.path.join(share, name))
        with board.Board(share, SCRIPT, serials=["outside"], reboots=True) as machine:
            machine.serve_lines("outside")
            status = machine.finish()
    phases.say(f"the board is off, with status {status}")
    return 0 if status == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
