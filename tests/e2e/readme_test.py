#!/usr/bin/env python3
"""The programs and the scenario printed in tools/seqc/README.md work as printed.

usage: readme_test.py SEQC NANOPLC_SIM README
"""

import os
import re
import subprocess
import sys
import tempfile
import unittest

SEQC = NANOPLC_SIM = README = ""


def unindented(block):
    return "\n".join(line[4:] for line in block.split("\n"))


class Readme(unittest.TestCase):
    def setUp(self):
        with open(README, encoding="utf-8") as file:
            self.text = file.read()
        self.folder = tempfile.TemporaryDirectory()

    def tearDown(self):
        self.folder.cleanup()

    def write(self, name, text):
        path = os.path.join(self.folder.name, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def programs(self):
        return [unindented(block) + "\n"
                for block in re.findall(r"(?ms)^(    PROGRAM \w+$.*?^    END_PROGRAM)$", self.text)]

    def test_programs_compile_without_a_word(self):
        programs = self.programs()
        self.assertGreaterEqual(len(programs), 2)
        for program in programs:
            done = subprocess.run([SEQC, "check", self.write("p.seq", program)], capture_output=True, text=True,
                                  timeout=60, check=False)
            self.assertEqual((done.returncode, done.stderr), (0, ""), program)

    def test_the_scenario_holds(self):
        scenario = re.search(r"(?m)^    # feeder\.scn\n((?:    .*\n)+)", self.text).group(1)
        done = subprocess.run([NANOPLC_SIM, "run", self.write("feeder.seq", self.programs()[-1]), "--scenario",
                               self.write("feeder.scn", unindented(scenario))],
                              capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("3 passed, 0 failed", done.stdout)


if __name__ == "__main__":
    README = sys.argv.pop(3)
    NANOPLC_SIM = sys.argv.pop(2)
    SEQC = sys.argv.pop(1)
    unittest.main(verbosity=2)
