#!/usr/bin/env python3
"""nanoplc on the virtual board: pick and place on real GPIO lines and a real serial port, the motor outside of it.

usage: nanoplc_test.py MACSIM NANOCTL SEQC PICK_AND_PLACE.seq

Fetches and builds what is missing. 77: the virtual board is not to be had; the reason is printed.
"""

import json
import os
import socket
import subprocess
import sys
import tempfile
import threading
import time

import board
from board_test import Phases, build

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.append(os.path.join(HERE, "..", "e2e"))
import simulator  # noqa: E402  pylint: disable=wrong-import-position

# Lines of the chip, by the names of the program.
START, ACK = 0, 2
GRIP, LAMP = 4, 5
CONFIG = """
[service]
state_directory = "/tmp/state"
real_time_priority = 50
lock_memory = true
[[axis]]
name = "x"
table = "/share/pick.bin"
[axis.motor]
port = "/dev/ttyS0"
[axis.user]
port = "/dev/ttyS1"
[axis.inputs]
IN0 = "IN_START"
IN1 = "gpiochip0:1"
IN2 = "/dev/gpiochip0:2"
[axis.outputs]
OUT0 = "OUT_GRIP"
OUT3 = {line = "gpiochip0:5"}
[axis.settings]
motor_silence = 200
"""
# Starts it again whatever ends it, until the file `stop` is there; the files `kill` and `term` are signals.
SCRIPT = """
while [ ! -e stop ]; do
    ./nanoplc --config nanoplc.toml 2>&1 &
    pid=$!
    while kill -0 $pid 2>/dev/null; do
        if [ -e kill ]; then kill -9 $pid; rm kill; fi
        if [ -e term ]; then kill -TERM $pid; rm term; fi
        sleep 0.1
    done
    wait $pid
    echo "ended with $?"
done
"""
# The board is emulated, and whoever emulates it busy: a lost link is a fault that the operator acknowledges.
MOST_FAULTS = 40


def join(one, other):
    def carry(source, target):
        try:
            while data := source.recv(4096):
                target.sendall(data)
        except OSError:
            pass

    for pair in ((one, other), (other, one)):
        threading.Thread(target=carry, args=pair, daemon=True).start()


class Machine:
    """The board in the hands of an operator."""

    def __init__(self, vm, share, nanoctl, port):
        self.vm, self.share, self.nanoctl, self.port = vm, share, nanoctl, port
        self.faults = 0

    def until(self, what, condition):
        end = time.monotonic() + board.LONGEST
        while not condition():
            assert time.monotonic() < end, f"never came: {what}"
            time.sleep(0.02)

    def signal(self, name):
        with open(os.path.join(self.share, name), "w", encoding="utf-8"):
            pass

    def outputs(self):
        return self.vm.output(GRIP), self.vm.output(LAMP)

    def status(self):
        done = subprocess.run([self.nanoctl, "--port", self.port, "--patience", "2000", "--json", "status"], capture_output=True,
                              text=True, timeout=board.LONGEST, check=False)
        return json.loads(done.stdout.splitlines()[-1])

    def acknowledge(self):
        self.faults += 1
        assert self.faults < MOST_FAULTS, "the link to the motor never holds"
        self.vm.set_input(ACK, 1)
        time.sleep(0.2)
        self.vm.set_input(ACK, 0)
        time.sleep(0.2)

    def idle(self):
        while self.outputs() != (0, 1):
            self.acknowledge()

    def grips(self):
        """Start is pressed until the gripper holds a part, on its way."""
        while True:
            self.idle()
            self.vm.set_input(START, 1)
            time.sleep(0.1)
            self.vm.set_input(START, 0)
            if self.outputs() == (1, 0):
                return

    def cycle(self):
        """One part from place to place, without a fault."""
        while True:
            self.grips()
            before = time.monotonic()
            while self.outputs() == (1, 0):
                time.sleep(0.005)
            while self.outputs() == (0, 0) and time.monotonic() - before < 3:
                time.sleep(0.02)
            if self.outputs() == (0, 1):
                return


def play(machine):
    machine.vm.wait("x: runs /share/pick.bin")
    machine.vm.wait("the motor answers on /dev/ttyS0")
    machine.cycle()
    print("vm: one part is carried", flush=True)
    machine.grips()
    machine.signal("kill")
    machine.vm.wait("ended with 137")
    machine.vm.wait("x: SAFE: the last run did not end in order")
    machine.until("safe outputs after the kill", lambda: machine.outputs() == (0, 0))
    status = machine.status()
    assert (status["state"], status["safe_reason"]) == ("stopped", "watchdog"), status
    print("vm: killed in mid-sequence: outputs are safe, it waits", flush=True)
    started = subprocess.run([machine.nanoctl, "--port", machine.port, "--patience", "2000", "run"], timeout=board.LONGEST,
                             check=False)
    assert started.returncode == 0
    machine.cycle()
    machine.grips()
    machine.signal("stop")
    machine.signal("term")
    assert machine.vm.finish() == 0
    machine.vm.wait("ended with 0")


def run(phases, share, macsim, nanoctl, seqc, source):
    board.prepare()
    phases.say("building nanoplc for the board")
    build(share, "board", {"nanoplc": "nanoplc"})
    subprocess.run([seqc, "build", source, "-o", os.path.join(share, "pick.bin")], check=True)
    with open(os.path.join(share, "nanoplc.toml"), "w", encoding="utf-8") as file:
        file.write(CONFIG)
    endpoint = os.path.join(share, "motor")
    motor, _ = simulator.start(macsim, "--model", "MAC140", "--fastmac", "unix:" + endpoint)
    phases.say("starting the board")
    listener = socket.socket(socket.AF_UNIX)
    listener.bind(os.path.join(share, "user"))
    listener.listen()
    try:
        with board.Board(share, SCRIPT, serials=["motor", "user"]) as vm:
            outside = socket.socket(socket.AF_UNIX)
            outside.connect(endpoint)
            join(vm.serials["motor"], outside)
            threading.Thread(target=serve_user, args=(listener, vm.serials["user"]), daemon=True).start()
            machine = Machine(vm, share, nanoctl, "unix:" + os.path.join(share, "user"))
            play(machine)
            phases.say(f"done, {machine.faults} faults acknowledged")
    finally:
        motor.terminate()
        motor.wait()
        motor.stdout.close()
        motor.stderr.close()
        listener.close()


def serve_user(listener, line):
    """One client after the other; what comes while there is none is lost."""
    current = []

    def listen():
        while data := line.recv(4096):
            for client in current:
                try:
                    client.sendall(data)
                except OSError:
                    pass

    threading.Thread(target=listen, daemon=True).start()
    while True:
        try:
            client, _ = listener.accept()
        except OSError:
            return
        current[:] = [client]
        while data := client.recv(4096):
            line.sendall(data)
        current.clear()


def main():
    phases = Phases()
    with tempfile.TemporaryDirectory(prefix="share") as share:
        try:
            run(phases, share, *sys.argv[1:5])
        except board.CannotBeHad:
            print("vm: skipped, for packages cannot be downloaded (see above)")
            return 77
    return 0


if __name__ == "__main__":
    sys.exit(main())
