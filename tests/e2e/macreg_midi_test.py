#!/usr/bin/env python3
"""macreg midi on virtual MIDI modules, over real terminals and sockets.

usage: macreg_midi_test.py MACREG MIDISIM
"""

import os
import pty
import signal
import socket
import subprocess
import sys
import termios
import threading
import unittest

import device_case
import shared_line
from device_case import LONG

MACREG = MIDISIM = ""


def receive(stream, count):
    """So many bytes; none if the other end is gone."""
    data = b""
    while len(data) < count:
        part = stream.recv(count - len(data))
        if not part:
            return b""
        data += part
    return data


class Case(device_case.Case):
    def setUp(self):
        super().setUp()
        self.endpoint = "unix:" + self.path("line")
        self.patience = "2000"  # a virtual module may be held up for long by other programs

    def modules(self, *arguments):
        return self.start_program(MIDISIM, "--model", "MAC34-1", *arguments, "--v24", self.endpoint)[0]

    def command(self, *arguments):
        return [MACREG, "--port", self.endpoint, "--patience", self.patience, *arguments[:1], "--model", "MAC34-1", *arguments[1:]]

    def call(self, *arguments, stdin=subprocess.DEVNULL):
        return subprocess.run(self.command("midi", *arguments), stdin=stdin, capture_output=True, text=True,
                              timeout=4 * LONG, check=False)

    def reg(self, *arguments, exit_code=0):
        return self.document_of(self.call("--json", *arguments), exit_code)

    def told(self, exit_code, part, *arguments):
        """One line on standard error, and nothing else but what --json prints."""
        result = self.call(*arguments)
        self.assertEqual(result.returncode, exit_code, f"{arguments}: {result.stdout} {result.stderr}")
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertIn(part, result.stderr, arguments)

    def value(self, name, *arguments):
        return self.reg(*arguments, "get", name)["parameters"][0]["raw"]


