#!/usr/bin/env python3
"""Who may include whom. Reads the #include lines of all sources and reports those that cross a wall.

usage: layering.py [ROOT]
"""

import os
import re
import sys
from dataclasses import dataclass

import sources

ANY = "any module"


@dataclass(frozen=True)
class Module:
    folder: str
    prefix: str | None  # its public headers are included as "prefix/..."
    may: tuple | str  # prefixes of the modules it may include beside itself
    core: bool = False  # no heap, no I/O: a short list of standard headers only
    os: bool = False  # may include headers of the operating system or the chip's vendor
    clock: bool = False  # may read a clock


# The longest folder that holds a file decides.
MODULES = [
    Module("hal/base", "base", (), core=True),
    Module("hal/ports", "ports", ("base",), core=True),
    Module("hal/host", "host", ("base", "ports")),
    Module("hal/linux", "hal_linux", ("base", "ports", "host"), os=True, clock=True),
    Module("hal/windows", "hal_windows", ("base", "ports", "host"), os=True, clock=True),
    Module("hal/mcu", "hal_mcu", ("base", "ports"), core=True, os=True, clock=True),
    Module("sequencer", "sequencer", ("base",), core=True),
    Module("firmware/protocol", "protocol", ("base",), core=True),
    Module("firmware/registers", "registers", ("base",), core=True),
    Module("firmware/motor", "motor", ("base", "ports", "protocol", "registers", "sequencer"), core=True),
    Module("firmware/store", "store", ("base", "ports", "registers", "sequencer"), core=True),
    Module("firmware/signature", "signature", ("base",), core=True),
    Module("firmware/update", "update", ("base", "ports", "registers", "signature"), core=True),
    Module(
        "firmware/gateway",
        "gateway",
        ("base", "ports", "sequencer", "protocol", "registers", "motor", "store", "update"),
        core=True,
    ),
    Module("firmware/causes", "causes", ("base", "registers")),
    Module("firmware/toml_files", "toml_files", ()),
    Module("firmware/plant_file", "plant_file", ("registers", "toml_files")),
    Module("firmware/set_points", "set_points", ("base", "registers", "toml_files")),
    Module("firmware/digest", "digest", ()),
    Module("firmware/broker", "broker", (), os=True),
    Module("firmware/orders", "orders", ("base", "digest")),
    Module("firmware/boards", None, ANY, os=True, clock=True),
    Module(
        "firmware/boards/bare_metal",
        "bare_metal",
        ("base", "ports", "hal_mcu", "motor", "store", "gateway", "update"),
        core=True,
    ),
    Module("firmware/boards/listener", "listener", ("base", "ports", "gateway", "protocol", "registers", "hal_linux", "seat")),
    Module("firmware/faces/seat", "seat", ("base", "registers")),
    Module(
        "firmware/faces/model",
        "faces",
        ("base", "ports", "sequencer", "protocol", "registers", "motor", "store", "gateway", "seat", "set_points", "causes"),
    ),
    Module(
        "firmware/faces/panel",
        "panel",
        ("base", "ports", "sequencer", "registers", "hal_linux", "faces", "seat", "set_points", "causes"),
        os=True,
    ),
    Module("firmware/faces/modbus", "modbus", ("base", "ports", "protocol", "registers", "faces", "seat", "set_points", "causes", "hal_linux"), os=True),
    Module("firmware/faces/deployment", "deployment", ("base", "registers", "sequencer", "faces", "seat", "orders", "hal_linux")),
    Module("firmware/faces/mqtt", "mqtt", ("base", "broker", "registers", "faces", "set_points", "causes", "deployment", "orders", "hal_linux"), os=True),
    Module("firmware/faces/metrics", "metrics", ("base", "registers", "faces", "set_points", "causes", "hal_linux"), os=True),
    Module("host-sim", "sim", ("base", "ports", "protocol", "registers", "set_points"), os=True),
    Module("host-sim/scenario", "sim", ("base", "registers", "set_points", "text")),
    Module("host-sim/axis", "sim", ("host", "plant_file", "registers")),
    Module("host-sim/board", "sim", ANY, os=True, clock=True),
    Module(
        "host-sim/device_server",
        "sim",
        ("arguments", "base", "ports", "protocol", "registers", "host", "hal_linux"),
        os=True,
    ),
    Module(
        "host-sim/midisim",
        None,
        ("arguments", "base", "ports", "protocol", "registers", "host", "hal_linux", "sim"),
        os=True,
    ),
    Module(
        "host-sim/macsim",
        None,
        ("arguments", "base", "plant_file", "ports", "protocol", "registers", "host", "hal_linux", "sim"),
        os=True,
    ),
    Module("host-sim/fmu", "sim", ANY, os=True),
    Module("host-sim/nanoplc_sim", None, ANY, os=True, clock=True),
    Module("tools/text", "text", ()),
    Module("tools/whole_files", "whole_files", ("host",)),
    Module("tools/intel_hex", "intel_hex", ("host",)),
    Module("tools/arguments", "arguments", ("text",)),
    Module("tools/mactalk_client", "mactalk_client", ("base", "protocol", "host")),
    Module("tools/midi_client", "midi_client", ("base", "ports", "protocol", "registers", "host", "mactalk_client")),
    Module("tools/command_line", "command_line", ("arguments", "base", "host", "mactalk_client", "registers")),
    Module("tools/uploads", "uploads", ("base", "command_line", "digest", "host", "intel_hex", "proof", "registers", "seqc", "sequencer", "set_points", "whole_files")),
    Module("tools/nanofleet", "nanofleet", ("arguments", "base", "broker", "command_line", "host", "orders", "set_points", "toml_files", "uploads", "whole_files"),
           os=True),
    Module(
        "tools/nanoctl",
        "nanoctl",
        ("arguments", "base", "causes", "sequencer", "protocol", "registers", "store", "seqc", "host", "intel_hex",
         "mactalk_client", "command_line", "digest", "proof", "set_points", "signature", "text", "update", "uploads", "whole_files"),
    ),
    Module("tools/registers_reference", "registers_reference", ("base", "registers")),
    # The language and what becomes of it, in the order of the way from a source line to a table's bytes. seqc/ is what others include.
    Module("tools/sequence/diagnostics", "diagnostics", ("seqc", "host")),
    Module("tools/sequence/language", "language", ("seqc", "diagnostics", "host", "text", "whole_files")),
    Module("tools/sequence/symbols", "symbols", ("seqc", "language", "table", "base", "host", "protocol", "registers", "sequencer", "set_points")),
    # The one model of a step in every case: nothing else reads a term's bytes.
    Module("tools/sequence/table", "table", ("base", "sequencer", "protocol", "registers")),
    Module("tools/sequence/analysis", "analysis", ("base", "sequencer", "protocol", "registers", "table")),
    Module("tools/sequence/compiler", "compiler",
           ("seqc", "language", "symbols", "diagnostics", "table", "analysis", "protocol", "registers", "sequencer", "set_points")),
    Module("tools/sequence/lowering", "lowering", ("compiler", "diagnostics", "table", "sequencer")),
    Module("tools/sequence/report", "report",
           ("seqc", "language", "symbols", "diagnostics", "table", "compiler", "lowering", "analysis", "base", "host", "protocol", "registers", "sequencer",
            "set_points")),
    Module("tools/sequence/format", "format", ("seqc", "language", "symbols", "registers")),
    Module("tools/sequence/proof", "proof", ("digest",)),
    Module("tools/sequence/editing", "editing",
           ("seqc", "language", "symbols", "diagnostics", "table", "compiler", "report", "registers", "sequencer")),
    Module("tools/sequence/rpc", "rpc", ("base",)),
    # The one door from seqc to the simulator: scenarios are read and programs rehearsed by what nanoplc-sim uses.
    Module("tools/sequence/rehearsal", "rehearsal", ("base", "plant_file", "registers", "seqc", "sequencer", "set_points", "sim")),
    Module("tools/sequence/dap", "dap", ("base", "host", "mactalk_client", "nanoctl", "registers", "rehearsal", "rpc", "seqc", "text",
                                          "whole_files")),
    Module("tools/sequence/lsp", "lsp", ("seqc", "language", "editing", "report", "analysis", "rehearsal", "rpc", "host", "sequencer", "whole_files")),
    Module("tools/sequence/cli", "cli",
           ("seqc", "language", "symbols", "diagnostics", "table", "compiler", "report", "analysis", "proof", "dap", "lsp", "arguments", "digest", "host", "intel_hex",
            "registers", "sequencer", "set_points", "whole_files")),
    Module("tools/sequence", "seqc", ("language", "symbols", "compiler", "lowering", "analysis", "registers", "set_points")),
    Module(
        "tools/macreg",
        "macreg",
        ("arguments", "base", "causes", "plant_file", "protocol", "registers", "host", "mactalk_client", "midi_client",
         "command_line", "text", "whole_files"),
    ),
    Module("tools/macreg/fit", "macreg", ("plant_file", "registers")),
    # The one door from macreg to the simulator.
    Module("tools/macreg/prediction", "macreg", ("plant_file", "registers", "sim")),
    Module("tools/macreg/ui", "macreg", ("base", "causes", "protocol", "registers", "mactalk_client", "text"), os=True),
    Module("tools/cmake", None, ()),
    Module("tests", None, ANY, os=True),
    Module("tests/bench", None, ANY, os=True, clock=True),
]

