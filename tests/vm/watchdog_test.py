#!/usr/bin/env python3
"""How nanoplc starts on the virtual board after a power cut in a run, and after its watchdog has reset the board.

usage: watchdog_test.py NANOCTL

Fetches and builds what is missing. 77: the virtual board is not to be had; the reason is printed.
"""

import json
import os
import socket
import subprocess
import sys
import threading
import time

import board
from board_run import build, in_share
from nanoplc_test import commission, serve_user

# No motor answers: a sequence that has started by itself waits for it. The driver of the virtual board's watchdog (i6300esb) reports its
# resets but does not report this capability: without after_power_cut the sequence would wait after the power cut, too.
CONFIG = """
[service]
state_directory = "/disk/state"
watchdog_device = "/dev/watchdog"
watchdog_seconds = 5
after_power_cut = "start"
[[axis]]
name = "x"
table = "/share/table.bin"
[axis.motor]
port = "/dev/ttyS0"
[axis.user]
port = "/dev/ttyS1"
"""
# The files `freeze` and `again` are requests: that the program hangs, and that it ends in order and starts again.
SCRIPT = """
modprobe -a virtio_blk crc32c_generic ext4 || exit 1
mkdir /disk
mount -t ext4 /dev/vda /disk || exit 1
[ -e /disk/state ] || { cp -r state /disk/state; sync; }
./nanoplc --config nanoplc.toml 2>&1 &
while true; do
    if [ -e freeze ]; then rm freeze; sync; kill -STOP $!; fi
    if [ -e again ]; then
        rm again
        kill -TERM $!
        wait $!
        ./nanoplc --config nanoplc.toml 2>&1 &
    fi
    sleep 0.1
done
"""
# One term and the end term (001 section 6.1.5).
TABLE = bytes([0xC0, 1, 1, 1, 0x80, 5, 0, 0, 0x3F, 0, 0, 0, 0, 0, 0, 0])


class Power:
    """One time that the board has power, maybe several boots."""

    def __init__(self, share, nanoctl, number):
        self.share, self.nanoctl = share, nanoctl
        self.port = os.path.join(share, f"user{number}")
        self.listener = socket.socket(socket.AF_UNIX)
        self.listener.bind(self.port)
        self.listener.listen()
        disk = ["-drive", f"if=none,id=disk,format=raw,file={share}/image", "-device", "virtio-blk-pci,drive=disk"]
        self.vm = board.Board(share, SCRIPT, serials=["motor", "user"], reboots=True, more=disk)

    def __enter__(self):
        self.vm.__enter__()
        threading.Thread(target=serve_user, args=(self.listener, self.vm.serials["user"]), daemon=True).start()
        return self

    def __exit__(self, *cause):
        """As a power cut."""
        self.vm.__exit__(*cause)
        self.listener.close()

    def request(self, name):
        with open(os.path.join(self.share, name), "w", encoding="utf-8"):
            pass

    def starts(self, times):
        end = time.monotonic() + board.LONGEST
        while sum("started with 1 axis" in line for line in list(self.vm.printed)) < times:
            assert time.monotonic() < end, f"never came: start {times}"
            time.sleep(0.1)

    def expect(self, state, reason):
        done = subprocess.run([self.nanoctl, "--port", "unix:" + self.port, "--patience", board.PATIENCE, "--json", "status"],
                              capture_output=True, text=True, timeout=board.LONGEST, check=False)
        assert done.returncode == 0, done
        status = json.loads(done.stdout)
        assert (status["state"], status["safe_reason"]) == (state, reason), status


def run(phases, share, nanoctl):
    board.prepare()
    phases.say("building nanoplc for the board")
    build(share, "board", {"nanoplc": "nanoplc"}, targets=["nanoplc"])
    for name, content in (("nanoplc.toml", CONFIG.encode()), ("table.bin", TABLE)):
        with open(os.path.join(share, name), "wb") as file:
            file.write(content)
    commission(os.path.join(share, "state"), "x")
    subprocess.run(["mkfs.ext4", "-q", os.path.join(share, "image"), "16M"], check=True, stdout=subprocess.DEVNULL)
    with Power(share, nanoctl, 1) as power:
        power.starts(1)
        power.expect("waiting for the motor", "not started")
    phases.say("power cut in a run")
    with Power(share, nanoctl, 2) as power:
        power.starts(1)
        power.vm.wait("no watchdog says that it did this: a power cut")
        power.expect("waiting for the motor", "not started")
        phases.say("it has started by itself; now it hangs")
        power.request("freeze")
        power.vm.wait("x: a watchdog has reset the board")
        power.vm.wait("x: SAFE: the last run did not end in order")
        power.starts(2)
        power.expect("stopped", "watchdog")
        phases.say("the watchdog's reset is known as one")
        power.request("again")
        power.starts(3)
        power.expect("stopped", "watchdog")
        phases.say("an orderly end in the same boot changes nothing")


if __name__ == "__main__":
    sys.exit(in_share(run, sys.argv[1]))
