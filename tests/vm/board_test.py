#!/usr/bin/env python3
"""The Linux side of the firmware on the virtual board: GPIO lines with both generations of libgpiod, CAN, the
watchdog, a serial adapter.

usage: board_test.py

Fetches and builds what is missing. 77: the virtual board is not to be had; the reason is printed.
"""

import sys
import threading

import board
from board_run import build, in_share

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


def echo(line):
    """The other end of the adapter's line echoes everything."""
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
        status = machine.finish()
    phases.say(f"the board is off, with status {status}")
    return status


if __name__ == "__main__":
    sys.exit(in_share(run))
