#!/usr/bin/env python3
"""Every file that a program writes: on a full disk, over a file that is there, through links, where it cannot be.

usage: outputs_test.py BIN_FOLDER PROGRAM.seq
Runs itself in a mount namespace, for a small disk of its own.
"""

import os
import subprocess
import sys
import unittest

import program_case

LONG = 60  # timeout in seconds of what must come
BIN = SEQUENCE = ""
DISK = 1 << 20  # bytes
BLINK = """PROGRAM Blink
VAR_OUTPUT Lamp AT %QX0.0 : BOOL; END_VAR
ON ERROR NEXT := Fault;
POWER_UP NEXT := Dark; END_POWER_UP
STEP Dark: ENTRY TIMER := T#5ms; IF TIMER.Q THEN NEXT := Lit; END_IF END_STEP
STEP Lit: OUT Lamp; ENTRY TIMER := T#5ms; IF TIMER.Q THEN NEXT := Dark; END_IF END_STEP
STEP Fault: OWN ERROR; END_STEP
END_PROGRAM
"""
IN_NAMESPACE = "NANOPLC_TEST_IN_NAMESPACE"


def program(name):
    return os.path.join(BIN, name)


class Outputs(program_case.ProgramCase):
    def setUp(self):
        super().setUp()
        self.disk = self.path("disk")
        os.mkdir(self.disk)
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={DISK}", "none", self.disk], check=True)
        self.addCleanup(subprocess.run, ["umount", "-l", self.disk], check=True)
        self.table = self.path("made.bin")
        subprocess.run([program("seqc"), "build", SEQUENCE, "-o", self.table], check=True, stdout=subprocess.DEVNULL)

    def tearDown(self):
        self.doCleanups()
        super().tearDown()

    def makers(self):
        """What makes a file from files, by name: how, and how the file must be called."""
        run = [program("nanoplc-sim"), "run", self.table, "--for", "200ms", "--quiet"]
        seqc = program("seqc")
        recording = self.put("recording.csv", "time_s,P_IST [counts]\n0,1\n1,2\n")
        return {
            "build": (lambda out: [seqc, "build", SEQUENCE, "--no-symbols", "-o", out], "t.bin"),
            "build hex": (lambda out: [seqc, "build", SEQUENCE, "--no-symbols", "-o", out], "t.hex"),
            "listing": (lambda out: [seqc, "build", SEQUENCE, "-o", "/dev/null", "--listing", out], "t.lst"),
            "symbols": (lambda out: [seqc, "build", SEQUENCE, "-o", "/dev/null", "--symbols", out], "t.sym"),
            "disasm": (lambda out: [seqc, "disasm", self.table, "-o", out], "t.txt"),
            "decompile": (lambda out: [seqc, "decompile", self.table, "-o", out], "t.seq"),
            "report": (lambda out: [seqc, "report", SEQUENCE, "-o", out], "t.txt"),
            "graph": (lambda out: [seqc, "graph", SEQUENCE, "-o", out], "t.svg"),
            "fmt": (lambda out: [seqc, "fmt", SEQUENCE, "-o", out], "t.seq"),
            "trace": (lambda out: [*run, "--trace", out], "t.csv"),
            "vcd": (lambda out: [*run, "--vcd", out], "t.vcd"),
            "junit": (lambda out: [*run, "--scenario", self.put("s.scn", "never ERROR\n"), "--junit", out], "t.xml"),
            "plot": (lambda out: [program("macreg"), "plot", recording, "-o", out], "t.svg"),
        }

    def readers(self):
        """The same of what is read from a gateway or a motor."""
        gateway, motor = "unix:" + self.path("gateway"), "unix:" + self.path("motor")
        self.launch(program("nanoplc-sim"), "run", self.table, "--realtime", "--mactalk", gateway)
        self.launch(program("macsim"), "--mactalk", motor)
        macreg = [program("macreg"), "--port", motor]
        return {
            "download": (lambda out: [program("nanoctl"), "--port", gateway, "download", "-o", out], "t.bin"),
            "download hex": (lambda out: [program("nanoctl"), "--port", gateway, "download", "-o", out], "t.hex"),
            "dump": (lambda out: [*macreg, "dump", "-o", out], "t.txt"),
            "record": (lambda out: [*macreg, "record", "P_IST", "--samples", "5", "-o", out], "t.csv"),
        }

    def call(self, command):
        return subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=LONG, check=False)

    def refused(self, command, *words):
        done = self.call(command)
        self.assertEqual(done.returncode, 2, f"{command}: {done.stdout}{done.stderr}")
        self.assertEqual(done.stderr.count("\n"), 1, f"{command}: {done.stderr}")
        for word in words:
            self.assertIn(word, done.stderr)

    def good(self, command):
        done = self.call(command)
        self.assertEqual(done.returncode, 0, f"{command}: {done.stdout}{done.stderr}")

    def each(self, writers, check):
        for name, (command, file) in writers.items():
            with self.subTest(name):
                self.clear()
                check(command, os.path.join(self.disk, file))

    def clear(self):
        for name in os.listdir(self.disk):
            os.unlink(os.path.join(self.disk, name))

    def fill(self):
        """Not one byte more fits on the disk."""
        with open(os.path.join(self.disk, "filler"), "wb", buffering=0) as file:
            try:
                while True:
                    file.write(bytes(4096))
            except OSError:
                pass

    def content(self, path):
        with open(path, "rb") as file:
            return file.read()

    def bad_places(self, command, out):
        full = os.path.join(self.disk, "full" + os.path.splitext(out)[1])
        os.symlink("/dev/full", full)
        self.refused(command(full), full, "No space left")
        os.unlink(full)
        self.refused(command(os.path.join(self.disk, "no", os.path.basename(out))), "No such file", "/no/")
        os.mkdir(out)
        self.refused(command(out), out)
        os.rmdir(out)
        self.assertEqual(os.listdir(self.disk), [])
        self.fill()
        self.refused(command(out), out, "No space left")
        self.assertEqual(os.listdir(self.disk), ["filler"])

    def links(self, command, out):
        """A link stays one, wherever it leads; one prepared where a file is gathered is not followed."""
        os.symlink("target" + os.path.splitext(out)[1], out)
        self.good(command(out))
        left = set(os.listdir(self.disk)) - {os.path.basename(out) + ".sym"}  # which a trace has beside it
        self.assertEqual(left, {os.path.basename(out), os.readlink(out)})
        self.assertTrue(self.content(out))
        self.clear()
        victim = self.put("victim", "precious")
        os.symlink(victim, out + ".part")
        self.good(command(out))
        self.assertEqual(self.content(victim), b"precious")
        self.assertFalse(os.path.islink(out))

    def replaced_or_left(self, command, out):
        self.good(command(out))
        first = self.content(out)
        with open(out, "w", encoding="ascii") as file:
            file.write("old")
        self.fill()
        self.refused(command(out), "No space left")
        self.assertEqual(self.content(out), b"old")
        os.unlink(os.path.join(self.disk, "filler"))
        self.good(command(out))
        self.assertEqual(self.content(out), first)

    def kept(self, command, out):
        with open(out, "w", encoding="ascii") as file:
            file.write("old")
        self.refused(command(out), out, "is there already", "--force")
        link = os.path.join(self.disk, "link" + os.path.splitext(out)[1])
        os.symlink(out, link)
        self.refused(command(link), "is there already", "--force")
        self.assertEqual(self.content(out), b"old")
        self.good([*command(out), "--force"])
        self.assertNotEqual(self.content(out), b"old")
        with open(out, "w", encoding="ascii"):
            pass  # as mktemp makes it: there is nothing to lose
        self.good(command(out))
        self.assertNotEqual(self.content(out), b"")

    def test_made_files_where_they_cannot_be(self):
        self.each(self.makers(), self.bad_places)

    def test_read_files_where_they_cannot_be(self):
        self.each(self.readers(), self.bad_places)

    def test_links_to_made_files(self):
        self.each(self.makers(), self.links)

    def test_links_to_read_files(self):
        self.each(self.readers(), self.links)

    def test_what_is_made_from_files_replaces_what_was_made_before_or_nothing(self):
        self.each(self.makers(), self.replaced_or_left)

    def test_what_is_read_from_a_machine_replaces_nothing_unless_it_is_forced(self):
        self.each(self.readers(), self.kept)

    def test_a_recording_is_refused_before_the_motor_moves(self):
        command, out = self.readers()["record"]
        move = ["--yes", "--move", "P_SOLL=+4096"]
        self.refused([*command(self.put(out, "old")), *move], "is there already")
        self.refused([*command(self.path("no/t.csv")), *move], "No such file")
        position = self.call([program("macreg"), "--port", "unix:" + self.path("motor"), "get", "P_SOLL"]).stdout
        self.assertIn("P_SOLL = 0 ", position)

    def test_memories_of_virtual_devices(self):
        endpoint = "unix:" + self.path("device")
        devices = {
            "macsim": [program("macsim"), "--mactalk", endpoint, "--flash"],
            "midisim": [program("midisim"), "--model", "MAC34-1", "--v24", endpoint, "--eeprom"],
            "nanoplc-sim": [program("nanoplc-sim"), "run", self.table, "--realtime", "--mactalk", endpoint, "--flash"],
        }
        for name, command in devices.items():
            with self.subTest(name):
                self.clear()
                memory = os.path.join(self.disk, "memory")
                self.refused([*command, os.path.join(self.disk, "no", "memory")], "No such file", "/no/memory")
                self.refused([*command, self.disk], self.disk)
                self.refused([*command, "/dev/zero"], "/dev/zero")
                victim = self.put("victim", "precious")
                self.refused([*command, victim], victim)
                self.assertEqual(self.content(victim), b"precious")
                os.mkfifo(memory)
                self.refused([*command, memory], memory)
                self.clear()
                self.fill()
                if name == "nanoplc-sim":
                    self.refused([*command, memory], memory, "No space left", "bytes", self.disk)
                self.assertNotIn("memory", os.listdir(self.disk))

    def test_the_store_of_a_gateway_tells_what_it_needs(self):
        ends = os.openpty()
        for end in ends:
            self.addCleanup(os.close, end)
        state = os.path.join(self.disk, "state")
        os.makedirs(os.path.join(state, "x"))
        config = self.put("nanoplc.toml", f'[service]\nstate_directory = "{state}"\n[[axis]]\nname = "x"\ntable = "none"\n'
                                           f'[axis.motor]\nport = "{os.ttyname(ends[1])}"\n')
        self.fill()
        with subprocess.Popen([program("nanoplc"), "--config", config], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True) as service:
            wanted = f"{state}/x/store.bin: cannot be made: No space left on device; it needs 32768 bytes in {state}/x"
            said = service.stderr.readline()
            while wanted not in said and service.poll() is None:
                said = service.stderr.readline()
            self.assertIn(wanted, said)
            service.terminate()
            service.communicate()
        self.assertNotIn("store.bin", os.listdir(os.path.join(state, "x")))

    def test_a_full_disk_ends_a_long_run_at_once(self):
        self.fill()
        os.unlink(os.path.join(self.disk, "filler"))
        blink = self.path("blink.bin")
        subprocess.run([program("seqc"), "build", self.put("blink.seq", BLINK), "-o", blink], check=True, capture_output=True)
        command = [program("nanoplc-sim"), "run", blink, "--for", "6000min", "--quiet"]
        for option in ("--trace", "--vcd"):
            self.refused([*command, option, os.path.join(self.disk, "t")], "No space left")
            self.assertEqual(os.listdir(self.disk), [])


if __name__ == "__main__":
    BIN, SEQUENCE = sys.argv[1:]
    if IN_NAMESPACE not in os.environ:
        private = ["unshare", "--user", "--map-root-user", "--mount"]
        if subprocess.run([*private, "true"], check=False).returncode != 0:
            sys.exit(77)  # skipped: mounting is not permitted on this machine
        os.environ[IN_NAMESPACE] = "yes"
        os.execvp("unshare", [*private, sys.executable, "-B", *sys.argv])
    unittest.main(argv=sys.argv[:1])
