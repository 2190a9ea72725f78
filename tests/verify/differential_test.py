"""seqc verify held against a naive explorer, on random small tables and programs, and properties.

usage: differential_test.py SEQC NANOPLC_SIM CASES [SEED]

Every second case is a program of the language, with ON, groups, and steps that the compiler makes itself.
"""

import contextlib
import json
import os
import random
import subprocess
import sys
import tempfile

import naive
import programs
import random_cases
import random_programs

PROPERTIES = 10


class Case(programs.Programs):
    def verify(self, assume):
        done = subprocess.run([self.seqc, "verify", self.path("t.bin"), "--property", self.path("p.prop"),
                               "--assume", assume, "--json"], capture_output=True, text=True, check=False)
        if done.returncode not in (0, 1, 4):
            raise AssertionError(f"exit code {done.returncode}: {done.stderr}")
        document = json.loads(done.stdout)
        verdicts = {(r["verdict"], r["severity"]) for r in document["results"]}
        undecided = any(verdict == "undecided" for verdict, _ in verdicts)
        expected = 1 if ("broken", "fault") in verdicts else 4 if undecided else 0
        if done.returncode != expected:
            raise AssertionError(f"exit code {done.returncode} with {verdicts}")
        self.replay_all(self.path("t.bin"), document)
        return document


def image_of(scan):
    return scan["inputs"] | scan["inpos"] << 6 | scan["error"] << 7


def judge_course(case, prop, course, explorer, free):
    """Whether a course breaks the property (reaches it), played by nanoplc-sim and by the manual."""
    form, c, d, ms, _, e = prop
    course = programs.expanded(course)
    state, states, begun = explorer.off, [], []
    for scan, row in zip(course, case.replayed(case.path("t.bin"), course), strict=True):
        assert image_of(scan) & 0xC0 or explorer.possible(state) is explorer.images, "a move has ended by then"
        begun.append(state)
        after = explorer.scan(state, image_of(scan))
        states.append(after)
        state = explorer.elapse(after, scan["dt_ms"])
        assert list(state[:1] + (state[2], state[3], state[1])) == row, (state, row)
    image = image_of(course[-1])
    if form in ("never", "reachable"):
        return naive.holds(c, image, states[-1])
    if form == "always":
        return not naive.holds(c, image, states[-1])
    if form in ("possible", "after"):
        if not free:
            return True
        ways = explorer.ways_to(c)
        return (form == "possible" or naive.holds(d, image, states[-1])) and not naive.holds(c, image, states[-1]) and not any(
            later in ways for later in explorer.elapsed(states[-1]))
    if form not in ("whenever", "while"):
        return judge_remembered(form, c, d, e, course, states, begun)
    if form == "while":
        return held_too_long(c, d, ms, course, states)
    due = None
    time = 0
    for scan, after in zip(course, states, strict=True):
        if naive.holds(d, image_of(scan), after):
            due = None
        elif due is None and naive.holds(c, image_of(scan), after):
            due = time + ms
        time += scan["dt_ms"]
        if due is not None and time > due:
            return True
    return False


def judge_remembered(form, c, d, e, course, states, begun):
    """Whether the last scan, and none before it, breaks the property."""
    values = [[naive.holds(x, image_of(scan), after) for x in (c, d, e)]
              for scan, after in zip(course, states, strict=True)]
    began = [naive.holds(d, image_of(scan), before) for scan, before in zip(course, begun, strict=True)]
    broken, within = [], False
    off = [naive.holds(x, 0, begun[0]) for x in (c, d, e)]
    for k, (one, two, three) in enumerate(values):
        before = values[k - 1] if k else off
        within = (within or one) and not two
        broken.append({"only": one and not any(v[1] for v in values[:k + 1]),
                       "stays": within and not three,
                       "changes": one != before[0] and not two and not before[1],
                       "scan": naive.holds(c, image_of(course[k]), begun[k]) and not two,
                       "from": one and not any(began[:k + 1]),
                       "both": one and not any(v[1] and w[2] for v, w in zip(values, values[1:k + 1])),
                       "followed": k > 0 and before[0] and two and not three}[form])
    return broken[-1] and not any(broken[:-1])


def held_too_long(c, d, ms, course, states):
    time, since = 0, None
    for scan, after in zip(course, states, strict=True):
        if not naive.holds(d, image_of(scan), after):
            since = None
        elif since is None:
            since = time
        elif time - since >= ms and naive.holds(c, image_of(scan), after):
            return True
        time += scan["dt_ms"]
    return False


