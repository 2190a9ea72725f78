#!/usr/bin/env python3
"""Runs parts of the full test run one after another, each with the builds that it needs, and prints a table at the end.

usage: parts.py [--long] [--rerun-failed] [PART...] [CTEST-ARGUMENT...]
       parts.py --gate [CTEST-ARGUMENT...]

Each part leaves its log and JUnit XML as build/test/PART.log and PART.xml. Its exit code is 0 if nothing failed, else 1.
  --rerun-failed   of each part only what failed when it ran last
  --long           the part `long` too, which takes hours
"""

import os
import re
import subprocess
import sys
import time
import xml.etree.ElementTree

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
RESULTS = os.path.join(ROOT, "build", "test")
# Part: the builds beside release, and where CTest looks.
PARTS = {
    "gate": ((), "release"),
    "thorough": ((), "release"),
    "realtime": ((), "release"),
    "terminals": ((), "release"),
    "sanitizers": (("dev",), "dev"),
    "sanitized-realtime": (("dev",), "dev"),
    "tidy": ((), "release"),
    "fuzz": (("fuzz",), "release"),
    "mcu": (("mcu", "mcu-microbit", "mcu-modbus", "mcu-set-points", "mcu-update", "mcu-update-lm3s6965"), "release"),
    "board": ((), "release"),
    "emulated": ((), "release"),
    "packages": ((), "release"),
    "browser": ((), "release"),
    "plant": ((), "release"),
}
LABELS = {"sanitizers": "gate|thorough", "sanitized-realtime": "realtime|terminals"}
ONE_AT_A_TIME = {"realtime", "terminals", "sanitized-realtime", "browser", "plant"}
ONCE_MORE = ONE_AT_A_TIME | {"mcu", "board", "emulated", "packages"}  # a machine that is emulated in real time beside others
TOO_LONG = 900  # seconds of the gate's tests: a warning
SLOWEST = 10


class Result:
    def __init__(self, part):
        self.part = part
        self.seconds = 0
        self.passed = 0
        self.again = []  # what passed only when it was run once more
        self.failed = []
        self.skipped = []
        self.broken = ""


def build(preset, log):
    """0, or what it ended with. Without a log it is seen at once."""
    for command in (["cmake", "--preset", preset], ["cmake", "--build", "--preset", preset, "--parallel", str(os.cpu_count())]):
        done = subprocess.run(command, cwd=ROOT, stdout=log, stderr=log and subprocess.STDOUT, stdin=subprocess.DEVNULL, check=False)
        if done.returncode:
            return done.returncode
    return 0


def cases(path):
    """Name, status, seconds and the last line of its output, for each test in a JUnit file."""
    if not os.path.exists(path):
        return
    for case in xml.etree.ElementTree.parse(path).getroot().iter("testcase"):
        output = (case.findtext("system-out") or "").strip().split("\n")[-1]
        yield case.get("name"), case.get("status"), float(case.get("time")), output


def named(names):
    return "^(" + "|".join(re.escape(name) for name in names) + ")$"


def ctest(part, xml_path, log, *arguments):
    where = PARTS[part][1]
    parallel = [] if part in ONE_AT_A_TIME else ["--parallel", str(os.cpu_count())]
    label = "^(" + LABELS.get(part, part) + ")$"
    command = ["ctest", "--test-dir", os.path.join(ROOT, "build", where), "--output-on-failure", "--no-tests=error",
               "--output-junit", xml_path, "-L", label, *parallel, *arguments]
    print("+", *command, file=log, flush=True)
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", cwd=ROOT,
                          stdin=subprocess.DEVNULL) as process:
        for line in process.stdout:
            log.write(line)
            if part == "gate" or "***" in line or re.search(r"^\d+% tests passed", line):
                print(line, end="", flush=True)
    log.flush()
    return process.returncode


