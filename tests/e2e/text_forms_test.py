#!/usr/bin/env python3
"""Every reader of text takes what editors and spreadsheets make of a file, and names UTF-16.

usage: text_forms_test.py BIN_FOLDER PLOT_TRACE PROGRAM.seq
"""

import os
import re
import shutil
import subprocess
import sys
import unittest

from folder_case import FolderCase

BIN = PLOT_TRACE = SEQUENCE = ""
AXIS = 'motor = "MAC140"\n\n[plant]\ninertia = 4.21e-05  # kg m2\n'
PARAMETERS = "model = MAC140\nP_SOLL = 5\nincomplete = one\n"
CSV = ("stimulus", "recording", "path", "trace")


def blank_rows(text):
    return "\n".join(line + "\n , ,,\n" if line and number > 0 else line for number, line in enumerate(text.split("\n")))


FORMS = {
    "a byte order mark": lambda text: b"\xef\xbb\xbf" + text.encode(),
    "CR LF": lambda text: text.replace("\n", "\r\n").encode(),
    "CR alone": lambda text: text.replace("\n", "\r").encode(),
    "1Ah at the end": lambda text: text.encode() + b"\x1a",
    "all of Windows": lambda text: b"\xef\xbb\xbf" + text.replace("\n", "\r\n").encode() + b"\x1a",
    "blank lines at the end": lambda text: text.encode() + b"\n \n\n",
}
UTF16 = {
    "UTF-16": lambda text: text.encode("utf-16"),
    "UTF-16, high byte first": lambda text: b"\xfe\xff" + text.encode("utf-16-be"),
    "UTF-16 without a mark": lambda text: text.encode("utf-16-le"),
}