class Values(Case):
    def test_status_on_every_kind_of_port(self):
        for endpoint in ("pty:" + self.path("tty"), "unix:" + self.path("socket")):
            self.endpoint = endpoint
            process = self.modules()
            answer = self.reg("status")
            self.assertEqual((answer["model"], answer["release"], answer["position"], answer["faults"]),
                             ("MAC34-1", "7.4", 0, ""))
            values = {one["name"]: one["value"] for one in answer["parameters"]}
            self.assertEqual(values["SPEED"], "100 rpm (16666.67 inc/s)")
            self.assertEqual(values["SUPPLY"], "48.0 V")
            process.terminate()
            process.wait(LONG)

    def test_set_checks_all_before_the_first(self):
        self.modules("--unit", "MAC34-1:5")
        answer = self.reg("set", "SPEED", "300rpm", "TORQUE=33%", "TOLERANCE", "7")["parameters"]
        self.assertEqual([one["raw"] for one in answer], [160, 42, 7])
        self.assertEqual(answer[1]["rounding"], "TORQUE: 33% taken as 32.82 %")
        self.told(2, "TORQUE: '101%'", "set", "SPEED", "100rpm", "TORQUE", "101%")
        self.assertEqual(self.value("SPEED"), 160)
        self.assertEqual(self.value("SPEED", "--address", "5"), 480)
        self.reg("limits", "-2rev", "2rev", "--on")
        self.assertEqual([self.value(name) for name in ("LOWER_STOP", "UPPER_STOP", "END_STOPS")], [-20000, 20000, 8])

    def test_wrong_input_is_one_line_and_nothing_is_sent(self):
        # A port that does not exist: what is refused before it is opened sends nothing.
        self.endpoint = "unix:" + self.path("nobody")
        for part, *arguments in (
                ("'NO' is no parameter", "get", "NO"), ("'NO' is no parameter", "set", "NO", "5"),
                ("POSITION is read only", "set", "POSITION", "5"), ("a value is missing", "set", "SPEED"),
                ("REFERENCE cannot be read", "get", "REFERENCE"), ("write a number", "move", "far"),
                ("either a position", "move"), ("out of range", "move", "1073741824"), ("say --for", "jog", "5rpm"),
                ("no speed at all", "jog", "0rpm", "--for", "1s"), ("is in rpm", "jog", "5kg", "--for", "1s"),
                ("has 13 digits", "raw", "0015000000320"), ("--force", "raw", "00150000000320"),
                ("nobody is there", "raw", "00150000000320", "--force"), ("baud 1200", "baud", "1200"),
                ("both are needed", "limits", "5"), ("is not below", "limits", "5", "5"),
                ("ADDRESS=POSITION", "together", "5"), ("stands there twice", "together", "0=1", "0=2"),
                ("two modules", "circle", "--axes", "0", "--radius", "5", "--speed", "5inc/s"),
                ("different", "circle", "--axes", "0,0", "--radius", "5", "--speed", "5inc/s"),
                ("--radius", "circle", "--axes", "0,1", "--radius", "-5", "--speed", "5inc/s"),
                ("--speed", "circle", "--axes", "0,1", "--radius", "5", "--speed", "5"),
                (self.path("none"), "path", self.path("none")), ("stopp", "stopp"), ("maybe", "power", "maybe")):
            self.told(2, part, *arguments)
        self.told(3, "nobody", "status")
        result = subprocess.run([MACREG, "--port", self.endpoint, "midi", "--model", "MAC99", "status"],
                                capture_output=True, text=True, check=False)
        self.assertEqual((result.returncode, result.stderr.count("\n")), (2, 1))
        for wrong in ("128", "-1"):
            self.told(2, f"{wrong}: modules on a serial line have the addresses 0 to 127", f"--address={wrong}", "status")
        self.endpoint = "can:"
        self.told(2, "interface's name", "status")
        self.endpoint = "can:none0"
        self.told(3, "can:none0: ", "status")
        self.told(2, "LMT addresses no module", "--address", "5", "address", "set", "7")
        # 003 §V.8: 0 is every module on the bus.
        for wrong in ("0", "128", "-1"):
            self.told(2, f"{wrong}: modules on CAN have the addresses 1 to 127", f"--address={wrong}", "status")
        for wrong in ("0", "128"):
            self.told(2, f"{wrong}: modules on CAN have the addresses 1 to 127", "address", "set", wrong)
        with open(self.path("path.csv"), "w", encoding="ascii") as file:
            file.write("time,0 [inc],1 [inc]\n0,0,0\n1,100,100\n")
        for arguments in (("together", "0=2rev", "1=5000"), ("path", self.path("path.csv")),
                          ("circle", "--axes", "0,1", "--radius", "5", "--speed", "5inc/s")):
            self.told(2, "axis 0: modules on CAN have the addresses 1 to 127", *arguments)

    def test_nobody_answers(self):
        self.modules()
        result = subprocess.run([MACREG, "--port", self.endpoint, "--patience", "50", "midi", "--address", "9", "status"],
                                capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 3)
        self.assertIn("no answer from address 9, asked 6 times", result.stderr)

    def test_the_speed_may_stand_before_midi(self):
        for speed, before, behind in ((termios.B38400, [], []), (termios.B19200, ["--baud", "19200"], []),
                                      (termios.B9600, ["--baud", "19200"], ["--baud", "9600"])):
            outside, inside = pty.openpty()
            with subprocess.Popen([MACREG, "--port", os.ttyname(inside), *before, "midi", *behind, "status"],
                                  stderr=subprocess.DEVNULL) as asking:
                os.read(outside, 1)
                self.assertEqual(termios.tcgetattr(outside)[5], speed, before + behind)
                asking.kill()
            os.close(inside)
            os.close(outside)

    def test_raw_shows_both_ways(self):
        self.modules()
        answer = self.reg("raw", "00240000000000")
        self.assertEqual(answer["sent"], "02 30 31 34 30 30 32 34 30 30 30 30 30 30 30 30 30 30 41 36 03")
        self.assertEqual(answer["answer"], "release 7.4")
        # The manual's example; then a stop, which needs no --force.
        answer = self.reg("--yes", "raw", "00150000000320", "--force")
        self.assertEqual(answer["sent"], "02 30 31 34 30 30 31 35 30 30 30 30 30 30 30 33 32 30 41 42 03")
        self.assertEqual((answer["received"], answer["answer"]), ("06 13 1A", "accepted"))
        self.assertEqual(self.reg("raw", "00180000000000")["answer"], "accepted")
        self.assertEqual(self.reg("--yes", "raw", "00050000000000", "--force", exit_code=1)["received"], "06 13 17")