def run(part, only_failed, arguments):
    result = Result(part)
    log_path, xml_path = (os.path.join(RESULTS, f"{part}.{kind}") for kind in ("log", "xml"))
    selection = list(arguments)
    if only_failed:
        names = [name for name, status, _, _ in cases(xml_path) if status == "fail"]
        if not names:
            return None
        selection += ["-R", named(names)]
    if os.path.exists(xml_path):
        os.remove(xml_path)
    start = time.monotonic()
    with open(log_path, "w", encoding="utf-8") as log:
        for preset in ("release", *PARTS[part][0]):
            print(f"== {part}: build {preset}", flush=True)
            if build(preset, None if part == "gate" else log):
                result.broken = f"build of {preset} failed"
                with open(log_path, encoding="utf-8", errors="replace") as text:
                    print("".join(text.readlines()[-40:]), end="", flush=True)
                return result
        built = time.monotonic()
        print(f"== {part}: test (builds took {built - start:.0f} s)", flush=True)
        code = ctest(part, xml_path, log, *selection)
        found = list(cases(xml_path))
        failed = [name for name, status, _, _ in found if status == "fail"]
        if failed and part in ONCE_MORE:
            again = xml_path.removesuffix(".xml") + "-again.xml"
            print(f"== {part}: once more: {', '.join(failed)}", flush=True)
            ctest(part, again, log, "-R", named(failed), "--parallel", "1")
            result.again = [name for name, status, _, _ in cases(again) if status == "run"]
        result.failed = [name for name in failed if name not in result.again]
    result.seconds = time.monotonic() - built
    result.passed = sum(status == "run" for _, status, _, _ in found) + len(result.again)
    result.skipped = [(name, output) for name, status, _, output in found if status in ("notrun", "disabled")]
    if code and not failed:
        result.broken = f"ctest ended with {code}: {os.path.relpath(log_path, ROOT)}"
    if part == "gate":
        report_times(found, result)
    return result


def report_times(found, result):
    print(f"\nThe {SLOWEST} slowest:")
    for name, _, seconds, _ in sorted(found, key=lambda case: -case[2])[:SLOWEST]:
        print(f"  {seconds:7.1f} s  {name}")
    if result.seconds > TOO_LONG:
        print(f"warning: the gate's tests took {result.seconds:.0f} s; it is to be short: {TOO_LONG} s at the most")


def table(results):
    print(f"\n{'part':20}{'seconds':>9}{'passed':>8}{'failed':>8}{'again':>7}{'skipped':>9}")
    for one in results:
        print(f"{one.part:20}{one.seconds:9.0f}{one.passed:8}{len(one.failed):8}{len(one.again):7}{len(one.skipped):9}")
    for one in results:
        if one.broken:
            print(f"{one.part}: {one.broken}")
        for name in one.failed:
            print(f"{one.part}: {name} failed: build/test/{one.part}.log")
        for name in one.again:
            print(f"{one.part}: {name} failed, and passed when it was run once more")
        for name, why in one.skipped:
            print(f"{one.part}: {name} skipped: {why}")
    passed, failed, skipped = (sum(counts) for counts in zip(*((r.passed, len(r.failed) + bool(r.broken), len(r.skipped)) for r in results)))
    print(f"\n{passed} passed, {failed} failed, {skipped} skipped")
    return failed


def main():
    arguments = sys.argv[1:]
    os.makedirs(RESULTS, exist_ok=True)
    if arguments[:1] == ["--gate"]:
        sys.exit(1 if table([run("gate", False, arguments[1:])]) else 0)
    only_failed = long = False
    parts = []
    while arguments and (arguments[0] in ("--rerun-failed", "--long") or not arguments[0].startswith("-")):
        argument = arguments.pop(0)
        only_failed = only_failed or argument == "--rerun-failed"
        long = long or argument == "--long"
        if not argument.startswith("--"):
            parts.append(argument)
    if long:
        PARTS["long"] = ((), "release")
    for part in parts:
        if part not in PARTS:
            sys.exit(f"{part}: no part of the full run. Parts: {' '.join(PARTS)}")
    results = [one for one in (run(part, only_failed, arguments) for part in parts or PARTS) if one]
    if not results:
        print("nothing failed when these parts ran last")
        return
    sys.exit(1 if table(results) else 0)


if __name__ == "__main__":
    main()
