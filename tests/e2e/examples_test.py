#!/usr/bin/env python3
"""Each example under its scenario, on a good line and on bad ones.

usage: examples_test.py NANOPLC_SIM FOLDER GoodLine|BadLine

Lost, delayed and misframed characters must not change how a run ends. A damaged character can be another command or
status, so there a run may also go wrong, but never silently: it went to the program's step Fault, or the comparison of
orders at its end names what the motor executed wrongly.
"""

import glob
import os
import subprocess
import sys
import unittest

PROGRAM = ""
FOLDER = ""
SEEDS = range(1, 4)


def run(example, *options):
    scenario = os.path.splitext(example)[0] + ".scn"
    done = subprocess.run([PROGRAM, "run", example, "--scenario", scenario, *options], capture_output=True,
                          text=True, timeout=300, check=False)
    return done.returncode, done.stdout + done.stderr


class Case(unittest.TestCase):
    def each(self, *options):
        examples = sorted(glob.glob(os.path.join(FOLDER, "*.seq")))
        self.assertGreaterEqual(len(examples), 3, FOLDER)
        for example in examples:
            yield example, run(example, *options)


class GoodLine(Case):
    def test_everything_comes_as_expected(self):
        for example, (code, text) in self.each():
            with self.subTest(example):
                self.assertEqual(code, 0, text)
                self.assertIn(" 0 failed", text)


class BadLine(Case):
    def same_end(self, *faults):
        for seed in SEEDS:
            for example, (code, text) in self.each("--seed", str(seed), *faults):
                with self.subTest(example=example, seed=seed):
                    self.assertEqual(code, 0, text)

    def test_with_one_percent_lost(self):
        self.same_end("--drop", "1%")

    def test_with_one_percent_delayed(self):
        self.same_end("--delay", "1%")

    def test_with_one_percent_framing_errors(self):
        self.same_end("--framing", "1%")

    def test_with_one_percent_damaged(self):
        for seed in SEEDS:
            for example, (code, text) in self.each("--seed", str(seed), "--damage", "1%"):
                with self.subTest(example=example, seed=seed):
                    told = "-> Fault" in text or "executed and not ordered" in text
                    self.assertTrue(code == 0 or (code == 1 and told), text)


if __name__ == "__main__":
    PROGRAM, FOLDER = sys.argv.pop(1), sys.argv.pop(1)
    unittest.main()
