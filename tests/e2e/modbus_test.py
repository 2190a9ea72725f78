#!/usr/bin/env python3
"""Modbus TCP with foreign masters: pymodbus and mbpoll, on the simulator and the service.

usage: modbus_test.py NANOPLC_SIM NANOPLC MACSIM NANOCTL SEQC SHUTTLE MENDING EXAMPLES [TEST ...]
"""

import csv
import io
import os
import random
import re
import signal
import socket
import struct
import subprocess
import sys
import unittest
import zlib

import program_case
import service_case
from patience import halt, until

# Debian's packages, whichever Python this is.
sys.path.append("/usr/lib/python3/dist-packages")
from pymodbus.client import ModbusTcpClient  # noqa: E402

SIM = SHUTTLE = EXAMPLES = ""
LONG = 60
RUN, STOP, SAFE, HOLD = 1, 2, 3, 6
COMMAND, FORCE_INPUTS = 0, 2
DONE_NUMBER, RESULT = 41, 42
# Discrete inputs.
READY, RUNNING, HELD, IS_SAFE, LINK_UP = 0, 1, 3, 4, 7
REFUSED, BUSY, NOT_KNOWN, NO_FUNCTION, NO_ADDRESS, NO_VALUE = 4, 6, 0x0B, 1, 2, 3
SEAT_TAKEN, TOO_LATE, OUT_OF_RANGE, NO_RECIPE = 22, 19, 23, 26
ACKNOWLEDGE, RESET_ERROR, TAKE_SET_POINTS, LOAD_RECIPE = 32, 33, 34, 35
SET_POINTS, WHY = 200, 900
MOVES, GATEWAY_SAFE, LOAD_FACTOR_ZERO = 1, 11, 34


def port_of(text):
    return int(re.search(r"tcp:127\.0\.0\.1:(\d+)", text).group(1))


class Master:
    def __init__(self, port, unit=1):
        self.port = port
        self.client = ModbusTcpClient("127.0.0.1", port=port, timeout=10)
        assert self.client.connect()
        self.unit = unit

    def inputs(self, address, count=1):
        return self.client.read_input_registers(address, count, slave=self.unit)

    def holding(self, address, count=1):
        return self.client.read_holding_registers(address, count, slave=self.unit)

    def words(self, address, count=1):
        answer = self.inputs(address, count)
        assert not answer.isError(), answer
        return answer.registers

    def status(self, bit):
        answer = self.client.read_discrete_inputs(bit, 1, slave=self.unit)
        assert not answer.isError(), answer
        return answer.bits[0]

    def write(self, address, *values):
        return self.client.write_registers(address, list(values), slave=self.unit)

    def coil(self, number, level=True):
        return self.client.write_coil(number, level, slave=self.unit)

    def pulse(self, number):
        self.coil(number, False)
        return self.coil(number)

    def order(self, command, number):
        assert not self.write(COMMAND, command, number).isError()
        done, result = self.words(DONE_NUMBER, 2)
        assert done == number, (done, number)
        return result

    def long(self, address):
        high, low = self.words(address, 2)
        return struct.unpack(">i", struct.pack(">HH", high, low))[0]


