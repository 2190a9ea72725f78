#!/usr/bin/env python3
"""What tools/demo builds on a fresh clone does the same as the programs of the release build.

usage: demo_test.py SEQC NANOPLC_SIM ROOT
"""

import os
import subprocess
import sys
import tempfile
import unittest

SEQC = NANOPLC_SIM = ROOT = ""
EXAMPLE = "tools/sequence/examples/pick_and_place"


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=ROOT)
    return done.returncode, done.stdout, done.stderr


def read(path):
    with open(path, "rb") as file:
        return file.read()


class Demo(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        for command in (("cmake", "--preset", "demo"), ("cmake", "--build", "--preset", "demo")):
            code, out, err = run(*command)
            if code != 0:
                raise AssertionError(out + err)

    def setUp(self):
        self.programs = os.path.join(ROOT, "build/demo/bin")
        self.seqc = os.path.join(self.programs, "seqc")
        self.sim = os.path.join(self.programs, "nanoplc-sim")
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def test_nothing_else_is_built(self):
        self.assertEqual(sorted(os.listdir(self.programs)), ["nanoplc-sim", "seqc"])

    def test_the_same_table_and_names(self):
        table = os.path.join(self.folder, "t.bin")
        found = []
        for program in (SEQC, self.seqc):
            said = run(program, "build", EXAMPLE + ".seq", "-o", table)
            found.append((said, read(table), read(os.path.join(self.folder, "t.sym"))))
        self.assertEqual(found[0], found[1])
        self.assertEqual(found[0][0][0], 0, found[0])

    def test_the_same_run(self):
        csv, vcd = os.path.join(self.folder, "t.csv"), os.path.join(self.folder, "t.vcd")
        found = []
        for program in (NANOPLC_SIM, self.sim):
            said = run(program, "run", EXAMPLE + ".seq", "--scenario", EXAMPLE + ".scn", "--trace", csv, "--vcd", vcd)
            found.append((said, read(csv), read(vcd)))
        self.assertEqual(found[0], found[1])
        self.assertEqual(found[0][0][0], 0, found[0])

    def test_what_is_left_out_says_what_to_build(self):
        for options in (("--realtime",), ("--flash", os.path.join(self.folder, "f"))):
            code, _, err = run(self.sim, "run", EXAMPLE + ".seq", *options)
            self.assertEqual(code, 2)
            self.assertIn("`cmake --preset release`", err)
        self.assertIn("`cmake --preset release`", run(self.seqc, "--help")[1])


if __name__ == "__main__":
    SEQC, NANOPLC_SIM, ROOT = sys.argv[1:4]
    unittest.main(argv=sys.argv[:1] + sys.argv[4:])