class Motion(Case):
    def standing(self):
        first = self.value("POSITION")
        self.assertEqual(self.value("POSITION"), first)
        return first

    def test_move_and_jog(self):
        self.modules("--speed", "5")
        self.assertEqual(self.reg("move", "20480")["position"], 20480)
        self.assertEqual(self.reg("move", "--by", "-0.5rev")["position"], 15480)
        answer = self.reg("jog", "-2rev/s", "--for", "200ms")
        self.assertLess(answer["position"], 15480)
        self.assertEqual(self.standing(), answer["position"])
        self.reg("zero")
        self.assertEqual(self.standing(), 0)

    def test_a_refused_motion_is_told_with_its_reason(self):
        self.modules()
        self.reg("limits", "-5000", "100", "--on")
        self.assertIn("stopped by the upper software stop", self.reg("move", "3000", exit_code=1)["error"])
        self.assertEqual(self.reg("why")["findings"][0]["code"], "above_upper_stop")
        self.reg("limits", "--off")
        self.reg("move", "0")
        self.reg("move", "1000000", "--no-wait")
        self.assertIn("refused while the axis moves", self.reg("set", "SPEED", "10rpm", exit_code=1)["reason"])
        self.assertIn("--force", self.reg("power", "off", exit_code=1)["error"])
        self.reg("stop")
        self.standing()
        self.reg("power", "off")

    def test_all_are_told_to_stop_though_nobody_answers(self):
        self.modules("--address", "2")
        self.reg("--address", "2", "move", "1000000", "--no-wait")
        self.patience = "100"
        self.told(3, "WHETHER THEY STOPPED IS NOT KNOWN", "stop", "--all", "--emergency")
        self.patience = "2000"
        first = self.value("POSITION", "--address", "2")
        self.assertEqual(self.value("POSITION", "--address", "2"), first)
        self.assertLess(first, 1000000)

    def signalled(self, number, *motion):
        """Its output at the end; the signal is sent twice, once it shows a motion."""
        terminal, others = pty.openpty()
        process = subprocess.Popen(self.command("midi", *motion), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=others)
        self.running.append(process)
        os.close(others)
        said = b""
        try:
            while part := os.read(terminal, 4096):
                if b"\033[K" in part and b"\033[K" not in said:
                    process.send_signal(number)
                    process.send_signal(number)
                said += part
        except OSError:
            pass  # it has ended
        os.close(terminal)
        self.assertEqual(process.wait(LONG), 130, said)
        return said.decode()

    def test_a_signal_never_leaves_it_turning(self):
        self.modules("--unit", "MAC34-1:1")
        jog = ("jog", "60rpm", "--for", "60s")
        circle = ("circle", "--axes", "0,1", "--radius", "50rev", "--speed", "1rev/s", "--segment", "1s")
        for number, motion in ((signal.SIGTERM, jog), (signal.SIGINT, jog), (signal.SIGHUP, jog), (signal.SIGQUIT, jog),
                               (signal.SIGINT, ("move", "--by", "900rev")), (signal.SIGTERM, circle)):
            said = self.signalled(number, *motion)
            self.assertIn("interrupted", said)
            self.assertNotIn("PERHAPS", said.upper())
            for address in ("0", "1"):
                first = self.value("POSITION", "--address", address)
                self.assertEqual(self.value("POSITION", "--address", address), first, motion)

    def test_a_refusal_that_was_none_is_stopped(self):
        """Xon came as 18h, which is one bit of it: the module turns."""
        self.modules()
        real = self.endpoint
        self.endpoint = "unix:" + self.path("noisy")
        relay = self.relay(real, lambda heard: b"\x06\x13\x18" if heard == b"\x06\x13\x1a" else heard, times=1)
        self.told(1, "it moved all the same and was stopped at", "jog", "60rpm", "--for", "60s")
        relay.join(LONG)
        self.endpoint = real
        self.standing()

    def test_the_first_cause_is_told_with_an_unconfirmed_stop(self):
        self.modules()
        real = self.endpoint
        self.endpoint = "unix:" + self.path("noisy")
        relay = self.relay(real, lambda heard: b"\x15" if heard == b"\x06\x13\x1a" else heard, times=100)
        result = self.call("jog", "60rpm", "--for", "60s")
        self.assertEqual((result.returncode, result.stderr.count("\n")), (3, 1), result.stderr)
        self.assertIn("RUN came damaged, 6 times", result.stderr)
        self.assertIn("does not answer to a stop; it stood when looked at", result.stderr)
        relay.join(LONG)

    def relay(self, real, change, times):
        """Passes requests on to a module; its first answers are changed as the line might."""
        server = socket.socket(socket.AF_UNIX)
        server.bind(self.endpoint.removeprefix("unix:"))
        server.listen(1)
        self.addCleanup(server.close)

        def work():
            left = times
            client, _ = server.accept()
            with client, socket.socket(socket.AF_UNIX) as module:
                module.connect(real.removeprefix("unix:"))
                while request := receive(client, 21):
                    module.sendall(request)
                    answer = receive(module, 21 if request[6:7] == b"2" else 3)
                    changed = change(answer) if left > 0 else answer
                    left -= changed != answer
                    client.sendall(changed)

        worker = threading.Thread(target=work)
        worker.start()
        return worker

    def test_a_hung_up_terminal_stops_it(self):
        self.modules()
        child, terminal = pty.fork()
        if child == 0:
            os.execv(MACREG, self.command("midi", "jog", "60rpm"))
        seen = b""
        while b"Enter stops" not in seen:
            seen += os.read(terminal, 4096)
        os.close(terminal)
        self.assertNotEqual(os.waitpid(child, 0)[1], 0)
        self.standing()

    def test_enter_ends_a_jog(self):
        self.modules()
        child, terminal = pty.fork()
        if child == 0:
            os.execv(MACREG, self.command("midi", "jog", "60rpm"))
        seen = b""
        sent = False
        try:
            while True:
                seen += os.read(terminal, 4096)
                if b"Enter stops" in seen and not sent:
                    os.write(terminal, b"\n")
                    sent = True
        except OSError:
            pass  # it has ended
        os.close(terminal)
        self.assertEqual(os.waitpid(child, 0)[1], 0, seen)
        self.assertIn(b"stands at", seen)
        self.standing()


