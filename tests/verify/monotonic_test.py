"""What is broken at a time is broken at every shorter one, and what is proved at every longer one, on random tables and on
random programs of the language.

usage: monotonic_test.py SEQC NANOPLC_SIM CASES [SEED]
"""

import json
import random
import subprocess
import sys
import tempfile

import programs
import random_cases
import random_programs

TIMES = [1, 2, 3, 5, 8, 20, 50, 320, 350, 800]
FORMS = {"whenever": "WHENEVER {} THEN {} WITHIN {} ms", "for": "WHENEVER {} FOR {} ms THEN {}",
         "while": "NEVER {} WHILE {} FOR {} ms"}


def text_of(form, c, d, ms):
    one, two = random_cases.text_of(c), random_cases.text_of(d)
    return FORMS[form].format(one, ms, two) if form == "for" else FORMS[form].format(one, two, ms)


class Case(programs.Programs):
    def verdicts(self, text):
        self.path("p.prop", text.encode())
        done = subprocess.run([self.seqc, "verify", self.path("t.bin"), "--property", self.path("p.prop"), "--json"],
                              capture_output=True, text=True, check=False)
        assert done.returncode in (0, 1, 4), done.stderr
        document = json.loads(done.stdout)
        self.replay_all(self.path("t.bin"), document)
        return {r["name"]: r["verdict"] for r in document["results"] if "code" not in r}


def check_order(verdicts, what):
    """By rising time: broken, then undecided, then proved."""
    rank = {"broken": 0, "undecided": 1, "proved": 2}
    assert verdicts == sorted(verdicts, key=rank.get), (what, verdicts)


def check_case(case, number, rng):
    if number % 2 == 1:
        program = random_programs.random_program(case, rng, rng.choice([3, 30, 400]))
        case.text, steps = program.text, len(program.numbers)
    else:
        table, steps = random_cases.random_table(rng)
        case.path("t.bin", b"".join(table))
        case.text = "\n".join(t.hex(" ") for t in table)
    seen = []
    questions = [(rng.choice(list(FORMS)), *(random_cases.random_condition(rng, steps) for _ in range(2))) for _ in range(4)]
    text = "".join(f"PROPERTY P{n}_{ms}: {text_of(form, c, d, ms)};\n"
                   for n, (form, c, d) in enumerate(questions) for ms in TIMES)
    verdicts = case.verdicts(text)
    for n, question in enumerate(questions):
        seen.append([verdicts[f"P{n}_{ms}"] for ms in TIMES])
        check_order(seen[-1], text_of(*question, TIMES[0]))
    condition = random_cases.text_of(random_cases.random_condition(rng, steps))
    by_time = [case.verdicts(f"PROPERTY P: NEVER {condition};\nASSUME IN0 STABLE FOR {ms} ms;")["P"] for ms in (4, 10, 40)]
    check_order(by_time, f"NEVER {condition} with IN0 STABLE")
    return [verdict for row in seen for verdict in row]


def main():
    seqc, nanoplc_sim, cases = sys.argv[1], sys.argv[2], int(sys.argv[3])
    seed = int(sys.argv[4]) if len(sys.argv) > 4 else random.randrange(1 << 32)
    all_verdicts = []
    with tempfile.TemporaryDirectory() as folder:
        case = Case(seqc, nanoplc_sim, folder)
        for number in range(cases):
            try:
                all_verdicts += check_case(case, number, random.Random(seed * 1_000_003 + number))
            except AssertionError:
                print(f"case {number} of seed {seed}:\n" + case.text)
                raise
    print(f"{cases} tables and programs of seed {seed}: " + ", ".join(f"{all_verdicts.count(v)} {v}" for v in ("broken", "undecided", "proved")))


main()
