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
        count = 0
        for title, blocks in recipes():
            with self.subTest(title), tempfile.TemporaryDirectory() as folder:
                self.assertEqual(len(blocks), 2)
                count += 1
                program, scenario = (os.path.join(folder, name) for name in ("part.seq", "part.scn"))
                for path, block in zip((program, scenario), blocks):
                    with open(path, "w", encoding="utf-8") as file:
                        file.write(block)
                checked = subprocess.run([SEQC, "check", program], capture_output=True, text=True, check=False)
                self.assertEqual(checked.stdout + checked.stderr, "")
                played = subprocess.run([NANOPLC_SIM, "run", program, "--scenario", scenario], capture_output=True,
                                        text=True, check=False)
                self.assertEqual(played.returncode, 0, played.stdout + played.stderr)
                self.assertIn(" 0 failed", played.stdout)
                verified = subprocess.run([SEQC, "verify", program], capture_output=True, text=True, check=False)
                self.assertEqual(verified.returncode, 0, verified.stdout + verified.stderr)
        self.assertGreaterEqual(count, 13)


class Examples(unittest.TestCase):
    def test_their_properties_are_proved_without_advice(self):
        for path in sorted(glob.glob(os.path.join(EXAMPLES, "*.seq"))):
            with open(path, encoding="utf-8") as program, self.subTest(path):
                self.assertIn("\nPROPERTY ", program.read())
                done = subprocess.run([SEQC, "verify", path], capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                self.assertNotIn("says nothing", done.stdout)
                self.assertNotIn(": advice ", done.stdout + done.stderr)


if __name__ == "__main__":
    SEQC, NANOPLC_SIM, PAGE, EXAMPLES = sys.argv[1:5]
    unittest.main(argv=sys.argv[:1])
