#!/usr/bin/env python3
"""`seqc lsp` over several files: scenarios and property files beside their program, files that are included.

usage: files_test.py SEQC EXAMPLES [UNITTEST-ARGUMENT...]
"""

import os
import sys
import unittest

from case import ALL, Case, example
from client import Refused, edited, place_of, uri_of

WIRING = "VAR_INPUT\n    Start AT IN0 : BOOL;\nEND_VAR\nVAR_OUTPUT Lamp AT OUT0 : BOOL; END_VAR\n"
PRESS = """PROGRAM Press
MOTOR MAC140;
INCLUDE 'wiring.seqi';
ON ERROR NEXT := Fault;
STEP Idle: IF Start THEN NEXT := Work; END_IF END_STEP
STEP Work: OUT Lamp; IF NOT Start THEN NEXT := Idle; END_IF END_STEP
STEP Fault: OWN ERROR; IF ANY ERROR AND Start THEN RESET_ERROR; NEXT := Idle; END_IF END_STEP
END_PROGRAM
"""


class OtherFiles(Case):
    """Scenarios and property files have the names of their program, and what a program has."""

    def setUp(self):
        super().setUp()
        self.text = example("pick_and_place.seq")
        self.program = self.open(self.text, "pick_and_place.seq")

    def ask(self, method, uri, **more):
        return self.client.request("textDocument/" + method, {"textDocument": {"uri": uri}, **more})

    def fixed(self, text, name):
        uri = self.open(text, name)
        context = {"diagnostics": self.client.diagnostics(uri)}
        preferred = [a for a in self.ask("codeAction", uri, range=ALL, context=context) if a.get("isPreferred", True)]
        titles = [action["title"] for action in preferred]
        self.assertEqual(len(set(titles)), len(titles), titles)
        for action in preferred:
            text = edited(text, action["edit"]["changes"][uri])  # of one length each, so that places stay
        return text

    def test_misspelt_names_are_mended(self):
        wrong = "at 200 ms pulse Strat 50 ms\nexpect step = Idel at 1 s\nexpetc Lmap at 1 s\nend at 2 s\n"
        right = "at 200 ms pulse Start 50 ms\nexpect step = Idle at 1 s\nexpect Lamp at 1 s\nend at 2 s\n"
        self.assertEqual(self.fixed(wrong, "pick_and_place.scn"), right)
        wrong = "PROPERTY A: NEVER Girp OR STEP = Idel;\n"
        self.assertEqual(self.fixed(wrong, "pick_and_place.prop"), "PROPERTY A: NEVER Grip OR STEP = Idle;\n")

    def test_a_property_is_wrong_at_its_name(self):
        text = "PROPERTY A:\n    NEVER Lamp AND Gripp;\n"
        told = self.client.diagnostics(self.open(text, "pick_and_place.prop"))
        self.assertEqual(told[0]["range"], {"start": place_of(text, "Gripp"), "end": place_of(text, ";")})

    def test_a_name_is_renamed_from_a_scenario(self):
        text = "at 1 s Guard := 1\nexpect Guard at 2 s   # Guard stays\nend at 3 s\n"
        uri = self.open(text, "pick_and_place.scn")
        self.assertEqual(self.client.at("textDocument/prepareRename", uri, place_of(text, "Guard"))["placeholder"], "Guard")
        self.assertEqual(len(self.client.at("textDocument/documentHighlight", uri, place_of(text, "Guard"))), 2)
        changes = self.client.at("textDocument/rename", uri, place_of(text, "Guard"), newName="Door")["changes"]
        self.assertEqual(edited(text, changes[uri]), "at 1 s Door := 1\nexpect Door at 2 s   # Guard stays\nend at 3 s\n")
        self.assertIn("Door AT %IX0.1", edited(self.text, changes[self.program]))
        with self.assertRaises(Refused):
            self.client.at("textDocument/rename", uri, place_of(text, "expect"), newName="Door")

    def test_hover_and_completion_of_a_scenario(self):
        text = "at 1 s Guard := 1\nexpect step = Tra at 2 s\nend at 3 s\n"
        uri = self.open(text, "pick_and_place.scn")
        self.assertIn("input **Guard** at %IX0.1", self.client.at("textDocument/hover", uri, place_of(text, "Guard"))["contents"]["value"])
        self.assertIn("TIME", self.client.at("textDocument/hover", uri, place_of(text, "at"))["contents"]["value"])
        steps = self.labels(uri, place_of(text, "Tra at", 3))
        self.assertEqual(steps, ["Idle", "Travel", "Hold", "Return", "Fault", "Cleared", "POWER_UP"])
        signals = self.labels(uri, place_of(text, "Guard"))
        self.assertEqual(signals[:5], ["Start", "Guard", "Ack", "Grip", "Lamp"])

    def test_shape_of_a_scenario(self):
        text = "# one\n# two\nat 1 s Guard := 1   # door\nend at 3 s\n"
        uri = self.open(text, "pick_and_place.scn")
        self.assertEqual([s["name"] for s in self.ask("documentSymbol", uri)], ["at 1 s Guard := 1", "end at 3 s"])
        self.assertEqual([(f["startLine"], f["endLine"]) for f in self.ask("foldingRange", uri)], [(0, 1)])
        chosen = self.ask("selectionRange", uri, positions=[place_of(text, "Guard", 2)])[0]
        self.assertEqual(chosen["range"]["end"], place_of(text, "Guard", 5))
        self.assertEqual(chosen["parent"]["range"]["end"], place_of(text, "   # door"))

    def test_shape_and_layout_of_a_property_file(self):
        text = "// one\n// two\nPROPERTY A:   NEVER Grip AND\n  STEP = Idle;\n"
        uri = self.open(text, "pick_and_place.prop")
        self.assertEqual([s["name"] for s in self.ask("documentSymbol", uri)], ["A"])
        self.assertEqual([(f["startLine"], f["endLine"]) for f in self.ask("foldingRange", uri)], [(0, 1), (2, 3)])
        chosen = self.ask("selectionRange", uri, positions=[place_of(text, "Grip", 2)])[0]
        self.assertEqual(chosen["range"]["start"], place_of(text, "Grip"))
        edits = self.ask("formatting", uri, options={"tabSize": 4, "insertSpaces": True})
        self.assertEqual(edited(text, edits), "// one\n// two\nPROPERTY A: NEVER Grip AND STEP = Idle;\n")
        self.assertGreater(len(self.ask("semanticTokens/full", uri)["data"]), 20)


