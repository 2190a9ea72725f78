"""A test case with a folder of its own, and programs that end with it."""

import simulator
from folder_case import FolderCase


class ProgramCase(FolderCase):
    def setUp(self):
        super().setUp()
        self.running = []

    def tearDown(self):
        for process in self.running:
            process.kill()
            process.communicate()
        super().tearDown()

    def launch(self, *command):
        """A simulator, when it is ready; its lines until then."""
        process, lines = simulator.start(*command)
        self.running.append(process)
        return process, lines
