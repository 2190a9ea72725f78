#!/usr/bin/env python3
"""A program, its table in both formats and its symbols, from seqc to nanoplc-sim.

usage: symbols_test.py SEQC NANOPLC_SIM
"""

import json
import os
import subprocess
import sys
import unittest
import zlib

from folder_case import FolderCase

SEQC = ""
SIM = ""

SOURCE = """PROGRAM Blink
MOTOR MAC141;
VAR_INPUT Go AT %IX0.0 : BOOL; END_VAR
VAR_OUTPUT Lamp AT %QX0.0 : BOOL; END_VAR
VAR_MOTOR Fast AT V1 := 600 rpm; END_VAR
ON ERROR NEXT := Fault;
POWER_UP INIT(Fast); NEXT := Dark; END_POWER_UP
STEP Dark: IF Go THEN NEXT := Lit; END_IF END_STEP
STEP Lit: OUT Lamp; IF NOT Go THEN NEXT := Dark; END_IF END_STEP
STEP Fault: OWN ERROR; IF ANY ERROR AND Go THEN RESET_ERROR; NEXT := Dark; END_IF END_STEP
END_PROGRAM
"""
SCENARIO = """at 100 ms pulse Go 50 ms
expect Lamp within 10 ms after Go rises
expect at 125 ms step = Lit
expect step = Dark
end at 300 ms
"""


