#!/usr/bin/env python3
"""Modbus RTU with foreign masters, pymodbus and mbpoll, over pseudo-terminals; and as one slave among others on a line.

usage: modbus_rtu_test.py NANOPLC_SIM NANOPLC MACSIM NANOCTL SEQC SHUTTLE MENDING [TEST ...]
"""

import os
import select
import signal
import subprocess
import sys
import tty
import unittest

import program_case
import service_case
from patience import halt, until

# Debian's packages, whichever Python this is.
sys.path.append("/usr/lib/python3/dist-packages")
from pymodbus.client import ModbusSerialClient  # noqa: E402

SIM = SHUTTLE = ""
LONG = 60
RUNNING, IS_SAFE = 1, 4
NOT_KNOWN, NO_FUNCTION, REFUSED = 0x0B, 1, 4
TOO_LATE = 19


def frame(unit, *pdu):
    """With its CRC, bit by bit (Serial Line V1.02 §2.5.1.2)."""
    data = bytes((unit, *pdu))
    crc = 0xFFFF
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ 0xA001 if crc & 1 else crc >> 1
    return data + crc.to_bytes(2, "little")


class Simulated(program_case.ProgramCase):
    def serve(self):
        port = self.path("plc")
        self.launch(SIM, "run", SHUTTLE, "--realtime", "--quiet", "--modbus", "pty:" + port)
        return port

    def test_pymodbus_operates_it(self):
        master = ModbusSerialClient(self.serve(), baudrate=19200, timeout=10)  # a pseudo-terminal has no parity
        self.assertTrue(master.connect())
        self.addCleanup(master.close)
        until(lambda: master.read_discrete_inputs(RUNNING, 1, slave=1).bits[0], "running")
        # command 2 is stop, 1 run; another command_number carries it out.
        self.assertFalse(master.write_registers(0, [2, 0], slave=1).isError())
        self.assertTrue(master.read_discrete_inputs(IS_SAFE, 1, slave=1).bits[0])
        self.assertFalse(master.write_registers(0, [1, 7], slave=1).isError())
        self.assertEqual(master.read_input_registers(41, 2, slave=1).registers, [7, 0])
        until(lambda: master.read_discrete_inputs(RUNNING, 1, slave=1).bits[0], "running again")
        self.assertEqual(master.read_input_registers(140, 1, slave=1).exception_code, NOT_KNOWN)
        self.assertEqual(len(master.read_input_registers(0, 45, slave=1).registers), 45)

    def test_mbpoll_reads_it(self):
        shown = subprocess.run(["mbpoll", "-m", "rtu", "-a", "1", "-0", "-t", "3", "-r", "0", "-c", "3", "-1", "-b", "19200", "-P", "even",
                                self.serve()], capture_output=True, text=True, check=True, timeout=LONG).stdout
        self.assertRegex(shown, r"\[0\]:\s+1\n\[1\]:\s+\d+.*\n\[2\]:\s+[012]\n")


