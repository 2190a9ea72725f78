"""Random values of set-points, in rehearsals of example programs: nothing comes of them that seqc verify calls impossible.

usage: set_points_test.py SEQC NANOPLC_SIM REHEARSALS SEED PROGRAM...

Of each program as many literal times, counts and motor registers as can be become set-points with a range about the literal, which a step takes; a program
that has set-points keeps its own. `seqc verify` says over all of the ranges which declared properties are proved. Rehearsals through the whole
gateway with a virtual motor, random inputs and values of the ranges at random moments must keep them, and what else they show must
be possible. All random choices follow the seed that is printed.
"""

import glob
import json
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile

import mutants_test
import rehearse_test

SECONDS = 12
TIME = re.compile(r"\bTIMER := T#(\d+(?:\.\d+)?)(ms|s);")
COUNT = re.compile(r"\bCOUNTER := (\d+);")
REGISTER = re.compile(r"^    (\w+)\s+AT ([VPA][1-8])\s+:= (-?\d+(?:\.\d+)?) (mm/s|deg/s|rpm/s|rpm|mm|deg|rev);.*\n", re.M)
STEP = re.compile(r"^(STEP \w+:)", re.M)
PROGRAM = re.compile(r"^(PROGRAM \w+\n)", re.M)
BEHIND = re.compile(r"^(?:PROGRAM|MOTOR|SCALE)\b.*\n", re.M)


class Bench(rehearse_test.Rehearsals):
    values = []  # all of the ranges

    def compiles(self, text):
        path = self.path("set.seq", text.encode())
        return subprocess.run([self.seqc, "check", path], capture_output=True, check=False).returncode == 0

    def build(self, program):
        table = self.path("set.bin")
        subprocess.run([self.seqc, "build", program, "--quiet", "-o", table], check=True, stderr=subprocess.DEVNULL)
        with open(self.path("set.sym"), encoding="utf-8") as file:
            return json.load(file)

    def proved(self, program, names):
        """Of the properties that the program declares."""
        done = subprocess.run([self.seqc, "verify", program, "--json"], capture_output=True, text=True, check=False)
        assert done.returncode in (0, 1, 4), f"{program}: exit code {done.returncode}: {done.stderr}"
        return {r["name"] for r in json.loads(done.stdout)["results"] if r["name"] in names and r["verdict"] == "proved"}


def with_declaration(text, line):
    """Behind the last line of the head: PROGRAM, MOTOR, SCALE."""
    at = max(m.end() for m in BEHIND.finditer(text))
    return text[:at] + line + text[at:]


def ranged(name, value, unit, rng):
    low, high = sorted(value * f for f in (rng.uniform(0.5, 0.95), rng.uniform(1.05, 1.6)))
    if unit == "":
        return f"SET_POINT {name} := {value:g} RANGE {max(1, int(low))} .. {int(high) + 1};\n"
    return f"SET_POINT {name} := {value:g} {unit} RANGE {int(low)} .. {int(high) + 1} {unit};\n"


def variants(text, rng):
    """The text with one literal more as a set-point, for each that there is."""
    for pattern in (TIME, COUNT):
        for number in range(len(pattern.findall(text))):
            def replaced(now, number=number, pattern=pattern):
                matches = list(pattern.finditer(now))
                if not matches:
                    return now
                match = matches[min(number, len(matches) - 1)]
                name = f"Sp_{now.count('SET_POINT ')}"
                unit = "ms" if pattern is TIME else ""
                value = float(match.group(1)) * (1000 if match.lastindex == 2 and match.group(2) == "s" else 1)
                word = "TIMER" if pattern is TIME else "COUNTER"
                return with_declaration(now[:match.start()] + f"{word} := {name};" + now[match.end():], ranged(name, value, unit, rng))
            yield replaced
    for match in REGISTER.finditer(text):
        def moved(now, match=match):
            value = float(match.group(3))
            line = ranged(match.group(1), value, match.group(4), rng).replace(" := ", f" AT {match.group(2)} := ", 1)
            return with_declaration(now.replace(match.group(0), ""), line)
        yield moved