# Composition roots name concrete parts and the clock: the boards, the simulated one included (the rows that may
# include any module), and in host-sim and tools the programs' main files.
ROOT_FILE = re.compile(r"^(host-sim|tools)/(.*/)?(main|\w+_main)\.cpp$")
ROOT_MAY = {"host-sim": ANY, "tools": ("ports", "host")}

# What works without an operating system and never allocates.
CORE_STANDARD = set(
    """algorithm array atomic bit cassert cctype charconv chrono climits compare concepts cstddef cstdint cstdlib
    cstring initializer_list iterator limits new numeric optional ranges ratio span string_view tuple type_traits
    utility variant version""".split()
)
# Standard headers that others may have and the core may not; named so that the message can say why.
HOSTED_STANDARD = set(
    """any barrier bitset cerrno cfenv cfloat cinttypes clocale cmath codecvt complex condition_variable coroutine
    csetjmp csignal cstdarg cstdio ctime cuchar cwchar cwctype deque exception execution expected filesystem format
    forward_list fstream functional future iomanip ios iosfwd iostream istream iterator latch list locale map memory
    memory_resource mutex numbers ostream queue random regex scoped_allocator semaphore set shared_mutex
    source_location spanstream sstream stack stacktrace stdexcept stop_token streambuf string strstream syncstream
    system_error thread typeindex typeinfo unordered_map unordered_set valarray vector""".split()
)
# Headers that take seconds to compile, and one of libmd: few folders hide them from all others.
HIDDEN = {
    "CLI/": ("tools/arguments",),
    "boost/": ("firmware/faces/panel",),
    "toml++/": ("firmware/toml_files",),
    "Eigen/": ("tools/macreg/fit",),
    "unsupported/Eigen/": ("tools/macreg/fit",),
    "sha2.h": ("firmware/digest",),
    "sodium.h": ("firmware/orders",),
    "minizip/": ("host-sim/fmu", "tests"),
}
LIBRARIES = ("gtest/", "gmock/", "benchmark/", "fmt/", "CLI/", "boost/", "nlohmann/", "stb/", "toml++/", "Eigen/", "unsupported/Eigen/", "sha2.h", "sodium.h", "minizip/", "zlib.h")

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.MULTILINE)
COMMENT_OR_STRING = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.DOTALL)
CLOCK = re.compile(
    r"\b(?:\w+_clock\s*::\s*now|(?:std\s*::\s*)?chrono\s*::\s*\w+_clock|(?:steady|system|high_resolution)_clock"
    r"|clock_gettime|gettimeofday|timespec_get|std\s*::\s*time\s*\()"
)
# Only tools/sequence/table defines what the bits of a command or a term mean; the simulated motor decodes commands by itself.
BITS_ARE_FOR = "tools/sequence/table/"
BITS = (
    (("tools/sequence/",), re.compile(r"\bfastmac::|protocol/fastmac\.h"), "table/commands.h"),
    (("tools/sequence/", "host-sim/nanoplc_sim/"), re.compile(r"\b(?:bytes|term|table)_?\[(?!\")"), "table/terms.h"),
)


