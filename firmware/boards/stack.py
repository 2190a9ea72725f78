#!/usr/bin/env python3
"""The most stack that a board's image can need, in bytes, and the calls that need it.

Reads what the compiler wrote with -fcallgraph-info=su beside the objects: each function's own need and its calls. A call
of a virtual function can reach what VIRTUAL says of the caller's module. On the deepest path of the loop the deepest
interrupt can come (all have the same priority), and on that a fault, which takes the stack anew.
"""

import argparse
import pathlib
import re
import subprocess
import sys
from collections import defaultdict

NODE = re.compile(r'node: \{ title: "([^"]+)" label: "([^"]*?)(?:\\n(\d+) bytes \(([\w,]+)\)[^"]*)?"')
EDGE = re.compile(r'edge: \{ sourcename: "([^"]+)" targetname: "([^"]+)"')
INDIRECT = "__indirect_call"
FILTER = "arm-none-eabi-c++filt"

# Whom virtual calls of a class (of a module's, where only that is named) can reach, by their qualified names.
SERIAL = r"nplc::hal_mcu::BufferedSerial::(read|write|transmitter_idle)"
VIRTUAL = [
    (r"nplc::hal_mcu::BufferedSerial::", r"nplc::hal_mcu::stellaris::Uart::(wake_transmitter|line_is_idle)"),
    (r"nplc::hal_mcu::I2cMemory::",
     r"nplc::hal_mcu::(stellaris::I2cMaster::(begin|state|abandon)|cortex_m::SysTickClock::now)"),
    (r"nplc::motor::", SERIAL),
    (r"nplc::store::TableCheck::", r"nplc::gateway::TableKeeper::accepts"),
    (r"nplc::store::Slots::(read|load|examine|crc_of|reads_back|erase_next|program_next|program_record)$",
     r"nplc::hal_mcu::I2cMemory::"),
    (r"nplc::store::", r"nplc::hal_mcu::I2cMemory::|nplc::store::(TableCheck|SettingsStore::Check)::"),
    (r"nplc::gateway::UserPort::", SERIAL + "|nplc::motor::JvlMotor::longwords_only"),
    (r"nplc::gateway::Gateway::motor_takes", r"nplc::motor::JvlMotor::can_execute"),
    (r"nplc::gateway::Gateway::write_outputs", r"nplc::hal_mcu::stellaris::OutputPins::write"),
    (r"nplc::gateway::|nplc::board::",
     r"nplc::motor::JvlMotor::|nplc::hal_mcu::stellaris::(InputPins::read|OutputPins::write|Watchdog::feed)"
     r"|nplc::hal_mcu::I2cMemory::geometry"),
]
# Pointers to functions that are called elsewhere than in virtual functions.
POINTERS = {"nplc_reset": r"_GLOBAL__sub_I_"}
ROOTS = r"nplc_reset$"
INTERRUPTS = r"nplc::board::on_\w+"
FRAME = 36  # bytes that an exception takes, with alignment
# The compiler's and the C library's, whose objects carry no such files; measured in their disassembly, rounded up.
FOREIGN = {"memcpy": 16, "memmove": 20, "memset": 16, "memcmp": 16, "__aeabi_lmul": 0}


class Graph:
    def __init__(self, files):
        self.need, self.name, self.calls, self.known = {}, {}, defaultdict(set), {}
        for file in files:
            text = file.read_text(encoding="utf-8")
            for title, label, size, kind in NODE.findall(text):
                self.name.setdefault(title, label)
                if size:
                    self.need[title], self.name[title] = int(size), label
                    if kind == "dynamic":
                        sys.exit(f"{label}: its need is not bounded")
            for source, target in EDGE.findall(text):
                self.calls[source].add(target)
        titles = sorted(self.name)
        names = subprocess.run([FILTER], input="\n".join(t.rsplit(":", 1)[-1] for t in titles), check=True, capture_output=True, text=True).stdout
        self.plain = {t: n.replace("(anonymous namespace)::", "").split("(")[0] for t, n in zip(titles, names.split("\n"))}

    def matching(self, pattern):
        """Functions whose qualified name begins with the pattern."""
        return [title for title in self.need if re.match(pattern, self.qualified(title))]

    def qualified(self, title):
        """nplc::module::Class::function"""
        return self.plain[title]

    def reached(self, title):
        """What a function calls."""
        for target in self.calls[title]:
            if target != INDIRECT:
                yield target
                continue
            name = self.qualified(title)
            pattern = POINTERS.get(title) or next((to for of, to in VIRTUAL if re.match(of, name)), None)
            if pattern is None:
                sys.exit(f"{name}: a virtual call of unknown targets; VIRTUAL in {sys.argv[0]} needs a row")
            yield from self.matching(pattern)

    def deepest(self, title, above=()):
        """Bytes and the path."""
        if title not in self.need and title.replace("C1E", "C2E") in self.need:
            title = title.replace("C1E", "C2E")  # a complete object's constructor is its base's
        if title in above:
            sys.exit("recursion: " + " -> ".join(self.qualified(t) for t in (*above, title)))
        if title not in self.need:
            if title not in FOREIGN:
                sys.exit(f"{title}: called by {self.qualified(above[-1])}, and its need is unknown")
            return FOREIGN[title], [title]
        if title not in self.known:
            below = max((self.deepest(t, (*above, title)) for t in self.reached(title)), default=(0, []))
            self.known[title] = (self.need[title] + below[0], [title, *below[1]])
        return self.known[title]


def call_graph(object_file):
    return object_file.with_suffix(".ci")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folders", nargs="+", type=pathlib.Path, help="where the compiler put its .ci files")
    parser.add_argument("--at-most", type=int, required=True, help="bytes that there are")
    arguments = parser.parse_args()
    missing = [file for folder in arguments.folders for file in folder.rglob("*.cpp.obj") if not call_graph(file).exists()]
    if missing:
        sys.exit(f"{missing[0]} and {len(missing) - 1} more have no call graph; build anew: remove {arguments.folders[0]}")
    graph = Graph(sorted(file for folder in arguments.folders for file in folder.rglob("*.ci")))
    loop, path = max(graph.deepest(title) for title in graph.matching(ROOTS))
    interrupt, on_top = max(graph.deepest(title) for title in graph.matching(INTERRUPTS))
    total = loop + FRAME + interrupt + FRAME
    print(total, "bytes of stack at the most")
    for title in [*path, *on_top]:
        print(f"  {graph.need.get(title, FOREIGN.get(title)):5}  {graph.qualified(title) if title in graph.name else title}")
    print(f"  {2 * FRAME:5}  two exceptions' frames")
    if total > arguments.at_most:
        sys.exit(f"{total} bytes of stack can be needed, {arguments.at_most} there are")


if __name__ == "__main__":
    main()
