#!/usr/bin/env python3
"""nanoplc as a service on this machine: real terminals, virtual motors on them, no GPIO.

usage: nanoplc_test.py NANOPLC MACSIM NANOCTL MACREG SEQC MENDING.seq EXAMPLE.toml SLOW_DISK.so
"""

import contextlib
import grp
import os
import re
import signal
import socket
import stat
import subprocess
import sys
import threading
import time
import unittest

import service_case
from device_case import Terminal
from macsim_test import read_request, value_in
from patience import until
from service_case import LONG, ServiceCase

EXAMPLE = SLOW_DISK = ""


class Running(ServiceCase):
    def test_upload_run_and_an_orderly_end(self):
        self.plug_in()
        service = self.start(self.write(self.axis()))
        self.assertEqual(self.ctl("status")["state"], "stopped")
        self.ctl("upload", self.table, "--run")
        self.moves()
        self.assertEqual(self.end(service), 0, service.said())
        self.assertIn("ends: Terminated", service.said())
        self.assertIn("x: the sequence runs", service.said())
        self.assertNotIn("has not taken the stop", service.said())
        self.assertEqual(self.mode(), "INIT_MODE", "the motor has not been told to stop")

    def test_every_end_signal_is_an_orderly_end(self):
        self.plug_in()
        for how in (signal.SIGINT, signal.SIGHUP, signal.SIGQUIT):
            service = self.start(self.write(self.axis()))
            self.assertEqual(self.end(service, how), 0, service.said())

    def test_after_an_orderly_end_the_stored_table_runs_by_itself(self):
        self.plug_in()
        config = self.write(self.axis())
        service = self.start(config)
        crc = self.ctl("upload", self.table)["crc32"]
        self.end(service)
        self.start(config)
        self.moves()
        self.assertEqual(self.ctl("status")["table_crc32"], crc)

    def test_killed_in_mid_sequence_it_keeps_its_table_and_waits(self):
        self.plug_in()
        config = self.write(self.axis())
        service = self.start(config)
        crc = self.ctl("upload", self.table, "--run")["crc32"]
        self.moves()
        self.end(service, signal.SIGKILL)
        again = self.start(config)
        status = self.ctl("status")
        self.assertEqual((status["state"], status["safe_reason"], status["table_crc32"]), ("stopped", "watchdog", crc))
        self.assertIn("did not end in order", again.said())
        self.ctl("run")
        self.moves()

    def test_a_crash_is_no_orderly_end(self):
        self.plug_in()
        config = self.write(self.axis())
        service = self.start(config)
        self.assertEqual(self.end(service, signal.SIGSEGV), -signal.SIGSEGV)
        self.start(config)
        self.assertEqual(self.ctl("status")["safe_reason"], "watchdog")

    def test_the_configured_table_runs_while_none_is_stored(self):
        self.plug_in()
        self.start(self.write(self.axis(table=self.table)))
        self.moves()
        self.assertEqual(self.ctl("status")["stored_bytes"], 0)

    def test_a_slow_disk_does_not_part_motor_and_gateway(self):
        self.plug_in()
        service = self.start(self.write(self.axis(table=self.table)), LD_PRELOAD=SLOW_DISK,
                             ASAN_OPTIONS="verify_asan_link_order=0")
        self.moves()
        before = self.ctl("status")
        begun = time.monotonic()
        crc = self.ctl("upload", self.table, "--only-store")["crc32"]
        # Five erasures, the table in one piece, header and mark: each would have been silence of 300 ms.
        self.assertGreater(time.monotonic() - begun, 8 * 0.3, "the disk was not slow")
        status = self.ctl("status")
        self.assertLess(status["link_losses"] - before["link_losses"], 4, service.said())
        self.moves()
        self.end(service)
        self.start(self.write(self.axis()))
        self.assertEqual(self.ctl("status")["table_crc32"], crc)

    def test_a_reset_over_the_port(self):
        self.plug_in()
        self.start(self.write(self.axis()))
        self.ctl("upload", self.table)
        self.ctl("reset")
        self.moves()

    def test_a_reset_does_not_forget_a_stop_that_is_not_confirmed(self):
        self.plug_in()
        service = self.start(self.write(self.axis()))
        self.ctl("upload", self.table, "--run")
        self.moves()
        self.pull_out()
        self.ctl("stop", exit_code=4)
        self.ctl("reset")
        self.until(lambda: "reset over the user's port" in service.said(), service)
        status = self.ctl("status")
        self.assertEqual((status["state"], status["stop_unconfirmed"]), ("stopped", True), service.said())
        self.ctl("run", exit_code=1)
        self.plug_in()
        self.until_status(lambda status: not status["stop_unconfirmed"] and status["link"] != "down")
        self.assertEqual(self.ctl("status")["state"], "stopped")
        self.ctl("run")
        self.moves()

    def test_a_stop_by_macreg_that_the_motor_does_not_confirm(self):
        self.plug_in()
        self.start(self.write(self.axis()))
        self.ctl("upload", self.table, "--run")
        self.moves()
        self.pull_out()
        self.until_status(lambda status: status["link"] == "down")
        stop = subprocess.run([service_case.MACREG, "--port", "unix:" + self.path("x"), "--patience", "300", "--address", "254", "set",
                               "MODE_REG", "INIT_MODE"], capture_output=True, text=True, timeout=LONG, check=False)
        self.assertEqual(stop.returncode, 4, stop.stderr)
        self.assertIn("the motor may be moving", stop.stderr)
        self.assertNotIn("MAC800", stop.stderr)

    def test_stored_settings_go_before_the_configuration(self):
        self.plug_in()
        config = self.write(self.axis(more="[axis.settings]\ndebounce = 5000\nautostart = false\n"))
        service = self.start(config)
        self.ctl("upload", self.table)
        self.ctl("settings", "set", "debounce=4000", "--keep")
        self.end(service)
        service = self.start(config)
        self.assertIn("setting debounce is 4000", service.said())
        self.assertIn("5000 is not used", service.said())
        self.assertEqual(self.ctl("status")["state"], "stopped", "autostart = false")

    def test_the_motors_adapter_is_pulled_out_and_comes_back(self):
        self.plug_in()
        service = self.start(self.write(self.axis()))
        self.ctl("upload", self.table, "--run")
        self.moves()
        self.pull_out()
        self.until(lambda: "motor is gone" in service.said(), service)
        status = self.until_status(lambda status: status["link"] == "down")
        self.assertEqual((status["safe_reason"], status["outputs"]), ("link down", 0))
        self.plug_in()
        self.until(lambda: "motor is back" in service.said(), service)
        self.moves()

    def test_two_axes_know_nothing_of_each_other(self):
        self.plug_in("one")
        self.plug_in("two")
        service = self.start(self.write(self.axis("a", "one"), self.axis("b", "two")))
        for port in "ab":
            self.ctl("upload", self.table, "--run", port=port)
            self.moves(port)
        self.ctl("stop", port="a")
        self.assertEqual(self.ctl("status", port="b")["state"], "running")
        self.ctl("run", port="a")
        self.pull_out("two")
        self.until(lambda: "two is gone" in service.said(), service)
        self.moves("a")
        self.assertEqual(self.end(service), 0)
        self.assertTrue(os.path.isfile(self.path("state/a/store.bin")))
        self.assertTrue(os.path.isfile(self.path("state/b/store.bin")))


