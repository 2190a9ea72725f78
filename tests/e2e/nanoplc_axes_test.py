#!/usr/bin/env python3
"""nanoplc with several axes: what one of them lacks, or what is wrong with it, is its own.

usage: nanoplc_axes_test.py NANOPLC MACSIM NANOCTL MACREG SEQC MENDING.seq SLOW_LINE.so
"""

import os
import signal
import socket
import sys
import threading
import unittest

import service_case
from service_case import LONG, ServiceCase

SLOW_LINE = ""


class Wire:
    """Two terminals that are joined."""

    def __enter__(self):
        self.masters, self.slaves = zip(*(os.openpty() for _ in range(2)))
        self.ends = [os.ttyname(slave) for slave in self.slaves]
        for one, other in (self.masters, self.masters[::-1]):
            threading.Thread(target=self.carry, args=(one, other), daemon=True).start()
        return self

    @staticmethod
    def carry(source, target):
        try:
            while data := os.read(source, 4096):
                os.write(target, data)
        except OSError:
            pass  # closed

    def __exit__(self, *_):
        for descriptor in self.masters + self.slaves:
            os.close(descriptor)


class TwoAxes(ServiceCase):
    """`good` works and has to go on; `bad` has the trouble."""

    def setUp(self):
        super().setUp()
        self.plug_in("one")

    def start_both(self, *bad, **environment):
        self.config = self.write(self.axis("good", "one", table=self.table), *bad)
        service = self.start(self.config, **environment)
        self.moves("good")
        return service

    def bad(self, motor="two", **more):
        return self.axis("bad", motor, table=more.pop("table", self.table), **more)

    def read_config(self):
        with open(self.config, encoding="utf-8") as file:
            return file.read()

    def reason(self):
        status = self.ctl("status", port="bad")
        return status["state"], status["safe_reason"], status["outputs"]

    def expect_both_move(self):
        self.moves("good")
        self.moves("bad")

    def ends(self, service):
        self.moves("good")
        self.assertEqual(self.end(service), 0, service.said())


