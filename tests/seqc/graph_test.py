"""What `seqc graph` draws, by the places that its JSON gives: no text outside of its box or upon another, no line through a box, a
text or along a line to another step, all of it on an A4 page; the SVG shows the same, and a PNG of it fits at 200 dpi.

usage: graph_test.py SEQC EXAMPLES RECIPES
"""

import json
import random
import re
import struct
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from itertools import combinations
from pathlib import Path

SEQC = ""
EXAMPLES = RECIPES = Path()
SVG = "{http://www.w3.org/2000/svg}"
SEED = 37
MONOSPACED = 0.602  # of the font's size: the widest of usual fonts, for most texts
RISE, FALL = 0.75, 0.22  # of the size: how far letters go above and below their line
A4 = (595.3, 841.9)
GRAPHVIZ_FOLD = 12
SLACK = 0.02  # coordinates are rounded


def run(file, *options):
    done = subprocess.run([SEQC, "graph", str(file), *options], capture_output=True, check=False)
    assert done.returncode == 0, done.stderr.decode()
    return done.stdout


def draw(file):
    return ElementTree.fromstring(run(file))


def graph(file):
    return json.loads(run(file, "--format", "json"))


def programs_of_recipes():
    """Title and program of each section of the recipes."""
    for section in re.split(r"^## ", RECIPES.read_text(), flags=re.MULTILINE)[1:]:
        title, text = section.split("\n", 1)
        blocks = re.findall(r"(?:^    .*\n|^\n(?=    ))+", text, flags=re.MULTILINE)
        yield title, re.sub(r"^    ", "", blocks[0].lstrip("\n"), flags=re.MULTILINE)


def steps_of(source):
    """By their names in the table: those of a SEQUENCE have its name before their own."""
    sequence = ""
    for word, name in re.findall(r"(?m)^\s*(STEP|SEQUENCE|END_SEQUENCE)\b[ \t]*(\w*)", source):
        if word == "STEP":
            yield sequence + name
        else:
            sequence = f"{name}_" if name else ""


def texts_of(svg):
    return [text.strip() for text in svg.itertext() if text.strip()]


def texts_in(drawing):
    return [text for part in [drawing, *drawing["nodes"]] for text in part["texts"]]


def area_of(text):
    """x and y from and to."""
    left = text["x"] - {"start": 0, "middle": text["width"] / 2, "end": text["width"]}[text["anchor"]]
    return left, text["y"] - RISE * text["size"], left + text["width"], text["y"] + FALL * text["size"]


def box_of(node):
    return node["x"], node["y"], node["x"] + node["width"], node["y"] + node["height"]


def overlap(a, b):
    return a[0] < b[2] - SLACK and b[0] < a[2] - SLACK and a[1] < b[3] - SLACK and b[1] < a[3] - SLACK


def is_within(inner, outer):
    return inner[0] >= outer[0] - SLACK and inner[1] >= outer[1] - SLACK and inner[2] <= outer[2] + SLACK and inner[3] <= outer[3] + SLACK


def segments(edge):
    for (ax, ay), (bx, by) in zip(edge["points"], edge["points"][1:]):
        yield min(ax, bx), min(ay, by), max(ax, bx), max(ay, by)


def is_through(segment, area):
    return (segment[0] < area[2] - SLACK and area[0] + SLACK < segment[2] or
            segment[0] == segment[2] and area[0] + SLACK < segment[0] < area[2] - SLACK) and \
           (segment[1] < area[3] - SLACK and area[1] + SLACK < segment[3] or
            segment[1] == segment[3] and area[1] + SLACK < segment[1] < area[3] - SLACK)


def run_together(a, b):
    """Two straight pieces that share more than a point."""
    for along, across in ((0, 1), (1, 0)):
        flat = a[across] == a[across + 2] and b[across] == b[across + 2] and abs(a[across] - b[across]) < 1
        if flat and min(a[along + 2], b[along + 2]) - max(a[along], b[along]) > 1:
            return True
    return False


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


