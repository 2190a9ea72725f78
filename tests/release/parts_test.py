#!/usr/bin/env python3
"""Whose a file is and under which licence, from a dpkg database and copyright files written here; what is in a bundle of npm packages."""

import json
import os
import sys
import tempfile
import unittest

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tools", "packing"))
import debian  # noqa: E402  pylint: disable=wrong-import-position
import npm  # noqa: E402  pylint: disable=wrong-import-position

FORMAT = "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/\nUpstream-Name: x\n\n"


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="parts")
        self.addCleanup(folder.cleanup)
        self.root = folder.name

    def write(self, name, text):
        path = os.path.join(self.root, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path


class Debian(Folder):
    def package(self, name, text, *fields):
        """The package `name` with one file /usr/lib/NAME.a and its copyright file, found by the file."""
        self.write("var/lib/dpkg/status", "\n".join((f"Package: {name}", "Version: 1.2-3", "Architecture: arm64", *fields)) + "\n\n")
        self.write(f"var/lib/dpkg/info/{name}.list", f"/.\n/usr\n/usr/lib\n/usr/lib/{name}.a\n")
        if text:
            self.write(f"usr/share/doc/{name}/copyright", text)
        return debian.Database(self.root).owner(self.write(f"usr/lib/{name}.a", ""))

    def licence(self, text, name="xyz", *fields):
        return debian.licence(self.package(name, text, *fields))

    def test_a_file_is_of_the_package_that_lists_it(self):
        found = self.package("xyz", "", "Source: xyz-source (1.2)")
        self.assertEqual((found.name, found.version, found.architecture, found.source, found.source_version),
                         ("xyz", "1.2-3", "arm64", "xyz-source", "1.2"))
        self.assertIsNone(debian.Database(self.root).owner(self.write("usr/lib/other.a", "")))
        # A link to it is it; /lib is /usr/lib.
        os.symlink("xyz.a", os.path.join(self.root, "usr/lib/link.a"))
        self.assertEqual(debian.Database(self.root).owner(os.path.join(self.root, "usr/lib/link.a")).name, "xyz")
        self.assertEqual(debian.Database(self.root).owner(self.write("lib/xyz.a", "")).name, "xyz")

    def test_licences_that_a_machine_can_read(self):
        for said, expression in (("Expat", "MIT"), ("LGPL-2.1+", "LGPL-2.1-or-later"), ("EPL-2.0 or EDL-1.0", "EPL-2.0 OR BSD-3-Clause"),
                                 ("GPL-2+ and Zlib or MIT", "(GPL-2.0-or-later AND Zlib OR MIT)")):
            text = f"{FORMAT}Files: debian/*\nCopyright: d\nLicense: GPL-3\n\nFiles:\n *\nCopyright: x\nLicense: {said}\n\nLicense: {said}\n Text.\n"
            self.assertEqual(self.licence(text), (expression, {}))

    def test_the_licence_of_everything_goes_before_that_of_a_part(self):
        text = f"{FORMAT}Files: a/*\nCopyright: a\nLicense: Zlib\n\nFiles: *\nCopyright: x\nLicense: ISC\n Text.\n"
        self.assertEqual(self.licence(text)[0], "ISC")

    def test_what_has_no_name_is_given_as_a_text(self):
        for text in (f"{FORMAT}Files: *\nCopyright: x\nLicense: Beer-ware\n Text.\n", "You may copy it.\n"):
            self.assertEqual(self.licence(text, "xyz", "Source: x+yz"), ("LicenseRef-Debian-x-yz", {"LicenseRef-Debian-x-yz": text}))

    def test_what_is_known_by_hand_must_stand_in_the_file(self):
        self.assertEqual(self.licence("... under the GNU Lesser\n    General Public License", "libc6-dev")[0], "LGPL-2.1-or-later")
        self.assertEqual(self.licence("something else now", "libc6-dev")[0], "LicenseRef-Debian-libc6-dev")
        self.assertEqual(self.licence("GCC Runtime Library Exception", "libgcc-12-dev")[0], "GPL-3.0-or-later WITH GCC-exception-3.1")

    def test_the_kernels_headers_say_it_themselves(self):
        package = self.package("linux-libc-dev", f"{FORMAT}Files: *\nCopyright: x\nLicense: GPL-2\n", "Source: linux")
        one = self.write("a.h", "/* SPDX-License-Identifier: GPL-2.0 WITH Linux-syscall-note */\n")
        two = self.write("b.h", "/* SPDX-License-Identifier: ((GPL-2.0+ WITH Linux-syscall-note) OR MIT) */\n")
        self.assertEqual(debian.licence(package, [one, two])[0],
                         "((GPL-2.0-or-later WITH Linux-syscall-note) OR MIT) AND GPL-2.0-only WITH Linux-syscall-note")

    def test_without_a_copyright_file_nothing_is_packed(self):
        with self.assertRaisesRegex(LookupError, "xyz-nowhere: it has no copyright file"):
            self.licence("", "xyz-nowhere")

    def test_of_a_huge_copyright_file_the_notice_has_what_counts(self):
        parts = "".join(f"Files: part{n}/*\nCopyright: somebody\nLicense: Zlib\n\n" for n in range(5000))
        text = f"{FORMAT}Files: *\nCopyright: the author\nLicense: BSL-1.0\n\n{parts}License: BSL-1.0\n Boost's text.\n"
        notice = debian.notice(self.package("xyz", text))
        self.assertLess(len(notice), 200)
        self.assertRegex(notice, "(?s)the author.*BSL-1.0.*Boost's text")


class Npm(Folder):
    def setUp(self):
        super().setUp()
        lock = {"": {"version": "1.0.0"}, "node_modules/a": {"version": "1.1.0", "license": "MIT"},
                "node_modules/@s/b": {"version": "2.0.0", "license": "ISC"},
                "node_modules/a/node_modules/c": {"version": "3.0.0"}, "node_modules/tool": {"version": "9.0.0", "dev": True, "license": "MIT"}}
        self.write("package-lock.json", json.dumps({"packages": lock}))

    def test_of_a_lock_file_what_is_not_for_development_only(self):
        self.assertEqual(npm.packages(self.root), [("node_modules/@s/b", "2.0.0", "ISC"), ("node_modules/a", "1.1.0", "MIT"),
                                                   ("node_modules/a/node_modules/c", "3.0.0", "NOASSERTION")])

    def test_of_a_bundle_what_it_was_made_of(self):
        inputs = self.write("meta.json", json.dumps({"inputs": dict.fromkeys(
            ("src/main.js", "node_modules/@s/b/lib/x.js", "node_modules/a/node_modules/c/y.js"), {})}))
        self.assertEqual([path for path, _, _ in npm.packages(self.root, inputs)], ["node_modules/@s/b", "node_modules/a/node_modules/c"])

    def test_what_is_not_locked_is_refused(self):
        inputs = self.write("meta.json", json.dumps({"inputs": {"node_modules/strange/x.js": {}}}))
        with self.assertRaisesRegex(LookupError, "node_modules/strange is in the bundle"):
            npm.packages(self.root, inputs)

    def test_a_notice_is_the_packages_own_or_missing(self):
        os.makedirs(os.path.join(self.root, "node_modules/a"))
        with self.assertRaisesRegex(LookupError, "no licence's text"):
            npm.notice(os.path.join(self.root, "node_modules/a"))
        self.write("node_modules/a/LICENSE.md", "may be copied")
        self.assertEqual(npm.notice(os.path.join(self.root, "node_modules/a")), "may be copied")


if __name__ == "__main__":
    unittest.main()
