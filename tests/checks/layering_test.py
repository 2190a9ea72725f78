#!/usr/bin/env python3
"""The layering check must find planted violations of each kind, and nothing in a tree without any."""

import os
import tempfile
import unittest

import layering

PRIVATE = {"sequencer/scan_detail.h": "#pragma once\n"}


class Layering(unittest.TestCase):
    def check(self, path, text, others=None):
        with tempfile.TemporaryDirectory() as root:
            for name, content in {**(others or {}), path: text}.items():
                file = os.path.join(root, name)
                os.makedirs(os.path.dirname(file), exist_ok=True)
                with open(file, "w", encoding="utf-8") as out:
                    out.write(content)
            findings, checked = layering.check_tree(root)
            self.assertEqual(checked, 1 + len(others or {}))
            return findings

    def refused(self, kind, line, path, text, others=None):
        findings = self.check(path, text, others)
        self.assertEqual(len(findings), 1, f"{path}: {text!r} gave {findings}")
        self.assertTrue(findings[0].startswith(f"{path}:{line}: {kind}: "), findings[0])

    def accepted(self, path, text, others=None):
        self.assertEqual(self.check(path, text, others), [])

    def test_a_module_that_may_not_be_included(self):
        forbidden = [
            ("hal/base/include/base/a.h", "ports/clock.h"),
            ("hal/ports/include/ports/a.h", "sequencer/term.h"),
            ("hal/linux/a.cpp", "protocol/fastmac.h"),
            ("hal/mcu/a.cpp", "motor/motor.h"),
            ("sequencer/a.cpp", "ports/clock.h"),
            ("sequencer/a.cpp", "protocol/fastmac.h"),
            ("firmware/protocol/a.cpp", "ports/serial.h"),
            ("firmware/protocol/a.cpp", "registers/mac.h"),
            ("firmware/registers/a.cpp", "protocol/fastmac.h"),
            ("firmware/motor/a.cpp", "store/slots.h"),
            ("firmware/motor/a.cpp", "gateway/gateway.h"),
            ("firmware/gateway/a.cpp", "hal_linux/clock.h"),
            ("firmware/gateway/a.cpp", "sim/clock.h"),
            ("host-sim/a.cpp", "motor/motor.h"),
            ("host-sim/a.cpp", "sequencer/term.h"),
            ("tools/sequence/a.cpp", "motor/motor.h"),
            ("tools/sequence/a.cpp", "ports/serial.h"),
            ("tools/sequence/main.cpp", "gateway/gateway.h"),
            ("tools/macreg/a.cpp", "seqc/compiler.h"),
            ("tools/sequence/a.cpp", "hal_linux/file_storage.h"),
            ("tools/mactalk_client/a.cpp", "hal_windows/a.h"),
            ("hal/host/a.cpp", "hal_linux/byte_server.h"),
            ("tools/arguments/a.cpp", "base/result.h"),
        ]
        for path, header in forbidden:
            self.refused("layering", 2, path, f'\n#include "{header}"\n')

    def test_angle_brackets_do_not_hide_it(self):
        self.refused("layering", 1, "sequencer/a.cpp", "#include <ports/clock.h>\n")

    def test_what_each_may_include(self):
        for path, header in [
            ("hal/ports/include/ports/a.h", "base/time.h"),
            ("sequencer/a.cpp", "sequencer/term.h"),
            ("firmware/motor/a.cpp", "protocol/fastmac.h"),
            ("firmware/motor/a.cpp", "sequencer/state.h"),
            ("firmware/gateway/a.cpp", "sequencer/term.h"),
            ("firmware/boards/pi/main.cpp", "hal_linux/clock.h"),
            ("host-sim/nanoplc_sim/main.cpp", "gateway/gateway.h"),
            ("host-sim/sim_main.cpp", "seqc/compiler.h"),
            ("host-sim/board/board.cpp", "gateway/gateway.h"),
            ("tools/sequence/a.cpp", "registers/mac.h"),
            ("tools/macreg/main.cpp", "host/terminal.h"),
            ("tests/e2e/a.cpp", "sim/motor.h"),
        ]:
            self.accepted(path, f'#include "{header}"\n')

    def test_operating_system_and_vendor_headers(self):
        headers = ["unistd.h", "termios.h", "sys/socket.h", "linux/can.h", "gpiod.h", "stm32f1xx.h", "fcntl.h"]
        for path in [
            "sequencer/a.cpp", "hal/ports/include/ports/a.h", "hal/host/include/host/a.h", "firmware/gateway/a.cpp",
            "tools/sequence/a.cpp", "tools/macreg/cli/a.cpp",
        ]:
            for header in headers:
                self.refused("OS or vendor header", 1, path, f"#include <{header}>\n")
        for path in ["hal/linux/a.cpp", "hal/mcu/a.cpp", "host-sim/a.cpp", "tools/macreg/ui/a.cpp", "tests/e2e/a.cpp"]:
            self.accepted(path, "#include <termios.h>\n")

    def test_heap_and_io_headers(self):
        headers = ["iostream", "string", "vector", "functional", "memory", "thread", "map", "cmath", "expected"]
        for path in ["hal/base/include/base/a.h", "hal/mcu/a.cpp", "sequencer/a.cpp", "firmware/motor/a.cpp"]:
            for header in [*headers, "fmt/core.h"]:
                self.refused("heap or I/O", 1, path, f"#include <{header}>\n")
        for path in ["hal/linux/a.cpp", "host-sim/a.cpp", "tools/sequence/a.cpp"]:
            self.accepted(path, "#include <vector>\n#include <fmt/core.h>\n")
        self.accepted("sequencer/a.cpp", "#include <array>\n#include <cstdint>\n#include <span>\n")

    def test_a_library_that_one_folder_hides(self):
        for path in ["tools/sequence/cli/main.cpp", "tools/command_line/a.h", "host-sim/macsim/a.cpp", "tests/seqc/a.cpp"]:
            self.refused("hidden library", 1, path, "#include <CLI/CLI.hpp>\n")
        self.accepted("tools/arguments/arguments.cpp", "#include <CLI/CLI.hpp>\n")

    def test_clock_reads(self):
        reads = [
            "auto t = std::chrono::steady_clock::now();",
            "using Clock = std::chrono::system_clock;",
            "clock_gettime(CLOCK_MONOTONIC, &t);",
            "auto t = std::time(nullptr);",
        ]
        for path in ["sequencer/a.cpp", "firmware/gateway/a.cpp", "host-sim/a.cpp", "tools/sequence/a.cpp", "tests/e2e/a.cpp"]:
            for read in reads:
                self.refused("clock", 2, path, f"\n{read}\n")
        for path in ["hal/linux/clock.cpp", "hal/mcu/clock.cpp", "firmware/boards/pi/main.cpp", "host-sim/sim_main.cpp"]:
            self.accepted(path, reads[0] + "\n")

    def test_bits_of_commands_and_terms(self):
        self.refused("bits", 1, "tools/sequence/compiler/a.cpp", '#include "protocol/fastmac.h"\n')
        self.refused("bits", 2, "tools/sequence/analysis/a.cpp", "\nint n = int(fastmac::Number::home);\n")
        self.refused("bits", 1, "tools/sequence/report/a.cpp", "int next = term[3] & 63;\n")
        self.refused("bits", 1, "host-sim/nanoplc_sim/a.cpp", "table[at + 6] = 1;\n")
        self.accepted("tools/sequence/table/a.cpp", '#include "protocol/fastmac.h"\nint next = term[3] & 63;\n')
        self.accepted("tools/sequence/symbols/a.cpp", 'int rows = table["rows"];  // term[3]\n')
        self.accepted("host-sim/nanoplc_sim/a.cpp", '#include "protocol/fastmac.h"\n')

    def test_a_header_nobody_owns(self):
        self.refused("unknown include", 1, "sequencer/a.cpp", '#include "nowhere.h"\n')
        self.refused("unknown include", 1, "sequencer/a.cpp", '#include "nowhere/a.h"\n')
        self.refused("unknown include", 1, "firmware/motor/a.cpp", '#include "../../sequencer/scan_detail.h"\n', PRIVATE)
        self.accepted("tests/bench/a.cpp", '#include "generated_by_the_build.h"\n')
        self.accepted("sequencer/a.cpp", '#include "scan_detail.h"\n', PRIVATE)
        self.accepted("sequencer/deep/a.cpp", '#include "scan_detail.h"\n', PRIVATE)

    def test_a_folder_without_a_row(self):
        self.refused("no module", 1, "firmware/gadget/a.cpp", "\n")

    def test_comments_and_strings_say_nothing(self):
        self.accepted("sequencer/a.cpp", '// #include "ports/clock.h"\n/*\n#include <vector>\nsteady_clock */\n')
        self.accepted("sequencer/a.cpp", 'const char* text = "std::chrono::steady_clock";\n')
        self.refused("layering", 3, "sequencer/a.cpp", '/* one\n two */\n#include "ports/clock.h"  // why\n')


if __name__ == "__main__":
    unittest.main()
