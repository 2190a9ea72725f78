#!/usr/bin/env python3
"""Signing and checking a folder of files with a throw-away key, and what is refused."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
SIGN = os.path.join(ROOT, "tools", "packing", "sign")


def run(*command, **more):
    return subprocess.run(command, capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL, **more)


def key(folder, name):
    """A secret key without a password, and its public key beside it."""
    path = os.path.join(folder, name)
    done = run("minisign", "-G", "-W", "-p", path + ".pub", "-s", path)
    if done.returncode != 0:
        sys.exit(f"no key: {done.stdout}{done.stderr}")
    return path


class Signing(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="signing")
        self.addCleanup(folder.cleanup)
        self.key = key(folder.name, "key")
        self.other = key(folder.name, "other")
        self.out = os.path.join(folder.name, "out")
        os.mkdir(self.out)
        self.write("nanoplc_0.1.0_amd64.deb", b"package")
        self.write("nanoplc-microbit+modbus_0.1.0.bin", b"image")

    def write(self, name, data):
        with open(os.path.join(self.out, name), "wb") as file:
            file.write(data)

    def names(self):
        return sorted(os.listdir(self.out))

    def sign(self):
        done = run(SIGN, self.out, self.key, "NanoPLC Gateway 0.1.0, commit 1234")
        self.assertEqual(done.returncode, 0, done.stderr)

    def refused(self, why, *command):
        done = run(SIGN, *command)
        self.assertEqual((done.returncode, done.stdout), (1, ""), done.stderr)
        self.assertIn(why, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)

    def check_refuses(self, why):
        self.refused(why, "--check", self.out, self.key + ".pub")

    def test_what_was_signed_is_in_order(self):
        self.sign()
        self.assertEqual(self.names(), ["SHA256SUMS", "SHA256SUMS.minisig", "nanoplc-microbit+modbus_0.1.0.bin",
                                        "nanoplc-microbit+modbus_0.1.0.bin.minisig", "nanoplc_0.1.0_amd64.deb",
                                        "nanoplc_0.1.0_amd64.deb.minisig"])
        done = run(SIGN, "--check", self.out, self.key + ".pub")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("2 files", done.stdout)
        self.assertIn("NanoPLC Gateway 0.1.0, commit 1234", done.stdout)
        # As a user does it, without this project.
        for command in (["minisign", "-V", "-p", self.key + ".pub", "-m", "SHA256SUMS"],
                        ["sha256sum", "--check", "--strict", "SHA256SUMS"]):
            self.assertEqual(run(*command, cwd=self.out).returncode, 0, command)

    def test_signed_again_it_is_the_same(self):
        self.sign()
        first = {path.name: path.read_bytes() for path in pathlib.Path(self.out).iterdir()}
        self.sign()
        self.assertEqual({path.name: path.read_bytes() for path in pathlib.Path(self.out).iterdir()}, first)

    def test_a_changed_file_is_noticed(self):
        self.sign()
        self.write("nanoplc_0.1.0_amd64.deb", b"packagE")
        self.check_refuses("nanoplc_0.1.0_amd64.deb: its signature")

    def test_a_missing_file_is_noticed(self):
        self.sign()
        os.remove(os.path.join(self.out, "nanoplc_0.1.0_amd64.deb"))
        done = run(SIGN, "--check", self.out, self.key + ".pub")
        self.assertEqual(done.returncode, 1)
        self.assertIn("a file is missing", done.stderr)

    def test_a_file_from_another_release_is_noticed(self):
        self.sign()
        self.write("nanoplc_0.0.9_amd64.deb", b"old")
        self.assertEqual(run("minisign", "-S", "-s", self.key, "-m", os.path.join(self.out, "nanoplc_0.0.9_amd64.deb")).returncode, 0)
        self.check_refuses("does not name: nanoplc_0.0.9_amd64.deb")

    def test_sums_without_the_right_signature_are_nothing(self):
        self.sign()
        self.refused("SHA256SUMS: its signature", "--check", self.out, self.other + ".pub")
        os.remove(os.path.join(self.out, "SHA256SUMS"))
        self.check_refuses("SHA256SUMS is missing")

    def test_what_cannot_be_signed_with_is_refused_and_leaves_nothing(self):
        before = self.names()
        self.refused("no such key", self.out, self.key + "x", "")
        self.refused("no secret key", self.out, self.key + ".pub", "")
        broken = self.key + ".broken"
        with open(self.key, encoding="utf-8") as good, open(broken, "w", encoding="utf-8") as file:
            file.write(good.readline() + "AAAA\n")
        done = run(SIGN, self.out, broken, "")
        self.assertEqual(done.returncode, 1)
        self.assertIn("could not be signed", done.stderr)
        self.assertEqual(self.names(), before)
        self.write("a name.deb", b"")
        self.refused("a name with a space", self.out, self.key, "")


if __name__ == "__main__":
    unittest.main()
