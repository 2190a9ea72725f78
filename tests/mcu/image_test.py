#!/usr/bin/env python3
"""The real image on an emulated board, with a virtual motor on its motor line and the real tools on its user's line.

usage: image_test.py IMAGE.bin MACSIM NANOCTL MACREG SEQC
"""

import os
import re
import sys
import unittest

import image_case
import machine
import user_line as gw
from machine import until

SOURCE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "machine.seq")
IDLING, LAMP, ARRIVED = 1, 4, 8
SAFE = 0b1010  # no step of machine.seq has these outputs
GAVE_UP, GAVE_UP_AT = 28, 29  # events (REGISTERS.md)
WATCHDOG, WITHOUT_A_WORD, REASON_WATCHDOG = 1, 9, 6
# Instructions: b ., cpsie i, cpsid i, udf
BRANCH_TO_ITSELF, INTERRUPTS, NO_INTERRUPTS, UNDEFINED = 0xE7FE, 0xB662, 0xB672, 0xDEFE


class Case(image_case.ImageCase):
    def setUp(self):
        self.take_folder()
        self.table = self.compile(SOURCE)
        self.start_board("--model", "MAC140", "--fastmac")

    def upload_and_run(self):
        self.ctl("settings", "set", f"safe_outputs={SAFE}", "--keep")
        sent = self.ctl("upload", self.table, "--run")
        self.assertTrue(sent["active"] and sent["started"])
        self.shows(IDLING)
        return sent


class Image(Case):
    def test_a_new_board_waits_for_the_first_run(self):
        self.ctl("upload", self.table)
        for _ in range(2):
            self.ctl("reset")
            status = until(lambda: self.ctl("status"), lambda status: status["link"] == "up")
            self.assertEqual((status["state"], status["waits_for_first_run"]), ("stopped", True))
        self.ctl("run")
        self.shows(IDLING)
        self.board.cut_power()
        self.board.start()
        self.shows(IDLING)

    def test_a_table_is_uploaded_and_runs_and_outlives_reset_and_power_cut(self):
        sent = self.upload_and_run()
        self.ctl("stop")
        self.shows(SAFE)
        self.ctl("reset")
        self.shows(IDLING)
        self.board.cut_power()
        self.board.start()
        self.shows(IDLING)
        status = self.ctl("status")
        self.assertEqual((status["state"], status["table_crc32"]), ("running", sent["crc32"]))
        self.assertTrue(self.ctl("verify", self.table, "--bytes")["active"])

    def test_pins_lead_the_motor_and_tell_where_it_is(self):
        self.upload_and_run()
        self.board.drive_input(5, 1)
        self.shows(IDLING | LAMP)
        self.board.drive_input(5, 0)
        self.shows(IDLING)
        for _ in range(2):
            self.board.drive_input(0, 1)
            self.shows(ARRIVED)
            told = self.macreg("get", "P_IST")
            self.assertEqual(told.returncode, 0, told.stdout + told.stderr)
            self.board.drive_input(0, 0)
            self.shows(IDLING)
        self.assertGreaterEqual(self.ctl("status")["orders"], 6)

    def stack_bound(self):
        with open(re.sub(r"\.bin$", ".stack", image_case.IMAGE), encoding="utf-8") as file:
            return int(file.read().split()[0])

    def test_the_stack_stays_within_what_was_computed(self):
        self.upload_and_run()
        self.board.drive_input(0, 1)
        self.shows(ARRIVED)
        self.macreg("get", "P_IST", "V_IST")
        used = self.board.stack_used()
        print(f"{used} bytes of stack used, {self.stack_bound()} computed")
        self.assertGreater(used, 400, "the painted stack was not looked at")
        self.assertLessEqual(used, self.stack_bound())

    def hang_with(self, *halfwords):
        debugger = self.board.debugger()
        debugger.run_code(*halfwords)
        debugger.resume()

    def bitten(self, line):
        self.assertEqual(line.read(gw.SAFE_REASON), REASON_WATCHDOG)
        self.assertEqual(line.read(gw.STATUS) & 7, 0, "it does not run by itself")
        return line.log()

    def test_the_watchdog_bites_a_loop_that_hangs_and_tells_where(self):
        self.upload_and_run()
        self.hang_with(INTERRUPTS, BRANCH_TO_ITSELF)
        self.shows(SAFE)
        log = self.on_the_line(self.bitten)
        self.assertIn((GAVE_UP, WATCHDOG), log)
        self.assertIn((GAVE_UP_AT, (machine.SCRATCH + 2) & 0xFFFF), log)
        self.ctl("run")
        self.shows(IDLING)

    def test_the_watchdog_resets_a_core_that_takes_no_interrupts(self):
        self.upload_and_run()
        before = self.on_the_line(lambda line: line.read(gw.UPTIME))
        self.hang_with(NO_INTERRUPTS, BRANCH_TO_ITSELF)
        after = until(lambda: self.on_the_line(lambda line: line.read(gw.UPTIME)), lambda up: up < before)
        self.assertLess(after, before)
        self.assertIn((GAVE_UP, WITHOUT_A_WORD), self.on_the_line(self.bitten))
        self.ctl("run")
        self.shows(IDLING)
        self.ctl("stop")
        self.ctl("reset")
        self.shows(IDLING)
        self.assertEqual(self.on_the_line(lambda line: [event for event, _ in line.log() if event == GAVE_UP]), [])

    def test_a_fault_of_the_core_ends_in_the_safe_state_with_its_reason(self):
        self.upload_and_run()
        self.hang_with(UNDEFINED)
        self.shows(SAFE)
        log = self.on_the_line(self.bitten)
        causes = [detail for event, detail in log if event == GAVE_UP]
        self.assertEqual(causes, [2], "an undefined instruction escalates to a hard fault")
        self.assertIn((GAVE_UP_AT, machine.SCRATCH & 0xFFFF), log)


if __name__ == "__main__":
    image_case.take(*sys.argv[1:6])
    unittest.main(argv=sys.argv[:1])
