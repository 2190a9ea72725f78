#!/usr/bin/env python3
"""nanoplc-sim fmu from the outside: its files, the model description by the standard's rules, the library's surface.

usage: program_test.py NANOPLC_SIM EXAMPLES
"""

import os
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
import zipfile

PROGRAM, EXAMPLES = sys.argv[1:3]
ROOT = os.path.join(EXAMPLES, "pick_and_place.seq")

# FMI 3.0.1 sections 2.4.7.4 and 2.4.7.5; 2.0.4 section 2.2.7: which variability a causality may have.
LEGAL = {
    "independent": {"continuous"},
    "parameter": {"fixed", "tunable"},
    "input": {"discrete", "continuous"},
    "output": {"constant", "discrete", "continuous"},
}
ORDER = ["CoSimulation", "UnitDefinitions", "LogCategories", "DefaultExperiment", "ModelVariables", "ModelStructure"]
BASE_UNITS = {"kg", "m", "s", "A", "K", "mol", "cd", "rad", "factor", "offset"}
REALS = {"Float64", "Real"}
TYPES = {3: {"Float64", "Int32", "UInt32", "Boolean"}, 2: {"Real", "Integer", "Boolean"}}
TYPE_ATTRIBUTES = {"unit", "min", "max", "start"}
VARIABLE_ATTRIBUTES = {"name", "valueReference", "description", "causality", "variability"}


class Variable:
    def __init__(self, element, fmi):
        inner = element if fmi == 3 else element[0]
        self.type = inner.tag
        self.attributes = {**element.attrib, **inner.attrib}
        self.name = element.get("name")
        self.reference = int(element.get("valueReference"))
        self.causality = element.get("causality")
        self.variability = element.get("variability")

    def number(self, attribute):
        text = self.attributes.get(attribute)
        return None if text is None else {"true": 1.0, "false": 0.0}.get(text) if self.type == "Boolean" else float(text)


class Case(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="fmu-")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def call(self, *arguments):
        return subprocess.run([PROGRAM, "fmu", *arguments], capture_output=True, text=True, check=False)

    def written(self, *arguments, name="out.fmu", says=""):
        done = self.call("-o", self.path(name), *arguments)
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
        self.assertIn(says, done.stderr)
        if not says:
            self.assertEqual(done.stderr, "")
        return self.path(name)

    def refused(self, *arguments, says):
        before = sorted(os.listdir(self.folder))
        done = self.call(*arguments)
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        self.assertIn(says, done.stderr)
        self.assertEqual(sorted(os.listdir(self.folder)), before)


