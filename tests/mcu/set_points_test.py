#!/usr/bin/env python3
"""The image with set-points on an emulated board: values and recipes of an example, over the user's line, a power cut and a new upload.

usage: set_points_test.py IMAGE.bin MACSIM NANOCTL MACREG SEQC PROGRAM.seq
"""

import os
import sys
import unittest

import image_case

PROGRAM = ""
READY = 0b0010  # Idle's output


class SetPoints(image_case.ImageCase):
    def setUp(self):
        self.take_folder()
        self.table = self.compile(PROGRAM)
        self.start_board("--model", "MAC140", "--fastmac")
        self.ctl("upload", self.table, "--run")
        self.shows(READY)

    def values(self):
        return {point["name"]: point["value"] for point in self.ctl("set-points")["set_points"]}

    def test_values_and_recipes_outlive_a_power_cut(self):
        before = self.values()
        self.assertEqual(before["Pieces"], 3)
        self.ctl("set-points", "set", "Pieces=7", "Length=120mm")
        self.ctl("recipe", "save", "Long")
        self.ctl("set-points", "set", "Pieces=2", "Length=40mm")
        self.ctl("recipe", "save", "Short")
        self.board.cut_power()
        self.board.start()
        self.shows(READY)
        self.assertEqual(self.values()["Pieces"], 2)
        self.ctl("recipe", "load", "Long")
        self.assertEqual(self.values()["Pieces"], 7)

    def test_what_is_beyond_its_range_is_refused_whole(self):
        before = self.values()
        refused = self.tool(image_case.NANOCTL, "set-points", "set", "Length=100mm", "Pieces=1000")
        self.assertEqual(refused.returncode, 2, refused.stdout)
        for words in ("Pieces", "1", "999"):
            self.assertIn(words, refused.stdout + refused.stderr)
        self.assertEqual(self.values(), before)

    def test_an_upload_of_the_same_program_keeps_them(self):
        self.ctl("set-points", "set", "Pieces=9")
        self.ctl("upload", self.table, "--stop", "--run")
        self.assertEqual(self.values()["Pieces"], 9)


if __name__ == "__main__":
    image_case.take(*(os.path.abspath(program) for program in sys.argv[1:6]))
    PROGRAM = os.path.abspath(sys.argv[6])
    unittest.main(argv=[sys.argv[0], *sys.argv[7:]])
