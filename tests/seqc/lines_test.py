#!/usr/bin/env python3
"""The documents say how many lines the first nine examples have, and none has become longer.

usage: lines_test.py FOLDER_OF_THE_PROJECT
"""

import pathlib
import sys
import unittest

ROOT = pathlib.Path(sys.argv.pop(1))
EXAMPLES = ROOT / "tools/sequence/examples"
# Lines before there were groups, time limits, sequences and constants.
BEFORE = {"pick_and_place": 82, "indexing_table": 88, "fill_and_count": 122, "homing": 132, "two_hand_start": 114, "flying_saw": 149,
          "press": 161, "register_sets": 153, "midi_pick_and_place": 86}


class Lines(unittest.TestCase):
    def setUp(self):
        self.lines = {name: (EXAMPLES / f"{name}.seq").read_text(encoding="utf-8").splitlines() for name in BEFORE}

    def test_none_is_longer(self):
        for name, lines in self.lines.items():
            self.assertLessEqual(len(lines), BEFORE[name], name)

    def test_the_documents_have_the_sums(self):
        now = f"{sum(map(len, self.lines.values())):,}"
        before = f"{sum(BEFORE.values()):,}"
        properties = sum(line.startswith("PROPERTY ") for lines in self.lines.values() for line in lines)
        for document, words in (
                (EXAMPLES / "README.md", f"The first nine had {before} lines before there were groups, time limits, sequences and constants; "
                                         f"they have {now}, {properties} of them properties, and none is longer."),
                (ROOT / "CHANGELOG.md", f"{now} lines for {before}, although {properties} of them are properties,")):
            self.assertIn(words, document.read_text(encoding="utf-8"), document)


if __name__ == "__main__":
    unittest.main()
