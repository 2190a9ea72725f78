#!/usr/bin/env python3
"""nanoplc with MIDI drives: virtual modules on V24 terminals, and the valid configurations.

usage: nanoplc_midi_test.py NANOPLC MACSIM NANOCTL MACREG SEQC MENDING.seq MIDISIM
"""

import os
import re
import subprocess
import sys
import unittest

import service_case
import shared_line
import simulator
from service_case import LONG, ServiceCase

MIDISIM = ""
INCREMENTS = 10000  # a revolution of a MAC34


class Case(ServiceCase):
    PATIENCE = "poll_limit = 1000000\n"

    def plug_in(self, name="motor", model="MAC34-1", address="0"):
        process, _ = simulator.start(MIDISIM, "--model", model, "--address", address, "--v24", "pty:" + self.path(name),
                                     "--eeprom", self.path(name + ".eeprom"))
        self.motors[name] = process

    def axis(self, name="x", motor="motor", port=None, table="none", more=""):
        text = super().axis(name, motor, port, table, more)
        return text.replace("[axis.motor]\n", '[axis.motor]\nkind = "mac34-1"\n')

    def position(self, name="motor"):
        """As the module keeps it without power; written when a motion ends."""
        with open(self.path(name + ".eeprom"), encoding="utf-8") as file:
            return int(re.search(r"(?m)^position = (-?\d+)$", file.read())[1])