class OnALine(service_case.ServiceCase):
    """The line's other end is ours: we are the master, and neighbours."""

    def begin(self, settings="", axes=1):
        self.line, slave = os.openpty()
        tty.setraw(slave)
        self.addCleanup(os.close, self.line)
        names = "xy"[:axes]
        for name in names:
            self.plug_in("motor" + name)
        config = self.write(*(self.axis(name=name, motor="motor" + name, table=self.table) for name in names),
                            service=f'[modbus]\nrtu_port = "{os.ttyname(slave)}"\nrtu_unit = 10\n{settings}')
        os.close(slave)
        service = self.start(config, wait_for="Modbus RTU: answers on")
        self.assertNotIn("error", service.said())
        return service

    def send(self, data):
        os.write(self.line, data)

    def hear(self, size, patience=LONG):
        heard = b""
        while len(heard) < size and select.select([self.line], [], [], patience)[0]:
            heard += os.read(self.line, size - len(heard))
        return heard

    def ask(self, unit, *pdu, size):
        self.send(frame(unit, *pdu))
        return self.hear(size)

    def state(self, bit, unit=10):
        """A discrete input; nothing while it is not known."""
        answer = self.ask(unit, 2, 0, bit, 0, 1, size=5)
        if answer == frame(unit, 0x82, NOT_KNOWN):
            return None
        answer += self.hear(1)
        self.assertIn(answer, (frame(unit, 2, 1, 0), frame(unit, 2, 1, 1)))
        return answer[3] == 1

    def test_one_slave_among_others(self):
        service = self.begin(axes=2)
        until(lambda: self.state(RUNNING) and self.state(RUNNING, 11), "running")
        # A neighbour is asked and answers, one is silent, one answers with an unknown function; none of these is for this server.
        self.send(frame(9, 3, 0, 0, 0, 2) + frame(9, 3, 4, 1, 2, 3, 4) + frame(12, 4, 0, 0, 0, 1) + frame(13, 0x84, 2))
        self.assertTrue(self.state(RUNNING))
        self.assertTrue(self.state(RUNNING, 11))
        # A stop of one axis leaves the other.
        self.assertEqual(self.ask(11, 5, 0, 1, 0xFF, 0, size=8), frame(11, 5, 0, 1, 0xFF, 0))
        self.assertTrue(self.state(IS_SAFE, 11))
        self.assertTrue(self.state(RUNNING))
        self.assertEqual(self.end(service), 0)

    def test_a_broadcast_stops_and_nothing_else(self):
        self.begin(axes=2)
        until(lambda: self.state(RUNNING) and self.state(RUNNING, 11), "running")
        self.send(frame(0, 5, 0, 2, 0xFF, 0))  # coil make_safe
        until(lambda: self.state(IS_SAFE) and self.state(IS_SAFE, 11), "safe")
        self.send(frame(0, 16, 0, 0, 0, 2, 4, 0, 1, 0, 0) + frame(0, 16, 0, 0, 0, 2, 4, 0, 1, 0, 1))
        self.assertEqual(self.hear(1, patience=0), b"")  # a broadcast is not answered
        self.assertTrue(self.state(IS_SAFE))

    def test_half_frames_and_damage(self):
        self.begin()
        until(lambda: self.state(RUNNING), "running")
        for wrong in (frame(10, 4, 0, 0, 0, 2)[:5], b"\x0A" * 600, frame(10, 5, 0, 1, 0xFF, 0)[:-1] + b"\x00", os.urandom(50)):
            self.send(wrong)
            # A master waits for an answer that does not come, and asks again: a silence.
            self.assertEqual(self.hear(1, patience=0.2), b"")
            self.assertTrue(self.state(RUNNING))
        # A function that it does not have ends at the silence.
        self.assertEqual(self.ask(10, 0x2B, 0x0E, 1, 0, size=5), frame(10, 0xAB, NO_FUNCTION))

    def test_a_stop_is_found_whatever_is_before_and_behind_it(self):
        """Whatever answer comes, and when: tests/faces/rtu_slave_test.cpp has the answers, in virtual time."""
        self.begin(axes=2)
        stop, read = frame(10, 5, 0, 1, 0xFF, 0), frame(10, 4, 0, 1, 0, 1)
        # Noise, a half frame, a neighbour's frame of unknown length; another request, also one for the other axis.
        for burst in (b"\x00" + stop, read[:5] + stop, frame(9, 0x2B, 0x0E, 1, 0) + stop, stop + read, stop + frame(11, 4, 0, 1, 0, 1),
                      b"\x00" + frame(0, 5, 0, 1, 0xFF, 0), frame(0, 16, 0, 0, 0, 2, 4, 0, 2, 0, 7)):
            self.until_status(lambda status: status["state"] == "running")
            self.send(burst)
            self.until_status(lambda status: status["safe_reason"] == "stop command")
            self.ctl("run")

    def test_what_waited_too_long_starts_nothing(self):
        service = self.begin()
        until(lambda: self.state(RUNNING), "running")
        self.assertEqual(self.ask(10, 16, 0, 0, 0, 2, 4, 0, 2, 0, 0, size=8), frame(10, 16, 0, 0, 0, 2))
        self.assertTrue(self.state(IS_SAFE))
        halt(service.process.pid)
        self.send(frame(10, 16, 0, 0, 0, 2, 4, 0, 1, 0, 1))  # run
        self.assertEqual(self.hear(1, patience=1.6), b"")
        os.kill(service.process.pid, signal.SIGCONT)
        self.assertEqual(self.hear(8), frame(10, 16, 0, 0, 0, 2))
        self.assertEqual(self.ask(10, 4, 0, 41, 0, 2, size=9), frame(10, 4, 4, 0, 1, 0, TOO_LATE))
        self.assertTrue(self.state(IS_SAFE))

    def test_a_silent_master_stops_the_machine(self):
        self.begin('on_silence = "stop"\nsilence = 500\n')
        until(lambda: self.state(RUNNING), "running")
        self.assertEqual(self.ask(10, 6, 0, 2, 0x20, 0, size=8), frame(10, 6, 0, 2, 0x20, 0))  # forces IN5 off: it operates
        self.until_status(lambda status: status["safe_reason"] == "stop command")

    def test_mistakes_are_named(self):
        code, said = self.check(f'[modbus]\nrtu_port = "tcp:127.0.0.1:1"\nrtu_baud = 7\nrtu_parity = "mark"\n{self.axis()}', "--no-devices")
        self.assertEqual(code, 2)
        for key in ("rtu_port", "rtu_baud", "rtu_parity"):
            self.assertTrue(any(f"modbus.{key}: " in line for line in said), said)
        code, said = self.check(f'[modbus]\nrtu_port = "{self.path("motor")}"\n{self.axis()}', "--no-devices")
        self.assertTrue(any("is used twice" in line for line in said), said)

    def test_one_port_for_two_listeners_is_a_mistake(self):
        listeners = '[modbus]\nlisten = "tcp:0.0.0.0:1502"\n[metrics]\nlisten = "{}"\n'
        code, said = self.check(f'{listeners.format("127.0.0.1:1502")}{self.axis()}', "--no-devices")
        self.assertEqual(code, 2, said)
        self.assertTrue(any("4: metrics.listen: 127.0.0.1:1502 is used twice: modbus.listen in line 2" in line for line in said), said)
        self.assertEqual(self.check(f'{listeners.format("127.0.0.1:1503")}{self.axis()}', "--no-devices")[0], 0)


if __name__ == "__main__":
    (SIM, service_case.NANOPLC, service_case.MACSIM, service_case.NANOCTL, service_case.SEQC, SHUTTLE,
     service_case.MENDING) = sys.argv[1:8]
    unittest.main(argv=[sys.argv[0], *sys.argv[8:]])
