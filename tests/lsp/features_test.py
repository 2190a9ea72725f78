#!/usr/bin/env python3
"""Each feature of `seqc lsp` on the examples, over its standard input and output.

usage: features_test.py SEQC EXAMPLES [UNITTEST-ARGUMENT...]
"""

import os
import shutil
import subprocess
import sys
import unittest

from case import ALL, EXAMPLES, SEQC, START, Case, example
from client import Client, Refused, edited, place_of, uri_of


class Diagnostics(Case):
    def test_every_example_is_clean(self):
        names = [name for name in sorted(os.listdir(EXAMPLES)) if name.endswith((".seq", ".seqi", ".scn"))]
        for name in names:
            shutil.copy(os.path.join(EXAMPLES, name), self.folder)
        for name in names:
            if not name.endswith(".seqi"):  # read, not open
                self.open(example(name), name)
        for name in (name for name in names if not name.endswith(".seqi")):
            self.assertEqual(self.client.diagnostics(uri_of(os.path.join(self.folder, name))), [], name)

    def test_a_word_half_written_leaves_the_rest_useful(self):
        text = example("pick_and_place.seq")
        whole = "IF NOT Guard AND TIMER.Q THEN NEXT := Return;"
        self.assertIn(whole, text)
        uri = self.open(text.replace(whole, "IF INP"))
        told = self.client.diagnostics(uri)
        self.assertTrue(told)
        line = text[: text.index(whole)].count("\n")
        self.assertTrue(all(abs(d["range"]["start"]["line"] - line) <= 2 for d in told), told)
        self.assertEqual(len(self.client.request("textDocument/documentSymbol", {"textDocument": {"uri": uri}})[0]["children"]), 21)

    def test_columns_count_in_utf16_units(self):
        uri = self.open("PROGRAM P\nSTEP S: OWN ERROR; (* \U0001f600\u00e9 *) NEXT := Nowhere; END_STEP\nEND_PROGRAM\n")
        told = [d for d in self.client.diagnostics(uri) if d["code"] == "E021"]
        # 'STEP S: OWN ERROR; (* ' is 22 units, the two signs 2 + 1, ' *) NEXT := ' 12
        self.assertEqual(told[0]["range"]["start"], {"line": 1, "character": 37})

    def test_versions_are_those_of_the_text(self):
        uri = self.open("PROGRAM P MOTOR MAC140;\nSTEP S: OWN ERROR; END_STEP\nEND_PROGRAM\n")
        self.assertEqual(self.codes(uri, 1), [])
        self.client.change(uri, 2, [{"range": {"start": {"line": 1, "character": 8}, "end": {"line": 1, "character": 18}}, "text": ""}])
        self.assertEqual(self.codes(uri, 2), ["E080"])

    def test_scenarios_are_read_by_the_simulators_reader(self):
        self.open(example("press.seq"), "press.seq")
        uri = self.open("at 1 s Strat := 1\nend at 2 s\n", "press.scn")
        told = self.client.diagnostics(uri)
        self.assertEqual([d["range"]["start"]["line"] for d in told], [0])
        self.assertIn("Strat", told[0]["message"])

    def test_property_files_have_their_programs_names(self):
        self.open(example("pick_and_place.seq"), "pick_and_place.seq")
        text = "PROPERTY A: NEVER Grip AND STEP = Idle;\nPROPERTY B: NEVER Gripp;\n"
        uri = self.open(text, "pick_and_place.prop")
        told = self.client.diagnostics(uri)
        self.assertEqual([d["range"]["start"]["line"] for d in told], [1])
        self.assertIn("Grip", self.labels(uri, place_of(text, "Gripp")))
        place = self.client.at("textDocument/definition", uri, place_of(text, "Grip"))
        self.assertTrue(place["uri"].endswith("pick_and_place.seq"))


