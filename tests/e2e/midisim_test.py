#!/usr/bin/env python3
"""midisim from the outside: real terminals and sockets, frames as 000 has them.

usage: midisim_test.py PROGRAM
"""

import os
import signal
import socket
import subprocess
import sys
import time
import unittest

import device_case
from device_case import LONG

PROGRAM = ""
DONE = b"\x06\x13\x1A"
REFUSED = b"\x06\x13\x17"
NACK = b"\x15"


def framed(length, fields):
    return b"\x02%03d%s%02X\x03" % (length, fields, sum(fields) & 0xFF)


def request(address, index, data=0, sub_index=0):
    """000 §II: the fields' characters are what the sum is over."""
    return framed(14, b"%02X%02X%02X%08X" % (address, index, sub_index, data % (1 << 32)))


class Case(device_case.Case):
    def start(self, *arguments):
        return self.start_program(PROGRAM, *arguments)

    def client(self, *arguments):
        self.start(*arguments, "--v24", "pty:" + self.path("tty"))
        return self.kept(device_case.Terminal(self.path("tty")))

    def order(self, client, *arguments, expected=DONE):
        self.assertEqual(self.ask(client, request(*arguments), len(expected)), expected, arguments)

    def value(self, client, address, index, sub_index=0):
        answer = self.ask(client, request(address, index, 0, sub_index), 21)
        fields = answer[6:17]
        self.assertEqual(answer, b"\x06\x13" + framed(11, fields) + b"\x1A")
        self.assertEqual(fields[:3], b"%02X%X" % (address, index & 15))
        return int(fields[3:], 16)

    def standing(self, client, address):
        """Waits until it is no longer busy (bit 3 of the third byte of 27h is 1); answers the position."""
        end = time.monotonic() + LONG
        while self.value(client, address, 0x27) & 0x800 == 0:
            self.assertLess(time.monotonic(), end)
        return self.value(client, address, 0x20)