def with_set_points(bench, path, rng):
    """A program's text with as many set-points as compile; its own if it has some."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    for included in glob.glob(os.path.join(os.path.dirname(path), "*.seqi")):
        shutil.copy(included, bench.folder)
    if "SET_POINT " in text:
        return text
    for step in STEP.finditer(text):
        taking = text[:step.end()] + "\n    TAKES SET_POINTS;" + text[step.end():]
        if bench.compiles(taking):
            text = taking
            break
    for change in variants(text, rng):
        more = change(text)
        if more.count("SET_POINT ") <= 16 and bench.compiles(more):
            text = more
    return text


def random_values(points, rng):
    """Lines that set some of them at random moments, ends of the ranges more often."""
    lines = []
    for _ in range(rng.choice([1, 2, 4, 8])):
        chosen = rng.sample(points, rng.randrange(1, len(points) + 1))
        parts = []
        for point in chosen:
            raw = rng.choice([point["lowest"], point["highest"], rng.randint(point["lowest"], point["highest"])])
            if point.get("step"):
                steps = round((raw - point["lowest"]) / point["steps_per_unit"] / point["step"])
                value = point["lowest"] / point["steps_per_unit"] + steps * point["step"]
            else:
                value = raw / point["steps_per_unit"]
            parts.append(f"{point['name']} := {value:.9g} {point['unit']}".strip())
        lines.append(f"at {rng.randrange(0, SECONDS * 1000)} ms set {' and '.join(parts)}")
    return lines


def declared(text, symbols):
    """The properties that look at no time and no input, of which a trace shows more than scans have seen, and at no step where
    some have copies; in the words of a bare table."""
    copied = any("made_for" in step for step in symbols["steps"])
    source = re.sub(r"//[^\n]*|\(\*.*?\*\)|/\*.*?\*/", " ", text, flags=re.S)
    found = re.findall(r"\bPROPERTY\s+(\w+)\s*:(.*?);", source, flags=re.S | re.I)
    texts = [(name, mutants_test.bare(body, symbols)) for name, body in found]
    return [mutants_test.Property(name, body) for name, body in texts
            if not mutants_test.NOT_JUDGED & set(body.split()) and "IS REACHABLE" not in body
            and not re.search(r"\bIN\d|INPOS|ERROR", body) and not (copied and "STEP" in body)]


def rehearsed(bench, path, count, rng):
    text = with_set_points(bench, path, rng)
    program = bench.path("set.seq", text.encode())
    symbols = bench.build(program)
    points = symbols.get("set_points", [])
    if not points:
        return None
    properties = declared(text, symbols)
    proved = bench.proved(program, {p.name for p in properties})
    facts = {"states": set(), "follow": set(), "last": {}}
    for i in range(count):
        own = rehearse_test.own_actions(path) if i % 2 == 0 else []
        own = [line for line in own if not re.search(r"\bset\b", line)]
        actions = [*own, *rehearse_test.random_actions(rng, False), *random_values(points, rng)]
        scenario = "\n".join([*filter(rehearse_test.before_the_end, actions), f"end at {SECONDS} s"]) + "\n"
        rows = bench.trace(program, scenario, rng)
        scans = [{"step": r.step, "counter": 0 if r.counter_zero else 1, "outputs": r.outputs, "image": r.image} for r in rows]
        for one in properties:
            assert one.name not in proved or not one.seen_in(scans), f"{path}: {one.name} is proved and broken\n{text}\n{scenario}"
        rehearse_test.facts_of(rows, facts, False)
    # One value is enough to reach it; IS REACHABLE is proved only if every value is.
    facts["states"] = {re.sub(r"^(.*) IS REACHABLE$", r"NEVER \1", text) for text in facts["states"]}
    asked, undecided = rehearse_test.check(bench, program, facts)
    return len(points), len(proved), len(properties), asked, undecided


def main():
    seqc, nanoplc_sim, count, seed = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
    print(f"seed {seed}")
    programs = points = proved = asked = undecided = 0
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(seqc, nanoplc_sim, folder)
        for path in sys.argv[5:]:
            rng = random.Random(f"{seed} {os.path.basename(path)}")
            done = rehearsed(bench, path, count, rng)
            if done is None:
                continue
            print(f"{os.path.basename(path)}: {done[0]} set-points, {done[1]} of {done[2]} judged properties proved, {done[3]} facts")
            programs, points, proved = programs + 1, points + done[0], proved + done[1]
            asked, undecided = asked + done[3], undecided + done[4]
    print(f"{programs} programs with {points} set-points, {count} rehearsals each: {proved} proved properties kept, {asked} facts, all possible "
          f"({undecided} undecided)")
    assert programs > 0 and points > programs


if __name__ == "__main__":
    main()
