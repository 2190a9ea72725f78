#!/usr/bin/env python3
"""What README.md and tools/sequence/README.md print: programs work as printed, and programs print what is printed there.

usage: readme_test.py SEQC NANOPLC_SIM ROOT
"""

import json
import os
import re
import subprocess
import sys
import unittest

from folder_case import FolderCase

SEQC = NANOPLC_SIM = ROOT = ""
EXAMPLE = "tools/sequence/examples/pick_and_place"


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


def unindented(block):
    return "\n".join(line[4:] for line in block.split("\n"))


def block_after(text, words):
    """The first indented block behind `words`."""
    block = re.search(r"(?m)^    .*\n((?:    .*\n|\n(?=    ))*)", text[text.index(words):])
    return unindented(block.group(0)).rstrip("\n")


class Readme(FolderCase):
    def setUp(self):
        super().setUp()
        self.text = read("tools/sequence/README.md")

    def run_program(self, *command):
        return subprocess.run(command, capture_output=True, text=True, check=False, cwd=self.folder.name)


class Tutorial(Readme):
    def programs(self):
        return [unindented(block) + "\n"
                for block in re.findall(r"(?ms)^(    PROGRAM \w+$.*?^    END_PROGRAM)$", self.text)]

    def test_programs_compile_without_a_word(self):
        programs = self.programs()
        self.assertGreaterEqual(len(programs), 2)
        for program in programs:
            done = self.run_program(SEQC, "check", self.put("p.seq", program))
            self.assertEqual((done.returncode, done.stderr), (0, ""), program)

    def test_the_scenario_holds(self):
        scenario = re.search(r"(?m)^    # feeder\.scn\n((?:    .*\n)+)", self.text).group(1)
        done = self.run_program(NANOPLC_SIM, "run", self.put("feeder.seq", self.programs()[-1]), "--scenario",
                                self.put("feeder.scn", unindented(scenario)))
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("3 passed, 0 failed", done.stdout)

    def test_what_build_says_of_it(self):
        said = re.search(r"says in one line what it wrote \(`([^`]+)`\)", self.text).group(1)
        done = self.run_program(SEQC, "build", self.put("feeder.seq", self.programs()[-1]), "-o", "F.bin")
        self.assertEqual((done.stdout + done.stderr).strip(), said)


