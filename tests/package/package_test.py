#!/usr/bin/env python3
"""The Debian package: what is in it, and what an installation, an upgrade, a removal and a purge leave.

usage: package_test.py BUILD_FOLDER
"""

import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

BUILD = ""
DEB = ""
SETTINGS = "etc/nanoplc/nanoplc.toml"
STORE = "var/lib/nanoplc/x/store.bin"


def run(*command, **more):
    return subprocess.run(command, capture_output=True, text=True, check=False, **more)


def build():
    shutil.rmtree(os.path.join(BUILD, "package"), ignore_errors=True)
    done = run("cmake", "--build", BUILD, "--target", "debian_package")
    found = glob.glob(os.path.join(BUILD, "package", "nanoplc_*.deb"))
    if done.returncode != 0 or len(found) != 1:
        sys.exit(f"{done.stdout}\n{done.stderr}\nthe package cannot be built")
    return found[0]


class Package(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = os.path.join(self.folder.name, "root")
        os.mkdir(self.root)

    def tearDown(self):
        self.folder.cleanup()

    def unpack(self):
        subprocess.run(["dpkg-deb", "-x", DEB, self.root], check=True)

    def path(self, name):
        return os.path.join(self.root, name)

    def read(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return file.read()

    def test_what_is_in_it(self):
        self.unpack()
        for name in ("usr/sbin/nanoplc", "usr/bin/nanoctl", SETTINGS, "lib/systemd/system/nanoplc.service",
                     "lib/udev/rules.d/70-nanoplc.rules", "usr/share/man/man8/nanoplc.8", "usr/share/man/man1/nanoctl.1",
                     "usr/share/bash-completion/completions/nanoplc", "usr/share/zsh/site-functions/_nanoplc",
                     "usr/share/doc/nanoplc/FIRST_START.md"):
            self.assertTrue(os.path.isfile(self.path(name)), name)
        files = [name for _, _, names in os.walk(self.root) for name in names]
        self.assertEqual([name for name in files if name in ("macreg", "seqc", "macsim", "nanoplc-sim")], [])
        self.assertEqual(run(self.path("usr/sbin/nanoplc"), "--version").returncode, 0)
        checked = run(self.path("usr/sbin/nanoplc"), "check-config", "--no-devices", self.path(SETTINGS))
        self.assertEqual((checked.returncode, checked.stderr), (0, ""))

    def test_what_it_says_of_itself(self):
        fields = run("dpkg-deb", "-f", DEB).stdout
        for wanted in (r"(?m)^Package: nanoplc$", r"(?m)^Depends: .*libc6", r"(?m)^Depends: .*libgpiod", r"(?m)^Depends: .*adduser"):
            self.assertRegex(fields, wanted)
        self.assertEqual(run("dpkg-deb", "-I", DEB, "conffiles").stdout, "/" + SETTINGS + "\n")
        for script in ("postinst", "prerm", "postrm"):
            text = run("dpkg-deb", "-I", DEB, script).stdout
            self.assertTrue(text.startswith("#!/bin/sh\nset -e\n"), script)
            self.assertEqual(run("sh", "-n", input=text).returncode, 0, script)

    def test_the_service(self):
        self.unpack()
        unit = self.read("lib/systemd/system/nanoplc.service")
        for wanted in ("Type=notify", "User=nanoplc", "WatchdogSec=", "NoNewPrivileges=yes", "DevicePolicy=closed",
                       "DeviceAllow=char-gpiochip rw", "StateDirectory=nanoplc", "RestartPreventExitStatus=2"):
            self.assertIn(wanted, unit)
        if shutil.which("systemd-analyze") is None:
            self.skipTest("there is no systemd-analyze here")
        copy = os.path.join(self.folder.name, "nanoplc.service")
        with open(copy, "w", encoding="utf-8") as file:
            file.write(unit.replace("/usr/sbin/nanoplc", self.path("usr/sbin/nanoplc")))
        verified = run("systemd-analyze", "verify", "--man=no", copy)
        about_it = [line for line in verified.stderr.splitlines() if "nanoplc" in line]
        self.assertEqual((verified.returncode, about_it), (0, []), verified.stderr)
        rated = run("systemd-analyze", "security", "--offline=true", copy)
        match = re.search(r"Overall exposure level for nanoplc.service: ([0-9.]+)", rated.stdout)
        self.assertIsNotNone(match, rated.stdout + rated.stderr)
        print(f"exposure of the service by systemd-analyze: {match.group(1)} of 10")
        self.assertLess(float(match.group(1)), 2.2)  # CAN and the state of its interface cost 0.2

    def test_settings_and_tables_outlive_upgrade_and_removal(self):
        if os.geteuid() != 0:
            self.skipTest("dpkg wants to be root even in a root of its own")
        for name in ("var/lib/dpkg/info", "var/lib/dpkg/updates", "var/lib/dpkg/triggers"):
            os.makedirs(self.path(name))
        open(self.path("var/lib/dpkg/status"), "w", encoding="utf-8").close()

        def dpkg(*arguments):
            done = run("dpkg", f"--root={self.root}", "--force-depends", "--force-script-chrootless", "--force-not-root",
                       *arguments)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

        dpkg("-i", DEB)
        with open(self.path(SETTINGS), "a", encoding="utf-8") as file:
            file.write("# mine\n")
        os.makedirs(os.path.dirname(self.path(STORE)))
        with open(self.path(STORE), "wb") as file:
            file.write(b"table")
        for step in (("--force-confdef", "-i", DEB), ("-r", "nanoplc")):
            dpkg(*step)
            self.assertIn("# mine", self.read(SETTINGS), step)
            self.assertEqual(self.read(STORE), "table", step)
        self.assertFalse(os.path.exists(self.path("usr/sbin/nanoplc")))
        dpkg("-i", DEB)
        self.assertIn("# mine", self.read(SETTINGS))
        dpkg("-P", "nanoplc")
        self.assertFalse(os.path.exists(self.path(SETTINGS)))
        self.assertFalse(os.path.exists(self.path("var/lib/nanoplc")))

    def test_lintian(self):
        if shutil.which("lintian") is None:
            self.skipTest("there is no lintian here")
        # Left out: what the project has not (a licence file, Debian's changelog, a maintainer's address), and what a package
        # of one's own need not.
        left_out = ("no-copyright-file,no-changelog,bogus-mail-host,root-in-contact,uncompressed-manual-page,"
                    "maintainer-script-calls-systemctl")
        done = run("lintian", "--allow-root", "--fail-on", "error", "--suppress-tags", left_out, DEB)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    BUILD = os.path.abspath(sys.argv[1])
    DEB = build()
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
