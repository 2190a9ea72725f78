#!/usr/bin/env python3
"""nanoplc with MIDI drives on the virtual board: pick and place with a virtual MAC34 on a real CAN bus, which is taken down and
whose module is killed on the way; at the same time a second axis on a V24 line.

usage: nanoplc_midi_test.py MIDISIM NANOCTL SEQC EXAMPLES MENDING.seq

Fetches and builds what is missing. 77: the virtual board is not to be had; the reason is printed.
"""

import os
import re
import socket
import subprocess
import sys
import threading
import time

import board
import nanoplc_test
from board_run import build, in_share
from nanoplc_test import commission, simulator

# The module on the bus shares the board's processor: no real-time priority, or it would starve.
CONFIG = """
[service]
state_directory = "/tmp/state"
lock_memory = true
[[axis]]
name = "x"
table = "/share/pick.bin"
[axis.motor]
kind = "mac34-1"
can = "can0"
address = 5
bitrate = 125000
[axis.user]
port = "/dev/ttyS1"
[axis.inputs]
IN0 = "IN_START"
IN1 = "gpiochip0:1"
IN2 = "/dev/gpiochip0:2"
[axis.outputs]
OUT0 = "OUT_GRIP"
OUT3 = {line = "gpiochip0:5"}
[[axis]]
name = "y"
table = "/share/mending.bin"
[axis.motor]
kind = "mac34-2"
port = "/dev/ttyS0"
"""
# The files `down`, `up`, `kill`, `start`, `second`, `alone` and `term` are requests; a line says that one was carried out.
SCRIPT = """
for one in can0 can1; do
    /usr/bin/ip link set $one type can bitrate 125000 && /usr/bin/ip link set $one up || exit 1
done
./midisim --model MAC34-1 --address 5 --can can1 --eeprom eeprom >sim.log 2>&1 &
module=$!
cp -r state /tmp/state
./nanoplc --config nanoplc.toml 2>&1 &
service=$!
while kill -0 $service 2>/dev/null; do
    if [ -e down ]; then rm down; /usr/bin/ip link set can0 down; fi
    if [ -e up ]; then rm up; /usr/bin/ip link set can0 up; fi
    if [ -e kill ]; then rm kill; kill -9 $module; fi
    if [ -e start ]; then rm start; ./midisim --model MAC34-1 --address 5 --can can1 --eeprom eeprom >sim.log 2>&1 & module=$!; fi
    if [ -e second ]; then rm second; ./midisim --model MAC34-1 --address 5 --can can1 >sim2.log 2>&1 & second=$!; fi
    if [ -e alone ]; then rm alone; kill -9 $second; fi
    if [ -e term ]; then rm term; kill -TERM $service; fi
    sleep 0.05
done
wait $service
echo "ended with $?"
"""
# The board's time counts instructions, 2 ns each: the module that shares its processor answers in time whatever else this
# machine does.
CLOCK = ["-icount", "shift=1"]
# 60 mm are 12 revolutions of 10000 increments; mending.seq goes half a revolution.
PLACE = 120000
AWAY = 5000


def position(eeprom):
    """As the module keeps it without power; written when a motion ends."""
    try:
        with open(eeprom, encoding="utf-8") as file:
            found = re.search(r"(?m)^position = (-?\d+)$", file.read())
    except OSError:
        return None
    return int(found[1]) if found else None


class Machine(nanoplc_test.Machine):
    def at(self, increments, tolerance=20):
        where = position(os.path.join(self.share, "eeprom"))
        return where is not None and abs(where - increments) <= tolerance

    def carries(self):
        """A part that surely came to its place."""
        while True:
            self.grips()
            before = time.monotonic()
            came = False
            while self.outputs() != (0, 1) and time.monotonic() - before < 10:
                came = came or self.at(PLACE)
                time.sleep(0.01)
            if came and self.outputs() == (0, 1):
                self.until("the way back", lambda: self.at(0))
                return

    def loses(self, request, said):
        """The link, with a part in the gripper."""
        self.grips()
        self.signal(request)
        self.until(f"safe outputs after {request}", lambda: self.outputs() == (0, 0))
        self.vm.wait(said)

    def stays_in_fault(self):
        """ERROR is there until it is acknowledged."""
        time.sleep(0.5)
        assert self.outputs() == (0, 0), self.outputs()


def play(machine, v24_eeprom):
    machine.vm.wait("x: runs /share/pick.bin")
    machine.vm.wait("x: the motor answers on address 5 on can0")
    machine.carries()
    print("vm: one part is carried over CAN", flush=True)
    machine.loses("down", "x: can0 is down; as root: ip link set can0 up")
    machine.signal("up")
    machine.vm.wait("x: can0 takes part in the bus")
    machine.stays_in_fault()
    machine.carries()
    print("vm: the interface was taken down and came back", flush=True)
    machine.loses("kill", "x: SAFE: the motor does not answer")
    machine.signal("start")
    machine.vm.wait("x: the motor answers on address 5 on can0")
    machine.stays_in_fault()
    machine.carries()
    print("vm: the module was killed and came back", flush=True)
    machine.loses("second", "x: ERROR: more than one MIDI drive answers to this address")
    machine.stays_in_fault()
    machine.signal("alone")
    machine.vm.wait("x: the motor answers on address 5 on can0")
    machine.carries()
    print("vm: a second module came to the address and left it", flush=True)
    machine.until("the drive on V24 away", lambda: position(v24_eeprom) == AWAY)
    machine.until("the drive on V24 back", lambda: position(v24_eeprom) == 0)
    machine.signal("term")
    machine.vm.wait("ended with 0")


def run(phases, share, midisim, nanoctl, seqc, examples, mending):
    board.prepare()
    phases.say("building nanoplc and midisim for the board")
    build(share, "board", {"nanoplc": "nanoplc", "midisim": "midisim"}, targets=["nanoplc", "midisim"])
    for name, source in (("pick", os.path.join(examples, "midi_pick_and_place.seq")), ("mending", mending)):
        subprocess.run([seqc, "build", source, "--quiet", "-o", os.path.join(share, name + ".bin")], check=True)
    with open(os.path.join(share, "nanoplc.toml"), "w", encoding="utf-8") as file:
        file.write(CONFIG)
    for axis in ("x", "y"):
        commission(os.path.join(share, "state"), axis)
    endpoint = os.path.join(share, "motor")
    v24_eeprom = os.path.join(share, "v24_eeprom")
    module, _ = simulator.start(midisim, "--model", "MAC34-2", "--v24", "unix:" + endpoint, "--eeprom", v24_eeprom)
    phases.say("starting the board")
    listener = socket.socket(socket.AF_UNIX)
    listener.bind(os.path.join(share, "user"))
    listener.listen()
    try:
        with board.Board(share, SCRIPT, serials=["motor", "user"], more=CLOCK) as vm:
            outside = socket.socket(socket.AF_UNIX)
            outside.connect(endpoint)
            nanoplc_test.join(vm.serials["motor"], outside)
            threading.Thread(target=nanoplc_test.serve_user, args=(listener, vm.serials["user"]), daemon=True).start()
            machine = Machine(vm, vm, nanoplc_test.OWN, share, nanoctl, "unix:" + os.path.join(share, "user"), phases)
            play(machine, v24_eeprom)
            phases.say(f"done, {machine.faults} faults acknowledged")
    finally:
        module.terminate()
        module.wait()
        module.stdout.close()
        module.stderr.close()
        listener.close()


if __name__ == "__main__":
    sys.exit(in_share(run, *sys.argv[1:6]))