class FrontPage(Readme):
    def setUp(self):
        super().setUp()
        self.front = read("README.md")

    def test_the_part_of_the_example(self):
        self.assertIn(block_after(self.front, "A part of `tools/sequence/examples/pick_and_place.seq`:"),
                      read(EXAMPLE + ".seq"))

    def test_the_timeline(self):
        done = self.run_program(NANOPLC_SIM, "run", os.path.join(ROOT, EXAMPLE + ".seq"), "--scenario",
                                os.path.join(ROOT, EXAMPLE + ".scn"))
        printed = [line.rstrip() for line in done.stdout.split("\n")]
        shown = block_after(self.front, "What `tools/demo` prints of it").split("\n")
        now = [line for line in printed if re.match(r" +\d+\.\d{3}  ", line)]
        at = next(number for number, line in enumerate(now) if "Idle -> Travel" in line)
        self.assertEqual(now[at:at + len(shown)], shown)

    def test_the_picture_of_its_trace(self):
        done = self.run_program(NANOPLC_SIM, "run", os.path.join(ROOT, EXAMPLE + ".seq"), "--scenario",
                                os.path.join(ROOT, EXAMPLE + ".scn"), "--trace", "trace.csv", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.run_program(SEQC, "build", os.path.join(ROOT, EXAMPLE + ".seq"), "-o", "p.bin")
        plot = [os.path.join(ROOT, "tools/plot_trace"), "trace.csv", "-o", "trace.svg",
                "--title", "pick_and_place.seq on a virtual MAC140"]
        named = ["--steps", "POWER_UP,Idle,Travel,Hold,Return,Fault,Cleared",
                 "--names", "IN0=Start,IN1=Guard,IN2=Ack,OUT0=Grip,OUT3=Lamp"]
        for drawing in (plot + ["--sym", "p.sym"], plot + named):
            self.assertEqual(self.run_program(*drawing).returncode, 0)
            drawn = read(os.path.join(self.folder.name, "trace.svg"))
            self.assertTrue(drawn == read(EXAMPLE + ".svg"), "draw it anew: " + " ".join(drawing))
        renamed = self.run_program(*plot, "--sym", "p.sym", "--names", "IN0=Go")
        self.assertEqual(renamed.returncode, 0)
        self.assertIn(">Go</text>", read(os.path.join(self.folder.name, "trace.svg")))

    def test_no_picture_with_wrong_symbols(self):
        trace = self.put("t.csv", "time_ms,step,timer,counter,inputs,outputs,inpos,error,command,p_ist,v_ist\n"
                                    "0,0,0,0,0,0,0,0,,0,0\n1,0,0,0,0,0,0,0,,0,0\n")
        for text, said in (("{", "bad.sym:1:2: this is not JSON"), ("[]", "bad.sym: no symbol file"),
                           ('{"format": "nanoplc-symbols", "version": 3}', "bad.sym: no symbol file of version 1 or 2")):
            done = self.run_program(os.path.join(ROOT, "tools/plot_trace"), trace, "-o", "no.svg", "--sym",
                                    self.put("bad.sym", text))
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn(said, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1)
        self.assertFalse(os.path.exists(os.path.join(self.folder.name, "no.svg")))

    def test_the_drawing_is_of_this_table(self):
        self.run_program(SEQC, "build", os.path.join(ROOT, "tools/sequence/examples/indexing_table.seq"), "-o", "t.bin")
        with open(os.path.join(self.folder.name, "t.sym"), encoding="utf-8") as file:
            crc = json.load(file)["table"]["crc32"]
        self.assertIn(crc.upper(), read("tools/sequence/examples/indexing_table.svg").upper())

    def test_how_many_examples_there_are(self):
        names = [n for n in os.listdir(os.path.join(ROOT, "tools/sequence/examples")) if n.endswith(".seq")]
        number = re.search(r"([\w-]+) example machines", self.front).group(1)
        words = ("fifteen sixteen seventeen eighteen nineteen twenty twenty-one twenty-two twenty-three twenty-four "
                 "twenty-five twenty-six twenty-seven twenty-eight twenty-nine thirty").split()
        self.assertEqual(words.index(number) + 15, len(names))
        for name in names:
            self.assertIn(f"`{name[:-4]}`", self.text)


class Outputs(Readme):
    def test_codes_that_documents_name_can_be_explained(self):
        listed = {line.split("  ", 1)[0] for line in self.run_program(SEQC, "explain").stdout.strip().split("\n")}
        named = set(re.findall(r"\b[EW]\d{3}\b", self.text + read("tools/sequence/LANGUAGE.md")))
        self.assertGreater(len(named), 20)
        self.assertLessEqual(named, listed)

    def test_json(self):
        shown = json.loads(block_after(self.text, "print one JSON document"))
        self.put("a.seq", "PROGRAM P\nSTEP s: OWN ERROR; END_STEP\nSTEP s: OWN ERROR; END_STEP\nEND_PROGRAM\n")
        self.assertEqual(json.loads(self.run_program(SEQC, "check", "--json", "a.seq").stdout), shown)

    def test_diff(self):
        before = read(EXAMPLE + ".seq")
        after = before
        for old, new in (("1500 rpm;", "1000 rpm;"), ("OUT Grip;", "OUT Grip, Lamp;"),
                         ("ENTRY STOP;", "ENTRY STOP; ENTRY CLEAR_IN_POS;")):
            self.assertIn(old, after)
            after = after.replace(old, new, 1)
        self.assertEqual(self.diff(before, after), block_after(self.text, "or what is different:").split("\n")[:3])

    def test_diff_of_a_branch(self):
        before = read(EXAMPLE + ".seq")
        after = before.replace("ON Guard IN Travel, Return", "ON Guard IN Return", 1)
        after = after.replace("IF INPOS", "IF INPOS AND NOT Guard", 1)
        after = after.replace("ELSE", "ELSIF Guard THEN HOME; NEXT := Fault; ELSE", 1)
        self.assertEqual(self.diff(before, after), block_after(self.text, "or what is different:").split("\n")[3:])

    def diff(self, before, after):
        done = self.run_program(SEQC, "diff", self.put("A.seq", before), self.put("B.seq", after))
        self.assertEqual(done.returncode, 1, done.stderr)
        return [line.rstrip() for line in done.stdout.strip().split("\n")]

    def test_time_on_the_line(self):
        said = re.search(r"`V1 := 1500 rpm` takes.*?, ([\d.]+) ms at 19200 baud, of\s+which (\d+) are ours", self.text,
                         re.DOTALL)
        self.put("v.seq", "PROGRAM P\nMOTOR MAC140;\n"
                            "STEP S: OWN ERROR; IF IN0 THEN V1 := 1500 rpm; NEXT := T; END_IF END_STEP\n"
                            "STEP T: OWN ERROR; END_STEP\nEND_PROGRAM\n")
        done = self.run_program(SEQC, "report", "--json", "--baud", "19200", "v.seq")
        switch = json.loads(done.stdout)["transitions"][0]
        self.assertEqual(switch["characters"], int(said.group(2)))
        self.assertEqual(f"{switch['until_done_ms']:.1f}", said.group(1))


if __name__ == "__main__":
    ROOT, NANOPLC_SIM, SEQC = (os.path.abspath(sys.argv.pop()) for _ in range(3))
    unittest.main(verbosity=2)