class ModelDescription(Case):
    """The standard's rules, on every kind of FMU that can be written."""

    KINDS = [(fmi, motor, gateway) for fmi in (3, 2) for motor, gateway in (("MAC50", None), ("MAC140", ROOT), ("MAC800", None))]

    read = {}

    def read_one(self, fmi, motor, gateway):
        arguments = ["--fmi", str(fmi)] + (["--with-gateway", gateway] if gateway else ["--motor", motor])
        with zipfile.ZipFile(self.written(*arguments)) as archive:
            self.assertIsNone(archive.testzip())
            return ElementTree.fromstring(archive.read("modelDescription.xml")), archive.namelist()

    def each(self):
        for kind in self.KINDS:
            if kind not in self.read:
                self.read[kind] = self.read_one(*kind)
            root, files = self.read[kind]
            with self.subTest(kind=kind):
                yield kind[0], root, files, [Variable(element, kind[0]) for element in root.find("ModelVariables")]

    def test_the_root_and_its_parts(self):
        for fmi, root, files, _ in self.each():
            self.assertEqual(root.tag, "fmiModelDescription")
            self.assertEqual(root.get("fmiVersion"), "3.0" if fmi == 3 else "2.0")
            self.assertTrue(root.get("modelName"))
            self.assertTrue(root.get("instantiationToken" if fmi == 3 else "guid"))
            self.assertEqual([child.tag for child in root], ORDER)
            kind = root.find("CoSimulation")
            identifier = kind.get("modelIdentifier")
            self.assertRegex(identifier, r"^[A-Za-z_]\w*$")
            platform = {3: "x86_64-linux", 2: "linux64"}[fmi] if os.uname().machine == "x86_64" else ".*"
            self.assertTrue([f for f in files if re.fullmatch(f"binaries/{platform}/{identifier}[.]so", f)], files)
            state, serialise = ("State", "State") if fmi == 3 else ("state", "state")
            self.assertEqual(kind.get("canGetAndSetFMU" + state), "true")
            self.assertEqual(kind.get("canSerializeFMU" + serialise), "false")
            step = float(root.find("DefaultExperiment").get("stepSize"))
            self.assertGreater(step, 0)
            if fmi == 3:
                self.assertEqual(float(kind.get("fixedInternalStepSize")), step)

    def test_variables_are_legal(self):
        for fmi, root, _, variables in self.each():
            names = [v.name for v in variables]
            references = [v.reference for v in variables]
            self.assertEqual(len(set(names)), len(names))
            self.assertEqual(len(set(references)), len(references))
            self.assertEqual(sum(v.causality == "independent" for v in variables), 1)
            units = {unit.get("name") for unit in root.find("UnitDefinitions")}
            for v in variables:
                self.assertIn(v.type, TYPES[fmi], v.name)
                self.assertLessEqual(set(v.attributes), VARIABLE_ATTRIBUTES | TYPE_ATTRIBUTES, v.name)
                self.assertIn(v.variability, LEGAL[v.causality], v.name)
                self.assertTrue(v.variability != "continuous" or v.type in REALS, v.name)
                self.assertTrue(v.attributes.get("description"), v.name)
                self.assertEqual("start" in v.attributes, v.causality in ("parameter", "input"), v.name)
                self.assertEqual("unit" in v.attributes, v.type in REALS, v.name)
                if "unit" in v.attributes:
                    self.assertIn(v.attributes["unit"], units, v.name)
                if "min" in v.attributes and "start" in v.attributes:
                    self.assertLessEqual(v.number("min"), v.number("start"), v.name)
                    self.assertLessEqual(v.number("start"), v.number("max"), v.name)

    def test_units_are_of_the_si(self):
        for _, root, _, variables in self.each():
            units = root.find("UnitDefinitions")
            names = [unit.get("name") for unit in units]
            self.assertEqual(len(set(names)), len(names))
            for unit in units:
                base = unit.findall("BaseUnit")
                self.assertEqual(len(base), 1)
                self.assertLessEqual(set(base[0].attrib), BASE_UNITS)
                for display in unit.findall("DisplayUnit"):
                    self.assertGreater(float(display.get("factor")), 0)
            factors = {d.get("name"): float(d.get("factor")) for d in units.iter("DisplayUnit")}
            self.assertAlmostEqual(factors["rpm"], 9.549296585513721)
            self.assertAlmostEqual(factors["rev"] * 6.283185307179586, 1)

    def test_the_structure_is_complete(self):
        for fmi, root, _, variables in self.each():
            structure = root.find("ModelStructure")
            outputs = [v.reference for v in variables if v.causality == "output"]
            if fmi == 3:
                listed = {tag: [int(e.get("valueReference")) for e in structure.findall(tag)] for tag in ("Output", "InitialUnknown")}
                self.assertEqual(listed, {"Output": outputs, "InitialUnknown": outputs})
                self.assertEqual(sorted({e.tag for e in structure}), ["InitialUnknown", "Output"])
            else:
                self.assertEqual([e.tag for e in structure], ["Outputs", "InitialUnknowns"])
                for part in structure:
                    self.assertEqual([variables[int(e.get("index")) - 1].reference for e in part], outputs)
            for element in structure.iter():
                self.assertEqual(element.get("dependencies", ""), "")

    def test_a_gateway_has_terminals_and_a_motor_alone_registers(self):
        expected = {
            True: {"IN0", "IN5", "OUT0", "OUT3", "step", "load_torque", "P_IST", "ERR_STAT", "IN_POS", "ERROR"},
            False: {"P_SOLL", "V_SOLL", "A_SOLL", "T_SOLL", "MODE_REG", "load_torque", "P_IST", "ERR_STAT", "IN_POS", "ERROR"},
        }
        for _, root, files, variables in self.each():
            names = {v.name for v in variables}
            with_gateway = "resources/table.bin" in files
            self.assertLessEqual(expected[with_gateway], names)
            self.assertFalse((expected[not with_gateway] - expected[with_gateway]) & names)
            step = next((v for v in variables if v.name == "step"), None)
            if step:
                self.assertIn("2 Travel", step.attributes["description"])


