#!/usr/bin/env python3
"""Scenarios as nanoplc-sim plays them: those in host-sim/scenario/README.md, and what is written about a run.

usage: scenario_test.py NANOPLC_SIM README
"""

import os
import re
import subprocess
import sys
import unittest
import xml.etree.ElementTree

from folder_case import FolderCase

PROGRAM = README = ""

# Step 0: at once to step 1. Bytes by 001 sections 6.1.5 and 6.1.7.
TABLE = bytes([0xC0, 0x00, 0x00, 0x01, 0x80, 0x01, 0x00, 0x00, 0x3F, 0, 0, 0, 0, 0, 0, 0])


def blocks(kind):
    """Options that stand behind the kind, and the text."""
    with open(README, encoding="utf-8") as file:
        return re.findall(rf"(?ms)^```{kind}([^\n]*)\n(.*?)^```$", file.read())


class Case(FolderCase):
    def setUp(self):
        super().setUp()
        self.table = self.put("t.bin", TABLE)

    def run_it(self, *arguments):
        return subprocess.run([PROGRAM, "run", *arguments], cwd=self.folder.name, capture_output=True, text=True, check=False)

    def refused(self, *arguments, says):
        self.refused_in_a_line(self.run_it(*arguments), says)


class Readme(Case):
    def test_every_scenario_holds(self):
        ((_, program),) = blocks("seq")
        self.put("station.seq", program)
        scenarios = blocks("scn")
        self.assertGreaterEqual(len(scenarios), 3)
        for number, (options, scenario) in enumerate(scenarios):
            with self.subTest(number):
                done = self.run_it("station.seq", "--scenario", self.put("s.scn", scenario), *options.split())
                self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)


class Junit(Case):
    def test_junit(self):
        scenario = self.put("s.scn", "end at 2 s\nexpect at 1 s step = 0\nnever V_IST < -9000 rpm\n")
        done = self.run_it(self.table, "--scenario", scenario, "--junit", self.path("t.xml"))
        self.assertEqual(done.returncode, 1)
        suites = xml.etree.ElementTree.parse(self.path("t.xml")).getroot()
        (suite,) = suites
        for counted in (suites, suite):
            self.assertEqual([counted.get(n) for n in ("tests", "failures", "errors", "time")], ["2", "1", "0", "2.000000"])
        self.assertEqual(suite.get("name"), scenario)
        failed, passed = suite
        self.assertEqual(failed.attrib, {"classname": self.table, "name": "2: at 1 s step = 0", "file": scenario,
                                         "line": "2", "time": "1.000000"})
        self.assertEqual(failed[0].get("message"), "at 1000.000 ms step = 1")
        self.assertIn("s.scn:2: expected: at 1 s step = 0; seen: at 1000.000 ms step = 1", failed[0].text)
        self.assertEqual(passed.get("name"), '3: never V_IST < -9000 rpm')
        self.assertEqual((len(passed), passed.get("time")), (0, "2.000000"))

    def test_junit_that_cannot_be(self):
        scenario = self.put("s.scn", "end at 1 s\n")
        self.refused(self.table, "--junit", self.path("t.xml"), says="--junit without a scenario")
        run = [self.table, "--scenario", scenario, "--junit"]
        self.refused(*run, self.path("no/t"), says="no/t: cannot be written")
        self.refused(*run, scenario, says="overwrite the scenario")
        self.refused(*run, self.path("t"), "--trace", self.path("t"), says="name two files")


class Times(Case):
    RISES = "every 100 ms toggle IN0\n"  # at 100, 300, 500 ms

    def test_an_event_is_awaited_n_times_and_what_is_said_there_stands_last(self):
        scenario = self.put("s.scn", self.RISES + 'once IN0 rises 2 times log "second"\n'
                              'once IN0 rises 3 times log "here it breaks", end\nexpect IN0\nend at 5 s\n')
        done = self.run_it(self.table, "--scenario", scenario)
        self.assertEqual((done.returncode, done.stdout.splitlines()[-1]), (0, "here it breaks, at 500.000 ms"))
        self.assertRegex(done.stdout, r'(?m)^ *300\.000 .*"second"$')
        quiet = self.run_it(self.table, "--scenario", scenario, "--quiet")
        self.assertEqual(quiet.stdout.splitlines()[-1], "here it breaks, at 500.000 ms")
        self.assertNotIn("second", quiet.stdout)

    def test_end_when_n_times(self):
        scenario = self.put("s.scn", self.RISES + "end when IN0 rises 2 times from 200 ms after 5 ms\n")
        self.assertIn("ended at 505.000 ms", self.run_it(self.table, "--scenario", scenario).stdout)

    def test_never_and_a_half_are_refused(self):
        for wrong, says in (("once IN0 0 times log \"a\"", "once or more often"), ("once IN0 1.5 times log \"a\"", "whole number"),
                            ("when IN0 2 times log \"a\"", "out of place")):
            with self.subTest(wrong):
                scenario = self.put("s.scn", wrong + "\nend at 1 s\n")
                self.refused(self.table, "--scenario", scenario, says=says)


if __name__ == "__main__":
    README, PROGRAM = (os.path.abspath(sys.argv.pop()) for _ in range(2))
    unittest.main()