class Verification(Case):
    options = {"verify": True}

    def test_verdicts_stand_beside_the_properties_and_a_counter_example_can_be_had(self):
        text = example("pick_and_place.seq").replace("END_PROGRAM", "PROPERTY Wrong: NEVER Lamp;\nEND_PROGRAM")
        uri = self.open(text)
        told = self.client.diagnostics(uri, where=lambda list: any(d["source"] == "seqc verify" for d in list))
        by_line = {d["range"]["start"]["line"]: d for d in told if d["source"] == "seqc verify"}
        proved = by_line[place_of(text, "Lamp_Means_Idle")["line"]]
        broken = by_line[place_of(text, "Wrong")["line"]]
        self.assertTrue(proved["message"].startswith("proved"))
        self.assertEqual((broken["severity"], broken["data"]), (1, {"counterexample": "Wrong"}))
        self.assertTrue(broken["relatedInformation"])
        shown = self.client.request("workspace/executeCommand", {"command": "seqc.counterexample", "arguments": [uri, "Wrong"]})
        self.assertIn("end at", shown["scenario"])
        self.assertTrue(shown["program"].endswith("machine.seq"))
        results = self.client.request("workspace/executeCommand", {"command": "seqc.verify.results", "arguments": [uri]})
        self.assertIn("Wrong", [r["name"] for r in results["results"] if r["level"] == "error"])
        lenses = self.client.request("textDocument/codeLens", {"textDocument": {"uri": uri}})
        lens = next(one for one in lenses if one["command"]["command"] == "seqc.counterexample.open")
        self.assertEqual((lens["command"]["arguments"], lens["range"]), ([uri, "Wrong"], broken["range"]))

    def test_the_properties_of_a_file_have_verdicts_that_follow_their_program(self):
        text = example("pick_and_place.seq")
        program = self.open(text, "pick_and_place.seq")
        # A is within the name of the program's property Places_Again_After_A_Fault, and is not meant by it.
        properties = "PROPERTY A: NEVER Grip AND STEP = Idle;\nPROPERTY B: NEVER Lamp;\n"
        uri = self.open(properties, "pick_and_place.prop")
        told = self.client.diagnostics(uri, where=lambda list: any(d["source"] == "seqc verify" for d in list))
        self.assertEqual([(d["range"]["start"]["line"], d["severity"]) for d in told], [(0, 4), (1, 1)])
        self.assertTrue(told[1]["relatedInformation"][0]["location"]["uri"].endswith("pick_and_place.seq"))
        lenses = self.client.request("textDocument/codeLens", {"textDocument": {"uri": uri}})
        self.assertEqual([one["command"]["command"] for one in lenses], ["seqc.verify", "seqc.counterexample.open"])
        start = place_of(text, "    OUT Lamp;")
        end = {"line": start["line"] + 1, "character": 0}
        self.client.change(program, 2, [{"range": {"start": start, "end": end}, "text": ""}])
        told = self.client.diagnostics(uri, where=lambda list: len(list) == 2 and all(d["severity"] == 4 for d in list))
        self.assertIn("proved", told[1]["message"])  # nothing lights the lamp now

    def test_an_editor_that_can_asks_for_its_lenses_anew(self):
        client = Client(SEQC, self.folder, {"workspace": {"codeLens": {"refreshSupport": True}}}, self.options)
        client.open("file:///none.seq", example("pick_and_place.seq"))
        client.diagnostics("file:///none.seq", where=lambda list: any(d["source"] == "seqc verify" for d in list))
        while not any(m["method"] == "workspace/codeLens/refresh" for m in client.notifications):
            client.notifications.append(client.receive())
        self.assertEqual(client.end(), 0)


