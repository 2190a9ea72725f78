#!/usr/bin/env python3
"""What tools/portable built, run beside the programs of this machine: the same bytes, the same words.

usage: portable_test.py PORTABLE_FOLDER REFERENCE_BIN_FOLDER SYSTEM...    (x86-64, aarch64, windows)
"""

import glob
import json
import os
import pty
import re
import select
import subprocess
import sys
import tempfile
import termios
import unittest
import zipfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "tests", "e2e"))

import simulator  # noqa: E402
import targets  # noqa: E402

REFERENCE = ""
EXAMPLES = sorted(glob.glob(os.path.join(ROOT, "tools", "sequence", "examples", "*.seq")))
OWN_OF_WINDOWS = {"kernel32.dll", "msvcrt.dll", "ws2_32.dll", "advapi32.dll", "user32.dll", "shell32.dll"}

# Says its argument and its input again; supports svg only.
STAND_IN_FOR_DOT = r"""
#include <fcntl.h>
#include <io.h>
#include <stdio.h>
#include <string.h>
int main(int count, char** words) {
    const char* const format = words[count - 1];
    if (strcmp(format, "-Tpng") != 0) return fprintf(stderr, "no such format\n"), 1;
    _setmode(0, _O_BINARY), _setmode(1, _O_BINARY);
    printf("%s\n", format);
    for (int c; (c = getchar()) != EOF;) putchar(c);
    return 0;
}
"""


