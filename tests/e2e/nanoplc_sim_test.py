#!/usr/bin/env python3
"""nanoplc-sim from the outside.

usage: nanoplc_sim_test.py PROGRAM
"""

import csv
import os
import re
import subprocess
import sys
import unittest

from folder_case import FolderCase

PROGRAM = ""
END = bytes([0x3F, 0, 0, 0, 0, 0, 0, 0])

# Step 0: at once to step 1 with OUT0 and a timer of 500 ms. Step 1: timer 0 and IN0 = 1: OUT1, step 2. Bytes by
# 001 sections 6.1.5 and 6.1.7.
TABLE = bytes([0xC0, 0x00, 0x00, 0x01, 0x80, 0x01, 0xF4, 0x01,
               0x41, 0x01, 0x01, 0x02, 0x80, 0x02, 0x00, 0x00]) + END
HEADER = "dt_ms,inputs,inpos,error\n"
TRACE_HEADER = "time_ms,step,timer,counter,inputs,outputs,inpos,error,command,p_ist,v_ist"


class Case(FolderCase):
    def setUp(self):
        super().setUp()
        self.table = self.put("t.bin", TABLE)

    def read(self, name):
        with open(self.path(name), encoding="ascii") as file:
            return file.read()

    def call(self, *arguments, stdin=b""):
        return subprocess.run([PROGRAM, *arguments], input=stdin, capture_output=True, check=False)

    def refused(self, *arguments, stdin=b"", says=""):
        done = self.call(*arguments, stdin=stdin)
        done.stdout, done.stderr = done.stdout.decode(), done.stderr.decode(errors="replace")
        self.refused_in_a_line(done, says)
        return done.stderr