class Navigation(Case):
    def setUp(self):
        super().setUp()
        self.text = example("pick_and_place.seq")
        self.uri = self.open(self.text, "pick_and_place.seq")
        self.scenario = example("pick_and_place.scn")
        self.scenario_uri = self.open(self.scenario, "pick_and_place.scn")

    def test_definition(self):
        place = self.client.at("textDocument/definition", self.uri, place_of(self.text, "NEXT := Hold", 9))
        self.assertEqual(place["range"]["start"], place_of(self.text, "Hold:"))

    def test_definition_from_a_scenario(self):
        place = self.client.at("textDocument/definition", self.scenario_uri, place_of(self.scenario, "Guard"))
        self.assertEqual((place["uri"], place["range"]["start"]), (self.uri, place_of(self.text, "Guard AT")))

    def test_references(self):
        found = self.client.at("textDocument/references", self.uri, place_of(self.text, "Grip AT"), context={"includeDeclaration": True})
        own = [f for f in found if f["uri"] == self.uri]
        self.assertEqual(len(own), 3)  # declaration, OUT in Travel, a property
        self.assertTrue(any(f["uri"] == self.scenario_uri for f in found))

    def test_rename_changes_scenarios_too_and_nothing_but_the_name(self):
        edit = self.client.at("textDocument/rename", self.uri, place_of(self.text, "Guard AT"), newName="Door")["changes"]
        renamed = edited(self.text, edit[self.uri])
        scenario = edited(self.scenario, edit[self.scenario_uri])
        for before, after in ((self.text, renamed), (self.scenario, scenario)):
            self.assertEqual(before.replace("Guard", "Door").lower().count("door"), after.lower().count("door"))
        self.assertIn("// 1 = the guard door is open", renamed)  # a comment stays
        path = os.path.join(self.folder, "renamed.seq")
        with open(path, "w", encoding="utf-8") as file:
            file.write(renamed)
        self.assertEqual(subprocess.run([SEQC, "check", path], check=False).returncode, 0)

    def test_a_name_that_is_taken_is_refused(self):
        for name in ("Ack", "STEP", "P_SOLL", "IN3", "1st"):
            with self.assertRaises(Refused):
                self.client.at("textDocument/rename", self.uri, place_of(self.text, "Guard AT"), newName=name)

    def test_symbols_folds_and_selections(self):
        symbols = self.client.request("textDocument/documentSymbol", {"textDocument": {"uri": self.uri}})
        self.assertEqual(symbols[0]["name"], "PickAndPlace")
        self.assertIn("Travel", [s["name"] for s in symbols[0]["children"]])
        folds = self.client.request("textDocument/foldingRange", {"textDocument": {"uri": self.uri}})
        travel = place_of(self.text, "STEP Travel:")["line"]
        end = travel + self.text[self.text.index("STEP Travel:"):].split("END_STEP")[0].count("\n")
        self.assertIn((travel, end), [(f["startLine"], f["endLine"]) for f in folds])
        nested = self.client.request("textDocument/selectionRange", {"textDocument": {"uri": self.uri}, "positions": [place_of(self.text, "T#500ms")]})[0]
        depth = 0
        while "parent" in nested:
            nested, depth = nested["parent"], depth + 1
        self.assertEqual(depth, 5)  # time, statement, IF, STEP, PROGRAM, file
        found = self.client.request("workspace/symbol", {"query": "trav"})
        self.assertIn("Travel", [s["name"] for s in found])