def random_program(chance, steps):
    """Ways between random steps, ON conditions, latched outputs, limits and edges, which ask for helper steps."""
    inputs = ["Stop", "Guard", "Pedal", "Part_In_Place", "Ack", "Up"]
    text = [f"PROGRAM Random_{steps}", "MOTOR MAC140;", "SCALE 1 rev = 5 mm;",
            "VAR_INPUT " + " ".join(f"{name} AT IN{i};" for i, name in enumerate(inputs)) + " END_VAR",
            "VAR_OUTPUT Clamp AT OUT0; Lamp AT OUT1; END_VAR",
            "VAR_MOTOR Near AT P1 := 12.5 mm; Far AT P2 := 80 mm; Fast AT V1 := 900 rpm; Soft AT A1 := 20000 rpm/s; END_VAR",
            "ON ERROR NEXT := Fault;", f"ON Stop EXCEPT Fault NEXT := {chance.choice(['Fault', 'Work_0'])};",
            "POWER_UP INIT(Fast, Soft); NEXT := Work_0; END_POWER_UP"]
    for n in range(steps):
        to = [f"Work_{chance.choice([m for m in range(steps) if m != n])}" for _ in range(2)]
        when = chance.choice(["Pedal", "Pedal AND Part_In_Place", "R_TRIG(Pedal)", "Up OR NOT Guard AND Part_In_Place", "Up FOR 300 ms"])
        ways = chance.choice([f"IF {when} THEN NEXT := {to[0]}; END_IF", f"IF Guard THEN STOP; NEXT := {to[0]}; ELSIF INPOS THEN NEXT := {to[1]}; END_IF",
                              f"IF INPOS WITHIN T#2s THEN NEXT := {to[0]}; ELSE NEXT := Fault; END_IF"])
        text.append(f"STEP Work_{n}: {chance.choice(['', 'OUT Clamp;', 'OUT Lamp WHEN Up;'])} ENTRY POSITION({chance.choice(['Near', 'Far'])}); "
                    f"{ways} END_STEP")
    text += ["STEP Fault: OWN ERROR; OUT Lamp; ENTRY STOP; IF ANY ERROR AND Ack THEN RESET_ERROR; NEXT := POWER_UP; END_IF END_STEP",
             "END_PROGRAM", ""]
    return "\n".join(text)


INPUTS = ["Go", "Door", "Part", "Up", "Ack", "Key"]
BITS = [*INPUTS, "INPOS", "ERROR", "TIMER.Q", "COUNTER.Q"]
ALL = (1 << (1 << len(BITS))) - 1


def bit_mask(bit):
    """The cases, one bit each, in which a bit of the input image or a zero flag is 1."""
    return sum(1 << case for case in range(1 << len(BITS)) if case >> bit & 1)


MASKS = {name: bit_mask(bit) for bit, name in enumerate(BITS)} | {f"IN{bit}": bit_mask(bit) for bit in range(len(INPUTS))}
NO_ERROR = ALL & ~MASKS["ERROR"]


def random_condition(chance):
    terms = [" AND ".join(chance.choice(["", "NOT "]) + name for name in chance.sample(BITS[:7] + BITS[8:], chance.randrange(1, 3)))
             for _ in range(chance.choice([1, 1, 2]))]
    return " OR ".join(terms)


