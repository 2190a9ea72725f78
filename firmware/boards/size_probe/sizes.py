#!/usr/bin/env python3
"""Prints what each part of the core costs on the microcontroller: bytes of flash and of static RAM."""

import argparse
import subprocess


def measure(size_tool, path):
    """Flash and static RAM of an object, archive or image. Initialised data counts in both."""
    listing = subprocess.run([size_tool, "-t", path], check=True, capture_output=True, text=True).stdout
    text, data, bss = (int(word) for word in listing.splitlines()[-1].split()[:3])
    return text + data, data + bss


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--size", default="arm-none-eabi-size")
    parser.add_argument("parts", nargs="+", metavar="NAME=FILE")
    arguments = parser.parse_args()

    print(f"  {'':24}{'flash':>8}{'RAM':>8}")
    for part in arguments.parts:
        name, path = part.split("=", 1)
        flash, ram = measure(arguments.size, path)
        print(f"  {name:24}{flash:8}{ram:8}")


if __name__ == "__main__":
    main()
