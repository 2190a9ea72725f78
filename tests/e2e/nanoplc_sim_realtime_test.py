#!/usr/bin/env python3
"""What of nanoplc-sim is in real time, on a terminal, or large: keys and signals, lines that fit, memory.

usage: nanoplc_sim_realtime_test.py NANOPLC_SIM
"""

import fcntl
import os
import pty
import re
import select
import signal
import struct
import subprocess
import sys
import termios
import time
import unittest

import nanoplc_sim_test
from nanoplc_sim_test import TRACE_HEADER, Case

MANY = """PROGRAM Many
MOTOR MAC140;
VAR_MOTOR Slow AT V1 := 10 rpm; Fast AT V2 := 20 rpm; END_VAR
ON ERROR NEXT := Fault;
POWER_UP INIT(Slow); INIT(Fast); NEXT := A; END_POWER_UP
STEP A: VELOCITY(Slow); NEXT := B; END_STEP
STEP B: VELOCITY(Fast); NEXT := A; END_STEP
STEP Fault: OWN ERROR; END_STEP
END_PROGRAM
"""


class LongRuns(Case):
    def run_many(self, length, *options):
        """Orders without a pause for so long: its output at the end, and its memory in KiB."""
        # What a sanitizer keeps of freed memory is not the program's.
        environment = {**os.environ, "ASAN_OPTIONS": os.environ.get("ASAN_OPTIONS", "") + ":quarantine_size_mb=0"}
        with open(self.path("said"), "w+", encoding="utf-8") as said:
            process = subprocess.Popen([nanoplc_sim_test.PROGRAM, "run", self.put("many.seq", MANY), "--quiet", "--baud", "115200", "--for", length,
                                        *options], stdin=subprocess.DEVNULL, stdout=said, stderr=subprocess.DEVNULL, env=environment)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            self.assertEqual(process.returncode, 0)
            said.seek(0)
            return said.read(), usage.ru_maxrss

    def test_a_million_orders_are_compared_in_the_memory_of_a_few(self):
        _, few = self.run_many("10s")
        text, many = self.run_many("400s")
        self.assertGreater(int(re.search(r"orders: (\d+) executed", text).group(1)), 1_000_000)
        self.assertIn("the motor executed what was ordered, and nothing else", text)
        self.assertNotIn("not executed:", text)
        self.assertLess(many, few + 1024)

    def test_a_disturbed_line_does_not_cost_memory_either(self):
        _, few = self.run_many("2s", "--damage", "1%", "--rapid")
        text, many = self.run_many("60s", "--damage", "1%", "--rapid")
        self.assertRegex(text, r"executed and not ordered: .* and \d+ more")
        self.assertLess(many, few + 2048)


class Realtime(Case):
    def test_without_a_terminal_there_are_no_keys(self):
        begin = time.monotonic()
        done = self.call("run", self.table, "--realtime", "--for", "300ms", stdin=b"q")
        self.assertEqual(done.returncode, 0)
        self.assertGreaterEqual(time.monotonic() - begin, 0.3)
        self.assertIn("ended at 300.000 ms", done.stdout.decode())

    def test_keys_toggle_inputs_and_q_ends(self):
        terminal, end = pty.openpty()
        with subprocess.Popen([nanoplc_sim_test.PROGRAM, "run", self.table, "--realtime", "--for", "60s"], stdin=end, stdout=end,
                              stderr=end, close_fds=True) as process:
            os.close(end)
            shown = self.read_until(terminal, b"link up")
            self.assertIn(b"keys: 0 IN0, 1 IN1, 2 IN2, 3 IN3, 4 IN4, 5 IN5; q ends", shown)
            shown += self.read_until(terminal, b" rev)")
            status = next(part for part in shown.split(b"\r\x1b[K") if part.endswith(b" rev)"))
            self.assertTrue(status.startswith(b"q ends, 0-5 toggle: 000000 | "), status)
            self.assertLess(len(status), 80)
            os.write(terminal, b"3")
            shown += self.read_until(terminal, b"IN3 on")
            os.write(terminal, b"q")
            shown += self.read_until(terminal, b"ended at")
            self.assertEqual(process.wait(30), 0, shown)
        os.close(terminal)

    def read_until(self, terminal, wanted):
        shown = b""
        while wanted not in shown:
            block = os.read(terminal, 65536)
            self.assertTrue(block, shown)
            shown += block
        return shown

    def test_every_line_fits_a_narrow_terminal(self):
        scenario = self.put("fails.scn", b"expect at 100 ms IN0 and IN1 and IN2 and IN3 and IN4 and IN5 and OUT0 and OUT1\nend at 200 ms\n")
        terminal, end = pty.openpty()
        fcntl.ioctl(end, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 80, 0, 0))
        with subprocess.Popen([nanoplc_sim_test.PROGRAM, "run", self.table, "--scenario", scenario, "--trace", self.path("t.csv")], stdin=end,
                              stdout=end, stderr=end, close_fds=True) as process:
            shown = self.read_until(terminal, b"seen: ")
            self.assertEqual(process.wait(60), 1, shown)
        while select.select([terminal], [], [], 0)[0]:
            shown += os.read(terminal, 65536)
        os.close(end)
        os.close(terminal)
        lines = re.sub(r"\x1b\[[0-9;]*[mK]", "", shown.decode()).replace("\r", "").split("\n")
        self.assertGreater(len(lines), 8)
        self.assertEqual([line for line in lines if len(line) > 80], [])
        self.assertIn("watchdog resets", " ".join(" ".join(lines).split()))

    def test_a_quit_from_the_keyboard_puts_the_terminal_back(self):
        terminal, end = pty.openpty()
        before = termios.tcgetattr(end)
        with subprocess.Popen([nanoplc_sim_test.PROGRAM, "run", self.table, "--realtime", "--for", "60s"], stdin=end, stdout=end,
                              stderr=end, close_fds=True) as process:
            shown = self.read_until(terminal, b"link up")
            self.assertNotEqual(termios.tcgetattr(end), before)
            process.send_signal(signal.SIGQUIT)
            shown += self.read_until(terminal, b"ended at")
            self.assertEqual(process.wait(30), 0, shown)
        self.assertEqual(termios.tcgetattr(end), before)
        os.close(end)
        os.close(terminal)

    def test_an_interrupt_ends_in_good_order(self):
        with subprocess.Popen([nanoplc_sim_test.PROGRAM, "run", self.table, "--realtime", "--trace", self.path("t.csv")],
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE) as process:
            process.stdout.read1(1)  # it has begun
            process.send_signal(2)
            process.communicate(timeout=30)
            self.assertEqual(process.returncode, 0)
        self.assertTrue(self.read("t.csv").startswith(TRACE_HEADER))


if __name__ == "__main__":
    nanoplc_sim_test.PROGRAM = sys.argv.pop(1)
    unittest.main()
