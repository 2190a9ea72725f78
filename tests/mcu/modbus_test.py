#!/usr/bin/env python3
"""The image with Modbus RTU on an emulated board, with a foreign master (pymodbus) on the user's line, beside MacTalk.

usage: modbus_test.py IMAGE.bin MACSIM NANOCTL MACREG SEQC PROGRAM.seq
"""

import os
import random
import socket
import sys
import threading
import time
import tty
import unittest

import image_case
import sockets
import user_line
from machine import until

# Debian's packages, whichever Python this is.
sys.path.append("/usr/lib/python3/dist-packages")
from pymodbus.client import ModbusSerialClient  # noqa: E402

PROGRAM = ""
UNIT = 128
RUN, STOP, ACKNOWLEDGE = 1, 2, 32
READY, RUNNING, IS_SAFE, LINK_UP, STOP_UNCONFIRMED = 0, 1, 4, 7, 15
NO_FUNCTION, NO_ADDRESS, NO_VALUE, REFUSED, NOT_KNOWN = 1, 2, 3, 4, 0x0B
NOT_STOPPED, BAD_VALUE, TOO_LATE = 5, 4, 19
P2, V_SOLL = 51, 5


def frame(unit, *pdu):
    """With its CRC, bit by bit (Serial Line V1.02 §2.5.1.2)."""
    data = bytes((unit, *pdu))
    crc = 0xFFFF
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ 0xA001 if crc & 1 else crc >> 1
    return data + crc.to_bytes(2, "little")


class Line:
    """The board's line as a terminal, which a Modbus master can open."""

    def __init__(self, path):
        self.socket = sockets.connected(path)
        self.socket.settimeout(None)
        self.ours, theirs = os.openpty()
        tty.setraw(theirs)
        self.name = os.ttyname(theirs)
        self.theirs = theirs
        self.threads = [threading.Thread(target=copy) for copy in (self.to_board, self.from_board)]
        for thread in self.threads:
            thread.start()

    def to_board(self):
        try:
            while data := os.read(self.ours, 4096):
                self.socket.sendall(data)
        except OSError:
            pass  # it was closed

    def from_board(self):
        try:
            while data := self.socket.recv(4096):
                os.write(self.ours, data)
        except OSError:
            pass

    def close(self):
        os.close(self.theirs)
        self.socket.shutdown(socket.SHUT_RDWR)
        for thread in self.threads:
            thread.join()
        self.socket.close()
        os.close(self.ours)