class Writing(Case):
    def setUp(self):
        super().setUp()
        self.text = example("pick_and_place.seq")
        self.uri = self.open(self.text)

    def test_completion_knows_what_may_stand_there(self):
        steps = self.labels(self.uri, place_of(self.text, "NEXT := Hold", 8))
        self.assertEqual(steps, ["Idle", "Travel", "Hold", "Return", "Fault", "Cleared", "POWER_UP"])
        tests = self.labels(self.uri, place_of(self.text, "IF Start", 3))
        self.assertEqual(tests[:3], ["Start", "Guard", "Ack"])
        self.assertIn("TIMER.Q", tests)
        self.assertNotIn("Grip", tests)
        self.assertEqual(self.labels(self.uri, place_of(self.text, "OUT Lamp", 4)), ["Grip", "Lamp"])
        behind = self.labels(self.open(self.text.replace("OUT Lamp;", "OUT Lamp ;", 1)), place_of(self.text, "OUT Lamp;", 9))
        self.assertEqual(behind, ["WHEN", "BLINKING"])  # what parser and reference have; FLASH exists only in the answers
        self.assertEqual(self.labels(self.uri, place_of(self.text, "60 mm", 3)), ["counts", "rev", "mm"])
        self.assertNotIn("STEP", self.labels(self.uri, place_of(self.text, "TIMER := T#500ms")))
        self.assertEqual(self.labels(self.uri, place_of(self.text, "gripper closed")), [])  # a comment

    def test_completion_is_documented_from_the_register_map(self):
        item = next(i for i in self.client.at("textDocument/completion", self.uri, place_of(self.text, "POSITION(Place", 9))["items"] if i["label"] == "P3")
        self.assertIn("Position 3", self.client.request("completionItem/resolve", item)["documentation"]["value"])

    def test_hover(self):
        # 60 mm are 12 rev of 4096 counts: 49152 (SCALE 1 rev = 5 mm)
        shown = self.client.at("textDocument/hover", self.uri, place_of(self.text, "60 mm"))["contents"]["value"]
        self.assertIn("49152", shown)
        step = self.client.at("textDocument/hover", self.uri, place_of(self.text, "Travel:"))["contents"]["value"]
        self.assertIn("to **Hold**", step)
        self.assertIn("C2 ", step)  # 80h, 40h and STATE 2: the first byte of its terms

    def test_hover_on_an_inverted_input(self):
        text = ("PROGRAM G\nMOTOR MAC140;\nVAR_INPUT Estop AT NOT IN2 : BOOL; END_VAR\n"
                "STEP A: OWN ERROR; IF NOT Estop THEN NEXT := POWER_UP; END_IF END_STEP\nEND_PROGRAM\n")
        shown = self.client.at("textDocument/hover", self.open(text), place_of(text, "Estop THEN"))["contents"]["value"]
        self.assertEqual(shown, "input **Estop** at NOT IN2: on while the wire is off")

    def test_signature(self):
        shown = self.client.at("textDocument/signatureHelp", self.uri, place_of(self.text, "INIT(Fast, Soft", 11))
        self.assertEqual((shown["signatures"][0]["label"], shown["activeParameter"]), ("INIT(V, A, T, L, Z)", 1))

    def test_hints_lenses_and_colours(self):
        hints = self.client.request("textDocument/inlayHint", {"textDocument": {"uri": self.uri}, "range": ALL})
        self.assertIn(" = 49152", [h["label"] for h in hints])
        lenses = self.client.request("textDocument/codeLens", {"textDocument": {"uri": self.uri}})
        self.assertEqual({lens["command"]["command"] for lens in lenses}, {"seqc.verify", "seqc.graph", "seqc.rehearse", "seqc.upload"})
        data = self.client.request("textDocument/semanticTokens/full", {"textDocument": {"uri": self.uri}})["data"]
        self.assertEqual(len(data) % 5, 0)
        self.assertGreater(len(data), 1000)

    def test_formatting_is_that_of_seqc_fmt(self):
        loose = self.text.replace("    ", "  ").replace(" := ", ":=")
        uri = self.open(loose, "loose.seq")
        edits = self.client.request("textDocument/formatting", {"textDocument": {"uri": uri}, "options": {"tabSize": 4, "insertSpaces": True}})
        wanted = subprocess.run([SEQC, "fmt", "-"], input=loose, capture_output=True, text=True, check=True).stdout
        self.assertEqual(edited(loose, edits), wanted)
        first = place_of(loose, "STEP Travel:")["line"]
        part = {"start": {"line": first, "character": 0}, "end": {"line": first + 7, "character": 0}}
        edits = self.client.request("textDocument/rangeFormatting", {"textDocument": {"uri": uri}, "range": part, "options": {"tabSize": 4, "insertSpaces": True}})
        laid_out = edited(loose, edits).split("\n")
        self.assertEqual(laid_out[first + 1], "    OUT Grip;")
        self.assertEqual(laid_out[: first - 1], loose.split("\n")[: first - 1])

    def test_typing_finds_the_depth(self):
        text = "PROGRAM P\nSTEP S:\n    OWN ERROR;\n    IF IN0 THEN\n\n    END_IF\nEND_STEP\nEND_PROGRAM\n"
        uri = self.open(text, "typed.seq")
        edits = self.client.at("textDocument/onTypeFormatting", uri, {"line": 4, "character": 0}, ch="\n", options={"tabSize": 4, "insertSpaces": True})
        self.assertEqual([e["newText"] for e in edits], [" " * 8])


