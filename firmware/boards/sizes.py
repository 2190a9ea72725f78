#!/usr/bin/env python3
"""What each folder takes in a board's image: bytes of flash and of RAM, out of the linker's map.

Flash is code, constants and the first values of variables. RAM is variables and the stack as stack.py computes it;
what --not-counted names stands apart. Fails when a budget is exceeded.
"""

import argparse
import os
import re
import sys
from collections import defaultdict

LIBRARIES = "compiler's libraries"
# " .text.name 0x0001234 0x56 path", the name perhaps on a line of its own.
SECTION = re.compile(r"^ (\.[a-z]+)\S*\s+0x([0-9a-f]+)\s+0x([0-9a-f]+) (\S.*)$", re.MULTILINE)
FLASH, RAM = (".text", ".rodata", ".data", ".init_array", ".vectors"), (".data", ".bss", ".noinit")


def folder_of(path, build):
    path = path.split("(")[0]
    relative = os.path.relpath(os.path.join(build, path), build)
    if relative.startswith("..") or os.path.isabs(path):
        return LIBRARIES
    return re.sub(r"/CMakeFiles/.*", "", relative) if "CMakeFiles" in relative else os.path.dirname(relative)


def measure(text, build):
    """Bytes of flash and RAM by folder."""
    sizes = defaultdict(lambda: [0, 0])
    linked = text.split("Linker script and memory map", 1)[1]
    linked = re.sub(r"^( \.\S+)\n\s+0x", r"\1 0x", linked, flags=re.MULTILINE)
    for section, _, size, path in SECTION.findall(linked):
        entry = sizes[folder_of(path, build)]
        entry[0] += int(size, 16) * (section in FLASH)
        entry[1] += int(size, 16) * (section in RAM)
    return sizes


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("map")
    parser.add_argument("bin")
    parser.add_argument("--build", required=True, help="the folder in which the linker ran")
    parser.add_argument("--flash", type=int, required=True, help="budget in bytes")
    parser.add_argument("--ram", type=int, required=True, help="budget in bytes")
    parser.add_argument("--stack", required=True, help="file with what stack.py printed")
    parser.add_argument("--not-counted", action="append", default=[], metavar="NAME=BYTES")
    arguments = parser.parse_args()

    with open(arguments.map, encoding="utf-8") as file:
        sizes = measure(file.read(), arguments.build)
    flash, ram = (sum(entry[i] for entry in sizes.values()) for i in (0, 1))
    sizes["gaps"][0] = os.path.getsize(arguments.bin) - flash
    flash = os.path.getsize(arguments.bin)
    rows = [(name, *sizes[name]) for name in sorted(sizes) if any(sizes[name])]
    with open(arguments.stack, encoding="utf-8") as file:
        stack = int(file.read().split()[0])
    rows.append(("the stack", 0, stack))
    ram += stack
    for item in arguments.not_counted:
        name, size = item.split("=")
        rows.append((f"not counted: {name}", 0, -int(size)))
        ram -= int(size)
    rows.append(("the whole image", flash, ram))
    rows.append(("budget", arguments.flash, arguments.ram))
    print(f"  {'':34}{'flash':>8}{'RAM':>8}")
    for name, in_flash, in_ram in rows:
        print(f"  {name:34}{in_flash:8}{in_ram:8}")
    if flash > arguments.flash or ram > arguments.ram:
        sys.exit(f"{arguments.map}: over budget; the map shows what is largest")


if __name__ == "__main__":
    main()
