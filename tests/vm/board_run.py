"""What all tests on the board begin with: programs built for it, a folder that both share."""

import os
import shutil
import subprocess
import sys
import tempfile
import time

import board

ROOT = os.path.join(board.HERE, "..", "..")


class Phases:
    """Prints the time of each part."""

    def __init__(self):
        self.start = time.monotonic()

    def say(self, words):
        print(f"vm: {words} (after {time.monotonic() - self.start:.0f} s)", flush=True)


def compile_for_board(preset, *sysroot, targets=()):
    """`targets` instead of the preset's. Raises CannotBeHad without the libraries for them."""
    if subprocess.run([os.path.join(ROOT, "tools", "sysroot"), *sysroot, "arm64"], check=False).returncode != 0:
        raise board.CannotBeHad
    compiling = ["cmake", "--build", "--preset", preset, "--parallel", str(os.cpu_count())]
    if targets:
        compiling += ["--target", *targets]
    for step in (["cmake", "--preset", preset], compiling):
        done = subprocess.run(step, cwd=ROOT, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"{done.stdout}{done.stderr}\nvm: {' '.join(step)} failed")


def build(share, preset, programs, *sysroot, targets=()):
    """The programs, by their names in the share; they are compiled unless build_programs.py has just done it."""
    if not board.IS_BUILT:
        compile_for_board(preset, *sysroot, targets=targets)
    for name, program in programs.items():
        path = os.path.join(ROOT, "build", preset, "bin", program)
        if not os.path.exists(path):
            raise board.CannotBeHad
        shutil.copy(path, os.path.join(share, name))


def in_share(run, *arguments):
    """run(phases, share, *arguments): its answer, 0 for None, or 77 if the board is not to be had."""
    with tempfile.TemporaryDirectory(prefix="share") as share:
        try:
            return run(Phases(), share, *arguments) or 0
        except board.CannotBeHad:
            print("vm: skipped, for packages cannot be downloaded (see above)")
            return 77
