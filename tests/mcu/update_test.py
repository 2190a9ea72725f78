#!/usr/bin/env python3
"""A board's loader and its two slots, emulated: a firmware is renewed over the user's port, or is not.

usage: update_test.py BOARD FOLDER NANOCTL SIGN_FIRMWARE SEQC [SEED]

BOARD is microbit or lm3s6965evb; FOLDER has its images (build/mcu-update/bin), signed with ../development_key.pem.
"""

import json
import os
import random
import struct
import subprocess
import sys
import tempfile
import time
import unittest

import flash_controller
import machine
import microbit
import user_line as gw

BOARD = FOLDER = NANOCTL = SIGN = SEQC = ""
SEED = 20261126
FLASH_END, LOADER_BYTES = 0x40000, 12 * 1024
SLOT_BYTES = {"microbit": 0x1C000, "lm3s6965evb": 0x1E800}
NUMBERS = {"microbit": 1, "lm3s6965evb": 2}
HEADER = 256
REFUSED = 1  # nanoctl's exit code
FIRMWARE_STATE, FIRMWARE_RECEIVED, FIRMWARE_DATA, FIRMWARE_BEGIN, SLOT_RUNS = 193, 198, 199, 24, 1 << 16
RECEIVING = 2  # bits 15..0 of FIRMWARE_STATE
# ldr r0, [pc, #4]; ldr r1, [pc, #8]; str r1, [r0]; b .; AIRCR; its key and SYSRESETREQ
RESETS_ITSELF = struct.pack("<4H2I", 0x4801, 0x4902, 0x6001, 0xE7FE, 0xE000ED0C, 0x05FA0004)


