#!/usr/bin/env python3
"""What the programs say of their command lines: help, guesses, completion, and that empty values are wrong usage.

usage: command_lines_test.py BIN_FOLDER PROGRAM.seq
"""

import os
import subprocess
import sys
import unittest

BIN = SEQUENCE = ""


def call(program, *arguments, text=None):
    return subprocess.run([os.path.join(BIN, program), *arguments], input=text, stdin=None if text else subprocess.DEVNULL,
                          capture_output=True, check=False, text=True, timeout=120)


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


if __name__ == "__main__":
    BIN, SEQUENCE = sys.argv[1:]
    unittest.main(argv=sys.argv[:1])
