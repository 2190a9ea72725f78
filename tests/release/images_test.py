#!/usr/bin/env python3
"""The microcontrollers' images as they are delivered: names, version and commit in them, bills of materials, no trace of the build.

usage: images_test.py ROOT PRESET...    (which have been built)
"""

import os
import re
import subprocess
import sys
import tempfile
import unittest

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "package"))
import bill  # noqa: E402  pylint: disable=wrong-import-position

ROOT, PRESETS = os.path.realpath(sys.argv[1]), sys.argv[2:]
NAMES = {"mcu": "lm3s6965evb", "mcu-microbit": "microbit", "mcu-modbus": "lm3s6965evb+modbus", "mcu-set-points": "lm3s6965evb+set_points"}


class Images(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="images")
        cls.addClassCleanup(cls.folder.cleanup)
        cls.out = cls.folder.name
        for preset in PRESETS:
            subprocess.run([sys.executable, "-B", os.path.join(ROOT, "tools/packing/pack_image"), "--source", ROOT, "--build",
                            os.path.join(ROOT, "build", preset), "--out", cls.out], check=True)
        with open(os.path.join(ROOT, "CMakeLists.txt"), encoding="utf-8") as file:
            cls.version = re.search(r"project\(.* VERSION (\S+)", file.read())[1]

    def path(self, preset, ending):
        return os.path.join(self.out, f"nanoplc-{NAMES[preset]}_{self.version}.{ending}")

    def test_each_is_there_in_each_form(self):
        self.assertEqual(sorted(os.listdir(self.out)), sorted(
            os.path.basename(self.path(preset, ending)) for preset in PRESETS for ending in ("elf", "bin", "hex", "spdx.json")))

    def test_each_says_what_it_is_and_what_it_was_built_from(self):
        for preset in PRESETS:
            with open(self.path(preset, "bin"), "rb") as file:
                data = file.read()
            found = re.findall(rb"[a-z0-9_+]+ [0-9.]+ (?:[0-9a-f]{12}(?:-changed)?|unknown)\0", data)
            self.assertEqual(len(found), 1, preset)
            self.assertRegex(found[0].decode(), rf"^{re.escape(NAMES[preset])} {re.escape(self.version)} "
                             r"([0-9a-f]{12}(-changed)?|unknown)\0$")
            # The register FW_VERSION of the same image has the same version.
            numbers = [int(number) for number in self.version.split(".")]
            with open(os.path.join(ROOT, "firmware/gateway/include/gateway/version.h"), encoding="utf-8") as file:
                said = int(re.search(r"kFirmwareVersion = (0x[0-9A-Fa-f']+)", file.read())[1].replace("'", ""), 16)
            self.assertEqual(said, numbers[0] << 16 | numbers[1] << 8 | numbers[2])

    def test_the_bills_of_materials_are_true(self):
        for preset in PRESETS:
            path = self.path(preset, "spdx.json")
            self.assertEqual(bill.problems(path, self.path(preset, "bin")), [], preset)
            document = bill.read(path)
            # The compiler's helpers, as for a division where the processor has none, are all that comes of an archive.
            symbols = subprocess.run(["arm-none-eabi-nm", self.path(preset, "elf")], check=True, capture_output=True, text=True).stdout
            helped = {"gcc-arm-none-eabi"} if re.search(r" __(aeabi|gnu_thumb1)_\w+$", symbols, re.MULTILINE) else set()
            self.assertEqual(bill.related(document, "STATIC_LINK"), helped, preset)
            self.assertEqual(bill.related(document, "DYNAMIC_LINK"), set(), preset)
            self.assertIn("libnewlib-dev", bill.related(document, "GENERATED_FROM"), preset)

    def test_they_have_no_trace_of_where_and_when_they_were_built(self):
        self.assertEqual(list(bill.build_traces(self.out, os.path.join(ROOT, "build"), ROOT)), [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