class Line(Case):
    def on_all_endpoints(self):
        process, _ = self.start("--model", "MAC23", "--address", "0", "--v24", "pty:" + self.path("tty"))
        yield process, device_case.Terminal(self.path("tty"))
        process, _ = self.start("--model", "MAC23", "--v24", "unix:" + self.path("socket"))
        yield process, device_case.Socket(socket.AF_UNIX, self.path("socket"))
        process, lines = self.start("--model", "MAC23", "--v24", "tcp:127.0.0.1:0")
        port = int(lines[0].rsplit(":", 1)[1])
        yield process, device_case.Socket(socket.AF_INET, ("127.0.0.1", port))

    def test_the_manuals_example_on_every_endpoint(self):
        for process, client in self.on_all_endpoints():
            # 000 §VI, the example: 300 rpm clockwise.
            self.assertEqual(self.ask(client, b"\x0201400150000000320AB\x03", 3), DONE)
            self.assertGreater(self.value(client, 0, 0x20), 0)
            client.close()
            process.send_signal(signal.SIGTERM)
            self.assertEqual(process.wait(LONG), 0)
        self.assertFalse(os.path.lexists(self.path("tty")))
        self.assertFalse(os.path.lexists(self.path("socket")))

    def test_a_module_moves_and_refuses(self):
        client = self.client("--speed", "10")
        self.order(client, 0, 0x13, 20000)
        self.order(client, 0, 0x13, 5, expected=REFUSED)
        self.assertEqual(self.standing(client, 0), 20000)
        self.order(client, 0, 0x14)
        self.assertEqual(self.standing(client, 0), 0)
        self.order(client, 0, 0x05, expected=REFUSED)
        self.assertEqual(self.ask(client, request(0, 0x18)[:-3] + b"00\x03", 1), NACK)
        self.assertEqual(self.value(client, 0, 0x28, 0xAF) >> 24, 0x80)

    def test_stray_characters(self):
        client = self.client()
        for stray in (b"\x00", b"\r\n", b"\x02", b"\x02014", b"\x02" * 5, os.urandom(40), request(7, 0x13, 5),
                      request(0, 0x20)[:-1]):
            client.send(stray)
            client.receive(0.05)  # what noise may be answered with
            self.assertEqual(self.value(client, 0, 0x24), 0x704, stray)

    def test_several_modules_on_one_line(self):
        client = self.client("--model", "MAC34-1", "--unit", "MAC34-2:1", "--unit", "MAC23:2", "--speed", "10")
        for address in (0, 1, 2):
            self.order(client, address, 0x09, 1000 + address)
        for address in (0, 1, 2):
            self.assertEqual(self.value(client, address, 0x22), 1000 + address)
        self.order(client, 0xFF, 0x13, 3000)  # general: 00 answers for all
        for address in (0, 1, 2):
            self.assertEqual(self.standing(client, address), 3000)
        # 10h to each, then one 11h to all.
        for address in (0, 1):
            self.order(client, address, 0x10)
            self.order(client, address, 0x13, 6000)
        self.assertEqual(self.value(client, 1, 0x20), 3000)
        self.order(client, 0xFF, 0x11)
        for address in (0, 1):
            self.assertEqual(self.standing(client, address), 6000)
        self.assertEqual(self.value(client, 2, 0x20), 3000)

    def awake(self, client):
        """Repeats the request until it is answered; returns the first complete answer."""
        end = time.monotonic() + LONG
        answer = b""
        while len(answer) < 21 and time.monotonic() < end:
            if not answer:
                client.send(request(0, 0x24))
            answer += client.receive(0.1)
        return answer[:21]

    def test_after_a_reset_it_is_heard_again(self):
        client = self.client("--speed", "20")
        self.order(client, 0, 0x00)
        self.assertEqual(self.awake(client), b"\x06\x13" + framed(11, b"00400000704") + b"\x1A")

    def test_a_client_that_changes_its_rate_with_the_module(self):
        client = self.client("--speed", "20", "--eeprom", self.path("eeprom"))
        self.order(client, 0, 0x1B, 1)
        self.assertEqual(self.awake(client), b"\x06\x13" + framed(11, b"00400000704") + b"\x1A")
        with open(self.path("eeprom"), encoding="ascii") as file:
            self.assertIn("baud_code = 1\n", file.read())


class Bench(Case):
    def test_what_happens_to_a_module_is_said_while_a_client_talks_to_it(self):
        """Query 27h: status; 003: the security input holds the module in reset, so there is no answer."""
        client = self.client("--address", "1", "--control", "unix:" + self.path("bench"))
        bench = self.kept(device_case.Socket(socket.AF_UNIX, self.path("bench")))
        self.assertEqual(self.said(bench, "motor security on"), "ok")
        client.send(request(1, 0x27))
        self.assertIn("deaf", self.said(bench, "status"))
        self.assertEqual(client.receive(0.05), b"")
        self.assertEqual(self.said(bench, "motor security off"), "ok")
        end = time.monotonic() + LONG
        while "deaf" in self.said(bench, "status"):
            self.assertLess(time.monotonic(), end)
        self.value(client, 1, 0x27)
        self.assertIn("motor analogue", self.said(bench, "motor flies"))
        self.assertEqual(self.said(bench, "motor pulses 5 per s")[:30], "error: a MAC34-1 has no pulse ")

    def test_a_load_turns_a_shaft_without_power(self):
        """003: below the motor's torque a load only has to be overcome; above it, it drags the shaft."""
        self.client("--control", "unix:" + self.path("bench"))
        bench = self.kept(device_case.Socket(socket.AF_UNIX, self.path("bench")))
        self.assertIn(" P 0 ", self.said(bench, "status"))
        self.assertEqual(self.said(bench, "motor load 1100"), "ok")
        end = time.monotonic() + LONG
        while " P 0 " in self.said(bench, "status"):
            self.assertLess(time.monotonic(), end)


