#!/usr/bin/env python3
"""macreg on virtual motors, over real terminals and sockets.

usage: macreg_test.py MACREG MACSIM NANOPLC_SIM SEQC SHUTTLE.seq
"""

import json
import os
import pty
import signal
import subprocess
import sys
import termios
import tty
import unittest

from noisy_proxy import NoisyProxy
from patience import until
from program_case import ProgramCase

MACREG = MACSIM = SIM = SEQC = SHUTTLE = ""
LONG = 60  # timeout in seconds of what must come


class Case(ProgramCase):
    def setUp(self):
        super().setUp()
        self.endpoint = "unix:" + self.path("port")

    def motor(self, *arguments, endpoint=None, model="MAC140"):
        self.endpoint = endpoint or self.endpoint
        process, lines = self.launch(MACSIM, "--model", model, "--address", "8", "--fastmac", "pty:" + self.path("fastmac"),
                                     "--mactalk", self.endpoint, *arguments)
        if self.endpoint == "tcp:127.0.0.1:0":
            self.endpoint = next(word for line in lines for word in line.split() if word.startswith("tcp:"))
        return process

    def start(self, *arguments, **options):
        process = subprocess.Popen([MACREG, "--port", self.endpoint, *arguments], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True, **options)
        self.running.append(process)
        return process

    def call(self, *arguments, port=None, patience=500):
        return subprocess.run([MACREG, "--port", port or self.endpoint, "--patience", str(patience), *arguments],
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=4 * LONG, check=False)

    def reg(self, *arguments, exit_code=0, **options):
        return self.document_of(self.call("--json", *arguments, **options), exit_code)

    def value(self, name, **options):
        return self.reg("get", name, **options)["registers"][0]["raw"]

    def refused(self, exit_code, part, *arguments, **options):
        result = self.call(*arguments, **options)
        self.assertEqual((result.returncode, result.stderr.count("\n")), (exit_code, 1), f"{arguments}: {result.stdout} {result.stderr}")
        self.assertIn(part, result.stderr, arguments)
        return result

    def read(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return file.read()


class Registers(Case):
    def test_every_kind_of_port(self):
        for endpoint in ("pty:" + self.path("tty"), "unix:" + self.path("socket"), "tcp:127.0.0.1:0"):
            with self.subTest(endpoint):
                process = self.motor(endpoint=endpoint)
                self.assertEqual(self.value("V_SOLL"), 1600)  # 001 3.2.5: 762.9 rpm
                self.assertEqual(self.reg("get", "5")["registers"][0]["value"], "762.94 rpm")
                process.terminate()
                process.wait(LONG)

    def test_set_takes_units_rounds_aloud_and_reaches_no_other_register(self):
        self.motor()
        answer = self.reg("set", "V_SOLL", "1500rpm", "T_SOLL=50%")["registers"]
        self.assertEqual([one["raw"] for one in answer], [3146, 512])  # 1500 / 0.4768, 1023 / 2
        self.assertIn("1500.13 rpm", answer[0]["rounding"])
        self.assertEqual(self.value("A_SOLL"), 160)
        self.assertIn("V_SOLL = -47.68 rpm (raw -100; was 1500.13 rpm)", self.call("set", "V_SOLL", "-100").stdout)
        self.assertEqual(self.reg("set", "V_SOLL", "500", "rpm")["registers"][0]["raw"], 1049)

    def test_wrong_values_are_refused_before_the_first_write(self):
        self.motor()
        for part, *values in (("out of range", "T_SOLL", "101%"), ("T_SOLL takes %peak", "T_SOLL", "20A"),
                              ("no value", "V_SOLL", "fast"), ("did you mean V_SOLL", "V_SOL", "5"),
                              ("write V_SOLL VALUE", "V_SOLL"), ("named twice", "V_SOLL", "1", "V_SOLL", "2"),
                              ("upper word", "4", "1"), ("--force", "KFF3", "1"), ("read only", "V_IST", "1"),
                              ("out of range", "A_SOLL", "raw:70000"), ("16 bits", "A_SOLL", "0x12345")):
            with self.subTest(values):
                self.refused(2, part, "set", "P_HOME", "7", *values)
        self.assertEqual(self.value("P_HOME"), 0)

    def test_limits_that_shut_the_shaft_out_want_force_and_a_yes(self):
        self.motor()
        for part, words in (("not below MAX_P_IST", "MIN_P_IST 500 MAX_P_IST -500"), ("LOW MAX_P_IST HIGH", "MIN_P_IST 500"),
                            ("P_IST (0) is then outside of 500 to 900", "MIN_P_IST 500 MAX_P_IST 900")):
            self.refused(2, part, "set", *words.split())
            self.refused(2, "say --yes", "set", *words.split(), "--force")
        # Inside 1000 to 5000 the lower limit alone, beside an upper one of 0, would shut 3000 out, and the other way round.
        for words in ("P_IST 3000", "MIN_P_IST 1000 MAX_P_IST 5000", "MIN_P_IST 0 MAX_P_IST 0", "P_IST -3000",
                      "MIN_P_IST -5000 MAX_P_IST -1000"):
            self.reg("set", *words.split())
        self.assertEqual(self.value("ERR_STAT") & 0x80, 0)  # PLIM_ERR
        self.reg("set", "MIN_P_IST", "500", "MAX_P_IST", "-500", "--force", "--yes")
        self.assertEqual(self.reg("why")["findings"][0]["code"], "limits_swapped")
        self.reg("dump", "-o", self.path("reversed.txt"))
        self.reg("set", "MIN_P_IST", "0", "MAX_P_IST", "0")
        self.refused(2, "not below MAX_P_IST", "load", self.path("reversed.txt"))

    def test_names_of_the_program_mactalk_are_found(self):
        for name, wanted, model in (("max velocity", "V_SOLL", "MAC140"), ("motor load", "I2T", "MAC140"),
                                    ("Zero search speed", "V_HOME", "MAC800")):
            self.assertIn(wanted, self.call("--model", model, "list", name, port="unix:/nowhere").stdout)

    def test_dangerous_registers_want_force_and_a_yes(self):
        self.motor()
        before = self.value("KFF3")
        self.refused(2, "say --yes", "set", "KFF3", "raw:1", "--force")
        for answer, exit_code, after in (("no\n", 2, before), ("yes\n", 0, 1)):
            keyboard, terminal = pty.openpty()
            process = self.start("set", "KFF3", "raw:1", "--force", stdin=terminal)
            os.write(keyboard, answer.encode())
            process.communicate(timeout=LONG)
            self.assertEqual(process.returncode, exit_code)
            os.close(keyboard)
            os.close(terminal)
            self.assertEqual(self.value("KFF3"), after)
        self.reg("set", "KFF3", "raw:2", "--force", "--yes")

    def test_ctrl_c_at_a_question_changes_nothing(self):
        self.motor()
        keyboard, terminal = pty.openpty()
        process = self.start("flash", "defaults", stdin=terminal)
        question = b""
        while b"Type yes" not in question:
            question += os.read(process.stderr.fileno(), 1)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=LONG)
        self.assertEqual(process.returncode, 130)
        os.close(keyboard)
        os.close(terminal)
        self.assertEqual(self.value("MODE_REG"), 0)

    def test_a_refused_write_says_why(self):
        self.motor()
        self.reg("safe", "enter")
        refused = self.reg("set", "MODE_REG", "P_MODE", exit_code=1)
        self.assertIn("safe exit", refused["reason"])
        self.reg("safe", "exit")
        self.assertEqual(self.reg("set", "MODE_REG", "P_MODE")["registers"][0]["raw"], 2)

    def test_a_stop_on_a_line_that_does_not_answer(self):
        """52h: a write. It is sent before any question, and said not to be confirmed."""
        for options, first in ((("--address", "8"), "52 52 52 08 F7 02 FD 02 FD 00 FF 00 FF"), ((), "52 52 52 FF 00 02 FD 02 FD 00 FF 00 FF"),
                               (("--address", "8", "--model", "MAC800"), "52 52 52 08 F7 02 FD 04 FB 00 FF 00 FF 00 FF 00 FF")):
            master, slave = pty.openpty()
            tty.setraw(slave)
            first = bytes.fromhex(first)
            result = self.call(*options, "set", "MODE_REG", "INIT_MODE", port=os.ttyname(slave), patience=50)
            self.assertEqual(os.read(master, 4096)[:len(first)], first)
            self.assertEqual(result.returncode, 4)
            self.assertEqual("a MAC800 takes it with --model MAC800 only" in result.stderr, "--model" not in options)
            self.assertIn("the stop was sent, but not confirmed: the motor may be moving", result.stderr)
            os.close(slave)
            os.close(master)

    def test_a_stop_is_read_back(self):
        for model in ("MAC140", "MAC800"):
            motor = self.motor(model=model)
            self.reg("set", "MODE_REG", "P_MODE")
            self.assertIn("MODE_REG = INIT_MODE (raw 0)", self.call("set", "MODE_REG", "INIT_MODE").stdout)
            self.assertEqual(self.value("MODE_REG"), 0)
            motor.terminate()
            motor.wait()

    def test_a_mac800_is_known_by_itself(self):
        self.motor(model="MAC800")
        self.assertEqual(self.reg("get", "V_SOLL")["registers"][0]["value"], "1000.16 rpm")  # 004: 2771 / 2.77056
        self.refused(2, "MAC800", "--model", "MAC140", "get", "V_SOLL")

    def test_why_answers_and_changes_when_it_is_mended(self):
        self.motor()
        self.assertEqual(self.reg("why")["findings"][0]["code"], "passive")
        self.reg("set", "T_SOLL", "0", "MODE_REG", "V_MODE")
        self.assertEqual(self.reg("why")["findings"][0]["code"], "torque_zero")
        self.assertIn("T_SOLL", self.call("why").stdout)
        self.reg("set", "T_SOLL", "100%")
        until(lambda: self.reg("why")["findings"][0]["code"] == "moves")


