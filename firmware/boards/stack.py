#!/usr/bin/env python3
"""The most stack that a board's image can need, in bytes, and the calls that need it.

Reads what the compiler wrote with -fcallgraph-info=su: each function's own need and its calls. A call of a virtual
function can reach the functions of that name that virtual_calls() says of its file. On the deepest path of the loop the deepest
interrupt can come (all have the same priority), and on that a fault, which takes the stack anew.
"""

import argparse
import pathlib
import re
import subprocess
import sys
from collections import defaultdict

NODE = re.compile(r'node: \{ title: "([^"]+)" label: "([^"]*?)(?:\\n(\d+) bytes \(([\w,]+)\)[^"]*)?"')
EDGE = re.compile(r'edge: \{ sourcename: "([^"]+)" targetname: "([^"]+)"(?: label: "([^"]+)")?')
SITE = re.compile(r"(.+):(\d+):(\d+)$")
INDIRECT = "__indirect_call"
FILTER = "arm-none-eabi-c++filt"

# Possible targets of virtual calls in a file, by the qualified names of classes; of these,
# functions with the called name.
HAL = "nplc::hal_mcu::"
MOTORS = ["nplc::motor::JvlMotor", "nplc::motor::MidiMotor"]
# Each board's classes for chip, clock and storage, and its possible line classes.
BOARDS = {
    "lm3s6965evb": (HAL + "stellaris::", HAL + "cortex_m::SysTickClock", HAL + "I2cMemory", [HAL + "BufferedSerial"]),
    "microbit": (HAL + "nrf51::", HAL + "nrf51::TimerClock", HAL + "nrf51::Flash", [HAL + "BufferedSerial", HAL + "NoLine"]),
}


def virtual_calls(board):
    chip, clock, storage, lines = BOARDS[board]
    return [
        (r"hal/mcu/(include/hal_mcu/)?buffered_serial", [chip + "Uart"]),
        (r"hal/mcu/(include/hal_mcu/)?i2c_memory", [chip + "I2cMaster", clock]),
        (r"firmware/boards/bare_metal/", [clock, *lines]),
        (r"firmware/motor/midi_motor", ["nplc::motor::MidiV24Link"]),
        (r"firmware/motor/", lines),
        (r"firmware/store/table_check", ["nplc::gateway::TableManager"]),
        (r"firmware/store/", [storage, "nplc::store::TableCheck", "nplc::store::SettingsStore::Check"]),
        (r"hal/mcu/stellaris/flash", [chip + "ChipFlash"]),
        (r"firmware/update/", [chip + "Flash"]),
        (r"firmware/gateway/(include/gateway/)?user_port", [*lines, *MOTORS]),
        (r"firmware/gateway/gateway_registers", [*lines, *MOTORS]),
        (r"firmware/gateway/sequence_scan", [*MOTORS, "nplc::gateway::SetPoints"]),
        (r"firmware/gateway/", [*MOTORS, chip + "InputPins", chip + "OutputPins", chip + "Watchdog"]),
    ]


# gateway/observer.h: no board implements it.
OBSERVER = ("ordered", "scanned")
# Returns a constant: the linker merges it with another function that does.
CONSTANT = ("take_boot",)
# Pointers to functions that are called outside virtual functions.
POINTERS = {"nplc_reset": r"_GLOBAL__sub_I_"}
ROOTS = r"nplc_reset$"
INTERRUPTS = r"nplc::board::on_\w+"
FRAME = 36  # bytes of an exception frame, with alignment
# Functions of the compiler and the C library, whose objects have no stack usage files; measured in
# their disassembly, rounded up.
FOREIGN = {"memcpy": 16, "memmove": 20, "memset": 16, "memcmp": 16, "__aeabi_lmul": 32, "__aeabi_llsr": 8,
           "__aeabi_uidiv": 16, "__aeabi_idiv": 16, "__aeabi_uidivmod": 16, "__aeabi_idivmod": 16}