class Simulated(program_case.ProgramCase):
    def connect(self, port, unit=1):
        master = Master(port, unit)
        self.addCleanup(master.client.close)
        return master

    def serve(self, *more):
        _, lines = self.launch(SIM, "run", SHUTTLE, "--realtime", "--quiet", "--modbus", "tcp:127.0.0.1:0", *more)
        return port_of("".join(lines))

    def master(self):
        master = self.connect(self.serve())
        until(lambda: master.status(RUNNING), "running")
        return master

    def test_a_plc_commands_with_its_handshake(self):
        master = self.master()
        self.assertEqual(master.write(COMMAND, STOP, 0).isError(), False)
        self.assertTrue(master.status(IS_SAFE))
        self.assertEqual(master.order(RUN, 7), 0)
        until(lambda: master.status(RUNNING), "running")
        # The same number again, as a cyclic master writes it, is nothing new.
        self.assertFalse(master.write(COMMAND, STOP, 7).isError())
        self.assertFalse(master.write(COMMAND, RUN, 7).isError())
        self.assertTrue(master.status(IS_SAFE))
        self.assertEqual(master.order(RUN, 8), 0)
        until(lambda: master.status(RUNNING), "running")
        self.assertEqual(master.order(RUN, 9), 5)  # not_stopped

    def test_a_master_that_writes_in_cycles_starts_nothing_by_itself(self):
        master = self.master()
        self.assertFalse(master.coil(1).isError())  # stop
        self.assertEqual(master.order(RUN, 7), TOO_LATE)
        self.assertFalse(master.coil(0).isError())  # run, never seen 0
        self.assertTrue(master.status(IS_SAFE))
        self.assertFalse(master.pulse(0).isError())
        until(lambda: master.status(RUNNING), "running")

    def cutter(self):
        """The example with set-points Length (0.1 mm), Speed (0.1 rpm), Blade_Time (ms) and Pieces."""
        _, lines = self.launch(SIM, "run", os.path.join(EXAMPLES, "cut_to_length.seq"), "--realtime", "--quiet", "--modbus",
                               "tcp:127.0.0.1:0")
        master = self.connect(port_of("".join(lines)))
        until(lambda: not master.inputs(SET_POINTS, 8).isError(), "the set-points")
        self.assertFalse(master.coil(1).isError())
        self.assertFalse(master.write(COMMAND, STOP, 0).isError())
        return master

    def test_set_points_describe_themselves(self):
        master = self.cutter()
        self.assertEqual(master.words(SET_POINTS, 4), [4, 0, 0, 8])
        self.assertEqual([master.long(210 + 2 * i) for i in range(4)], [800, 15_000, 300, 3])
        texts = [master.words(300 + 32 * i, 32) for i in range(4)]
        names = [struct.pack(">16H", *words[16:]).rstrip(b"\0").decode() for words in texts]
        units = [struct.pack(">6H", *words[10:16]).rstrip(b"\0").decode() for words in texts]
        self.assertEqual(names, ["Length", "Speed", "Blade_Time", "Pieces"])
        self.assertEqual(units, ["mm", "rpm", "ms", ""])
        self.assertEqual(texts[0][:10], [0, 100, 0, 2000, 0, 800, 0, 1, 1, 0])  # 10.0 to 200.0, 80.0, in steps of 0.1
        self.assertEqual(texts[3][:10], [0, 1, 0, 999, 0, 3, 0, 0, 0, 0])
        self.assertEqual(master.inputs(210 + 8, 2).exception_code, NOT_KNOWN)

    def test_set_points_are_changed_whole_or_not_at_all(self):
        master = self.cutter()
        self.assertFalse(master.write(6, 0, 1234, 0, 20_000).isError())
        self.assertEqual((master.holding(5).registers, master.long(210)), ([3], 800))
        self.assertEqual(master.order(TAKE_SET_POINTS, 1), 0)
        self.assertEqual([master.long(210 + 2 * i) for i in range(4)], [1234, 20_000, 300, 3])
        self.assertEqual(master.holding(5, 5).registers, [0, 0, 1234, 0, 20_000])
        # One is out of its range: none is taken.
        self.assertFalse(master.write(6, 0, 500, 0, 25_010).isError())
        self.assertEqual(master.order(TAKE_SET_POINTS, 2), OUT_OF_RANGE)
        self.assertEqual((master.words(43), master.long(210)), ([1], 1234))
        self.assertFalse(master.write(5, 0).isError())
        self.assertEqual(master.order(TAKE_SET_POINTS, 3), 4)  # none was written: bad_value
        self.assertEqual(master.write(7, 5).exception_code, NO_ADDRESS)
        self.assertEqual(master.write(6, 5).exception_code, NO_ADDRESS)
        # A value that is set already is not stored again; in one request with its command, negative numbers too.
        changes = master.long(206)
        self.assertFalse(master.write(COMMAND, TAKE_SET_POINTS, 4, 0, 0, 0, 0, 0, 1234).isError())
        self.assertEqual((master.words(DONE_NUMBER, 2), master.long(206)), ([4, 0], changes))
        self.assertFalse(master.write(COMMAND, TAKE_SET_POINTS, 5, 0, 0, 0, 0, 0xFFFF, 0xFFFF).isError())
        self.assertEqual(master.words(DONE_NUMBER, 3), [5, OUT_OF_RANGE, 0])

    def test_set_points_need_the_seat_and_reading_them_does_not(self):
        master = self.cutter()
        other = self.connect(master.port)
        self.assertFalse(master.write(FORCE_INPUTS, 0x2000).isError())
        self.assertFalse(other.write(6, 0, 900).isError())
        self.assertEqual(other.order(TAKE_SET_POINTS, 1), SEAT_TAKEN)
        self.assertEqual((other.long(210), other.holding(6, 2).registers), (800, [0, 900]))
        # What another client has written is not taken.
        self.assertEqual(master.order(TAKE_SET_POINTS, 2), 4)

    def test_a_recipe_that_is_not_there_is_not_loaded(self):
        master = self.cutter()
        self.assertFalse(master.write(4, 3).isError())
        self.assertEqual(master.order(LOAD_RECIPE, 1), NO_RECIPE)
        self.assertEqual(master.words(820, 8), [0] * 8)

    def test_why_nothing_moves(self):
        master = self.master()
        self.assertFalse(master.coil(1).isError())
        until(lambda: (answer := master.inputs(WHY)) and not answer.isError() and answer.registers == [GATEWAY_SAFE], "why")
        severity, *text = master.words(WHY + 1, 99)
        self.assertEqual(severity, 0)
        self.assertIn(b"safe state: stop command", struct.pack(">98H", *text))
        # A value reported by the motor has precedence: its load factor is 0.
        self.assertFalse(master.write(1000 + 2 * 13, 0, 0).isError())  # KVOUT
        until(lambda: master.words(WHY) == [LOAD_FACTOR_ZERO], "KVOUT")

    def test_why_a_midi_drive_does_not_move(self):
        _, lines = self.launch(SIM, "run", service_case.MENDING, "--motor", "MAC34-1", "--realtime", "--quiet", "--modbus", "tcp:127.0.0.1:0")
        master = self.connect(port_of("".join(lines)))
        until(lambda: (answer := master.inputs(WHY)) and not answer.isError() and answer.registers == [MOVES], "moves")
        self.assertFalse(master.coil(1).isError())
        until(lambda: master.words(WHY) == [GATEWAY_SAFE], "why")

    def test_reset_error_clears_the_motors_errors(self):
        master = self.master()
        self.assertFalse(master.coil(1).isError())
        self.assertFalse(master.write(COMMAND, STOP, 0).isError())
        # DIS_P_LIM (14) is a setting and stays; FLW_ERR (1) is an error.
        self.assertFalse(master.write(1000 + 2 * 35, 0, 0x4002).isError())
        self.assertEqual(master.order(RESET_ERROR, 1), 0)
        self.assertEqual(master.holding(1000 + 2 * 35, 2).registers[1] & 0x4082, 0x4000)

    def test_acknowledge_by_the_command_word(self):
        master = self.cutter()
        self.assertNotEqual(master.words(40), [0])
        self.assertEqual(master.order(ACKNOWLEDGE, 1), 0)
        self.assertEqual(master.words(40), [0])

    def test_a_move_and_the_motors_values(self):
        master = self.master()
        until(lambda: not master.inputs(100, 6).isError(), "the motor's values")
        self.assertEqual(master.long(102), 0)
        self.assertFalse(master.write(FORCE_INPUTS, 0x0101).isError())
        # P2 is 40960 counts, of which a MAC140 has 4096 a revolution: 10 rev, in thousandths.
        until(lambda: abs(master.long(102) - 10_000) <= 1, "10 rev")
        self.assertAlmostEqual(master.long(100), 40_960, delta=4)
        answer = master.holding(1000 + 2 * 51, 2)  # P2 is register 51
        self.assertEqual(answer.registers, [0, 40_960])
        # The sequence runs: motor registers are not written.
        self.assertEqual(master.write(1000 + 2 * 51, 0, 4096).exception_code, REFUSED)
        self.assertFalse(master.coil(1).isError())
        self.assertFalse(master.write(1000 + 2 * 51, 0, 4096).isError())
        self.assertEqual(master.holding(1000 + 2 * 51, 2).registers, [0, 4096])

    def test_what_is_not_known_is_an_exception(self):
        master = self.master()
        self.assertEqual(master.inputs(140).exception_code, NOT_KNOWN)  # a MAC140 does not report a temperature
        self.assertEqual(master.inputs(60).exception_code, NO_ADDRESS)
        self.assertEqual(master.inputs(44, 2).exception_code, NO_ADDRESS)
        self.assertEqual(master.holding(1001, 2).exception_code, NO_ADDRESS)
        self.assertEqual(master.write(38, 1).exception_code, NO_ADDRESS)
        self.assertEqual(master.holding(6, 2).exception_code, NOT_KNOWN)  # the table has no set-points
        for unit in (2, 9, 247):
            wrong = self.connect(master.port, unit=unit)
            self.assertEqual(wrong.inputs(0).exception_code, NOT_KNOWN)
            self.assertEqual(wrong.coil(1).exception_code, NOT_KNOWN)
            self.assertEqual(wrong.write(COMMAND, STOP, 1).exception_code, NOT_KNOWN)
        self.assertTrue(master.status(RUNNING))

    def test_one_operates_and_all_stop(self):
        master = self.master()
        other = self.connect(master.port)
        self.assertFalse(master.write(FORCE_INPUTS, 0x2000).isError())
        self.assertEqual(other.write(FORCE_INPUTS, 0x2020).exception_code, REFUSED)
        self.assertEqual(other.words(RESULT), [SEAT_TAKEN])
        self.assertEqual((master.words(17), other.words(17)), ([1], [0]))
        self.assertFalse(other.coil(1).isError())
        self.assertTrue(other.status(IS_SAFE))
        master.client.close()
        until(lambda: not other.write(FORCE_INPUTS, 0x2020).isError(), "the seat")

    def test_every_address_is_answered(self):
        """All 65,536 of each kind but the motor's window, one by one; those that exist are those of the map."""
        master = self.master()
        window = range(1000, 1512)
        for function, highest in ((1, 7), (2, 15), (3, 5), (4, 999)):
            addresses = [at for at in range(65_536) if function != 3 or at not in window]
            with socket.create_connection(("127.0.0.1", master.port)) as line:
                line.settimeout(LONG)
                stream = line.makefile("rb")
                good = []
                for first in range(0, len(addresses), 200):
                    some = addresses[first:first + 200]
                    line.sendall(b"".join(struct.pack(">HHHBBHH", at, 0, 6, 1, function, at, 1) for at in some))
                    for at in some:
                        number, _, length, _, answered = struct.unpack(">HHHBB", stream.read(8))
                        self.assertEqual((number, answered & 0x7F), (at, function))
                        rest = stream.read(length - 2)
                        if answered == function:
                            good.append(at)
                        else:
                            self.assertIn(rest[0], (NO_ADDRESS, NOT_KNOWN))
            self.assertTrue(good)
            self.assertLessEqual(max(good), highest)
        self.assertTrue(master.status(RUNNING))

    def test_mbpoll_reads_it(self):
        port = self.serve()
        master = self.connect(port)
        until(lambda: master.status(RUNNING), "running")
        shown = subprocess.run(["mbpoll", "-m", "tcp", "-a", "1", "-0", "-t", "3", "-r", "0", "-c", "3", "-1", "-p", str(port),
                                "127.0.0.1"], capture_output=True, text=True, check=True, timeout=LONG).stdout
        self.assertRegex(shown, r"\[0\]:\s+1\n\[1\]:\s+\d+.*\n\[2\]:\s+2\n")

    def test_misuse_disturbs_nobody(self):
        master = self.master()
        port = master.port
        seed = random.randrange(2**32)
        chance = random.Random(seed)
        crowd = [socket.create_connection(("127.0.0.1", port)) for _ in range(40)]
        request = struct.pack(">HHHBBHH", 1, 0, 6, 1, 4, 0, 45)
        for number, one in enumerate(crowd):
            try:
                if number % 4 == 0:
                    one.sendall(request[:-3])  # half a frame
                elif number % 4 == 1:
                    one.sendall(bytes(chance.randrange(256) for _ in range(500)))
                elif number % 4 == 2:
                    one.setblocking(False)
                    one.send(request * 5000)  # and never takes an answer
                else:
                    one.sendall(struct.pack(">HHHBB", 1, 0, 2, 1, chance.randrange(128)))
            except OSError:
                pass  # it was turned away
        other = self.connect(port)
        for _ in range(50):
            self.assertTrue(other.status(RUNNING), f"seed {seed}")
        self.assertFalse(other.coil(1).isError())
        self.assertTrue(other.status(IS_SAFE))
        for one in crowd:
            one.close()

    def test_frames_in_pieces_and_together(self):
        port = self.serve()
        until(lambda: self.connect(port).status(RUNNING), "running")
        with socket.create_connection(("127.0.0.1", port)) as line:
            line.settimeout(LONG)
            first = struct.pack(">HHHBBHH", 0x1603, 0, 6, 1, 4, 0, 1)
            second = struct.pack(">HHHBBHH", 2, 0, 6, 1, 4, 2, 1)
            for byte in first:
                line.sendall(bytes([byte]))
            line.sendall(second + struct.pack(">HHHBB", 3, 0, 2, 1, 0x63))
            stream = line.makefile("rb")
            self.assertEqual(stream.read(11), struct.pack(">HHHBBBH", 0x1603, 0, 5, 1, 4, 2, 1))
            self.assertEqual(stream.read(11), struct.pack(">HHHBBBH", 2, 0, 5, 1, 4, 2, 2))
            self.assertEqual(stream.read(9), struct.pack(">HHHBBB", 3, 0, 3, 1, 0x63 | 0x80, NO_FUNCTION))


