"""What Graphviz makes of `seqc graph`: whole XML, every step's name in it, no text outside of its box or the page, and no line
through a box, so none through a text.

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


def steps_of(source):
    """By their names in the table: those of a SEQUENCE have its name before their own."""
    sequence = ""
    for word, name in re.findall(r"(?m)^\s*(STEP|SEQUENCE|END_SEQUENCE)\b[ \t]*(\w*)", source):
        if word == "STEP":
            yield sequence + name
        else:
            sequence = f"{name}_" if name else ""


def texts_of(svg):
    return [text.strip() for text in svg.itertext() if text.strip() and "graphviz" not in text]


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


def curve(path, parts=12):
    """Points along a path of cubic Bezier curves, as Graphviz writes them."""
    numbers = [float(n) for n in re.findall(r"-?[0-9.]+", path.get("d"))]
    knots = list(zip(numbers[::2], numbers[1::2]))
    for at in range(0, len(knots) - 3, 3):
        for part in range(parts + 1):
            t = part / parts
            weights = ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t ** 3)
            yield tuple(sum(w * knot[axis] for w, knot in zip(weights, knots[at:at + 4])) for axis in (0, 1))


def transfer_line(steps):
    """A program of `steps` steps in stations of four, with an emergency stop and a guard for all of them."""
    text = ["PROGRAM Transfer_Line", "MOTOR MAC140;", "SCALE 1 rev = 10 mm;",
            "VAR_INPUT E_Stop AT IN0; Guard AT IN1; Start AT IN2; Clamped AT IN3; Ack AT IN4; END_VAR",
            "VAR_OUTPUT Clamp AT OUT0; Alarm AT OUT1; END_VAR",
            "VAR_MOTOR A_Place AT P1 := 0 mm; B_Place AT P2 := 80 mm; Soft AT A1 := 20000 rpm/s; END_VAR",
            "ON ERROR NEXT := Fault;", "ON E_Stop EXCEPT Cleared NEXT := Fault;", "ON Guard EXCEPT Fault, Cleared NEXT := Idle;",
            "POWER_UP INIT(V1, Soft); NEXT := Idle; END_POWER_UP",
            "STEP Idle: IF Start THEN NEXT := Travel_0; END_IF END_STEP"]
    stations = (steps - 3) // 4
    for n in range(stations):
        after = f"Travel_{n + 1}" if n + 1 < stations else "Idle"
        text += [f"STEP Travel_{n}: ENTRY POSITION({'AB'[n % 2]}_Place); IF INPOS THEN TIMER := T#800ms; NEXT := Clamp_{n}; END_IF END_STEP",
                 f"STEP Clamp_{n}: OUT Clamp; IF Clamped THEN TIMER := 3 s; NEXT := Work_{n};",
                 "ELSIF TIMER.Q THEN NEXT := Fault; END_IF END_STEP",
                 f"STEP Work_{n}: OUT Clamp; IF TIMER.Q THEN TIMER := T#1s; NEXT := Release_{n}; END_IF END_STEP",
                 f"STEP Release_{n}: IF NOT Clamped THEN NEXT := {after}; ELSIF TIMER.Q THEN NEXT := Fault; END_IF END_STEP"]
    text += ["STEP Fault: OWN ERROR; OUT Alarm; ENTRY STOP; IF ANY ERROR AND Ack THEN RESET_ERROR; NEXT := Cleared; END_IF END_STEP",
             "STEP Cleared: OUT Alarm; IF NOT Ack THEN NEXT := POWER_UP; END_IF END_STEP", "END_PROGRAM", ""]
    return "\n".join(text)


class Graph(unittest.TestCase):
    def check_drawing(self, svg):
        page = svg.find(f"{SVG}g")
        left, top, right, bottom = extent(page.find(f"{SVG}polygon"))
        self.check_lines(page)
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

    def check_lines(self, page):
        boxes = [extent(group.find(f"{SVG}polygon")) for group in page.findall(f"{SVG}g") if group.get("class") == "node"]
        for group in page.findall(f"{SVG}g"):
            if group.get("class") != "edge":
                continue
            self.assertEqual(group.findall(f".//{SVG}text"), [])
            for x, y in curve(group.find(f"{SVG}path")):
                for x0, y0, x1, y1 in boxes:
                    inside = x0 + 1 < x < x1 - 1 and y0 + 1 < y < y1 - 1
                    self.assertFalse(inside, f"{group.find(f'{SVG}title').text} runs through a box at {x:.0f}, {y:.0f}")

    def test_forty_and_sixty_steps_stay_readable(self):
        """On A4 no letter is smaller than 5 points: a drawing in a cabinet's door."""
        for steps in (43, 59):
            with self.subTest(steps), tempfile.TemporaryDirectory() as folder:
                file = Path(folder) / "line.seq"
                file.write_text(transfer_line(steps))
                svg = draw(file)
                self.check_drawing(svg)
                scale = float(re.search(r"scale\(([0-9.]+)", svg.find(f"{SVG}g").get("transform"))[1])
                self.assertGreaterEqual(11 * scale, 5)
                texts = [text.strip() for text in svg.itertext()]
                self.assertEqual(texts.count("E_Stop"), 1)
                self.assertIn("EXCEPT Cleared", texts)
                self.assertIn("/ TIMER := 3 s", texts)
                self.assertIn("Soft := 20000 rpm/s", texts)

    def test_examples(self):
        programs = sorted(EXAMPLES.glob("*.seq"))
        self.assertGreaterEqual(len(programs), 3)
        for program in programs:
            with self.subTest(program.name):
                svg = draw(program)
                self.check_drawing(svg)
                texts = {text.strip() for text in svg.itertext()}
                source = program.read_text()
                for step in steps_of(source):
                    self.assertIn(step, texts)
                self.assertIn("POWER_UP", texts)
                self.assertIn(re.search(r"PROGRAM\s+(\w+)", source)[1], texts)

    def test_pictures_beside_the_examples_are_true(self):
        """A picture of a program has the CRC-32 of its table; the other pictures are traces."""
        pictures = 0
        for picture in sorted(EXAMPLES.glob("*.svg")):
            shown = texts_of(ElementTree.parse(picture).getroot())
            if any("CRC-32" in text for text in shown):
                pictures += 1
                self.assertEqual(shown, texts_of(draw(picture.with_suffix(".seq"))),
                                 f"draw it anew: seqc graph {picture.stem}.seq -o {picture.name}")
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
