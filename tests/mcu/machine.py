"""The firmware's image on an emulated LM3S6965 board: its lines, its pins, and what a test may do to it from outside."""

import json
import os
import re
import struct
import subprocess
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "e2e"))
import simulator  # noqa: E402: a neighbour's
import user_line  # noqa: E402
from sockets import LONG, Lines, connected  # noqa: E402

MEMORY = 32 * 1024
INPUT_LINES = (0, 1, 4, 5, 6, 7)  # of port D
OUTPUT_LINES = (0, 1, 5, 6)  # of port B
OUTPUTS = 0x4000_5000 + (sum(1 << line for line in OUTPUT_LINES) << 2)
STACK, STACK_BYTES, PAINT = 0x2000_0000, 2048, 0xA5A5_A5A5
HEX = tuple("0123456789abcdef")
SCRATCH = 0x2000_F000  # RAM that the firmware does not use


class Monitor:
    """qemu's own: QMP."""

    def __init__(self, path):
        self.lines, self.events = Lines(path), []
        self.lines.file.readline()
        self.do("qmp_capabilities")

    def do(self, command, **arguments):
        answer = json.loads(self.lines.ask(json.dumps({"execute": command, "arguments": arguments})))
        while "event" in answer:
            self.events.append(answer["event"])
            answer = json.loads(self.lines.file.readline())
        if "return" not in answer:
            raise AssertionError(f"{command}: {answer}")
        return answer["return"]

    def wait_for(self, event):
        """The next one since the last wait."""
        while event not in self.events:
            self.events.append(json.loads(self.lines.file.readline())["event"])
        self.events.clear()


class Debugger:
    """gdb's remote protocol, as little as is needed. The core stands from here to resume()."""

    def __init__(self, path, scratch):
        self.socket, self.received, self.scratch = connected(path), b"", scratch
        self.command("?", "T")
        self.command("qXfer:features:read:target.xml:0,400", ("l", "m"))  # without it no single register is written

    def send(self, text):
        self.socket.sendall(f"${text}#{sum(text.encode()) % 256:02x}".encode())

    def receive(self):
        while (packet := re.search(rb"\$([^#]*)#..", self.received)) is None:
            more = self.socket.recv(4096)
            assert more, "the debugger's line was closed"
            self.received += more
        self.received = self.received[packet.end():]
        self.socket.sendall(b"+")
        return packet.group(1).decode()

    def command(self, text, begins):
        """The answer that begins so; unsolicited messages of the stopped core are skipped."""
        self.send(text)
        while True:
            answer = self.receive()
            if answer.startswith(begins):
                return answer
            assert answer.startswith("T"), f"{text}: {answer!r}"

    def go_on(self):
        """Until the core stops by itself."""
        self.send("c")
        self.socket.settimeout(None)
        assert self.receive().startswith("T05")
        self.socket.settimeout(LONG)

    def in_interrupt(self):
        """Bits 8 to 0 of XPSR."""
        return int.from_bytes(bytes.fromhex(self.command("p19", HEX)), "little") & 0x1FF != 0

    def run_code(self, *halfwords):
        """The core goes on with these instructions instead of its own."""
        code = struct.pack(f"<{len(halfwords)}H", *halfwords)
        self.command(f"M{self.scratch:x},{len(code):x}:{code.hex()}", "OK")
        self.jump(self.scratch)

    def jump(self, address):
        self.command(f"Pf={struct.pack('<I', address).hex()}", "OK")

    def resume(self):
        self.command("D", "OK")
        self.socket.close()