class Files(Case):
    def test_dump_diff_and_load(self):
        self.motor()
        self.reg("dump", "-o", self.path("good.txt"))
        self.assertIn("V_SOLL = 762.94 rpm", self.read("good.txt"))
        self.assertEqual(self.call("diff", self.path("good.txt")).returncode, 0)
        self.reg("set", "V_SOLL", "5", "P3", "123456")
        different = self.call("--json", "diff", self.path("good.txt"))
        self.assertEqual(different.returncode, 1)
        self.assertEqual([one["name"] for one in json.loads(different.stdout)["differences"]], ["V_SOLL", "P3"])
        self.assertEqual(self.reg("load", self.path("good.txt"))["written"], ["V_SOLL", "P3"])
        self.assertEqual(self.value("V_SOLL"), 1600)
        self.assertEqual(self.reg("load", self.path("good.txt"))["written"], [])
        self.reg("dump", "-o", self.path("again.txt"))
        self.assertEqual(self.call("diff", self.path("good.txt"), self.path("again.txt"), port="none").returncode, 0)

    def test_what_acts_on_the_flash_is_no_mode(self):
        self.motor()
        self.reg("set", "GEARF1", "77")
        self.reg("--yes", "safe", "enter")
        for value in ("LOAD_DEFAULTS", "256", "257", "258", "99"):
            self.refused(2, "MODE_REG: ", "set", "MODE_REG", value)
        self.refused(2, "STARTMODE: 99 is no mode", "set", "STARTMODE", "99")
        self.assertEqual(self.value("GEARF1"), 77)

    def test_a_bad_file_writes_nothing(self):
        self.motor()
        head = "model = MAC50-141\nV_SOLL = 7\n"
        for part, text in ((":3: MAC50 to MAC141 has no register 'A_SOL'", head + "A_SOL = 5\n"),
                           (":3: 'x' is no value", head + "T_SOLL = x\n"), ("is no file of macreg", "V_SOLL = 7\n"),
                           ("MAC800", "model = MAC800\nV_SOLL = 7\n"), ("incomplete", head + "incomplete = lost\n"),
                           ("holds no register", "model = MAC140\n"), ("--skip-dangerous", head + "KFF3 = 1\n"),
                           ("type 99", head + "motor_type = 99\n")):
            registers = sum(line[0].isupper() for line in text.splitlines())
            with self.subTest(part):
                self.refused(2, part, "load", self.put("bad.txt", text + ("" if "incomplete" in text else f"end = {registers}\n")))
        three = self.put("bad.txt", head + "A_SOL = 5\nT_SOLL = x\nT_SOLL = 7\nP_IST = 1\nend = 5\n")
        result = self.call("load", three)
        self.assertEqual(result.returncode, 2)
        self.assertEqual([line.split("bad.txt:")[1].split(":")[0] for line in result.stderr.splitlines()[1:]],
                         ["3", "4", "6"])
        self.assertIn("3 problems, nothing was written", result.stderr)
        self.assertEqual([one["line"] for one in self.reg("load", three, exit_code=2)["problems"]], [3, 4, 6])
        self.refused(2, "bad.txt: no line says 'model", "load", self.put("bad.txt", ""))
        self.refused(2, "--output: its value is empty", "dump", "-o", "")
        self.refused(2, "may be cut short", "load", self.put("bad.txt", head + "A_SOLL = 397"))
        self.refused(2, "cannot be read", "load", self.path("none.txt"))
        self.refused(2, "folder", "load", self.folder.name)
        self.assertEqual(self.value("V_SOLL"), 1600)

    def test_a_file_of_another_axis_is_told_and_the_address_stays(self):
        self.motor()
        text = "model = MAC140\naddress = 4\nMYADDR = 44\nend = 1\n"
        result = subprocess.run([MACREG, "--port", self.endpoint, "load", "-"], input=text, capture_output=True, text=True,
                                check=True)
        self.assertIn("read from a motor with address 4, this one has 8", result.stderr)
        self.assertIn("MYADDR stays 8: load leaves the address alone, standard input has 44", result.stderr)
        self.assertIn("the motor has all else already", result.stdout)
        self.assertEqual(self.value("MYADDR"), 8)

    def test_a_file_that_broke_off_is_compared_as_far_as_it_goes(self):
        self.motor()
        part = self.put("f.part", "model = MAC140\nV_SOLL = raw:1600\nincomplete = lost\n")
        same = self.call("--json", "diff", "--partial", part)
        self.assertEqual(same.returncode, 0, same.stdout)
        self.assertIn("A_SOLL", json.loads(same.stdout)["not_compared"])
        self.reg("set", "V_SOLL", "raw:5")
        result = self.call("diff", "--partial", part)
        self.assertEqual(result.returncode, 1)
        self.assertEqual(len(result.stdout.splitlines()), 2, result.stdout)

    def test_a_motor_that_runs_is_not_changed_under_way(self):
        self.motor()
        self.reg("set", "V_SOLL", "100rpm", "MODE_REG", "V_MODE")
        file = self.put("file.txt", "model = MAC140\nV_SOLL = 7\nend = 1\n")
        self.refused(1, "V_MODE", "load", file)
        self.reg("load", "--stop", file)
        self.assertEqual((self.value("V_SOLL"), self.value("MODE_REG")), (7, 0))

    def test_a_motor_that_vanishes_loses_nothing_already_read(self):
        motor = self.motor("--mactalk-baud", "2400", endpoint="pty:" + self.path("tty"))
        process = self.start("--baud", "2400", "dump", "-o", self.path("file.txt"))
        part = self.path("file.txt.part")
        until(lambda: os.path.exists(part) and "V_SOLL" in self.read("file.txt.part"))
        motor.kill()
        _, error = process.communicate(timeout=LONG)
        self.assertEqual(process.returncode, 3, error)
        self.assertIn("registers were read and are in", error)
        text = self.read("file.txt.part")
        self.assertIn("V_SOLL = 762.94 rpm", text)
        self.assertIn("\nincomplete = ", text)
        self.assertFalse(os.path.exists(self.path("file.txt")))

    def test_a_line_that_breaks_in_a_load_says_what_was_written(self):
        self.motor("--speed", "10")
        self.reg("set", "V_SOLL", "10rpm", "MODE_REG", "V_MODE")
        names = [f"{letter}{number}" for letter, most in (("P", 8), ("V", 8), ("A", 4)) for number in range(1, most + 1)]
        file = self.put("file.txt", "model = MAC140\n" + "".join(f"{name} = raw:77\n" for name in names) + "end = 20\n")
        # Of 9 + 19 bytes a read, some 140 a block: far behind the first write, before the last.
        proxy = NoisyProxy(self.path("breaking"), self.path("port"), 0, 1, breaks_after=2200)
        self.addCleanup(proxy.close)
        answer = self.reg("load", "--stop", file, port="unix:" + self.path("breaking"), exit_code=3)
        for words in ("were written", "may have been written or not", "ran in V_MODE and was stopped",
                      "the flash is as it was"):
            self.assertIn(words, answer["error"])
        self.assertGreater(len(answer["written"]), 0)
        self.assertLess(len(answer["written"]), len(names))
        process = self.running[0]
        process.terminate()
        process.wait(LONG)

    def test_ctrl_c_in_a_recording_tells_of_the_move(self):
        self.motor()
        self.reg("set", "MODE_REG", "P_MODE")
        screen, end = pty.openpty()
        process = subprocess.Popen([MACREG, "--port", self.endpoint, "--yes", "record", "P_IST", "-o", self.path("move.csv"),
                                    "--move", "P_SOLL=+40960"], stdout=subprocess.DEVNULL, stderr=end)
        self.running.append(process)
        text = b""
        while b"read " not in text:
            text += os.read(screen, 1000)
        process.send_signal(signal.SIGINT)
        while b"had been written" not in text:
            text += os.read(screen, 1000)
        self.assertEqual(process.wait(LONG), 130)
        self.assertIn(b"P_SOLL = 40960 counts had been written: THE MOTOR MAY STILL MOVE", text)
        os.close(end)
        os.close(screen)

    def test_ctrl_c_in_a_dump(self):
        self.motor("--mactalk-baud", "2400", endpoint="pty:" + self.path("tty"))
        process = self.start("--baud", "2400", "dump", "-o", self.path("file.txt"))
        until(lambda: os.path.exists(self.path("file.txt.part")) and "V_SOLL" in self.read("file.txt.part"))
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=LONG)
        self.assertEqual(process.returncode, 130)
        self.assertIn("incomplete = interrupted", self.read("file.txt.part"))