class SeveralAxes(Case):
    def setUp(self):
        super().setUp()
        self.modules("--unit", "MAC34-1:1")

    def places(self):
        return [self.value("POSITION", "--address", address) for address in ("0", "1")]

    def test_together_circle_and_path(self):
        self.reg("together", "0=1000", "1=-0.2rev")
        self.assertEqual(self.places(), [1000, -2000])
        # Segments so long that a busy machine keeps up.
        answer = self.reg("circle", "--axes", "0,1", "--radius", "5000", "--speed", "5000inc/s", "--segment", "250ms",
                          "--acceleration", "2rev/s2")
        self.assertEqual(self.places(), [1000, -2000])
        self.assertAlmostEqual(answer["seconds"], 2 * 3.14159265 + 0.25, places=2)
        with open(self.path("way.csv"), "w", encoding="ascii") as file:
            file.write("time,0 [inc],1 [rev]\n0,0,0\n0.5,600,0.05\n1,0,0.1\n")
        self.assertEqual(self.reg("path", self.path("way.csv"), "--check")["points"], 3)
        self.reg("path", self.path("way.csv"))
        self.assertEqual(self.places(), [0, 1000])

    def test_what_the_line_cannot_feed(self):
        result = self.call("circle", "--axes", "0,1", "--radius", "5000", "--speed", "50000inc/s", "--segment", "5ms")
        self.assertEqual(result.returncode, 1)
        self.assertIn("would run out of segments", result.stderr)
        self.assertEqual(self.places(), [0, 0])


