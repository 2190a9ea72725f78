#!/usr/bin/env python3
"""The timeline of a scenario as nanoplc-sim shows it on a terminal.

usage: scenario_terminal_test.py NANOPLC_SIM README
"""

import fcntl
import os
import pty
import re
import struct
import subprocess
import sys
import termios
import unittest

import scenario_test
from scenario_test import Case, blocks


class Narrow(Case):

    def on_a_terminal(self, columns, *arguments):
        ours, theirs = pty.openpty()
        fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
        with subprocess.Popen([scenario_test.PROGRAM, "run", *arguments], cwd=self.folder.name, stdin=subprocess.DEVNULL,
                              stdout=theirs, stderr=subprocess.DEVNULL) as process:
            os.close(theirs)
            text = b""
            try:
                while block := os.read(ours, 65536):
                    text += block
            except OSError:  # the other end is closed
                pass
            os.close(ours)
            self.assertEqual(process.wait(), 0)
        plain = re.sub(r"\x1b\[[0-9;]*m", "", text.decode()).replace("\r", "")
        return plain.split("\n\n")[1].split("\n")  # between heading and summary

    def happened(self, lines, column):
        return " ".join(line[column:].strip() for line in lines).replace("  ", " ")

    def test_eighty_columns_hold_all_that_happens(self):
        ((_, program),) = blocks("seq")
        self.put("station.seq", program)
        self.put("s.scn", blocks("scn")[1][1] + "at 500 ms log \"" + "a long remark " * 12 + "x" * 100 + "\"\n")
        run = ["station.seq", "--scenario", "s.scn"]
        narrow = self.on_a_terminal(80, *run)
        self.assertLessEqual(max(map(len, narrow)), 80)
        self.assertEqual(narrow[0].split(), ["time", "step", "P_IST", "V_IST", "what", "happens"])
        self.assertEqual(narrow[1].split(), ["ms", "mm", "rpm"])
        wide = self.on_a_terminal(250, *run)
        self.assertIn("inputs", wide[0])
        told = re.sub(r"[^\w()]", "", self.happened(narrow[2:], narrow[0].index("what happens")))
        for line in wide[2:]:
            for event in line[wide[0].index("what happens"):].split(", "):
                self.assertIn(re.sub(r"[^\w()]", "", event), told)
        self.assertIn("Clampon", told, "outputs have no column there")
        piped = self.run_it(*run).stdout
        self.assertIn("inputs", piped)
        self.assertTrue(any(len(line) > 200 for line in piped.split("\n")), "a pipe is not broken")

    def test_a_step_with_a_long_name(self):
        self.put("long.seq", "PROGRAM P\nMOTOR MAC140;\nSTEP The_Step_With_The_Long_Name: OWN ERROR; END_STEP\nEND_PROGRAM\n")
        lines = self.on_a_terminal(80, "long.seq", "--for", "50ms")
        self.assertLessEqual(max(map(len, lines)), 80)


if __name__ == "__main__":
    scenario_test.README, scenario_test.PROGRAM = (os.path.abspath(sys.argv.pop()) for _ in range(2))
    unittest.main()
