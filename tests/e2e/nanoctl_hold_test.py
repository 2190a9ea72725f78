#!/usr/bin/env python3
"""Held in mid-motion and going on, or not, on the simulated gateway.

usage: nanoctl_hold_test.py NANOCTL NANOPLC_SIM SEQC SHUTTLE.seq
"""

import subprocess
import sys
import unittest

import nanoctl_test


class Holding(nanoctl_test.Case):
    def test_what_was_held_in_a_move_goes_on_with_it(self):
        self.start()
        self.ctl("upload", self.table)
        for go_on in ("run", "step"):
            self.ctl(*self.sym(), "break", "S2")
            self.ctl("run")
            self.until(lambda status: status["step"] == 1)
            self.ctl("force", "IN0=1")
            held = self.until(lambda status: status["state"] == "held")
            self.assertEqual((held["step"], held["can_go_on"]), (2, True))
            self.ctl("break", "--clear")
            self.ctl(go_on)
            if go_on == "step":
                self.assertEqual(self.ctl("status")["step"], 3, "it has arrived")
            self.until(lambda status: status["step"] > 2)
            self.ctl("stop")
            self.ctl("force", "--off")

    def test_what_cannot_be_taken_up_again_is_refused_with_what_to_do(self):
        with open(self.path("home.seq"), "w", encoding="utf-8") as file:
            file.write("PROGRAM P\nMOTOR MAC140;\nSTEP S: OWN ERROR; IF TRUE THEN HOME; NEXT := T; END_IF END_STEP\n"
                       "STEP T: OWN ERROR; IF IN5 THEN NEXT := S; END_IF END_STEP\nEND_PROGRAM\n")
        subprocess.run([nanoctl_test.SEQC, "build", self.path("home.seq"), "--quiet", "-o", self.path("home.bin")], check=True)
        self.start()
        self.ctl("upload", self.path("home.bin"), "--run")
        self.until(lambda status: status["orders"] == 1)
        self.ctl("hold")
        self.assertFalse(self.ctl("status")["can_go_on"])
        for go_on in ("run", "step", "scan"):
            self.assertIn("stop, then run from the start", self.ctl(go_on, exit_code=1)["error"])
        self.assertEqual(self.ctl("status")["state"], "held")
        self.ctl("stop")
        self.ctl("run")


if __name__ == "__main__":
    nanoctl_test.NANOCTL, nanoctl_test.SIM, nanoctl_test.SEQC, nanoctl_test.SHUTTLE = sys.argv[1:5]
    unittest.main(argv=sys.argv[:1] + sys.argv[5:])