def module_of(path):
    inside = [m for m in MODULES if path.startswith(m.folder + "/")]
    return max(inside, key=lambda m: len(m.folder), default=None)


def line_of(text, position):
    return text.count("\n", 0, position) + 1


class Checker:
    def __init__(self, root):
        self.root = root
        self.findings = []

    def find(self, path, line, kind, message):
        self.findings.append(f"{path}:{line}: {kind}: {message}")

    def check(self, path):
        module = module_of(path)
        if module is None:
            self.find(path, 1, "no module", "no row of MODULES in tests/checks/layering.py holds this folder")
            return
        text = sources.read(self.root, path)
        for match in INCLUDE.finditer(blank_comments(text, strings=False)):
            self.check_include(path, module, line_of(text, match.start()), match.group(1), match.group(2))
        if not module.clock and not ROOT_FILE.match(path):
            for match in CLOCK.finditer(blank_comments(text, strings=True)):
                self.find(path, line_of(text, match.start()), "clock",
                          f"`{match.group(0)}`: time is a parameter; only hal/* and composition roots read a clock")

        self.check_bits(path, text)

    def check_bits(self, path, text):
        for folders, pattern, header in BITS:
            if not path.startswith(folders) or path.startswith(BITS_ARE_FOR):
                continue
            for match in pattern.finditer(blank_comments(text, strings=False)):
                self.find(path, line_of(text, match.start()), "bits", f"`{match.group(0)}`: ask {header}, which names them")

    def check_include(self, path, module, line, bracket, header):
        prefix = header.split("/")[0] if "/" in header else None
        if prefix in {m.prefix for m in MODULES if m.prefix} and not self.is_private(path, module, header):
            self.check_own(path, module, line, header, prefix)
        elif bracket == '"':
            if module.may != ANY and not self.is_private(path, module, header):
                self.find(path, line, "unknown include",
                          f'"{header}" is neither beside this file nor a public header ("module/name.h") of ours')
        else:
            self.check_foreign(path, module, line, header)

    def check_own(self, path, module, line, header, prefix):
        may = module.may
        if ROOT_FILE.match(path) and may != ANY:
            more = ROOT_MAY[path.split("/")[0]]
            may = ANY if more == ANY else may + more
        if may != ANY and prefix != module.prefix and prefix not in may:
            allowed = ", ".join(may) or "nothing of ours"
            self.find(path, line, "layering", f'{module.folder} may not include "{header}" (it may include: {allowed})')

    def is_private(self, path, module, header):
        folders = (os.path.dirname(path), module.folder)
        for folder in folders:
            target = os.path.normpath(os.path.join(folder, header))
            if os.path.isfile(os.path.join(self.root, target)) and target.startswith(module.folder + "/"):
                return module_of(target) is module
        return False

    def check_foreign(self, path, module, line, header):
        if header in CORE_STANDARD:
            return
        for hidden, folders in HIDDEN.items():
            if header.startswith(hidden) and module.folder not in folders:
                self.find(path, line, "hidden library",
                          f"<{header}>: only {' and '.join(folders)} may include it; include ours")
                return
        if header in HOSTED_STANDARD or header.startswith(LIBRARIES):
            if module.core:
                self.find(path, line, "heap or I/O", f"<{header}>: {module.folder} is core, which has no heap, no I/O, "
                          "no threads, no exceptions, no floating point and no libraries")
        elif not module.os:
            self.find(path, line, "OS or vendor header",
                      f"<{header}> belongs in hal/linux, hal/windows, hal/mcu, firmware/boards or host-sim (if it is "
                      "standard and works without an OS, add it to CORE_STANDARD in tests/checks/layering.py)")


def blank_comments(text, strings):
    """The text with comments (and string literals) blanked, its lines and columns kept."""

    def blank(match):
        if match.group(0).startswith('"') and not strings:
            return match.group(0)
        return re.sub(r"[^\n]", " ", match.group(0))

    return COMMENT_OR_STRING.sub(blank, text)


def check_tree(root):
    checker = Checker(root)
    paths = sources.cxx(root)
    for path in paths:
        checker.check(path)
    return checker.findings, len(paths)


if __name__ == "__main__":
    tree = sys.argv[1] if len(sys.argv) > 1 else os.path.join(os.path.dirname(__file__), "..", "..")
    sources.report(*check_tree(tree), "source files")
