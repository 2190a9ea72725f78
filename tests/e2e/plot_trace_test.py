#!/usr/bin/env python3
"""tools/plot_trace: names and units of the program, short steps, kinds of pictures, symbols that do not belong to a trace.

usage: plot_trace_test.py SEQC NANOPLC_SIM ROOT
"""

import json
import os
import random
import re
import subprocess
import sys
import unittest

from folder_case import FolderCase

SEQC = NANOPLC_SIM = ROOT = ""
HEADER = "time_ms,step,timer,counter,inputs,outputs,inpos,error,command,p_ist,v_ist\n"
SEED = 5


def example(name):
    return os.path.join(ROOT, "tools/sequence/examples", name)


class PlotTrace(FolderCase):
    def run_program(self, *command):
        return subprocess.run(command, capture_output=True, text=True, check=False, cwd=self.folder.name)

    def plot(self, *words):
        return self.run_program(sys.executable, "-B", os.path.join(ROOT, "tools/plot_trace"), *words)

    def read(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return file.read()

    def traced(self, name, trace, *more):
        done = self.run_program(NANOPLC_SIM, "run", example(name + ".seq"), "--scenario", example(name + ".scn"), "--quiet",
                                "--trace", trace, *more)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def refused(self, words, *said):
        done = self.plot(*words)
        self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), done.stderr)
        for text in said:
            self.assertIn(text, done.stderr)
        self.assertFalse(os.path.exists(self.path(words[words.index("-o") + 1])))

    def test_control_characters_of_inputs_do_not_reach_the_terminal(self):
        self.put("bad.csv", "no trace")
        self.put("t.csv", HEADER + "0,0,0,0,0,0,0,0,P1=8,0,0\n1,1,0,0,0,0,0,0,,0,0\n")
        symbols = {"format": "nanoplc-symbols", "version": 1, "program": "\x1b[31mRED\u009b1m", "table": {"crc32": "\x1b1"},
                   "steps": [{"number": 0, "name": "\x1b[2JA"}], "inputs": ["\x1b]0;a\x07"], "outputs": [], "registers": [], "motor": "MAC140"}
        self.put("s.sym", json.dumps(symbols))
        odd = "\x1b[31mred\n\u009b\x7f"
        self.put(odd + ".csv", "no trace")
        self.put(odd + ".sym", "{")
        self.put("deep.sym", "[" * 100_000)
        for words in (["bad.csv", "--sym", "s.sym"], ["t.csv", "--sym", "s.sym"], [odd + ".csv"], ["gone" + odd], ["t.csv", "--sym", odd + ".sym"],
                      ["t.csv", "--sym", "deep.sym"], ["t.csv", odd]):
            done = self.plot(*words, "-o", "t.svg")
            self.assertEqual(done.returncode, 2, words)
            self.assertNotRegex(done.stderr, "[\x00-\x08\x0b-\x1f\x7f-\x9f]")
            self.assertNotIn("Traceback", done.stderr)
        for output in (odd + ".svgx", odd + "/t.svg"):
            done = self.plot("t.csv", "-o", output)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertNotRegex(done.stderr, "[\x00-\x08\x0b-\x1f\x7f-\x9f]")

    def test_a_picture_holds_no_control_characters(self):
        self.put("t.csv", HEADER + "0,0,0,0,0,0,0,0,,0,0\n1,1,0,0,0,0,0,0,,0,0\n")
        done = self.plot("t.csv", "-o", "t.svg", "--title", "a\x1b[31m", "--steps", "A\x07,B\u0085", "--names", "IN0=C\x01")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("a?[31m", self.read("t.svg"))
        self.assertNotRegex(self.read("t.svg"), "[\x00-\x08\x0b-\x1f\x7f-\x9f]")

    def test_a_run_leaves_names_and_units(self):
        self.traced("pick_and_place", "t.csv")
        symbols = json.loads(self.read("t.csv.sym"))
        self.assertEqual((symbols["program"], symbols["trace"]["counts_per_rev"]), ("PickAndPlace", 4096))
        self.assertEqual(self.plot("t.csv", "-o", "t.svg").returncode, 0)
        texts = re.findall(r">([^<]*)</text>", self.read("t.svg"))
        for text in ("Travel", "POWER_UP", "Cleared", "Start", "Grip", "mm", "mm/s", "60", "1 s"):
            self.assertIn(text, texts)
        self.assertTrue({"IN0", "OUT0", "2", "counts"}.isdisjoint(texts))

    def test_an_inverted_input_is_drawn_as_its_wire(self):
        self.put("e.seq", "PROGRAM E MOTOR MAC140; VAR_INPUT Estop AT NOT IN2; END_VAR STEP A: OWN ERROR; IF Estop THEN NEXT := POWER_UP; "
                          "END_IF END_STEP END_PROGRAM\n")
        done = self.run_program(NANOPLC_SIM, "run", "e.seq", "--for", "100ms", "--inputs", "IN2", "--quiet", "--trace", "t.csv")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.plot("t.csv", "-o", "t.svg").returncode, 0)
        texts = re.findall(r">([^<]*)</text>", self.read("t.svg"))
        self.assertIn("NOT Estop", texts)
        self.assertNotIn("Estop", texts)

    def test_a_step_that_blinks_is_one_box(self):
        self.put("b.seq", """PROGRAM Blink
MOTOR MAC140;
VAR_INPUT Start AT IN0 : BOOL; END_VAR
VAR_OUTPUT Lamp AT OUT0 : BOOL; END_VAR
POWER_UP NEXT := Idle; END_POWER_UP
STEP Idle: OWN ERROR; OUT Lamp BLINKING 100 ms; IF R_TRIG(Start) THEN NEXT := Work; END_IF END_STEP
STEP Work: OWN ERROR; IF NOT Start THEN NEXT := Idle; END_IF END_STEP
END_PROGRAM
""")
        self.put("b.scn", "at 1200 ms Start := 1\nend at 2 s\n")
        done = self.run_program(NANOPLC_SIM, "run", "b.seq", "--scenario", "b.scn", "--quiet", "--trace", "b.csv")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(self.plot("b.csv", "-o", "b.svg").returncode, 0)
        texts = re.findall(r">([^<]*)</text>", self.read("b.svg"))
        self.assertEqual((texts.count("Idle"), texts.count("Work")), (1, 1), texts)

    def test_a_step_of_a_later_call_is_a_box_of_its_own(self):
        self.put("c.seq", """PROGRAM Twice
MOTOR MAC140;
SEQUENCE Rest(VAR_INPUT Held)
    STEP Wait: OWN ERROR; ENTRY TIMER := T#200ms; IF TIMER.Q AND NOT Held THEN RETURN; END_IF END_STEP
END_SEQUENCE
POWER_UP NEXT := One; END_POWER_UP
STEP One: OWN ERROR; CALL Rest(IN0); NEXT := Two; END_STEP
STEP Two: OWN ERROR; CALL Rest(IN0); NEXT := One; END_STEP
END_PROGRAM
""")
        done = self.run_program(NANOPLC_SIM, "run", "c.seq", "--for", "700ms", "--quiet", "--trace", "c.csv")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(self.plot("c.csv", "-o", "c.svg").returncode, 0)
        texts = re.findall(r">([^<]*)</text>", self.read("c.svg"))
        self.assertEqual((texts.count("Rest_Wait") > 0, texts.count("Rest_Wait_2") > 0), (True, True), texts)

    def test_what_a_count_is_comes_from_the_motor_that_ran(self):
        self.put("p.seq", "PROGRAM P MOTOR MAC800; SCALE 1 rev = 360 deg; STEP A: OWN ERROR; IF IN0 THEN NEXT := POWER_UP; END_IF "
                            "END_STEP END_PROGRAM\n")
        done = self.run_program(NANOPLC_SIM, "run", "p.seq", "--for", "100ms", "--quiet", "--trace", "t.csv")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(self.read("t.csv.sym"))["trace"], {"counts_per_rev": 8000, "samples_per_second": 770})
        self.put("turn.csv", HEADER + "0,0,0,0,0,0,0,0,,0,0\n1,0,0,0,0,0,0,0,,8000,770\n")
        os.rename(self.path("t.csv.sym"), self.path("turn.csv.sym"))
        self.assertEqual(self.plot("turn.csv", "-o", "t.svg").returncode, 0)
        texts = re.findall(r">([^<]*)</text>", self.read("t.svg"))
        self.assertLessEqual({"deg", "deg/s", "300"}, set(texts))

    def test_a_table_without_names_leaves_none(self):
        self.run_program(SEQC, "build", example("pick_and_place.seq"), "-o", "p.bin")
        self.traced("pick_and_place", "t.csv")
        os.remove(self.path("p.sym"))
        self.run_program(NANOPLC_SIM, "run", "p.bin", "--for", "100ms", "--quiet", "--trace", "t.csv")
        self.assertEqual(sorted(os.listdir(self.folder.name)), ["p.bin", "t.csv"])
        self.assertEqual(self.plot("t.csv", "-o", "t.svg").returncode, 0)
        self.assertIn(">counts</text>", self.read("t.svg"))

    def test_symbols_of_another_program_are_refused(self):
        self.traced("pick_and_place", "t.csv")
        self.run_program(SEQC, "build", example("press.seq"), "-o", "other.bin")
        self.refused(["t.csv", "-o", "no.svg", "--sym", "other.sym"], "other.sym: is of Press", "t.csv is of PickAndPlace")
        os.remove(self.path("t.csv.sym"))
        self.refused(["t.csv", "-o", "no.svg", "--sym", "other.sym"], "other.sym: Press begins by writing")
        self.put("step.csv", HEADER + "0,0,0,0,0,0,0,0,,0,0\n1,40,0,0,0,0,0,0,,0,0\n")
        self.refused(["step.csv", "-o", "no.svg", "--sym", "other.sym"], "has no step 40")

    def test_nothing_is_written_over(self):
        self.run_program(SEQC, "build", example("pick_and_place.seq"), "-o", "t.bin")
        os.rename(self.path("t.sym"), self.path("t.csv.sym"))
        symbols = self.read("t.csv.sym")
        done = self.run_program(NANOPLC_SIM, "run", "t.bin", "--symbols", "t.csv.sym", "--for", "100ms", "--trace", "t.csv")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.read("t.csv.sym"), symbols)
        self.assertEqual(self.plot("t.csv", "-o", "t.svg").returncode, 0)
        self.put("u.csv.sym", "at 0 ms IN0 := 1\nend at 10 ms\n")
        done = self.run_program(NANOPLC_SIM, "run", "t.bin", "--scenario", "u.csv.sym", "--trace", "u.csv")
        self.assertEqual(done.returncode, 2)
        self.assertIn("would overwrite the scenario", done.stderr)

    def test_a_picture_is_what_its_name_says(self):
        self.traced("pick_and_place", "t.csv")
        for name, begin in (("t.png", b"\x89PNG\r\n\x1a\n"), ("t.pdf", b"%PDF"), ("t.svg", b"<svg"), ("T.PNG", b"\x89PNG")):
            done = self.plot("t.csv", "-o", name)
            self.assertEqual(done.returncode, 0, done.stderr)
            with open(self.path(name), "rb") as file:
                self.assertTrue(file.read().startswith(begin), name)
        self.refused(["t.csv", "-o", "t.jpg"], "t.jpg: name the picture .svg, .png or .pdf")

    def test_names_of_short_steps_meet_neither_each_other_nor_their_lines(self):
        chance = random.Random(SEED)
        sys.path.insert(0, os.path.join(ROOT, "tools"))
        from traces.pictures import LETTER, MOST_NAME_ROWS, Picture  # pylint: disable=import-outside-toplevel
        for _ in range(50):
            time, trace = 0.0, []
            for _ in range(chance.randrange(2, 60)):
                trace.append({"time_ms": time, "step": chance.randrange(20), "inputs": 0, "outputs": 0, "inpos": 0, "error": 0,
                              "p_ist": 0, "v_ist": 0})
                time += chance.choice([1, 5, 400])
            names = {step: "Step" + "x" * chance.randrange(20) for step in range(20)}
            canvas = Picture(trace, names, {}, {}).drawn("t")
            texts = [(x, y, x + LETTER * size * len(words)) for kind, x, y, words, anchor, *_, size in
                     (shape for shape in canvas.shapes if shape[0] == "text") if anchor == "start" and words.startswith("Step")]
            lines = [shape[1] for shape in canvas.shapes if shape[0] == "line" and shape[2] == "#bbb"]
            self.assertEqual(len(texts), len(lines))
            self.assertLessEqual(len({y for _, y, _ in texts}), MOST_NAME_ROWS)
            for at, (left, y, right) in enumerate(texts):
                self.assertLessEqual(right, canvas.width)
                self.assertFalse(any(y == b and left < d and a < right for a, b, d in texts[:at]))
                self.assertFalse(any(left < x < right and top < y - 1 and y - 8 < bottom for (x, top), (_, bottom) in lines))


if __name__ == "__main__":
    ROOT = sys.argv.pop()
    NANOPLC_SIM = sys.argv.pop()
    SEQC = sys.argv.pop()
    unittest.main()
