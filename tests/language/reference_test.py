#!/usr/bin/env python3
"""The examples, tables and the grammar of LANGUAGE.md against the compiler and the engine.

usage: reference_test.py SEQC NANOPLC_SIM LANGUAGE.md REGISTERS_MAC50-141.md
"""

import sys
import tempfile
import unittest

import document
import registers
from remembering import machine_for
from tools import Tools, as_columns, sent_in_order, step_of_program

# What a whole machine would have and a fragment leaves out: exits, presets, values, RESET_ERROR, uses of all names.
OVERSIGHTS = {"W019", "W020", "W021", "W022", "W023", "W034"}
SEQC = NANOPLC_SIM = LANGUAGE = REGISTERS = ""


class Reference(unittest.TestCase):
    def setUp(self):
        self.document = document.Document(LANGUAGE)
        self.folder = tempfile.TemporaryDirectory()
        self.tools = Tools(SEQC, NANOPLC_SIM, self.folder.name)
        for name, text in self.document.files.items():
            self.tools.path(name, text)
        self.map, self.bytes = registers.read(REGISTERS), self.document.command_bytes()

    def tearDown(self):
        self.folder.cleanup()

    def program(self, text):
        self.assertIsNotNone(self.document.grammar.parse(text), f"not in the grammar:\n{text}")
        tree = self.document.grammar.parse(self.document.included(text))
        return self.document.program(tree, self.map, self.bytes)

    def test_the_grammar_has_no_holes(self):
        self.assertEqual(self.document.grammar.holes(), ([], []))

    def test_examples_compile_as_they_say(self):
        self.assertGreater(len(self.document.examples), 15)
        for example in self.document.examples:
            with self.subTest(example.text):
                here = range(example.first_line, example.first_line + example.text.count("\n") + 1)
                found = self.tools.build(example.program)
                elsewhere = [d for d in found if d["line"] not in here and d["severity"] == "error"]
                self.assertEqual(elsewhere, [])
                said = sorted((d["line"], d["code"]) for d in found
                              if d["line"] in here and d["code"] not in OVERSIGHTS)
                self.assertEqual(said, example.said())

    def test_examples_are_in_the_grammar_and_the_faults_are_known(self):
        for example in self.document.examples:
            with self.subTest(example.text):
                program = self.program(example.program)
                said = {code for _, code in example.said() if code[0] == "E" and code not in ("E071", "E072", "E074", "E075")}
                self.assertEqual(program.faults, said)

    def test_properties_have_their_verdicts(self):
        told = [example for example in self.document.examples if example.verdicts()]
        self.assertGreater(sum(len(example.verdicts()) for example in told), 15)
        for example in told:
            with self.subTest(example.text):
                found = {r["name"]: r["verdict"] for r in self.tools.verify(example.program) if "code" not in r}
                self.assertEqual(found, example.verdicts())

    def test_tables_hold(self):
        tables = [example for example in self.document.examples if example.scans]
        self.assertGreater(len(tables), 8)
        for example in tables:
            with self.subTest(example.text):
                self.check_table(example)

    def check_table(self, example):
        program = self.program(example.program)
        program.is_possible()
        self.tools.build(example.program)
        course = [self.read_row(program, before) for before, _ in example.scans]
        machine, table, steps, step = machine_for(program), self.tools.table(), self.tools.steps(), 0
        for (image, ms), row, (before, after) in zip(course, self.tools.scan(course), example.scans):
            case = machine.case(image)
            sends = machine.scan(image, ms)
            here = step_of_program(steps[row[0]], program) if program.remembers() else row[0]
            self.assertEqual([machine.step, machine.timer, machine.counter, machine.outputs, *as_columns(sends)],
                             [here, *row[1:]], (before, after))
            self.assertEqual(sends, sent_in_order(table, step, case))
            self.check_row(program, row, steps[row[0]]["name"], sends, before, after)
            step = row[0]

    def read_row(self, program, before):
        inputs = before.get("inputs", "-")
        on = {name.upper() for name in inputs.split(",") if name != "-"}
        image = sum({1 << program.inputs[name] for name in on ^ program.inverted})
        image |= int(before.get("INPOS", 0)) << 6 | int(before.get("ERROR", 0)) << 7
        return image, int(before.get("dt", 1))

    def check_row(self, program, row, name, sends, before, after):
        self.assertEqual(name, after["step"], (before, after))
        if "outputs" in after:
            names = [name.upper() for name in after["outputs"].split(",") if name != "-"]
            self.assertEqual(row[3], sum(1 << program.outputs[name] for name in names), (before, after))
        for column, at in (("timer", 1), ("counter", 2)):
            if column in after:
                self.assertEqual(row[at], int(after[column]), (before, after))
        if "sends" in after:
            self.assertEqual([self.sent(program, text) for text in after["sends"]], sends, (before, after))

    def sent(self, program, text):
        """STOP, INIT(V1) or V1=100 of a table's last column, as the machine has it."""
        name, _, value = text.partition("=")
        if value:
            register = program.names.get(name.upper()) or self.map[name]
            return register.number, int(value)
        selected = name.partition("(")[2].rstrip(")").upper()
        if not selected or name in self.bytes:
            return self.bytes[name]
        register = program.names[selected].name if selected in program.names else selected
        base = {"INIT": 0x00, "VELOCITY": 0x20, "POSITION": 0x40}[name.partition("(")[0]]
        return base + registers.SELECTABLE[register[0]] + int(register[1]) - 1


if __name__ == "__main__":
    REGISTERS, LANGUAGE, NANOPLC_SIM, SEQC = (sys.argv.pop() for _ in range(4))
    unittest.main(verbosity=2)
