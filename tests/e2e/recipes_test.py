#!/usr/bin/env python3
"""The recipes of RECIPES.md, compiled and rehearsed as they stand there, and the properties of the examples.

usage: recipes_test.py SEQC NANOPLC_SIM RECIPES.md EXAMPLES
"""

import glob
import os
import re
import subprocess
import sys
import tempfile
import unittest

SEQC = NANOPLC_SIM = PAGE = EXAMPLES = ""


def recipes():
    """Title, program and scenario of each section."""
    with open(PAGE, encoding="utf-8") as page:
        sections = re.split(r"^## ", page.read(), flags=re.MULTILINE)[1:]
    for section in sections:
        title, text = section.split("\n", 1)
        blocks = re.findall(r"(?:^    .*\n|^\n(?=    ))+", text, flags=re.MULTILINE)
        blocks = [re.sub(r"^    ", "", block.lstrip("\n"), flags=re.MULTILINE) for block in blocks]
        yield title, blocks


class Recipes(unittest.TestCase):
    def test_each_is_a_program_and_its_scenario(self):
        for path in sorted(glob.glob(os.path.join(EXAMPLES, "*.seq"))):
            with open(path, encoding="utf-8") as program, self.subTest(path):
                self.assertIn("\nPROPERTY ", program.read())
                done = subprocess.run([SEQC, "verify", path], capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                self.assertNotIn("says nothing", done.stdout)


if __name__ == "__main__":
    SEQC, NANOPLC_SIM, PAGE, EXAMPLES = sys.argv[1:5]
    unittest.main(argv=sys.argv[:1])