class Service(Case):
    def test_flash_keeps_what_was_saved(self):
        process = self.motor("--flash", self.path("flash"))
        self.reg("set", "V_SOLL", "777")
        self.refused(2, "say --yes", "flash", "save")
        self.assertFalse(os.path.exists(self.path("flash")) and "777" in self.read("flash"))
        self.reg("flash", "save", "--yes")
        process.terminate()
        process.wait(LONG)
        self.motor("--flash", self.path("flash"))
        self.assertEqual(self.value("V_SOLL"), 777)
        self.reg("set", "V_SOLL", "5")
        self.reg("reset", "--yes")
        self.assertEqual(self.value("V_SOLL"), 777)
        self.reg("flash", "defaults", "--unsaved", "--yes")
        self.assertEqual(self.value("V_SOLL"), 1600)
        self.reg("flash", "reload", "--yes")
        self.assertEqual(self.value("V_SOLL"), 777)

    def test_a_motor_that_vanishes_in_a_save_is_told_with_what_became_of_the_flash(self):
        self.motor("--speed", "10", "--flash", self.path("flash"))
        proxy = NoisyProxy(self.path("breaking"), self.path("port"), 0, 1, breaks_after=400)
        self.addCleanup(proxy.close)
        answer = self.reg("--yes", "flash", "save", port="unix:" + self.path("breaking"), exit_code=3)
        self.assertIn("the flash was not written", answer["error"])
        self.assertEqual(answer["order"], "not sent")

    def test_prepare_sets_saves_resets_and_checks(self):
        self.motor()
        self.assertFalse(self.reg("prepare").get("changed", True))
        self.reg("set", "CNTRL_BITS", "none")
        self.reg("flash", "save", "--yes")
        self.assertEqual(self.value("CNTRL_BITS") & 3, 0)
        self.reg("prepare", "--yes")
        self.assertEqual(self.value("CNTRL_BITS") & 3, 3)  # 001 3.2.36: USERINTF 11
        self.reg("reset", "--yes")
        self.assertEqual(self.value("CNTRL_BITS") & 3, 3)

    def test_find_tells_motors_apart(self):
        self.motor("--unit", "MAC800:20")
        self.refused(3, "`macreg find`", "--address", "77", "get", "P_IST", patience=50)
        units = self.reg("find", patience=45)["units"]
        self.assertEqual([(one["address"], one["family"]) for one in units], [(8, "MAC50-141"), (20, "MAC800")])
        self.refused(3, "--address", "get", "V_SOLL", patience=20)
        self.refused(3, "several motors that answer at once", "--address", "255", "set", "V_SOLL", "50", patience=20)
        self.assertEqual(self.reg("--address", "20", "get", "V_SOLL")["registers"][0]["raw"], 2771)

    def test_find_where_nobody_is(self):
        self.motor()
        self.running[0].send_signal(signal.SIGSTOP)
        self.refused(3, "nobody answers", "find", patience=20)
        self.running[0].send_signal(signal.SIGCONT)