class Running(Case):
    def test_a_sequence_drives_a_module(self):
        self.plug_in()
        service = self.start(self.write(self.axis(table=self.table)), "the motor answers on address 0 on")
        self.until_status(lambda status: status["state"] == "running")
        self.moves()
        # Place is 2048 counts, half a revolution.
        self.until(lambda: self.position() == INCREMENTS // 2, service)
        self.until(lambda: self.position() == 0, service)
        self.assertEqual(self.end(service), 0, service.said())
        self.assertNotIn("may be moving", service.said())

    def test_a_module_that_falls_silent_and_comes_back(self):
        self.plug_in()
        service = self.start(self.write(self.axis(table=self.table)))
        self.moves()
        self.pull_out()
        self.until(lambda: "SAFE: the motor does not answer" in service.said(), service)
        self.plug_in()
        self.until(lambda: "the link is up and acknowledged" in service.said(), service)
        self.moves()

    def test_a_module_at_another_address_is_told_of(self):
        self.plug_in(address="5")
        service = self.start(self.write(self.axis(table=self.table)))
        self.until(lambda: "x: no motor has answered yet on address 0 on" in service.said(), service)
        self.assertEqual(self.ctl("status")["state"], "waiting for the motor")
        self.assertEqual(self.end(service), 0)
        self.assertEqual(service.said().count("no motor has answered"), 1)

    def test_a_fault_of_the_drive_is_told_in_words(self):
        with open(self.path("motor.eeprom"), "w", encoding="utf-8") as file:
            file.write("# EEPROM of a virtual MAC34-1\nupper_stop = 3000\nstops = 8\n")  # on the way to 5000
        self.plug_in()
        service = self.start(self.write(self.axis(table=self.table)))
        self.until(lambda: "x: ERROR: an end-stop ended" in service.said(), service)
        self.assertRegex(service.said(), r"x: ERROR: an end-stop [^\n]*\([^)]*upper[^)]*\)")

    def test_a_table_that_the_drive_cannot_do_is_refused(self):
        self.plug_in()
        with open(self.path("home.seq"), "w", encoding="utf-8") as file:
            file.write("PROGRAM P\nMOTOR MAC140;\nSTEP S: OWN ERROR; IF IN0 THEN HOME; NEXT := T; END_IF END_STEP\n"
                       "STEP T: OWN ERROR; IF IN1 THEN NEXT := S; END_IF END_STEP\nEND_PROGRAM\n")
        subprocess.run([service_case.SEQC, "build", self.path("home.seq"), "--quiet", "-o", self.path("home.bin")], check=True)
        service = self.start(self.write(self.axis(table=self.path("home.bin"))))
        status = self.ctl("status")
        self.assertEqual((status["state"], status["safe_reason"]), ("stopped", "bad table"))
        self.assertRegex(service.said(), r"home.bin: term \d+: the motor does not have an order of the table; upload another")
        self.assertEqual(self.end(service), 0)


class TwoAtOneAddress(Case):
    """Two modules on one line, real processes and a real terminal."""

    # Answers that collide indicate a second drive, too.
    TOLD = (r"x: ERROR: more than one MIDI drive answers to this address[^\n]*macreg midi address set|"
            r"x: ERROR: each answer of the MIDI drive came damaged[^\n]*a second drive at its address")

    def setUp(self):
        super().setUp()
        self.line = shared_line.SharedLine(self.path("motor"))
        self.addCleanup(self.line.close)

    def plug_in(self, name="a", model="MAC34-1", address="0"):
        process, _ = simulator.start(MIDISIM, "--model", model, "--address", address, "--v24", "unix:" + self.path(name),
                                     "--eeprom", self.path(name + ".eeprom"))
        self.motors[name] = process
        self.line.join(self.path(name))

    def has_moved(self, name):
        return os.path.exists(self.path(name + ".eeprom")) and self.position(name) != 0

    def test_nothing_moves_when_both_are_there_at_the_start(self):
        self.plug_in("a")
        self.plug_in("b")
        service = self.start(self.write(self.axis(table=self.table)))
        self.until(lambda: re.search(self.TOLD, service.said()), service)
        self.until(lambda: "no link to the motor on address 0" in service.said(), service)
        self.assertFalse(self.has_moved("a") or self.has_moved("b"))
        self.pull_out("b")
        self.until(lambda: "the motor answers on address 0" in service.said(), service)

    def test_one_that_joins_stops_the_run(self):
        self.plug_in("a")
        service = self.start(self.write(self.axis(table=self.table)))
        self.moves()
        self.plug_in("b")
        self.until(lambda: re.search(self.TOLD, service.said()), service)
        self.until(lambda: "SAFE: " in service.said(), service)


class Refusing(Case):
    def mistakes(self, motor, more=""):
        code, lines = self.check(f'[[axis]]\nname = "x"\n[axis.motor]\n{motor}\n{more}', "--no-devices")
        self.assertEqual(code, 2 if lines else 0, lines)
        return lines

    def one(self, key, text, motor, more=""):
        lines = self.mistakes(motor, more)
        self.assertEqual(len(lines), 1, lines)
        self.assertRegex(lines[0], rf"^\d+: axis\[x\]\.{re.escape(key)}: ")
        self.assertIn(text, lines[0])

    def test_what_is_right(self):
        for motor in ('kind = "mac34-1"\nport = "/dev/ttyUSB0"', 'kind = "mac34-2"\ncan = "can0"\naddress = 127\nbitrate = 500000',
                      'kind = "mac23"\nport = "/dev/ttyUSB0"\naddress = 0\nbaud = 9600', 'kind = "jvl"\nport = "/dev/ttyUSB0"'):
            self.assertEqual(self.mistakes(motor), [])

    def test_each_mistake_of_a_midi_drive_is_named(self):
        self.one("motor.kind", 'write one of "jvl", "mac23", "mac34-1", "mac34-2"', 'kind = "mac34"\nport = "/dev/ttyS0"')
        self.one("motor.can", "a MAC23 has no CAN", 'kind = "mac23"\ncan = "can0"')
        self.one("motor.can", "leave one of them out", 'kind = "mac34-1"\ncan = "can0"\nport = "/dev/ttyS0"')
        self.one("motor.port", 'or its bus: can = "can0"', 'kind = "mac34-1"')
        self.one("motor.can", "no interface", 'kind = "mac34-1"\ncan = "/dev/can0"')
        self.one("motor.address", "128 is out of range; write a whole number from 0 to 127",
                 'kind = "mac34-1"\nport = "/dev/ttyS0"\naddress = 128')
        self.one("motor.address", "0 is out of range; write a whole number from 1 to 127",
                 'kind = "mac34-1"\ncan = "can0"\naddress = 0')
        self.one("motor.baud", "write 9600, 19200 or 38400", 'kind = "mac34-1"\nport = "/dev/ttyS0"\nbaud = 10000')
        self.one("motor.baud", "the rate of a bus is bitrate", 'kind = "mac34-1"\ncan = "can0"\nbaud = 9600')
        self.one("motor.bitrate", "the speed of a V24 line is baud", 'kind = "mac34-1"\nport = "/dev/ttyS0"\nbitrate = 125000')
        self.one("motor.rs485", "for a JVL motor", 'kind = "mac34-1"\nport = "/dev/ttyS0"\nrs485 = "rts_on_send"')
        self.one("motor.mactalk_port", "for a JVL motor", 'kind = "mac34-1"\nport = "/dev/ttyS0"\nmactalk_port = "/dev/ttyS1"')
        self.one("settings.motor_baud", "for a JVL motor", 'kind = "mac34-1"\nport = "/dev/ttyS0"',
                 "[axis.settings]\nmotor_baud = 38400\n")
        self.one("motor.can", "for a MIDI drive", 'port = "/dev/ttyS0"\ncan = "can0"')
        self.one("motor.address", "for a MIDI drive", 'kind = "jvl"\nport = "/dev/ttyS0"\naddress = 2')

    def test_two_axes_on_one_line(self):
        def axis(name, motor):
            return f'[[axis]]\nname = "{name}"\n[axis.motor]\n{motor}\n'

        on_bus = 'kind = "mac34-1"\ncan = "can0"\naddress = {}'
        self.assertEqual(self.check(axis("x", on_bus.format(1)) + axis("y", on_bus.format(2)), "--no-devices"), (0, []))
        code, lines = self.check(axis("x", on_bus.format(3)) + axis("y", on_bus.format(3)), "--no-devices")
        self.assertEqual((code, len(lines)), (2, 1), lines)
        self.assertIn("12: axis[y].motor.address: address 3 on can0 is used twice: axis[x].motor.address in line 6 has it already",
                      lines[0])
        code, lines = self.check(axis("x", on_bus.format(1)) + axis("y", 'kind = "mac34-2"\ncan = "can0"'), "--no-devices")
        self.assertEqual((code, len(lines)), (2, 1), lines)
        self.assertIn("address 1 on can0 is used twice", lines[0])
        serial = 'kind = "mac34-1"\nport = "/dev/ttyS7"\naddress = {}'
        code, lines = self.check(axis("x", serial.format(0)) + axis("y", serial.format(1)), "--no-devices")
        self.assertEqual((code, len(lines)), (2, 1), lines)
        self.assertIn("axis[y].motor.port: /dev/ttyS7 is used twice", lines[0])
        self.assertIn("a motor's serial line is its axis's alone (a CAN bus can be shared)", lines[0])

    def test_an_interface_that_is_not_there_or_no_bus(self):
        head = '[[axis]]\nname = "x"\n[axis.motor]\nkind = "mac34-1"\n'
        code, lines = self.check(head + 'can = "can97"\n')
        self.assertEqual((code, len(lines)), (3, 1), lines)
        self.assertIn("5: axis[x].motor.can: there is no interface can97", lines[0])
        code, lines = self.check(head + 'can = "lo"\n')
        self.assertEqual((code, len(lines)), (3, 1), lines)
        self.assertIn("lo is no interface for CAN", lines[0])


class Telling(Case):
    def wiring(self, motor):
        config = self.path("wiring.toml")
        with open(config, "w", encoding="utf-8") as file:
            file.write(f'[[axis]]\nname = "x"\n[axis.motor]\n{motor}\n')
        done = subprocess.run([service_case.NANOPLC, "wiring", config], capture_output=True, text=True, timeout=LONG, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def test_the_wiring_of_a_bus(self):
        text = self.wiring('kind = "mac34-2"\ncan = "can0"\naddress = 5\nbitrate = 250000')
        self.assertRegex(text, r"motor +can0 +CAN, 250000 bit/s +MAC34-2, address 5: J4")
        # 003 §VIII
        for pin in (r"CAN_L +J4 pin 2", r"CAN_H +J4 pin 7", r"GND +J4 pin 3", r"shield +J4 pin 5", "22 to 160 V", "120 Ohm"):
            self.assertRegex(text, pin)
        self.assertNotIn("FastMAC", text)

    def test_the_wiring_of_a_serial_line(self):
        text = self.wiring('kind = "mac23"\nport = "/dev/ttyUSB0"\nbaud = 19200')
        self.assertRegex(text, r"motor +/dev/ttyUSB0 +V24 \(RS-232\), 19200 baud, 8N1 +MAC23, address 0")
        self.assertIn("no connector pins", text)
        self.assertIn("no pins of J4 for V24", self.wiring('kind = "mac34-1"\nport = "/dev/ttyUSB0"'))


if __name__ == "__main__":
    (service_case.NANOPLC, service_case.MACSIM, service_case.NANOCTL, service_case.MACREG, service_case.SEQC,
     service_case.MENDING, MIDISIM) = sys.argv[1:8]
    unittest.main(argv=sys.argv[:1] + sys.argv[8:])
