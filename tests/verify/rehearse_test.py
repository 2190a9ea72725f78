"""Rehearsals through the whole gateway with a virtual motor: seqc verify reaches all of their states under --assume driver.

usage: rehearse_test.py SEQC NANOPLC_SIM REHEARSALS TABLES SEED PROGRAM...

Each program is rehearsed with its own scenario and random inputs, motor errors and cut lines on top; so are random tables. What
the trace shows is asked as properties: states with their outputs and whether timer and counter are zero, with which inputs, INPOS
and ERROR a scan left them, steps that follow each other, how long steps last. All random choices follow the seed that is printed.
"""

import csv
import json
import os
import random
import re
import subprocess
import sys
import tempfile
from collections import namedtuple

import programs
import random_cases

ORDERS = [0x08, 0x10, 0x14, 0x24, 0x40, 0x41, 0x48, 0x61, 0x65, 0x67, 0x70]  # INIT, VELOCITY, POSITION, commands
SECONDS = 12
LONGEST_SCAN = 400  # ms, with its orders


Row = namedtuple("Row", "time step outputs timer_zero counter_zero image")
SIGNALS = [*(f"IN{i}" for i in range(6)), "INPOS", "ERROR"]


class Rehearsals(programs.Programs):
    values = ["--set-points", "default"]

    def trace(self, program, scenario, rng):
        """Rows of the trace."""
        trace = self.path("t.csv")
        done = subprocess.run([self.nanoplc_sim, "run", program, "--scenario", self.path("s.scn", scenario.encode()),
                               "--trace", trace, "--quiet", "--seed", str(rng.randrange(1 << 30)),
                               "--debounce", rng.choice(["3ms", "3ms", "11ms"])],  # the longer keeps to the shorter one's rule too
                              capture_output=True, text=True, check=False)
        assert done.returncode in (0, 1), f"{program}: {done.stderr}\n{scenario}"
        with open(trace, encoding="ascii") as file:
            return [Row(float(r["time_ms"]), int(r["step"]), int(r["outputs"]), int(r["timer"]) == 0, int(r["counter"]) == 0,
                        int(r["inputs"]) | int(r["inpos"]) << 6 | int(r["error"]) << 7) for r in csv.DictReader(file)]

    def verdicts(self, program, texts):
        prop = self.path("p.prop", "".join(f"PROPERTY P{i}: {text};\n" for i, text in enumerate(texts)).encode())
        done = subprocess.run([self.seqc, "verify", program, "--property", prop, "--json", *self.values], capture_output=True, text=True,
                              check=False)
        assert done.returncode in (0, 1, 4), f"{program}: exit code {done.returncode}: {done.stderr}"
        document = json.loads(done.stdout)
        if program.endswith(".bin"):
            self.replay_all(program, document)
        return {r["name"]: r["verdict"] for r in document["results"] if "code" not in r}


def random_actions(rng, cuts):
    """Inputs that bounce, come and go, now and then an error of the motor or a cut line."""
    lines, time = [], 0
    while time < SECONDS * 1000:
        time += rng.choice([1, 2, 3, 4, 5, 8, 20, 60, 150, 400, 900])
        draw = rng.random()
        if draw < 0.04:
            lines.append(f"at {time} ms motor error")
        elif draw < 0.06 and cuts:
            lines.append(f"at {time} ms line cut for {rng.choice([5, 50, 400, 1500])} ms")
        else:
            for i in rng.sample(range(6), rng.choice([1, 1, 2])):
                lines.append(f"at {time} ms {rng.choice([f'toggle IN{i}', f'toggle IN{i}', f'pulse IN{i} {rng.choice([1, 4, 30, 300])} ms'])}")
    return lines


def own_actions(program):
    """A program's own scenario without what it expects and when it ends; its set-points keep their defaults."""
    path = os.path.splitext(program)[0] + ".scn"
    if not os.path.exists(path):
        return []
    with open(path, encoding="utf-8") as file:
        lines = [line.strip() for line in file]
    return [line for line in lines if line and not line.lower().startswith(("expect", "always", "never", "end", "#", "gateway"))
            and not any(word in line.lower() for word in ("expect", "gateway", "recipe"))]


