#!/usr/bin/env python3
"""The board loses its power in the midst of an upload, again and again, and always starts with a whole table: the one of
before or the new one.

usage: power_cut_test.py NANOCTL [SEED [CUTS]]

Each cut is a SIGKILL for qemu in a write or a flush of the disk, which loses about half of what had not been
flushed (disk.py). Fetches and builds what is missing. 77: the virtual board is not to be had; the reason is printed.
"""

import os
import random
import socket
import subprocess
import sys
import threading

import board
from board_run import build, in_share
from disk import Disk
from nanoplc_test import serve_user

TERMS = 200
CONFIG = """
[service]
state_directory = "/disk/state"
[[axis]]
name = "x"
[axis.motor]
port = "/dev/ttyS0"
[axis.user]
port = "/dev/ttyS1"
[axis.settings]
user_baud = 115200
autostart = false
"""
SCRIPT = """
modprobe -a virtio_blk crc32c_generic ext4 || exit 1
mkdir /disk
mount -t ext4 /dev/vda /disk || exit 1
./nanoplc --config nanoplc.toml 2>&1
"""


def table(seed):
    """Well-formed terms (001 section 6.1.5) that differ from those of any other seed."""
    terms = [bytes([0xC0 | (i % 60), (i + seed) & 0xFF, seed & 0xFF, 0x3E, 0x80, 0x01, i & 0xFF, seed & 0xFF])
             for i in range(TERMS)]
    return b"".join(terms) + bytes([0x3F, 0, 0, 0, 0, 0, 0, 0])


class Cuts:
    def __init__(self, share, nanoctl, seed):
        self.share, self.nanoctl = share, nanoctl
        self.chance = random.Random(seed)
        self.stored = None
        self.count = {"old": 0, "new": 0, "told": 0}
        image = os.path.join(share, "image")
        subprocess.run(["mkfs.ext4", "-q", image, "16M"], check=True, stdout=subprocess.DEVNULL)
        self.disk = Disk(image, share)

    def ctl(self, port, *arguments):
        return subprocess.run([self.nanoctl, "--port", "unix:" + port, "--baud", "115200", "--patience", "3000", *arguments],
                              capture_output=True, text=True, timeout=board.LONGEST, check=False)

    def path(self, name, content):
        path = os.path.join(self.share, name)
        with open(path, "wb") as file:
            file.write(content)
        return path

    def check(self, port, allowed):
        """What the board has stored is one of those."""
        for name, content in allowed.items():
            if content is None:
                continue
            done = self.ctl(port, "verify", self.path("wanted.bin", content))
            if done.returncode == 0:
                self.stored = content
                return name
        raise AssertionError(f"neither of both tables is there: {done.stdout}{done.stderr}")

    def boot(self, number, allowed, upload, cut_at):
        """Answers which table was found."""
        port = os.path.join(self.share, f"user{number}")
        listener = socket.socket(socket.AF_UNIX)
        listener.bind(port)
        listener.listen()
        with listener, board.Board(self.share, SCRIPT, serials=["motor", "user"], echo=None, more=self.disk.arguments()) as vm:
            threading.Thread(target=serve_user, args=(listener, vm.serials["user"]), daemon=True).start()
            vm.wait("started with 1 axis")
            found = self.check(port, allowed) if allowed else None
            self.count["told"] += any("damaged" in line for line in vm.printed)
            before = self.disk.requests
            if upload is not None:
                if cut_at:
                    self.disk.cut_at(cut_at, vm.process.kill)
                done = self.ctl(port, "upload", "--only-store", self.path("new.bin", upload))
                if not cut_at:
                    assert done.returncode == 0, done.stdout + done.stderr
                    vm.process.kill()
            else:
                vm.process.kill()
            vm.process.wait()
        self.disk.power_off(self.chance)
        return found, self.disk.requests - before


def run(phases, share, nanoctl, seed=1, count=10):
    seed, count = int(seed), int(count)
    board.prepare()
    phases.say("building nanoplc for the board")
    build(share, "board", {"nanoplc": "nanoplc"}, targets=["nanoplc"])
    with open(os.path.join(share, "nanoplc.toml"), "w", encoding="utf-8") as file:
        file.write(CONFIG)
    cuts = Cuts(share, nanoctl, seed)
    old = table(0)
    _, requests = cuts.boot(0, None, old, None)
    phases.say(f"seed {seed}: an upload is {requests} writes and flushes")
    allowed = {"old": old}
    for number in range(1, count + 1):
        new = table(number)
        # Every other one at the end, where the new table takes the old one's place.
        moment = cuts.chance.randint(1 if number % 2 else requests - 3, requests)
        found, _ = cuts.boot(number, allowed, new, moment)
        cuts.count[found] += number > 1
        phases.say(f"found the {found} table; cut {number} in request {moment}")
        allowed = {"old": cuts.stored, "new": new}
    found, _ = cuts.boot(count + 1, allowed, None, None)
    cuts.count[found] += 1
    phases.say(f"{count} cuts: {cuts.count['old']} left the old table, {cuts.count['new']} the new one; a slot was told to be "
               f"damaged {cuts.count['told']} times")


if __name__ == "__main__":
    sys.exit(in_share(run, *sys.argv[1:4]))
