"""A test case with a folder of its own, and what tests look at when a program has answered."""

import json
import os
import tempfile
import unittest


class FolderCase(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()

    def tearDown(self):
        self.folder.cleanup()

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def put(self, name, content):
        """A file of text or bytes; its path."""
        with open(self.path(name), "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode())
        return self.path(name)

    def document_of(self, done, exit_code=0):
        """What a program has said last with --json."""
        self.assertEqual(done.returncode, exit_code, f"{done.args}: {done.stdout} {done.stderr}")
        answer = json.loads(done.stdout.splitlines()[-1])
        self.assertEqual(answer["ok"], exit_code == 0)
        return answer

    def refused_in_a_line(self, done, says, exit_code=2):
        """One line on standard error, and nothing else."""
        self.assertEqual((done.returncode, done.stderr.count("\n"), done.stdout), (exit_code, 1, ""), f"{done.args}: {done.stderr}")
        self.assertIn(says, done.stderr, done.args)
