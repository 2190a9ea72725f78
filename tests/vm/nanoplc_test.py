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
import threading
import time

import board
import gpio_sim
from board_run import build, in_share

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.append(os.path.join(HERE, "..", "e2e"))
import simulator  # noqa: E402  pylint: disable=wrong-import-position
from commissioned import commission  # noqa: E402  pylint: disable=wrong-import-position

# Lines of the simulated chip; of the board's own, which has fewer, some have names.
SIMULATED = {f"IN{i}": 4 + i for i in range(6)} | {f"OUT{i}": 27 + i for i in range(4)}
OWN = {"IN0": 0, "IN1": 1, "IN2": 2, "OUT0": 4, "OUT3": 5}
NAMED = {"IN0": "IN_START", "IN1": "gpiochip0:1", "IN2": "/dev/gpiochip0:2", "OUT0": "OUT_GRIP"}
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
[axis.settings]
motor_silence = 200
poll_limit = 1000000
"""
# Starts it again whatever ends it, until the file `stop` is there; the files `kill` and `term` are signals, `away` and
# `back` take the driver of the lines and give it back, and the kernel gives the chip another number then. `used` asks for
# the processor's time in 10 ms.
SCRIPT = """
cp -r state /tmp/state
driver=/sys/bus/DRIVER
while [ ! -e stop ]; do
    ./nanoplc --config nanoplc.toml 2>&1 &
    pid=$!
    while kill -0 $pid 2>/dev/null; do
        if [ -e kill ]; then kill -9 $pid; rm kill; fi
        if [ -e term ]; then kill -TERM $pid; rm term; fi
        if [ -e away ]; then rm away; echo DEVICE >$driver/unbind; echo "the chip is away"; fi
        if [ -e back ]; then rm back; echo DEVICE >$driver/bind; RENAME; echo "the chip is back"; fi
        if [ -e used ]; then rm used; echo "used $(awk '{ print $14 + $15 }' /proc/$pid/stat) in $(cat /proc/uptime)"; fi
        sleep 0.1
    done
    wait $pid
    echo "ended with $?"
