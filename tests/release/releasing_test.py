#!/usr/bin/env python3
"""The steps of tools/RELEASING.md, each done once in a repository of its own with a throw-away key and of the smallest part; and what
tools/release refuses."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
PAGE = os.path.join(ROOT, "tools", "RELEASING.md")
VERSION = "98.7.6"
# How a step is done here; those that are not named are done as they stand.
DONE = {"tools/test": None, "minisign -G": "{} -W", "tools/release --key": "{} source", "tools/release --unsigned": "{} source"}


def steps():
    """The commands of the page, in its order."""
    with open(PAGE, encoding="utf-8") as file:
        return [line.strip() for line in file if re.match(r" {4,7}\S", line)]


class Repository(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="releasing")
        self.addCleanup(folder.cleanup)
        self.tree = os.path.join(folder.name, "tree")
        self.environment = {**os.environ, "HOME": folder.name, "VERSION": VERSION, "GIT_CONFIG_GLOBAL": "/dev/null",
                            "GIT_AUTHOR_NAME": "a", "GIT_AUTHOR_EMAIL": "a@b", "GIT_COMMITTER_NAME": "a", "GIT_COMMITTER_EMAIL": "a@b"}
        listed = self.run_in(ROOT, "git ls-files -co --exclude-standard").stdout.splitlines()
        for name in listed:
            if os.path.isfile(os.path.join(ROOT, name)):
                os.makedirs(os.path.dirname(os.path.join(self.tree, name)), exist_ok=True)
                shutil.copy2(os.path.join(ROOT, name), os.path.join(self.tree, name))
        self.edit("tools/cmake/archived_commit.txt", ".*\n", "$Format:%H %ct$\n")
        self.do("git init -q && git add . && git commit -qm first")
        self.key = os.path.join(folder.name, "nanoplc-release.key")

    def run_in(self, folder, command):
        return subprocess.run(["bash", "-c", command], cwd=folder, env=self.environment, stdin=subprocess.DEVNULL,
                              capture_output=True, text=True, check=False)

    def do(self, command, folder=""):
        done = self.run_in(os.path.join(self.tree, folder), command)
        self.assertEqual(done.returncode, 0, f"{command}\n{done.stdout}{done.stderr}")
        return done.stdout

    def edit(self, name, pattern, text):
        path = os.path.join(self.tree, name)
        with open(path, encoding="utf-8") as file:
            edited, count = re.subn(pattern, text, file.read(), count=1)
        self.assertEqual(count, 1, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(edited)

    def write_version(self):
        self.edit("CMakeLists.txt", r"VERSION 0\.1\.0", f"VERSION {VERSION}")
        self.edit("CHANGELOG.md", r"## \[Unreleased\]", f"## [{VERSION}] - 2030-01-01")

    def refused(self, why, command, code=1):
        done = self.run_in(self.tree, command)
        self.assertEqual(done.returncode, code, f"{command}\n{done.stdout}{done.stderr}")
        self.assertIn(why, done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertFalse(os.path.exists(os.path.join(self.tree, "build")))


class Releasing(Repository):
    def test_the_steps_of_the_page(self):
        found = steps()
        self.assertEqual(len(found), 10, found)
        for step in found:
            if step.startswith("git commit"):
                self.write_version()
            way = next((way for begin, way in DONE.items() if step.startswith(begin)), "{}")
            if way is not None:
                # The last two are the users'.
                self.do(way.format(step), f"build/dist/{VERSION}" if "SHA256SUMS" in step and "diff" not in step else "")
        out = os.path.join(self.tree, "build", "dist", VERSION)
        self.assertEqual(sorted(os.listdir(out)), [
            "SHA256SUMS", "SHA256SUMS.minisig", "minisign.pub", f"nanoplc-gateway_{VERSION}.tar.gz",
            f"nanoplc-gateway_{VERSION}.tar.gz.minisig"])
        commit = self.do("git rev-parse HEAD").strip()
        with open(os.path.join(out, "SHA256SUMS.minisig"), encoding="utf-8") as file:
            self.assertIn(f"trusted comment: NanoPLC Gateway {VERSION}, commit {commit}\n", file.read())
        # The source archive alone contains its version and commit.
        self.do(f"tar -xzf {out}/nanoplc-gateway_{VERSION}.tar.gz -C .. && grep -q '^{commit} ' "
                f"../nanoplc-gateway_{VERSION}/tools/cmake/archived_commit.txt")

    def test_what_is_no_release_is_refused_before_anything_is_built(self):
        self.do(f"minisign -G -W -p {self.key}.pub -s {self.key}")
        with_key = f"tools/release --key {self.key} source"
        self.refused("--key FILE is missing", "tools/release", 2)
        self.refused("--windows is no option", "tools/release --windows", 2)
        self.refused("--key needs a value", "tools/release --key", 2)
        self.refused("exclude each other", f"tools/release --key {self.key} --unsigned", 2)
        self.refused("go together", "tools/release --check build", 2)
        self.refused("no such key", f"tools/release --key {self.key}x")
        self.refused("no secret key", f"tools/release --key {self.key}.pub")
        self.refused("has no tag v0.1.0", with_key)
        self.do("git tag v0.1.0")
        self.refused("CHANGELOG.md has no section [0.1.0]", with_key)
        self.write_version()
        self.refused("the tree is not as committed", with_key)
        self.do("git commit -qam version")
        self.refused(f"has no tag v{VERSION}", with_key)
        self.do(f"git tag v{VERSION} HEAD~")
        self.refused(f"has no tag v{VERSION}", with_key)
        self.do(f"git tag -f v{VERSION}")
        self.do("echo >new_file")
        self.refused("the tree is not as committed", with_key)
        self.do("rm new_file && mkdir ../out && echo >../out/file")
        self.refused("there is something already", f"{with_key} --out ../out")
        shutil.rmtree(os.path.join(self.tree, ".git"))
        self.refused("this is no git tree", with_key)


if __name__ == "__main__":
    if not os.path.exists(os.path.join(ROOT, ".git")):
        print("skipped: this tree is no git repository")
        sys.exit(77)
    unittest.main()
