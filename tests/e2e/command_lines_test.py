#!/usr/bin/env python3
"""The programs' output on their command lines: help, guesses, completion, and that empty values are wrong usage; and how
they treat what their output leads to.

usage: command_lines_test.py BIN_FOLDER PROGRAM.seq
"""

import os
import subprocess
import sys
import unittest

from folder_case import FolderCase

BIN = SEQUENCE = ""


def call(program, *arguments, text=None):
    return subprocess.run([os.path.join(BIN, program), *arguments], input=text, stdin=None if text else subprocess.DEVNULL,
                          capture_output=True, check=False, text=True)


def completed(program, *words):
    script = f'source /dev/stdin; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _{program}; printf "%s\\n" "${{COMPREPLY[@]}}"'
    source = call(program, "completion", "bash").stdout
    return subprocess.run(["bash", "-c", script, "bash", program, *words], input=source, capture_output=True, text=True,
                          check=True).stdout.split()


class CommandLines(unittest.TestCase):
    def refused(self, *command, says):
        done = call(*command)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertIn(says, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)

    def test_what_may_have_been_meant(self):
        self.refused("seqc", "biuld", SEQUENCE, says="'biuld' is no command; did you mean 'build'?")
        self.refused("seqc", "build", SEQUENCE, "--symbls", "x", says="did you mean '--symbols'?")
        self.refused("seqc", says="a command is missing: build, check")
        self.refused("nanoplc-sim", "rum", SEQUENCE, says="did you mean 'run'?")
        self.refused("nanoctl", "upolad", says="did you mean 'upload'?")
        self.refused("macreg", "midi", "stauts", says="did you mean 'status'?")
        self.refused("seqc", "help", "biuld", says="did you mean 'build'?")

    def test_help_of_a_command(self):
        for program, *command in (("seqc",), ("seqc", "verify"), ("nanoplc-sim", "run"), ("macreg", "midi", "get"),
                                  ("nanoctl", "upload")):
            done = call(program, "help", *command)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertEqual(done.stdout, call(program, *command, "--help").stdout)

    def test_an_empty_value(self):
        for command in (("seqc", "build", SEQUENCE, "-o", ""), ("seqc", "verify", SEQUENCE, "--proof", ""),
                        ("seqc", "graph", SEQUENCE, "-o", ""), ("nanoplc-sim", "run", SEQUENCE, "--for", "1ms", "--trace", "")):
            self.refused(*command, says="its value is empty")

    def test_bash_completes(self):
        self.assertEqual(completed("seqc", "ve"), ["verify"])
        self.assertEqual(completed("seqc", "verify", "--ass"), ["--assume"])
        self.assertEqual(completed("seqc", "verify", "--assume", ""), ["driver", "any"])
        self.assertEqual(completed("seqc", "explain", "W00")[:2], ["W001", "W002"])
        self.assertEqual(completed("seqc", "help", "ve"), ["verify"])
        self.assertIn(SEQUENCE, completed("seqc", "check", SEQUENCE[:-2]))
        self.assertEqual(completed("nanoplc-sim", "run", "--scen"), ["--scenario"])
        self.assertIn(SEQUENCE, completed("nanoplc-sim", "run", SEQUENCE[:-2]))
        self.assertIn("MAC34-1", completed("nanoplc-sim", "run", "--motor", "MAC3"))

    def test_pages_are_written(self):
        for program in ("seqc", "nanoplc-sim"):
            self.assertIn(f"#compdef {program}", call(program, "completion", "zsh").stdout)
            self.assertIn(".SH COMMANDS", call(program, "man").stdout)


