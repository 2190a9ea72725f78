#!/usr/bin/env python3
"""Stop, safe and hold whatever other clients do; and commands that come too late, on nanoplc and on the simulated gateway.

usage: stop_test.py NANOPLC MACSIM NANOCTL NANOPLC_SIM SEQC MENDING.seq MACREG
"""

import fcntl
import http.client
import json
import os
import signal
import socket
import stat
import statistics
import subprocess
import sys
import threading
import time
import tty
import unittest

import service_case
import simulator
from macsim_test import read_request, value_in, write_request
from patience import halt
from service_case import LONG, ServiceCase

SIM = ""
GATEWAY = 128
OPERATOR, STATUS, SCANS, RESULT, COMMAND = 12, 16, 25, 31, 48
RUN, STOP, HOLD = 1, 2, 6
TRIES = 20
WITHIN = 1.0  # seconds in which a stop takes effect
FLOODING = int(os.environ.get("NPLC_FLOODING", "200"))  # clients
HALTED = 1.5  # seconds, longer than the 1 s that a command may wait to be read


def order(command):
    return write_request(GATEWAY, COMMAND, command, 4)


def refused_write():
    return write_request(GATEWAY, SCANS, 0, 4)


class Client:
    def __init__(self, endpoint):
        kind, where = endpoint.split(":", 1)
        if kind == "unix":
            self.socket = socket.socket(socket.AF_UNIX)
            self.socket.connect(where)
        else:
            host, port = where.split(":")
            self.socket = socket.create_connection((host, int(port)))

    def send(self, data):
        self.socket.sendall(data)

    def read(self, register):
        """None without an answer."""
        self.send(read_request(GATEWAY, register))
        answer = b""
        self.socket.settimeout(5)
        try:
            while len(answer) < 19:
                piece = self.socket.recv(19 - len(answer))
                if not piece:
                    return None
                answer = (answer + piece).lstrip(b"\x11")  # accepts of what it wrote before
        except OSError:
            return None
        return value_in(answer)

    def accepted(self):
        """The answer to a write."""
        self.socket.settimeout(LONG)
        answer = b""
        while len(answer) < 3:
            answer += self.socket.recv(3 - len(answer)) or b"closed"
        return answer == b"\x11\x11\x11"

    def is_closed(self):
        self.socket.settimeout(LONG)
        try:
            return self.socket.recv(1) == b""
        except ConnectionError:
            return True

    def close(self):
        self.socket.close()


class Gateway(ServiceCase):
    """One whose sequence runs; `endpoint` is its port."""

    KIND = "unix"

    def setUp(self):
        super().setUp()
        self.clients = []
        self.endpoint = {"unix": "unix:" + self.path("x"), "pty": "pty:" + self.path("x"),
                         "tcp": f"tcp:127.0.0.1:{simulator.free_port()}"}[self.KIND]
        self.gateway = self.begin()
        self.wait_until_it_runs()

    def tearDown(self):
        self.gateway.send_signal(signal.SIGCONT)
        for client in self.clients:
            client.close()
        super().tearDown()

    def begin(self):
        raise NotImplementedError

    def client(self):
        self.clients.append(Client(self.endpoint))
        return self.clients[-1]

    def state(self):
        """0 stopped, 2 running; read by a separate client."""
        client = Client(self.endpoint)
        status = client.read(STATUS)
        client.close()
        return None if status is None else status & 7

    def wait_until_it_runs(self):
        self.until(lambda: self.nanoctl("status").stdout.startswith("running"))

    def nanoctl(self, *arguments):
        return subprocess.run([service_case.NANOCTL, "--port", self.endpoint, *arguments], capture_output=True, text=True,
                              timeout=LONG, check=False)

    def stops(self, *arguments, command="stop", state="stopped"):
        """It is done within the time that it may take; on a busy machine the start of a process and the look at the result take theirs."""
        before = self.start_of_a_process()
        begun = time.monotonic()
        result = self.nanoctl(*arguments, command)
        taken = time.monotonic() - begun
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn(state, result.stdout)
        self.assertLess(taken, WITHIN + 20 * max(before, self.start_of_a_process()))
        return result

    @staticmethod
    def start_of_a_process():
        begun = time.monotonic()
        subprocess.run([service_case.NANOCTL, "--version"], capture_output=True, timeout=LONG, check=True)
        return time.monotonic() - begun