class Case(FolderCase):
    def setUp(self):
        super().setUp()
        self.put("blink.seq", SOURCE)
        self.put("blink.scn", SCENARIO)

    def read(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def call(self, *command):
        return subprocess.run(command, cwd=self.folder.name, capture_output=True, text=True, check=False)

    def build(self, *options):
        done = self.call(SEQC, "build", "blink.seq", *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def run_sim(self, program, *options):
        return self.call(SIM, "run", program, "--scenario", "blink.scn", *options)

    def runs(self, program, *options):
        done = self.run_sim(program, *options)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done

    def refused(self, program, *options, says, lines=1):
        done = self.run_sim(program, *options)
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        self.assertEqual(done.stderr.count("\n"), lines, done.stderr)
        self.assertIn(says, done.stderr)


GUARDED = """PROGRAM Guarded
MOTOR MAC140;
VAR_INPUT Start AT IN0 : BOOL; Estop AT NOT IN2 : BOOL; END_VAR
VAR_OUTPUT Run AT OUT0 : BOOL; Alarm AT OUT1 : BOOL; END_VAR
ON ERROR NEXT := Stopped;
ON Estop NEXT := Stopped;
STEP Idle: IF Start THEN NEXT := Work; END_IF END_STEP
STEP Work: OUT Run; IF NOT Start THEN NEXT := Idle; END_IF END_STEP
STEP Stopped: OWN ERROR; OUT Alarm; IF ANY ERROR AND F_TRIG(Estop) THEN RESET_ERROR; NEXT := Idle; END_IF END_STEP
PROPERTY Safe: NEVER Estop AND Run;
PROPERTY Never_Alarm: NEVER NOT Estop AND Alarm AND NOT ERROR;
END_PROGRAM
"""
GUARDED_SCENARIO = """at 0 s Estop := 0
at 100 ms Start := 1
expect at 150 ms step = Work and Run and not Estop and IN2
at 200 ms Estop := 1
expect at 250 ms step = Stopped and Estop and Alarm and not IN2
at 270 ms Start := 0
at 300 ms IN2 := 1
expect at 350 ms step = Idle and Estop = 0
end at 400 ms
"""


class InvertedInput(Case):
    """Estop AT NOT IN2: the name goes by its sense, IN2 is the wire."""

    def setUp(self):
        super().setUp()
        self.put("blink.seq", GUARDED)
        self.put("blink.scn", GUARDED_SCENARIO)

    def test_names_go_by_their_sense(self):
        self.build("-o", "t.bin")
        for program in ("blink.seq", "t.bin"):
            with self.subTest(program):
                done = self.runs(program, "--trace", "t.csv", "--vcd", "t.vcd")
                events = [event for event in ("Estop off", "Estop on") if event in done.stdout]
                self.assertEqual(events, ["Estop off", "Estop on"])
                columns = [line.split(",") for line in self.read("t.csv").decode().splitlines()[1:]]
                wires = [[int(row[4]) & 4 for row in columns if float(row[0]) <= time][-1] for time in (150, 250, 350)]
                self.assertEqual(wires, [4, 0, 4], "the trace has the wires")
                self.assertEqual(json.loads(self.read("t.csv.sym"))["inverted_inputs"], [2])

    def test_a_terminal_that_is_on_from_the_beginning(self):
        self.put("blink.scn", "expect at 50 ms not Estop and IN2\nend at 60 ms\n")
        self.runs("blink.seq", "--inputs", "IN2")
        self.put("blink.scn", "expect at 50 ms Estop and not IN2\nend at 60 ms\n")
        self.runs("blink.seq", "--inputs", "Estop")

    def test_what_verify_writes_plays(self):
        done = self.call(SEQC, "verify", "blink.seq", "--scenario", "found.scn")
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertRegex(done.stdout, r"proved +Safe: NEVER Estop AND Run")
        self.assertRegex(done.stdout, r"broken +Never_Alarm: ")
        found = self.read("found.scn").decode()
        self.assertRegex(found, r"(?m)^.*Estop := [01]")
        played = self.call(SIM, "run", "blink.seq", "--scenario", "found.scn", "--quiet")
        self.assertEqual(played.returncode, 0, found + played.stdout + played.stderr)

    def test_the_table_comes_back(self):
        self.build("-o", "t.bin")
        with open(self.path("back.seq"), "w", encoding="utf-8") as file:
            file.write(self.call(SEQC, "decompile", "t.bin").stdout)
        back = self.read("back.seq").decode()
        self.assertIn("Estop AT NOT IN2 : BOOL;", back)
        done = self.call(SEQC, "diff", "t.bin", "back.seq")
        self.assertIn("the same bytes", done.stdout, back)


class Names(Case):
    def test_a_table_with_its_symbols_runs_as_its_source(self):
        self.build("-o", "t.bin")
        self.build("-o", "u.hex")
        source = self.runs("blink.seq", "--trace", "s.csv", "--vcd", "s.vcd")
        self.assertIn("Dark -> Lit", source.stdout)
        self.assertIn(", MAC141, ", source.stdout)
        for table in ("t.bin", "u.hex"):
            with self.subTest(table):
                done = self.runs(table, "--trace", "s.csv", "--vcd", "t.vcd")
                self.assertEqual(done.stderr, "")
                head, rest = done.stdout.split("\n", 1)
                source_head, source_rest = source.stdout.split("\n", 1)
                self.assertEqual(rest, source_rest.replace("s.vcd", "t.vcd"))
                symbols = table[0] + ".sym"
                self.assertEqual(head, source_head.replace("blink.seq", table) + f", names from {symbols}")
                self.assertEqual(self.read("t.vcd"), self.read("s.vcd"))

    def test_symbols_by_name(self):
        self.build("-o", "t.bin", "--symbols", "names.json")
        self.assertFalse(os.path.exists(self.path("t.sym")))
        self.refused("t.bin", says="blink.scn:1:17: ", lines=4)
        self.runs("t.bin", "--symbols", "names.json")
        self.refused("t.bin", "--symbols", "no.sym", says="no.sym: cannot be opened")
        self.refused("t.bin", "--symbols", "blink.scn", says="blink.scn: this is not JSON, from line 1, column 1 on")
        self.refused("blink.seq", "--symbols", "names.json", says="a source brings its own names")

    def test_symbols_of_another_table_are_left_out(self):
        self.build("-o", "t.bin")
        # A term of step 40, which nothing leads to, in front of the end term.
        table = self.read("t.bin")
        self.put("t.bin", table[:-8] + bytes([0xE8, 0, 0, 0x3E, 0x80, 0, 0, 0]) + table[-8:])
        done = self.call(SIM, "run", "t.bin", "--for", "50ms")
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stderr, r"^t\.sym: it belongs to another table \(.*\); names are left out\n$")
        self.assertIn("0 -> 1", done.stdout)
        self.assertIn(", MAC140, ", done.stdout)
        self.refused("t.bin", "--symbols", "t.sym", says="t.sym: it belongs to another table")

    def test_bytes_after_the_end_do_not_matter(self):
        self.build("-o", "t.bin")
        self.put("t.bin", self.read("t.bin") + b"rubbish")
        self.assertIn("Dark -> Lit", self.runs("t.bin").stdout)

    def test_a_broken_symbol_file_is_no_symbol_file(self):
        self.build("-o", "t.bin")
        whole = json.loads(self.read("t.sym"))
        whole["steps"][1]["name"] = "\x1b[2J"
        for content in (b"", b"\x00", json.dumps(whole)):
            self.put("t.sym", content)
            done = self.call(SIM, "run", "t.bin", "--for", "50ms")
            self.assertEqual(done.returncode, 0)
            self.assertRegex(done.stderr, r"^t\.sym: .*; names are left out\n$")
            self.assertNotIn("\x1b", done.stdout + done.stderr)

    def test_the_motor_of_the_command_line_counts(self):
        self.build("-o", "t.bin")
        done = self.runs("t.bin", "--motor", "MAC140")
        self.assertIn("t.bin: was compiled for MAC141 and runs on MAC140", done.stderr)

    def test_a_trace_never_lands_on_the_symbols(self):
        self.build("-o", "t.bin")
        before = self.read("t.sym")
        self.refused("t.bin", "--trace", "t.sym", says="overwrite the symbol file")
        self.refused("t.bin", "--vcd", "./t.sym", says="overwrite the symbol file")
        self.assertEqual(self.read("t.sym"), before)


class Traces(Case):
    def test_the_crc_is_zlibs(self):
        self.build("-o", "t.bin")
        crc = f"{zlib.crc32(self.read('t.bin')):08X}"
        self.assertEqual(json.loads(self.read("t.sym"))["table"]["crc32"], crc)
        self.runs("t.bin", "--vcd", "t.vcd")
        self.assertIn(f"$comment program Blink, table CRC-32 {crc} $end\n".encode(), self.read("t.vcd"))
        os.remove(self.path("t.sym"))
        self.assertEqual(self.call(SIM, "run", "t.bin", "--for", "20ms", "--vcd", "t.vcd").returncode, 0)
        self.assertIn(f"$comment table CRC-32 {crc} $end\n".encode(), self.read("t.vcd"))

    def test_the_csv_knows_numbers_only(self):
        self.build("-o", "t.bin")
        self.runs("t.bin", "--trace", "t.csv")
        self.assertTrue(self.read("t.csv").startswith(
            b"time_ms,step,timer,counter,inputs,outputs,inpos,error,command,p_ist,v_ist\n"))
        self.assertNotIn(b"Lit", self.read("t.csv"))


class IntelHex(Case):
    def scan(self, table):
        self.put("s.csv", "dt_ms,inputs,inpos,error\n10,0,0,0\n10,1,0,0\n10,0,0,0\n")
        return self.call(SIM, "scan", table, "--stimulus", "s.csv")

    def test_scan_takes_it(self):
        self.build("-o", "t.bin")
        self.build("-o", "t.hex", "--base-address", "0x08010000")
        raw, text = self.scan("t.bin"), self.scan("t.hex")
        self.assertEqual((raw.returncode, raw.stderr), (0, ""))
        self.assertEqual(text.stdout, raw.stdout)
        # Known by its first line, too.
        os.rename(self.path("t.hex"), self.path("t.dat"))
        self.assertEqual(self.scan("t.dat").stdout, raw.stdout)

    def test_mistakes(self):
        self.build("-o", "t.hex")
        good = self.read("t.hex").decode()
        lines = good.splitlines(keepends=True)
        bad = {
            good.replace(lines[1], lines[1][:-2] + "x\n"): "t.hex:2: character 43 is no hex digit",
            "".join(lines[:1] + lines[2:]): "t.hex:2: nothing says what stands at 10h..1Fh",
            "".join(lines[:-1]): "t.hex:%d: the end record (:00000001FF) is missing" % (len(lines) - 1),
            "".join(lines[:-2] + lines[-1:]): "t.hex: term ",
            SOURCE: "t.hex:1: a record begins with ':'",
            "": "t.hex: the file is empty",
        }
        for content, says in bad.items():
            with self.subTest(says):
                self.put("t.hex", content)
                done = self.scan("t.hex")
                self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
                self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
                self.assertIn(says, done.stderr)
                self.refused("t.hex", says=says)


if __name__ == "__main__":
    SEQC, SIM = os.path.abspath(sys.argv.pop(1)), os.path.abspath(sys.argv.pop(1))
    unittest.main()
