#!/usr/bin/env python3
"""A board's image for the microcontroller must not hold what a controller of machines cannot afford.

usage: mcu_image.py IMAGE [NM]

Looks at the symbols that the linker kept.
"""

import re
import subprocess
import sys

# Kind, and the symbols that give it away.
BANNED = {
    "heap": r"_*(malloc|calloc|realloc|free|sbrk)(_r)?|_Zn[wa][jm]\w*|_Zd[la]Pv\w*",
    "exceptions": r"__cxa_(throw|allocate_exception|begin_catch|rethrow)|_Unwind_\w+|__gxx_personality_\w+",
    "run-time type information": r"__dynamic_cast|_ZT[IS]\w+",
    "floating point": r"__aeabi_[df](r?sub|add|mul|div|neg|cmp\w+|2\w+)|__aeabi_u?[il]2[df]|__aeabi_ul2[df]",
    "64-bit division": r"__aeabi_u?ldivmod|__u?divmoddi4|__u?(div|mod)di3",
    "guarded statics": r"__cxa_guard_\w+",
    "input and output": r"_*(printf|puts|fopen|fwrite|write)(_r)?|_ZSt\w*cout",
}
PATTERN = {kind: re.compile(f"^(?:{pattern})$") for kind, pattern in BANNED.items()}


def findings_in(symbols):
    for symbol in sorted(symbols):
        for kind, pattern in PATTERN.items():
            if pattern.match(symbol):
                yield f"{kind}: {symbol}"


def symbols_of(image, nm_tool):
    listing = subprocess.run([nm_tool, image], check=True, capture_output=True, text=True).stdout
    return {line.split()[-1] for line in listing.splitlines() if line.strip()}


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    image = sys.argv[1]
    nm_tool = sys.argv[2] if len(sys.argv) > 2 else "arm-none-eabi-nm"
    symbols = symbols_of(image, nm_tool)
    if "nplc_reset" not in symbols:
        sys.exit(f"{image}: no nplc_reset in it: it is not a board's image")
    findings = list(findings_in(symbols))
    for finding in findings:
        print(f"{image}: {finding}")
    if findings:
        print("The linker's map beside the image shows who asked for each.")
    print(f"{len(symbols)} symbols checked, {len(findings)} findings")
    sys.exit(1 if findings else 0)


if __name__ == "__main__":
    main()