class Served(service_case.ServiceCase):
    def connect(self, port):
        master = Master(port)
        self.addCleanup(master.client.close)
        return master

    def begin(self, settings="", more=""):
        self.plug_in()
        config = self.write(self.axis(table=self.table, more=more), service=f'[modbus]\nlisten = "tcp:127.0.0.1:0"\n{settings}')
        service = self.start(config, wait_for="Modbus: listens")
        return service, self.connect(port_of(service.said().partition("Modbus: listens")[2]))

    def test_the_service_serves_a_plc(self):
        service, master = self.begin()
        until(lambda: master.status(RUNNING), "running")
        self.assertFalse(master.coil(2).isError())
        self.assertEqual(self.ctl("status")["safe_reason"], "safe command")
        self.assertEqual(master.words(9), [8])
        self.assertEqual(self.end(service), 0)

    def test_words_low_first(self):
        _, master = self.begin('word_order = "low_first"')
        until(lambda: not master.inputs(38, 2).isError(), "the table")
        low, high = master.words(38, 2)
        with open(self.table, "rb") as table:
            self.assertEqual(high << 16 | low, zlib.crc32(table.read()))

    def test_a_silent_master_stops_the_machine(self):
        _, master = self.begin('on_silence = "stop"\nsilence = 1000')
        until(lambda: master.status(RUNNING), "running")
        self.assertFalse(master.write(FORCE_INPUTS, 0x2000).isError())
        watcher = self.connect(master.port)
        for _ in range(5):
            self.assertTrue(master.status(RUNNING))
        master.client.close()
        until(lambda: watcher.words(9) == [2], "the stop")

    def test_what_waited_too_long_starts_nothing(self):
        service, master = self.begin()
        until(lambda: master.status(RUNNING), "running")
        self.assertFalse(master.write(COMMAND, STOP, 0).isError())
        request = struct.pack(">HHHBBHHBHH", 1, 0, 11, 1, 16, 0, 2, 4, RUN, 1)
        with socket.create_connection(("127.0.0.1", master.port)) as late:
            late.settimeout(1.6)
            halt(service.process.pid)
            late.sendall(request)
            with self.assertRaises(TimeoutError):
                late.recv(1)
            service.process.send_signal(signal.SIGCONT)
            late.settimeout(LONG)
            self.assertEqual(len(late.makefile("rb").read(12)), 12)
        self.assertEqual(master.words(DONE_NUMBER, 2), [1, TOO_LATE])
        self.assertTrue(master.status(IS_SAFE))

    def test_who_has_gone_starts_nothing(self):
        _, master = self.begin()
        until(lambda: master.status(RUNNING), "running")
        for number in range(1, 30):
            self.assertFalse(master.write(COMMAND, STOP, 0).isError())
            with socket.create_connection(("127.0.0.1", master.port)) as gone:
                gone.sendall(struct.pack(">HHHBBHHBHH", 1, 0, 11, 1, 16, 0, 2, 4, RUN, number))
                gone.shutdown(socket.SHUT_WR)
                gone.settimeout(LONG)
                gone.makefile("rb").read()
            self.assertTrue(master.status(IS_SAFE) or master.words(DONE_NUMBER, 2) == [number, 0])

    def test_local_is_local(self):
        _, master = self.begin(more='[axis.control]\nfrom = "local"\n')
        until(lambda: master.status(RUNNING), "running")
        self.assertEqual(master.write(FORCE_INPUTS, 0x2020).exception_code, REFUSED)
        self.assertEqual(master.words(RESULT, 2), [SEAT_TAKEN, 1])
        self.assertFalse(master.coil(1).isError())
        self.assertTrue(master.status(IS_SAFE))
        self.ctl("run")

    def test_mistakes_are_named_and_the_place_is_told(self):
        config = self.write(self.axis(), service='[modbus]\nlisten = "tcp:plc:502"\nword_order = "x"')
        checked = subprocess.run([service_case.NANOPLC, "check-config", "--no-devices", config], capture_output=True, text=True,
                                 check=False)
        self.assertEqual(checked.returncode, 2)
        self.assertIn("modbus.listen: plc is no address", checked.stderr)
        self.assertIn("modbus.word_order", checked.stderr)
        config = self.write(self.axis(), service='[modbus]\nlisten = "tcp:127.0.0.1:1502"')
        checked = subprocess.run([service_case.NANOPLC, "check-config", "--no-devices", config], capture_output=True, text=True,
                                 check=False)
        self.assertEqual(checked.returncode, 0, checked.stderr)
        self.assertIn("Modbus TCP listens at tcp:127.0.0.1:1502", checked.stdout)

    def units(self, *axes, modbus='listen = "tcp:127.0.0.1:1502"'):
        """What check-config says of axes, each a name and its unit: exit code, mistakes and warnings, {axis: unit} of each face."""
        written = [self.axis(name=name).replace("table =", f"modbus_unit = {unit}\ntable =" if unit else "table =")
                   .replace(self.path("motor"), self.path("motor" + name)) for name, unit in axes]
        config = self.write(*written, service=f"[modbus]\n{modbus}")
        checked = subprocess.run([service_case.NANOPLC, "check-config", "--no-devices", config], capture_output=True, text=True, check=False)
        return (checked.returncode, checked.stderr.splitlines(),
                [dict(re.findall(r"axis (\w+) is unit (\d+)", line)) for line in checked.stdout.splitlines() if line.startswith("Modbus ")])

    def test_an_axis_keeps_its_unit_when_another_is_removed(self):
        both = 'listen = "tcp:127.0.0.1:1502"\nrtu_port = "pty:/tmp/plc"\nrtu_unit = 10'
        self.assertEqual(self.units(("x", 0), modbus=both), (0, [], [{"x": "1"}, {"x": "10"}]))
        self.assertEqual(self.units(("x", 7), ("y", 3), modbus=both), (0, [], 2 * [{"x": "7", "y": "3"}]))
        self.assertEqual(self.units(("y", 3), modbus=both), (0, [], 2 * [{"y": "3"}]))
        code, (warning,), units = self.units(("x", 0), ("y", 4), ("z", 0), modbus=both)
        self.assertEqual((code, units), (0, [{"x": "1", "y": "4", "z": "3"}, {"x": "10", "y": "4", "z": "12"}]))
        self.assertIn("axis: warning: x, z have no modbus_unit: ", warning)

    def test_units_by_place_are_told_at_the_start_too(self):
        service = self.start(self.write(self.axis(), self.axis(name="y", motor="motory"), service='[modbus]\nlisten = "tcp:127.0.0.1:0"'))
        self.assertRegex(service.said(), r"configuration, line \d+: axis: x, y have no modbus_unit: ")

    def test_a_unit_has_one_axis(self):
        code, mistakes, _ = self.units(("x", 3), ("y", 3))
        self.assertEqual(code, 2)
        self.assertRegex(mistakes[0], r": axis\[y\]\.modbus_unit: 3 is used twice: axis\[x\]\.modbus_unit in line \d+ has it already$")
        # The second axis is unit 2 by its place.
        code, mistakes, _ = self.units(("x", 2), ("y", 0))
        self.assertEqual(code, 2)
        self.assertRegex(mistakes[0], r": axis\[x\]\.modbus_unit: 2 is used twice: axis y in line \d+ has it on Modbus TCP by its place; ")
        for unit, code in ((248, 2), (247, 0), (-1, 2)):
            self.assertEqual(self.units(("x", unit))[0], code, unit)

    def test_the_map_is_csv(self):
        text = subprocess.run([service_case.NANOPLC, "modbus-map"], capture_output=True, text=True, check=True).stdout
        rows = list(csv.DictReader(io.StringIO(text)))
        self.assertEqual(list(rows[0]), ["address", "block", "name", "type", "words", "scale", "unit", "range", "meaning", "access"])
        self.assertEqual(len({row["name"] for row in rows}), len(rows))
        taken = set()
        for row in rows:
            for word in range(int(row["words"])):
                place = (row["block"], int(row["address"]) + word)
                self.assertNotIn(place, taken)
                taken.add(place)


if __name__ == "__main__":
    (SIM, service_case.NANOPLC, service_case.MACSIM, service_case.NANOCTL, service_case.SEQC, SHUTTLE,
     service_case.MENDING, EXAMPLES) = sys.argv[1:9]
    unittest.main(argv=[sys.argv[0], *sys.argv[9:]])
