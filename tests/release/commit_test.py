#!/usr/bin/env python3
"""Which commit a build writes into programs and images: of a git tree, a changed one, an archive and neither."""

import os
import shutil
import subprocess
import tempfile
import unittest

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
SCRIPTS = "tools/cmake"
WHO = {"GIT_AUTHOR_NAME": "a", "GIT_AUTHOR_EMAIL": "a@b", "GIT_COMMITTER_NAME": "a", "GIT_COMMITTER_EMAIL": "a@b",
       "GIT_CONFIG_GLOBAL": "/dev/null", "GIT_CEILING_DIRECTORIES": tempfile.gettempdir()}


def run(*command, **more):
    done = subprocess.run(command, capture_output=True, text=True, check=False, env={**os.environ, **WHO}, **more)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(command)}: {done.stdout}{done.stderr}")
    return done.stdout


def written(tree):
    """What a build in the tree would write."""
    template, output = tree + ".template", tree + ".output"
    with open(template, "w", encoding="utf-8") as file:
        file.write("@NPLC_COMMIT@ @MORE@")
    run("cmake", f"-DSOURCE={tree}", f"-DTEMPLATE={template}", f"-DOUTPUT={output}", "-DMORE=more", "-P",
        os.path.join(tree, SCRIPTS, "write_commit.cmake"))
    with open(output, encoding="utf-8") as file:
        return file.read().strip()


class Commit(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="commit")
        self.addCleanup(folder.cleanup)
        self.tree, self.archive = os.path.join(folder.name, "tree"), os.path.join(folder.name, "archive")
        shutil.copytree(os.path.join(ROOT, SCRIPTS), os.path.join(self.tree, SCRIPTS))
        shutil.copy(os.path.join(ROOT, ".gitattributes"), self.tree)
        # A tree that is an archive itself contains its own commit, which is none of the new tree's.
        with open(os.path.join(self.tree, SCRIPTS, "archived_commit.txt"), "w", encoding="utf-8") as file:
            file.write("$Format:%H %ct$\n")

    def commit(self):
        run("git", "init", "-q", cwd=self.tree)
        run("git", "add", ".", cwd=self.tree)
        run("git", "commit", "-q", "-m", "first", cwd=self.tree)
        return run("git", "rev-parse", "HEAD", cwd=self.tree)[:12]

    def test_of_a_tree_as_committed(self):
        self.assertEqual(written(self.tree), "unknown more")
        commit = self.commit()
        self.assertEqual(written(self.tree), f"{commit} more")
        run("git", "tag", "v9.9.9", cwd=self.tree)
        self.assertEqual(written(self.tree), f"{commit} more")

    def test_of_a_changed_tree(self):
        commit = self.commit()
        with open(os.path.join(self.tree, SCRIPTS, "NplcTest.cmake"), "a", encoding="utf-8") as file:
            file.write("# changed\n")
        self.assertEqual(written(self.tree), f"{commit}-changed more")

    def test_of_an_archive_it_is_the_same_as_of_the_tree(self):
        commit = self.commit()
        os.mkdir(self.archive)
        run("git", "archive", "-o", self.archive + ".tar", "HEAD", cwd=self.tree)
        run("tar", "-xf", self.archive + ".tar", "-C", self.archive)
        self.assertEqual(written(self.archive), f"{commit} more")

    def test_what_did_not_change_is_not_compiled_anew(self):
        self.commit()
        written(self.tree)
        output = self.tree + ".output"
        os.utime(output, (1, 1))
        written(self.tree)
        self.assertEqual(os.stat(output).st_mtime, 1)


if __name__ == "__main__":
    unittest.main()
