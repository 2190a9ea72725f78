"""The report of seqc verify on a course, and the scenario that it writes: machines whose motor needs longer than the course.

usage: stories_test.py SEQC NANOPLC_SIM FOLDER_OF_STORIES
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SEQC = SIM = STORIES = ""


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        for name in os.listdir(STORIES):
            shutil.copy(os.path.join(STORIES, name), self.folder.name)

    def run_it(self, *arguments):
        return subprocess.run(arguments, cwd=self.folder.name, capture_output=True, text=True, check=False)

    def verify(self, *arguments):
        done = self.run_it(SEQC, "verify", *arguments)
        self.assertEqual(done.returncode, 1, done.stderr)
        return done.stdout

    def read(self, name):
        with open(os.path.join(self.folder.name, name), encoding="utf-8") as file:
            return file.read()

    def write(self, name, text):
        with open(os.path.join(self.folder.name, name), "w", encoding="utf-8") as file:
            file.write(text)


class Story(Case):
    def test_orders_have_names_units_and_signs(self):
        story = self.verify("elevator.seq")
        self.assertIn("Floor_2 := 900 mm; ", story)
        self.assertIn("V_HOME := -100 rpm", story)
        self.assertIn("POSITION(Floor_1)", story)
        self.assertIn("INIT(Travel)", story)
        self.assertNotIn("429496", story)

    def test_orders_are_in_the_units_of_the_program(self):
        self.assertIn("Travel := 600 mm/s", self.verify("elevator.seq"))
        self.write("counts.seq", "PROGRAM P\nMOTOR MAC140;\nVAR_INPUT Go AT IN0 : BOOL; END_VAR\n"
                   "VAR_MOTOR Far AT P1 := 5000; Near AT INPOSWIN := 20; Fast AT V1 := 500 rpm; END_VAR\n"
                   "POWER_UP INIT(Fast); NEXT := S; END_POWER_UP\nSTEP S: OWN ERROR; ENTRY POSITION(Far); IF Go THEN NEXT := T; END_IF END_STEP\n"
                   "STEP T: OWN ERROR; END_STEP\nPROPERTY No: NEVER STEP = T;\nEND_PROGRAM\n")
        for of in ("counts.seq", "counts.bin"):
            self.run_it(SEQC, "build", "counts.seq", "-o", "counts.bin", "--quiet")
            arguments = ("--property", "t.prop") if of.endswith("bin") else ()
            self.write("t.prop", "PROPERTY No: NEVER STEP = T;")
            story = self.verify(of, *arguments)
            self.assertIn("Far := 5000 counts; Near := 20 counts; Fast := 500 rpm", story)

    def test_a_fraction_is_told_as_one(self):
        self.assertIn("Station := 4468 counts", self.verify("camera.seq"))
        self.write("camera.seq", self.read("camera.seq").replace(":= 4468 counts", ":= 32.725 deg"))
        self.assertIn("Station := 32.725 deg", self.verify("camera.seq"))

    def test_a_bare_table_has_register_names_and_signed_values(self):
        self.run_it(SEQC, "build", "elevator.seq", "-o", "t.bin", "--quiet")
        os.remove(os.path.join(self.folder.name, "t.sym"))
        self.write("t.prop", "PROPERTY Top: NEVER step = 5;")
        story = self.verify("t.bin", "--property", "t.prop")
        self.assertIn("V_HOME := -277;", story)
        self.assertIn("POSITION(P1)", story)

    def test_modes_and_bits_have_their_names(self):
        self.write("modes.seq", "PROGRAM P\nMOTOR MAC140;\nVAR_INPUT Go AT IN0 : BOOL; END_VAR\n"
                   "VAR_MOTOR Kind AT HOME_MODE := BY_COMMAND = HOME1_MODE; Window AT INPOSWIN := 24; Fast AT V1 := 100 rpm; END_VAR\n"
                   "POWER_UP INIT(Fast); NEXT := S; END_POWER_UP\n"
                   "STEP S: OWN ERROR; IF Go THEN CNTRL_BITS := HICLK + INPSIGN; MODE_REG := V_MODE; NEXT := T; END_IF END_STEP\n"
                   "STEP T: OWN ERROR; ENTRY HOME_MODE := 7; IF NOT Go THEN NEXT := S; END_IF END_STEP\n"
                   "PROPERTY No: NEVER STEP = T;\nEND_PROGRAM\n")
        story = self.verify("modes.seq")
        self.assertIn("Kind := BY_COMMAND = HOME1_MODE; Window := 24 ", story)
        self.assertIn("CNTRL_BITS := INPSIGN + HICLK; MODE_REG := V_MODE", story)
        self.assertIn("Kind := 7", story)  # is no kind of homing

    def test_where_a_time_begins(self):
        for of, name, ms in (("gate.seq", "E_Stop", 200), ("camera.seq", "E_Stop", 200), ("elevator.seq", "Travel_Ends", 9000)):
            for assume in ("driver", "any"):
                story = self.verify(of, "--assume", assume)
                if f"here {name} breaks" not in story:
                    continue
                (begin,) = re.findall(rf"^ +(\d+)  here the {ms} ms of {name} begin: in scan (\d+)$", story, re.MULTILINE)
                (end,) = re.findall(rf"^ +(\d+)  here {name} breaks: .*scan (\d+)$", story, re.MULTILINE)
                self.assertGreaterEqual(int(end[0]) - int(begin[0]), ms)
                self.assertLessEqual(int(begin[1]), int(end[1]))

    def test_it_begins_in_the_scan_in_which_the_condition_comes(self):
        # Go is on from the scan that leads to Work on; Late is looked for 20 ms later.
        self.write("late.seq", "PROGRAM Late\nMOTOR MAC140;\nVAR_INPUT Go AT IN0 : BOOL; END_VAR\nVAR_OUTPUT Lamp AT OUT0 : BOOL; END_VAR\n"
                   "STEP Idle: OWN ERROR; ENTRY TIMER := T#30ms; IF Go THEN NEXT := Work; END_IF END_STEP\n"
                   "STEP Work: OWN ERROR; OUT Lamp; ENTRY TIMER := T#50ms; IF TIMER.Q THEN NEXT := Idle; END_IF END_STEP\n"
                   "PROPERTY Short: WHENEVER STEP = Work THEN NOT Lamp WITHIN 20 ms;\n"
                   "PROPERTY Dark: WHENEVER Lamp FOR 20 ms THEN STEP = Idle;\nPROPERTY Off: NEVER Lamp;\nEND_PROGRAM\n")
        for assume in ("driver", "any"):
            for result in json.loads(self.verify("late.seq", "--assume", assume, "--json"))["results"]:
                if result["name"] not in ("Short", "Dark", "Off"):
                    continue
                scans = result["course"]
                begun = [i for i, scan in enumerate(scans) if scan.get("time_begins")]
                first = [scan["step"] for scan in scans].index("Work")
                self.assertEqual(begun, [] if result["name"] == "Off" else [first])

    def test_a_helper_step_is_named_with_what_to_write(self):
        self.assertIn("  Wait_to_Move is a helper step that the compiler made for a branch; it does not ask again: "
                      "write a step that tests Door\n", self.verify("camera.seq"))

    def test_columns_hold(self):
        for name in ("gate.seq", "gate_shut.seq", "camera.seq"):
            lines = self.verify(name).splitlines()
            heads = [i for i, line in enumerate(lines) if line.split()[:2] == ["ms", "on"]]
            self.assertTrue(heads)
            for head in heads:
                steps, outputs = lines[head].index("step"), lines[head].index("outputs")
                for line in lines[head + 1:]:
                    if "here " in line:
                        break
                    if line[:12].strip():
                        self.assertEqual((line[steps - 2:steps], line[outputs - 2:outputs]), ("  ", "  "), line)
                        self.assertNotEqual((line[steps], line[outputs]), (" ", " "), line)

    def test_no_riddles(self):
        story = self.verify("gate_shut.seq")
        self.assertIn("  its condition holds at the end of this course\n", story)
        self.assertIn("     2657  here Bolt_Is_Drawn breaks: in scan 1306\n", story)
        self.assertIn("at the end of this course WHENEVER's condition has held for that time, and THEN's does not hold",
                      self.verify("gate.seq"))
        self.assertIn("here Travel_Ends breaks: 2 ms after scan", self.verify("elevator.seq"))


class Scenario(Case):
    def plays(self, program, *names, options=()):
        printed = self.verify(program, "--scenario", "out.scn", *options)
        for name, file in names:
            self.assertIn(f"nanoplc-sim run plays {file} to the same end", printed)
            done = self.run_it(SIM, "run", program, "--scenario", file, "--quiet")
            self.assertEqual(done.returncode, 0, done.stdout)
            last = done.stdout.splitlines()[-1]
            self.assertRegex(last, rf"^here {name} breaks, at [0-9]+\.[0-9]+ ms$")
            scenario = self.read(file)
            self.assertIn(f'log "here {name} breaks", end\n', scenario)
            self.assertNotRegex(scenario, r"\bIN[0-5]\b|OUTPUTS|\bOUT[0-3]\b")
        return printed

    def test_a_gate_that_needs_longer_than_its_course(self):
        self.plays("gate.seq", ("E_Stop", "out.scn"))
        self.plays("gate_shut.seq", ("Bolt_Is_Drawn", "out.scn"), ("Lamp_While_It_Moves", "out-Lamp_While_It_Moves.scn"))

    def test_a_course_that_needs_a_hard_stop_takes_it_from_a_scenario(self):
        printed = self.verify("elevator.seq", "--scenario", "out.scn")
        self.assertRegex(printed, r"the virtual motor cannot follow out\.scn: in step Search INPOS does not come as in the course, "
                         r"which goes to To_1, and it goes to Fault at [0-9.]+ ms; .*--plant FILE")
        self.assertIn("# The virtual motor cannot follow this course: ", self.read("out.scn"))
        self.plays("elevator.seq", ("Doors_Stop_It", "out.scn"), ("Travel_Ends", "out-Travel_Ends.scn"),
                   options=("--plant", "elevator.scn"))
        scenario = self.read("out.scn")
        self.assertIn("motor stop below -500 mm\nmotor load 40\nmotor T_HOME := 30\n", scenario)
        self.assertNotIn("pulse Go", scenario)

    def test_a_time_limit_that_the_move_does_not_keep(self):
        self.write("short.seq", "PROGRAM Short\nMOTOR MAC140;\nVAR_INPUT Go AT IN0 : BOOL; END_VAR\nVAR_OUTPUT Lamp AT OUT0 : BOOL; END_VAR\n"
                   "VAR_MOTOR Far AT P1 := 60 rev; Fast AT V1 := 1000 rpm; END_VAR\nPOWER_UP INIT(Fast); NEXT := Idle; END_POWER_UP\n"
                   "STEP Idle: OWN ERROR; IF R_TRIG(Go) THEN NEXT := Away; END_IF END_STEP\n"
                   "STEP Away: OWN ERROR; ENTRY POSITION(Far); IF INPOS WITHIN T#20ms THEN NEXT := There; ELSE NEXT := Idle; END_IF END_STEP\n"
                   "STEP There: OWN ERROR; OUT Lamp; IF NOT Go THEN NEXT := Idle; END_IF END_STEP\n"
                   "PROPERTY Dark: NEVER Lamp;\nEND_PROGRAM\n")
        printed = self.verify("short.seq", "--scenario", "out.scn")
        self.assertRegex(printed, r"in step Away the course goes to There with INPOS, and the move takes more than the 20 ms of the timer: "
                         r"it goes to Idle")
        self.assertNotIn("--plant", printed + self.read("out.scn"))

    HEAD = ("PROGRAM Short\nMOTOR MAC140;\nVAR_INPUT Go AT IN0 : BOOL; Part AT IN1 : BOOL; END_VAR\n"
            "VAR_OUTPUT Lamp AT OUT0 : BOOL; END_VAR\n")

    def test_times_of_a_few_milliseconds_are_followed_where_debouncing_lets_them(self):
        for ms in (1, 2, 3, 4, 5):
            self.write("short.seq", self.HEAD + "STEP Idle: OWN ERROR; IF R_TRIG(Go) THEN TIMER := T#%dms; NEXT := Wait; END_IF END_STEP\n"
                       "STEP Wait: OWN ERROR; IF R_TRIG(Part) THEN NEXT := Got; ELSIF TIMER.Q THEN NEXT := Idle; END_IF END_STEP\n"
                       "STEP Got: OWN ERROR; OUT Lamp; IF NOT Go THEN NEXT := Idle; END_IF END_STEP\n"
                       "PROPERTY Dark: NEVER Lamp;\nEND_PROGRAM\n" % ms)
            self.plays("short.seq", ("Dark", "out.scn"))

    def test_what_is_not_followed_without_a_move_is_not_said_of_the_motor(self):
        self.write("short.seq", self.HEAD + "STEP Idle: OWN ERROR; IF Go THEN NEXT := Wait; END_IF END_STEP\n"
                   "STEP Wait: OWN ERROR; IF NOT Go WITHIN 1 ms THEN NEXT := Got; ELSE NEXT := Late; END_IF END_STEP\n"
                   "STEP Got: OWN ERROR; OUT Lamp; IF Part THEN NEXT := Idle; END_IF END_STEP\n"
                   "STEP Late: OWN ERROR; IF Part THEN NEXT := Idle; END_IF END_STEP\n"
                   "PROPERTY Dark: NEVER Lamp;\nEND_PROGRAM\n")
        printed = self.verify("short.seq", "--scenario", "out.scn")
        self.assertRegex(printed, r"nanoplc-sim run does not come to the end of out\.scn: in step Wait the course goes to Got, and it goes to Late "
                         r"at [0-9.]+ ms; it debounces inputs for 3 ms")
        self.assertIn("# nanoplc-sim run does not come to the end of this course: ", self.read("out.scn"))
        self.assertNotIn("motor cannot", printed + self.read("out.scn"))

    def test_a_last_step_that_is_left_too_early(self):
        self.write("short.seq", self.HEAD + "VAR_MOTOR Far AT P1 := 1 rev; Fast AT V1 := 600 rpm; END_VAR\nON ERROR NEXT := Fault;\n"
                   "POWER_UP INIT(Fast); NEXT := Idle; END_POWER_UP\nSTEP Idle: IF Go THEN NEXT := Move; END_IF END_STEP\n"
                   "STEP Move: ENTRY POSITION(Far); IF Part THEN TIMER := T#9ms; NEXT := Brake; END_IF END_STEP\n"
                   "STEP Brake: OUT Lamp; IF TIMER.Q THEN STOP; NEXT := Fault; END_IF END_STEP\n"
                   "STEP Fault: OWN ERROR; IF ANY ERROR AND R_TRIG(Part) THEN RESET_ERROR; NEXT := POWER_UP; END_IF END_STEP\n"
                   "PROPERTY Stops: WHENEVER Part THEN NOT moving WITHIN 3 ms;\nEND_PROGRAM\n")
        self.assertRegex(self.verify("short.seq", "--scenario", "out.scn"),
                         r"does not come to the end of out\.scn: it goes through the steps of the course and leaves the last one, Move, at [0-9.]+ ms, "
                         r"before the course ends")

    def test_a_helper_step_on_the_way(self):
        self.plays("camera.seq", ("Door_Stops_It", "out.scn"))

    def test_a_step_that_is_entered_again_is_counted(self):
        self.write("again.seq", "PROGRAM Again\nMOTOR MAC140;\n"
                   "VAR_INPUT Go AT IN0 : BOOL; END_VAR\nVAR_OUTPUT Lamp AT OUT0 : BOOL; END_VAR\n"
                   "POWER_UP COUNTER := 2; NEXT := Idle; END_POWER_UP\n"
                   "STEP Idle: OWN ERROR; IF COUNTER.Q THEN NEXT := Done; ELSIF Go THEN COUNT_DOWN; NEXT := Work; END_IF END_STEP\n"
                   "STEP Work: OWN ERROR; IF NOT Go THEN NEXT := Idle; END_IF END_STEP\n"
                   "STEP Done: OWN ERROR; OUT Lamp; IF Go THEN NEXT := POWER_UP; END_IF END_STEP\n"
                   "PROPERTY Dark: NEVER Lamp;\nEND_PROGRAM\n")
        self.plays("again.seq", ("Dark", "out.scn"))
        self.assertRegex(self.read("out.scn"), r"once step = \w+ 2 times .*Go := ")

    def test_an_input_that_changes_at_the_beginning_and_a_deadline(self):
        self.write("warm.seq", "PROGRAM Warm_Up\nMOTOR MAC140;\nVAR_INPUT Well AT IN0 : BOOL; Go AT IN1 : BOOL; END_VAR\n"
                   "VAR_MOTOR Fast AT V1 := 100 rpm; Soft AT A1 := 1000 rpm/s; END_VAR\n"
                   "POWER_UP INIT(Fast, Soft); NEXT := Warm; END_POWER_UP\n"
                   "STEP Warm: OWN ERROR; IF NOT Well THEN NEXT := Stopped; ELSIF R_TRIG(Go) THEN NEXT := Work; END_IF END_STEP\n"
                   "STEP Work: OWN ERROR; IF NOT Go THEN NEXT := Warm; END_IF END_STEP\n"
                   "STEP Stopped: OWN ERROR; IF Well THEN NEXT := Warm; END_IF END_STEP\n"
                   "PROPERTY Stops: WHENEVER step = Work THEN step = Stopped WITHIN 200 ms;\nPROPERTY Works: NEVER step = Work;\n"
                   "END_PROGRAM\n")
        self.plays("warm.seq", ("Stops", "out.scn"), ("Works", "out-Works.scn"))
        self.assertRegex(self.read("out.scn"), r'once step = Work for [0-9]+ ms log "here Stops breaks", end\n')

    def test_what_the_plant_is_taken_from(self):
        self.write("no.scn", "at 1 s motor load 40\nend at 2 s\n")
        done = self.run_it(SEQC, "verify", "camera.seq", "--scenario", "out.scn", "--plant", "no.scn")
        self.assertEqual(done.returncode, 2)
        self.assertIn("no.scn: says nothing of the motor at the beginning", done.stderr)
        done = self.run_it(SEQC, "verify", "camera.seq", "--plant", "no.scn")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--plant goes with --scenario", done.stderr)
        done = self.run_it(SEQC, "verify", "camera.seq", "--scenario", "elevator.scn", "--plant", "elevator.scn")
        self.assertEqual(done.returncode, 2)

    def test_json_says_where_it_is_left(self):
        result = json.loads(self.verify("elevator.seq", "--json", "--scenario", "out.scn"))["results"]
        (scenario,) = [r["scenario"] for r in result if r["name"] == "Doors_Stop_It"]
        self.assertFalse(scenario["plays"])
        self.assertIn("step Search", scenario["why"])


if __name__ == "__main__":
    SEQC, SIM, STORIES = sys.argv[1:4]
    unittest.main(argv=sys.argv[:1] + sys.argv[4:])