def branching_program(chance, steps):
    """Branches that go on, stay or do nothing, in one IF or two; ON conditions for all steps or some."""
    text = [f"PROGRAM Branching_{steps}", "MOTOR MAC140;",
            "VAR_INPUT " + " ".join(f"{name} AT IN{i};" for i, name in enumerate(INPUTS)) + " END_VAR", "ON ERROR NEXT := Fault;"]
    work = [f"Work_{n}" for n in range(steps)]
    for _ in range(chance.randrange(3)):
        where = chance.choice(["", f"IN {', '.join(chance.sample(work, 2))}", f"EXCEPT {', '.join(chance.sample([*work, 'Fault'], 2))}"])
        text.append(f"ON {random_condition(chance)} {where} NEXT := {chance.choice([*work, 'Fault'])};")
    text.append("POWER_UP NEXT := Work_0; END_POWER_UP")
    for name in work:
        others = [other for other in [*work, "Fault"] if other != name]
        act = lambda: chance.choice(["", "", f"NEXT := {chance.choice(others)};", f"NEXT := {chance.choice(others)};",
                                     f"POSITION(P2); NEXT := {chance.choice(others)};", "EVERY_SCAN COUNT_DOWN;"])
        body = ""
        for _ in range(chance.choice([1, 1, 1, 2])):
            body += f"IF {random_condition(chance)} THEN {act()} "
            for _ in range(chance.randrange(3)):
                body += f"ELSIF {random_condition(chance)} THEN {act()} "
            body += chance.choice(["", f"ELSE {act()} "]) + "END_IF "
        text.append(f"STEP {name}: {chance.choice(['', 'ENTRY TIMER := T#1s;'])} {body}END_STEP")
    text += ["STEP Fault: OWN ERROR; IF ANY ERROR AND Ack THEN RESET_ERROR; NEXT := POWER_UP; END_IF END_STEP", "END_PROGRAM", ""]
    return "\n".join(text)


def cases_of(condition):
    """As one reads it: a condition that does not name ERROR is one without ERROR."""
    if condition in ("ELSE", "always"):
        return NO_ERROR
    names = condition.replace("ANY ERROR", "ANY_ERROR")
    symbols = {"AND": "&", "OR": "|", "XOR": "^", "NOT": "~", "ANY_ERROR": str(ALL)} | {name: str(mask) for name, mask in MASKS.items()}
    cases = eval(re.sub(r"[A-Za-z][\w.]*", lambda word: symbols[word[0]], names)) & ALL
    return cases if "ERROR" in condition else cases & NO_ERROR


def is_note_for(where, node, target, fault):
    """`where` as it is drawn: "in every other step but A", "in A, B", "in steps 1, 3 to 5", and as the program has it "IN A, B" or
    "EXCEPT A", which are about its own steps, the latter but for the fault step."""
    own = {node["name"], *map(str, node["steps"])}
    names = set(re.findall(r"\w+", where.split(" but ")[-1])) - {"in", "every", "other", "step", "steps", "IN", "EXCEPT", "to"}
    for first, last in re.findall(r"(\d+) to (\d+)", where):
        names |= {str(n) for n in range(int(first), int(last) + 1)}
    if where.startswith("EXCEPT") and (node["kind"] == "helper" or node["step"] == fault):
        return False
    if where.startswith(("in every other step", "EXCEPT")):
        return node["step"] != target and not own & names
    return bool(own & names)


def fault_of(drawing):
    """Where the note of ERROR stands."""
    return next((node["step"] for node in drawing["nodes"] if node["kind"] == "note" and node["ways"][0]["condition"] == "ERROR"), None)


def transitions(drawing, behind=None):
    """For each step the cases in which the drawing, read from top to bottom, allows to go to each other one. `behind`: where helper
    steps lead to, which are left out on the way."""
    behind = behind or {}
    fault = fault_of(drawing)
    notes = [way for node in drawing["nodes"] if node["kind"] == "note" for way in node["ways"]]
    read = {}
    for node in drawing["nodes"]:
        if node["kind"] == "note":
            continue
        step, to, told = node["step"], {}, 0
        for note in notes:
            first = note["condition"] == "ERROR" or step != 0
            if first and note["to"] != step and is_note_for(note["where"], node, note["to"], fault):
                to[note["to"]] = to.get(note["to"], 0) | cases_of(note["condition"])
                told |= cases_of(note["condition"])
        for way in node["ways"]:
            target, cases = behind.get(way["to"], way["to"]), cases_of(way["condition"]) & ~told
            to[target] = to.get(target, 0) | cases
            told |= cases
        to[step] = to.get(step, 0) | ALL & ~told
        read[step] = to
    return read


