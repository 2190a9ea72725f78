#!/usr/bin/env python3
"""Figures of seqc verify in one run: on each example program and on a program that fills a table, beside Spin on the same emitted
questions, and how far it goes with times.

usage: bench_foreign.py SEQC BENCH_SEQC PROGRAM...

Medians of five for seqc and of three for Spin, processor time in milliseconds, so that other work on the machine counts little. All runs of
seqc include its own built-in checks and ten properties without times; `driver` and `any` are what is assumed. Spin is asked what `any` asks:
its own time is that of its ten runs, spin -a and the compiler come on top. With times: three properties one by one, on the full table
and on a dense one of random terms, its greatest time and memory.
"""

import os
import random
import statistics
import subprocess
import sys
import tempfile

PROPERTIES = [
    "NEVER OUT0 AND OUT1 AND OUT2 AND OUT3", "NEVER step = 1 AND step = 2", "ALWAYS NOT (step = 0 AND OUT3 AND IN5)",
    "step = 1 IS REACHABLE", "step = 2 IS REACHABLE", "NEVER step = 3 AND OUT3 AND TIMER.Q", "ALWAYS INPOS OR TRUE",
    "NEVER ERROR AND OUT2 AND step = 4", "WHENEVER step = 1 THEN NOT OUT3", "WHENEVER IN0 AND step = 2 THEN step = 2",
]
TIMED = ["WHENEVER step = 1 THEN NOT step = 1 WITHIN 5 s", "NEVER OUT0 WHILE OUT1 FOR 3 s", "WHENEVER IN0 AND step = 7 THEN step = 0 WITHIN 60 s"]


def once(folder, command):
    """Milliseconds of processor time, and KiB at the most."""
    with subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
        _, _, used = os.wait4(process.pid, 0)
        process.returncode = 0
    return 1000 * (used.ru_utime + used.ru_stime), used.ru_maxrss


def milliseconds(runs, folder, *commands):
    return statistics.median(sum(once(folder, command)[0] for command in commands) for _ in range(runs))


def write(folder, name, lines):
    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
        file.writelines(f"{line}\n" for line in lines)


def compare(seqc, folder, program):
    subprocess.run([seqc, "build", program, "--no-symbols", "--quiet", "-o", "t.bin"], cwd=folder, check=True, stderr=subprocess.DEVNULL)
    verify = [seqc, "verify", "t.bin", "--property", "p.prop"]
    driver, free = (milliseconds(5, folder, [*verify, "--assume", assume]) for assume in ("driver", "any"))
    subprocess.run([*verify, "--assume", "any", "--emit", "promela", "-o", "t.pml"], cwd=folder, check=True)
    made = milliseconds(3, folder, ["spin", "-a", "t.pml"], ["gcc", "-O2", "-w", "-DSAFETY", "-o", "pan", "pan.c"])
    runs = milliseconds(3, folder, *(["./pan", "-m100000", "-w18", "-N", f"p_P{i}"] for i in range(len(PROPERTIES))))
    print(f"{os.path.basename(program):26}{driver:8.1f}{free:8.1f}{made:9.0f}{runs:9.0f}{(made + runs) / free:9.0f}{runs / free:9.0f}", flush=True)


def dense_table(rng):
    """992 terms over all steps, with timers, small counters and orders to the motor."""
    terms = []
    for _ in range(992):
        next_step = rng.choice([0x3E, rng.randrange(63), rng.randrange(63)]) | rng.choice([0, 0, 0, 0x40])
        word = rng.randrange(200) if next_step & 0x40 else rng.choice([0, 0, rng.randrange(1, 5000)])
        terms.append(bytes([rng.randrange(63) | rng.choice([0, 0x80, 0x40, 0xC0, 0xC0]), rng.randrange(256),
                            rng.randrange(128) & rng.randrange(128), next_step, rng.choice([0x80, 0x80, 0x40, 0x28, 0x65, 0x61]),
                            rng.randrange(16) | rng.choice([0, 0, 0, 0x40, 0x80]), word & 255, word >> 8]))
    return b"".join(terms) + bytes([0x3F, 0, 0, 0, 0, 0, 0, 0])


def with_times(seqc, folder, name):
    used = []
    for assumed in ([], ["ASSUME moving ENDS WITHIN 2 s;"]):
        for text in TIMED:
            write(folder, "p.prop", [*assumed, f"PROPERTY P: {text};"])
            used.append(once(folder, [seqc, "verify", name, "--property", "p.prop"]))
    print(f"{name:26}{max(u[0] for u in used):8.0f} ms at the most, {max(u[1] for u in used) / 1024:.0f} MiB")


def main():
    seqc, bench_seqc, *programs = sys.argv[1:]
    print(f"{'program':26}{'driver':>8}{'any':>8}{'spin+cc':>9}{'pan':>9}{'whole/any':>9}{'pan/any':>9}")
    with tempfile.TemporaryDirectory() as folder:
        full = os.path.join(folder, "full.seq")
        with open(full, "w", encoding="utf-8") as file:
            subprocess.run([bench_seqc, "--print"], stdout=file, check=True)
        write(folder, "p.prop", [f"PROPERTY P{i}: {text};" for i, text in enumerate(PROPERTIES)])
        for program in [*programs, full]:
            compare(seqc, folder, os.path.abspath(program))
        subprocess.run([seqc, "build", full, "--no-symbols", "--quiet", "-o", "full.bin"], cwd=folder, check=True, stderr=subprocess.DEVNULL)
        with open(os.path.join(folder, "dense.bin"), "wb") as file:
            file.write(dense_table(random.Random(3)))
        print("with times, a property at a time:")
        with_times(seqc, folder, "full.bin")
        with_times(seqc, folder, "dense.bin")


if __name__ == "__main__":
    main()