class Scan(Case):
    def scan(self, rows, table=None):
        stimulus = self.put("s.csv", HEADER + rows)
        done = self.call("scan", table or self.table, "--stimulus", stimulus)
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        return done.stdout.decode()

    def test_prints_what_stands_after_each_scan(self):
        self.assertEqual(self.scan("10,0,0,0\n490,1,0,0\n5,1,0,0\n"),
                         "scan,step,timer,counter,outputs,fastmac,flexmac\n"
                         "1,1,490,0,1,,\n"
                         "2,1,0,0,1,,\n"
                         "3,2,0,0,2,,\n")

    def test_standard_input(self):
        done = self.call("scan", self.table, "--stimulus", "-", stdin=(HEADER + "10,0,0,0\n").encode())
        self.assertEqual(done.stdout.decode().splitlines()[1], "1,1,490,0,1,,")

    def test_bytes_after_the_end_term_are_ignored(self):
        table = self.put("more.bin", TABLE + b"rubbish")
        self.assertIn("1,1,490,0,1,,", self.scan("10,0,0,0\n", table))

    def test_another_file_is_no_empty_table(self):
        stimulus = self.put("s.csv", HEADER)
        for content in (b"\xff\xfe" + bytes(20) + b"a", b"?" * 7 + b"\x01" * 9, b"\xff\xfeP\0R\0O\0"):
            self.refused("run", self.put("t.bin", content), says="t.bin: ")
            self.refused("scan", self.path("t.bin"), "--stimulus", stimulus, says="t.bin: ")
        self.assertEqual(self.call("run", self.put("t.bin", b"\xff" * 64), "--for", "1ms").returncode, 0)  # erased flash

    def test_bad_tables(self):
        stimulus = self.put("s.csv", HEADER + "10,0,0,0\n")
        bad = {
            b"": "the file is empty",
            TABLE[:12]: "term 1 (byte 8)",
            TABLE[:16]: "term 2 (byte 16): the table has no end",
            bytes([0xC0, 0, 0, 0x3F, 0x80, 0, 0, 0]) + END: "term 0 (byte 0): NEXT_STATE is 3Fh",
            bytes([0xC0, 0, 0x80, 0x80, 0, 0, 0, 0]) + END: "REG_NMB is 0",
            bytes([0xC0, 0, 0, 0x3E, 0x80, 0, 0, 0]) * 1025 + END: "more than 1024 terms",
        }
        for content, says in bad.items():
            with self.subTest(says):
                table = self.put("bad.bin", content)
                self.refused("scan", table, "--stimulus", stimulus, says=says)
                self.assertIn("bad.bin", self.refused("scan", table, "--stimulus", stimulus))

    def test_bad_stimuli(self):
        bad = {
            "": "s.csv:1:",
            "dt_ms,inputs,inpos\n": "s.csv:1:",
            HEADER + "10,0,0,0\n10,64,0,0\n": "s.csv:3: inputs is \"64\"",
            HEADER + "10,0,0\n": "s.csv:2:",
            HEADER + "10,0,0,0,0\n": "s.csv:2:",
            HEADER + "-1,0,0,0\n": "dt_ms is \"-1\"",
            HEADER + "4294967296,0,0,0\n": "0 to 4294967295",
            HEADER + "1,0,0,2\n": "error is \"2\"",
            HEADER + "1,0,x,0\n": "inpos is \"x\"",
            HEADER + "1, 0,0,0\n": "inputs is \" 0\"",
            HEADER + "1,0,0,\0\n": "s.csv: cannot be read: it is no text, for it holds zeros",
        }
        for content, says in bad.items():
            with self.subTest(content):
                self.refused("scan", self.table, "--stimulus", self.put("s.csv", content), says=says)

    def test_files_that_are_not_there(self):
        stimulus = self.put("s.csv", HEADER)
        self.refused("scan", self.path("no.bin"), "--stimulus", stimulus, says="no.bin: cannot be opened")
        self.refused("scan", self.table, "--stimulus", self.path("no.csv"), says="no.csv: cannot be opened")
        self.refused("scan", self.folder.name, "--stimulus", stimulus, says="it is a folder")
        for name in ("x.seq", "X.SEQ"):
            self.refused("scan", self.put(name, "PROGRAM X"), "--stimulus", stimulus, says="source, not a table")

    def test_text_is_no_table(self):
        stimulus = self.put("s.csv", HEADER)
        for content in (SOURCE, "Täglich\r\n"):
            source = self.put("my.st", content)
            says = f"my.st: text, not a raw table; if it is a program's source, build the table first: seqc build {source}"
            self.refused("scan", source, "--stimulus", stimulus, says=says)
            self.refused("run", source, says=says)

    def test_blank_lines_at_the_end(self):
        whole = self.scan("10,0,0,0\n5,0,0,0\n")
        for end in ("", "\n\n", "\r\n\r\n", "\n \t\n\n "):
            self.assertEqual(self.scan("10,0,0,0\n5,0,0,0" + end), whole, repr(end))
        self.refused("scan", self.table, "--stimulus", self.put("s.csv", "\n\n"), says="s.csv:1: the header")


class CommandLine(Case):
    def test_help_names_the_exit_codes(self):
        for arguments in (["--help"], ["run", "--help"], ["scan", "--help"]):
            done = self.call(*arguments)
            self.assertEqual(done.returncode, 0)
            self.assertIn("Exit code: 0", done.stdout.decode())

    def test_mistakes(self):
        self.refused(says="see nanoplc-sim --help")
        self.refused("walk", says="see nanoplc-sim --help")
        self.refused("run", says="program")
        self.refused("scan", self.table, says="--stimulus")
        self.refused("run", self.table, "--nonsense", says="--nonsense")
        self.refused("run", self.table, self.table, says="see nanoplc-sim --help")
        self.refused("run", self.table, "--for", "5", says="such as 500ms, 5s or 2min")
        self.refused("run", self.table, "--for", "0s", says="--for \"0s\"")
        self.refused("run", self.table, "--for", "-5s", says="--for \"-5s\"")
        self.refused("run", self.table, "--for", says="--for")
        self.refused("run", self.table, "--motor", "MAC999", says="MAC141, MAC800, or of MIDI MAC23, MAC34-1 or MAC34-2")
        self.refused("run", self.table, "--drop", "1", says="--drop \"1\": write a share")
        self.refused("run", self.table, "--damage", "101%", says="--damage \"101%\"")
        self.refused("run", self.table, "--delay", "1%:5", says="--delay \"1%:5\"")
        self.refused("run", self.table, "--baud", "0", says="--baud \"0\"")
        self.refused("run", self.table, "--motor", "MAC34-1", "--baud", "1200", says="line has 9600, 19200 or 38400 baud")
        self.refused("run", self.table, "--seed", "x", says="--seed \"x\"")
        for address in ("0.0.0.0", "[::]", "192.168.1.2"):
            self.refused("run", self.table, "--realtime", "--panel", address + ":8080", says="write 127.0.0.1:8080; another machine")
        self.assertNotIn("password and a token", self.refused("run", self.table, "--realtime", "--panel", "0.0.0.0:8080"))
        self.refused("run", self.table, "--debounce", "2s", says="--debounce \"2s\"")