done
"""
# The board is emulated, and whoever emulates it busy: a lost link is a fault that the operator acknowledges.
MOST_FAULTS = 100


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

    def __init__(self, vm, hand, lines, share, nanoctl, port, phases):
        self.vm, self.hand, self.lines, self.share, self.nanoctl, self.port = vm, hand, lines, share, nanoctl, port
        self.phases, self.faults = phases, 0

    def until(self, what, condition):
        end = time.monotonic() + board.LONGEST
        while not condition():
            assert time.monotonic() < end, f"never came: {what}"
            time.sleep(0.02)

    def signal(self, name):
        with open(os.path.join(self.share, name), "w", encoding="utf-8"):
            pass

    def outputs(self):
        return self.hand.output(self.lines["OUT0"]), self.hand.output(self.lines["OUT3"])

    def set(self, name, level):
        self.hand.set_input(self.lines[name], level)

    def status(self):
        done = subprocess.run([self.nanoctl, "--port", self.port, "--patience", board.PATIENCE, "--json", "status"], capture_output=True,
                              text=True, timeout=board.LONGEST, check=False)
        return json.loads(done.stdout.splitlines()[-1])

    def ctl(self, *arguments):
        subprocess.run([self.nanoctl, "--port", self.port, "--patience", board.PATIENCE, *arguments], timeout=board.LONGEST, check=True,
                       stdout=subprocess.DEVNULL)

    def acknowledge(self):
        self.faults += 1
        assert self.faults < MOST_FAULTS, "the link to the motor never holds"
        self.set("IN2", 1)
        time.sleep(0.2)
        self.set("IN2", 0)
        time.sleep(0.2)

    def idle(self):
        while self.outputs() != (0, 1):
            self.acknowledge()

    def grips(self):
        """Start is pressed until the gripper holds a part, on its way."""
        while True:
            self.idle()
            self.set("IN0", 1)
            time.sleep(0.1)
            self.set("IN0", 0)
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


def look_at_all_lines(machine):
    """While the sequence waits for its start: the other inputs, each by itself; outputs that it does not use, forced."""
    machine.idle()
    for name in [name for name in machine.lines if name.startswith("IN") and name != "IN0"]:
        for level in (1, 0):
            machine.set(name, level)
            machine.until(f"{name} = {level}", lambda bits=level << int(name[2]): machine.status()["terminals"] == bits)
    for name in set(machine.lines) & {"OUT1", "OUT2"}:
        while machine.hand.output(machine.lines[name]) == 0:  # in the safe state they show nothing
            machine.idle()
            machine.ctl("force", f"{name}=1")
            time.sleep(0.1)
        machine.ctl("force", "--off")
        machine.until(f"{name} off", lambda line=machine.lines[name]: machine.hand.output(line) == 0)
    print(f"vm: {len(machine.lines)} lines do what they should", flush=True)


def lose_the_chip(machine):
    """In mid-sequence. The axis does nothing any more until a reset, and then not before the chip is there again."""
    machine.grips()
    machine.signal("away")
    machine.vm.wait("x: SAFE: a GPIO chip is gone")
    status = machine.status()
    assert (status["state"], status["safe_reason"]) == ("stopped", "GPIO lines missing"), status
    used = []
    for _ in range(2):
        machine.signal("used")
        machine.until("its time", lambda: not os.path.exists(os.path.join(machine.share, "used")))
        time.sleep(1)
        told = [line.split() for line in machine.vm.printed if line.startswith("used ")]
        used.append((int(told[-1][1]), float(told[-1][3])))
    (before, begun), (after, ended) = used
    print(f"vm: without the chip it uses {(after - before) / (ended - begun):.0f} % of the processor", flush=True)
    assert after - before < 50 * (ended - begun), "it turns round and round"
    machine.ctl("reset")
    machine.vm.wait("x: .*(there is no /dev/gpiochip|no chip has a line).*tries again")
    assert machine.status()["safe_reason"] == "GPIO lines missing"
    machine.signal("back")
    machine.vm.wait("the chip is back")
    machine.vm.wait("x: has all that it needs")
    machine.until("the sequence", lambda: machine.status().get("state") == "running")
    machine.cycle()


def play(machine):
    machine.vm.wait("x: runs /share/pick.bin")
    machine.vm.wait("the motor answers on /dev/ttyS0")
    machine.cycle()
    print("vm: one part is carried", flush=True)
    look_at_all_lines(machine)
    machine.grips()
    machine.signal("kill")
    machine.vm.wait("ended with 137")
    machine.vm.wait("x: SAFE: the last run did not end in order")
    machine.until("safe outputs after the kill", lambda: machine.outputs() == (0, 0))
    status = machine.status()
    assert (status["state"], status["safe_reason"]) == ("stopped", "watchdog"), status
    print("vm: killed in mid-sequence: outputs are safe, it waits", flush=True)
    machine.ctl("run")
    machine.cycle()
    lose_the_chip(machine)
    machine.grips()
    machine.signal("stop")
    machine.signal("term")
    assert machine.vm.finish() == 0
    machine.vm.wait("ended with 0")
    machine.phases.say(f"done, {machine.faults} faults acknowledged")


def config(lines, simulated):
    def places(kind):
        return "\n".join(f'{name} = "{f"gpiochip1:{line}" if simulated else NAMED.get(name, f"gpiochip0:{line}")}"'
                         for name, line in lines.items() if name.startswith(kind))

    return f"{CONFIG}[axis.inputs]\n{places('IN')}\n[axis.outputs]\n{places('OUT')}\n"


def script(simulated):
    if not simulated:
        return SCRIPT.replace("DRIVER", "amba/drivers/pl061_gpio").replace("DEVICE", "9030000.pl061").replace(
            "RENAME", "[ -e /dev/gpiochip0 ] || ln -s gpiochip1 /dev/gpiochip0")
    own = SCRIPT.replace("DRIVER", "platform/drivers/gpio-sim").replace("DEVICE", "gpio-sim.0").replace(
        "RENAME", "[ -e /dev/gpiochip1 ] || ln -s gpiochip2 /dev/gpiochip1; "
        "ln -sfn $(echo /sys/devices/platform/gpio-sim.0/gpiochip*) $lines")
    return f"{gpio_sim.SCRIPT}{gpio_sim.AGENT}hand /dev/ttyS2 &\n{own}"


def run(phases, share, macsim, nanoctl, seqc, source):
    board.prepare()
    simulated = gpio_sim.prepare()
    if not simulated:
        print("vm: goes on with the board's own chip: three inputs and two outputs")
    phases.say("building nanoplc for the board")
    build(share, "board", {"nanoplc": "nanoplc"}, targets=["nanoplc"])
    subprocess.run([seqc, "build", source, "-o", os.path.join(share, "pick.bin")], check=True)
    lines = SIMULATED if simulated else OWN
    with open(os.path.join(share, "nanoplc.toml"), "w", encoding="utf-8") as file:
        file.write(config(lines, simulated))
    commission(os.path.join(share, "state"), "x")
    endpoint = os.path.join(share, "motor")
    motor, _ = simulator.start(macsim, "--model", "MAC140", "--fastmac", "unix:" + endpoint)
    phases.say("starting the board")
    listener = socket.socket(socket.AF_UNIX)
    listener.bind(os.path.join(share, "user"))
    listener.listen()
    try:
        with board.Board(share, script(simulated), serials=["motor", "user", "lines"]) as vm:
            outside = socket.socket(socket.AF_UNIX)
            outside.connect(endpoint)
            join(vm.serials["motor"], outside)
            threading.Thread(target=serve_user, args=(listener, vm.serials["user"]), daemon=True).start()
            hand = gpio_sim.Hand(vm.serials["lines"]) if simulated else vm
            play(Machine(vm, hand, lines, share, nanoctl, "unix:" + os.path.join(share, "user"), phases))
    finally:
        motor.terminate()
        motor.wait()
        motor.stdout.close()
        motor.stderr.close()
        listener.close()


def serve_user(listener, line):
    """One client after the other; what comes while there is none is lost. Ends with the board or the listener."""
    current = []

    def listen():
        try:
            while data := line.recv(4096):
                for client in current:
                    send(client, data)
        except OSError:
            pass

    threading.Thread(target=listen, daemon=True).start()
    while True:
        try:
            client, _ = listener.accept()
            current[:] = [client]
            while data := client.recv(4096):
                line.sendall(data)
        except OSError:
            return
        current.clear()


def send(client, data):
    try:
        client.sendall(data)
    except OSError:
        pass  # it has gone


if __name__ == "__main__":
    sys.exit(in_share(run, *sys.argv[1:5]))
