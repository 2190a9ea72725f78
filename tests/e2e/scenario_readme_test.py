#!/usr/bin/env python3
"""The scenarios in host-sim/scenario/README.md, played with the program that stands there.

usage: scenario_readme_test.py NANOPLC_SIM README
"""

import os
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM = README = ""


def blocks(kind):
    with open(README, encoding="utf-8") as file:
        return re.findall(rf"(?ms)^```{kind}\n(.*?)^```$", file.read())


class Readme(unittest.TestCase):
    def test_every_scenario_holds(self):
        (program,) = blocks("seq")
        scenarios = blocks("scn")
        self.assertGreaterEqual(len(scenarios), 2)
        for number, scenario in enumerate(scenarios):
            with self.subTest(number), tempfile.TemporaryDirectory() as folder:
                for name, text in (("station.seq", program), ("s.scn", scenario)):
                    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                        file.write(text)
                done = subprocess.run([PROGRAM, "run", "station.seq", "--scenario", "s.scn"], cwd=folder,
                                      capture_output=True, text=True, timeout=120, check=False)
                self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)


if __name__ == "__main__":
    README, PROGRAM = (os.path.abspath(sys.argv.pop()) for _ in range(2))
    unittest.main()