def called_at(site):
    """The name before the opening parenthesis that a place in the sources points to, then those behind it in its line."""
    file, line, column = SITE.match(site).groups()
    text = pathlib.Path(file).read_text(encoding="utf-8").split("\n")[int(line) - 1]
    return [re.search(r"(\w+)$", text[: int(column) - 1])[1], *re.findall(r"(\w+)\(", text[int(column) - 1 :])]


class Graph:
    def __init__(self, files, board):
        self.virtual_calls = virtual_calls(board)
        self.need, self.name, self.calls, self.known = {}, {}, defaultdict(set), {}
        for file in files:
            text = file.read_text(encoding="utf-8")
            for title, label, size, kind in NODE.findall(text):
                self.name.setdefault(title, label)
                if size:
                    self.need[title], self.name[title] = int(size), label
                    if kind == "dynamic":
                        sys.exit(f"{label}: its need is not bounded")
            for source, target, site in EDGE.findall(text):
                self.calls[source].add((target, site if target == INDIRECT else ""))
        titles = sorted({*self.name, *(target for calls in self.calls.values() for target, _ in calls)})
        names = subprocess.run([FILTER], input="\n".join(t.rsplit(":", 1)[-1] for t in titles), check=True, capture_output=True, text=True).stdout
        self.plain = {t: n.replace("(anonymous namespace)::", "").split("(")[0] for t, n in zip(titles, names.split("\n"))}

    def matching(self, pattern):
        """Functions whose qualified name begins with the pattern."""
        return [title for title in self.need if re.match(pattern, self.qualified(title))]

    def qualified(self, title):
        """nplc::module::Class::function"""
        return self.plain[title]

    def folded_into(self, title):
        """A template's instance of which only another one is left, because their instructions are the same."""
        without = lambda t: re.sub(r"<[^<>]*>", "", self.plain[t])
        return [t for t in self.need if "<" in self.plain[t] and without(t) == without(title)]

    def reached(self, title):
        """What a function calls."""
        for target, site in self.calls[title]:
            if target != INDIRECT:
                yield target
            elif title in POINTERS:
                yield from self.matching(POINTERS[title])
            else:
                yield from self.virtual(title, site)

    def virtual(self, title, site):
        """What the virtual call at a place in the sources can reach."""
        classes = next((classes for of, classes in self.virtual_calls if re.search(r"(^|/)" + of, site)), None)
        if classes is None:
            sys.exit(f"{self.qualified(title)}: {site}: a virtual call of unknown targets; virtual_calls in {sys.argv[0]} needs a row")
        names = called_at(site)
        if names[0] in OBSERVER + CONSTANT:
            return []
        for name in names:
            if found := [target for owner in classes for target in self.matching(rf"{owner}::{name}(\.|$)")]:
                return found
        return sys.exit(f"{self.qualified(title)}: {site}: nobody of {', '.join(classes)} has what is called there")

    def deepest(self, title, above=()):
        """Bytes and the path."""
        if title not in self.need and title.replace("C1E", "C2E") in self.need:
            title = title.replace("C1E", "C2E")  # a complete object's constructor is its base's
        if title in above:
            sys.exit("recursion: " + " -> ".join(self.qualified(t) for t in (*above, title)))
        if title not in self.need and (same := self.folded_into(title)):
            return max(self.deepest(t, above) for t in same)
        if title not in self.need:
            if title not in FOREIGN:
                sys.exit(f"{title}: called by {self.qualified(above[-1])}, and its need is unknown")
            return FOREIGN[title], [title]
        if title not in self.known:
            below = max((self.deepest(t, (*above, title)) for t in self.reached(title)), default=(0, []))
            self.known[title] = (self.need[title] + below[0], [title, *below[1]])
        return self.known[title]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("graphs", nargs="+", type=pathlib.Path, help="the compiler's .ci files")
    parser.add_argument("--board", required=True, choices=BOARDS)
    parser.add_argument("--at-most", type=int, required=True, help="bytes that there are")
    arguments = parser.parse_args()
    graph = Graph(arguments.graphs, arguments.board)
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