class Ports(ServiceCase):
    def test_a_serial_port_for_the_user(self):
        self.plug_in()
        master, slave = os.openpty()
        self.start(self.write(self.axis(port=os.ttyname(slave))))
        # Register 1 of the gateway, address 128: "NPLG".
        os.write(master, read_request(128, 1))
        answer = b""
        while len(answer) < 19:
            answer += os.read(master, 64)
        self.assertEqual(value_in(answer), 0x474C504E)
        os.close(master)
        os.close(slave)

    def test_a_pseudo_terminal_and_several_clients_of_a_socket(self):
        self.plug_in("one")
        self.plug_in("two")
        self.start(self.write(self.axis("a", "one", port="pty:" + self.path("pty")), self.axis("b", "two")))
        self.assertEqual(self.ctl("status", port=self.path("pty"))["state"], "stopped")
        with subprocess.Popen([service_case.NANOCTL, "--port", "unix:" + self.path("b"), "--patience", "2000", "watch"],
                              stdout=subprocess.PIPE, text=True) as watch:
            self.assertIn("stopped", watch.stdout.readline())
            self.ctl("upload", self.table, "--run", port="b")
            self.assertTrue(any("running" in line for line in watch.stdout), "it ended before")
            watch.terminate()

    def test_a_client_that_sends_nonsense_disturbs_nobody(self):
        self.plug_in()
        self.start(self.write(self.axis(port="pty:" + self.path("pty"))))
        terminal = Terminal(self.path("pty"))
        terminal.send(bytes(range(256)) * 8)
        terminal.close()
        self.assertEqual(self.ctl("status", port=self.path("pty"))["state"], "stopped")


