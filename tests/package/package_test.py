#!/usr/bin/env python3
"""The Debian package: what is in it, and what an installation, an upgrade, a removal and a purge leave.

usage: package_test.py BUILD_FOLDER
"""

import glob
import gzip
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import bill
import deb
from deb import run

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
BUILD = ""
VERSION = r"^[a-z-]+ \d+\.\d+\.\d+ \(commit ([0-9a-f]{12}(-changed)?|unknown)\)\n$"
DEB = ""
SETTINGS = "etc/nanoplc/nanoplc.toml"
STORE = "var/lib/nanoplc/x/store.bin"


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
                     "lib/udev/rules.d/70-nanoplc.rules", "lib/udev/rules.d/99-nanoplc-brltty.rules", "usr/share/man/man8/nanoplc.8.gz", "usr/share/man/man1/nanoctl.1.gz",
                     "usr/share/bash-completion/completions/nanoplc", "usr/share/zsh/site-functions/_nanoplc",
                     "usr/share/doc/nanoplc/FIRST_START.md"):
            self.assertTrue(os.path.isfile(self.path(name)), name)
        files = [name for _, _, names in os.walk(self.root) for name in names]
        self.assertEqual([name for name in files if name in ("macreg", "seqc", "macsim", "nanoplc-sim")], [])
        for program in ("usr/sbin/nanoplc", "usr/bin/nanoctl"):
            self.assertRegex(run(self.path(program), "--version").stdout, VERSION)
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
        self.assertLess(float(match.group(1)), 2.0)  # CAN and the state of its interface cost 0.2

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

    def test_lintian_says_nothing(self):
        deb.expect_lintian_silent(self, DEB)

    def test_the_bill_of_materials_is_true(self):
        path = DEB.removesuffix(".deb") + ".spdx.json"
        self.assertEqual(bill.problems(path, DEB), [])
        document = bill.read(path)
        # Debian's own tool found out what the package needs to run.
        self.assertEqual(bill.related(document, "DYNAMIC_LINK"), deb.needed(DEB) - {"adduser"})
        self.assertLess({"libboost1.74-dev", "libcli11-dev", "libfmt-dev", "libtomlplusplus-dev"}, bill.related(document, "GENERATED_FROM"))
        with open(os.path.join(ROOT, "firmware", "faces", "panel", "bundle", "README.md"), encoding="utf-8") as file:
            uplot = re.search(r"uPlot ([0-9.]+) by", file.read())[1]
        self.assertIn(("uplot", uplot), [(package["name"], package["versionInfo"]) for package in document["packages"]])

    def test_it_contains_the_notices_of_what_is_in_it(self):
        self.unpack()
        document = bill.read(DEB.removesuffix(".deb") + ".spdx.json")
        for how in ("GENERATED_FROM", "STATIC_LINK", "CONTAINS"):
            for name in bill.related(document, how) - {"nanoplc", "nanoctl"}:
                self.assertIn(f"    {name} ", self.read("usr/share/doc/nanoplc/copyright"))
                with gzip.open(self.path(f"usr/share/doc/nanoplc/notices/{name}.gz"), "rt", encoding="utf-8") as file:
                    self.assertRegex(file.read(), "(?i)copyright", name)

    def test_it_has_no_trace_of_where_and_when_it_was_built(self):
        self.unpack()
        self.assertEqual(list(bill.build_traces(self.root, BUILD, ROOT)), [])

    def test_packed_elsewhere_it_is_the_same(self):
        with open(DEB, "rb") as file:
            first = file.read()
        other = {**os.environ, "TZ": "Asia/Tokyo", "LC_ALL": "C", "LANGUAGE": "fr", "HOME": self.root, "USER": "other", "LOGNAME": "other"}
        done = run("sh", "-c", f"umask 077; cmake --build '{BUILD}' --target debian_package", env=other)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        with open(DEB, "rb") as file:
            self.assertTrue(file.read() == first, "diffoscope would tell what is not the same")


if __name__ == "__main__":
    BUILD = os.path.abspath(sys.argv[1])
    DEB = build()
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
