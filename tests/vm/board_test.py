#!/usr/bin/env python3
"""The Linux side of the firmware on the virtual board: GPIO lines with both generations of libgpiod, CAN, the
watchdog, a serial adapter.

usage: board_test.py

Fetches and builds what is missing. 77: the virtual board is not to be had; the reason is printed.
"""

import os
import shutil
import subprocess
import sys
import tempfile
import threading
import time

import board

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
# After the watchdog has reset the board this runs again.
SCRIPT = """
export GTEST_COLOR=no
if [ -e before ]; then exec ./watchdog --gtest_filter='AfterTheReset.*'; fi
touch before
failed=''
for part in gpio_* can uart; do ./$part --gtest_filter=-GpioGone.* || failed="$failed $part"; done
for part in gpio_*; do ./$part --gtest_filter=GpioGone.* || failed="$failed $part"; done
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


def build(share, preset, programs, *sysroot):
    """The programs, by their names in the share. Raises CannotBeHad without the libraries for them."""
    if subprocess.run([os.path.join(ROOT, "tools", "sysroot"), *sysroot, "arm64"], check=False).returncode != 0:
        raise board.CannotBeHad
    for step in (["cmake", "--preset", preset], ["cmake", "--build", "--preset", preset, "--parallel", "2"]):
        done = subprocess.run(step, cwd=ROOT, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"{done.stdout}{done.stderr}\nvm: {' '.join(step)} failed")
    for name, program in programs.items():
        shutil.copy(os.path.join(ROOT, "build", preset, "bin", program), os.path.join(share, name))


def echo(line):
    """The other end of the adapter's line says everything again."""
    while heard := line.recv(4096):
        line.sendall(heard)


def run(phases, share):
    board.prepare()
    phases.say("building the tests for the board")
    build(share, "board", {"gpio_1": "board_gpio_test", "can": "board_can_test", "uart": "board_uart_test",
                           "watchdog": "board_watchdog_test"})
    try:
        build(share, "board-libgpiod2", {"gpio_2": "board_gpio_test"}, "--libgpiod2")
    except board.CannotBeHad:
        print("vm: skipped: the lines with libgpiod 2, which the backports do not have (see above)")
    phases.say("starting the board")
    with board.Board(share, SCRIPT, serials=["outside"], adapters=["adapter"], reboots=True) as machine:
        threading.Thread(target=echo, args=[machine.serials["adapter"]], daemon=True).start()
        machine.serve_lines("outside")
        return machine.finish()


def main():
    phases = Phases()
    with tempfile.TemporaryDirectory(prefix="share") as share:
        try:
            status = run(phases, share)
        except board.CannotBeHad:
            print("vm: skipped, for packages cannot be downloaded (see above)")
            return 77
    phases.say(f"the board is off, with status {status}")
    return 0 if status == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