class OneIsWrong(TwoAxes):
    def test_a_stored_setting_that_the_table_does_not_fit(self):
        self.plug_in("two")
        service = self.start_both(self.bad())
        self.expect_both_move()
        self.ctl("stop", port="bad")
        self.ctl("settings", "set", "motor_is_mac800=1", "--keep", port="bad")
        self.ctl("reset", port="bad")
        self.assertEqual(self.reason(), ("stopped", "bad table", 0))
        self.assertIn("motor_is_mac800", service.said())
        self.ends(service)
        code, lines = self.check(self.read_config())
        self.assertEqual(code, 3, lines)
        self.assertTrue(any("axis[bad].table" in line and "motor_is_mac800" in line for line in lines), lines)
        service = self.start(self.config)
        self.moves("good")
        self.assertEqual(self.reason(), ("stopped", "bad table", 0))
        self.ctl("settings", "set", "motor_is_mac800=0", "--keep", port="bad")
        self.ctl("reset", port="bad")
        self.expect_both_move()
        self.assertEqual(self.check(self.read_config()), (0, []))
        self.ends(service)

    def test_a_stored_table_that_a_setting_does_not_fit(self):
        self.plug_in("two")
        service = self.start_both(self.bad(table="none"))
        self.ctl("upload", self.table, "--run", port="bad")
        self.moves("bad")
        self.ctl("stop", port="bad")
        self.ctl("settings", "set", "motor_is_mac800=1", "--keep", port="bad")
        self.ctl("reset", port="bad")
        self.assertEqual(self.reason(), ("stopped", "bad table", 0))
        code, lines = self.check(self.read_config())
        self.assertEqual(code, 3, lines)
        self.assertTrue(any("axis[bad]" in line and "the stored table" in line for line in lines), lines)
        self.ends(service)

    def test_a_configured_table_that_is_none(self):
        self.plug_in("two")
        for name, content in (("missing.bin", None), ("ragged.bin", b"\x00" * 12)):
            if content is not None:
                with open(self.path(name), "wb") as file:
                    file.write(content)
            service = self.start_both(self.bad(table=self.path(name)))
            self.assertEqual(self.reason(), ("stopped", "bad table", 0))
            self.assertIn("make it with `seqc build`", service.said())
            self.ctl("run", port="bad", exit_code=1)
            self.ends(service)
        service = self.start(self.config)
        self.ctl("upload", self.table, "--run", port="bad")
        self.expect_both_move()
        self.ends(service)

    def test_a_motor_whose_adapter_is_missing_at_the_start(self):
        service = self.start_both(self.bad())
        self.assertEqual(self.ctl("status", port="bad")["link"], "down")
        self.assertIn("bad: ", service.said())
        self.plug_in("two")
        self.until(lambda: "two is back" in service.said(), service)
        self.expect_both_move()
        self.ends(service)

    def test_a_can_interface_that_is_missing_at_the_start(self):
        axis = (f'[[axis]]\nname = "bad"\n[axis.motor]\nkind = "mac34-1"\ncan = "can97"\n[axis.user]\n'
                f'port = "unix:{self.path("bad")}"\n')
        service = self.start_both(axis)
        self.assertEqual(self.ctl("status", port="bad")["link"], "down")
        self.assertIn("bad: there is no interface 'can97'", service.said())
        self.ends(service)

    def test_the_motors_own_port_is_missing_at_the_start(self):
        self.plug_in("two")
        more = self.bad().replace("[axis.user]", f'mactalk_port = "{self.path("none")}"\n[axis.user]')
        service = self.start_both(more)
        self.moves("bad")
        self.assertIn("bad: " + self.path("none"), service.said())
        self.ends(service)

    def test_a_gpio_chip_that_is_not_there(self):
        self.plug_in("two")
        service = self.start_both(self.bad(more='[axis.outputs]\nOUT0 = "gpiochip97:3"\n'))
        self.assertEqual(self.reason(), ("stopped", "GPIO lines missing", 0))
        self.assertIn("bad: there is no /dev/gpiochip97", service.said())
        self.assertEqual(service.said().count("there is no /dev/gpiochip97"), 1, "told at every try")
        self.ctl("run", port="bad", exit_code=1)
        self.ctl("reset", port="bad")
        self.assertEqual(self.reason(), ("stopped", "GPIO lines missing", 0))
        self.assertEqual(self.mode("two"), "INIT_MODE")
        self.ends(service)

    def test_a_store_that_cannot_be_had_until_it_can(self):
        self.plug_in("two")
        self.write(self.axis("good", "one"), self.bad())
        os.rename(self.path("state/bad"), self.path("bad_store"))
        with open(self.path("state/bad"), "w", encoding="utf-8"):
            service = self.start_both(self.bad())
        self.assertEqual(self.reason(), ("stopped", "no store", 0))
        self.assertIn("name another state_directory", service.said())
        self.ctl("upload", self.table, port="bad", exit_code=1)
        self.ctl("run", port="bad", exit_code=1)
        os.remove(self.path("state/bad"))
        os.rename(self.path("bad_store"), self.path("state/bad"))
        self.expect_both_move()
        self.ends(service)
        with open(self.path("state/bad/running"), encoding="ascii") as marker:
            self.assertEqual(marker.read()[:5], "ended")

    def test_a_store_that_another_service_uses_stays_that_ones(self):
        self.plug_in("two")
        self.start(self.write(self.axis("bad", "two", port="unix:" + self.path("first"), table=self.table)))
        self.moves("first")
        service = self.start_both(self.bad(motor="three"))
        self.assertEqual(self.reason(), ("stopped", "no store", 0))
        self.assertIn("another program uses this memory", service.said())
        self.assertNotIn("are damaged", service.said())
        self.ends(service)
        self.assertTrue(os.path.exists(self.path("state/bad/running")), "the mark of the one that runs")
        self.moves("first")

    def test_a_users_socket_that_is_in_use_until_it_is_free(self):
        self.plug_in("two")
        with socket.socket(socket.AF_UNIX) as other:
            other.bind(self.path("bad"))
            other.listen()
            service = self.start_both(self.bad())
            self.assertIn("another program listens there", service.said())
            self.assertEqual(self.mode("two"), "INIT_MODE", "it runs and nobody could stop it")
        os.remove(self.path("bad"))
        self.until(lambda: os.path.exists(self.path("bad")), service)
        self.expect_both_move()
        self.ends(service)

    def test_a_crash_is_known_when_all_is_there_again(self):
        self.plug_in("two")
        with open(self.path("bad"), "w", encoding="utf-8"):
            service = self.start_both(self.bad())
        self.assertEqual(self.end(service, signal.SIGKILL), -signal.SIGKILL)
        service = self.start(self.config)
        self.assertEqual(self.ctl("status", port="good")["safe_reason"], "watchdog")
        os.remove(self.path("bad"))
        self.until(lambda: os.path.exists(self.path("bad")), service)
        self.assertEqual(self.reason(), ("stopped", "watchdog", 0))
        self.ctl("run", port="bad")
        self.moves("bad")
        self.assertEqual(self.end(service), 0, service.said())

    def test_the_common_watchdog_is_fed(self):
        place = self.path("notify")
        with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as manager:
            manager.bind(place)
            manager.settimeout(LONG)
            service = self.start_both(self.bad(more='[axis.outputs]\nOUT0 = "gpiochip97:3"\n'), NOTIFY_SOCKET=place,
                                      WATCHDOG_USEC="3000000")
            told = []
            while told.count("WATCHDOG=1") < 3:
                told += manager.recv(4096).decode().splitlines()
            self.assertTrue(any("bad stopped, incomplete" in line for line in told), told)
            self.ends(service)

    def test_a_users_adapter_that_comes_later(self):
        self.plug_in("two")
        service = self.start_both(self.bad(port=self.path("adapter")))
        master, slave = os.openpty()
        os.symlink(os.ttyname(slave), self.path("adapter"))
        self.until(lambda: "bad: the sequence runs" in service.said(), service)
        os.close(master)
        os.close(slave)
        self.ends(service)

    def test_a_stored_speed_that_the_users_adapter_cannot_do(self):
        self.plug_in("two")
        with Wire() as wire:
            service = self.start_both(self.bad(port=wire.ends[0]), LD_PRELOAD=SLOW_LINE, ASAN_OPTIONS="verify_asan_link_order=0")
            self.ctl("stop", port=wire.ends[1])
            self.ctl("settings", "set", "user_baud=921600", "--keep", port=wire.ends[1])
            self.ctl("reset", port=wire.ends[1])
            self.until(lambda: "cannot do 921600 baud" in service.said(), service)
            self.assertEqual(self.ctl("status", port=wire.ends[1])["state"], "running")
            self.ends(service)


if __name__ == "__main__":
    (service_case.NANOPLC, service_case.MACSIM, service_case.NANOCTL, service_case.MACREG, service_case.SEQC, service_case.MENDING,
     SLOW_LINE) = sys.argv[1:8]
    unittest.main(argv=sys.argv[:1] + sys.argv[8:])
