#!/usr/bin/env python3
"""How long an editor waits: from a keystroke to the diagnostics of a full program, and for completion.

usage: speed.py SEQC [KEYSTROKES]

Types in the middle of a program of 61 steps with 992 terms and prints median and 95th percentile in
milliseconds, and the server's memory. Not a test: nothing is asserted.
"""

import os
import sys
import time

from client import Client


def full_program():
    """61 steps, 16 branches each with another condition and target."""
    lines = ["PROGRAM Full", "MOTOR MAC140;"]
    for step in range(61):
        lines += [f"STEP S{step}:", "    OWN ERROR;"]
        for branch in range(16):
            test = " AND ".join(f"{'NOT ' if branch >> bit & 1 == 0 else ''}IN{bit}" for bit in range(4))
            word = "IF" if branch == 0 else "ELSIF"
            lines.append(f"    {word} {test} THEN TIMER := T#{100 + branch}ms; NEXT := S{(step + branch + 1) % 61};")
        lines += ["    END_IF", "END_STEP"]
    return "\n".join([*lines, "END_PROGRAM", ""])


def figures(name, times):
    times.sort()
    print(f"{name}: median {times[len(times) // 2]:.1f} ms, p95 {times[len(times) * 95 // 100]:.1f} ms of {len(times)}")


def main():
    strokes = int(sys.argv[2]) if len(sys.argv) > 2 else 200
    text = full_program()
    client = Client(sys.argv[1])
    uri = "file:///full.seq"
    client.open(uri, text)
    assert client.diagnostics(uri, 1) == []
    line = text.split("\n").index("STEP S30:") + 4
    typed = "NEXT := S12; "
    diagnostics, completions = [], []
    version, column = 1, 0
    for stroke in range(strokes):
        version += 1
        place = {"line": line, "character": column}
        removes = column == len(typed)
        change = {"range": {"start": {"line": line, "character": 0} if removes else place, "end": place}, "text": "" if removes else typed[column]}
        column = 0 if removes else column + 1
        begun = time.perf_counter()
        client.change(uri, version, [change])
        client.diagnostics(uri, version)
        diagnostics.append((time.perf_counter() - begun) * 1000)
        begun = time.perf_counter()
        client.at("textDocument/completion", uri, {"line": line, "character": column})
        completions.append((time.perf_counter() - begun) * 1000)
    figures("keystroke to diagnostics", diagnostics)
    figures("completion", completions)
    with open(f"/proc/{client.process.pid}/stat", encoding="utf-8") as stat:
        ticks = sum(int(field) for field in stat.read().rsplit(")", 1)[1].split()[11:13])
    print(f"processor time of both together: {ticks * 1000 / os.sysconf('SC_CLK_TCK') / strokes:.1f} ms a keystroke")
    with open(f"/proc/{client.process.pid}/status", encoding="utf-8") as status:
        print(next(row for row in status if row.startswith("VmHWM")).strip())
    client.end()


if __name__ == "__main__":
    main()
