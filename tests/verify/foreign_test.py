"""seqc verify held against Spin and Z3 by what it emits for them, on random tables and on programs.

usage: foreign_test.py SEQC CASES [SEED] [PROGRAM...]

Random properties of all forms are asked of each, and of each step whether it is reached; of every third table with moves
and assumptions, one of them that moves end in some time. Spin cannot state ALWAYS POSSIBLE, Datalog counts no time of WHILE.
"""

import json
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile

import programs
import random_cases

PROPERTIES = 8
SKIPPED = 77


def run(command, folder, allowed=(0,)):
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode in allowed, f"{' '.join(command)}: exit code {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout


def verdicts_of_verify(seqc, table, folder, timed):
    report = json.loads(run([seqc, "verify", table, "--property", "p.prop", "--assume", "any", "--set-points", "default", "--json"], folder,
                            (0, 1, 4)))
    player = os.path.join(os.path.dirname(seqc), "nanoplc-sim")
    programs.Programs(seqc, player, folder).replay_all(os.path.join(folder, table), report)
    own = {r["name"]: r["verdict"] for r in report["results"] if "code" not in r}
    undecided = [r["property"] for r in report["results"] if "code" not in r and r["verdict"] == "undecided"]
    assert report["complete"] and (timed or not undecided), report
    assert all("ALWAYS POSSIBLE" in text for text in undecided), undecided  # what times do to ways on may stay open
    return own, report["unreachable"]


def emit(seqc, table, folder, language, output):
    run([seqc, "verify", table, "--property", "p.prop", "--assume", "any", "--set-points", "default", "--emit", language, "-o", output],
        folder)


def proved(found, text):
    """`found`: some scan is as the checker was asked."""
    return "proved" if found == ("IS REACHABLE" in text) else "broken"


def verdicts_of_spin(seqc, table, folder, texts):
    emit(seqc, table, folder, "promela", "t.pml")
    run(["spin", "-a", "t.pml"], folder)
    run(["gcc", "-O0", "-w", "-DSAFETY", "-o", "pan", "pan.c"], folder)
    result = {}
    for name, text in texts.items():
        if "ALWAYS POSSIBLE" in text or text.startswith("ASSUME"):
            continue
        told = run(["./pan", "-m100000", "-w18", "-N", f"p_{name}"], folder)
        errors = int(re.search(r"errors: (\d+)", told).group(1))
        assert "too small" not in told and (errors or "Search not completed" not in told), told
        result[name] = proved(errors != 0, text)
    return result


def verdicts_of_z3(seqc, table, folder, texts):
    emit(seqc, table, folder, "smt2", "t.smt2")
    lines = run(["z3", "t.smt2"], folder).split()
    answers = dict(zip(lines[::2], lines[1::2], strict=True))
    asked = {name: text for name, text in texts.items() if " WHILE " not in text and not text.startswith("ASSUME")}
    assert set(answers) == set(asked) and set(answers.values()) <= {"sat", "unsat"}, lines
    return {name: proved(answers[name] == "sat", text) for name, text in asked.items()}


def compare(seqc, checkers, table, folder, properties, steps, assumptions=()):
    """Verdicts of seqc; of `properties` and whether the steps are reached, under the assumptions."""
    timed = any("ENDS" in text for text in assumptions)
    texts = {p[4].split()[1][:-1]: p[4] for p in properties}
    for step in steps:
        texts[f"Step_{step}"] = f"PROPERTY Step_{step}: step = {step} IS REACHABLE;"
    texts |= {f"ASSUME {i}": text for i, text in enumerate(assumptions)}
    with open(os.path.join(folder, "p.prop"), "w", encoding="utf-8") as file:
        file.write("\n".join(texts.values()) + "\n")
    own, unreachable = verdicts_of_verify(seqc, table, folder, timed)
    for step in steps:
        if step != 0 and not timed:
            assert (own[f"Step_{step}"] == "broken") == (step in unreachable), (step, unreachable)
    for checker in checkers:
        for name, verdict in checker(seqc, table, folder, texts).items():
            assert own[name] in (verdict, "undecided"), f"{checker.__name__}: {verdict}, seqc: {own[name]}: {texts[name]}"
    return own.values()