def memory_of(path):
    """What Intel HEX leaves in an erased chip."""
    memory, upper = bytearray(b"\xFF" * FLASH_END), 0
    with open(path, encoding="ascii") as file:
        for line in file:
            row = bytes.fromhex(line.strip()[1:])
            assert sum(row) & 0xFF == 0, line
            if row[3] == 4:
                upper = int.from_bytes(row[4:6], "big") << 16
            elif row[3] == 0:
                at = upper + int.from_bytes(row[1:3], "big")
                memory[at : at + row[0]] = row[4:-1]
    return bytes(memory)


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.key = os.path.join(FOLDER, "..", "development_key.pem")
        self.slots = (LOADER_BYTES, LOADER_BYTES + SLOT_BYTES[BOARD])
        factory = memory_of(self.built(".hex"))
        loader = self.path("loader.bin")
        with open(loader, "wb") as file:
            file.write(factory[:LOADER_BYTES])
        self.board = self.make_board(loader, factory)
        self.board.start()
        self.addCleanup(self.board.cut_power)

    def make_board(self, loader, factory):
        if BOARD == "microbit":
            board = microbit.Microbit(loader, self.folder.name, kept_from=LOADER_BYTES)
            board.flash = factory[LOADER_BYTES:]
            return board
        images = [self.built(f"_{part}.elf") for part in ("loader", "slot_0", "slot_1")]
        return flash_controller.Board(loader, self.folder.name, factory, images)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def built(self, ending):
        return os.path.join(FOLDER, f"nanoplc_{BOARD}{ending}")

    def sign(self, version, links=None, key=None, board=None):
        """`links`: the image for each slot."""
        firmware = self.path(version + ".npfw")
        links = links or [self.built("_slot_0.bin"), self.built("_slot_1.bin")]
        subprocess.run([SIGN, "sign", "--key", key or self.key, "--board", str(board or NUMBERS[BOARD]), "--version", version,
                        *(f"{slot:#x}={link}" for slot, link in zip(self.slots, links)), "-o", firmware], check=True)
        return firmware

    def that_crash(self):
        """Images that reset the chip as the first thing that they do."""
        images = []
        for slot in self.slots:
            code = slot + HEADER + 64
            images.append(self.path(f"{slot:#x}.bin"))
            with open(images[-1], "wb") as file:
                file.write(struct.pack("<16I", 0x2000_0800, *[code | 1] * 15) + RESETS_ITSELF)
        return images

    def begin_ctl(self, *arguments):
        return subprocess.Popen([NANOCTL, "--port", self.board.endpoint(), "--patience", "2000", "--json", *arguments],
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def ctl(self, *arguments):
        self.board.stop_at_resets(True)
        tool = self.begin_ctl(*arguments)
        end = time.monotonic() + 4 * machine.LONG
        while tool.poll() is None and time.monotonic() < end:
            self.board.go_on_after_reset()
            time.sleep(0.02)
        tool.kill()
        said = tool.communicate()[0]
        self.board.stop_at_resets(False)
        return tool.returncode, json.loads(said.splitlines()[-1])

    def expect_refused(self, words, *arguments):
        code, told = self.ctl("firmware", *arguments)
        self.assertEqual(code, REFUSED, told)
        self.assertIn(words, told["error"])

    def expect_runs(self, slot, *versions):
        code, told = self.ctl("firmware")
        self.assertEqual(code, 0, told)
        self.assertEqual((told["running"], told["confirmed"]), (slot, True))
        self.assertEqual([each["version"] for each in told["slots"]], list(versions))

    def cut_power(self):
        self.board.cut_power()
        self.board.start()

    def expect_given_up_after_three_starts(self):
        for _ in range(3):
            self.cut_power()
            self.assertEqual(self.ctl("firmware")[1]["running"], 1)
        self.cut_power()
        self.expect_runs(0, "0.1.0", "0.2.0")


class Update(Case):
    def test_a_newer_firmware_is_confirmed_and_outlives_power_cuts(self):
        self.expect_runs(0, "0.1.0", "")
        code, told = self.ctl("firmware", self.sign("0.2.0"))
        self.assertEqual((code, told.get("version"), told.get("slot")), (0, "0.2.0", 1), told)
        self.cut_power()
        self.expect_runs(1, "0.1.0", "0.2.0")
        self.expect_refused("only a later version", self.sign("0.1.9"))
        self.expect_refused("board 7", self.sign("0.3.0", board=7))
        self.expect_runs(1, "0.1.0", "0.2.0")

    def test_one_that_crashes_is_started_three_times_then_the_old_one_again(self):
        self.expect_refused("0.2.0 did not run healthily in 3 starts; 0.1.0 runs again", self.sign("0.2.0", self.that_crash()))
        self.expect_runs(0, "0.1.0", "0.2.0")
        self.cut_power()
        self.expect_runs(0, "0.1.0", "0.2.0")

    def test_one_signed_with_another_key_is_not_started(self):
        key = self.path("other.pem")
        subprocess.run(["openssl", "genpkey", "-algorithm", "ed25519", "-out", key], check=True)
        self.expect_refused("not signed with the key of this board", self.sign("0.2.0", self.that_crash(), key=key))
        self.expect_runs(0, "0.1.0", "0.2.0")


class OfMicrobit(Case):
    def test_one_that_was_not_confirmed_is_given_up_after_three_starts(self):
        code, told = self.ctl("firmware", "--only-store", self.sign("0.2.0"))
        self.assertEqual((code, told.get("confirmed")), (0, False), told)
        self.expect_runs(0, "0.1.0", "0.2.0")
        self.expect_given_up_after_three_starts()

    def test_after_resets_and_power_cuts_in_updates_the_old_one_runs(self):
        print("seed", SEED)
        seeded = random.Random(SEED)
        with open(self.sign("0.2.0"), "rb") as file:
            firmware = file.read()
        for number in range(6):
            line = gw.UserLine(self.board.path("user"))
            self.assertEqual(line.read(FIRMWARE_STATE) & SLOT_RUNS, 0)
            line.must_write(gw.UPLOAD_BYTES, 37_000)
            line.must_write(gw.COMMAND, FIRMWARE_BEGIN)
            pieces = max(0, seeded.randrange(-30, 60))  # a third of the cuts come while it erases
            if pieces:
                machine.until(lambda: line.read(FIRMWARE_STATE) & 0xFF, lambda phase: phase == RECEIVING)
            for at in range(0, 120 * pieces, 120):
                piece = gw.number(at) + firmware[at : at + 120]
                taken = any(line.write(FIRMWARE_DATA, piece) for _ in range(20))  # a repeat is taken, too
                self.assertTrue(taken, f"byte {at}: RESULT {line.read(gw.RESULT):08X}h, {line.read(FIRMWARE_RECEIVED)} taken")
            line.close()
            if number % 2:
                self.cut_power()
            else:
                self.board.reset()
        self.assertEqual(self.ctl("firmware")[1]["slots"][0]["version"], "0.1.0")


class OfLm3s(Case):
    def tearDown(self):
        self.assertEqual(self.board.controller.faults, [], "orders that the chip would not take")

    def test_one_that_was_not_confirmed_is_given_up_after_three_starts(self):
        """Put into the flash from outside, as a debugger would."""
        self.board.cut_power()
        with open(self.sign("0.2.0"), "rb") as file:
            firmware = file.read()
        first = HEADER + (int.from_bytes(firmware[20:24], "little") + 3) // 4 * 4
        self.board.put(self.slots[1], firmware[first:])
        self.board.put(FLASH_END - flash_controller.PAGE, b"COMP")
        self.board.start()
        self.board.cut_power()
        self.assertEqual(self.board.flash[FLASH_END - flash_controller.PAGE + 4:][:8], b"TRIE\xFF\xFF\xFF\xFF")
        self.board.start()
        self.assertEqual(self.ctl("firmware")[1]["running"], 1)
        self.cut_power()
        self.assertEqual(self.ctl("firmware")[1]["running"], 1)
        self.cut_power()
        self.expect_runs(0, "0.1.0", "0.2.0")

    def test_after_power_cuts_in_any_order_of_an_update_the_old_one_runs(self):
        print("seed", SEED)
        seeded = random.Random(SEED)
        firmware = self.sign("0.2.0", self.that_crash())
        words = (HEADER + 64 + len(RESETS_ITSELF)) // 4
        last = 2 + words  # two pages are erased; then the mark that it is complete
        for order in [0, 1, last - 1, last, *(seeded.randrange(2, last - 1) for _ in range(4))]:
            self.board.cut_after(order)
            tool = self.begin_ctl("firmware", "--only-store", firmware)
            self.board.wait_for_cut()
            self.assertNotEqual(tool.wait(2 * machine.LONG), 0, tool.communicate())
            self.cut_power()
            code, told = self.ctl("firmware")
            self.assertEqual((code, told["running"], told["confirmed"], told["slots"][1]["version"]), (0, 0, True, ""), told)

    def test_nothing_is_erased_while_the_sequence_is_started_and_nothing_runs_afterwards(self):
        source = os.path.join(os.path.dirname(os.path.abspath(__file__)), "machine.seq")
        subprocess.run([SEQC, "build", source, "--quiet", "-o", self.path("machine.bin")], check=True)
        firmware = self.sign("0.2.0", self.that_crash())
        code, told = self.ctl("upload", self.path("machine.bin"), "--only-store")
        self.assertEqual(code, 0, told)
        self.cut_power()
        self.assertTrue(self.ctl("status")[1]["waits_for_first_run"])
        self.ctl("give-up-stop")  # no motor confirms that of the start
        code, told = self.ctl("run")
        self.assertEqual(code, 0, told)
        self.cut_power()
        self.assertNotEqual(self.ctl("status")[1]["state"], "stopped")  # it starts by itself, and waits for the motor
        self.expect_refused("stop", firmware)
        self.assertEqual(self.board.controller.commands, 0)
        self.ctl("stop")  # which no motor confirms
        self.assertEqual(self.ctl("status")[1]["state"], "stopped")
        self.assertEqual(self.ctl("firmware", "--only-store", firmware)[0], 0)
        code, told = self.ctl("run")
        self.assertEqual(code, REFUSED, told)
        self.assertIn("service", told["error"])


def load_tests(loader, _tests, _pattern):
    own = OfMicrobit if BOARD == "microbit" else OfLm3s
    return unittest.TestSuite(loader.loadTestsFromTestCase(case) for case in (Update, own))


if __name__ == "__main__":
    BOARD, FOLDER, NANOCTL, SIGN, SEQC = sys.argv[1:6]
    SEED = int(sys.argv[6]) if len(sys.argv) > 6 else SEED
    unittest.main(argv=sys.argv[:1])
