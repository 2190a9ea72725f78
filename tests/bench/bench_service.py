#!/usr/bin/env python3
"""What the service nanoplc costs while nothing happens: its share of a processor with the motor's status stream at 19200 baud
and without any, and its memory. See --help."""

import argparse
import os
import subprocess
import sys
import tempfile
import time

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "e2e"))
import simulator  # noqa: E402  pylint: disable=wrong-import-position
from commissioned import commission  # noqa: E402  pylint: disable=wrong-import-position

PROGRAM = """
PROGRAM Waits
MOTOR MAC140;
VAR_INPUT Start AT %IX0.0 : BOOL; END_VAR
POWER_UP NEXT := Waits; END_POWER_UP
STEP Waits: OWN ERROR; IF Start OR ERROR THEN EVERY_SCAN RESET_ERROR; END_IF END_STEP
END_PROGRAM
"""
CONFIG = """
[service]
state_directory = "{folder}/state"
[[axis]]
name = "x"
table = "{folder}/waits.bin"
[axis.motor]
port = "{motor}"
[axis.user]
port = "unix:{folder}/x"
"""
WANTED = 1.0  # per cent of a processor, with the stream


def used(process):
    """Seconds on a processor, all threads."""
    total = 0
    for task in os.listdir(f"/proc/{process.pid}/task"):
        with open(f"/proc/{process.pid}/task/{task}/schedstat", encoding="ascii") as file:
            total += int(file.read().split()[0])
    return total / 1e9


def memory(process):
    with open(f"/proc/{process.pid}/status", encoding="ascii") as file:
        fields = dict(line.split(":", 1) for line in file)
    return {name: int(fields[name].split()[0]) for name in ("VmRSS", "RssAnon", "VmHWM")}


def measure(options, folder, motor, wait_for):
    with open(f"{folder}/nanoplc.toml", "w", encoding="utf-8") as file:
        file.write(CONFIG.format(folder=folder, motor=motor))
    commission(f"{folder}/state", "x")
    with subprocess.Popen([options.nanoplc, "--config", f"{folder}/nanoplc.toml"], stderr=subprocess.PIPE, text=True) as service:
        while wait_for not in service.stderr.readline():
            assert service.poll() is None, "nanoplc has ended"
        time.sleep(1)
        begun, before = time.monotonic(), used(service)
        time.sleep(options.seconds)
        share = (used(service) - before) / (time.monotonic() - begun) * 100
        kept = memory(service)
        service.terminate()
        service.stderr.read()
    return share, kept


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for program in ("nanoplc", "macsim", "seqc"):
        parser.add_argument(program)
    parser.add_argument("--seconds", type=float, default=20, help="of each measurement (default: %(default)s)")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        with open(f"{folder}/waits.seq", "w", encoding="utf-8") as file:
            file.write(PROGRAM)
        subprocess.run([options.seqc, "build", f"{folder}/waits.seq", "-o", f"{folder}/waits.bin"], check=True,
                       stdout=subprocess.DEVNULL)
        motor, _ = simulator.start(options.macsim, "--model", "MAC140", "--fastmac", f"pty:{folder}/motor")
        streaming, kept = measure(options, folder, f"{folder}/motor", "the sequence runs")
        motor.terminate()
        motor.communicate()
        master, slave = os.openpty()
        silent, _ = measure(options, folder, os.ttyname(slave), "started with")
        os.close(master)
        os.close(slave)
    print(f"with the status stream: {streaming:.2f} % of a processor, wanted below {WANTED} %")
    print(f"without a stream:       {silent:.2f} %")
    print(f"memory: {kept['VmRSS']} kB resident, {kept['RssAnon']} kB of it its own")
    return 0 if streaming < WANTED else 1


if __name__ == "__main__":
    sys.exit(main())
