"""What Graphviz makes of `seqc graph`: whole XML, every step's name in it, and no text outside of its box or the page.

usage: graph_test.py SEQC EXAMPLES
"""

import random
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

SEQC = ""
EXAMPLES = Path()
SVG = "{http://www.w3.org/2000/svg}"
SEED = 37
LETTER = 0.45  # of the font's size: what a letter of Helvetica takes at the least, over a few of them


def draw(file):
    run = subprocess.run([SEQC, "graph", str(file)], capture_output=True)
    assert run.returncode == 0, run.stderr.decode()
    return ElementTree.fromstring(run.stdout)


def points(polygon):
    return [tuple(map(float, pair.split(","))) for pair in polygon.get("points").split()]


def extent(shape):
    xs, ys = zip(*points(shape))
    return min(xs), min(ys), max(xs), max(ys)


def random_table(chance, steps, terms):
    """Valid terms, most with few conditions, so that many switches come of it."""
    table = bytearray()
    for _ in range(terms):
        flex = chance.random() < 0.2
        care = (1 << chance.randrange(7)) | (1 << chance.randrange(7)) | (0x80 if flex else 0)
        table += bytes([chance.choice([0xC0, 0xC0, 0x80, 0x40]) | chance.randrange(steps),
                        chance.randrange(128) | chance.choice([0, 0, 0, 0x80]), care])
        if flex:
            table += bytes([chance.randrange(1, 128) | chance.choice([0, 0x80])])
            table += bytes(chance.randrange(256) for _ in range(4))
        else:
            table += bytes([chance.choice([0x3E, chance.randrange(steps), chance.randrange(steps)]),
                            chance.choice([0x80, chance.randrange(128)]), chance.randrange(16),
                            chance.randrange(256), 0])
    return bytes(table + bytes([0x3F] + [0] * 7))


class Graph(unittest.TestCase):
    def check_drawing(self, svg):
        page = svg.find(f"{SVG}g")
        left, top, right, bottom = extent(page.find(f"{SVG}polygon"))
        for group in page.findall(f"{SVG}g"):
            box = group.find(f"{SVG}polygon") if group.get("class") == "node" else None
            for text in group.findall(f".//{SVG}text"):
                x, y, size = (float(text.get(key)) for key in ("x", "y", "font-size"))
                label = "".join(text.itertext())
                width = LETTER * size * len(label)
                if text.get("text-anchor") == "middle":
                    x -= width / 2
                end = x + width
                within = extent(box) if box is not None else (left, top, right, bottom)
                self.assertGreaterEqual(x, within[0], label)
                self.assertLessEqual(end, within[2], label)
                self.assertGreaterEqual(y, within[1], label)
                self.assertLessEqual(y, within[3], label)

    def test_examples(self):
        programs = sorted(EXAMPLES.glob("*.seq"))
        self.assertGreaterEqual(len(programs), 3)
        for program in programs:
            with self.subTest(program.name):
                svg = draw(program)
                self.check_drawing(svg)
                texts = {text.strip() for text in svg.itertext()}
                source = program.read_text()
                for step in re.findall(r"^\s*STEP\s+(\w+)", source, re.MULTILINE):
                    self.assertIn(step, texts)
                self.assertIn("POWER_UP", texts)
                self.assertIn(re.search(r"PROGRAM\s+(\w+)", source)[1], texts)

    def test_pictures_beside_the_examples_are_true(self):
        """A picture of a program shows the CRC-32 of its table; the other pictures are traces."""
        pictures = 0
        for picture in sorted(EXAMPLES.glob("*.svg")):
            shown = re.search("CRC-32 ([0-9A-F]{8})", "".join(ElementTree.parse(picture).getroot().itertext()))
            if shown:
                pictures += 1
                now = "".join(draw(picture.with_suffix(".seq")).itertext())
                self.assertIn(shown[0], now, f"draw it anew: seqc graph {picture.stem}.seq -o {picture.name}")
        self.assertGreaterEqual(pictures, 1)

    def test_random_tables(self):
        chance = random.Random(SEED)
        with tempfile.TemporaryDirectory() as folder:
            for number in range(8):
                steps = chance.randrange(1, 15)
                table = random_table(chance, steps, chance.randrange(1, 40))
                file = Path(folder) / "table.bin"
                file.write_bytes(table)
                with self.subTest(seed=SEED, number=number):
                    svg = draw(file)
                    self.check_drawing(svg)
                    texts = {text.strip() for text in svg.itertext()}
                    for at in range(0, len(table) - 8, 8):
                        self.assertIn(f"step {table[at] & 0x3F}", texts)

    def test_long_names_are_not_cut(self):
        long = "A_Name_As_Long_As_Anybody_Would_Ever_Want_To_Write_It_Down"
        source = (f"PROGRAM {long} VAR_INPUT {long}_In AT IN0; END_VAR VAR_OUTPUT {long}_Out AT OUT0; END_VAR\n"
                  f"STEP {long}_1: OWN ERROR; OUT {long}_Out; IF {long}_In THEN NEXT := {long}_2; END_IF END_STEP\n"
                  f"STEP {long}_2: OWN ERROR; END_STEP END_PROGRAM\n")
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "long.seq"
            file.write_text(source)
            svg = draw(file)
            self.check_drawing(svg)
            texts = {text.strip() for text in svg.itertext()}
            self.assertLessEqual({f"{long}_1", f"{long}_2", f"OUT {long}_Out", f"{long}_In"}, texts)


if __name__ == "__main__":
    EXAMPLES = Path(sys.argv.pop())
    SEQC = sys.argv.pop()
    unittest.main()