class Service(Gateway):
    def begin(self):
        self.plug_in()
        return self.start(self.write(self.axis(port=self.endpoint, table=self.table))).process


class Simulated(Gateway):
    def begin(self):
        process, _ = simulator.start(SIM, "run", self.table, "--realtime", "--mactalk", self.endpoint)
        self.running.append(Simulation(process))
        return process


class Simulation:
    """As ServiceCase ends its services."""

    def __init__(self, process):
        self.process = process

    def end(self, how):
        self.process.send_signal(how)
        self.process.wait(LONG)
        self.process.stdout.close()
        self.process.stderr.close()


class Watching:
    """Programs that watch what is stopped."""

    def watch(self, *options):
        watcher = subprocess.Popen([service_case.NANOCTL, "--port", self.endpoint, "watch", *options],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(watcher.stderr.close)
        self.addCleanup(watcher.stdout.close)
        self.addCleanup(watcher.wait)
        self.addCleanup(watcher.kill)
        watcher.stdout.readline()
        return watcher


class Flood:
    """Connections that send all they can, read nothing, and come again when they were closed."""

    MESSAGES = [os.urandom(4096), 40 * read_request(GATEWAY, STATUS), 40 * refused_write()]

    def __init__(self, endpoint, count):
        self.endpoint = endpoint
        self.sockets = [None] * count
        self.goes_on = True
        self.thread = threading.Thread(target=self.run)
        self.thread.start()

    def run(self):
        while self.goes_on:
            for number, one in enumerate(self.sockets):
                try:
                    if one is None:
                        one = self.sockets[number] = Client(self.endpoint).socket
                        one.setblocking(False)
                    one.send(self.MESSAGES[number % len(self.MESSAGES)])
                except BlockingIOError:
                    pass
                except OSError:
                    if one is not None:
                        one.close()
                    self.sockets[number] = None
            time.sleep(0.001)

    def end(self):
        self.goes_on = False
        self.thread.join()
        for one in self.sockets:
            if one is not None:
                one.close()


class Others(Watching):
    """Whatever other clients do, a stop takes effect within a second."""

    def test_clients_whose_writes_are_refused(self):
        for _ in range(7):
            self.client().send(refused_write())
        time.sleep(0.05)
        self.stops()

    def test_a_stop_goes_before_what_others_have_sent(self):
        for _ in range(7):
            self.client().send(16 * refused_write() + 16 * read_request(GATEWAY, STATUS))
        stopper = self.client()
        begun = time.monotonic()
        stopper.send(order(STOP))
        self.assertTrue(stopper.accepted())
        self.assertLess(time.monotonic() - begun, WITHIN)
        self.assertEqual(self.state(), 0)

    def test_idle_clients_lose_their_seats(self):
        for _ in range(100):
            self.client()
        self.stops()

    def test_a_flood(self):
        flood = Flood(self.endpoint, FLOODING)
        self.addCleanup(flood.end)
        time.sleep(1)
        times = []
        for _ in range(TRIES):
            starter = self.client()
            starter.send(order(RUN))
            stopper = self.client()
            begun = time.monotonic()
            stopper.send(order(STOP))
            self.assertTrue(stopper.accepted())
            times.append(time.monotonic() - begun)
            self.until(lambda: self.state() == 0)
            for client in (starter, stopper):
                client.close()
        print(f"{TRIES} stops beside {FLOODING} clients that flood: median {1000 * statistics.median(times):.1f} ms, "
              f"longest {1000 * max(times):.1f} ms", flush=True)
        self.until(lambda: self.nanoctl("stop").returncode == 0)

    def test_clients_that_read_without_a_pause(self):
        watchers = [self.watch("--interval", "0") for _ in range(3)]
        for command, state in (("hold", "held"), ("stop", "stopped")):
            self.stops(command=command, state=state)
        self.assertEqual(self.nanoctl("status").returncode, 0)
        for watcher in watchers:
            self.assertIsNone(watcher.poll(), "it lost its place")

    def test_what_was_sent_before_a_stop_does_not_start_anything_after_it(self):
        self.nanoctl("stop")
        for _ in range(3):
            self.client().send(8 * refused_write() + order(RUN))
        stopper = self.client()
        stopper.send(order(RUN) + order(STOP))
        self.assertEqual(stopper.read(STATUS) & 7, 0)
        time.sleep(2)
        self.assertEqual(self.state(), 0)


class Late:
    """What waited longer than a second to be read, or whose sender has gone, starts nothing; a stop is obeyed."""

    def halted(self):
        halt(self.gateway.pid)

    def goes_on(self, seconds=HALTED):
        time.sleep(seconds)
        self.gateway.send_signal(signal.SIGCONT)

    def test_a_run_of_a_client_that_has_gone(self):
        self.nanoctl("stop")
        self.halted()
        client = Client(self.endpoint)
        client.send(order(RUN))
        client.close()
        self.goes_on(0.2)
        time.sleep(0.3)
        self.assertEqual(self.state(), 0)

    def test_a_run_of_a_client_that_has_gone_long_ago(self):
        self.nanoctl("stop")
        self.halted()
        client = Client(self.endpoint)
        client.send(order(RUN))
        client.close()
        self.goes_on()
        time.sleep(0.3)
        self.assertEqual(self.state(), 0)

    def test_a_run_that_waited_too_long(self):
        self.nanoctl("stop")
        client = self.client()
        self.assertEqual(client.read(STATUS) & 7, 0)
        self.halted()
        client.send(order(RUN))
        self.goes_on()
        self.assertEqual(client.read(STATUS) & 7, 0)
        client.send(order(RUN))
        self.assertTrue(client.accepted(), "the next one is in time")
        self.assertIn(client.read(STATUS) & 7, (1, 2))

    def test_a_stop_among_what_waited_too_long(self):
        client = Client(self.endpoint)
        self.assertEqual(client.read(STATUS) & 7, 2)
        self.halted()
        client.send(order(STOP) + order(RUN))
        client.close()
        self.goes_on()
        time.sleep(0.3)
        self.assertEqual(self.state(), 0)


class Names:
    """A stop needs no names and nothing read back; what is wrong with them is said afterwards."""

    def test_symbols_that_are_missing_or_of_another_table(self):
        with open(self.path("other.sym"), "w", encoding="utf-8") as file:
            file.write("nonsense")
        for symbols in ("missing.sym", "other.sym"):
            self.nanoctl("run")
            self.wait_until_it_runs()
            for command, state in (("hold", "held"), ("stop", "stopped"), ("safe", "stopped")):
                said = self.stops("--sym", self.path(symbols), command=command, state=state)
                self.assertIn(symbols, said.stderr)
                self.assertEqual(said.stderr.count("\n"), 1)
        for arguments in (("log",), ("verify", self.table), ("run",), ("stop",), ("reset",)):
            result = self.nanoctl("--sym", self.path("other.sym"), *arguments)
            self.assertNotEqual(result.returncode, 2, f"{arguments} {result.stderr}")
        for arguments in (("status",), ("upload", self.table)):  # without its set-points a table would lose their values
            self.assertEqual(self.nanoctl("--sym", self.path("other.sym"), *arguments).returncode, 2)

    def test_one_that_is_not_confirmed_says_so(self):
        self.halted()
        for endpoint, command, waits in ((self.endpoint, "stop", False), ("unix:" + self.path("nobody"), "safe", True),
                                         (self.path("none"), "hold", False)):
            result = subprocess.run([service_case.NANOCTL, "--port", endpoint, command], capture_output=True, text=True,
                                    timeout=LONG, check=False)
            self.assertEqual(result.returncode, 4, result.stderr)
            self.assertIn("THE MACHINE MAY STILL BE RUNNING", result.stderr)
            self.assertEqual("waiting 10 s for the program" in result.stderr, waits)
            self.assertEqual(result.stderr.count("\n"), 2 if waits else 1)
        self.goes_on(0)
        self.until(lambda: self.state() == 0)

    def test_an_interrupted_one_says_so(self):
        self.halted()
        stop = subprocess.Popen([service_case.NANOCTL, "--port", self.endpoint, "stop"], stderr=subprocess.PIPE, text=True)
        time.sleep(0.3)
        stop.send_signal(signal.SIGINT)
        said = stop.communicate(timeout=LONG)[1]
        self.assertEqual(stop.returncode, 130, said)
        self.assertIn("THE MACHINE MAY STILL BE RUNNING", said)


class OnASerialLine(ServiceCase):
    """A line of one client, whose disconnection cannot be detected."""

    def setUp(self):
        super().setUp()
        self.plug_in()
        self.master, self.slave = os.openpty()
        self.addCleanup(os.close, self.slave)
        self.addCleanup(os.close, self.master)
        self.service = self.start(self.write(self.axis(port=os.ttyname(self.slave), table=self.table))).process
        self.addCleanup(lambda: self.service.send_signal(signal.SIGCONT))
        self.until(lambda: self.state() == 2)

    def read(self, register):
        os.write(self.master, read_request(GATEWAY, register))
        answer = b""
        while len(answer) < 19:
            answer = (answer + os.read(self.master, 64)).lstrip(b"\x11")
        return value_in(answer)

    def state(self):
        return self.read(STATUS) & 7

    def sent_while_halted(self, data):
        halt(self.service.pid)
        os.write(self.master, data)
        time.sleep(HALTED)
        self.service.send_signal(signal.SIGCONT)
        time.sleep(0.3)

    def test_a_run_that_waited_too_long(self):
        os.write(self.master, order(STOP))
        self.until(lambda: self.state() == 0)
        self.sent_while_halted(order(RUN) + refused_write() + order(RUN))
        self.assertEqual(self.state(), 0)
        self.assertEqual(self.read(RESULT) & 0xFFFF, 19 | COMMAND << 8, "too_late")
        os.write(self.master, order(RUN))
        self.until(lambda: self.state() == 2)

    def test_who_is_there_is_one_operator(self):
        self.assertEqual(self.read(OPERATOR), 0)
        os.write(self.master, order(RUN))
        self.until(lambda: self.read(OPERATOR) == 4 | 1 << 8)

    def test_a_stop_among_what_waited_too_long(self):
        self.sent_while_halted(b"\x52\x52" + order(STOP) + order(RUN))
        self.assertEqual(self.state(), 0)


class Motorless(Service):
    def test_a_motor_that_cannot_be_told_is_said(self):
        self.pull_out()
        self.until(lambda: "SAFE" in self.nanoctl("status").stdout)
        result = self.nanoctl("stop")
        self.assertEqual(result.returncode, 4, result.stdout)
        self.assertIn("the link to the motor is down", result.stderr)
        self.assertIn("THE MACHINE MAY STILL BE RUNNING", result.stderr)
        self.assertRegex(self.nanoctl("status").stdout, r"STOP NOT CONFIRMED by the motor for \d+\.\d s: it may be moving")
        self.assertGreater(json.loads(self.nanoctl("--json", "status").stdout)["stop_unconfirmed_ms"], 0)
        service = self.running[0]
        self.until(lambda: "the motor has not confirmed the stop for 1 s: it may be moving" in service.said(), service)
        given_up = self.nanoctl("give-up-stop")
        self.assertEqual(given_up.returncode, 0, given_up.stderr)
        self.assertIn("THE MOTOR MAY BE MOVING", given_up.stdout)
        self.assertNotIn("STOP NOT CONFIRMED", self.nanoctl("status").stdout)
        self.assertIn("no stop waits", self.nanoctl("give-up-stop").stdout)
        self.assertEqual(json.loads(self.nanoctl("--json", "status").stdout)["stop_unconfirmed_ms"], 0)
        self.until(lambda: "the stop is given up by " in service.said(), service)
        self.assertEqual(service.said().count("has not confirmed the stop for 1 s"), 1)


class Stepped(ServiceCase):
    """The motor goes in the middle of a step."""

    def test_a_sequence_that_is_held_then_is_no_motor_that_is_stopped(self):
        with open(self.path("waits.seq"), "w", encoding="utf-8") as file:
            file.write("PROGRAM P\nMOTOR MAC140;\nPOWER_UP NEXT := Waits; END_POWER_UP\n"
                       "STEP Waits: OWN ERROR; IF TRUE THEN TIMER := T#10s; NEXT := Passes; END_IF END_STEP\n"
                       "STEP Passes: OWN ERROR; IF ANY ERROR AND TIMER.Q THEN NEXT := Waits; END_IF END_STEP\nEND_PROGRAM\n")
        table = self.path("waits.bin")
        subprocess.run([service_case.SEQC, "build", self.path("waits.seq"), "--quiet", "-o", table], check=True)
        self.plug_in()
        service = self.start(self.write(self.axis(table=table)))
        self.until_status(lambda status: status["state"] == "running" and status["step"] == 2)
        self.ctl("hold")
        with subprocess.Popen([service_case.NANOCTL, "--port", "unix:" + self.path("x"), "step", "--wait", "60"],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as step:
            self.until_status(lambda status: status["state"] == "running")
            self.pull_out()
            said, complaint = step.communicate(timeout=2 * LONG)
        self.assertEqual(step.returncode, 4, said + complaint + service.said())
        self.assertIn("step: the sequence is held, but the motor has not confirmed the stop", complaint)
        self.assertIn("THE MACHINE MAY STILL BE RUNNING", complaint)


class Wire:
    """Between the gateway and the motor's terminal, until it is cut."""

    def __init__(self, motor):
        self.gateway, self.terminal = os.openpty()
        tty.setraw(self.terminal)
        self.motor = os.open(motor, os.O_RDWR | os.O_NOCTTY)
        tty.setraw(self.motor)
        self.is_whole = True
        for source, sink in ((self.gateway, self.motor), (self.motor, self.gateway)):
            threading.Thread(target=self.carry, args=(source, sink), daemon=True).start()

    def name(self):
        return os.ttyname(self.terminal)

    def carry(self, source, sink):
        while True:
            try:
                data = os.read(source, 4096)
                if self.is_whole:
                    os.write(sink, data)
            except OSError:
                return


class BesideTheMotorsOwnPort(ServiceCase):
    """The FastMAC line is cut; the motor's MacTalk port is wired, too."""

    def test_the_motor_is_stopped_over_it(self):
        motor, _ = simulator.start(service_case.MACSIM, "--model", "MAC140", "--address", "254", "--fastmac", "pty:" + self.path("motor"),
                                   "--mactalk", "pty:" + self.path("own"))
        self.motors["motor"] = motor
        wire = Wire(self.path("motor"))
        os.symlink(wire.name(), self.path("line"))
        axis = self.axis(motor="line", table=self.table)
        service = self.start(self.write(axis.replace("[axis.user]", f'mactalk_port = "{self.path("own")}"\n[axis.user]')))
        self.until_status(lambda status: status["state"] == "running" and status["link"] == "up")
        wire.is_whole = False
        self.ctl("stop")
        status = self.until_status(lambda status: status["link"] == "down")
        self.assertFalse(status["stop_unconfirmed"])
        self.assertIn("the motor was stopped over its MacTalk port", service.said())
        self.end(service)
        result = subprocess.run([service_case.MACREG, "--port", self.path("own"), "--json", "get", "MODE_REG"],
                                capture_output=True, text=True, timeout=LONG, check=False)
        self.assertEqual(json.loads(result.stdout)["registers"][0]["value"], "INIT_MODE", result.stdout)


class Terminal(Watching):
    """One line, which programs have in turns; a stop does not wait for its turn."""

    KIND = "pty"

    def test_others_have_it_while_some_watch(self):
        watchers = [self.watch(), self.watch("--interval", "0")]
        for arguments in (("break", "5"), ("force", "IN3=1"), ("log",), ("status",)):
            result = self.nanoctl(*arguments)
            self.assertEqual(result.returncode, 0, f"{arguments} {result.stderr}")
        for command, state in (("hold", "held"), ("safe", "stopped"), ("stop", "stopped")):
            self.stops(command=command, state=state)
        for watcher in watchers:
            self.assertIsNone(watcher.poll(), "it ended")

    def test_a_program_that_keeps_it_does_not_keep_a_stop_away(self):
        with open(self.path("x"), "r+b", buffering=0) as line:
            fcntl.flock(line, fcntl.LOCK_EX)
            self.stops()
            result = self.nanoctl("status")
            self.assertEqual(result.returncode, 3)
            self.assertIn(f"(process {os.getpid()}) holds this port", result.stderr)

    def test_a_stop_in_the_middle_of_an_upload(self):
        big = self.path("big.bin")
        with open(big, "wb") as file:
            for term in range(900):
                file.write(bytes([0xC0 | term % 60, term % 256, 0x3F, 0x3E, 0x80, 1, 0, 0]))
            file.write(bytes([0x3F, 0, 0, 0, 0, 0, 0, 0]))
        with subprocess.Popen([service_case.NANOCTL, "--port", self.endpoint, "upload", "--only-store", big],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as upload:
            time.sleep(0.1)
            self.stops()
            said = upload.communicate(timeout=LONG)
            self.assertEqual(upload.returncode, 0, said)

    def test_a_run_of_a_client_that_has_gone(self):
        self.nanoctl("stop")
        halt(self.gateway.pid)
        with open(self.path("x"), "r+b", buffering=0) as line:
            line.write(order(RUN))
        time.sleep(0.2)
        self.gateway.send_signal(signal.SIGCONT)
        time.sleep(0.3)
        self.assertIn("stopped", self.nanoctl("status").stdout)

    def test_a_run_that_waited_too_long(self):
        self.nanoctl("stop")
        with open(self.path("x"), "r+b", buffering=0) as line:
            tty.setraw(line)
            halt(self.gateway.pid)
            line.write(order(RUN))
            time.sleep(HALTED)
            self.gateway.send_signal(signal.SIGCONT)
            time.sleep(0.3)
            self.assertIn("stopped", self.nanoctl("status").stdout)


class OnATerminal(Terminal, Service):
    pass


class OfTheSimulationOnATerminal(Terminal, Simulated):
    pass


class OnASocket(Others, Late, Names, Service):
    def test_the_socket_is_its_owners_and_its_groups(self):
        self.assertEqual(stat.S_IMODE(os.stat(self.path("x")).st_mode), 0o660)


class OfTheSimulation(Others, Late, Names, Simulated):
    pass


class Door:
    """A page in this machine's browser can send anything, behind the head of an HTTP request."""

    KIND = "tcp"

    def post(self, body, method="POST"):
        host, port = self.endpoint.removeprefix("tcp:").split(":")
        page = http.client.HTTPConnection(host, int(port), timeout=LONG)
        with self.assertRaises((http.client.HTTPException, ConnectionError)):
            page.request(method, "/", body, {"Origin": "http://example.org", "Content-Type": "text/plain"})
            page.getresponse()
        page.close()

    def test_a_web_page_cannot_start_it(self):
        self.nanoctl("stop")
        for method in ("POST", "PUT", "PPP"):
            self.post(order(RUN), method)
        self.assertEqual(self.state(), 0)

    def test_nothing_behind_a_greeting_of_tls_is_taken(self):
        self.nanoctl("stop")
        client = self.client()
        client.send(b"\x16\x03\x01\x02\x00\x01" + order(RUN))
        self.assertTrue(client.is_closed())
        self.assertEqual(self.state(), 0)

    def test_one_that_says_nothing_yet_is_heard_later(self):
        client = self.client()
        client.send(b"\x50\x50\x50")
        time.sleep(0.3)
        client.send(read_request(GATEWAY, STATUS)[3:])
        self.assertEqual(len(client.socket.recv(19, socket.MSG_WAITALL)), 19)


class Nobody(ServiceCase):
    def test_a_port_that_takes_no_connection_is_given_up_and_said(self):
        with socket.socket() as listener:
            listener.bind(("127.0.0.1", 0))
            listener.listen(0)
            waiting = [socket.socket() for _ in range(4)]  # more than its backlog: who comes later gets no answer
            for client in waiting:
                client.setblocking(False)
                client.connect_ex(listener.getsockname())
            port = "tcp:127.0.0.1:%d" % listener.getsockname()[1]
            done = subprocess.run([service_case.NANOCTL, "--port", port, "stop"], capture_output=True, text=True, timeout=LONG,
                                  check=False)
            for client in waiting:
                client.close()
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("THE MACHINE MAY STILL BE RUNNING", done.stderr)


class BeingRestarted(ServiceCase):
    def stop(self, endpoint):
        stop = subprocess.Popen([service_case.NANOCTL, "--port", endpoint, "stop"], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                text=True)
        said = stop.stderr.readline()
        self.assertIn("waiting 10 s for the program", said)
        return stop

    def test_a_service_that_is_not_there_yet_is_waited_for(self):
        stop = self.stop("unix:" + self.path("x"))
        self.plug_in()
        service = self.start(self.write(self.axis(table=self.table)))
        said, complaint = stop.communicate(timeout=LONG)
        self.assertEqual(stop.returncode, 0, complaint + service.said())
        self.assertIn("stopped", said)

    def test_ctrl_c_ends_the_wait(self):
        dead = socket.socket(socket.AF_UNIX)
        dead.bind(self.path("dead"))  # nobody listens there
        for name in ("none", "dead"):
            stop = self.stop("unix:" + self.path(name))
            stop.send_signal(signal.SIGINT)
            complaint = stop.communicate(timeout=LONG)[1]
            self.assertEqual(stop.returncode, 130, complaint)
            self.assertIn("THE MACHINE MAY STILL BE RUNNING", complaint)
        dead.close()

    def test_what_cannot_heal_is_not_waited_for(self):
        for endpoint, code in (("tcp:nowhere.invalid:5", 2), ("tcp:127.0.0.1:0", 2), ("what", 2)):
            stop = subprocess.run([service_case.NANOCTL, "--port", endpoint, "stop"], capture_output=True, text=True, timeout=LONG,
                                  check=False)
            self.assertEqual(stop.returncode, code, stop.stderr)
            self.assertIn("THE MACHINE MAY STILL BE RUNNING", stop.stderr)
            self.assertNotIn("waiting", stop.stderr)


class OnTcp(Door, Service):
    pass


class OfTheSimulationOnTcp(Door, Simulated):
    pass


del Gateway, Service, Simulated  # they have no tests of their own

if __name__ == "__main__":
    (service_case.NANOPLC, service_case.MACSIM, service_case.NANOCTL, SIM, service_case.SEQC,
     service_case.MENDING, service_case.MACREG) = sys.argv[1:8]
    unittest.main(argv=[sys.argv[0], *sys.argv[8:]])