class SameAddress(Case):
    """Two modules at one address on one line, and a third at its own."""

    def setUp(self):
        super().setUp()
        self.patience = "500"
        self.line = shared_line.SharedLine(self.path("line"))
        self.addCleanup(self.line.close)
        self.endpoint = "unix:" + self.path("a")
        self.modules("--speed", "20", "--eeprom", self.path("a.eeprom"))
        self.endpoint = "unix:" + self.path("c")
        self.modules("--speed", "20", "--address", "3")
        for name in "ac":
            self.line.join(self.path(name))
        self.endpoint = "pty:" + self.path("line")

    def second(self):
        self.endpoint = "unix:" + self.path("b")
        process = self.modules("--speed", "20")
        self.line.join(self.path("b"))
        self.endpoint = "pty:" + self.path("line")
        return process

    def test_what_moves_is_refused_and_why_names_it(self):
        self.second()
        for arguments in (("move", "1rev"), ("jog", "60rpm", "--for", "1s"), ("power", "on"), ("together", "0=1rev", "3=1rev"),
                          ("circle", "--axes", "0,3", "--radius", "1000", "--speed", "1000inc/s"),
                          ("--address", "0", "address", "set", "9")):
            result = self.call(*arguments) if "set" not in arguments else subprocess.run(
                [*self.command("--yes"), *("midi", *arguments)], capture_output=True, text=True, timeout=4 * LONG, check=False)
            self.assertNotEqual(result.returncode, 0, arguments)
            self.assertRegex(result.stderr, "more than one module answers to address 0|two modules have this address", arguments)
        findings = self.reg("why")["findings"]
        self.assertEqual([one["code"] for one in findings], ["same_address"])
        self.assertIn("address set", findings[0]["remedy"])
        self.patience = "100"  # of each unused address
        self.assertEqual([(one["address"], one.get("several")) for one in self.reg("find", "--this-speed")["modules"]],
                         [(0, True), (3, None)])
        self.patience = "500"
        self.reg("--address", "3", "move", "0.5rev")
        self.assertFalse(os.path.exists(self.path("a.eeprom")) and self.position_kept() != 0)

    def position_kept(self):
        with open(self.path("a.eeprom"), encoding="utf-8") as file:
            return int(next(line for line in file if line.startswith("position = ")).split("=")[1])

    def test_a_taken_address_is_not_given_again(self):
        result = subprocess.run([*self.command("--yes"), "midi", "--address", "3", "address", "set", "0"], capture_output=True,
                                text=True, timeout=4 * LONG, check=False)
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("address 0 answers already", result.stderr)

    def test_one_that_joins_ends_a_jog(self):
        # pylint: disable-next=consider-using-with
        jog = subprocess.Popen(self.command("midi", "jog", "60rpm", "--for", "60s"), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True)
        self.second()
        _, said = jog.communicate(timeout=4 * LONG)
        self.assertNotEqual(jog.returncode, 0)
        self.assertRegex(said, "more than one module answers|two modules have this address|no clear answer|its first")
        self.assertEqual(self.reg("--address", "3", "status")["turns"], False)


class Service(Case):
    def test_address_baud_reset_and_find(self):
        self.modules("--speed", "20")
        self.told(2, "nobody is there to be asked", "address", "set", "7")
        self.assertEqual(self.reg("--yes", "address", "set", "7")["address"], 7)
        self.patience = "100"  # of each unused address
        found = self.reg("find")["modules"]
        self.patience = "2000"
        self.assertEqual([one["address"] for one in found], [7])
        self.assertEqual(self.reg("--address", "7", "--yes", "reset")["faults"], "")
        self.assertEqual(self.reg("--address", "7", "--yes", "baud", "19200")["baud"], 19200)
        self.told(2, "nobody is there to be asked", "--address", "7", "factory")
        self.assertEqual(self.reg("--address", "7", "--yes", "factory")["address"], 0)
        self.assertEqual(self.value("SPEED"), 480)


class Documents(Case):
    def test_completion_and_manual_know_the_commands(self):
        for shell in ("bash", "zsh"):
            text = subprocess.run([MACREG, "completion", shell], capture_output=True, text=True, check=True).stdout
            for word in ("circle", "--emergency", "UPPER_STOP"):
                self.assertIn(word, text, shell)
        text = subprocess.run([MACREG, "man"], capture_output=True, text=True, check=True).stdout
        self.assertIn("midi jog speed", text)
        self.assertIn("midi address set new_address", text)

    def test_bash_completes_commands_of_midi(self):
        script = subprocess.run([MACREG, "completion", "bash"], capture_output=True, text=True, check=True).stdout
        def completed(*words):
            line = script + f'COMP_WORDS=({" ".join(words)}); COMP_CWORD={len(words) - 1}; _macreg; echo "${{COMPREPLY[*]}}"'
            return subprocess.run(["bash", "-c", line], capture_output=True, text=True, check=True).stdout.split()
        self.assertEqual(completed("macreg", "midi", "cir"), ["circle"])
        self.assertEqual(completed("macreg", "midi", "get", "UPP"), ["UPPER_STOP"])
        self.assertEqual(completed("macreg", "midi", "stop", "--em"), ["--emergency"])
        self.assertEqual(completed("macreg", "get", "P_SO"), ["P_SOLL"])


if __name__ == "__main__":
    MACREG, MIDISIM = sys.argv[1:3]
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
