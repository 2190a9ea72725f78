"""On a program that fills a table each check decides what it finds, whatever the others need; each course is played.

usage: full_table_test.py SEQC NANOPLC_SIM BENCH_SEQC
"""

import json
import subprocess
import sys
import tempfile

import programs


def main():
    seqc, nanoplc_sim, bench_seqc = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        case = programs.Programs(seqc, nanoplc_sim, folder)
        text = subprocess.run([bench_seqc, "--print"], capture_output=True, check=True).stdout
        subprocess.run([seqc, "build", case.path("full.seq", text), "--quiet", "-o", case.path("t.bin")], capture_output=True, check=True)
        done = subprocess.run([seqc, "verify", case.path("t.bin"), "--json"], capture_output=True, text=True, check=False)
        document = json.loads(done.stdout)
        undecided = [r["name"] for r in document["results"] if r["verdict"] == "undecided"]
        assert not undecided, undecided
        assert case.replay_all(case.path("t.bin"), document) > 0


main()
