"""Registers of a MAC140 as REGISTERS_MAC50-141.md has them: number, width, range, steps in a unit."""

import re

COUNTS = 4096          # a revolution
RATE = 3125 / 6        # samples a second
SELECTABLE = {"P": 0x00, "V": 0x08, "A": 0x10, "T": 0x14, "L": 0x18, "Z": 0x1C}
ROW = re.compile(r"(?m)^\| (\d+)(?:, \d+)? \| (\w+) \| [^|]* \| (\w+) \| ([^|]*) \| (-?\d+) \.\. (-?\d+)")


class Register:
    def __init__(self, number, name, form, unit, low, high):
        self.number, self.name, self.unit = number, name, unit
        self.is_wide, self.is_signed = form == "LongInt", form in ("LongInt", "Integer")
        self.low, self.high = low, high

    def steps_in(self, unit):
        """Steps of the register that one of the unit is (LANGUAGE.md section 8)."""
        per_rev = {"rev": COUNTS, "counts": 1}
        by_kind = {
            "rev": per_rev,
            "rpm": {"rpm": 16 * COUNTS / 60 / RATE, "rev/s": 16 * COUNTS / RATE},
            "rpm/s": {"rpm/s": 16 * COUNTS / 60 / RATE ** 2, "rev/s2": 16 * COUNTS / RATE ** 2},
        }
        kind = re.match(r"1\d* (\S+) =", self.unit)
        return by_kind[kind.group(1)][unit]


def read(path):
    with open(path, encoding="utf-8") as file:
        rows = ROW.findall(file.read())
    found = [Register(int(number), name, form, unit.strip(), int(low), int(high))
             for number, name, form, unit, low, high in rows]
    return {register.name: register for register in found}
