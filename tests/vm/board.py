"""A single-board computer that runs in qemu: Debian's own kernel for arm64, a PL061 GPIO chip of 8 lines that are driven and
read from outside, two CAN controllers on one bus, a watchdog, and serial ports that end in sockets here.

    with board.Board(share, command="./test", serials=["motor"]) as machine:
        machine.wait("ready")
        machine.set_input(2, 1)
        machine.output(5)
        machine.serials["motor"]      # the other end of /dev/ttyS0; adapters are /dev/ttyUSB0 and so on
        status = machine.finish()     # of the command
"""

import json
import os
import re
import select
import shlex
import shutil
import socket
import subprocess
import tempfile
import threading
import time

import image

HERE = os.path.dirname(os.path.abspath(__file__))
BUILD = os.path.join(HERE, "..", "..", "build")
LINES = 8
LONGEST = 400  # seconds of any wait: generous, for the machine that this runs on may be busy
PATIENCE = "20000"  # ms of a client for each answer, likewise

_PL061 = 0x9030000
# Names for some lines, the last one twice.
LINE_NAMES = ["IN_START", "IN_PART", "", "", "OUT_GRIP", "OUT_LAMP", "TWICE", "TWICE"]


class CannotBeHad(Exception):
    """What the virtual board consists of cannot be downloaded."""


# CTest's build.board has fetched and built all just before, or printed why it is not available.
IS_BUILT = "NPLC_BOARD_IS_BUILT" in os.environ


def prepare():
    """Fetches what is missing."""
    if IS_BUILT:
        if not os.path.exists(os.path.join(image.VM, "PACKAGES")):
            raise CannotBeHad
        return
    done = subprocess.run([os.path.join(HERE, "fetch_packages")], check=False)
    if done.returncode == 77:
        raise CannotBeHad
    if done.returncode != 0:
        raise RuntimeError("tests/vm/fetch_packages failed")


class Lines:
    """A socket of text lines."""

    def __init__(self, connection):
        self.socket = connection
        self.file = connection.makefile("rw", encoding="utf-8", newline="\n")

    def tell(self, line):
        self.file.write(line + "\n")
        self.file.flush()

    def hear(self):
        line = self.file.readline()
        if not line:
            raise ConnectionError("the virtual board has ended")
        return line.rstrip("\n")


