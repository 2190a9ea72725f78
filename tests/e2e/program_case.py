"""A test case with a folder of its own, and programs that end with it."""

import os
import tempfile
import unittest

import simulator


class ProgramCase(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.running = []

    def tearDown(self):
        for process in self.running:
            process.kill()
            process.communicate()
        self.folder.cleanup()

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def launch(self, *command):
        """A simulator, when it is ready; its lines until then."""
        process, lines = simulator.start(*command)
        self.running.append(process)
        return process, lines