class Emulated:
    """A board in qemu's process; its files in a folder."""

    def __init__(self, image, folder):
        self.image, self.folder, self.process = image, folder, None

    def path(self, name):
        return os.path.join(self.folder, name)

    def server(self, name):
        """A socket to connect to, as qemu's options have it."""
        if os.path.exists(self.path(name)):
            os.unlink(self.path(name))
        return f"path={self.path(name)},server=on,wait=off"

    def spawn(self, *options):
        unix = {name: "unix:" + self.server(name).removeprefix("path=") for name in ("qmp", "pins", "gdb")}
        self.process = subprocess.Popen(
            ["qemu-system-arm", "-nodefaults", "-display", "none", "-nic", "none", "-kernel", self.image, *options,
             "-qmp", unix["qmp"], "-gdb", unix["gdb"], "-qtest", unix["pins"], "-qtest-log", "none"],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.monitor = Monitor(self.path("qmp"))

    def cut_power(self):
        self.process.kill()
        self.process.wait()
        self.monitor.lines.close()
        self.pins.close()
        self.process = None

    def reset(self):
        self.monitor.do("system_reset")

    def debugger(self, scratch):
        """The core stands outside of interrupts. `scratch`: RAM that the firmware does not use."""
        while (debugger := Debugger(self.path("gdb"), scratch)).in_interrupt():
            debugger.resume()
        return debugger

    def word(self, address):
        answer = self.pins.ask(f"readl {address:#x}").split()
        assert answer[0] == "OK", answer
        return int(answer[1], 16)

    def stack_used(self):
        """Bytes of painted stack that were ever written."""
        for offset in range(0, STACK_BYTES, 4):
            if self.word(STACK + offset) != PAINT:
                return STACK_BYTES - offset
        return 0


class Machine(Emulated):
    """In real time, as the virtual motor is; with fast=True time is counted in instructions, and an idle core's is skipped."""

    def __init__(self, image, folder, motor=None, fast=False, has_memory=True):
        super().__init__(image, folder)
        self.motor, self.fast, self.has_memory = motor, fast, has_memory
        self.memory = os.path.join(folder, "memory")
        if not os.path.exists(self.memory):
            with open(self.memory, "wb") as file:
                file.write(b"\xFF" * MEMORY)

    def start(self):
        motor = f"socket,id=motor,path={self.motor}" if self.motor else "null,id=motor"
        memory = ["-drive", f"if=none,id=memory,format=raw,cache=unsafe,file={self.memory}",
                  "-device", f"at24c-eeprom,bus=i2c,address=0x50,rom-size={MEMORY},drive=memory"]
        self.spawn("-M", "lm3s6965evb", *(["-icount", "shift=5,sleep=off"] if self.fast else []),
                   *(memory if self.has_memory else []),
                   "-chardev", f"socket,id=user,{self.server('user')}", "-serial", "chardev:user",
                   "-chardev", motor, "-serial", "chardev:motor")
        # The emulated clock can stand for ever if the pins' client comes before the firmware runs.
        line = user_line.UserLine(self.path("user"))
        line.read(user_line.FW_VERSION)
        line.close()
        self.pins = Lines(self.path("pins"))
        devices = self.monitor.do("qom-list", path="/machine/unattached")
        ports = sorted((int(d["name"][7:-1]), d["name"]) for d in devices if d["type"] == "child<pl061_luminary>")
        self.port_d = "/machine/unattached/" + ports[3][1]
        return self

    def debugger(self):
        return super().debugger(SCRATCH)

    def endpoint(self):
        return "unix:" + self.path("user")

    def drive_input(self, number, level):
        answer = self.pins.ask(f"set_irq_in {self.port_d} unnamed-gpio-in {INPUT_LINES[number]} {level}")
        assert answer.startswith("OK"), answer

    def outputs(self):
        pins = self.word(OUTPUTS)
        return sum((pins >> line & 1) << number for number, line in enumerate(OUTPUT_LINES))


def until(what, wanted, seconds=LONG):
    """Asks again and again until the answer is as wanted; the answer."""
    end = time.monotonic() + seconds
    while True:
        answer = what()
        if wanted(answer):
            return answer
        if time.monotonic() > end:
            raise AssertionError(f"never came; the last was {answer}")
        time.sleep(0.01)


def start_motor(simulator_program, folder, *options):
    """The process and the path of its line, whose option is the last one."""
    path = os.path.join(folder, "motor")
    process, _ = simulator.start(simulator_program, *options, "unix:" + path)
    return process, path
