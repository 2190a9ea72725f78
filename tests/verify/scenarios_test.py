"""Every course into a step of the example programs, written as a scenario and played by seqc verify itself.

usage: scenarios_test.py SEQC NANOPLC_SIM PROGRAM...

Of each step `NEVER step = Name` is broken by the shortest course there. What seqc verify says of the scenario is what nanoplc-sim run
says; where the virtual motor cannot follow, the stimulus comes to the same end in nanoplc-sim scan.
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile

import programs


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
                assert ("cannot follow" in file.readline()) != played["plays"], (program, name)
            stimulus = os.path.splitext(played["file"])[0] + ".csv"
            scans = subprocess.run([self.nanoplc_sim, "scan", self.path("t.bin"), "--stimulus", stimulus],
                                   capture_output=True, text=True, check=True).stdout.splitlines()
            assert scans[-1].split(",")[1] == str(number), (program, name, scans[-1])
            counts[0 if played["plays"] else 1] += 1
        self.draw()
        return counts

    def draw(self):
        """The first course as a picture."""
        plot = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tools", "plot_trace")
        subprocess.run([sys.executable, "-B", plot, self.path("trace.csv"), "-o", self.path("t.svg"), "--sym", self.path("t.sym")],
                       check=True)
        with open(self.path("t.svg"), encoding="utf-8") as file:
            picture = file.read()
        assert picture.startswith("<svg") and ">step<" in picture and "P_IST" not in picture

    def check_alone(self, program):
        """A seqc without nanoplc-sim says that it played nothing; the verdict stays."""
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
        courses.check_alone(paths[-1])
    print(f"{len(paths)} programs: the virtual motor follows {follows} courses of {follows + misses}")
    assert follows >= 9 * misses


main()
