#!/usr/bin/env python3
"""Every file that a program reads, given what it is not: a folder, nothing, 10 GB, no end, a pipe, garbage, another kind of file.

usage: wrong_files_test.py BIN_FOLDER PROGRAM.seq
"""

import os
import random
import subprocess
import sys
import time
import unittest

import program_case

BIN = SEQUENCE = ""
ANY_BYTES = "seq bin garbage"  # what holds an end term is looked at, as what an old module gave
MOST_SECONDS = 30  # a busy machine's
MOST_KIB = 200 * 1024


def program(name):
    return os.path.join(BIN, name)


class WrongFiles(program_case.ProgramCase):
    def setUp(self):
        super().setUp()
        self.scenario = self.put("right.scn", "end at 10 ms\n")
        self.table = self.path("right.bin")
        subprocess.run([program("seqc"), "build", SEQUENCE, "-o", self.table], check=True, stdout=subprocess.DEVNULL)
        self.gateway, self.motor = "unix:" + self.path("gateway"), "unix:" + self.path("motor")
        self.module = "unix:" + self.path("module")
        ends = os.openpty()
        for end in ends:
            self.addCleanup(os.close, end)
        self.line = os.ttyname(ends[1])
        self.launch(program("nanoplc-sim"), "run", self.table, "--realtime", "--mactalk", self.gateway)
        self.launch(program("macsim"), "--mactalk", self.motor)
        self.launch(program("midisim"), "--model", "MAC34-1", "--v24", self.module)

    def readers(self):
        """A reader of a file: the expected content, and the command."""
        seqc, sim = program("seqc"), [program("nanoplc-sim"), "run"]
        nanoctl = [program("nanoctl"), "--port", self.gateway]
        macreg = [program("macreg"), "--port", self.motor]
        endpoint = "unix:" + self.path("endpoint")
        yield from ((f"seqc {name}", "seq", lambda file, name=name: [seqc, name, file, "-o", "/dev/null"])
                    for name in ("build", "fmt"))
        yield from ((f"seqc {name}", wants, lambda file, name=name: [seqc, name, file])
                    for name, wants in (("check", "seq"), ("report", "seq bin"), ("disasm", ANY_BYTES), ("decompile", ANY_BYTES)))
        yield "seqc graph", "seq bin", lambda file: [seqc, "graph", file, "--format", "svg"]
        yield "seqc diff", "seq bin", lambda file: [seqc, "diff", self.table, file]
        yield "seqc --symbols", "sym", lambda file: [seqc, "disasm", self.table, "--symbols", file]
        yield "nanoplc-sim run", "seq bin", lambda file: [*sim, file, "--for", "20ms"]
        yield "nanoplc-sim --scenario", "scn empty", lambda file: [*sim, self.table, "--for", "20ms", "--scenario", file]
        yield "nanoplc-sim --symbols", "sym", lambda file: [*sim, self.table, "--for", "20ms", "--symbols", file]
        yield "nanoplc-sim --flash", "none", lambda file: [*sim, self.table, "--for", "20ms", "--flash", file]
        yield "nanoplc-sim scan", "bin", lambda file: [program("nanoplc-sim"), "scan", file, "--stimulus", self.path("right.stimulus")]
        yield "nanoplc-sim --stimulus", "stimulus", lambda file: [program("nanoplc-sim"), "scan", self.table, "--stimulus", file]
        yield from ((f"nanoctl {name}", "bin", lambda file, name=name: [*nanoctl, name, file]) for name in ("upload", "verify"))
        yield "nanoctl --sym", "sym", lambda file: [*nanoctl, "--sym", file, "status"]
        yield from ((f"macreg {name}", "txt", lambda file, name=name: [*macreg, name, file]) for name in ("load", "diff"))
        yield "macreg plot", "csv", lambda file: [*macreg, "plot", file, "-o", self.path("plotted.svg")]
        yield "macreg fit", "", lambda file: [*macreg, "fit", file, "-o", self.path("fitted.toml")]
        yield "macreg monitor", "hex", lambda file: [*macreg, "monitor", "--replay", file]
        yield "macreg midi", "path", lambda file: [program("macreg"), "--port", self.module, "midi", "path", file]
        yield "macsim --flash", "flash none", lambda file: [program("macsim"), "--mactalk", endpoint, "--flash", file]
        yield "macsim --scenario", "scn empty", lambda file: [program("macsim"), "--mactalk", endpoint, "--scenario", file]
        yield "macsim --plant", "", lambda file: [program("macsim"), "--mactalk", endpoint, "--plant", file]
        yield "nanoplc-sim --plant", "", lambda file: [*sim, self.table, "--for", "20ms", "--plant", file]
        yield "midisim --eeprom", "none", lambda file: [program("midisim"), "--model", "MAC34-1", "--v24", endpoint,
                                                          "--eeprom", file]
        yield from ((f"nanoplc {name[0]}", "toml", lambda file, name=name: [program("nanoplc"), *name, file])
                    for name in (["check-config", "--no-devices"], ["wiring"], ["--config"]))
        yield "nanoplc table", "bin", lambda file: [program("nanoplc"), "check-config", self.with_table(file)]

    def with_table(self, table):
        return self.put("with_table.toml", f'[[axis]]\nname = "x"\ntable = "{table}"\n[axis.motor]\nport = "{self.line}"\n')

    def wrong(self):
        """What a file may be instead; by extension the right ones of all kinds, which are wrong for all others."""
        os.mkdir(self.path("folder"))
        os.mkfifo(self.path("pipe"))
        yield "a folder", self.path("folder")
        yield "none", self.path("none")
        yield "empty", self.put("empty", "")
        yield "a pipe without a writer", self.path("pipe")
        yield "no end", "/dev/zero"
        with open(self.path("huge"), "wb") as file:
            file.truncate(10_000_000_000)
        yield "10 GB", self.path("huge")
        yield "garbage", self.put("garbage", random.Random(1).randbytes(20_000))
        yield "lines of garbage", self.put("lines", "".join(f"{chr(33 + i % 90)};{i} \u00fc\n" for i in range(2000)))
        with open(SEQUENCE, "rb") as file:
            self.put("right.seq", file.read())
        self.put("right.stimulus", "dt_ms,inputs,inpos,error\n10,0,0,0\n")
        self.put("right.csv", "time_s,P_IST [counts]\n0,1\n1,2\n")
        self.put("right.toml", '[service]\nstate_directory = "/none"\n')
        self.put("right.flash", "# parameter flash of a virtual MAC140\n65 = 5\n")
        for extension in ("seq", "bin", "sym", "scn", "stimulus", "csv", "toml", "flash"):
            yield extension, self.path("right." + extension)

    def check(self, command, file):
        start = time.monotonic()
        with open(self.path("said"), "w+b") as said:
            process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=said)
            self.running.append(process)
            while True:
                pid, status, usage = os.wait4(process.pid, os.WNOHANG)
                if pid != 0:
                    break
                if time.monotonic() > start + MOST_SECONDS:
                    self.fail("it has no end")
                time.sleep(0.002)
            process.returncode = os.waitstatus_to_exitcode(status)
            said.seek(0)
            text = said.read().decode(errors="replace")
        self.assertGreater(process.returncode, 0, text)
        self.assertNotEqual(text, "")
        self.assertLess(usage.ru_maxrss, MOST_KIB)
        self.assertLess(len(text), 50_000)  # a hundred of the compiler's messages
        self.assertIn(os.path.basename(file), text)
        self.assertTrue(all(line.replace("\t", "").isprintable() for line in text.split("\n")), repr(text[:500]))
        if "error E" not in text:
            self.assertLessEqual(text.count("\n"), 25, text)

    def test_each_is_refused_in_words(self):
        wrong = list(self.wrong())
        for name, wants, command in self.readers():
            for kind, file in wrong:
                if kind in wants.split():
                    continue
                if os.path.exists(self.path("none")):
                    os.unlink(self.path("none"))
                with self.subTest(f"{name}: {kind}"):
                    self.check(command(file), file)


if __name__ == "__main__":
    BIN, SEQUENCE = sys.argv[1:]
    unittest.main(argv=sys.argv[:1])
