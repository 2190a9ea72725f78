#!/usr/bin/env python3
"""The real image on an emulated board, with a virtual MIDI drive on its motor line and the real tools on its user's line.

usage: midi_test.py IMAGE.bin MIDISIM NANOCTL MACREG SEQC MIDI_PICK_AND_PLACE.seq
"""

import json
import re
import sys
import unittest

import image_case
import user_line as gw
from machine import until

EXAMPLE = ""
MAC34_1 = 2  # of setting motor_kind
START, GRIP, LAMP = 0, 1, 8
TURNS = 0.2
# The example goes 60 mm at 1500 rpm. The emulated core's clock loses the ticks in which the emulator has no processor, and a
# drive that goes on meanwhile is further than its speed allows: the driver calls that a jump, from 500 increments on.
SLOWLY = (("P2 := 60 mm", "P2 := 1 mm"), ("V1 := 1500 rpm", "V1 := 10 rpm"), ("WITHIN T#3s", "WITHIN T#60s"))
COUNTS, INCREMENTS = 4096, 10000  # a revolution
HOMING = """PROGRAM P
MOTOR MAC140;
STEP S: OWN ERROR; IF IN0 THEN HOME; NEXT := T; END_IF END_STEP
STEP T: OWN ERROR; IF IN1 THEN NEXT := S; END_IF END_STEP
END_PROGRAM
"""


class Midi(image_case.ImageCase):
    def setUp(self):
        self.take_folder()
        self.start_board("--model", "MAC34-1", "--address", "5", "--eeprom", self.path("eeprom"), "--v24")
        self.ctl("settings", "set", f"motor_kind={MAC34_1}", "midi_address=5", "motor_baud=38400", "--keep")
        self.assertEqual(self.ctl("status")["link"], "down", "the kind counts from the next reset on")
        self.ctl("reset")
        until(lambda: self.ctl("status")["link"], lambda link: link == "up")

    def compile_example(self):
        with open(EXAMPLE, encoding="utf-8") as file:
            text = file.read()
        for old, new in SLOWLY:
            self.assertIn(old, text)
            text = text.replace(old, new)
        with open(self.path("slow.seq"), "w", encoding="utf-8") as file:
            file.write(text)
        return self.compile(self.path("slow.seq"))

    def increments(self):
        """As the module keeps them when a motion has ended."""
        with open(self.path("eeprom"), encoding="utf-8") as file:
            found = re.search(r"(?m)^position = (-?\d+)$", file.read())
        return int(found[1]) if found else None

    def counts(self):
        told = self.macreg("get", "P_IST")
        self.assertEqual(told.returncode, 0, told.stdout + told.stderr)
        return json.loads(told.stdout.splitlines()[-1])["registers"][0]["raw"]

    def test_a_table_is_uploaded_and_leads_the_drive_after_a_reset(self):
        self.ctl("upload", self.compile_example(), "--run")
        self.ctl("stop")
        self.ctl("reset")
        self.shows(LAMP)
        self.board.drive_input(START, 1)
        self.shows(GRIP)
        self.board.drive_input(START, 0)
        until(self.increments, lambda there: there == TURNS * INCREMENTS)
        self.shows(LAMP)
        until(self.increments, lambda back: back == 0)
        self.assertEqual(self.counts(), 0)
        status = self.ctl("status")
        self.assertEqual((status["state"], status["error"]), ("running", False))

    def test_where_the_drive_stands_is_read_through_the_gateway(self):
        self.ctl("upload", self.compile_example(), "--run")
        self.shows(LAMP)
        self.board.drive_input(START, 1)
        self.shows(GRIP)
        until(self.increments, lambda there: there == TURNS * INCREMENTS)
        self.ctl("stop")
        self.assertAlmostEqual(self.counts(), TURNS * COUNTS, delta=1)

    def test_a_table_for_a_jvl_motor_is_refused_with_the_reason(self):
        with open(self.path("homing.seq"), "w", encoding="utf-8") as file:
            file.write(HOMING)
        refused = self.tool(image_case.NANOCTL, "upload", self.compile(self.path("homing.seq")))
        self.assertNotEqual(refused.returncode, 0)
        self.assertIn("a MIDI drive searches no home", refused.stdout + refused.stderr)
        state = self.on_the_line(lambda line: line.read(gw.UPLOAD_STATE))
        self.assertEqual((state & 0xFF, state >> 8 & 0xFF), (gw.FAILED, gw.NOT_FOR_MOTOR))


if __name__ == "__main__":
    image_case.take(*sys.argv[1:6])
    EXAMPLE = sys.argv[6]
    unittest.main(argv=sys.argv[:1])
