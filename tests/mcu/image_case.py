"""A test of the firmware's image: the emulated board, a virtual motor on its motor line, the tools on its user's line."""

import json
import os
import subprocess
import tempfile
import unittest

import machine
import user_line
from machine import until

IMAGE = SIMULATOR = NANOCTL = MACREG = SEQC = ""


def take(*programs):
    global IMAGE, SIMULATOR, NANOCTL, MACREG, SEQC
    IMAGE, SIMULATOR, NANOCTL, MACREG, SEQC = programs


class ImageCase(unittest.TestCase):
    def take_folder(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def compile(self, source):
        table = self.path(os.path.basename(source) + ".bin")
        subprocess.run([SEQC, "build", source, "--quiet", "-o", table], check=True, capture_output=True)
        return table

    def start_board(self, *motor):
        """The motor's line is what follows the last word of `motor`."""
        self.motor, line = machine.start_motor(SIMULATOR, self.folder.name, *motor)
        self.addCleanup(self.end_motor)
        self.board = machine.Machine(IMAGE, self.folder.name, motor=line).start()
        self.addCleanup(lambda: self.board.process and self.board.cut_power())

    def end_motor(self):
        self.motor.kill()
        self.motor.communicate()

    def tool(self, program, *arguments):
        return subprocess.run([program, "--port", self.board.endpoint(), "--patience", "2000", "--json", *arguments],
                              capture_output=True, text=True, timeout=4 * machine.LONG, check=False)

    def ctl(self, *arguments):
        result = self.tool(NANOCTL, *arguments)
        self.assertEqual(result.returncode, 0, f"{arguments}: {result.stdout} {result.stderr}")
        return json.loads(result.stdout.splitlines()[-1])

    def macreg(self, *arguments):
        """Of the motor behind the gateway."""
        return self.tool(MACREG, "--model", "MAC140", "--address", "254", *arguments)

    def shows(self, outputs):
        until(self.board.outputs, lambda seen: seen == outputs)

    def on_the_line(self, what):
        line = user_line.UserLine(self.board.path("user"))
        try:
            return what(line)
        finally:
            line.close()