class Files(Case):
    def test_the_same_command_writes_the_same_bytes(self):
        for arguments in ((), ("--with-gateway", ROOT), ("--motor", "MAC800", "--fmi", "2")):
            contents = []
            for name in ("one.fmu", "two.fmu"):
                with open(self.written(*arguments, name=name), "rb") as file:
                    contents.append(file.read())
            self.assertEqual(contents[0], contents[1])

    def test_machines_that_differ_have_other_tokens(self):
        tokens = set()
        kinds = ((), ("--motor", "MAC50"), ("--with-gateway", ROOT), ("--with-gateway", os.path.join(EXAMPLES, "press.seq")))
        for arguments in kinds:
            with zipfile.ZipFile(self.written(*arguments)) as archive:
                tokens.add(re.search(r'instantiationToken="([^"]+)"', archive.read("modelDescription.xml").decode())[1])
        self.assertEqual(len(tokens), len(kinds))

    def test_the_library_shows_fmi_and_needs_the_c_library(self):
        with zipfile.ZipFile(self.written()) as archive:
            name = next(file for file in archive.namelist() if file.endswith(".so"))
            library = archive.extract(name, self.folder)
        dynamic = subprocess.run(["readelf", "-dW", library], capture_output=True, text=True, check=True).stdout
        needed = set(re.findall(r"NEEDED.*\[(.*?)\]", dynamic))
        self.assertLessEqual(needed, {"libc.so.6", "libm.so.6"} | {name for name in needed if name.startswith("ld-linux")})
        symbols = subprocess.run(["readelf", "--dyn-syms", "-W", library], capture_output=True, text=True, check=True).stdout
        defined = [row.split()[7] for row in symbols.splitlines()
                   if len(row.split()) == 8 and row.split()[4] in ("GLOBAL", "WEAK", "UNIQUE") and row.split()[6] != "UND"]
        self.assertGreater(len(defined), 100)
        self.assertEqual([symbol for symbol in defined if not re.match(r"fmi[23][A-Z]", symbol)], [])

    def test_a_file_that_is_there_is_replaced(self):
        with open(self.path("out.fmu"), "w", encoding="ascii") as file:
            file.write("old")
        with zipfile.ZipFile(self.written()) as archive:
            self.assertIn("modelDescription.xml", archive.namelist())

    def test_a_motor_stands_in_for_a_midi_drive_only_if_it_is_named(self):
        program = ("--with-gateway", os.path.join(EXAMPLES, "midi_pick_and_place.seq"))
        self.refused("-o", self.path("out.fmu"), *program, says="is for MAC34, a MIDI drive, of which there are no FMUs; with --motor MAC140")
        self.written(*program, "--motor", "MAC140", says="was compiled for MAC34 and runs on MAC140; its register values may not fit")


class Mistakes(Case):
    def test_are_named(self):
        self.refused(says="--output is required")
        out = ("-o", self.path("x.fmu"))
        self.refused(*out, "--motor", "MAC9", says="MAC140, MAC141 or MAC800")
        self.refused(*out, "--motor", "MAC34-1", says="a JVL motor")
        self.refused(*out, "--fmi", "1", says="3 or 2")
        self.refused(*out, "--with-gateway", self.path("none.seq"), says="none.seq: cannot be opened")
        self.refused(*out, "--symbols", self.path("none.sym"), says="--with-gateway")
        self.refused(*out, "--windows", ROOT, says="is no DLL")
        self.refused("-o", self.path("no/such/x.fmu"), says="no/such/x.fmu")
        self.refused("-o", self.folder, says=self.folder)

    def test_a_program_is_not_overwritten(self):
        with open(ROOT, encoding="utf-8") as file:
            text = file.read()
        program = self.path("machine.seq")
        with open(program, "w", encoding="utf-8") as file:
            file.write(text)
        self.refused("-o", program, "--with-gateway", program, says="this would overwrite the program")
        with open(program, encoding="utf-8") as file:
            self.assertEqual(file.read(), text)

    def test_a_program_with_errors_gets_the_compilers_messages(self):
        program = self.path("wrong.seq")
        with open(program, "w", encoding="ascii") as file:
            file.write("PROGRAM P\nSTEP A:\n NEXT := B;\nEND_STEP\nEND_PROGRAM\n")
        self.refused("-o", self.path("x.fmu"), "--with-gateway", program, says="wrong.seq:")


if __name__ == "__main__":
    unittest.main(argv=["program_test"])
