#!/usr/bin/env python3
"""A virtual motor with a known load, recorded and fitted with macreg, is the same motor with the file that comes of it.

usage: fit_test.py MACREG MACSIM
"""

import json
import subprocess
import sys
import tomllib
import unittest

from program_case import ProgramCase

MACREG = MACSIM = ""
LONG = 120
LOAD = """motor = "MAC140"
[plant]
inertia = 6.0e-05
coulomb_friction = 0.05
viscous_friction = 0.0002
constant_load = -0.02
dead_time = 0.001
"""


class Fit(ProgramCase):
    def setUp(self):
        super().setUp()
        self.moves = 0

    def motor(self, plant):
        """A motor on a terminal, fifty times as fast as a real one, standing in P_MODE."""
        self.endpoint = "pty:" + self.path(f"tty{self.moves}")
        process, _ = self.launch(MACSIM, "--model", "MAC140", "--address", "8", "--mactalk", self.endpoint, "--plant", plant,
                                 "--speed", "50")
        self.reg("--yes", "set", "KVOUT", "3.5", "A_SOLL", "60", "MODE_REG", "P_MODE")
        return process

    def call(self, *arguments):
        return subprocess.run([MACREG, *arguments], stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=LONG,
                              check=False)

    def reg(self, *arguments):
        return self.document_of(self.call("--port", self.endpoint, "--patience", "500", "--model", "MAC140", "--json", *arguments))

    def record(self, speed, way):
        """A move by so many counts."""
        self.moves += 1
        name = self.path(f"move{self.moves}.csv")
        self.reg("--yes", "set", "V_SOLL", str(speed))
        self.reg("--yes", "record", "P_IST,VF_OUT", "-o", name, "--move", f"P_SOLL=+{way}")
        return name

    @staticmethod
    def course(name):
        """Positions and torques of 450 samples from where it moves."""
        with open(name, encoding="ascii") as file:
            rows = [line.split(",") for line in file if line[0].isdigit()]
        positions = [int(row[1]) for row in rows]
        begin = next(i for i, p in enumerate(positions) if abs(p - positions[0]) > 20)
        return [p - positions[0] for p in positions[begin:begin + 450]], [float(row[2]) for row in rows[begin:begin + 450]]

    def strays(self, name, other):
        """By how many counts two courses differ at the most, the sample in which each begins to move apart, and by how much of the full
        torque on the mean of the acceleration."""
        (here, torque), (there, other_torque) = self.course(name), self.course(other)
        pairs = [(here, there), (here[1:], there), (here, there[1:])]
        counts = min(max(abs(a - b) for a, b in zip(*pair)) for pair in pairs)
        return counts, abs(sum(torque[:100]) - sum(other_torque[:100])) / 100

    def test_a_fitted_motor_is_the_same_motor(self):
        known = self.path("known.toml")
        with open(known, "w", encoding="ascii") as file:
            file.write(LOAD)
        process = self.motor(known)
        moves = [self.record(1200, 20000), self.record(1200, -20000), self.record(300, 5000), self.record(300, -5000)]
        measured = self.record(800, 12000)
        process.terminate()
        process.wait(LONG)

        fitted = self.path("axis.toml")
        result = self.call("fit", *moves, "-o", fitted, "--against", measured, "--picture", self.path("fit.svg"), "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        document = json.loads(result.stdout)
        self.assertGreater(document["against"][0]["r2_velocity"], 0.99)
        self.assertAlmostEqual(document["recommended"]["KVOUT"], 6.0e-5 / 1.73e-5, delta=0.1)
        with open(fitted, "rb") as file:
            found = tomllib.load(file)["plant"]
        for name, value in tomllib.loads(LOAD)["plant"].items():
            self.assertAlmostEqual(found[name], value, delta=0.05 * abs(value), msg=name)
        with open(self.path("fit.svg"), encoding="utf-8") as file:
            self.assertIn("fitted", file.read())

        process = self.motor(fitted)
        same = self.record(800, 12000)
        process.terminate()
        process.wait(LONG)
        light = self.path("light.toml")
        with open(light, "w", encoding="ascii") as file:
            file.write(LOAD.replace("6.0e-05", "4.5e-05").replace("0.05", "0.03"))
        self.motor(light)
        other = self.record(800, 12000)
        counts, torque = self.strays(measured, same)
        self.assertLess(counts, 25)
        self.assertLess(torque, 0.5)
        self.assertGreater(self.strays(measured, other)[1], 1)  # a third less inertia shows

    def test_what_cannot_be_fitted_ends_with_2(self):
        name = self.path("bad.csv")
        for text, part in (("time_s,P_IST [counts]\n0,0\n", "it does not say of which motor it is"),
                           ("# model MAC140\ntime_s,VF_OUT\n0,nan\n", "bad.csv:3: 'nan' in column 2 is no number"),
                           ("", "there is no header")):
            with open(name, "w", encoding="ascii") as file:
                file.write(text)
            result = self.call("fit", name, "-o", self.path("none.toml"))
            self.assertEqual((result.returncode, result.stdout, result.stderr.count("\n")), (2, "", 1), result.stderr)
            self.assertIn(part, result.stderr)
        with self.assertRaises(FileNotFoundError):
            open(self.path("none.toml"), encoding="ascii").close()


if __name__ == "__main__":
    MACREG, MACSIM = sys.argv[1:3]
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