SET = """at 1 s set Length := 90 mm and Blade_Time := 200 ms
expect at 2 s Length = 90 mm +- 1 mm   # Length stays
when Length changes pulse Start 50 ms
expect ordered "POSITION(Length)" by 3 s, "never"
log "Length"
end at 4 s
"""


class SetPoints(Case):
    """A scenario sets and expects its program's set-points, and knows registers by the program's names in orders."""

    def setUp(self):
        super().setUp()
        self.text = example("cut_to_length.seq")
        self.program = self.open(self.text, "cut_to_length.seq")
        self.scenario = self.open(SET, "cut_to_length.scn")

    def renamed(self, uri, place, name):
        changes = self.client.at("textDocument/rename", uri, place, newName=name)["changes"]
        return {one: edited(SET if one == self.scenario else self.text, changes[one]) for one in changes}

    def test_a_set_point_is_renamed_from_program_and_scenario(self):
        wanted = SET.replace("Length", "Way").replace("Way stays", "Length stays").replace('log "Way"', 'log "Length"')
        program = self.text.replace("SET_POINT Length", "SET_POINT Way").replace("POSITION(Length)", "POSITION(Way)")
        for uri, place in (
            (self.program, place_of(self.text, "SET_POINT Length", 12)),
            (self.program, place_of(self.text, "POSITION(Length", 11)),
            (self.scenario, place_of(SET, "Length")),
            (self.scenario, place_of(SET, "Length = 90")),
            (self.scenario, place_of(SET, "Length changes")),
            (self.scenario, place_of(SET, "POSITION(Length", 11)),
        ):
            texts = self.renamed(uri, place, "Way")
            self.assertEqual(texts, {self.program: program, self.scenario: wanted})

    def test_one_of_a_timer_is_renamed_where_it_is_used(self):
        texts = self.renamed(self.scenario, place_of(SET, "Blade_Time"), "Cut_Time")
        self.assertEqual(texts, {self.program: self.text.replace("Blade_Time", "Cut_Time"), self.scenario: SET.replace("Blade_Time", "Cut_Time")})

    def test_a_name_of_var_motor_is_renamed_in_orders(self):
        text = 'expect ordered "INIT(Soft)" by 1 s\nend at 2 s\n'
        uri = self.open(text, "cut_to_length-soft.scn")
        changes = self.client.at("textDocument/rename", self.program, place_of(self.text, "Soft"), newName="Gentle")["changes"]
        self.assertEqual(edited(text, changes[uri]), text.replace("Soft", "Gentle"))

    def test_a_word_that_is_no_set_point_stays(self):
        text = self.text.replace("SET_POINT Pieces", "SET_POINT load").replace(":= Pieces", ":= load")
        self.client.change(self.program, 2, [{"text": text}])
        scenario = "at 1 s motor load 5, set load := 4\nend at 2 s\n"
        self.client.change(self.scenario, 2, [{"text": scenario}])
        changes = self.client.at("textDocument/rename", self.program, place_of(text, "SET_POINT load", 12), newName="Count")["changes"]
        self.assertEqual(edited(scenario, changes[self.scenario]), "at 1 s motor load 5, set Count := 4\nend at 2 s\n")

    def test_a_name_that_scenarios_have_for_something_else_is_refused(self):
        for name in ("Torque", "shaft", "Speed", "Start", "P2"):
            with self.assertRaises(Refused, msg=name):
                self.client.at("textDocument/rename", self.scenario, place_of(SET, "Length"), newName=name)

    def test_definition_references_highlights_and_hover(self):
        found = self.client.at("textDocument/definition", self.scenario, place_of(SET, "Length = 90"))
        self.assertEqual((found["uri"], found["range"]["start"]), (self.program, place_of(self.text, "Length AT")))
        for uri, place in ((self.scenario, place_of(SET, "Length")), (self.program, place_of(self.text, "Length AT"))):
            found = self.client.at("textDocument/references", uri, place, context={"includeDeclaration": True})
            self.assertEqual(sorted(one["uri"] for one in found), [self.scenario] * 4 + [self.program] * 2)
        self.assertEqual(len(self.client.at("textDocument/documentHighlight", self.scenario, place_of(SET, "Length"))), 4)
        text = self.client.at("textDocument/hover", self.scenario, place_of(SET, "Length"))["contents"]["value"]
        self.assertIn("RANGE 10 .. 200 mm STEP 0.1 mm", text)
        text = self.client.at("textDocument/hover", self.scenario, place_of(SET, "Blade_Time"))["contents"]["value"]
        self.assertIn("RANGE 100 ms .. 5 s", text)
        self.assertEqual(self.client.at("textDocument/prepareRename", self.scenario, place_of(SET, "Length"))["placeholder"], "Length")

    def test_completion(self):
        text = "at 1 s set Len\nexpect Le\nend at 2 s\n"
        self.client.change(self.scenario, 2, [{"text": text}])
        points = ["Length", "Speed", "Blade_Time", "Pieces"]
        self.assertEqual(self.labels(self.scenario, place_of(text, "Len", 3)), points)
        offered = self.labels(self.scenario, place_of(text, "Le\n", 2))
        self.assertEqual(offered[:6], ["Start", "Ack", "Blade", "Ready", "Alarm", "Length"])
        for name in (*points, "set", "recipe"):
            self.assertIn(name, offered)
        # Of the program: a time or a count where it is a value, one with AT where a register is selected.
        text = self.text.replace("COUNTER := Pieces", "COUNTER := Pi").replace("POSITION(Length)", "POSITION(Le)")
        self.client.change(self.program, 2, [{"text": text}])
        offered = self.labels(self.program, place_of(text, "COUNTER := Pi", 13))
        self.assertIn("Pieces", offered)
        self.assertNotIn("Length", offered)
        offered = self.labels(self.program, place_of(text, "POSITION(Le", 11))
        self.assertIn("Length", offered)
        self.assertNotIn("Pieces", offered)

    def test_a_misspelt_set_point_is_mended(self):
        text = "at 1 s set Lenght := 90 mm\nend at 2 s\n"
        self.client.change(self.scenario, 2, [{"text": text}])
        told = self.client.diagnostics(self.scenario, 2)
        actions = self.actions(self.scenario, told[0])
        self.assertIn("Write 'Length'", [action["title"] for action in actions])