class TextForms(FolderCase):
    def setUp(self):
        super().setUp()
        self.table = self.path("t.bin")
        shutil.copy(SEQUENCE, self.path("p.seq"))
        self.run_well("seqc", "build", self.path("p.seq"), "-o", self.table)
        self.run_well("seqc", "build", self.path("p.seq"), "-o", self.path("t.hex"))
        self.run_well("nanoplc-sim", "run", self.table, "--for", "100ms", "--trace", self.path("t.csv"))

    def run_program(self, program, *arguments):
        if program != PLOT_TRACE:
            program = os.path.join(BIN, program)
        return subprocess.run([program, *arguments], stdin=subprocess.DEVNULL, capture_output=True, check=False)

    def run_well(self, *command):
        done = self.run_program(*command)
        self.assertEqual(done.returncode, 0, done.stderr)

    def text_of(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return file.read()

    def readers(self):
        """A kind of text, one that is right, and who reads it."""
        program, names, table = self.text_of("p.seq"), self.text_of("t.sym"), self.text_of("t.hex")
        sim = ("nanoplc-sim", "run")
        yield "x.seq", program, lambda file: ("seqc", "check", file)
        yield "x.seq", program, lambda file: ("seqc", "fmt", file)
        yield "x.seq", program, lambda file: (*sim, file, "--for", "100ms")
        yield "x.hex", table, lambda file: ("seqc", "disasm", file)
        yield "x.hex", table, lambda file: (*sim, file, "--for", "100ms")
        yield "x.sym", names, lambda file: ("seqc", "disasm", self.table, "--symbols", file)
        yield "x.sym", names, lambda file: (*sim, self.table, "--for", "100ms", "--symbols", file)
        yield "x.prop", "PROPERTY A:\n  STEP = 1 IS REACHABLE;\n", lambda file: ("seqc", "verify", self.table, "--property", file)
        yield "x.scn", "# one\nat 10 ms Start := 1\nend at 50 ms\n", lambda file: (*sim, self.table, "--scenario", file)
        yield "x.toml", AXIS, lambda file: (*sim, self.table, "--for", "50ms", "--plant", file)
        yield "x.stimulus", "dt_ms,inputs,inpos,error\n10,0,0,0\n5,1,0,0\n", lambda file: (
            "nanoplc-sim", "scan", self.table, "--stimulus", file)
        yield "x.params", PARAMETERS, lambda file: ("macreg", "diff", "--partial", file, self.put("same.params", PARAMETERS))
        yield "x.recording", "time_s,P_IST [counts]\n0,1\n1,2\n", lambda file: ("macreg", "plot", file, "-o", self.path("o.svg"))
        yield "x.path", "time,0 [inc]\n0,0\n1,500\n", lambda file: ("macreg", "midi", "path", "--check", file)
        yield "x.bytes", "50 50 50 08 F7 # one\n52 52 52\n", lambda file: ("macreg", "monitor", "--replay", file)
        yield "x.trace", self.text_of("t.csv"), lambda file: (PLOT_TRACE, file, "-o", self.path("o.svg"))
        if os.path.exists(os.path.join(BIN, "nanoplc")):
            yield "x.toml", '[service]\nstate_directory = "/none"\n', lambda file: ("nanoplc", "check-config", "--no-devices", file)

    def outcome(self, name, content, command):
        done = self.run_program(*command(self.put(name, content)))
        return done.returncode, re.sub(rb"\d+ pixels", b"", done.stdout), done.stderr

    def test_each_is_taken_by_every_reader(self):
        for name, text, command in self.readers():
            wanted = self.outcome(name, text, command)
            forms = dict(FORMS)
            if name.split(".")[1] in CSV:
                forms["rows of commas"] = lambda text: blank_rows(text).encode()
            for form, made in forms.items():
                with self.subTest(f"{command(name)}: {form}"):
                    self.assertEqual(self.outcome(name, made(text), command), wanted)

    def test_utf16_is_named_by_every_reader(self):
        for name, text, command in self.readers():
            for form, made in UTF16.items():
                with self.subTest(f"{command(name)}: {form}"):
                    code, _, said = self.outcome(name, made(text), command)
                    self.assertEqual(code, 2)
                    if name == "x.trace" and form.endswith("mark"):
                        self.assertIn(b"zeros", said)
                    else:
                        self.assertIn(b"UTF-16", said)

    def test_text_under_a_tables_name(self):
        # A table would end at '?', whose code is 63.
        for content in ("PROGRAM P", "PROGRAM P".encode("utf-16"), "?ROGRAM P".encode("utf-16-le"), "?ROGRAM P".encode("utf-16-be"),
                        "?\u4e2d\u6587\n".encode("utf-16-le") * 4, "?\u4e2d\u6587\n".encode("utf-16-be") * 4, "\u4e2d\u6587\n".encode("utf-16")):
            for command in (("seqc", "disasm"), ("nanoplc-sim", "run")):
                with self.subTest(f"{command} {content}"):
                    code, _, said = self.outcome("x.bin", content, lambda file, command=command: (*command, file))
                    self.assertEqual(code, 2)
                    self.assertIn(b"text in UTF-16" if isinstance(content, bytes) else b"text", said)
                    self.assertIn(b".seq", said)

    def test_an_empty_table_is_told(self):
        """By the manual STATE 63 ends a table; bits 7 and 6 and what follows do not matter."""
        for content in (b"\x3f" + 7 * b"\0", 8 * b"\xff", b"\xff\xfe" + 6 * b"\0"):
            for command in (("seqc", "disasm"), ("seqc", "verify"), ("nanoplc-sim", "run", "--for", "100ms")):
                with self.subTest(f"{command} {content}"):
                    code, _, said = self.outcome("x.bin", content, lambda file, command=command: (*command, file))
                    self.assertEqual(code, 0)
                    self.assertIn(b"x.bin: the table is empty: nothing will happen", said)

    def test_fmt_takes_a_mark_and_cr_lf_away(self):
        file = self.path("p.seq")
        self.run_well("seqc", "fmt", "-i", file)
        formatted = self.text_of("p.seq")
        self.put("p.seq", b"\xef\xbb\xbf" + formatted.replace("\n", "\r\n").encode())
        self.assertEqual(self.run_program("seqc", "fmt", "--check", file).returncode, 1)
        self.run_well("seqc", "fmt", "-i", file)
        self.assertEqual(self.text_of("p.seq"), formatted)


if __name__ == "__main__":
    BIN, PLOT_TRACE, SEQUENCE = sys.argv[1:]
    unittest.main(argv=sys.argv[:1])