class Line(Case):
    def test_the_second_program_is_told_who_holds_the_port(self):
        self.motor(endpoint="pty:" + self.path("tty"))
        watcher = self.start("watch", "P_IST")
        watcher.stdout.readline()
        self.refused(3, f"macreg (process {watcher.pid}) holds this port", "get", "P_IST")
        watcher.send_signal(signal.SIGINT)
        watcher.communicate(timeout=LONG)
        self.assertEqual(watcher.returncode, 0)
        self.assertEqual(self.value("V_SOLL"), 1600)

    def test_a_socket_tells_a_busy_program_from_one_that_ended(self):
        for endpoint in ("unix:" + self.path("socket"), "tcp:127.0.0.1:0"):
            motor = self.motor(endpoint=endpoint)
            watcher = self.start("watch", "P_IST")
            watcher.stdout.readline()
            self.refused(3, f"macreg (process {watcher.pid}) is connected", "get", "P_IST")
            motor.kill()
            _, error = watcher.communicate(timeout=LONG)
            self.assertEqual(watcher.returncode, 3)
            self.assertIn("has its program ended?", error)
            self.assertNotIn("another", error)

    def test_watch_ends_with_who_reads_it(self):
        self.motor()
        watcher = self.start("watch", "P_IST")
        watcher.stdout.readline()
        watcher.stdout.close()
        self.assertEqual(watcher.wait(LONG), 0)

    def test_the_terminal_is_left_as_it_was(self):
        self.motor(endpoint="pty:" + self.path("tty"))
        for end in (signal.SIGINT, signal.SIGTERM):
            line = os.open(self.path("tty"), os.O_RDWR | os.O_NOCTTY)
            mode = termios.tcgetattr(line)
            mode[3] |= termios.ECHO
            termios.tcsetattr(line, termios.TCSANOW, mode)
            before = termios.tcgetattr(line)
            watcher = self.start("watch", "P_IST")
            watcher.stdout.readline()
            watcher.send_signal(end)
            watcher.communicate(timeout=LONG)
            self.assertEqual(watcher.returncode, 0)
            self.assertEqual(termios.tcgetattr(line), before)
            os.close(line)

    def test_a_bad_line_costs_time_and_no_value(self):
        self.motor("--speed", "10")
        proxy = NoisyProxy(self.path("noisy"), self.path("port"), 0.002, 5)
        self.addCleanup(proxy.close)
        port = "unix:" + self.path("noisy")
        for value in range(20):
            self.reg("set", "V_SOLL", str(value), port=port, patience=60)
            self.assertEqual(self.value("V_SOLL", port=port, patience=60), value)
            self.assertEqual(self.value("A_SOLL", port=port, patience=60), 160)
        self.assertGreater(proxy.damaged, 0)

    def test_no_port_no_motor_no_sense(self):
        self.motor()
        for exit_code, part, *arguments in (
                (2, "no command", "fly"),
                (2, "--address", "--address", "0", "get", "1"), (2, "--address", "--address", "256", "get", "1"),
                (2, "MAC15", "--model", "MAC15", "get", "1"), (2, "has no register", "get", "FOO"),
                (2, "required", "get"), (2, "a command is missing: save, defaults, reload", "flash"), (3, "asked 10 times", "--address", "77", "get", "1")):
            with self.subTest(arguments):
                self.refused(exit_code, part, *arguments, patience=20)
        self.refused(3, "no such port", "get", "1", port="/dev/ttyNONE")
        for wrong in ("foo:bar", "tcp:nohost:99", "tcp:127.0.0.1:99999"):
            self.refused(2, "write ", "get", "1", port=wrong)
        self.refused(2, "12345 baud", "--baud", "12345", "get", "1", port=self.path("fastmac"))
        self.assertEqual(self.call("--baud", "0", "monitor", "--replay", "-").returncode, 2)
        for baud in ("0", "1", "12345"):
            self.refused(2, f"--baud {baud}", "--baud", baud, "get", "1", port="tcp:127.0.0.1:9")
        alone = subprocess.run([MACREG, "get", "1"], capture_output=True, text=True, check=False,
                               env={key: value for key, value in os.environ.items() if key != "MACREG_PORT"})
        self.assertEqual(alone.returncode, 2)
        self.assertIn("MACREG_PORT", alone.stderr)

    def test_a_full_disk_and_a_closed_pipe(self):
        self.motor()
        self.refused(2, "cannot be written", "dump", "-o", "/none/file")
        with open("/dev/full", "w", encoding="utf-8") as full:
            result = subprocess.run([MACREG, "--port", self.endpoint, "get", "V_SOLL"], stdout=full,
                                    stderr=subprocess.PIPE, check=False)
        self.assertEqual(result.returncode, 2)

    def test_help_completion_and_manual(self):
        for arguments, part in ((["--help"], "why"), (["--version"], "macreg "), (["man"], ".SH COMMANDS"),
                                (["completion", "bash"], "complete -o filenames -F _macreg macreg"),
                                (["completion", "zsh"], "#compdef macreg"), (["list", "V_SOLL"], "Velocity, or limit")):
            result = subprocess.run([MACREG, *arguments], capture_output=True, text=True, check=False)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn(part, result.stdout)
        script = self.put("completion", subprocess.run([MACREG, "completion", "bash"], capture_output=True, text=True,
                                                         check=False).stdout)
        self.assertEqual(subprocess.run(["bash", "-n", script], check=False).returncode, 0)


class Gateway(Case):
    def gateway(self, *arguments):
        table = self.path("shuttle.bin")
        subprocess.run([SEQC, "build", SHUTTLE, "-o", table], check=True)
        self.launch(SIM, "run", table, "--realtime", "--mactalk", self.endpoint, *arguments)

    def test_registers_of_the_motor_behind_a_gateway(self):
        self.gateway()
        self.assertEqual(self.value("T_SOLL"), 1023)
        refused = self.reg("set", "P8", "4711", exit_code=1)
        self.assertIn("sequence runs", refused["reason"])
        refused = self.reg("--yes", "record", "P_IST", "--poll", "--samples", "3", "--move", "P_SOLL=+10", exit_code=1)
        self.assertIn("P_SOLL was not written: the gateway refuses it while its sequence runs", refused["error"])
        found = [one["code"] for one in self.reg("why")["findings"]]
        self.assertIn("gateway_runs", found)
        self.refused(3, "gateway's, not a motor's", "--address", "128", "get", "1")


if __name__ == "__main__":
    MACREG, MACSIM, SIM, SEQC, SHUTTLE = sys.argv[1:6]
    unittest.main(argv=[sys.argv[0], *sys.argv[6:]])
