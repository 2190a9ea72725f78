#!/usr/bin/env python3
"""The micro:bit's real image on an emulated board: the user uploads while button A is held, then the table runs a motor.

usage: microbit_test.py IMAGE.bin MACSIM NANOCTL SEQC [SEED]
"""

import contextlib
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

import machine
import microbit
import upload_test
import user_line as gw
from machine import until

IMAGE = MACSIM = NANOCTL = SEQC = ""
SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "machine.seq")
IDLING, LAMP, ARRIVED = 1, 4, 8
SAFE = 0b1010  # no step of machine.seq has these outputs
NOT_ENABLED = 18  # a result (REGISTERS.md)
GAVE_UP, GAVE_UP_AT = 28, 29  # events
WATCHDOG, HARD_FAULT = 1, 2
# Instructions: b ., cpsie i, udf
BRANCH_TO_ITSELF, INTERRUPTS, UNDEFINED = 0xE7FE, 0xB662, 0xDEFE


class Image(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.table = os.path.join(self.folder.name, "machine.bin")
        subprocess.run([SEQC, "build", SOURCE, "-o", self.table], check=True, capture_output=True)
        self.board = microbit.Microbit(IMAGE, self.folder.name).start()
        self.addCleanup(self.board.cut_power)

    def tool(self, *arguments):
        return subprocess.run([NANOCTL, "--port", self.board.endpoint(), "--patience", "2000", "--json", *arguments],
                              capture_output=True, text=True, timeout=4 * machine.LONG, check=False)

    def ctl(self, *arguments):
        result = self.tool(*arguments)
        self.assertEqual(result.returncode, 0, f"{arguments}: {result.stdout} {result.stderr}")
        return json.loads(result.stdout.splitlines()[-1])

    def shows(self, outputs):
        until(self.board.outputs, lambda seen: seen == outputs)

    def prepare(self):
        """In service: settings and table kept."""
        self.ctl("settings", "set", f"safe_outputs={SAFE}", "--keep")
        self.ctl("upload", self.table, "--only-store")
        self.permit()

    def permit(self):
        """Refused in service, and for the next start."""
        refused = self.tool("run")
        self.assertIn("started for service", refused.stdout + refused.stderr)
        until(lambda: self.ctl("status")["waits_for_first_run"], lambda waits: not waits)

    @contextlib.contextmanager
    def running_motor(self):
        self.board.cut_power()
        motor, line = machine.start_motor(MACSIM, self.folder.name, "--fastmac")
        try:
            self.board.start(motor=line)
            self.shows(IDLING)
            yield
        finally:
            motor.kill()
            motor.communicate()
            os.unlink(line)

    def serve_again(self):
        self.board.cut_power()
        self.board.start()

    def stack_bound(self):
        with open(re.sub(r"\.bin$", ".stack", IMAGE), encoding="utf-8") as file:
            return int(file.read().split()[0])

    def check_stack(self, least):
        used = self.board.stack_used()
        print(f"{used} bytes of stack used, {self.stack_bound()} computed")
        self.assertGreater(used, least, "the painted stack was not looked at")
        self.assertLessEqual(used, self.stack_bound())

    def test_nothing_runs_in_service(self):
        self.prepare()
        self.board.reset()
        refused = self.tool("run")
        self.assertNotEqual(refused.returncode, 0)
        self.assertIn("started for service", refused.stdout + refused.stderr)
        status = self.ctl("status")
        self.assertEqual((status["state"], status["enabled"], status["link"]), ("stopped", False, "down"))
        self.assertTrue(self.ctl("verify", self.table, "--bytes")["active"])
        self.assertEqual(self.board.outputs(), SAFE)
        self.check_stack(400)

    def test_the_table_runs_the_motor_and_outlives_power_cuts(self):
        self.prepare()
        for _ in range(2):
            with self.running_motor():
                self.board.drive_input(5, 1)
                self.shows(IDLING | LAMP)
                self.board.drive_input(0, 1)
                self.shows(ARRIVED)
                self.board.drive_input(5, 0)
                self.board.drive_input(0, 0)
                self.shows(IDLING)
                self.check_stack(400)
        self.serve_again()
        self.assertTrue(self.ctl("verify", self.table, "--bytes")["active"])
        self.shows(SAFE)

    def test_a_loop_that_hangs_ends_in_the_safe_state(self):
        self.prepare()
        with self.running_motor():
            debugger = self.board.debugger()
            debugger.run_code(INTERRUPTS, BRANCH_TO_ITSELF)
            debugger.resume()
            self.shows(SAFE)
            self.board.monitor.wait_for("RESET")
            until(self.board.loop_time, lambda microseconds: microseconds > 500_000)
            self.assertEqual(self.board.outputs(), SAFE, "it does not run by itself")

    def end_in_service(self, *code):
        """The reset that follows waits for this program; the log after it."""
        self.prepare()
        self.board.monitor.do("set-action", reboot="shutdown", shutdown="pause")
        debugger = self.board.debugger()
        debugger.run_code(*code)
        debugger.resume()
        self.board.monitor.wait_for("SHUTDOWN")
        self.assertEqual(self.board.outputs(), SAFE, "before the reset")
        self.board.monitor.do("set-action", reboot="reset", shutdown="poweroff")
        self.board.reset()
        line = gw.UserLine(self.board.path("user"))
        self.addCleanup(line.close)
        return line.log()

    def test_the_watchdog_tells_where_it_bit(self):
        log = self.end_in_service(INTERRUPTS, BRANCH_TO_ITSELF)
        self.assertIn((GAVE_UP, WATCHDOG), log)
        self.assertIn((GAVE_UP_AT, (microbit.SCRATCH + 2) & 0xFFFF), log)

    def test_a_fault_of_the_core_tells_where_it_was(self):
        log = self.end_in_service(UNDEFINED)
        self.assertIn((GAVE_UP, HARD_FAULT), log)
        self.assertIn((GAVE_UP_AT, microbit.SCRATCH & 0xFFFF), log)


class Uploads(upload_test.Uploads):
    resets, power_cuts = 30, 5

    def make_board(self, folder):
        return microbit.Microbit(IMAGE, folder, fast=True)


if __name__ == "__main__":
    IMAGE, MACSIM, NANOCTL, SEQC = sys.argv[1:5]
    upload_test.SEED = int(sys.argv[5]) if len(sys.argv) > 5 else 20261123
    unittest.main(argv=sys.argv[:1])