class Case(unittest.TestCase):
    target = None  # of the class that run() makes for each system

    @classmethod
    def setUpClass(cls):
        if reason := cls.target.missing():
            print(f"skipped: {cls.target.name}: {reason}")
            raise unittest.SkipTest(reason)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "wb") as file:
            file.write(text.encode())

    def read(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def call(self, program, *arguments, code=0, **options):
        """A program of the target's, in the test's folder; its standard output and error."""
        done = subprocess.run([*self.target.command(program), *arguments], cwd=self.folder, capture_output=True,
                              stdin=subprocess.DEVNULL, env=self.target.environment, timeout=300, check=False, **options)
        self.assertEqual(done.returncode, code, f"{program} {arguments}: {done.stdout!r} {done.stderr!r}")
        return done.stdout, done.stderr

    def reference(self, program, *arguments):
        done = subprocess.run([os.path.join(REFERENCE, program), *arguments], cwd=self.folder, capture_output=True,
                              stdin=subprocess.DEVNULL, timeout=300, check=False)
        return done.stdout, done.stderr

    def expect_same(self, program, *arguments, code=0):
        theirs = self.call(program, *arguments, code=code)
        self.assertEqual(theirs, self.reference(program, *arguments), f"{program} {arguments}")
        return theirs


class Programs(Case):
    def test_they_need_no_library(self):
        for program in self.target.programs:
            if self.target.ending:
                listing = subprocess.run(["x86_64-w64-mingw32-objdump", "-p", self.target.file(program)],
                                         capture_output=True, text=True, check=True).stdout
                needed = {name.lower() for name in re.findall(r"DLL Name: (\S+)", listing)}
                self.assertLessEqual(needed, OWN_OF_WINDOWS | {n for n in needed if n.startswith("api-ms-win-crt-")})
                self.assertIn("kernel32.dll", needed)
            else:
                kind = subprocess.run(["file", "-b", self.target.file(program)], capture_output=True, text=True, check=True)
                self.assertIn("statically linked", kind.stdout)
                self.assertIn(self.target.machine, kind.stdout)
                loader = subprocess.run(["ldd", self.target.file(program)], capture_output=True, text=True, check=False)
                self.assertIn("not a dynamic executable", loader.stderr)

    def test_versions_and_help(self):
        for program in self.target.programs:
            self.expect_same(program, "--version")
            self.assertIn(b"Exit codes:", self.call(program, "--help")[0])

    def test_checksums(self):
        subprocess.run(["sha256sum", "--check", "--quiet", "SHA256SUMS"], cwd=self.target.folder, check=True)


class Seqc(Case):
    def test_every_example_becomes_the_same_bytes(self):
        self.assertGreaterEqual(len(EXAMPLES), 8)
        for example in EXAMPLES:
            name = os.path.basename(example)
            with open(example, encoding="utf-8") as file:
                self.write(name, file.read())
            made = {}
            for who in (self.call, self.reference):
                who("seqc", "build", name, "-o", "t.bin", "--listing", "t.lst")
                made[who] = [self.read(part) for part in ("t.bin", "t.lst", "t.sym")]
                for part in ("t.bin", "t.lst", "t.sym"):
                    os.remove(self.path(part))
            self.assertEqual(made[self.call], made[self.reference], name)
            self.assertGreater(len(made[self.call][0]), 8)
            self.assertEqual(len(os.listdir(self.folder)), 1, os.listdir(self.folder))
            os.remove(self.path(name))

    def prepare(self):
        with open(EXAMPLES[0], encoding="utf-8") as file:
            self.write("a.seq", file.read())
        self.reference("seqc", "build", "a.seq")

    def test_what_it_prints(self):
        self.prepare()
        for arguments in (["disasm", "a.bin"], ["decompile", "a.bin"], ["report", "a.seq"], ["check", "a.seq"],
                          ["graph", "a.seq", "--format", "dot"], ["explain", "E012"], ["build", "a.seq", "-o", "b.hex"]):
            out, _ = self.expect_same("seqc", *arguments)
            self.assertNotIn(b"\r", out)

    def test_errors(self):
        self.write("wrong.seq", "STEP A:\n    NEXT := Nowhere;\nEND_STEP\n")
        self.expect_same("seqc", "check", "wrong.seq", code=1)
        self.expect_same("seqc", "build", "missing.seq", code=2)
        self.prepare()
        os.mkdir(self.path("folder"))
        _, error = self.call("seqc", "build", "a.seq", "-o", "folder", code=2)
        self.assertIn(b"it is a folder", error)

    def test_an_older_table_is_replaced(self):
        self.prepare()
        wanted = self.read("a.bin")
        self.write("a.bin", "old")
        self.call("seqc", "build", "a.seq")
        self.assertEqual(self.read("a.bin"), wanted)
        self.assertEqual(sorted(os.listdir(self.folder)), ["a.bin", "a.seq", "a.sym"])

    def test_names_beyond_ascii(self):
        self.prepare()
        os.rename(self.path("a.seq"), self.path("Größe Ω.seq"))
        out, _ = self.call("seqc", "build", "Größe Ω.seq")
        self.assertIn("Größe Ω.bin: ".encode(), out)
        self.assertEqual(self.read("Größe Ω.bin"), self.read("a.bin"))
        self.expect_same("seqc", "disasm", "Größe Ω.bin")
        self.assertIn(b"STEP", self.expect_same("seqc", "decompile", "Größe Ω.bin")[0])
        _, error = self.call("seqc", "build", "weiß nicht.seq", code=2)
        self.assertIn("'weiß nicht.seq'".encode(), error)

    def test_line_ends_of_windows(self):
        self.prepare()
        self.write("b.seq", self.read("a.seq").decode().replace("\n", "\r\n"))
        self.call("seqc", "build", "b.seq")
        self.assertEqual(self.read("b.bin"), self.read("a.bin"))

    def test_drawings(self):
        self.prepare()
        for kind in ("svg", "json", "dot"):
            self.expect_same("seqc", "graph", "a.seq", "--format", kind)
        if not self.target.ending:
            return
        _, error = self.call("seqc", "graph", "a.seq", "-o", "a.png", code=2)
        self.assertIn(b"Graphviz' program 'dot' is missing", error)
        self.assertFalse(os.path.exists(self.path("a.png")))
        self.write("dot.c", STAND_IN_FOR_DOT)
        subprocess.run(["x86_64-w64-mingw32-gcc-posix", "-o", "dot.exe", "dot.c"], cwd=self.folder, check=True)
        self.call("seqc", "graph", "a.seq", "-o", "a.png")
        self.assertTrue(self.read("a.png").startswith(b"-Tpng\ndigraph"))
        _, error = self.call("seqc", "graph", "a.seq", "-o", "a.pdf", code=2)
        self.assertIn(b"'dot' failed: no such format", error)


class Macreg(Case):
    def setUp(self):
        super().setUp()
        lines = self.start_motor("tcp:127.0.0.1:0")
        self.port = next(word for line in lines for word in line.split() if word.startswith("tcp:"))

    def macreg(self, *arguments, code=0, port=None):
        out, error = self.call("macreg", "--port", port or self.port, "--patience", "2000", *arguments, code=code)
        return out.decode(), error.decode()

    def value(self, register, **options):
        out, _ = self.macreg("get", register, "--json", **options)
        return json.loads(out.splitlines()[0])["registers"][0]["raw"]

    def read_and_write(self, port):
        # 001 §7: V_SOLL's unit on MAC50 to MAC141 is 1/16 count a sample of 1.92 ms at 4096 counts a turn:
        # 500 rpm are 500 / 60 * 4096 * 1.92e-3 * 16 = 1048.6.
        self.macreg("set", "V_SOLL", "500rpm", port=port)
        self.assertIn(self.value("V_SOLL", port=port), (1048, 1049))
        self.macreg("set", "P_SOLL", "20480", port=port)
        self.assertEqual(self.value("P_SOLL", port=port), 20480)

    def test_registers_over_tcp(self):
        self.read_and_write(self.port)

    def test_a_whole_parameter_file(self):
        self.macreg("set", "V_SOLL", "1600", "T_SOLL", "500")
        self.macreg("dump", "-o", "axis.txt")
        self.assertFalse(os.path.exists(self.path("axis.txt.part")))
        self.assertNotIn(b"\r", self.read("axis.txt"))
        self.macreg("dump", "-o", "axis.txt")  # over the one that is there
        self.macreg("diff", "axis.txt")
        self.macreg("set", "V_SOLL", "800")
        self.macreg("diff", "axis.txt", code=1)
        self.macreg("load", "axis.txt", "--yes")
        self.assertEqual(self.value("V_SOLL"), 1600)
        ours = subprocess.run([os.path.join(REFERENCE, "macreg"), "--port", self.port, "dump"], capture_output=True,
                              stdin=subprocess.DEVNULL, timeout=300, check=True).stdout.decode().splitlines()
        dated = re.compile(r"\d{4}-\d\d-\d\dT")
        self.assertEqual([line for line in self.read("axis.txt").decode().splitlines() if not dated.search(line)],
                         [line for line in ours if not dated.search(line)])

    def test_a_recording_as_a_picture(self):
        self.macreg("record", "P_IST,V_IST", "--samples", "50", "-o", "r.csv")
        self.assertNotIn(b"\r", self.read("r.csv"))
        for ending in ("svg", "png"):
            self.call("macreg", "plot", "r.csv", "-o", "theirs." + ending)
            self.reference("macreg", "plot", "r.csv", "-o", "ours." + ending)
            self.assertEqual(self.read("theirs." + ending), self.read("ours." + ending))

    def test_nobody_to_be_asked(self):
        _, error = self.macreg("flash", "save", code=2)
        self.assertIn("nobody is there to be asked", error)

    def test_ports_that_are_none(self):
        self.assertIn("nobody listens there", self.macreg("get", "P_IST", code=3, port="tcp:127.0.0.1:1")[1])
        self.assertIn("this machine only", self.macreg("get", "P_IST", code=2, port="tcp:192.0.2.1:80")[1])
        if self.target.ending:
            for port in ("pty:/tmp/x", "unix:/tmp/x", "/dev/ttyUSB0"):
                self.assertIn("write a serial line such as COM3, or tcp:127.0.0.1:PORT",
                              self.macreg("get", "P_IST", code=2, port=port)[1])
            self.assertIn("COM9: there is no such port", self.macreg("get", "P_IST", code=3, port="com9")[1])
        else:
            self.assertIn("there is no such port", self.macreg("get", "P_IST", code=3, port="/dev/nothing")[1])

    def look_at_the_screen(self):
        keyboard, terminal = pty.openpty()
        self.addCleanup(os.close, keyboard)
        self.addCleanup(os.close, terminal)
        before = termios.tcgetattr(terminal)
        screen = subprocess.Popen([*self.target.command("macreg"), "--port", self.port, "--patience", "2000", "ui"],
                                  stdin=terminal, stdout=terminal, stderr=terminal,
                                  env={**os.environ, "TERM": "xterm", "LC_ALL": "C.UTF-8"})
        self.addCleanup(screen.kill)
        shown = b""
        while b"INIT_MODE" not in shown:
            self.assertTrue(select.select([keyboard], [], [], 60)[0], shown)
            shown += os.read(keyboard, 65536)
        os.write(keyboard, b"q")
        while screen.poll() is None:
            if select.select([keyboard], [], [], 0.1)[0]:
                os.read(keyboard, 65536)
        self.assertEqual(screen.returncode, 0)
        self.assertEqual(termios.tcgetattr(terminal), before)

    def test_the_full_screen(self):
        help_text = self.call("macreg", "--help")[0].decode()
        if self.target.has_ui:
            self.assertNotIn("built without ncurses", help_text)
            self.assertIn("terminal", self.macreg("ui", code=2)[1])
            self.look_at_the_screen()
        else:
            self.assertIn("built without ncurses", help_text)
            self.assertIn("without the full screen", self.macreg("ui", code=2)[1])

    def start_motor(self, endpoint):
        motor, lines = simulator.start(os.path.join(REFERENCE, "macsim"), "--model", "MAC140", "--address", "8", "--fastmac",
                                       "pty:" + self.path("fastmac"), "--mactalk", endpoint)
        self.addCleanup(motor.communicate)
        self.addCleanup(motor.kill)
        return lines

    def test_registers_over_a_serial_line(self):
        self.start_motor("pty:" + self.path("motor"))
        ports = [self.path("motor"), "pty:" + self.path("motor")]
        if self.target.ending:
            self.target.connect_com(7, os.path.realpath(self.path("motor")))
            ports = ["COM7", "com7:", r"\\.\COM7"]
        for port in ports:
            self.read_and_write(port)


class Fmu(Case):
    """The library for Windows in an FMU, driven by a program of its own there and by the same one here."""

    @classmethod
    def setUpClass(cls):
        if cls.target.fmu_library is None:
            raise unittest.SkipTest("of this system's own nanoplc-sim, in tests/fmu")
        super().setUpClass()

    def course(self, runner, driver, library):
        with open(self.path("modelDescription.xml"), encoding="utf-8") as file:
            token = re.search('instantiationToken="([^"]+)"', file.read())[1]
        done = subprocess.run([*runner, self.path(driver), library, token, "resources"], cwd=self.folder, capture_output=True,
                              stdin=subprocess.DEVNULL, env=self.target.environment, timeout=300, check=False)
        self.assertEqual(done.returncode, 0, done.stdout[-500:] + done.stderr)
        return done.stdout.replace(b"\r\n", b"\n")

    def test_its_library_for_windows_computes_the_same(self):
        program = os.path.join(ROOT, "tools", "sequence", "examples", "pick_and_place.seq")
        self.reference("nanoplc-sim", "fmu", "-o", "axis.fmu", "--with-gateway", program, "--windows", self.target.fmu_library)
        with zipfile.ZipFile(self.path("axis.fmu")) as archive:
            archive.extractall(self.folder)
        source = os.path.join(ROOT, "tests", "portable", "fmu_driver.c")
        subprocess.run(["gcc", "-O1", "-o", "driver", source, "-ldl"], cwd=self.folder, check=True)
        subprocess.run(["x86_64-w64-mingw32-gcc-posix", "-O1", "-o", "driver.exe", source], cwd=self.folder, check=True)
        here = self.course((), "driver", "binaries/x86_64-linux/nanoplc.so")
        there = self.course(self.target.runner, "driver.exe", r"binaries\x86_64-windows\nanoplc.dll")
        self.assertEqual(len(here.splitlines()), 1501)
        self.assertNotEqual(here.splitlines()[-1].split()[0], b"0000000000000000")
        self.assertEqual(there, here)

    def test_the_library_needs_windows_only(self):
        done = subprocess.run(["x86_64-w64-mingw32-objdump", "-p", self.target.fmu_library], capture_output=True, text=True, check=True)
        needed = {name.lower() for name in re.findall(r"DLL Name: (\S+)", done.stdout)}
        self.assertLessEqual(needed, OWN_OF_WINDOWS)
        exported = re.findall(r"(?m)^\s+\[ *\d+\] (?:\+base\[ *\d+\] +[0-9a-f]+ )?(\w+)$", done.stdout)
        self.assertGreater(len(exported), 100)
        self.assertEqual([name for name in exported if not re.match(r"fmi[23][A-Z]", name)], [])


def suite_of(target):
    cases = unittest.TestSuite()
    for case in (Programs, Seqc, Macreg, Fmu):
        named = type(f"{case.__name__}_{target.name}".replace("-", "_"), (case,), {"target": target})
        cases.addTests(unittest.defaultTestLoader.loadTestsFromTestCase(named))
    return cases


def main(portable, reference, systems):
    global REFERENCE
    REFERENCE = os.path.abspath(reference)
    failed = False
    with tempfile.TemporaryDirectory() as scratch:
        known = {"x86-64": targets.Linux(portable), "aarch64": targets.Arm(portable),
                 "windows": targets.Windows(portable, scratch)}
        for system in systems:
            target = known[system]
            print(f"-- {target.name}", flush=True)
            if not target.missing():
                target.start()
            try:
                failed |= not unittest.TextTestRunner(verbosity=1).run(suite_of(target)).wasSuccessful()
            finally:
                if not target.missing():
                    target.stop()
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2], sys.argv[3:]))
