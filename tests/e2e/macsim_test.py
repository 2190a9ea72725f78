#!/usr/bin/env python3
"""macsim from the outside: real terminals and sockets, bytes as clients in the field send them.

usage: macsim_test.py PROGRAM
"""

import os
import signal
import socket
import subprocess
import sys
import time
import unittest

import device_case
import simulator
from device_case import LONG

PROGRAM = ""
ACCEPT = bytes.fromhex("111111")


def protected(*values):
    return b"".join(bytes([value, value ^ 0xFF]) for value in values)


def read_request(address, register):
    return b"\x50" * 3 + protected(address, register) + b"\xAA\xAA"


def write_request(address, register, value, length):
    data = (value % (1 << 8 * length)).to_bytes(length, "little")
    return b"\x52" * 3 + protected(address, register, length, *data) + b"\xAA\xAA"


def command(kind, address):
    return bytes([kind] * 3) + protected(address) + b"\xAA\xAA"


def value_in(answer):
    """The value in the answer to a read, after a look at all of its bytes."""
    assert len(answer) == 19, answer.hex(" ")
    assert answer[:5] == b"\x52\x52\x52\x00\xFF" and answer[-2:] == b"\xAA\xAA", answer.hex(" ")
    assert all(answer[i] ^ answer[i + 1] == 0xFF for i in range(5, 17, 2)), answer.hex(" ")
    return int.from_bytes(answer[9:17:2], "little")


class Case(device_case.Case):
    def start(self, *arguments):
        return self.start_program(PROGRAM, *arguments)


class Scenarios(Case):
    def test_pulses_reach_a_motor_without_fastmac(self):
        scenario = self.path("s.scn")
        with open(scenario, "w", encoding="ascii") as file:
            file.write("motor pulses 52083 per s\n")
        self.start("--address", "8", "--mactalk", "pty:" + self.path("tty"), "--scenario", scenario)
        client = device_case.Terminal(self.path("tty"))
        self.kept(client)
        self.assertEqual(self.ask(client, write_request(8, 2, 3, 2), 3), ACCEPT)  # MODE_REG := 3, Gear Position
        v_ext = value_in(self.ask(client, read_request(8, 120), 19)) & 0xFFFF  # 52,083 / 520.83
        self.assertAlmostEqual(v_ext, 100, delta=1)

    def test_what_a_scenario_cannot_be(self):
        for text, said in (("motor pulses 1 per s", "s.scn:1:7: a MAC140 has FastMAC on the pins"),
                           ("motor error\nIN0 := 1", "s.scn:2:1: here is the motor alone"),
                           ("expect P_IST > 0", "s.scn:1:1: expectations are not checked here")):
            with open(self.path("s.scn"), "w", encoding="ascii") as file:
                file.write(text)
            self.refused_by(PROGRAM, "--fastmac", "unix:" + self.path("f"), "--scenario", self.path("s.scn"), says=said)
        self.refused_by(PROGRAM, "--fastmac", "unix:" + self.path("f"), "--scenario", self.path("no.scn"), says="no.scn: cannot be opened")


