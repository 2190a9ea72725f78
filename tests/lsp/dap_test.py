#!/usr/bin/env python3
"""`seqc dap`: rehearsals in virtual time, and a gateway on the simulated board in real time.

usage: dap_test.py SEQC NANOPLC-SIM NANOCTL EXAMPLES [UNITTEST-ARGUMENT...]
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

SEQC, SIM, NANOCTL, EXAMPLES = sys.argv[1:5]


# Of a command that a gateway on a busy machine read too late and did not carry out, so it can be given again.
TOO_LATE = "it waited longer than 1 s"


class Refused(Exception):
    pass


class Debugger:
    def __init__(self):
        self.process = subprocess.Popen([SEQC, "dap"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.sequence = 0
        self.events = []
        self.transcript = []
        self.capabilities = self.request("initialize", {"adapterID": "seqc", "linesStartAt1": True})

    def receive(self):
        length = None
        while True:
            line = self.process.stdout.readline()
            if not line:
                raise EOFError("the adapter ended")
            if line == b"\r\n":
                break
            length = int(line.partition(b":")[2])
        message = json.loads(self.process.stdout.read(length))
        self.transcript.append(message)
        return message

    def request(self, command, arguments=None):
        while True:
            try:
                return self.request_once(command, arguments)
            except Refused as refused:
                if TOO_LATE not in str(refused):
                    raise
                time.sleep(1)

    def request_once(self, command, arguments):
        self.sequence += 1
        message = {"seq": self.sequence, "type": "request", "command": command, "arguments": arguments or {}}
        content = json.dumps(message).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(content) + content)
        self.process.stdin.flush()
        while True:
            answer = self.receive()
            if answer["type"] == "event":
                self.events.append(answer)
            elif answer["request_seq"] == self.sequence:
                if not answer["success"]:
                    raise Refused(answer["message"])
                return answer.get("body")

    def wait_for(self, *names):
        while True:
            for i, event in enumerate(self.events):
                if event["event"] in names:
                    del self.events[: i + 1]
                    return event["event"], event["body"]
            self.events.append(self.receive())

    def values(self, scope):
        number = next(s["variablesReference"] for s in self.request("scopes", {"frameId": 1})["scopes"] if s["name"] == scope)
        return {v["name"]: v["value"] for v in self.request("variables", {"variablesReference": number})["variables"]}

    def set(self, scope, name, value):
        number = next(s["variablesReference"] for s in self.request("scopes", {"frameId": 1})["scopes"] if s["name"] == scope)
        return self.request("setVariable", {"variablesReference": number, "name": name, "value": value})["value"]

    def step(self):
        return self.values("Sequence")["step"]

    def end(self):
        self.request("disconnect")
        return self.close()

    def close(self):
        self.process.stdin.close()
        code = self.process.wait(120)
        self.process.stdout.close()
        return code


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="seqc-dap-")
        self.addCleanup(shutil.rmtree, self.folder)
        self.program = os.path.join(EXAMPLES, "pick_and_place.seq")
        with open(self.program, encoding="utf-8") as file:
            self.text = file.read()
        self.debugger = Debugger()
        self.addCleanup(self.end_debugger)

    def end_debugger(self):
        debugger, self.debugger = self.debugger, None
        if debugger is not None:
            self.assertEqual(debugger.end(), 0)

    def line(self, words):
        return self.text[: self.text.index(words)].count("\n") + 1

    def breakpoint(self, line):
        return self.debugger.request(
            "setBreakpoints", {"source": {"path": self.program}, "breakpoints": [{"line": line}]}
        )["breakpoints"]


class Rehearsal(Case):
    def launch(self, **more):
        self.debugger.request("launch", {"program": self.program, **more})
        self.debugger.wait_for("initialized")

    def scenario(self):
        return os.path.join(EXAMPLES, "pick_and_place.scn")

    def test_breakpoints_steps_and_variables(self):
        self.launch(scenario=self.scenario())
        told = self.breakpoint(self.line("ENTRY POSITION(Place)"))
        self.assertEqual((told[0]["verified"], told[0]["line"]), (True, self.line("STEP Travel:")))
        self.debugger.request("configurationDone")
        _, why = self.debugger.wait_for("stopped")
        self.assertEqual(why["reason"], "breakpoint")
        frame = self.debugger.request("stackTrace", {"threadId": 1})["stackFrames"][0]
        self.assertEqual(frame["line"], self.line("STEP Travel:"))
        self.assertEqual(self.debugger.step(), "Travel")
        self.assertEqual(self.debugger.values("Outputs")["Grip"], "TRUE")
        self.assertEqual(self.debugger.values("Inputs")["Start"], "TRUE")  # pulsed for 50 ms
        self.debugger.request("next", {"threadId": 1})
        self.debugger.wait_for("stopped")
        self.assertEqual(self.debugger.step(), "Hold")
        # Hold is entered in position: 60 mm are 49152 counts, INPOSWIN is some counts
        position = int(self.debugger.values("Motor")["P_IST"].split("(")[1].rstrip(")"))
        self.assertLess(abs(position - 49152), 50)
        self.assertEqual(self.debugger.values("Motor")["Place"], "60 mm (49152)")
        self.assertEqual(self.debugger.request("evaluate", {"expression": "TIMER"})["result"], "500 ms")

    def test_steps_of_an_included_file(self):
        places = {}
        for name, text in (("moves.seqi", "STEP There: IF TIMER.Q THEN TIMER := T#9ms; NEXT := Back; END_IF END_STEP\n"),
                           ("p.seq", "PROGRAM P\nMOTOR MAC140;\nINCLUDE 'moves.seqi';\nON ERROR NEXT := Fault;\n"
                                     "STEP Back: IF TIMER.Q THEN TIMER := T#9ms; NEXT := There; END_IF END_STEP\n"
                                     "STEP Fault: OWN ERROR; IF ANY ERROR AND IN0 THEN RESET_ERROR; NEXT := Back; END_IF END_STEP\n"
                                     "END_PROGRAM\n")):
            places[name] = os.path.join(self.folder, name)
            with open(places[name], "w", encoding="utf-8") as file:
                file.write(text)
        self.program = places["p.seq"]
        self.launch()
        self.assertEqual([b["verified"] for b in self.breakpoint(5)], [True])
        told = self.debugger.request("setBreakpoints", {"source": {"path": places["moves.seqi"]}, "breakpoints": [{"line": 1}]})
        self.assertEqual([(b["verified"], b["line"]) for b in told["breakpoints"]], [(True, 1)])
        self.debugger.request("configurationDone")
        seen = []
        for _ in range(2):
            self.debugger.wait_for("stopped")
            frame = self.debugger.request("stackTrace", {"threadId": 1})["stackFrames"][0]
            seen.append((self.debugger.step(), frame["source"]["path"], frame["line"]))
            self.debugger.request("continue", {"threadId": 1})
        self.assertEqual(sorted(seen), [("Back", places["p.seq"], 5), ("There", places["moves.seqi"], 1)])

    def test_it_runs_to_the_end_of_its_scenario(self):
        self.launch(scenario=self.scenario())
        self.debugger.request("configurationDone")
        _, body = self.debugger.wait_for("exited")
        self.assertEqual(body["exitCode"], 0)

    def test_a_failed_expectation_stops_it(self):
        path = os.path.join(self.folder, "wrong.scn")
        with open(path, "w", encoding="utf-8") as file:
            file.write("never Lamp from 100 ms\nend at 1 s\n")
        self.launch(scenario=path)
        self.debugger.request("configurationDone")
        _, why = self.debugger.wait_for("stopped")
        self.assertEqual(why["reason"], "exception")

    def test_inputs_and_registers_are_set_by_hand(self):
        self.launch(stopOnEntry=True)
        self.debugger.request("configurationDone")
        self.debugger.wait_for("stopped")
        self.debugger.request("setFunctionBreakpoints", {"breakpoints": [{"name": "Idle"}]})
        self.debugger.request("continue", {"threadId": 1})
        self.debugger.wait_for("stopped")
        self.assertEqual(self.debugger.step(), "Idle")
        self.assertEqual(self.debugger.set("Inputs", "Start", "1"), "TRUE")
        self.debugger.request("next", {"threadId": 1})
        self.debugger.wait_for("stopped")
        self.assertEqual(self.debugger.step(), "Travel")
        # 5 mm are a revolution: 4096 counts
        self.assertEqual(self.debugger.set("Motor", "Home", "5 mm"), "5 mm (4096)")
        self.assertEqual(self.debugger.values("Motor")["Home"], "5 mm (4096)")
        for scope, name, value in (("Outputs", "Grip", "1"), ("Inputs", "Start", "2"), ("Motor", "Home", "5 kg"), ("Sequence", "step", "3")):
            with self.assertRaises(Refused):
                self.debugger.set(scope, name, value)

    def test_an_inverted_input_is_shown_and_set_by_its_name(self):
        self.program = os.path.join(self.folder, "g.seq")
        with open(self.program, "w", encoding="utf-8") as file:
            file.write("PROGRAM G\nMOTOR MAC140;\nVAR_INPUT Estop AT NOT IN2 : BOOL; END_VAR\n"
                       "STEP A: OWN ERROR; IF NOT Estop THEN NEXT := B; END_IF END_STEP\n"
                       "STEP B: OWN ERROR; IF Estop THEN NEXT := A; END_IF END_STEP\nEND_PROGRAM\n")
        self.launch(stopOnEntry=True)
        self.debugger.request("configurationDone")
        self.debugger.wait_for("stopped")
        self.assertEqual(self.debugger.values("Inputs")["Estop"], "TRUE")  # the terminal is off
        self.assertEqual(self.debugger.set("Inputs", "Estop", "0"), "FALSE")
        self.debugger.request("setFunctionBreakpoints", {"breakpoints": [{"name": "B"}]})
        self.debugger.request("continue", {"threadId": 1})
        self.debugger.wait_for("stopped")
        self.assertEqual(self.debugger.step(), "B")
        self.assertEqual(self.debugger.values("Inputs")["Estop"], "FALSE")

    def test_what_never_ends_can_be_paused(self):
        self.launch()
        self.debugger.request("configurationDone")
        self.debugger.wait_for("seqc/state")
        self.debugger.request("pause", {"threadId": 1})
        self.debugger.wait_for("stopped")
        self.assertEqual(self.debugger.step(), "Idle")

    def test_bad_arguments_are_told(self):
        wrong = os.path.join(self.folder, "wrong.scn")
        with open(wrong, "w", encoding="utf-8") as file:
            file.write("at 1 s Strat := 1\n")
        for arguments in ({}, {"program": "/none.seq"}, {"program": self.program, "scenario": wrong}, {"program": self.program, "motor": "MAC7"}):
            with self.assertRaises(Refused):
                self.debugger.request("launch", arguments)


class Gateway(Case):
    """A gateway on the simulated board, in real time."""

    def setUp(self):
        super().setUp()
        self.endpoint = "unix:" + os.path.join(self.folder, "gateway")
        self.table = os.path.join(self.folder, "p.bin")
        subprocess.run([SEQC, "build", self.program, "-o", self.table, "--quiet"], check=True)
        self.sim = subprocess.Popen(
            [SIM, "run", "--realtime", "--mactalk", self.endpoint, "--flash", os.path.join(self.folder, "flash")],
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True)
        self.addCleanup(self.stop)
        self.addCleanup(self.end_debugger)  # before its gateway is gone
        while self.sim.stdout.readline().strip() != "ready":
            self.assertIsNone(self.sim.poll())

    def stop(self):
        self.sim.terminate()
        self.sim.wait(120)
        self.sim.stdout.close()

    def nanoctl(self, *arguments):
        command = [NANOCTL, "--port", self.endpoint, "--patience", "20000", *arguments]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        while TOO_LATE in done.stderr:
            time.sleep(1)
            done = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, (arguments, done.stdout, done.stderr))
        return done.stdout

    def attach(self):
        self.debugger.request("attach", {"program": self.program, "endpoint": self.endpoint})
        self.debugger.wait_for("initialized")

    def test_a_breakpoint_holds_with_the_motor_stopped_and_forces_end(self):
        self.nanoctl("upload", self.table, "--run")
        self.attach()
        self.breakpoint(self.line("STEP Travel:"))
        self.debugger.request("configurationDone")
        self.debugger.set("Inputs", "Start", "1")
        _, why = self.debugger.wait_for("stopped")
        self.assertEqual((why["reason"], self.debugger.step()), ("breakpoint", "Travel"))
        self.assertIn("held", self.nanoctl("status"))
        self.debugger.request("next", {"threadId": 1})
        self.debugger.wait_for("stopped")
        self.assertEqual(self.debugger.step(), "Hold")
        self.debugger.request("continue", {"threadId": 1})
        self.debugger.request("pause", {"threadId": 1})
        self.debugger.wait_for("stopped")
        self.assertIn("held", self.debugger.values("Sequence")["state"])
        self.debugger.request("disconnect")
        self.debugger.wait_for("terminated")
        self.assertIn("no breakpoints", self.nanoctl("break"))
        self.assertIn("nothing is forced", self.nanoctl("force"))
        self.debugger.close()
        self.debugger = Debugger()

    def test_conditions_of_a_copy_of_a_step_are_those_of_the_step(self):
        self.program = os.path.join(self.folder, "edge.seq")
        self.text = ("PROGRAM P\nMOTOR MAC140;\nVAR_INPUT Go AT %IX0.2 : BOOL; END_VAR\nPOWER_UP NEXT := A; END_POWER_UP\n"
                     "STEP A: OWN ERROR; IF R_TRIG(Go) THEN NEXT := B; END_IF END_STEP\n"
                     "STEP B: OWN ERROR; IF NOT Go THEN NEXT := A; END_IF END_STEP\nEND_PROGRAM\n")
        with open(self.program, "w", encoding="utf-8") as file:
            file.write(self.text)
        subprocess.run([SEQC, "build", self.program, "-o", self.table, "--quiet"], check=True)
        self.nanoctl("upload", self.table, "--run")
        self.attach()
        self.debugger.request("configurationDone")
        # Go is off, so A has gone to the copy for that case.
        told = self.state(lambda body: body["name"].startswith("A_"))
        self.assertEqual([(c["text"], c["holds"]) for c in told["conditions"]], [("R_TRIG(Go)", False)])
        self.assertEqual(told["conditions"][0]["parts"], [{"text": "Go", "holds": False}])

    def test_another_table_is_refused(self):
        other = os.path.join(self.folder, "other.bin")
        subprocess.run([SEQC, "build", os.path.join(EXAMPLES, "press.seq"), "-o", other, "--quiet"], check=True)
        self.nanoctl("upload", other, "--run")
        with self.assertRaises(Refused) as refused:
            self.attach()
        self.assertIn("another table", str(refused.exception))

    def test_it_does_not_start_a_machine(self):
        self.nanoctl("upload", self.table, "--run")
        self.nanoctl("stop")
        self.attach()
        with self.assertRaises(Refused):
            self.debugger.request("continue", {"threadId": 1})
        self.assertIn("stopped", self.nanoctl("status"))

    def state(self, where):
        while True:
            _, body = self.debugger.wait_for("seqc/state")
            if where(body):
                return body

    def test_a_person_runs_and_stops_it_and_what_others_start_is_followed(self):
        self.nanoctl("upload", self.table, "--run")
        self.nanoctl("stop")
        self.attach()
        self.debugger.request("configurationDone")
        self.debugger.wait_for("stopped")
        self.nanoctl("run")
        self.debugger.wait_for("continued")
        self.state(lambda body: body["name"] == "Idle" and body["state"] == "running")
        self.debugger.request("seqc/stop")
        self.assertIn("stopped", self.nanoctl("status"))
        self.state(lambda body: body["state"] == "stopped")
        self.debugger.wait_for("stopped")
        self.assertEqual(self.debugger.request("evaluate", {"expression": "run", "context": "repl"})["result"], "running")
        self.state(lambda body: body["state"] == "running")
        self.assertIn("running", self.nanoctl("status"))

    def test_the_conditions_of_the_active_step_are_told_as_they_change(self):
        self.nanoctl("upload", self.table, "--run")
        self.attach()
        self.debugger.request("configurationDone")
        idle = self.state(lambda body: body["name"] == "Idle")
        line = self.line("IF Start AND NOT Guard")
        parts = [{"text": "Start", "holds": False}, {"text": "Guard", "holds": False}]
        self.assertEqual(idle["conditions"], [{"file": self.program, "line": line, "text": "Start AND NOT Guard", "holds": False, "parts": parts}])
        self.debugger.set("Inputs", "Guard", "1")
        self.state(lambda body: body["conditions"] and body["conditions"][0]["parts"][1]["holds"])
        self.debugger.set("Inputs", "Guard", "0")
        self.debugger.set("Inputs", "Start", "1")
        travel = self.state(lambda body: body["name"] == "Travel")
        # The step's own, then ON Guard IN Travel, Return.
        self.assertEqual([c["text"] for c in travel["conditions"]], ["INPOS", "Guard"])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[5:]])