class Faces(ServiceCase):
    def test_a_panel_that_cannot_listen_says_what_to_do(self):
        """192.0.2.0/24 is for documents (RFC 5737)."""
        secret = self.put("secret", "secret0123456789secret\n")
        os.chmod(secret, 0o600)
        with socket.create_server(("127.0.0.1", 0)) as other:
            taken = f"127.0.0.1:{other.getsockname()[1]}"
            for place, said in ((taken, "another program listens there, and `ss -ltnp` as root names it; end it, or write another port"),
                                ("192.0.2.7:8080", "this machine has no such address now; write one that `ip -br address` lists")):
                config = self.write(self.axis(), service=f'[panel]\nlisten = "{place}"\npassword_file = "{secret}"\ntoken_file = "{secret}"\n')
                service = self.start(config)
                self.assertRegex(service.said(), f"no panel: cannot listen at {place.replace(':', ' port ')}: .*; {said}")
                self.assertEqual(self.end(service), 0)


class Refusing(ServiceCase):
    def test_every_mistake_is_named_at_once(self):
        code, lines = self.check("""[service]
log_levle = "info"
real_time_priority = 120
lock_memory = "yes"
[[axis]]
name = "X Axis"
[axis.motor]
prot = "/dev/ttyUSB0"
[axis.inputs]
IN0 = "gpiochip0:17"
IN1 = {line = "/dev/gpiochip0:17", active_lo = true}
[axis.settings]
debounce = "3 ms"
motor_baud = 19201
[[axis]]
name = "y"
[axis.motor]
port = "/dev/ttyS0"
[axis.user]
port = "/dev/ttyS0"
[axis.outputs]
OUT2 = {active_low = true}
[[axis]]
name = "y"
[axis.motor]
port = "/dev/ttyS1"
[axis.user]
port = "tcp:0.0.0.0:2000"
""", "--no-devices")
        self.assertEqual(code, 2)
        expected = [
            (2, "service.log_levle", "did you mean log_level?"),
            (3, "service.real_time_priority", "120 is out of range; write a whole number from 0 to 99"),
            (4, "service.lock_memory", "is a text; write true or false"),
            (6, "axis[X Axis].name", "small letters"),
            (7, "axis[X Axis].motor.port", "is missing"),
            (8, "axis[X Axis].motor.prot", "did you mean port?"),
            (11, "axis[X Axis].inputs.IN1.active_lo", "did you mean active_low?"),
            (11, "axis[X Axis].inputs.IN1", "used twice: axis[X Axis].inputs.IN0 in line 10"),
            (13, "axis[X Axis].settings.debounce", "is a text; write a whole number from 0 to 1000000"),
            (14, "axis[X Axis].settings.motor_baud", "no standard speed"),
            (20, "axis[y].user.port", "/dev/ttyS0 is used twice: axis[y].motor.port in line 18"),
            (22, "axis[y].outputs.OUT2", "names no line"),
            (23, "axis.name", "y is used twice"),
            (28, "axis[y].user.port", "open to the network"),
        ]
        self.assertEqual(len(lines), len(expected), "\n".join(lines))
        for line, (number, key, text) in zip(lines, expected):
            self.assertTrue(line.startswith(f"{number}: {key}: "), f"{line} is not of {number}: {key}")
            self.assertIn(text, line)

    def test_whose_a_socket_is(self):
        axis = '[[axis]]\nname = "x"\n[axis.motor]\nport = "/dev/null"\n[axis.user]\nport = "{}"\n{}\n'
        for port, key, text in (("unix:/tmp/x", 'socket_mode = "660"', "is no mode"),
                                ("unix:/tmp/x", 'socket_mode = "04755"', "is no mode"),
                                ("tcp:127.0.0.1:2000", 'socket_mode = "0660"', "is for a port unix:PATH"),
                                ("pty:/tmp/x", 'socket_group = "root"', "is for a port unix:PATH")):
            code, lines = self.check(axis.format(port, key), "--no-devices")
            self.assertEqual((code, len(lines)), (2, 1), lines)
            self.assertIn(f"7: axis[x].user.{key.split()[0]}: {text}", lines[0])
        _, lines = self.check(axis.format("unix:/tmp/x", 'socket_group = "nosuchgroup"'))
        self.assertTrue(any("7: axis[x].user.socket_group: there is no group nosuchgroup" in line for line in lines), lines)

    def test_a_socket_has_the_mode_and_the_group_of_the_configuration(self):
        self.plug_in()
        group = next(group for group in grp.getgrall() if group.gr_gid in os.getgroups() + [os.getgid()])
        keys = f'"\nsocket_mode = "0600"\nsocket_group = "{group.gr_name}'
        self.start(self.write(self.axis(port="unix:" + self.path("x") + keys)))
        status = os.stat(self.path("x"))
        self.assertEqual((stat.S_IMODE(status.st_mode), status.st_gid), (0o600, group.gr_gid))
        self.assertEqual(self.ctl("status")["state"], "stopped")

    def test_a_password_is_for_sockets(self):
        axis = '[[axis]]\nname = "x"\n[axis.motor]\nport = "/dev/null"\n[axis.user]\nport = "{}"\npassword_file = "{}"\n'
        code, lines = self.check(axis.format("pty:/tmp/x", "/tmp/secret"), "--no-devices")
        self.assertEqual((code, len(lines)), (2, 1), lines)
        self.assertIn("7: axis[x].user.password_file: is for a port unix:PATH or tcp:", lines[0])
        short = self.secret("short")
        for file, why in ((short, "its first line must be a secret of 12 to 128 characters"),
                          ("/no/such/file", "No such file or directory")):
            _, lines = self.check(axis.format("unix:/tmp/x", file))
            self.assertIn(f"7: axis[x].user.password_file: {file}: {why}", lines)

    def secret(self, text):
        path = self.path("secret." + text.split()[0])
        with open(path, "w", encoding="utf-8") as file:
            file.write(text + "\n")
        return path

    def test_a_port_with_a_password(self):
        """Without it one reads and stops; with it one changes, by nanoctl and by macreg; a wrong one is refused and reported."""
        self.plug_in()
        right, wrong = self.secret("correct horse battery"), self.secret("wrong horse battery")
        service = self.start(self.write(self.axis(port=f'unix:{self.path("x")}"\npassword_file = "{right}')))
        self.assertEqual(self.ctl("status")["state"], "stopped")
        self.assertIn("--password-file", self.ctl("settings", "set", "debounce=5000", exit_code=1)["error"])
        self.assertEqual(self.ctl("settings", "get", "debounce")["settings"]["debounce"], 3000)
        self.ctl("stop")
        refused = self.ctl("--password-file", wrong, "settings", "set", "debounce=5000", exit_code=1)
        self.assertIn(f"the password of {wrong} is not this port's", refused["error"])
        self.until(lambda: "a wrong password was given" in service.said())
        self.ctl("--password-file", wrong, "stop")
        self.ctl("--password-file", right, "settings", "set", "debounce=5000")
        self.assertEqual(self.ctl("settings", "get", "debounce")["settings"]["debounce"], 5000)
        macreg = [service_case.MACREG, "--port", "unix:" + self.path("x"), "--patience", "300", "--json", "set", "V_SOLL=100"]
        told = subprocess.run(macreg, capture_output=True, text=True, check=False)
        self.assertEqual(told.returncode, 1, told.stdout)
        self.assertIn("this port takes changes only from who has given its password", told.stdout)
        done = subprocess.run(macreg, capture_output=True, text=True, check=False,
                              env={**os.environ, "MACREG_PASSWORD_FILE": right})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_a_port_whose_password_cannot_be_read_is_not_opened(self):
        self.plug_in()
        missing = self.path("later")
        service = self.start(self.write(self.axis(port=f'unix:{self.path("x")}"\npassword_file = "{missing}')))
        self.assertIn(f"no user's port: {missing}: No such file or directory", service.said())
        self.assertFalse(os.path.exists(self.path("x")))
        os.rename(self.secret("correct horse battery"), missing)
        self.until(lambda: os.path.exists(self.path("x")))
        self.assertEqual(self.ctl("status")["state"], "stopped")

    def test_what_is_no_toml_has_a_line(self):
        code, lines = self.check('[service]\nlog_level = "info\n')
        self.assertEqual((code, len(lines)), (2, 1))
        self.assertTrue(lines[0].startswith("2: this is not TOML"), lines)

    def test_a_missing_device_and_a_missing_file(self):
        code, lines = self.check('[[axis]]\nname = "x"\ntable = "/no/table.bin"\n[axis.motor]\nport = "/dev/no-such-port"\n')
        self.assertEqual(code, 3)
        self.assertIn("3: axis[x].table: there is no file /no/table.bin", lines[0])
        self.assertIn("5: axis[x].motor.port: there is no /dev/no-such-port; plug the adapter in", lines[1])

    def test_a_table_in_intel_hex(self):
        # C0h 01h 01h 01h 80h 05h 00 00 (001 §6.1.5) makes 148h with its length 08h: checksum 100h - 50h = B0h.
        term, end = ":08000000C001010180050000B0", ":080008003F00000000000000B1"
        wrong = {
            "whole": (f"{term}\n{end}\n:00000001FF\n", None),
            "cut": (f"{term}\n{end}\n", ":2: the end record (:00000001FF) is missing"),
            "damaged": (f"{term[:-1]}1\n{end}\n:00000001FF\n", ":1: the checksum is B1 where the record makes B0"),
            "no_end": (f"{term}\n:00000001FF\n", ": term 1: "),
            "more": (f"{term}\n{end}\n:01001000AA45\n:00000001FF\n", ": term 1 ends the table and 1 bytes follow it"),
        }
        self.plug_in()
        for name, (text, complaint) in wrong.items():
            table = self.path(name + ".hex")
            with open(table, "w", encoding="ascii") as file:
                file.write(text)
            code, lines = self.check(self.axis(table=table))
            if complaint is None:
                self.assertEqual((code, lines), (0, []))
                continue
            self.assertEqual((code, len(lines)), (3, 1), lines)
            self.assertIn(f"axis[x].table: {table}{complaint}", lines[0])
        service = self.start(self.write(self.axis(table=self.path("whole.hex"))))
        self.assertIn(f"x: runs {self.path('whole.hex')} while no table is stored", service.said())

    def test_wrong_usage(self):
        for arguments in (["--confg", "x"], ["check-config"], ["wirings", "x"]):
            result = subprocess.run([service_case.NANOPLC, *arguments], capture_output=True, text=True, check=False)
            self.assertEqual((result.returncode, len(result.stderr.splitlines())), (2, 1), result.stderr)
        result = subprocess.run([service_case.NANOPLC, "--config", "/no/such.toml"], capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 2)
        self.assertIn("/no/such.toml: cannot be read", result.stderr)


