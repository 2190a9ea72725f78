#!/usr/bin/env python3
"""seqc verify beside Spin on the same emitted questions: ten properties, each example program and a program that fills a table.

usage: bench_foreign.py SEQC BENCH_SEQC PROGRAM...

Medians of three, in milliseconds. Spin's own time is that of its ten runs; spin -a and the compiler come on top. What seqc
takes includes its own built-in checks.
"""

import os
import statistics
import subprocess
import sys
import tempfile
import time

RUNS = 3
PROPERTIES = [
    "NEVER OUT0 AND OUT1 AND OUT2 AND OUT3", "NEVER step = 1 AND step = 2", "ALWAYS NOT (step = 0 AND OUT3 AND IN5)",
    "step = 1 IS REACHABLE", "step = 2 IS REACHABLE", "NEVER step = 3 AND OUT3 AND TIMER.Q", "ALWAYS INPOS OR TRUE",
    "NEVER ERROR AND OUT2 AND step = 4", "WHENEVER step = 1 THEN NOT OUT3 WITHIN 20 ms",
    "WHENEVER IN0 AND step = 2 THEN step = 2 WITHIN 10 ms",
]


def milliseconds(seqc, folder, *commands):
    times = []
    for _ in range(RUNS):
        begun = time.perf_counter()
        for command in commands:
            subprocess.run(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=command[0] != seqc)
        times.append(1000 * (time.perf_counter() - begun))
    return statistics.median(times)


def main():
    seqc, bench_seqc, *programs = sys.argv[1:]
    print(f"{'program':24}{'seqc':>9}{'spin+cc':>9}{'pan':>9}{'whole':>8}{'pan only':>9}")
    with tempfile.TemporaryDirectory() as folder:
        full = os.path.join(folder, "full.seq")
        with open(full, "w", encoding="utf-8") as file:
            subprocess.run([bench_seqc, "--print"], stdout=file, check=True)
        with open(os.path.join(folder, "p.prop"), "w", encoding="utf-8") as file:
            file.writelines(f"PROPERTY P{i}: {text};\n" for i, text in enumerate(PROPERTIES))
        for program in [*programs, full]:
            subprocess.run([seqc, "build", program, "--no-symbols", "--quiet", "-o", "t.bin"], cwd=folder, check=True,
                           stderr=subprocess.DEVNULL)
            verify = [seqc, "verify", "t.bin", "--property", "p.prop", "--assume", "any"]
            subprocess.run([*verify, "--emit", "promela", "-o", "t.pml"], cwd=folder, check=True)
            own = milliseconds(seqc, folder, verify)
            made = milliseconds(seqc, folder, ["spin", "-a", "t.pml"],
                                ["gcc", "-O2", "-w", "-DSAFETY", "-o", "pan", "pan.c"])
            runs = milliseconds(seqc, folder, *(["./pan", "-m100000", "-w18", "-N", f"p_P{i}"] for i in range(len(PROPERTIES))))
            print(f"{os.path.basename(program):24}{own:9.1f}{made:9.1f}{runs:9.1f}{(made + runs) / own:8.1f}{runs / own:9.1f}")


main()