class Run(Case):
    def run_with(self, scenario, *more):
        return self.call("run", self.table, "--scenario", self.put("s.scn", scenario), *more)

    def test_timeline_and_summary(self):
        done = self.run_with("at 1 s IN0 := 1\nend at 2 s\nexpect step = 2\nexpect at 100 ms OUT0\n")
        text = done.stdout.decode()
        self.assertEqual(done.returncode, 0, text)
        self.assertNotIn("\033", text, "no colours off a terminal")
        self.assertIn("0 -> 1", text)
        self.assertIn("1000.000", text)
        self.assertIn("expectations: 2 passed, 0 failed", text)

    def test_a_failed_expectation_is_exit_code_1(self):
        done = self.run_with("end at 2 s\nexpect at 1 s step = 2\n")
        self.assertEqual(done.returncode, 1)
        self.assertIn("s.scn:2: expected: at 1 s step = 2; seen: at 1000.000 ms step = 1", done.stdout.decode())

    def test_a_run_that_ends_before_an_expectation_fails(self):
        done = self.run_with("expect at 1 s step = 1\n", "--for", "500ms")
        self.assertEqual(done.returncode, 1)
        self.assertIn("the run ended at 500.000 ms, before that time", done.stdout.decode())

    def test_a_gateway_that_starts_again_is_not_said_to_wait(self):
        done = self.run_with("at 2 s gateway restart\nend at 3 s\n")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn(b"waits for the motor", done.stdout)

    def test_a_stop_and_a_run_at_once_are_no_run_and_that_is_said(self):
        done = self.run_with("at 1 s gateway stop, gateway run\nend at 2 s\n")
        self.assertIn(b"gateway run: refused: ", done.stdout)

    def test_a_gateway_without_a_motor_is_said_to_wait_for_it(self):
        waits = b"the gateway waits for the motor, which does not answer"
        for missing in ("line cut", "motor power off"):
            done = self.run_with(f"{missing}\nend at 2 s\n")
            self.assertEqual(done.stdout.count(waits), 2, done.stdout)  # in the timeline and behind it
        for there in ("line restored", "line cut for 500 ms", "at 500 ms line cut"):
            self.assertNotIn(waits, self.run_with(f"{there}\nend at 2 s\n").stdout, there)
        done = self.run_with("end at 2 s\n", "--new")  # it waits for input
        self.assertNotIn(waits, done.stdout)

    def test_inputs_that_are_on_from_the_beginning(self):
        # IN0 and the 500 ms of the table's step 1 lead to step 2.
        done = self.run_with("expect IN0 and IN3 at 0 s\nexpect step = 2 at 1 s\nend at 2 s\n", "--inputs", "in0,IN3")
        self.assertEqual(done.returncode, 0, done.stdout)
        done = self.run_with("IN0 := 0\nexpect step = 1 at 1 s\nend at 2 s\n", "--inputs", "IN0")
        self.assertEqual(done.returncode, 0, "a scenario has the last word")
        self.refused("run", self.table, "--for", "1s", "--inputs", "IN6", says="has no input 'IN6'; its inputs are IN0, ")
        self.refused("run", self.table, "--for", "1s", "--inputs", "", says="--inputs")

    def test_the_earlier_end_counts(self):
        self.assertIn("ended at 300.000 ms", self.run_with("end at 2 s", "--for", "300ms").stdout.decode())
        self.assertIn("ended at 300.000 ms", self.run_with("end at 300 ms", "--for", "1s").stdout.decode())

    def test_mistakes_in_scenarios(self):
        bad = {
            "end at 1 s\nat 5 IN0 := 1\n": "s.scn:2:4: \"5 IN0\" is not a time",
            "end at 1 s\nexpect step = Idle\n": "s.scn:2:15: \"Idle\": this program has no step names",
            "at 1 s IN0 := 1\n": "s.scn: the scenario has no end",
            "end at 1 s\nwhen IN0 rises IN0 := 0\nwhen not IN0 IN0 := 1\n": "",
            "\x00\xff\n": "it is no text, for it holds zeros",
            "end at 1 s\nexpect " + "(" * 10000 + "IN0" + ")" * 10000 + "\n": "s.scn:2:108: parentheses and NOTs are more",
            "expect " + "not " * 40000 + "IN0\n": "s.scn:1:408: parentheses and NOTs are more",
        }
        for content, says in bad.items():
            with self.subTest(content):
                scenario = self.put("s.scn", content.encode("latin-1"))
                if says:
                    self.refused("run", self.table, "--scenario", scenario, says=says)
                else:
                    done = self.call("run", self.table, "--scenario", scenario)
                    self.assertEqual(done.returncode, 2)
                    self.assertIn(b"set each other off without end", done.stderr)
        self.refused("run", self.table, "--scenario", self.path("no.scn"), says="no.scn: cannot be opened")

    def test_all_mistakes_of_a_scenario_are_told(self):
        scenario = self.put("s.scn", "att 1 s IN0 := 1\nexpect stp = 3\nend at 1 s\nat 1 s pulze IN0 50 ms\n")
        done = self.call("run", self.table, "--scenario", scenario)
        self.assertEqual((done.returncode, done.stdout), (2, b""))
        places = [line.split(": ", 1)[0].rsplit("/", 1)[1] for line in done.stderr.decode().splitlines()]
        self.assertEqual(places, ["s.scn:1:1", "s.scn:2:8", "s.scn:4:8"])
        self.assertIn(b"did you mean pulse?", done.stderr)
        many = self.put("s.scn", "a=\n" * 1_000_000)
        done = self.call("run", self.table, "--scenario", many)
        self.assertEqual(done.stderr.count(b"\n"), 21)
        self.assertTrue(done.stderr.endswith(b"980 or more mistakes\n"), done.stderr)

    def test_trace_format(self):
        done = self.run_with("at 1003 ms IN0 := 1\nend at 2 s\n", "--trace", self.path("t.csv"))
        self.assertEqual(done.returncode, 0)
        lines = self.read("t.csv").splitlines()
        self.assertEqual(lines[0], TRACE_HEADER)
        rows = list(csv.DictReader(lines))
        times = [float(row["time_ms"]) for row in rows]
        self.assertEqual(times[0], 0)
        self.assertEqual(times[-1], 2000)
        for before, after in zip(times, times[1:]):
            self.assertGreaterEqual(after, before)
            self.assertLessEqual(after - before, 10.0005, "a row at least every 10 ms")
        for before, after in zip(lines[1:], lines[2:]):
            same = before.split(",")[1:] == after.split(",")[1:]
            gap = float(after.split(",")[0]) - float(before.split(",")[0])
            self.assertTrue(not same or gap > 9.999 or after == lines[-1], f"{before} and {after}")
        self.assertEqual([float(row["time_ms"]) for row in rows if row["inputs"] == "1"][0], 1003)
        # 3 ms of debouncing and a scan
        first = next(float(row["time_ms"]) for row in rows if row["step"] == "2")
        self.assertGreaterEqual(first, 1006)
        self.assertLessEqual(first, 1007)
        # The timer was set to 500 by the first scan and runs down to 0 by 1 each millisecond.
        self.assertEqual([int(row["timer"]) for row in rows if row["step"] == "1"][0], 500)
        timers = {int(row["timer"]) for row in rows}
        self.assertEqual(timers, set(range(0, 501)))

    def test_commands_in_the_trace(self):
        # NOP (60h) and register 65 := 300, once; 001 sections 6.1.7 and 6.1.8.
        self.table = self.put("c.bin", bytes([0xC0, 0, 0, 0x01, 0x60, 0, 0, 0, 0xC0, 0, 0x80, 65, 44, 1, 0, 0]) + END)
        self.run_with("end at 200 ms\n", "--trace", self.path("t.csv"))
        commands = [row["command"] for row in csv.DictReader(self.read("t.csv").splitlines()) if row["command"]]
        self.assertEqual(commands, ["60 65=300"])

    def test_orders_on_their_way_at_the_end_are_not_lost(self):
        # VELOCITY(V1) is mode 01, register 01000: 28h; 001 sections 5.2.1.4 and 6.1.7.
        self.table = self.put("c.bin", bytes([0xC0, 0, 0, 0x01, 0x28, 0, 0, 0]) + END)
        good = "the motor executed what was ordered, and nothing else\n"
        whole = self.call("run", self.table, "--for", "1s").stdout.decode()
        self.assertIn("\n" + good, whole)
        ordered = next(line for line in whole.splitlines() if "VELOCITY(V1)" in line).split()[0]
        # A byte takes 10 bits at 19200 baud, 521 us: 100 us after the order none of its has arrived.
        cut = self.call("run", self.table, "--for", f"{round(float(ordered) * 1000) + 100}us").stdout.decode()
        self.assertIn("still on their way: VELOCITY(V1)\napart from that " + good, cut)
        self.assertNotIn("not executed", cut)

    def test_the_program_decides_the_motor(self):
        steps = (b"STEP S: OWN ERROR; IF IN0 THEN NEXT := T; END_IF END_STEP\n"
                 b"STEP T: OWN ERROR; IF IN1 THEN NEXT := S; END_IF END_STEP\nEND_PROGRAM\n")
        for motor, model in ((b"MAC23", "MAC23"), (b"MAC34", "MAC34-1"), (b"MAC34_2", "MAC34-2"), (b"MAC141", "MAC141")):
            done = self.call("run", self.put("d.seq", b"PROGRAM P\nMOTOR " + motor + b";\n" + steps), "--for", "20ms", "--quiet")
            self.assertEqual(done.stderr, b"")
            self.assertIn(f" terms, {model}", done.stdout.decode().splitlines()[0])

    def test_another_motor_than_the_programs_is_told(self):
        program = self.put("d.seq", b"PROGRAM P\nMOTOR MAC34;\nSTEP S: OWN ERROR; IF IN0 THEN NEXT := T; END_IF END_STEP\n"
                             b"STEP T: OWN ERROR; IF IN1 THEN NEXT := S; END_IF END_STEP\nEND_PROGRAM\n")
        for motor in ("MAC34-1", "MAC34-2"):
            self.assertEqual(self.call("run", program, "--for", "20ms", "--motor", motor).stderr, b"")
        for motor in ("MAC140", "MAC23"):
            told = self.call("run", program, "--for", "20ms", "--motor", motor).stderr.decode()
            self.assertIn(f"was compiled for MAC34 and runs on {motor}; its register values may not fit", told)
        self.assertEqual(self.call("run", program, "--for", "20ms", "--midi", "can").returncode, 0)
        self.refused("run", program, "--rapid", says="of a JVL motor's line")
        self.refused("run", self.table, "--midi", "can", says="--midi without a MIDI drive")

    def test_the_last_line_has_the_unit_of_scale(self):
        # 4096 counts are a turn of a MAC140, 001 section 3.2; 3 turns are 15 mm.
        source = (b"PROGRAM P\nMOTOR MAC140;\n%sVAR_MOTOR Far AT P1 := 3 rev; Fast AT V1 := 600 rpm; Soft AT A1 := 10000 rpm/s; END_VAR\n"
                  b"POWER_UP INIT(Fast, Soft); NEXT := Away; END_POWER_UP\n"
                  b"STEP Away: OWN ERROR; ENTRY POSITION(Far); IF IN0 THEN STOP; NEXT := POWER_UP; END_IF END_STEP\nEND_PROGRAM\n")
        for scale, there in ((b"SCALE 1 rev = 5 mm;\n", "(3.000 rev, 15.000 mm)"), (b"", "(3.000 rev)")):
            told = self.call("run", self.put("d.seq", source % scale), "--for", "3s", "--quiet").stdout.decode()
            self.assertRegex(told, r"P_IST 1228[78] counts " + re.escape(there) + ", outputs")

    def test_vcd_begins_as_viewers_want_it(self):
        self.run_with("end at 100 ms\n", "--vcd", self.path("t.vcd"))
        text = self.read("t.vcd")
        self.assertIn("$timescale 1 us $end", text)
        self.assertIn("$enddefinitions $end\n#0\n", text)
        self.assertTrue(text.endswith("#100000\n"))

    def test_traces_that_cannot_be_written(self):
        for option in ("--trace", "--vcd"):
            self.refused("run", self.table, "--for", "1s", option, self.path("no/t"), says="no/t: cannot be written")
            self.refused("run", self.table, "--for", "1s", option, self.folder.name, says="it is a folder")

    def test_a_trace_never_lands_on_an_input(self):
        scenario = self.put("s.scn", "end at 1 s\n")
        os.symlink(self.table, self.path("symbolic.bin"))
        os.link(self.table, self.path("hard.bin"))
        around = os.path.join(self.folder.name, ".", "t.bin")
        for option in ("--trace", "--vcd"):
            for name in (self.table, around, self.path("symbolic.bin"), self.path("hard.bin")):
                with self.subTest(option=option, name=name):
                    self.refused("run", self.table, "--for", "1s", option, name, says="overwrite the program")
            self.refused("run", self.path("symbolic.bin"), "--for", "1s", option, self.table, says="overwrite the program")
            self.refused("run", self.table, "--scenario", scenario, option, scenario, says="overwrite the scenario")
            # A trace is gathered in NAME.part.
            part = self.put("k.part", TABLE)
            self.refused("run", part, "--for", "1s", option, self.path("k"), says="overwrite the program")
        with open(self.table, "rb") as file:
            self.assertEqual(file.read(), TABLE)
        self.assertEqual(self.read("s.scn"), "end at 1 s\n")

    def test_a_trace_needs_a_name(self):
        for option in ("--trace", "--vcd"):
            self.refused("run", self.table, "--for", "20ms", option, "-", says=f'{option} "-": this is no file')

    def test_two_traces_are_two_files(self):
        os.symlink(self.path("new"), self.path("dangling"))
        self.put("old", "old")
        for csv_name, vcd_name in (("new", "new"), ("new", "./new"), ("dangling", "new"), ("old", "old"),
                                   ("new", "new.part"), ("new.part", "new")):
            with self.subTest(csv=csv_name, vcd=vcd_name):
                self.refused("run", self.table, "--for", "1s", "--trace", self.path(csv_name), "--vcd",
                             self.path(vcd_name), says="name two files")
        self.assertEqual(sorted(os.listdir(self.folder.name)), ["dangling", "old", "t.bin"])
        self.assertEqual(self.call("run", self.table, "--for", "20ms", "--trace", "/dev/null", "--vcd",
                                   "/dev/null").returncode, 0)

    def test_a_link_to_a_trace_stays_a_link(self):
        os.symlink("new.csv", self.path("link.csv"))
        self.assertEqual(self.call("run", self.table, "--for", "20ms", "--trace", self.path("link.csv")).returncode, 0)
        self.assertTrue(os.path.islink(self.path("link.csv")))
        self.assertTrue(self.read("new.csv").startswith(TRACE_HEADER))

    def test_a_trace_is_written_whole_or_not_at_all(self):
        self.put("s.scn", "when IN0 rises IN0 := 0\nwhen not IN0 IN0 := 1\nend at 1 s\n")
        self.call("run", self.table, "--scenario", self.path("s.scn"), "--trace", self.path("t.csv"))
        self.assertEqual(sorted(os.listdir(self.folder.name)), ["s.scn", "t.bin"])

    def test_devices_are_written_directly(self):
        done = self.call("run", self.table, "--for", "20ms", "--quiet", "--trace", "/dev/stderr")
        self.assertEqual(done.returncode, 0)
        self.assertTrue(done.stderr.decode().startswith(TRACE_HEADER))

    def test_a_full_disk_is_told(self):
        with open("/dev/full", "wb") as full:
            done = subprocess.run([PROGRAM, "run", self.table, "--for", "1s"], stdout=full, stderr=subprocess.PIPE,
                                  check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn(b"standard output: cannot be written", done.stderr)

    def test_the_same_seed_gives_the_same_run(self):
        def output(seed):
            return self.call("run", self.table, "--for", "2s", "--drop", "5%", "--damage", "2%", "--delay", "2%:10ms",
                             "--seed", seed).stdout
        self.assertEqual(output("3"), output("3"))
        self.assertNotEqual(output("3"), output("4"))


SOURCE = """PROGRAM Blink
MOTOR MAC140;
VAR_INPUT Go AT %IX0.0 : BOOL; END_VAR
VAR_OUTPUT Lamp AT %QX0.0 : BOOL; END_VAR
ON ERROR NEXT := Fault;
POWER_UP NEXT := Off; END_POWER_UP
STEP Off: IF Go THEN NEXT := Lit; END_IF END_STEP
STEP Lit: OUT Lamp; IF NOT Go THEN NEXT := Off; END_IF END_STEP
STEP Fault: OWN ERROR; IF ANY ERROR AND Go THEN RESET_ERROR; NEXT := Off; END_IF END_STEP
END_PROGRAM
"""


class Source(Case):
    def test_a_source_runs_with_its_names(self):
        source = self.put("blink.seq", SOURCE)
        scenario = self.put("s.scn", "at 100 ms pulse Go 50 ms\nexpect Lamp within 10 ms after Go rises\n"
                                       "expect at 125 ms step = Lit\nexpect step = Off\nend at 1 s\n")
        done = self.call("run", source, "--scenario", scenario)
        self.assertEqual(done.returncode, 0, done.stdout.decode() + done.stderr.decode())
        self.assertIn("Off -> Lit\n", done.stdout.decode())

    def test_the_extension_is_read_without_case(self):
        done = self.call("run", self.put("BLINK.SEQ", SOURCE), "--for", "50ms")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("Off", done.stdout.decode())

    def test_mistakes_of_a_source_are_the_compilers(self):
        source = self.put("bad.seq", SOURCE.replace("NEXT := Lit", "NEXT := Lid"))
        done = self.call("run", source)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stdout, b"")
        self.assertIn("bad.seq:7:", done.stderr.decode())
        self.assertTrue(done.stderr.decode().endswith("bad.seq: 1 error, 0 warnings\n"))

    def test_many_mistakes_of_a_source_are_said_to_be_more(self):
        steps = "STEP S: IF Q THEN NEXT := Z; END_IF END_STEP\n" * 500
        done = self.call("run", self.put("bad.seq", "PROGRAM P\n" + steps + "END_PROGRAM\n"))
        self.assertEqual(done.returncode, 2)
        lines = done.stderr.decode().splitlines()[-2:]
        self.assertIn("there are more; only 100 are shown", lines[0])
        self.assertTrue(lines[1].endswith("bad.seq: 100 errors, 0 warnings"), lines[1])


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