class Telling(ServiceCase):
    def test_lines_for_the_journal_have_levels(self):
        self.plug_in()
        read_end, write_end = os.pipe()
        status = os.fstat(write_end)
        environment = {**os.environ, "JOURNAL_STREAM": f"{status.st_dev}:{status.st_ino}",
                       "NANOPLC_JOURNAL_SOCKET": self.path("nobody")}
        with subprocess.Popen([service_case.NANOPLC, "--config", self.write(self.axis())], stderr=write_end, env=environment) as process:
            os.close(write_end)
            with os.fdopen(read_end, encoding="utf-8") as lines:
                seen = [lines.readline()]
                while "started with" not in seen[-1]:
                    seen.append(lines.readline())
                process.terminate()
                seen += lines.readlines()
            self.assertEqual(process.wait(LONG), 0)
        self.assertTrue(all(line[0] == "<" and line[1] in "34567" and line[2] == ">" for line in seen), seen)
        self.assertIn("<5>started with 1 axis\n", seen)
        # SAFE_REASON 8, commanded by the user, is a warning.
        self.assertTrue(any(line.startswith("<4>x: SAFE: told to be") for line in seen), seen)

    def test_the_journal_can_be_searched_by_cause(self):
        """Where standard error is the journal, messages go to its socket, in its own protocol."""
        self.plug_in()
        stream = self.path("journal")
        with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as journal, open(stream, "wb") as lines:
            journal.bind(stream + ".socket")
            status = os.fstat(lines.fileno())
            environment = {**os.environ, "JOURNAL_STREAM": f"{status.st_dev}:{status.st_ino}",
                           "NANOPLC_JOURNAL_SOCKET": stream + ".socket"}
            with subprocess.Popen([service_case.NANOPLC, "--config", self.write(self.axis(table=self.table))], stderr=lines,
                                  env=environment) as process, contextlib.ExitStack() as at_end:
                at_end.callback(process.kill)
                seen = []

                def read():
                    """Without a pause: the socket holds ten messages, and the service waits for none."""
                    while message := journal.recv(65536):
                        seen.append(dict(line.split("=", 1) for line in message.decode().splitlines()))

                reader = threading.Thread(target=read, daemon=True)
                reader.start()

                def first_with(field, value):
                    return until(lambda: next((fields for fields in seen if fields.get(field) == value), None), lambda: seen)

                self.assertEqual(first_with("NANOPLC_EVENT", "motor_answers")["NANOPLC_AXIS"], "x")
                self.moves()
                self.pull_out()
                lost = first_with("NANOPLC_EVENT", "link_down")
                self.assertEqual((lost["PRIORITY"], lost["SYSLOG_IDENTIFIER"], lost["NANOPLC_EVENT"], lost["NANOPLC_AXIS"]),
                                 ("3", "nanoplc", "link_down", "x"))
                self.assertEqual(lost["NANOPLC_CAUSE"], "link_down")
                self.assertIn("the motor does not answer (step " + lost["NANOPLC_STEP"] + ")", lost["MESSAGE"])
                gone = first_with("NANOPLC_EVENT", "port_gone")
                self.assertEqual((gone["NANOPLC_AXIS"], gone["NANOPLC_CAUSE"]), ("x", "link_down"), gone)
                process.terminate()
                self.assertEqual(first_with("MESSAGE", "ends: Terminated")["PRIORITY"], "5")
                unstopped = first_with("NANOPLC_EVENT", "end_unstopped")
                self.assertEqual((unstopped["NANOPLC_AXIS"], unstopped["NANOPLC_CAUSE"]), ("x", "link_down"), unstopped)
                self.assertIn("could not be told to stop", unstopped["MESSAGE"])
                process.wait(LONG)
                with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as end:
                    end.sendto(b"", stream + ".socket")
                reader.join(LONG)
                for fields in seen:
                    self.assertIn("NANOPLC_EVENT", fields)
                    self.assertEqual(fields["MESSAGE"].startswith("x: "), "NANOPLC_AXIS" in fields, fields)
        self.assertEqual(os.path.getsize(stream), 0)

    def test_systemd_is_told_and_its_watchdog_fed(self):
        self.plug_in()
        place = self.path("notify")
        with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as manager:
            manager.bind(place)
            manager.settimeout(LONG)
            service = self.start(self.write(self.axis()), NOTIFY_SOCKET=place, WATCHDOG_USEC="1000000")
            told = ""
            while "READY=1" not in told or told.count("WATCHDOG=1") < 3 or "STATUS=x stopped" not in told:
                told += manager.recv(4096).decode() + "\n"
            self.ctl("upload", self.table, "--run")
            while "STATUS=x runs" not in told:
                told += manager.recv(4096).decode() + "\n"
            self.end(service)
            while "STOPPING=1" not in told:
                told += manager.recv(4096).decode() + "\n"

    def test_the_example_is_in_order(self):
        result = subprocess.run([service_case.NANOPLC, "check-config", "--no-devices", EXAMPLE], capture_output=True, text=True, check=False)
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_a_scale_that_is_not_the_programs_is_told(self):
        source = self.put("belt.seq", "PROGRAM Belt\nMOTOR MAC140;\nSCALE 1 rev = 5 mm;\nON ERROR NEXT := Fault;\n"
                          "POWER_UP NEXT := Idle; END_POWER_UP\nSTEP Idle: END_STEP\nSTEP Fault: OWN ERROR; END_STEP\nEND_PROGRAM\n")
        subprocess.run([service_case.SEQC, "build", source, "-o", self.path("belt.bin")], check=True, stdout=subprocess.DEVNULL)
        self.plug_in()
        for scale, is_told in (('unit = "mm"\nunits = 5', False), ('unit = "mm"\nunits = 4', True), ('unit = "deg"\nunits = 360', True)):
            axis = self.axis(table=self.path("belt.bin"), more=f"[axis.scale]\n{scale}\n")
            config = self.write(axis.replace("[axis.motor]", f'symbols = "{self.path("belt.sym")}"\n[axis.motor]'))
            result = subprocess.run([service_case.NANOPLC, "check-config", config], capture_output=True, text=True, check=False)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual("the SCALE of its program 5 mm a revolution" in result.stdout, is_told, result.stdout)

    def test_the_example_has_every_key(self):
        with open(EXAMPLE, encoding="utf-8") as file:
            text = file.read()
        keys = subprocess.run([service_case.NANOPLC, "check-config", "--no-devices", "--keys", EXAMPLE], capture_output=True, text=True,
                              check=False).stdout.split()
        self.assertIn("axis.motor.rs485_before_ms", keys)
        self.assertGreater(len(keys), 45)
        for key in keys:
            name = re.escape(key.split(".")[-1])
            self.assertRegex(text, rf"(?m)^(# )?((\[+([a-z]+\.)?{name}\]+$)|({name} = )|(IN1 = \{{.*\b{name} = ))",
                             f"{key} is not in the example")

    def test_wiring(self):
        config = self.write(self.axis(more='[axis.inputs]\nIN2 = {line = "GPIO5", active_low = true, bias = "pull_up"}\n'
                                      '[axis.outputs]\nOUT1 = "gpiochip0:23"\n[axis.settings]\nsafe_outputs = 2\n'
                                      'enable_input = 2\n'))
        result = subprocess.run([service_case.NANOPLC, "wiring", config], capture_output=True, text=True, check=False)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        rows = {}
        for line in filter(str.strip, result.stdout.splitlines()):
            rows.setdefault(line.split()[0], line)
        self.assertRegex(rows["IN2"], r"GPIO5 +0 V = 1, pulled up +input 2")
        self.assertRegex(rows["OUT1"], r"gpiochip0:23 +1 = high, safe: 1 +output 1")
        self.assertRegex(rows["IN0"], r"none +reads 0 always")
        self.assertRegex(rows["motor"], r"RS422, 19200 baud, 8N1")
        self.assertIn("IN2 is the enable input", result.stdout)

    def test_help_manual_and_completion(self):
        for arguments, part in ((["--help"], "Exit codes: 0"), (["--version"], "nanoplc "), (["man"], ".TH NANOPLC 8"),
                                (["completion", "bash"], "-F _nanoplc nanoplc"), (["completion", "zsh"], "#compdef nanoplc")):
            result = subprocess.run([service_case.NANOPLC, *arguments], capture_output=True, text=True, check=False)
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertIn(part, result.stdout)


if __name__ == "__main__":
    (service_case.NANOPLC, service_case.MACSIM, service_case.NANOCTL, service_case.MACREG, service_case.SEQC, service_case.MENDING,
     EXAMPLE, SLOW_DISK) = sys.argv[1:9]
    unittest.main(argv=sys.argv[:1] + sys.argv[9:])