def random_case(seqc, checkers, folder, rng):
    moves = rng.random() < 1 / 3
    assumptions = []
    if moves:
        assumptions = rng.choice([[], ["ASSUME NEVER IN0 AND IN1;"], ["ASSUME NEVER INPOS AND ERROR;"]])
        assumptions = assumptions + rng.choice([[], [f"ASSUME moving ENDS WITHIN {rng.choice([1, 2, 4])} ms;"]])
    table, count = random_cases.random_table(rng, moves=moves)
    with open(os.path.join(folder, "t.bin"), "wb") as file:
        file.write(b"".join(table))
    steps = sorted({t[0] & 0x3F for t in table[:-1]})
    try:
        properties = random_cases.random_properties(rng, count, PROPERTIES, moves=moves)
        return compare(seqc, checkers, "t.bin", folder, properties, steps, assumptions)
    except AssertionError:
        print("\n".join([*(t.hex(" ") for t in table), *assumptions]))
        raise


def program_case(seqc, checkers, folder, rng, program):
    run([seqc, "build", program, "--no-symbols", "-o", "t.bin", "--quiet"], folder)
    with open(os.path.join(folder, "t.bin"), "rb") as file:
        states = [byte & 0x3F for byte in file.read()[::8]][:-1]
    untimed = [form for form in random_cases.FORMS if form != "while"]  # each millisecond of its timers is a state for Spin
    properties = random_cases.random_properties(rng, max(states) + 1, 2 * PROPERTIES, untimed, True)
    try:
        return compare(seqc, checkers, "t.bin", folder, properties, sorted(set(states)))
    except AssertionError:
        print(program)
        raise


def check_refusals(seqc, folder):
    """One line each, exit code 2, and nothing written."""
    with open(os.path.join(folder, "t.bin"), "wb") as file:
        file.write(bytes.fromhex("C041490280052C01 3F00000000000000"))
    with open(os.path.join(folder, "p.prop"), "w", encoding="utf-8") as file:
        file.write("PROPERTY P: ALWAYS POSSIBLE step = 0;")
    with open(os.path.join(folder, "stable.prop"), "w", encoding="utf-8") as file:
        file.write("ASSUME IN0 STABLE FOR 5 ms; PROPERTY P: NEVER step = 2;")
    plain = ["t.bin", "--emit", "promela", "-o", "never.pml"]
    for options, reason in ((["--property", "p.prop"], "--assume any"),
                            (["--assume", "any"], "no property to emit"),
                            (["--property", "p.prop", "--assume", "any", "--json"], "does not go with"),
                            (["--property", "stable.prop", "--assume", "any"], "STABLE"),
                            (["--property", "p.prop", "--assume", "any"], "in smt2")):
        done = subprocess.run([seqc, "verify", *plain, *options], cwd=folder, capture_output=True, text=True, check=False)
        assert done.returncode == 2 and reason in done.stderr and done.stderr.count("\n") == 1, (options, done)
        assert not os.path.exists(os.path.join(folder, "never.pml"))


def main():
    seqc, cases = sys.argv[1], int(sys.argv[2])
    seed = int(sys.argv[3]) if len(sys.argv) > 3 else random.randrange(1 << 32)
    checkers = []
    for checker, programs in ((verdicts_of_spin, ["spin", "gcc"]), (verdicts_of_z3, ["z3"])):
        missing = [p for p in programs if not shutil.which(p)]
        if missing:
            print(f"skipped: {' and '.join(missing)} not installed (tools/setup all)")
        else:
            checkers.append(checker)
    if not checkers:
        sys.exit(SKIPPED)
    verdicts = []
    with tempfile.TemporaryDirectory() as folder:
        check_refusals(seqc, folder)
        for number in range(cases):
            try:
                verdicts += random_case(seqc, checkers, folder, random.Random(seed * 1_000_003 + number))
            except AssertionError:
                print(f"case {number} of seed {seed}")
                raise
        for program in sys.argv[4:]:
            verdicts += program_case(seqc, checkers, folder, random.Random(seed), program)
    print(f"seed {seed}: {cases} tables, {len(sys.argv[4:])} programs, {len(verdicts)} properties, "
          f"{verdicts.count('proved')} proved and {verdicts.count('broken')} broken by all of "
          + ", ".join(["seqc", *(c.__name__.removeprefix('verdicts_of_') for c in checkers)]))


main()
