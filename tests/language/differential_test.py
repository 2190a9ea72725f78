#!/usr/bin/env python3
"""Random programs: their behaviour by LANGUAGE.md, against what the compiled table does in the engine.

usage: differential_test.py SEQC NANOPLC_SIM LANGUAGE.md REGISTERS_MAC50-141.md [PROGRAMS [SEED]]
"""

import random
import sys
import tempfile

import document
import kept
import programs
import registers
from remembering import Impossible, machine_for
from tools import Tools, as_columns, sent_in_order, step_of_program

SCANS = 150
OF_A_TABLE = {"E071", "E072"}  # section 9: what a table cannot do
OF_COPIES = OF_A_TABLE | {"E074"}  # and how many steps it has
OF_NUMBERS = "E083"  # steps without a number: what is then said of the branches that lead to them is open


class Difference(Exception):
    pass


class Duel:
    def __init__(self, tools, language, register_map):
        self.tools, self.map = tools, registers.read(register_map)
        self.document = document.Document(language)
        self.bytes = self.document.command_bytes()
        self.errors = set()

    def fight(self, seed):
        """True if the program compiled, and behaved as the reference."""
        rng = random.Random(seed)
        text = programs.program(rng)
        try:
            return self.compare(text, programs.course(rng, SCANS))
        except (Difference, KeyError, TypeError, AttributeError) as what:
            raise Difference(f"seed {seed}: {what!r}\n{text}") from what

    def fight_for(self, name, text, codes):
        """A program that is kept: also refused with these codes, or by neither."""
        try:
            ran = self.compare(text, programs.course(random.Random(name), SCANS))
        except (Difference, KeyError, TypeError, AttributeError) as what:
            raise Difference(f"{name}: {what!r}\n{text}") from what
        if self.errors != codes or ran == bool(codes):
            raise Difference(f"{name}: refused with {self.errors}\n{text}")

    def parted(self, text):
        """Every fourth program has its declarations in a file."""
        if len(text) % 4:
            return text
        declarations = programs.DECLARATIONS + programs.CONSTANTS
        self.tools.path("declarations.seqi", declarations)
        return text.replace(declarations, "INCLUDE 'declarations.seqi';\n")

    def compare(self, text, course):
        tree = self.document.grammar.parse(text)
        if tree is None:
            raise Difference("not in the grammar")
        program = self.document.program(tree, self.map, self.bytes)
        misplaced = program.misplaced()
        is_possible = misplaced or OF_NUMBERS in program.faults or program.remembers() or program.is_possible()
        said = self.tools.build(self.parted(text))
        errors = self.errors = {d["code"] for d in said if d["severity"] == "error"}
        if misplaced:
            if errors != misplaced:
                raise Difference(f"the grammar's rules forbid {misplaced}, the compiler {errors}")
            return False
        if OF_NUMBERS in program.faults & errors:
            return False
        if program.remembers() and errors and errors <= OF_COPIES and not program.faults:
            return False
        if program.faults or errors - OF_A_TABLE:
            # What a choice does that sets the counter twice (E061) is open, and so whether another does the same, or it under ERROR.
            doubtful = {"E070", "E082"} if program.faults & {"E061", "E073"} else set()
            if "E073" in program.faults & errors:
                doubtful.add("E061")  # both report that the timer is set twice
            if program.faults - doubtful != errors - doubtful:
                raise Difference(f"the reference refuses with {program.faults}, the compiler with {errors}")
        elif bool(errors) == is_possible:
            raise Difference(f"the compiler refuses with {errors} what a table can do" if errors else "refuses nothing")
        if errors:
            return False
        lost = {d["message"].split("'")[1].upper() for d in said if d["code"] == "W005" and d["message"].startswith("no step leads")}
        self.run(program, course, lost)
        return True

    def run(self, program, course, lost):
        """`lost`: unreachable steps, by the compiler."""
        machine, table, steps, step = machine_for(program), self.tools.table(), self.tools.steps(), 0
        for number, (row, (image, ms)) in enumerate(zip(self.tools.scan(course), course), 1):
            order = sent_in_order(table, step, machine.case(image))
            step = row[0]
            if steps[step]["name"].upper() in lost:
                raise Difference(f"scan {number}: in step {steps[step]['name']}, to which none leads, says the compiler")
            if program.remembers():
                row[0] = step_of_program(steps[step], program)
            before = f"step {machine.step}, image {image:02X}, timer {machine.timer}, counter {machine.counter}"
            try:
                sends = machine.scan(image, ms)
            except Impossible:
                raise Difference(f"scan {number} ({before}): no table can do it, and the compiler made one") from None
            here = [machine.step, machine.timer, machine.counter, machine.outputs, *as_columns(sends)]
            if here != row or order != sends:
                raise Difference(f"scan {number} ({before}): reference {here}, table {row}; sent {sends}, {order}")


def main():
    seqc, nanoplc_sim, language, register_map = sys.argv[1:5]
    count = int(sys.argv[5]) if len(sys.argv) > 5 else 250
    first = int(sys.argv[6]) if len(sys.argv) > 6 else random.SystemRandom().randrange(10 ** 9)
    print(f"{count} programs from seed {first} on", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        duel = Duel(Tools(seqc, nanoplc_sim, folder), language, register_map)
        try:
            for program in kept.programs():
                duel.fight_for(*program)
            for seed in kept.SEEDS:
                duel.fight(seed)
            ran = sum(duel.fight(seed) for seed in range(first, first + count))
        except Difference as difference:
            print(difference)
            return 1
    print(f"{ran} compiled and did what the reference says in {SCANS} scans each; {count - ran} refused by both")
    return 0 if ran * 4 > count else 1


if __name__ == "__main__":
    sys.exit(main())
