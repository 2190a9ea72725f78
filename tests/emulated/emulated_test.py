#!/usr/bin/env python3
"""The unit tests of the firmware on another processor, under qemu-user.

usage: emulated_test.py arm64|armhf

Fetches and builds what is missing. 77: the libraries, the compiler or the emulator are not to be had; the reason is printed.
"""

import glob
import os
import re
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
# Preset, compiler and emulator by Debian's name of the architecture.
ARCHITECTURES = {
    "arm64": ("board", "aarch64-linux-gnu-g++", "qemu-aarch64-static"),
    "armhf": ("board-armhf", "arm-linux-gnueabihf-g++", "qemu-arm-static"),
}
# qemu-user 7.2 does not support TCSETS2, by which any speed of a serial port is set. The virtual board has real ports.
NOT_EMULATED = {"hal_linux": "Uart.*"}
LONGEST = 600


def build(architecture, preset):
    """Whether there are libraries; the test programs are up to date then."""
    if subprocess.run([os.path.join(ROOT, "tools", "sysroot"), architecture], check=False).returncode != 0:
        return False
    compiling = ["cmake", "--build", "--preset", preset, "--parallel", "2", "--target", "unit_tests"]
    for step in (["cmake", "--preset", preset], compiling):
        done = subprocess.run(step, cwd=ROOT, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"{done.stdout}{done.stderr}\n{' '.join(step)} failed")
    return True


def run(emulator, program):
    name = os.path.basename(program).removeprefix("test_")
    left_out = NOT_EMULATED.get(name, "")
    start = time.monotonic()
    done = subprocess.run([emulator, program, "--gtest_brief=1", "--gtest_filter=-" + left_out], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, timeout=LONGEST, check=False)
    text = done.stdout.decode(errors="replace")
    match = re.search(r"\[==========\] (\d+) tests? from", text)
    count = int(match.group(1)) if match else 0
    print(f"{name}: {count} tests, {time.monotonic() - start:.1f} s{', without ' + left_out if left_out else ''}", flush=True)
    if done.returncode != 0 or count == 0:
        print(f"{text}\n{name}: FAILED with {done.returncode}", flush=True)
        return None
    return count


def main():
    architecture = sys.argv[1]
    preset, *programs = ARCHITECTURES[architecture]
    missing = [program for program in programs if shutil.which(program) is None]
    if missing:
        print(f"skipped: there is no {' and no '.join(missing)}; tools/setup installs them")
        return 77
    start = time.monotonic()
    if not build(architecture, preset):
        print(f"skipped: libraries for {architecture} cannot be downloaded (see above)")
        return 77
    print(f"built after {time.monotonic() - start:.0f} s", flush=True)
    tests = sorted(glob.glob(os.path.join(ROOT, "build", preset, "tests", "test_*")))
    with ThreadPoolExecutor(2) as pool:
        counts = list(pool.map(lambda test: run(programs[1], test), tests))
    print(f"{architecture}: {sum(filter(None, counts))} tests of {len(tests)} programs, {time.monotonic() - start:.0f} s")
    return 1 if None in counts or not tests else 0


if __name__ == "__main__":
    sys.exit(main())