def unreachable_of(case, report):
    return {case.numbers.get(step, step) for step in report["unreachable"]}


def check_any(case, table, properties, report, explorer):
    begun = explorer.begun | {0}
    with_terms = {t[0] & 0x3F for t in table[:-1]}
    unreachable = {s for s in with_terms | set(case.numbers.values()) if s not in begun}
    if explorer.move_ms is None:
        assert unreachable_of(case, report) == unreachable, report["unreachable"]
    else:  # reported without times
        assert unreachable_of(case, report) <= unreachable, report["unreachable"]
    results = {r["name"]: r for r in report["results"] if "code" not in r}
    for number, prop in enumerate(properties):
        holds, shortest = explorer.verdict(prop[0], prop[1], prop[2], prop[5], prop[3])
        result = results[f"P{number}"]
        if explorer.move_ms is not None and prop[0] in ("possible", "after") and result["verdict"] == "undecided":
            continue
        assert result["verdict"] == ("proved" if holds else "broken"), (prop[4], result["verdict"])
        if shortest is None:
            assert "course" not in result
            continue
        assert len(programs.expanded(result["course"])) == shortest, (prop[4], result["course"], shortest)
        assert judge_course(case, prop, result["course"], explorer, True), prop[4]


def check_driver(case, properties, report, free, explorer):
    """Each course of the driver's is one of `any`."""
    assert unreachable_of(case, report) >= unreachable_of(case, free)
    results = {r["name"]: r for r in report["results"] if "code" not in r}
    for other in free["results"]:
        if "code" in other:
            continue
        result = results[other["name"]]
        prop = properties[int(other["name"][1:])]
        if prop[0] == "reachable":
            assert (result["verdict"], other["verdict"]) != ("proved", "broken"), prop[4]
        elif prop[0] not in ("possible", "after"):
            assert (result["verdict"], other["verdict"]) != ("broken", "proved"), prop[4]
        if "course" in result:
            assert judge_course(case, prop, result["course"], explorer, False), prop[4]
    return [r["verdict"] for r in results.values()]


def random_case(case, number, rng, moves):
    """(table, properties); a program's symbols stand beside its table."""
    with contextlib.suppress(FileNotFoundError):
        os.remove(case.path("t.sym"))
    case.numbers = {}
    if number % 2 == 1:
        program = random_programs.random_program(case, rng)
        case.text, case.numbers = program.text, program.numbers
        steps = len(program.numbers)
        properties = random_cases.random_properties(rng, steps, PROPERTIES - 2, moves=moves)
        return program.table, properties + random_cases.group_properties(rng, program.group, steps, PROPERTIES - 2)
    table, steps = random_cases.random_table(rng, moves=moves)
    case.text = "\n".join(t.hex(" ") for t in table)
    case.path("t.bin", b"".join(table))
    return table, random_cases.random_properties(rng, steps, PROPERTIES, moves=moves)


def main():
    seqc, nanoplc_sim, cases = sys.argv[1], sys.argv[2], int(sys.argv[3])
    seed = int(sys.argv[4]) if len(sys.argv) > 4 else random.randrange(1 << 32)
    verdicts = []
    with tempfile.TemporaryDirectory() as folder:
        case = Case(seqc, nanoplc_sim, folder)
        for number in range(cases):
            rng = random.Random(seed * 1_000_003 + number)
            move_ms = rng.choice([1, 2, 4]) if number % 3 == 2 else None
            table, properties = random_case(case, number, rng, move_ms is not None)
            text = "\n".join(p[4] for p in properties)
            if move_ms is not None:
                text += f"\nASSUME moving ENDS WITHIN {move_ms} ms;"
            case.path("p.prop", text.encode())
            try:
                explorer = naive.Naive(table, random_cases.images(), 3, move_ms)
                free = case.verify("any")
                check_any(case, table, properties, free, explorer)
                verdicts += check_driver(case, properties, case.verify("driver"), free, explorer)
            except AssertionError:
                print(f"case {number} of seed {seed}:\n{case.text}\n{text}")
                raise
    print(f"{cases} tables and programs, {len(verdicts)} properties; under driver "
          + ", ".join(f"{verdicts.count(v)} {v}" for v in ("proved", "broken", "undecided")))


main()
