#!/usr/bin/env python3
"""What each folder takes in a board's image: bytes of flash and of RAM, out of the names that the image holds.

Flash is code, constants and the first values of variables. RAM is variables and the stack as stack.py computes it;
what --not-counted names stands apart. What was inlined counts where it was inlined. Fails when a budget is exceeded.
"""

import argparse
import os
import re
import subprocess
import sys
from collections import defaultdict

NM = "arm-none-eabi-nm"
LIBRARIES = "compiler's libraries"
# Namespaces with their folders; protocol has one per codec.
FOLDERS = {
    "bare_metal": "firmware/boards/bare_metal", "board": "firmware/boards", "gateway": "firmware/gateway", "motor": "firmware/motor", "protocol": "firmware/protocol",
    "registers": "firmware/registers", "store": "firmware/store", "hal_mcu": "hal/mcu", "sequencer": "sequencer", "update": "firmware/update", "signature": "firmware/signature",
    "base": "hal/base",
}
SYMBOL = re.compile(r"^([0-9a-f]+) ([0-9a-f]+) (\w) (.*)$", re.MULTILINE)
FLASH, RAM = "tTrRvVwWdD", "bBdD"
# Names of the C++ runtime and the start-up code, which have no namespace.
START_UP = re.compile(r"nplc_|_GLOBAL__sub_I|__cxa_|__aeabi_atexit|__dso_handle|run_firmware|end_firmware")


def folder_of(name):
    name = name.replace("(anonymous namespace)", "-").split("(")[0]
    first = re.search(r"\b(nplc|std)::(\w+)(?:::(\w+)::)?", name)
    if first is None:
        return "start-up" if START_UP.match(name) else LIBRARIES
    if first[1] == "std":
        return LIBRARIES
    folder = FOLDERS.get(first[2]) or sys.exit(f"{name}: namespace of unknown folder; {__file__} needs a row")
    return f"{folder}, {first[3]}" if first[2] == "protocol" else folder


def measure(elf):
    """Bytes of flash and RAM by folder."""
    listing = subprocess.run([NM, "-S", "-C", elf], check=True, capture_output=True, text=True).stdout
    sizes = defaultdict(lambda: [0, 0])
    seen = set()
    for address, size, kind, name in SYMBOL.findall(listing):
        if address in seen:
            continue  # one constructor has several names
        seen.add(address)
        entry = sizes[folder_of(name)]
        entry[0] += int(size, 16) * (kind in FLASH)
        entry[1] += int(size, 16) * (kind in RAM)
    return sizes


def pairs(items):
    return [(name, int(size)) for name, size in (item.rsplit("=", 1) for item in items)]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("elf")
    parser.add_argument("bin")
    parser.add_argument("--flash", type=int, required=True, help="budget in bytes")
    parser.add_argument("--ram", type=int, required=True, help="budget in bytes")
    parser.add_argument("--stack", required=True, help="file with what stack.py printed")
    parser.add_argument("--not-counted", action="append", default=[], metavar="NAME=BYTES")
    parser.add_argument("--row", action="append", default=[], metavar="FOLDER=BYTES", help="a row's own budget of flash")
    arguments = parser.parse_args()

    sizes = measure(arguments.elf)
    named, ram = (sum(entry[i] for entry in sizes.values()) for i in (0, 1))
    flash = os.path.getsize(arguments.bin)
    sizes["strings, constants, gaps"][0] = flash - named
    rows = [(name, *sizes[name]) for name in sorted(sizes) if any(sizes[name])]
    with open(arguments.stack, encoding="utf-8") as file:
        stack = int(file.read().split()[0])
    rows.append(("the stack", 0, stack))
    ram += stack
    for name, size in pairs(arguments.not_counted):
        rows.append((f"not counted: {name}", 0, -size))
        ram -= size
    rows.append(("the whole image", flash, ram))
    rows.append(("budget", arguments.flash, arguments.ram))
    print(f"  {'':34}{'flash':>8}{'RAM':>8}")
    for name, in_flash, in_ram in rows:
        print(f"  {name:34}{in_flash:8}{in_ram:8}")
    over = [name for name, size in pairs(arguments.row) if sizes[name][0] > size]
    if flash > arguments.flash or ram > arguments.ram or over:
        sys.exit(f"{arguments.elf}: over budget {' '.join(over)}; {NM} -S --size-sort -C shows what is largest")


if __name__ == "__main__":
    main()