class Includes(Case):
    def setUp(self):
        super().setUp()
        self.wiring = self.write("wiring.seqi", WIRING)
        self.saw = self.write("saw.seq", PRESS.replace("Press", "Saw"))
        self.press = self.open(PRESS, "press.seq")

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return uri_of(path)

    def ask(self, method, uri, **more):
        return self.client.request(method, {"textDocument": {"uri": uri}, **more})

    def test_a_graph_knows_in_which_file_each_step_stands(self):
        fault = self.write("fault.seqi", "// shared\nSTEP Fault: OWN ERROR; IF ANY ERROR AND Start THEN RESET_ERROR; NEXT := Idle; END_IF END_STEP\n")
        text = "\n".join(line for line in PRESS.replace("ON ERROR", "INCLUDE 'fault.seqi';\nON ERROR").split("\n") if "STEP Fault" not in line)
        self.client.change(self.press, 2, [{"text": text}])
        told = self.client.request("workspace/executeCommand", {"command": "seqc.dot", "arguments": [self.press]})
        self.assertIn("digraph", told["dot"])
        self.assertIn(">Work</text>", told["svg"])
        places = {step["name"]: (step["uri"], step["line"]) for step in told["steps"]}
        idle = place_of(text, "STEP Idle")["line"]
        self.assertEqual(places, {"Idle": (self.press, idle), "Work": (self.press, idle + 1), "Fault": (fault, 1)})

    def test_a_program_has_the_names_of_its_files(self):
        self.assertEqual(self.client.diagnostics(self.press), [])
        place = self.client.at("textDocument/definition", self.press, place_of(PRESS, "IF Start", 3))
        self.assertEqual((place["uri"], place["range"]["start"]), (self.wiring, place_of(WIRING, "Start")))
        hover = self.client.at("textDocument/hover", self.press, place_of(PRESS, "IF Start", 3))
        self.assertIn("IN0", hover["contents"]["value"])
        items = self.client.at("textDocument/completion", self.press, place_of(PRESS, "IF Start", 3))["items"]
        self.assertIn("Start", [item["label"] for item in items])

    def test_the_file_is_a_link(self):
        links = self.ask("textDocument/documentLink", self.press)
        self.assertEqual([(link["target"], link["range"]["start"]) for link in links],
                         [(self.wiring, place_of(PRESS, "'wiring"))])
        place = self.client.at("textDocument/definition", self.press, place_of(PRESS, "wiring"))
        self.assertEqual(place["uri"], self.wiring)

    def test_a_mistake_in_a_file_stands_there_until_it_is_mended(self):
        self.client.diagnostics(self.press)
        self.client.open(self.wiring, WIRING.replace("OUT0", "OUT9"))
        told = self.client.diagnostics(self.wiring, where=bool)
        self.assertEqual((told[0]["code"], told[0]["range"]["start"]), ("E022", place_of(WIRING, "OUT0")))
        self.client.change(self.wiring, 2, [{"text": WIRING}])
        self.assertEqual(self.client.diagnostics(self.wiring, 2), [])

    def test_a_program_follows_what_is_typed_in_a_file(self):
        self.assertEqual(self.client.diagnostics(self.press), [])
        self.client.open(self.wiring, WIRING)
        self.client.change(self.wiring, 2, [{"text": WIRING.replace("Start", "Begin")}])
        told = self.client.diagnostics(self.press, where=bool)
        self.assertEqual({d["code"] for d in told}, {"E021"})
        self.client.change(self.wiring, 3, [{"text": WIRING}])
        self.assertEqual(self.client.diagnostics(self.press, where=lambda list: not list), [])

    def test_a_mistake_in_a_file_that_is_not_open_is_told_of_it(self):
        self.write("wiring.seqi", WIRING.replace("OUT0", "OUT9"))
        self.client.change(self.press, 2, [{"text": PRESS + "// more\n"}])
        told = self.client.diagnostics(self.wiring, where=bool)
        self.assertEqual(told[0]["code"], "E022")
        self.write("wiring.seqi", WIRING)
        self.client.notify("workspace/didChangeWatchedFiles", {"changes": [{"uri": self.wiring, "type": 2}]})
        self.assertEqual(self.client.diagnostics(self.wiring, where=lambda list: not list), [])

    def test_a_file_that_is_missing(self):
        os.remove(os.path.join(self.folder, "wiring.seqi"))
        self.client.change(self.press, 2, [{"text": PRESS + "\n"}])
        told = self.client.diagnostics(self.press, 2)
        self.assertEqual([(d["code"], d["range"]["start"]) for d in told], [("E024", place_of(PRESS, "'wiring"))])
        self.assertEqual(self.ask("textDocument/documentLink", self.press), [])

    def check_renamed(self, edit):
        for uri, before in ((self.wiring, WIRING), (self.press, PRESS), (self.saw, PRESS.replace("Press", "Saw"))):
            self.assertEqual(edited(before, edit[uri]), before.replace("Start", "Go"), uri)
        self.assertEqual(set(edit), {self.wiring, self.press, self.saw})

    def test_a_name_is_renamed_in_all_that_include_it(self):
        edit = self.client.at("textDocument/rename", self.press, place_of(PRESS, "IF Start", 3), newName="Go")
        self.check_renamed(edit["changes"])

    def test_a_name_is_renamed_from_its_file(self):
        self.client.open(self.wiring, WIRING)
        edit = self.client.at("textDocument/rename", self.wiring, place_of(WIRING, "Start"), newName="Go")
        self.check_renamed(edit["changes"])

    def test_a_name_that_another_program_has_is_refused(self):
        self.write("saw.seq", PRESS.replace("IDLE", "Idle").replace(
            "ON ERROR", "VAR_INPUT Blade AT IN3 : BOOL; END_VAR\nON ERROR"))
        with self.assertRaisesRegex(Refused, "saw.seq.*Blade"):
            self.client.at("textDocument/rename", self.press, place_of(PRESS, "IF Start", 3), newName="Blade")

    def test_scenarios_and_property_files_have_the_names_too(self):
        scenario = "at 1 s Start := 1\nexpect Lamp by 2 s\n"
        uri = self.open(scenario, "press.scn")
        self.assertEqual(self.client.diagnostics(uri), [])
        place = self.client.at("textDocument/definition", uri, place_of(scenario, "Start"))
        self.assertEqual((place["uri"], place["range"]["start"]), (self.wiring, place_of(WIRING, "Start")))
        properties = "PROPERTY Dark: NEVER Lamp AND STEP = Idle;\n"
        uri = self.open(properties, "press.prop")
        self.assertEqual(self.client.diagnostics(uri), [])
        place = self.client.at("textDocument/definition", uri, place_of(properties, "Lamp"))
        self.assertEqual((place["uri"], place["range"]["start"]), (self.wiring, place_of(WIRING, "Lamp")))
        edit = self.client.at("textDocument/rename", uri, place_of(properties, "Lamp"), newName="Glow")["changes"]
        self.assertEqual(edited(properties, edit[uri]), properties.replace("Lamp", "Glow"))
        self.assertEqual(edited(WIRING, edit[self.wiring]), WIRING.replace("Lamp", "Glow"))

    def test_an_open_file_has_its_own_shape(self):
        self.client.open(self.wiring, WIRING)
        symbols = self.ask("textDocument/documentSymbol", self.wiring)
        self.assertEqual([s["name"] for s in symbols], ["Start", "Lamp"])
        self.assertTrue(self.ask("textDocument/semanticTokens/full", self.wiring)["data"])
        self.assertTrue(self.ask("textDocument/foldingRange", self.wiring))
        layout = self.ask("textDocument/formatting", self.wiring, options={"tabSize": 4, "insertSpaces": True})
        self.assertEqual(edited(WIRING, layout).split(), WIRING.split())
        found = self.client.at("textDocument/references", self.wiring, place_of(WIRING, "Start"),
                               context={"includeDeclaration": True})
        self.assertEqual({f["uri"] for f in found}, {self.wiring, self.press})

    def test_a_file_that_nothing_includes_is_judged_by_the_grammar(self):
        lone = uri_of(os.path.join(self.folder, "lone.seqi"))
        self.client.open(lone, "CONST A := 3;\nGROUP G: Nowhere;\n")
        self.assertEqual(self.client.diagnostics(lone), [])
        self.client.change(lone, 2, [{"text": "CONST A := ;\n"}])
        self.assertEqual([d["code"] for d in self.client.diagnostics(lone, 2)], ["E010"])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
