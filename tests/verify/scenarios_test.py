"""Every course into a step of the example programs, written as a scenario and played by seqc verify itself.

usage: scenarios_test.py SEQC NANOPLC_SIM PROGRAM...

Of each step `NEVER step = Name` is broken by the shortest course there. What seqc verify says of the scenario is what nanoplc-sim run
says; where the virtual motor cannot follow, the stimulus comes to the same end in nanoplc-sim scan. Courses that need other values of
set-points than the table's have them in both.
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile

import programs

SET_POINTS = """PROGRAM Coats
MOTOR MAC140;
VAR_INPUT Go AT IN0 : BOOL; Ack AT IN1 : BOOL; END_VAR
VAR_OUTPUT Lamp AT OUT0 : BOOL; END_VAR
SET_POINT Coats := 3 RANGE 1 .. 5;
SET_POINT Soak := 100 ms RANGE 10 ms .. 20 s;
ON ERROR NEXT := Fault;
STEP Idle: {takes} IF R_TRIG(Go) THEN COUNTER := Coats; NEXT := Soaking; END_IF END_STEP
STEP Soaking: ENTRY TIMER := Soak; IF TIMER.Q THEN COUNT_DOWN; NEXT := Dry; END_IF END_STEP
STEP Dry: OUT Lamp; IF COUNTER.Q THEN NEXT := Idle; ELSE NEXT := Soaking; END_IF END_STEP
STEP Fault: OWN ERROR; IF ANY ERROR AND R_TRIG(Ack) THEN RESET_ERROR; NEXT := POWER_UP; END_IF END_STEP
PROPERTY Short: WHENEVER STEP = Soaking THEN NOT STEP = Soaking WITHIN 150 ms;
PROPERTY Many: WHENEVER STEP = Soaking FOLLOWED BY STEP = Dry THEN NOT COUNTER.Q;
END_PROGRAM
"""


class Courses(programs.Programs):
    def verify(self, seqc, program, *options, **more):
        return subprocess.run([seqc, "verify", program, "--property", self.path("p.prop"), "--scenario", self.path("out.scn"),
                               "--stimulus", self.path("out.csv"), "--trace", self.path("trace.csv"), *options], capture_output=True, text=True, check=False, **more)

    def check(self, program):
        subprocess.run([self.seqc, "build", program, "--quiet", "-o", self.path("t.bin")], check=True)
        with open(self.path("t.sym"), encoding="utf-8") as file:
            steps = {s["name"]: s["number"] for s in json.load(file)["steps"] if s["number"]}
        self.path("p.prop", "".join(f"PROPERTY At_{name}: NEVER step = {name};\n" for name in steps).encode())
        done = self.verify(self.seqc, program, "--json")
        assert done.returncode == 1, done.stderr
        results = {r["name"]: r for r in json.loads(done.stdout)["results"]}
        counts = [0, 0]
        for name, number in steps.items():
            result = results[f"At_{name}"]
            assert result["verdict"] == "broken", (program, name)
            played = result["scenario"]
            assert played["plays"] is not None, played
            told = subprocess.run([self.nanoplc_sim, "run", program, "--scenario", played["file"], "--quiet"],
                                  capture_output=True, text=True, check=False)
            assert told.returncode == (0 if played["plays"] else 1), (program, name, told.stdout)
            with open(played["file"], encoding="utf-8") as file:
                first = file.readline()
            is_marked = "cannot follow this course: " in first or "does not come to the end of this course: " in first
            assert is_marked != played["plays"], (program, name)
            stimulus = os.path.splitext(played["file"])[0] + ".csv"
            scans = subprocess.run([self.nanoplc_sim, "scan", self.path("t.bin"), "--stimulus", stimulus],
                                   capture_output=True, text=True, check=True).stdout.splitlines()
            assert scans[-1].split(",")[1] == str(number), (program, name, scans[-1])
            counts[0 if played["plays"] else 1] += 1
        self.draw()
        return counts

    def check_set_points(self, takes):
        """Long enough a time, and a single coat."""
        program = self.path("set.seq", SET_POINTS.format(takes=takes).encode())
        subprocess.run([self.seqc, "build", program, "--quiet", "-o", self.path("t.bin")], check=True)
        with open(self.path("t.sym"), encoding="utf-8") as file:
            steps = {s["number"]: s["name"] for s in json.load(file)["steps"]}
        done = subprocess.run([self.seqc, "verify", program, "--json", "--scenario", self.path("out.scn"), "--stimulus", self.path("out.csv")],
                              capture_output=True, text=True, check=False)
        results = {r["name"]: r for r in json.loads(done.stdout)["results"]}
        for name, end in (("Short", "Soaking"), ("Many", "Dry")):
            assert results[name]["verdict"] == "broken", (name, results[name])
            assert results[name]["scenario"]["plays"], results[name]["scenario"]
            file = results[name]["scenario"]["file"]
            scans = subprocess.run([self.nanoplc_sim, "scan", self.path("t.bin"), "--stimulus", os.path.splitext(file)[0] + ".csv"],
                                   capture_output=True, text=True, check=True).stdout.splitlines()
            step, counter = (int(scans[-1].split(",")[i]) for i in (1, 3))
            assert steps[step] == end and (name != "Many" or counter == 0), (name, scans)

    def draw(self):
        """The first course as a picture."""
        plot = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tools", "plot_trace")
        subprocess.run([sys.executable, "-B", plot, self.path("trace.csv"), "-o", self.path("t.svg"), "--sym", self.path("t.sym")],
                       check=True)
        with open(self.path("t.svg"), encoding="utf-8") as file:
            picture = file.read()
        assert picture.startswith("<svg") and ">step<" in picture and "P_IST" not in picture

    def check_alone(self, program):
        """A seqc without nanoplc-sim reports that it played nothing; the verdict stays."""
        alone = os.path.join(self.folder, "alone")
        os.mkdir(alone)
        seqc = shutil.copy(self.seqc, alone)
        done = self.verify(seqc, program, env={"PATH": alone})
        assert done.returncode == 1 and "was not played: nanoplc-sim was not found" in done.stdout, done


def main():
    seqc, nanoplc_sim, *paths = sys.argv[1:]
    follows = misses = 0
    with tempfile.TemporaryDirectory() as folder:
        courses = Courses(seqc, nanoplc_sim, folder)
        for program in paths:
            more, others = courses.check(program)
            follows, misses = follows + more, misses + others
        courses.check_set_points("TAKES SET_POINTS;")
        courses.check_set_points("")
        courses.check_alone(paths[-1])
    print(f"{len(paths)} programs: the virtual motor follows {follows} courses of {follows + misses}")
    assert follows >= 9 * misses


main()
