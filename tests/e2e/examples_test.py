#!/usr/bin/env python3
"""Each example under its scenario, on a good line and on bad ones.

usage: examples_test.py NANOPLC_SIM FOLDER GoodLine|BadLine [SEEDS]

Lost, delayed and misframed characters must not change how a run ends; only where the link was lost over them (the same message
four times) it may end otherwise, with an ERROR that took it to the program's step Fault. With damaged characters and safe communication a
run ends right, or an ERROR took it to the program's step Fault; and the motor executed nothing that was not ordered.

A MIDI drive's telegrams are ten times as long as a JVL motor's commands, and three without a readable answer end its link: there the
link may be lost in each run. That such a drive does nothing unordered is in tests/motor/midi_disturbed_test.cpp.
"""

import glob
import os
import re
import subprocess
import sys
import unittest

PROGRAM = ""
FOLDER = ""
SEEDS = range(1, 2)
FAULT = "-> Fault.*ERROR|Fault .* ERROR"
ALL_DONE = "the motor executed what was ordered, and nothing else"


def run(example, *options):
    scenario = os.path.splitext(example)[0] + ".scn"
    done = subprocess.run([PROGRAM, "run", example, "--scenario", scenario, *options], capture_output=True,
                          text=True, check=False)
    return done.returncode, done.stdout + done.stderr


def is_midi(text):
    return re.search(r"terms, MAC(34|23)", text) is not None


def nothing_unordered(text):
    return is_midi(text) or ALL_DONE in text or "executed and not ordered: nothing" in text


class Case(unittest.TestCase):
    def each(self, *options):
        examples = sorted(glob.glob(os.path.join(FOLDER, "*.seq")))
        self.assertGreaterEqual(len(examples), 8, FOLDER)
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
        runs = losses = 0
        for seed in SEEDS:
            for example, (code, text) in self.each("--seed", str(seed), *faults):
                with self.subTest(example=example, seed=seed):
                    is_lost = " 0 link losses" not in text
                    if not is_midi(text):
                        runs += 1
                        losses += is_lost
                    if is_lost:
                        self.assertRegex(text, FAULT)
                        self.assertTrue(nothing_unordered(text), text)
                    else:
                        self.assertEqual(code, 0, text)
        self.assertLessEqual(losses, runs // 50, "the link is lost too often")

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
                    all_done = is_midi(text) or ALL_DONE in text
                    failed_openly = re.search(FAULT, text) is not None
                    self.assertTrue(code == 0 and all_done or code in (0, 1) and failed_openly, text)
                    self.assertTrue(nothing_unordered(text), text)


if __name__ == "__main__":
    PROGRAM, FOLDER = sys.argv.pop(1), sys.argv.pop(1)
    if len(sys.argv) > 2:
        SEEDS = range(1, 1 + int(sys.argv.pop(2)))
    unittest.main()