class Fixes(Case):
    def fixed(self, text, code, title=None):
        """The text with the first fix, or the one named."""
        uri = self.open(text, f"fix{code}.seq")
        told = next(d for d in self.client.diagnostics(uri) if d["code"] == code)
        actions = [a for a in self.actions(uri, told) if a["kind"] == "quickfix"]
        action = actions[0] if title is None else next(a for a in actions if a["title"] == title)
        return edited(text, action["edit"]["changes"][uri])

    def clean(self, text):
        path = os.path.join(self.folder, "clean.seq")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        done = subprocess.run([SEQC, "check", path], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr + done.stdout)

    HEAD = "PROGRAM P\nSTEP S:\n    OWN ERROR;\n"
    TAIL = "END_STEP\nSTEP T: OWN ERROR; IF IN1 THEN NEXT := S; END_IF END_STEP\nEND_PROGRAM\n"

    def test_each_advice_makes_the_program_right(self):
        body = "    IF IN0 THEN NEXT := T; END_IF\n"
        cases = [
            (body.replace("NEXT := T;", "NEXT := T"), "E010", None),
            (body.replace("END_IF", "ENDIF"), "E010", None),
            (body.replace(" END_IF", ""), "E012", None),
            (body.replace(":=", "="), "E010", None),
            (body.replace(" THEN", ""), "E010", None),
            (body.replace("IF IN0", "IF TIMER"), "E014", None),
            (body.replace("NEXT := T;", "TIMER := T#0ms; NEXT := T;"), "W007", None),
            (body.replace("NEXT := T;", "STOP(); NEXT := T;"), "E050", None),
            ("    IF IN0 THEN NEXT := T; ELSE IF IN2 THEN NEXT := T; END_IF END_IF\n", "E010", None),
            (body + "    IF IN2 AND NOT IN0 THEN COUNT_DOWN; END_IF\n", "E060", "Insert EVERY_SCAN"),
            ("    HOME;\n" , "E060", "Insert ENTRY"),
            (body.replace("NEXT := T;", "NEXT := New;"), "E021", "Add STEP New"),
            (body.replace("IN0", "Start"), "E021", "Declare it: Start AT %IX0.0 : BOOL;"),
        ]
        for text, code, title in cases:
            with self.subTest(text=text):
                motor = "" if "HOME" not in text and "STOP" not in text else "MOTOR MAC140;\n"
                self.clean(self.fixed(self.HEAD.replace("STEP S", motor + "STEP S") + text + self.TAIL, code, title))

    def test_own_error_on_error_and_motor(self):
        plain = self.HEAD.replace("    OWN ERROR;\n", "") + "    IF IN0 THEN NEXT := T; END_IF\n" + self.TAIL
        self.clean(self.fixed(plain, "E080", "Write OWN ERROR; in step S"))
        self.clean(self.fixed(plain, "E080", "Add ON ERROR NEXT := Fault;").replace("END_PROGRAM", "END_PROGRAM"))
        self.clean(self.fixed(self.HEAD + "    IF IN0 THEN INPOSWIN := 9; NEXT := T; END_IF\n" + self.TAIL, "E031"))

    def test_several_at_once(self):
        text = self.HEAD + "    IF IN0 THEN NXT := T END_IF\n    IF NOT IN0 AND IN3 THEN TIMER = T#1s; NEXT := T; ENDIF\n" + self.TAIL
        uri = self.open(text, "several.seq")
        self.assertGreater(len(self.client.diagnostics(uri)), 2)
        actions = self.client.request("textDocument/codeAction", {"textDocument": {"uri": uri}, "range": ALL, "context": {"diagnostics": [], "only": ["source.fixAll"]}})
        self.clean(edited(text, actions[0]["edit"]["changes"][uri]))


class Lifecycle(unittest.TestCase):
    def test_nothing_before_initialize_and_nothing_after_shutdown(self):
        client = Client(SEQC)
        with self.assertRaises(Refused) as refused:
            client.request("textDocument/noSuchThing", {})
        self.assertEqual(refused.exception.code, -32601)
        client.request("shutdown", None)
        with self.assertRaises(Refused) as refused:
            client.request("textDocument/hover", {})
        self.assertEqual(refused.exception.code, -32600)
        client.notify("exit", None)
        self.assertEqual(client.process.wait(30), 0)
        client.process.stdin.close()
        client.process.stdout.close()

    def test_an_editor_that_leaves_ends_it(self):
        client = Client(SEQC)
        client.process.stdin.close()
        self.assertEqual(client.process.wait(30), 1)
        client.process.stdout.close()

    def test_utf8_positions_are_negotiated(self):
        client = Client(SEQC, None, {"general": {"positionEncodings": ["utf-8"]}})
        self.assertEqual(client.capabilities["positionEncoding"], "utf-8")
        client.open("file:///p.seq", "PROGRAM P\nSTEP S: OWN ERROR; (* \u00e9 *) NEXT := Nowhere; END_STEP\nEND_PROGRAM\n")
        told = [d for d in client.diagnostics("file:///p.seq") if d["code"] == "E021"]
        self.assertEqual(told[0]["range"]["start"]["character"], 36)  # 22 + 2 bytes + 12
        self.assertEqual(client.end(), 0)

    def test_bad_messages_are_answered_and_read_over(self):
        client = Client(SEQC)
        client.process.stdin.write(b"Content-Length: 3\r\n\r\n{]}")
        client.process.stdin.flush()
        self.assertEqual(client.receive()["error"]["code"], -32700)
        for params in ({}, {"textDocument": 7}, {"textDocument": {"uri": "file:///none.seq"}, "position": START}):
            with self.assertRaises(Refused) as refused:
                client.request("textDocument/hover", params)
            self.assertEqual(refused.exception.code, -32602)
        self.assertEqual(client.end(), 0)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