class Bench(Case):
    """Events of the motor are reported at a separate port, while a client talks to the motor."""

    def bench(self, *arguments):
        self.start("--address", "8", "--mactalk", "pty:" + self.path("tty"), "--control", "unix:" + self.path("bench"), *arguments)
        return self.kept(device_case.Terminal(self.path("tty"))), self.controller()

    def controller(self):
        return self.kept(device_case.Socket(socket.AF_UNIX, self.path("bench")))

    def value(self, client, register, bits=16):
        value = value_in(self.ask(client, read_request(8, register), 19)) & ((1 << bits) - 1)
        return value - (1 << bits) if value >> (bits - 1) else value

    def until(self, client, register, wanted, bits=16):
        end = time.monotonic() + LONG
        value = self.value(client, register, bits)
        while not wanted(value):
            self.assertLess(time.monotonic(), end, value)
            value = self.value(client, register, bits)
        return value

    def write(self, client, register, value, length=2):
        self.assertEqual(self.ask(client, write_request(8, register, value, length), 3), ACCEPT)

    def test_homing_against_a_stop(self):
        """001 section 4.4.15: V_HOME 40, T_HOME 41, HOME_MODE 12 in MODE_REG; where the torque is exceeded P_IST becomes 0."""
        client, bench = self.bench("--speed", "10")
        self.write(client, 37, 2)  # STARTMODE: position mode afterwards
        self.write(client, 40, -200)
        self.write(client, 41, 300)
        self.write(client, 2, 12)
        self.until(client, 10, lambda place: place < -4096, 32)  # a revolution, and no end of it yet
        self.assertEqual(self.said(bench, "motor stop below -2 rev"), "ok")
        self.until(client, 2, lambda mode: mode == 2)
        self.assertLess(abs(self.until(client, 10, lambda place: abs(place) < 400, 32)), 400)
        self.assertEqual(self.said(bench, "motor stop none"), "ok")

    def test_undervoltage(self):
        """U_SUPPLY is 151, 1 V is 18.622."""
        client, bench = self.bench()
        before = self.value(client, 151)
        self.assertEqual(self.said(bench, "motor supply 10 V"), "ok")
        self.assertAlmostEqual(self.until(client, 151, lambda value: value != before), 186, delta=2)

    def test_without_supply_nobody_answers(self):
        client, bench = self.bench()
        self.assertEqual(self.said(bench, "motor power off"), "ok")
        client.send(read_request(8, 5))
        self.assertEqual(self.said(bench, "status")[:11], "MAC140 @8 m")
        self.assertEqual(client.receive(0.05), b"")
        self.assertEqual(self.said(bench, "motor power on"), "ok")
        self.value(client, 5)

    def test_gear_with_pulses(self):
        """CNTRL_BITS is 36; USERINTF in its bits 1 and 0 is 0 for the pulse input, taken over at a start: 54h, 56h."""
        client, bench = self.bench()
        self.write(client, 36, self.value(client, 36) & ~3)
        self.assertEqual(self.ask(client, command(0x54, 8), 3), ACCEPT)
        client.send(command(0x56, 8))
        self.until(client, 2, lambda mode: mode == 0)
        self.assertTrue(self.said(bench, "motor pulses 52083 per s").startswith("ok, but nothing follows: the shaft does not follow in INIT"))
        self.write(client, 2, 3)
        self.assertAlmostEqual(self.until(client, 120, lambda pulses: pulses != 0), 100, delta=1)

    def test_what_is_no_line_for_it(self):
        _, bench = self.bench()
        other = self.controller()
        for line, said in (("motor flies", "error: "), ("IN0 := 1", "error: here is the motor alone"),
                           ("at 2 s motor load 1", "error: "), ("motor load 1 Nm", "error: "), ("motor brake 5", "error: a MAC140 has no output"),
                           ("when P_IST > 5 motor load 1", "error: "), ("x" * 2000, "error: a line has 1000 characters at the most")):
            self.assertEqual(self.said(bench, line)[:len(said)], said, line)
        self.assertEqual(self.said(other, "motor load 1, after 20 ms motor load 0 # two of them"), "ok")
        self.assertIn("motor load 500", self.said(other, "help"))
        bench.send(b"motor lo")
        bench.close()
        self.clients.remove(bench)
        self.assertEqual(self.said(self.controller(), "motor load 0"), "ok", "half a line of one who left is nobody's")

    def test_on_standard_input(self):
        with open(self.path("lines"), "w", encoding="ascii") as file:
            file.write("motor load 5\n\nmotor flies\nmotor load 0")
        with open(self.path("lines"), encoding="ascii") as lines:
            process = subprocess.Popen([PROGRAM, "--mactalk", "unix:" + self.path("m"), "--control", "-"], stdin=lines,
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.running.append(process)
        simulator.until_ready(process)
        self.assertEqual(process.stdout.readline(), "ok\n")
        self.assertIn("error: ", process.stdout.readline())
        self.assertEqual(process.stdout.readline(), "ok\n")
        client = self.kept(device_case.Socket(socket.AF_UNIX, self.path("m")))
        value_in(self.ask(client, read_request(1, 5), 19))  # it serves on

    def test_a_name_in_use_is_refused(self):
        self.bench()
        for option in ("--mactalk", "--control"):
            name = {"--mactalk": "pty:" + self.path("tty"), "--control": "unix:" + self.path("bench")}[option]
            more = [] if option == "--mactalk" else ["--mactalk", "pty:" + self.path("other")]
            self.refused_by(PROGRAM, option, name, *more, says="macsim")


class MacTalk(Case):
    def on_all_endpoints(self):
        process, _ = self.start("--model", "MAC140", "--address", "8", "--mactalk", "pty:" + self.path("tty"))
        yield process, device_case.Terminal(self.path("tty"))
        process, _ = self.start("--address", "8", "--mactalk", "unix:" + self.path("socket"))
        yield process, device_case.Socket(socket.AF_UNIX, self.path("socket"))
        process, lines = self.start("--address", "8", "--mactalk", "tcp:127.0.0.1:0")
        port = int(lines[0].rsplit(":", 1)[1])
        yield process, device_case.Socket(socket.AF_INET, ("127.0.0.1", port))

    def test_the_quick_guides_examples_on_every_endpoint(self):
        for process, client in self.on_all_endpoints():
            self.assertEqual(self.ask(client, bytes.fromhex("52525208F705FA02FD58A702FDAAAA"), 3), ACCEPT)
            answer = self.ask(client, bytes.fromhex("50505008F705FAAAAA"), 19)
            self.assertEqual(answer[:13], bytes.fromhex("52525200FF05FA04FB58A702FD"))
            client.close()
            process.send_signal(signal.SIGTERM)
            self.assertEqual(process.wait(LONG), 0)
        self.assertFalse(os.path.lexists(self.path("tty")))
        self.assertFalse(os.path.lexists(self.path("socket")))

    def client(self, *arguments):
        self.start(*arguments, "--mactalk", "pty:" + self.path("tty"))
        return self.kept(device_case.Terminal(self.path("tty")))

    def test_shapes_that_clients_send(self):
        client = self.client("--address", "254")
        # Exact and 4-byte writes; addresses 254 and 255.
        self.assertEqual(self.ask(client, write_request(254, 5, 600, 2), 3), ACCEPT)
        self.assertEqual(self.ask(client, write_request(255, 5, -600, 2), 3), ACCEPT)
        self.assertEqual(value_in(self.ask(client, read_request(255, 5), 19)) & 0xFFFF, 0x10000 - 600)
        self.assertEqual(self.ask(client, write_request(254, 5, 40 << 16 | 1000, 4), 3), ACCEPT)
        self.assertEqual(value_in(self.ask(client, read_request(254, 5), 19)), 40 << 16 | 1000)
        # A read right behind a write.
        answer = self.ask(client, write_request(254, 49, -5000, 4) + read_request(254, 49), 22)
        self.assertEqual(answer[:3], ACCEPT)
        self.assertEqual(value_in(answer[3:]), (1 << 32) - 5000)
        # Stray characters, a wrong length, the misprint, other units' messages: the next thing heard is the answer to the
        # message after them.
        for stray in (b"\x00", b"\r\n", b"\x50\x50", b"\x52" * 5, b"\x11" * 3, os.urandom(40)[:39] + b"\x00",
                      bytes.fromhex("525252FE0105FA07F801FE00FFAAAA"), bytes.fromhex("505050FE0105F6AAAA"),
                      read_request(7, 5), write_request(7, 5, 1, 2)):
            client.send(stray)
            self.assertEqual(value_in(self.ask(client, read_request(254, 5), 19)), 40 << 16 | 1000, stray)

    def test_several_motors_on_one_line(self):
        client = self.client("--model", "MAC140", "--address", "8", "--unit", "MAC95:9", "--unit", "MAC800:10")
        for address, value, length in ((8, 111, 2), (9, 222, 2), (10, 333, 4)):
            self.assertEqual(self.ask(client, write_request(address, 65, value, length), 3), ACCEPT)
        for address, value in ((8, 111), (9, 222), (10, 333)):
            self.assertEqual(value_in(self.ask(client, read_request(address, 65), 19)) & 0xFFFF, value)

    def test_a_motor_moves(self):
        client = self.client("--address", "8", "--speed", "20")
        for register, value, length in ((5, 3000, 2), (3, 40960, 4), (2, 2, 2)):
            self.assertEqual(self.ask(client, write_request(8, register, value, length), 3), ACCEPT)
        end = time.monotonic() + LONG
        position = 0
        while position != 40960 and time.monotonic() < end:
            position = value_in(self.ask(client, read_request(8, 10), 19))
        self.assertEqual(position, 40960)
        self.assertTrue(value_in(self.ask(client, read_request(8, 35), 19)) & 0x10, "in position")

    def test_safe_mode_flash_and_reset(self):
        client = self.client("--address", "8", "--flash", self.path("flash"))
        self.ask(client, write_request(8, 65, 777, 2), 3)
        self.assertEqual(self.ask(client, command(0x54, 8), 3), ACCEPT)
        client.send(command(0x56, 8))
        self.assertEqual(value_in(self.ask(client, read_request(8, 2), 19)) & 0xFFFF, 0)
        with open(self.path("flash"), encoding="ascii") as file:
            self.assertIn("65 = 777\n", file.read())
        self.running[-1].kill()
        self.running[-1].wait(LONG)
        again = self.client("--address", "8", "--flash", self.path("flash"))
        self.assertEqual(value_in(self.ask(again, read_request(8, 65), 19)) & 0xFFFF, 777)

    def test_the_sample_buffer(self):
        client = self.client("--address", "8", "--speed", "50")
        self.ask(client, write_request(8, 112, 34, 2), 3)  # INPOSCNT, whose value does not change
        count = value_in(self.ask(client, read_request(8, 34), 19)) & 0xFFFF
        self.ask(client, write_request(8, 36, 3 | 0xC0, 2), 3)
        end = time.monotonic() + LONG
        while value_in(self.ask(client, read_request(8, 116), 19)) & 0xFFFF != 895:
            self.assertLess(time.monotonic(), end)
        self.ask(client, write_request(8, 36, 3 | 0x80, 2), 3)
        for _ in range(895):
            answer = self.ask(client, command(0x53, 8), 25)
            self.assertEqual(answer[:7], bytes.fromhex("52525200FF08F7"))
            self.assertEqual(answer[7], count)
        self.assertEqual(value_in(self.ask(client, read_request(8, 116), 19)) & 0xFFFF, 895)


class FastMac(Case):
    def test_status_bytes_come_without_pause_and_a_command_is_taken(self):
        self.start("--model", "MAC140", "--fastmac", "pty:" + self.path("tty"), "--mactalk",
                   "unix:" + self.path("socket"))
        motor = self.kept(device_case.Terminal(self.path("tty")))
        client = self.kept(device_case.Socket(socket.AF_UNIX, self.path("socket")))
        self.assertNotEqual(motor.receive(LONG), b"")
        self.ask(client, write_request(1, 66, 2500, 2), 3)
        motor.send(b"\xA9")  # toggle 1, velocity mode, V2 (001 §5.2.1.4: 01 01 001)
        end = time.monotonic() + LONG
        while value_in(self.ask(client, read_request(1, 5), 19)) & 0xFFFF != 2500:
            self.assertLess(time.monotonic(), end)
        while motor.receive(LONG)[-1] & 0x80 == 0:
            self.assertLess(time.monotonic(), end, "the toggle is not echoed")


class Mistakes(Case):
    def refused(self, *arguments, says):
        self.refused_by(PROGRAM, *arguments, says=says)

    def test_of_the_command_line(self):
        end = ("--mactalk", "pty:" + self.path("x"))
        self.refused(says="--fastmac EP")
        self.refused("--model", "MAC145", *end, says="MAC145")
        self.refused("--address", "0", *end, says="1 to 254")
        self.refused("--address", "255", *end, says="1 to 254")
        self.refused("--address", "x", *end, says="whole number")
        self.refused("--unit", "MAC95", *end, says="MODEL:ADDRESS")
        self.refused("--unit", "MAC95:1", *end, says="address 1")
        self.refused("--speed", "0", *end, says="0.01 to 100")
        self.refused("--baud", "5", *end, says="300 to")
        self.refused("--wrong", *end, says="--wrong")
        self.refused("--mactalk", "nowhere", says="nowhere")
        self.refused("--mactalk", "pty:" + self.path("no/such"), says="no/such")
        self.assertEqual(os.listdir(self.folder.name), [])

    def test_of_files(self):
        with open(self.path("flash"), "w", encoding="ascii") as file:
            file.write("# parameter flash of a virtual MAC140\n65 = many\n")
        self.refused("--flash", self.path("flash"), "--mactalk", "pty:" + self.path("x"), says="flash:2")
        self.refused("--flash", self.path("none/flash"), "--mactalk", "pty:" + self.path("x"), says="none/flash")
        self.refused("--model", "MAC800", "--flash", self.path("flash"), "--mactalk", "pty:" + self.path("x"),
                     says="MAC800")
        first, _ = self.start("--mactalk", "unix:" + self.path("socket"))
        self.refused("--mactalk", "unix:" + self.path("socket"), says=f"macsim (process {first.pid}) already serves there")

    def test_help_is_there(self):
        done = subprocess.run([PROGRAM, "--help"], capture_output=True, timeout=LONG, check=False, text=True)
        self.assertEqual(done.returncode, 0)
        for word in ("--model", "--fastmac", "--mactalk", "pty:PATH", "ready", "Exit code"):
            self.assertIn(word, done.stdout)


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main(verbosity=2)