class Board:
    # For boards with another system on them.
    MEMORY = "256"
    KERNEL_WORDS = ""

    def __init__(self, share, command, serials=(), adapters=(), watchdog="reset", reboots=False, echo=print,
                 more=()):
        """`command` runs in `share`, which the board has as /share. The first of `serials` is /dev/ttyS0. `adapters` are
        those on USB (FTDI); the guest says `modprobe -a xhci_pci ftdi_sio` first. `watchdog`: what it does (reset,
        poweroff, pause, none). Without `reboots` a reset ends the board. `more`: arguments of qemu."""
        self.share, self.watchdog, self.reboots = share, watchdog, reboots
        self.ports, self.adapters = list(serials), list(adapters)
        self.echo, self.more = echo, list(more)
        self.printed = []
        self.serials = {}
        self._news = threading.Condition()
        self._ended = False
        self._lock = threading.Lock()
        with open(os.path.join(share, "run"), "w", encoding="utf-8") as file:
            file.write(command if isinstance(command, str) else shlex.join(command))
            file.write("\n")

    def __enter__(self):
        self.folder = tempfile.mkdtemp(prefix="board")
        try:
            self._start()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        process = getattr(self, "process", None)
        if process is not None and process.poll() is None:
            process.kill()
        if process is not None:
            process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def wait(self, pattern, seconds=LONGEST):
        """The match of a printed line, also one of before."""
        end = time.monotonic() + seconds
        seen = 0
        with self._news:
            while True:
                for line in self.printed[seen:]:
                    if match := re.search(pattern, line):
                        return match
                seen = len(self.printed)
                if self._ended or not self._news.wait(end - time.monotonic()):
                    tail = "\n".join(self.printed[-20:])
                    raise AssertionError(f"the virtual board did not print {pattern!r}; its last lines:\n{tail}")

    def finish(self, seconds=LONGEST):
        """The exit status of the command; the board is off then."""
        status = int(self.wait(r"VM-DONE rc=(\d+)", seconds).group(1))
        self.process.wait(seconds)
        return status

    def set_input(self, line, level):
        self._qtest(f"set_irq_in {self._chip} unnamed-gpio-in {line} {level}")

    def output(self, line):
        """The level that is on the line, whoever drives it."""
        value = int(self._qtest(f"readl {_PL061 + 0x3FC:#x}").split()[1], 16)
        return (value >> line) & 1

    def command(self, execute, **arguments):
        """One of QMP, to qemu."""
        with self._lock:
            self._monitor.tell(json.dumps({"execute": execute, "arguments": arguments}))
            while True:
                answer = json.loads(self._monitor.hear())
                if "error" in answer:
                    raise RuntimeError(f"qemu: {execute}: {answer['error']['desc']}")
                if "return" in answer:
                    return answer["return"]

    def unplug(self, adapter):
        self.command("device_del", id=adapter)

    def plug(self, adapter):
        end = time.monotonic() + LONGEST
        while True:
            try:
                self.command("device_add", driver="usb-serial", id=adapter, chardev=adapter)
                return
            except RuntimeError:  # qemu is not yet done with the one that was pulled out
                if time.monotonic() > end:
                    raise
                time.sleep(0.02)

    def serve_lines(self, name):
        """Answers the guest on this serial port: `set LINE LEVEL`, `unplug ADAPTER` and `plug ADAPTER` with `ok`,
        `get LINE` with the level."""
        lines = Lines(self.serials[name])
        orders = {
            "set": lambda line, level: self.set_input(int(line), int(level)),
            "get": lambda line: self.output(int(line)),
            "unplug": self.unplug,
            "plug": self.plug,
        }

        def serve():
            try:
                while True:
                    word, *rest = lines.hear().split()
                    try:
                        answer = orders[word](*rest)
                        lines.tell("ok" if answer is None else str(answer))
                    except (KeyError, TypeError, RuntimeError) as error:
                        lines.tell(f"cannot {word}: {error}")
            except (OSError, ValueError):
                pass  # the board has ended

        threading.Thread(target=serve, daemon=True).start()

    def make_initramfs(self, target):
        image.make(target)

    def _start(self):
        initramfs, tree = os.path.join(self.folder, "initramfs"), os.path.join(self.folder, "tree")
        self.make_initramfs(initramfs)
        arguments = self._hardware()
        subprocess.run([*arguments, "-M", f"virt,dumpdtb={tree}"], check=True, capture_output=True)
        subprocess.run(["fdtput", "-t", "s", tree, f"/pl061@{_PL061:x}", "gpio-line-names", *LINE_NAMES], check=True)
        names = ["qtest", "monitor", *self.ports, *self.adapters]
        for name in names[1:]:
            arguments += ["-chardev", f"socket,id={name},path={self.folder}/{name}"]
        for name in self.ports:
            arguments += ["-device", f"pci-serial,chardev={name}"]
        for name in self.adapters:
            arguments += ["-device", f"usb-serial,id={name},chardev={name}"]
        arguments += ["-M", "virt", "-dtb", tree, "-kernel", kernel(), "-initrd", initramfs]
        arguments += ["-append", f"console=ttyAMA0 quiet acpi=off nokaslr panic=-1 {self.KERNEL_WORDS}", "-serial", "stdio"]
        arguments += ["-qtest", f"unix:{self.folder}/qtest", "-qtest-log", "/dev/null"]
        arguments += ["-mon", "chardev=monitor,mode=control"]
        listeners = {name: self._listener(name) for name in names}
        self.process = subprocess.Popen(
            arguments, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        joined = {name: self._accept(listener) for name, listener in listeners.items()}
        self.serials = {name: joined[name] for name in names[2:]}
        threading.Thread(target=self._listen, daemon=True).start()
        self._outside = Lines(joined["qtest"])
        self._monitor = Lines(joined["monitor"])
        self._monitor.hear()
        self.command("qmp_capabilities")
        self._chip = self._find("pl061")

    def _hardware(self):
        arguments = ["qemu-system-aarch64", "-cpu", "cortex-a53", "-m", self.MEMORY, "-accel", "tcg", "-nodefaults"]
        arguments += ["-display", "none", "-object", "can-bus,id=bus"]
        arguments += ["-device", "kvaser_pci,canbus=bus", "-device", "kvaser_pci,canbus=bus"]
        arguments += ["-device", "qemu-xhci", "-device", "i6300esb", "-watchdog-action", self.watchdog]
        arguments += ["-virtfs", f"local,path={self.share},mount_tag=share,security_model=none"]
        arguments += self.more
        return arguments if self.reboots else [*arguments, "-no-reboot"]

    def _listener(self, name):
        listener = socket.socket(socket.AF_UNIX)
        listener.bind(os.path.join(self.folder, name))
        listener.listen()
        return listener

    def _accept(self, listener):
        with listener:
            while not select.select([listener], [], [], 0.2)[0]:
                if self.process.poll() is not None:
                    raise RuntimeError("qemu: " + self.process.stdout.read().decode())
            return listener.accept()[0]

    def _listen(self):
        for raw in self.process.stdout:
            line = raw.decode(errors="replace").rstrip()
            if self.echo:
                self.echo(line, flush=True)
            with self._news:
                self.printed.append(line)
                self._news.notify_all()
        with self._news:
            self._ended = True
            self._news.notify_all()

    def _qtest(self, words):
        with self._lock:
            self._outside.tell(words)
            answer = self._outside.hear()
        if not answer.startswith("OK"):
            raise RuntimeError(f"qtest: {words}: {answer}")
        return answer

    def _find(self, kind):
        for child in self.command("qom-list", path="/machine/unattached"):
            if child["type"] == f"child<{kind}>":
                return "/machine/unattached/" + child["name"]
        raise RuntimeError(f"qemu has no {kind}")


def kernel():
    folder = os.path.join(image.VM, "kernel", "boot")
    return os.path.join(folder, os.listdir(folder)[0])