class Modbus(image_case.ImageCase):
    def setUp(self):
        self.take_folder()
        self.start_board("--model", "MAC140", "--fastmac")
        self.ctl("upload", self.compile(PROGRAM), "--run")

    def plug_in(self):
        line = Line(self.board.path("user"))
        self.addCleanup(line.close)
        master = ModbusSerialClient(line.name, baudrate=19200, timeout=10, retry_on_empty=True)
        self.assertTrue(master.connect())
        self.addCleanup(master.close)
        until(lambda: self.status(master, RUNNING), lambda seen: seen)
        return master

    def inputs(self, master, address, count=1):
        answer = master.read_input_registers(address, count, slave=UNIT)
        self.assertFalse(answer.isError(), answer)
        return answer.registers

    def status(self, master, bit):
        answer = master.read_discrete_inputs(bit, 1, slave=UNIT)
        self.assertFalse(answer.isError(), answer)
        return answer.bits[0]

    def order(self, master, command, number):
        self.assertFalse(master.write_registers(0, [command, number], slave=UNIT).isError())
        done, result = self.inputs(master, 41, 2)
        self.assertEqual(done, number)
        return result

    def test_a_plc_operates_it(self):
        master = self.plug_in()
        words = self.inputs(master, 0, 45)
        self.assertEqual((words[0], words[2], words[14]), (1, 2, 3))
        self.assertEqual(words[1] >> RUNNING & 1, 1)
        self.assertEqual(self.order(master, RUN, 7), TOO_LATE)  # no 0 was seen: a cyclic master starts nothing
        self.assertFalse(master.write_registers(0, [STOP, 0], slave=UNIT).isError())
        self.assertTrue(self.status(master, IS_SAFE))
        until(lambda: self.status(master, STOP_UNCONFIRMED), lambda seen: not seen)
        self.assertEqual(self.order(master, RUN, 8), 0)
        until(lambda: self.status(master, RUNNING), lambda seen: seen)
        self.assertEqual(self.order(master, RUN, 9), NOT_STOPPED)
        self.assertEqual(self.order(master, 99, 10), BAD_VALUE)
        self.assertEqual(self.order(master, ACKNOWLEDGE, 11), 0)
        self.assertEqual(self.inputs(master, 40), [0])
        self.assertFalse(master.write_coil(1, True, slave=UNIT).isError())
        self.assertTrue(self.status(master, IS_SAFE))
        until(lambda: self.status(master, STOP_UNCONFIRMED), lambda seen: not seen)
        self.assertFalse(master.write_coil(0, False, slave=UNIT).isError())
        self.assertFalse(master.write_coil(0, True, slave=UNIT).isError())
        until(lambda: self.status(master, RUNNING), lambda seen: seen)

    def test_the_motors_registers(self):
        master = self.plug_in()
        self.assertEqual(master.write_registers(1000 + 2 * V_SOLL, [0, 100], slave=UNIT).exception_code, REFUSED)
        self.assertFalse(master.write_coil(1, True, slave=UNIT).isError())
        for register, value in ((P2, 0x12345), (V_SOLL, -5)):
            words = [value >> 16 & 0xFFFF, value & 0xFFFF]
            self.assertFalse(master.write_registers(1000 + 2 * register, words, slave=UNIT).isError())
            answer = master.read_holding_registers(1000 + 2 * register, 2, slave=UNIT)
            self.assertEqual(answer.registers, words)
        # 16 bits hold no more than that.
        self.assertEqual(master.write_registers(1000 + 2 * V_SOLL, [1, 0], slave=UNIT).exception_code, NO_VALUE)
        self.assertFalse(master.read_input_registers(100, 2, slave=UNIT).isError())
        self.end_motor()
        until(lambda: self.status(master, LINK_UP), lambda seen: not seen)
        self.assertEqual(master.read_input_registers(100, 2, slave=UNIT).exception_code, NOT_KNOWN)

    def test_what_is_not_there_is_an_exception(self):
        master = self.plug_in()
        for address, count in ((45, 1), (44, 2), (45, 2), (0, 48), (50, 1), (49, 2), (102, 2), (65535, 1)):
            self.assertEqual(master.read_input_registers(address, count, slave=UNIT).exception_code, NO_ADDRESS)
        self.assertEqual(master.read_holding_registers(4, 1, slave=UNIT).exception_code, NO_ADDRESS)
        self.assertEqual(master.read_holding_registers(1001, 2, slave=UNIT).exception_code, NO_ADDRESS)
        self.assertEqual(master.read_coils(7, 1, slave=UNIT).exception_code, NO_ADDRESS)
        self.assertEqual(master.read_discrete_inputs(16, 1, slave=UNIT).exception_code, NO_ADDRESS)

    def answer_to(self, line, data, size):
        return line.ask(data, size, 0.5)

    def test_damage_and_floods_do_no_harm(self):
        line = user_line.UserLine(self.board.path("user"))
        good = frame(UNIT, 4, 0, 0, 0, 1)
        seed = random.randrange(2**32)
        chance = random.Random(seed)
        for _ in range(20):
            line.socket.sendall(bytes(chance.randrange(256) for _ in range(chance.randrange(300))))
            time.sleep(0.02)  # the pause that ends a frame
            half = good[:chance.randrange(1, 8)]
            line.socket.sendall(half)
            time.sleep(0.02)
            wrong = bytes([*good[:6], good[6] ^ 1, good[7]])
            self.assertEqual(self.answer_to(line, wrong, 7), b"", seed)
            self.assertEqual(self.answer_to(line, frame(UNIT + 1, 4, 0, 0, 0, 1), 7), b"", seed)
            until(lambda: self.answer_to(line, good, 7), lambda seen: seen == frame(UNIT, 4, 2, 0, 1))
            # The other language goes on between.
            self.assertEqual(line.read(user_line.STATUS) & 7, 2)
        line.close()
        self.assertEqual(self.ctl("status")["state"], "running")

    def test_both_languages_in_turn(self):
        self.ctl("stop")
        master_line = user_line.UserLine(self.board.path("user"))
        self.assertEqual(master_line.ask(frame(UNIT, 0x63), 5), frame(UNIT, 0xE3, NO_FUNCTION))
        master_line.close()
        self.ctl("run")


if __name__ == "__main__":
    image_case.take(*(os.path.abspath(program) for program in sys.argv[1:6]))
    PROGRAM = os.path.abspath(sys.argv[6])
    unittest.main(argv=[sys.argv[0], *sys.argv[7:]])