class Graph(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, name, content):
        file = self.folder / name
        file.write_bytes(content if isinstance(content, bytes) else content.encode())
        return file

    def check(self, file):
        """All that holds of every drawing; answers it."""
        drawing = graph(file)
        self.assertEqual((drawing["format"], drawing["version"]), ("nanoplc-graph", 1))
        self.check_texts(drawing)
        self.check_lines(drawing)
        self.check_page(drawing)
        self.check_folds(drawing, draw(file))
        shown = [text["text"] for text in texts_in(drawing)]
        self.assertEqual(sorted(texts_of(draw(file))), sorted([drawing["program"], *(text.strip() for text in shown)]))
        return drawing

    def check_texts(self, drawing):
        boxes = [box_of(node) for node in drawing["nodes"]]
        for a, b in combinations(boxes, 2):
            self.assertFalse(overlap(a, b), (a, b))
        for text in texts_in(drawing):
            self.assertGreaterEqual(text["width"] + SLACK, MONOSPACED * text["size"] * len(text["text"]), text)
        for node in drawing["nodes"]:
            for text in node["texts"]:
                self.assertTrue(is_within(area_of(text), box_of(node)), text)
        for text in drawing["texts"]:
            self.assertFalse(any(overlap(area_of(text), box) for box in boxes), text)
        for part in [drawing, *drawing["nodes"]]:
            for a, b in combinations(part["texts"], 2):
                self.assertFalse(overlap(area_of(a), area_of(b)), (a, b))
            for y in part.get("rules", []):
                for text in part["texts"]:
                    _, top, _, bottom = area_of(text)
                    self.assertFalse(top + SLACK < y < bottom - SLACK, (y, text))

    def check_folds(self, drawing, svg):
        """No text in the folded corner of a note, in the SVG and as Graphviz folds it."""
        folds = {}
        for group in svg.findall(f"{SVG}g"):
            if "note" in group.get("class").split():
                left, right = re.match(r"M\S+ H(\S+) L([^,]+),", group.find(f"{SVG}path").get("d")).groups()
                folds[group.get("id")] = max(float(right) - float(left), GRAPHVIZ_FOLD)
        for node in drawing["nodes"]:
            if node["kind"] == "note":
                _, top, right, _ = box_of(node)
                fold = folds[node["id"]]
                for text in node["texts"]:
                    self.assertFalse(overlap(area_of(text), (right - fold, top, right, top + fold)), text)

    def check_lines(self, drawing):
        nodes = {node["id"]: node for node in drawing["nodes"]}
        texts = [area_of(text) for text in texts_in(drawing)]
        pieces = []
        for edge in drawing["edges"]:
            for piece in segments(edge):
                self.assertTrue(piece[0] == piece[2] or piece[1] == piece[3], edge)
                for area in [*map(box_of, nodes.values()), *texts]:
                    self.assertFalse(is_through(piece, area), (edge, area))
                pieces.append((edge["to"], piece))
            if edge["points"]:
                for name, (x, y) in ((edge["from"], edge["points"][0]), (edge["to"], edge["points"][-1])):
                    left, top, right, bottom = box_of(nodes[name])
                    on_side = min(abs(x - left), abs(x - right)) <= SLACK and top < y < bottom
                    on_end = min(abs(y - top), abs(y - bottom)) <= SLACK and left < x < right
                    self.assertTrue(on_side or on_end, (name, edge))
        for (to, a), (other, b) in combinations(pieces, 2):
            self.assertFalse(to != other and run_together(a, b), (to, a, other, b))

        kinds = [edge["kind"] for edge in drawing["edges"]]
        self.assertEqual(kinds, sorted(kinds, key=["error", "back", "forward", "note"].index), "back to front")

    def check_page(self, drawing):
        page = drawing["page"]
        for area in [*map(box_of, drawing["nodes"]), *map(area_of, texts_in(drawing)), *(p for e in drawing["edges"] for p in segments(e))]:
            self.assertTrue(is_within(area, (0, 0, page["width"], page["height"])), area)
        sides = sorted((page["width"] * page["points"], page["height"] * page["points"]))
        self.assertLessEqual(sides[0], A4[0])
        self.assertLessEqual(sides[1], A4[1])

    def check_ways(self, drawing):
        """A line for each way out of a step, and how many of them are not drawn."""
        wanted = sorted((node["id"], number) for node in drawing["nodes"] if node["kind"] != "note"
                        for number, way in enumerate(node["ways"]) if way["to"] != node["step"])
        self.assertEqual(sorted((edge["from"], edge["way"]) for edge in drawing["edges"] if "way" in edge), wanted)

    def test_forty_and_sixty_steps_stay_readable(self):
        """On A4 no letter of a step is smaller than 5 points: a drawing in a cabinet's door."""
        for steps in (43, 59):
            with self.subTest(steps):
                drawing = self.check(self.write("line.seq", transfer_line(steps)))
                self.check_ways(drawing)
                self.assertGreaterEqual(10 * drawing["page"]["points"], 5)
                texts = [text["text"] for text in texts_in(drawing)]
                self.assertEqual(texts.count("E_Stop"), 1)
                for text in ("EXCEPT Cleared", "/ TIMER := 3 s", "Soft := 20000 rpm/s"):
                    self.assertIn(text, texts)

    def test_examples(self):
        programs = sorted(EXAMPLES.glob("*.seq"))
        self.assertGreaterEqual(len(programs), 3)
        for program in programs:
            with self.subTest(program.name):
                drawing = self.check(program)
                self.check_ways(drawing)
                self.assertGreaterEqual(10 * drawing["page"]["points"], 5.8)
                source = program.read_text()
                names = {node["name"] for node in drawing["nodes"] if node["kind"] != "note"}
                self.assertLessEqual({*steps_of(source), "POWER_UP"}, names)
                self.assertEqual(drawing["program"], re.search(r"PROGRAM\s+(\w+)", source)[1])
                self.assertTrue(all(edge["points"] for edge in drawing["edges"] if edge["kind"] == "note"))

    def test_recipes(self):
        programs = list(programs_of_recipes())
        self.assertGreaterEqual(len(programs), 13)
        for title, source in programs:
            with self.subTest(title):
                drawing = self.check(self.write("part.seq", source))
                self.check_ways(drawing)
                self.assertGreaterEqual(10 * drawing["page"]["points"], 5.8)

    def test_random_programs(self):
        chance = random.Random(SEED)
        for number in range(25):
            source = random_program(chance, chance.randrange(2, 24))
            with self.subTest(seed=SEED, number=number):
                self.check_ways(self.check(self.write("random.seq", source)))

    def table_of(self, program):
        table = self.write("table.bin", "")
        done = subprocess.run([SEQC, "build", program, "-o", table, "--quiet"], capture_output=True, check=False)
        table.with_suffix(".sym").unlink(missing_ok=True)
        return table if done.returncode == 0 else None

    def check_transitions(self, program):
        """A program and its table are drawn as the same machine, as far as one step of the one is one of the other."""
        table = self.table_of(program)
        if table is None:
            return False
        drawing = graph(program)
        behind = {node["step"]: node["ways"][0]["to"] for node in drawing["nodes"] if node["kind"] == "helper"}
        drawn, wanted = transitions(drawing), transitions(graph(table), behind)
        self.assertEqual(drawn.keys(), wanted.keys())
        for step, to in drawn.items():
            same = 0
            for target, cases in to.items():
                same |= cases & wanted[step].get(target, 0)
            self.assertEqual(same, ALL, f"step {step} of\n{program.read_text()}")
        return True

    def test_a_branch_that_does_nothing_keeps_those_behind_it_from_acting(self):
        source = ("PROGRAM P MOTOR MAC140; VAR_INPUT Door AT IN1; Go AT IN0; END_VAR STEP Wait: OWN ERROR; {} END_STEP\n"
                  "STEP C: OWN ERROR; END_STEP STEP D: OWN ERROR; END_STEP END_PROGRAM\n")
        for branches, drawn in (
                ("IF NOT Door THEN ; ELSE NEXT := C; END_IF", [("NOT Door", 1), ("ELSE", 2)]),
                ("IF Go THEN NEXT := D; ELSIF NOT Door THEN ; ELSE NEXT := C; END_IF", [("Go", 3), ("NOT Door", 1), ("ELSE", 2)]),
                ("IF Go THEN NEXT := D; ELSIF NOT Door THEN ; END_IF", [("Go", 3)]),
                ("IF Go THEN NEXT := D; ELSE ; END_IF", [("Go", 3)]),
                # the empty branch of one IF is none for the next
                ("IF Go THEN ; ELSIF Door THEN NEXT := C; END_IF IF Go AND Door THEN NEXT := D; END_IF",
                 [("NOT Go AND Door", 2), ("Go AND Door", 3)])):
            with self.subTest(branches):
                program = self.write("wait.seq", source.format(branches))
                wait = next(node for node in self.check(program)["nodes"] if node.get("name") == "Wait")
                self.assertEqual([(way["condition"], way["to"]) for way in wait["ways"]], drawn)
                self.assertTrue(self.check_transitions(program))
                dot = run(program, "--format", "dot").decode()
                texts = [text["text"] for text in wait["texts"]]
                self.assertEqual("NOT Door" in texts and "stays" in texts, ("NOT Door", 1) in drawn)
                self.assertEqual("stays" in dot, ("NOT Door", 1) in drawn)

    def test_a_program_is_drawn_as_the_machine_that_its_table_is(self):
        chance = random.Random(SEED)
        compared = 0
        for number in range(80):
            source = branching_program(chance, chance.randrange(2, 7))
            with self.subTest(seed=SEED, number=number):
                compared += self.check_transitions(self.write("branching.seq", source))
        self.assertGreaterEqual(compared, 30)

    def test_a_box_leads_where_the_steps_of_it_lead(self):
        """With copies, whose conditions on edges and times no table can tell."""
        chance = random.Random(SEED)
        for number in range(12):
            program = self.write("random.seq", random_program(chance, chance.randrange(2, 12)))
            with self.subTest(seed=SEED, number=number):
                drawing = graph(program)
                box_of = {step: node["step"] for node in drawing["nodes"] if node["kind"] != "note" for step in node["steps"]}
                def ways_of(read):
                    return {(box_of[step], box_of[to]) for step, targets in read.items() for to, cases in targets.items()
                            if cases and box_of[step] != box_of[to]}
                known = {node["step"]: {way.get("by", way["to"]) for way in node["ways"]} for node in drawing["nodes"] if node["kind"] != "note"}
                fault = fault_of(drawing)
                for node in drawing["nodes"]:
                    for note in node["ways"] if node["kind"] == "note" else []:
                        for other in drawing["nodes"]:
                            if other["kind"] != "note" and is_note_for(note["where"], other, note["to"], fault):
                                known[other["step"]].add(note["to"])
                drawn = {(step, box_of[to]) for step, targets in known.items() for to in targets if box_of[to] != step}
                self.assertEqual(drawn - {(0, to) for to in box_of.values()},
                                 ways_of(transitions(graph(self.table_of(program)))) - {(0, to) for to in box_of.values()})

    def test_title_motor_and_terminals_stand_apart(self):
        source = ("PROGRAM Bag_Sealer MOTOR MAC140; VAR_INPUT Pedal AT IN0; Shut AT IN3; END_VAR VAR_OUTPUT Jaws AT OUT1; END_VAR\n"
                  "STEP A: OWN ERROR; OUT Jaws; IF Pedal AND Shut THEN NEXT := POWER_UP; END_IF END_STEP END_PROGRAM\n")
        file = self.write("bag.seq", source)
        shown = [text["text"] for text in self.check(file)["texts"]]
        self.assertEqual(shown[:3], ["Bag_Sealer", "Motor: MAC140", "IN0 = Pedal, IN3 = Shut"])
        drawing = graph(file)
        self.assertEqual((drawing["motor"], drawing["terminals"][1]), ("MAC140", {"terminal": "IN3", "name": "Shut"}))

    def test_helper_steps_are_told_from_the_programs_own(self):
        table = self.write("bag_sealer.bin", "")
        subprocess.run([SEQC, "build", EXAMPLES / "bag_sealer.seq", "-o", table, "--quiet"], check=True)
        for file, kind in ((EXAMPLES / "egg_turner.seq", "helper"), (table, "copy")):
            kinds = {}
            for group in draw(file).findall(f"{SVG}g"):
                kinds.setdefault(group.get("class").split()[1], []).append(group.find(f"{SVG}rect"))
            self.assertTrue(kinds[kind])
            self.assertTrue(all(rect.get("stroke-dasharray") for rect in kinds[kind]))
            self.assertFalse(any(rect.get("stroke-dasharray") for rect in kinds["step"]))

    def test_a_step_of_a_program_is_one_box_for_all_its_steps_of_the_table(self):
        for file in sorted(EXAMPLES.glob("*.seq")):
            with self.subTest(file=file.name):
                nodes = [node for node in graph(file)["nodes"] if node["kind"] != "note"]
                self.assertFalse([node["name"] for node in nodes if node["kind"] == "copy"])
                steps = [step for node in nodes for step in node["steps"]]
                table = self.write("table.bin", "")
                subprocess.run([SEQC, "build", file, "-o", table, "--quiet"], check=True)
                drawn = [node["step"] for node in graph(table)["nodes"] if node["kind"] != "note"]
                self.assertEqual(sorted(steps), sorted(drawn))

    def test_a_png_is_one_and_fits_the_page(self):
        file = EXAMPLES / "pick_and_place.seq"
        page = graph(file)["page"]
        png = run(file, "--format", "png")
        self.assertTrue(png.startswith(b"\x89PNG\r\n\x1a\n"))
        width, height = struct.unpack(">II", png[16:24])
        self.assertAlmostEqual(width, page["width"] * page["points"] * 200 / 72, delta=4)
        self.assertAlmostEqual(height, page["height"] * page["points"] * 200 / 72, delta=4)

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
        for number in range(12):
            steps = chance.randrange(1, 15)
            table = random_table(chance, steps, chance.randrange(1, 40))
            with self.subTest(seed=SEED, number=number):
                drawing = self.check(self.write("table.bin", table))
                self.check_ways(drawing)
                names = {node.get("name") for node in drawing["nodes"]}
                self.assertLessEqual({f"step {table[at] & 0x3F}" for at in range(0, len(table) - 8, 8)}, names)

    def test_long_names_are_not_cut(self):
        long = "A_Name_As_Long_As_Anybody_Would_Ever_Want_To_Write_It_Down"
        source = (f"PROGRAM {long} VAR_INPUT {long}_In AT IN0; END_VAR VAR_OUTPUT {long}_Out AT OUT0; END_VAR\n"
                  f"STEP {long}_1: OWN ERROR; OUT {long}_Out; IF {long}_In THEN NEXT := {long}_2; END_IF END_STEP\n"
                  f"STEP {long}_2: OWN ERROR; END_STEP END_PROGRAM\n")
        drawing = self.check(self.write("long.seq", source))
        texts = {text["text"] for text in texts_in(drawing)}
        self.assertLessEqual({f"{long}_1", f"{long}_2", f"OUT {long}_Out", f"{long}_In"}, texts)


if __name__ == "__main__":
    RECIPES = Path(sys.argv.pop())
    EXAMPLES = Path(sys.argv.pop())
    SEQC = sys.argv.pop()
    unittest.main()