def facts_of(rows, facts, pins_are_outputs):
    """`facts`: properties that the trace refutes, or shows to be reachable; of a kind of lasting the longest. While the link is
    lost the pins have their safe values, whatever the sequence writes."""
    begun = seen = None
    for before, row in zip([None, *rows], rows):
        time, step = row.time, row.step
        signals = [signal(row.outputs, i, f"OUT{i}") for i in range(4)] if pins_are_outputs else []
        state = " AND ".join([f"step = {step}", *signals, signal(row.counter_zero, 0, "COUNTER.Q")])
        if begun is not None or (before and before.step != step):  # before that no scan may have ended in step 0
            facts["states"].add(f"{state} IS REACHABLE")
            # The timer only runs down between scans: it ran after the last one; it was zero when the next one began.
            facts["states"].add(f"{state} AND NOT TIMER.Q IS REACHABLE" if not row.timer_zero
                                else f"EVERY_SCAN FROM {state} AND TIMER.Q ENDS IN FALSE")
        if before is None or before[1:3] != row[1:3] or before.image != row.image:
            seen = time
        elif time - seen > LONGEST_SCAN:  # so a scan read them, and left this
            image = " AND ".join(signal(row.image, i, name) for i, name in enumerate(SIGNALS))
            facts["states"].add(f"{state} AND {image} IS REACHABLE")
        if before and before.step != step:
            if begun is not None:
                facts["follow"].add(f"WHENEVER step = {before.step} AND NOT step = {step} FOLLOWED BY step = {step} THEN FALSE")
                facts["last"][before.step] = max(facts["last"].get(before.step, 0), int(time - begun) - 1)
            begun = time
    return facts


def signal(bits, number, name):
    return name if bits >> number & 1 else f"NOT {name}"


def check(bench, program, facts):
    texts = {text: "broken" if "REACHABLE" in text else "proved" for text in facts["states"]}
    texts |= {text: "proved" for text in facts["follow"]}
    for step, ms in facts["last"].items():
        if ms > 0:
            texts[f"WHENEVER step = {step} THEN NOT step = {step} WITHIN {ms} ms"] = "proved"
        if ms > 2 * LONGEST_SCAN:  # the last scan in it may have been so long before
            texts[f"NEVER step = {step} WHILE step = {step} FOR {ms - LONGEST_SCAN} ms"] = "proved"
    order = sorted(texts)
    verdicts = bench.verdicts(program, order)
    wrong = [text for i, text in enumerate(order) if verdicts[f"P{i}"] == texts[text]]
    assert not wrong, f"{program}: rehearsed, and impossible for seqc verify:\n  " + "\n  ".join(wrong)
    return len(order), sum(verdicts[f"P{i}"] == "undecided" for i in range(len(order)))


UNITS = {"ms": 1, "s": 1000, "min": 60000}


def before_the_end(line):
    """A scenario takes no action that comes when it has ended."""
    begins = re.findall(r"\b(?:at|from)\s+([\d.]+)\s*(ms|s|min)\b", line)
    return all(float(time) * UNITS[unit] < SECONDS * 1000 for time, unit in begins)


def is_for_midi(program):
    with open(program, "rb") as file:
        return program.endswith(".seq") and re.search(rb"^MOTOR MAC(23|34)", file.read(), re.MULTILINE) is not None


def rehearsed(bench, program, scenarios, rng):
    facts = {"states": set(), "follow": set(), "last": {}}
    losing = ["line", "power", "gateway", "security"] + (["error"] if is_for_midi(program) else [])  # a reset drive restarts
    for scenario in scenarios:
        text = "\n".join([*filter(before_the_end, scenario), f"end at {SECONDS} s"]) + "\n"
        link_stays = not any(word in text for word in losing)
        facts_of(bench.trace(program, text, rng), facts, link_stays)
    return check(bench, program, facts)


def main():
    seqc, nanoplc_sim, count, tables, seed = sys.argv[1], sys.argv[2], *(int(a) for a in sys.argv[3:6])
    print(f"seed {seed}")
    with tempfile.TemporaryDirectory() as folder:
        bench = Rehearsals(seqc, nanoplc_sim, folder)
        asked = undecided = 0
        for program in sys.argv[6:]:
            rng = random.Random(f"{seed} {os.path.basename(program)}")
            scenarios = [(own_actions(program) if i % 2 == 0 else []) + random_actions(rng, i % 3 == 2) for i in range(count)]
            more, open_ones = rehearsed(bench, program, scenarios, rng)
            asked, undecided = asked + more, undecided + open_ones
        print(f"{len(sys.argv) - 6} programs, {count} rehearsals each: {asked} facts, all possible ({undecided} undecided)")
        asked = undecided = 0
        for number in range(tables):
            rng = random.Random(seed * 1_000_003 + number)
            table, _ = random_cases.random_table(rng)
            terms = [t[:4] + bytes([rng.choice(ORDERS)]) + t[5:] if not t[2] & 0x80 and rng.random() < 0.3 else t for t in table]
            program = bench.path("t.bin", b"".join(terms))
            try:
                more, open_ones = rehearsed(bench, program, [random_actions(rng, cuts) for cuts in (False, True)], rng)
            except AssertionError:
                print(f"table {number} of seed {seed}:\n" + "\n".join(t.hex(" ") for t in terms))
                raise
            asked, undecided = asked + more, undecided + open_ones
        print(f"{tables} random tables, 2 rehearsals each: {asked} facts, all possible ({undecided} undecided)")


if __name__ == "__main__":
    main()
