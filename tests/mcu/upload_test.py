#!/usr/bin/env python3
"""Resets at random moments of an upload, and noise on the user's line. No motor: nothing here needs one.

usage: upload_test.py IMAGE.bin [SEED]
"""

import random
import sys
import tempfile
import time
import unittest
import zlib

import machine
import user_line as gw
from user_line import number

IMAGE = ""
SEED = 0
PIECE = 24  # the emulated line has no speed: a whole message must fit the firmware's buffer
END = bytes.fromhex("3F00000000000000")


def table(rng):
    """Terms that stay in step 0 and set outputs, an end term."""
    terms = [bytes([0xC0, 0, 0, 0, 0x80, rng.randrange(16), rng.randrange(256), 0]) for _ in range(rng.randrange(1, 60))]
    return b"".join(terms) + END


def messages(content):
    """What uploads it, one after the other."""
    yield gw.COMMAND, number(gw.BEGIN)
    for begin in range(0, len(content), PIECE):
        yield gw.TABLE_DATA, content[begin:begin + PIECE]
    yield gw.UPLOAD_BYTES, number(len(content))
    yield gw.UPLOAD_CRC, number(zlib.crc32(content))
    yield gw.COMMAND, number(gw.COMMIT)


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.board = self.make_board(self.folder.name).start()
        self.addCleanup(self.board.cut_power)
        self.line = self.open_line()
        self.addCleanup(lambda: self.line.close())
        self.rng = random.Random(SEED)

    def make_board(self, folder):
        return machine.Machine(IMAGE, folder, fast=True)

    def open_line(self):
        return gw.UserLine(self.board.path("user"))

    def send(self, register, data):
        self.assertTrue(self.line.write(register, data), f"register {register}: {self.line.read(gw.RESULT):08X}h")

    def wait_stored(self):
        machine.until(lambda: self.line.read(gw.UPLOAD_STATE), lambda state: state == gw.STORED)

    def upload(self, content):
        for register, data in messages(content):
            self.send(register, data)
        self.wait_stored()
        self.assertEqual(self.line.read(gw.STORED_CRC), zlib.crc32(content))

    def upload_until(self, content, message, byte, pause):
        """Ends in the middle of a message, or a while after the last one; True if the commit was sent."""
        sent = list(messages(content))
        for register, data in sent[:message]:
            self.send(register, data)
        if message == len(sent):
            time.sleep(pause)  # the storage works; real time is as good as any for chance
            return True
        whole = gw.write_message(*sent[message])
        self.line.socket.sendall(whole[:byte % len(whole)])
        return False


class Uploads(Case):
    resets, power_cuts = 100, 5

    def one_cut(self, old, cut):
        """An upload that is cut; the table that is stored then."""
        new = table(self.rng)
        last = len(list(messages(new)))
        message = last if self.rng.random() < 0.4 else self.rng.randrange(last)
        byte = self.rng.randrange(60)
        where = f"seed {SEED}: cut in message {message} of {last}, byte {byte}"
        committed = self.upload_until(new, message, byte, self.rng.random() * 0.02)
        cut()
        stored = self.line.read(gw.STORED_CRC)
        may_be = {zlib.crc32(old): old, **({zlib.crc32(new): new} if committed else {})}
        self.assertIn(stored, may_be, where)
        self.assertEqual(self.line.read(gw.TABLE_CRC), stored, f"{where}: what is stored is what is active")
        self.cuts[committed, stored == zlib.crc32(new)] = self.cuts.get((committed, stored == zlib.crc32(new)), 0) + 1
        return may_be[stored]

    def reset(self):
        self.board.reset()
        machine.until(lambda: self.line.read(gw.UPLOAD_STATE), lambda state: state == 0)

    def cut_power(self):
        self.line.close()
        self.board.cut_power()
        self.board.start()
        self.line = self.open_line()

    def test_a_reset_in_an_upload_leaves_the_old_or_the_new_table(self):
        self.cuts = {}
        stored = table(self.rng)
        self.upload(stored)
        for number_of in range(self.resets + self.power_cuts):
            stored = self.one_cut(stored, self.reset if number_of < self.resets else self.cut_power)
        print(f"seed {SEED}: {self.resets} resets and {self.power_cuts} power cuts; (commit sent, new table stored): {self.cuts}")
        self.upload(table(self.rng))


class NoMemory(unittest.TestCase):
    def test_a_board_without_its_memory_says_so_and_works_on(self):
        with tempfile.TemporaryDirectory() as folder:
            board = machine.Machine(IMAGE, folder, fast=True, has_memory=False).start()
            self.addCleanup(board.cut_power)
            line = gw.UserLine(board.path("user"))
            self.addCleanup(line.close)
            self.assertEqual(line.log(), [(gw.STORE_DAMAGED, 0), (gw.BAD_SETTINGS, 0), (gw.STORE_DAMAGED, 0)], "settings and table")
            self.assertEqual(line.read(gw.SAFE_REASON), gw.BAD_SETTINGS)
            self.assertEqual(line.read(gw.STORE_FLAGS), 2 | 8, "initial settings are in use, and nobody has commanded run")
            self.assertTrue(line.write(gw.COMMAND, number(gw.BEGIN)))
            failed = machine.until(lambda: line.read(gw.UPLOAD_STATE), lambda state: state & 0xFF == gw.FAILED)
            self.assertEqual(failed >> 8 & 0xFF, gw.STORAGE_FAILED)


class Noise(Case):
    def test_whole_messages_are_understood_after_noise_and_breaks(self):
        print(f"seed {SEED}")
        self.assertEqual(self.line.read(gw.LINE_FAULTS), 0)
        breaks = 0
        for _ in range(50):
            noise = self.rng.randbytes(self.rng.randrange(1, 400))
            self.line.socket.sendall(noise)
            if self.rng.random() < 0.5:
                self.board.monitor.do("chardev-send-break", id="user")
                breaks += 1
            self.assertEqual(self.line.read(gw.STATUS) & 7, 0)
        self.assertEqual(self.line.log(), [(gw.NOT_STARTED, 0)], "a new board waits for its first run, and nothing else happened")
        self.assertGreaterEqual(self.line.read(gw.LINE_FAULTS) & 0xFFFF, breaks)

    def test_a_flood_costs_messages_and_nothing_else(self):
        """The line has no speed here: so much at once overruns the receiver's buffer."""
        flood = gw.write_message(gw.TABLE_DATA, bytes(128)) * 20
        for _ in range(20):
            self.line.socket.sendall(flood)
            self.assertEqual(self.line.read(gw.STATUS) & 7, 0)
        self.assertEqual(self.line.read(gw.UPLOAD_RECEIVED), 0, "no upload was begun")
        self.assertGreater(self.line.read(gw.LINE_FAULTS) >> 16, 0, "characters lost")
        self.assertEqual(self.line.log(), [(gw.NOT_STARTED, 0)], "a new board waits for its first run, and nothing else happened")


if __name__ == "__main__":
    IMAGE = sys.argv[1]
    SEED = int(sys.argv[2]) if len(sys.argv) > 2 else 20261122
    unittest.main(argv=sys.argv[:1])