class Outputs(FolderCase):
    def test_who_has_seen_enough_is_no_mistake(self):
        table = self.path("t.bin")
        self.assertEqual(call("seqc", "build", SEQUENCE, "-o", table).returncode, 0)
        for command in (("macreg", "list"), ("macreg", "man"), ("nanoctl", "completion", "zsh"), ("seqc", "explain"),
                        ("seqc", "disasm", table)):
            for stderr in (subprocess.PIPE, subprocess.STDOUT):
                with self.subTest(f"{command} {stderr}"):
                    reading, writing = os.pipe()
                    os.close(reading)
                    done = subprocess.run([os.path.join(BIN, command[0]), *command[1:]], stdin=subprocess.DEVNULL, stdout=writing,
                                          stderr=stderr, check=False)
                    os.close(writing)
                    self.assertIn(done.returncode, (0, -13))  # of SIGPIPE, as cat would
                    self.assertFalse(done.stderr)

    def test_links_that_lead_in_a_circle(self):
        loop = self.path("loop")
        for command in (("seqc", "build", SEQUENCE, "-o", loop), ("seqc", "graph", SEQUENCE, "--format", "dot", "-o", loop),
                        ("seqc", "verify", SEQUENCE, "--proof", loop),
                        ("nanoplc-sim", "run", SEQUENCE, "--for", "1ms", "--trace", loop),
                        ("nanoplc-sim", "run", SEQUENCE, "--for", "1ms", "--flash", loop)):
            with self.subTest(command):
                if not os.path.islink(loop):
                    os.symlink("loop", loop)
                done = call(*command)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn(command[-1], done.stderr)
                self.assertTrue(os.path.islink(loop))

    def test_no_escape_characters_reach_the_terminal(self):
        bad = "\x1b[31mX\x07\u009b"

        def file(name, text):
            with open(self.path(name), "w", encoding="utf-8") as written:
                written.write(text)
            return self.path(name)

        with open(SEQUENCE, encoding="utf-8") as sequence:
            program = sequence.read()
        sim = ("nanoplc-sim", "run", SEQUENCE, "--for", "1ms")
        for command in (
                ("seqc", "check", self.path(bad + ".seq")), ("seqc", "check", file("x" + bad + ".seq", "x")), ("seqc", bad),
                ("seqc", "build", file("y" + bad + ".seq", program)), ("seqc", "check", file("e.seq", f"PROGRAM P // {bad}\n{bad}")),
                ("seqc", "explain", bad), ("seqc", "graph", SEQUENCE, "--format", bad),
                ("seqc", "verify", SEQUENCE, "--property", file("e.prop", f"PROPERTY A{bad}: NEVER Start;")),
                (*sim, "--scenario", file("a.scn", f'at 1 us log "{bad}"\nend at 1 ms\n')),
                (*sim, "--scenario", file("b.scn", f'expect "{bad}"\n')), (*sim, "--scenario", file("c.scn", f'motor plant "{bad}"\n')),
                ("nanoplc-sim", "run", file("z" + bad + ".seq", program), "--for", "1ms"), (*sim, "--inputs", bad),
                (*sim, "--trace", self.path(bad) + "/x"), ("nanoplc-sim", "run", SEQUENCE, "--for", bad),
                ("macreg", "plot", file("e.csv", f"time_s,A\n0,{bad}\n"), "-o", self.path("o.svg")), ("macreg", "list", bad),
                ("macreg", "diff", file("e.txt", bad), "x"), ("macreg", "monitor", "--replay", file("e.hex", bad)),
                ("macsim", "--mactalk", bad), ("midisim", "--v24", bad), ("nanoctl", "--port", bad, "status")):
            with self.subTest(command):
                done = call(*command)
                for character in "\x1b\x07\u009b":
                    self.assertNotIn(character, done.stdout + done.stderr)

    def test_long_files_take_no_memory(self):
        """100 MB of commas, of which 200 MB and more were held. A forked Python counts as some 46 MiB."""
        commas = self.path("commas")
        with open(commas, "wb") as written:
            for _ in range(100):
                written.write(b"," * 1_000_000)
        for command in (("macreg", "monitor", "--replay", commas), ("macreg", "plot", commas, "-o", self.path("o.svg")),
                        ("macreg", "fit", commas)):
            with self.subTest(command), subprocess.Popen([os.path.join(BIN, command[0]), *command[1:]], stdout=subprocess.DEVNULL,
                                                         stderr=subprocess.DEVNULL) as process:
                _, status, usage = os.wait4(process.pid, 0)
                process.returncode = os.waitstatus_to_exitcode(status)
                self.assertEqual(process.returncode, 2)
                self.assertLess(usage.ru_maxrss, 64 * 1024)


if __name__ == "__main__":
    BIN, SEQUENCE = sys.argv[1:]
    unittest.main(argv=sys.argv[:1])