class Memory(Case):
    def test_parameters_and_position_are_kept(self):
        arguments = ("--model", "MAC34-2", "--eeprom", self.path("eeprom"), "--speed", "10")
        client = self.client(*arguments)
        self.order(client, 0, 0x1C, 7)
        self.order(client, 0, 0x08, 5)
        self.order(client, 5, 0x13, -12345)
        end = time.monotonic() + LONG
        while self.value(client, 5, 0x20) != (1 << 32) - 12345:
            self.assertLess(time.monotonic(), end)
        end = time.monotonic() + LONG
        while True:
            with open(self.path("eeprom"), encoding="ascii") as file:
                text = file.read()
            if "position = -12345\n" in text:
                break
            self.assertLess(time.monotonic(), end, text)
        self.assertIn("# EEPROM of a virtual MAC34-2\n", text)
        self.assertIn("address = 5\n", text)
        self.assertIn("tolerance = 7\n", text)
        self.running[-1].kill()
        self.running[-1].wait(LONG)
        again = self.client(*arguments)
        self.assertEqual(self.value(again, 5, 0x20), (1 << 32) - 12345)
        self.assertEqual(self.value(again, 5, 0x26) & 0xFF, 7)
        # In mid-move it keeps the place on SIGTERM.
        self.order(again, 5, 0x15, 480)
        end = time.monotonic() + LONG
        while self.value(again, 5, 0x20) == (1 << 32) - 12345:
            self.assertLess(time.monotonic(), end)
        self.running[-1].send_signal(signal.SIGTERM)
        self.assertEqual(self.running[-1].wait(LONG), 0)
        with open(self.path("eeprom"), encoding="ascii") as file:
            self.assertNotIn("position = -12345\n", file.read())


class Mistakes(Case):
    def refused(self, *arguments, says):
        self.refused_by(PROGRAM, *arguments, says=says)

    def test_of_the_command_line(self):
        end = ("--v24", "pty:" + self.path("x"))
        self.refused(says="--v24 EP")
        self.refused("--model", "MAC140", *end, says="MAC34-2")
        self.refused("--address", "128", *end, says="0 to 127")
        self.refused("--address", "x", *end, says="whole number")
        self.refused("--unit", "MAC23", *end, says="MODEL:ADDRESS")
        self.refused("--unit", "MAC23:0", *end, says="address 0")
        self.refused("--speed", "0", *end, says="0.01 to 100")
        self.refused("--baud", "300", *end, says="9600, 19200 or 38400")
        self.refused("--wrong", *end, says="--wrong")
        self.refused("--v24", "nowhere", says="nowhere")
        self.refused("--can", "can0", *end, says="not both")
        self.refused("--can", "can0", "--baud", "9600", says="--v24")
        self.refused("--can", "can0", "--model", "MAC23", says="MAC34-1")
        for wrong in ("0", "128"):
            self.refused("--can", "can0", "--address", wrong, says="1 to 127")
            self.refused("--unit", "MAC34-1:" + wrong, "--can", "can0", says="1 to 127")
        self.refused("--can", "nocan77", says="nocan77")
        self.assertEqual(os.listdir(self.folder.name), [])

    def test_of_files(self):
        end = ("--v24", "pty:" + self.path("x"))
        for line in ("position = many", "positron = 5", "tolerance = 256", "stops = -1", "stops = 5"):
            with open(self.path("eeprom"), "w", encoding="ascii") as file:
                file.write("# EEPROM of a virtual MAC34-1\n" + line + "\n")
            self.refused("--eeprom", self.path("eeprom"), *end, says="eeprom:2")
        self.refused("--model", "MAC23", "--eeprom", self.path("eeprom"), *end, says="MAC23")
        self.refused("--eeprom", self.path("none/eeprom"), *end, says="none/eeprom")

    def test_help_is_there(self):
        done = subprocess.run([PROGRAM, "--help"], capture_output=True, timeout=LONG, check=False, text=True)
        self.assertEqual(done.returncode, 0)
        for word in ("--model", "--v24", "--eeprom", "pty:PATH", "ready", "Exit code"):
            self.assertIn(word, done.stdout)


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main(verbosity=2)
