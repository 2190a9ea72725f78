"""Registers of a MAC140 as REGISTERS_MAC50-141.md has them: number, width, range, steps in a unit."""

import re

COUNTS = 4096          # a revolution
RATE = 3125 / 6        # samples a second
SELECTABLE = {"P": 0x00, "V": 0x08, "A": 0x10, "T": 0x14, "L": 0x18, "Z": 0x1C}
SECTION = re.compile(r"(?m)^### (\d+) (\w+)\n((?:(?!^##).*\n)*)")
LINE = re.compile(r"(?m)^\| ([^| ]+) \| (\w+) \|")
ROW = re.compile(r"(?m)^\| (\d+)(?:, \d+)? \| (\w+) \| [^|]* \| (\w+) \| ([^|]*) \| (?:(-?\d+) \.\. (-?\d+)| \|)")


class Register:
    def __init__(self, number, name, form, unit, low, high):
        self.number, self.name, self.unit = number, name, unit
        self.is_wide, self.is_signed = form == "LongInt", form in ("LongInt", "Integer")
        self.low, self.high = low, high
        self.parts = {}     # name -> (lowest bit, width, {name of a value: value})

    def bits_named(self, name):
        """Of a bit, or of a value of the whole register."""
        if self.parts.get(name, (0, 0))[1] == 1:
            return 1 << self.parts[name][0]
        return next(values[name] for _, width, values in self.parts.values() if width == 16 and name in values)

    def bits_of_part(self, part, value):
        first, _, values = self.parts[part]
        return (value if isinstance(value, int) else values[value]) << first

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
        text = file.read()
    found = [Register(int(number), name, form, unit.strip(), int(low or 0), int(high or 65535))
             for number, name, form, unit, low, high in ROW.findall(text)]
    by_number = {register.number: register for register in found}
    for number, _, section in SECTION.findall(text):
        if int(number) in by_number:
            by_number[int(number)].parts = read_parts(section)
    modes = by_number[2].parts["MODE"]
    by_number[37].parts = {"MODE": modes}          # "Values as of 2 MODE_REG"
    return {register.name: register for register in found}


def read_parts(section):
    parts = {}
    tables = section.split("| name | meaning |")
    for bits, name in LINE.findall(tables[1]) if len(tables) > 1 else []:
        high, _, low = bits.partition("..")
        first, width = (0, 16) if bits == "all" else (int(low or high), int(high) - int(low or high) + 1)
        parts[name] = (first, width, {})
    for before, table in zip(tables[1:], tables[2:]):
        part = before.strip().split("\n")[-1].split("|")[1].strip()
        parts[part][2].update({name: int(value) for value, name in LINE.findall(table) if value.isdigit()})
    same = re.search(r"The same for (\w+)", section)
    if same:
        parts[same.group(1)][2].update(next(values for _, _, values in parts.values() if values))
    return parts
