#!/usr/bin/env python3
"""nanoctl on the simulated gateway, over real terminals and sockets.

usage: nanoctl_test.py NANOCTL NANOPLC_SIM SEQC SHUTTLE.seq MACREG
"""

import json
import os
import shutil
import signal
import stat
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

import simulator
import zsh
from noisy_proxy import NoisyProxy
from patience import until
from program_case import ProgramCase

NANOCTL = SIM = SEQC = SHUTTLE = MACREG = ""
LONG = 60  # timeout in seconds of what must come


class Case(ProgramCase):
    def setUp(self):
        super().setUp()
        self.table = self.path("shuttle.bin")
        built = subprocess.run([SEQC, "build", SHUTTLE, "-o", self.table], capture_output=True, text=True, check=False)
        self.assertEqual(built.returncode, 0, built.stderr)
        self.endpoint = "unix:" + self.path("port")

    def start(self, *arguments, endpoint=None):
        """The gateway, when it is ready."""
        self.endpoint = endpoint or self.endpoint
        return self.launch(SIM, "run", *arguments, "--flash", self.path("flash"), "--realtime", "--mactalk", self.endpoint)[0]

    def end(self, process):
        process.send_signal(signal.SIGTERM)
        self.assertIn(process.wait(LONG), (0, 1))
        process.stdout.close()
        process.stderr.close()
        self.running.remove(process)

    def watcher(self):
        """`nanoctl watch` of every status, once it has said the first."""
        watcher = subprocess.Popen([NANOCTL, "--port", self.endpoint, "--patience", "2000", "--json", "watch", "--all",
                                    "--interval", "0"], stdout=subprocess.PIPE, text=True)
        self.running.append(watcher)
        self.assertTrue(json.loads(watcher.stdout.readline())["ok"])
        return watcher

    def call(self, *arguments, port=None, patience=2000):
        return subprocess.run(
            [NANOCTL, "--port", port or self.endpoint, "--patience", str(patience), *arguments],
            capture_output=True, text=True, timeout=4 * LONG, check=False)

    def ctl(self, *arguments, exit_code=0, **options):
        """What is refused is refused by silence: then patience is time, and what is read afterwards is asked for ten times."""
        return self.document_of(self.call("--json", *arguments, **{"patience": 500 if exit_code else 2000, **options}), exit_code)

    def until(self, wanted, **options):
        """Looks at the status until it is as wanted."""
        return until(lambda: wanted(status := self.ctl("status", **options)) and status, lambda: self.ctl("status", **options))

    def big_table(self):
        with open(self.path("big.bin"), "wb") as file:
            for term in range(900):
                file.write(bytes([0xC0 | term % 60, term % 256, 0x3F, 0x3E, 0x80, 1, 0, 0]))
            file.write(bytes([0x3F, 0, 0, 0, 0, 0, 0, 0]))
        return self.path("big.bin")

    def sym(self):
        return "--sym", self.path("shuttle.sym")


class Tables(Case):
    def test_a_table_goes_over_a_terminal_outlives_a_power_cut_and_runs(self):
        process = self.start(endpoint="pty:" + self.path("tty"))
        self.assertEqual(self.ctl("status")["state"], "stopped")
        sent = self.ctl("upload", self.table, "--run")
        self.assertTrue(sent["active"] and sent["started"])
        self.assertEqual(sent["bytes"], os.path.getsize(self.table))
        self.until(lambda status: status["state"] == "running" and status["step"] == 1)
        self.assertTrue(self.ctl("verify", self.table, "--bytes")["active"])
        process.kill()
        process.wait()
        self.start(endpoint="pty:" + self.path("tty"))
        status = self.until(lambda status: status["state"] == "running" and status["step"] == 1)
        self.assertEqual(status["table_crc32"], sent["crc32"])
        self.ctl("download", "-o", self.path("back.bin"))
        with open(self.table, "rb") as first, open(self.path("back.bin"), "rb") as second:
            self.assertEqual(first.read(), second.read())

    def test_a_running_sequence_keeps_its_table_until_it_is_stopped(self):
        self.start()
        first = self.ctl("upload", self.table, "--run")["crc32"]
        other = self.path("other.bin")
        with open(other, "wb") as file:
            file.write(bytes.fromhex("C000003E80010000 3F00000000000000"))
        self.until(lambda status: status["state"] == "running")
        refused = self.ctl("upload", other, exit_code=1)
        self.assertIn("stored and not active", refused["error"])
        status = self.ctl("status")
        self.assertEqual((status["table_crc32"], status["stored_differs"]), (first, True))
        self.assertIn("the active table", self.ctl("verify", other, exit_code=1)["error"])
        self.ctl("upload", other, "--stop")
        self.assertEqual(self.ctl("status")["state"], "stopped")
        self.ctl("verify", other)

    def test_a_table_that_is_active_and_not_stored_is_said(self):
        self.launch(SIM, "run", self.table, "--realtime", "--mactalk", self.endpoint)
        self.assertIn("no table is stored", self.ctl("verify", self.table, exit_code=1)["error"])

    def test_noise_on_both_lines(self):
        self.start("--drop", "0.2%", "--damage", "0.3%", "--seed", "3")
        proxy = NoisyProxy(self.path("noise"), self.path("port"), 0.002, 7)
        noisy = "unix:" + self.path("noise")
        big = self.path("big.bin")
        with open(big, "wb") as file:
            for term in range(120):
                file.write(bytes([0xC0 | term % 60, term, 0x3F, 0x3E, 0x80, 1, 0, 0]))
            file.write(bytes([0x3F, 0, 0, 0, 0, 0, 0, 0]))
        self.ctl("upload", big, port=noisy, patience=200)
        self.ctl("verify", big, "--bytes", port=noisy, patience=200)
        proxy.close()
        self.ctl("verify", big)
        self.assertGreater(proxy.damaged, 0, "seed 7")


class WhyNothingMoves(Case):
    """The number and the name that every interface shows; KVOUT, register 13, is the load factor."""

    def first(self, *arguments):
        status = self.ctl("status", *arguments)
        return status["why"][0]["code"], status["why"][0]["number"], status["why_of_motor"]

    def test_of_the_gateway_and_of_its_motor(self):
        self.start()
        self.ctl("upload", self.table, "--run")
        self.until(lambda status: status["state"] == "running" and status["step"] == 1)
        self.assertEqual(self.first(), ("gateway_runs", 14, False))
        self.ctl("stop")
        self.assertEqual(self.first(), ("gateway_safe", 11, False))
        self.assertEqual(self.first("--why"), ("gateway_safe", 11, True))
        said = self.call("status").stdout
        self.assertIn("\nwhy: The gateway is in its safe state: stop command. (gateway_safe, 11)\n    -> ", said)

    def test_they_are_those_of_macreg(self):
        self.start()
        self.ctl("stop")
        for value in ("0", "1"):
            changed = subprocess.run([MACREG, "--port", self.endpoint, "--address", "1", "set", "KVOUT", value],
                                     capture_output=True, text=True, timeout=LONG, check=False)
            self.assertEqual(changed.returncode, 0, changed.stdout + changed.stderr)
            named = subprocess.run([MACREG, "--port", self.endpoint, "--address", "1", "--json", "why"], capture_output=True,
                                   text=True, timeout=LONG, check=True)
            theirs = [(one["code"], one["sentence"], one["remedy"]) for one in json.loads(named.stdout)["findings"]]
            ours = [(one["code"], one["sentence"], one["remedy"]) for one in self.ctl("status", "--why")["why"]]
            self.assertEqual(ours, theirs)
            self.assertEqual(ours[0][0] == "load_factor_zero", value == "0")

    def test_of_a_midi_drive(self):
        self.start("--motor", "MAC34-1")
        self.ctl("upload", self.table, "--run")
        self.until(lambda status: status["state"] == "running" and status["step"] == 1)
        self.assertEqual(self.first("--why"), ("gateway_runs", 14, True))  # in INIT, where it waits for I0
        self.ctl("stop")
        self.assertEqual(self.first("--why"), ("gateway_safe", 11, True))
        named = subprocess.run([MACREG, "--port", self.endpoint, "--address", "1", "--model", "MAC140", "why"], capture_output=True,
                               text=True, timeout=LONG, check=False)
        self.assertEqual(named.returncode, 3, named.stdout)
        self.assertIn("behind this gateway is a MIDI drive", named.stderr)


class Running(Case):
    def test_forced_inputs_step_it_through(self):
        self.start()
        self.ctl("upload", self.table, "--run")
        self.until(lambda status: status["step"] == 1)
        forcing = subprocess.Popen([NANOCTL, "--port", self.endpoint, "--patience", "2000", *self.sym(), "force", "I0=1",
                                   "--keep"], stdout=subprocess.PIPE, text=True)
        self.running.append(forcing)
        self.assertIn("I0 = 1", forcing.stdout.readline())
        moving = self.until(lambda status: status["step"] == 2)
        self.assertTrue(moving["forced_inputs"])
        self.assertEqual(moving["outputs"], 1)
        self.until(lambda status: status["step"] == 4)
        forcing.send_signal(signal.SIGINT)
        self.assertEqual(forcing.wait(LONG), 0)
        self.assertFalse(self.ctl("status")["forced_inputs"])
        self.assertIn("forced", [entry["event"] for entry in self.ctl("log")["entries"]])

    def test_a_breakpoint_holds_it_with_the_motor_stopped(self):
        self.start()
        self.ctl("upload", self.table)
        self.assertEqual(self.ctl(*self.sym(), "break", "S3")["steps"], [3])
        self.ctl("run")
        self.until(lambda status: status["step"] == 1)
        self.ctl("force", "IN0=1")
        held = self.until(lambda status: status["state"] == "held")
        self.assertEqual((held["step"], held["at_breakpoint"]), (3, True))
        self.assertEqual(held["outputs"], 1, "as they were")
        self.assertEqual(self.ctl("break", "--clear")["steps"], [])
        after = self.ctl("step")
        self.assertEqual((after["state"], after["step"], after["fired_step"]), ("held", 4, 3))
        self.ctl("stop")
        self.assertEqual(self.ctl("status")["safe_reason"], "stop command")

    def test_the_link_to_the_motor_is_cut_in_mid_move_and_restored(self):
        scenario = self.path("cut.scn")
        with open(scenario, "w", encoding="utf-8") as file:
            file.write("once step = 2 after 100 ms line cut, after 3 s line restored\n")
        process = self.start()
        self.ctl("upload", self.table)
        self.end(process)
        self.start("--scenario", scenario)
        self.until(lambda status: status["step"] == 1)
        watcher = self.watcher()
        self.ctl("force", "IN0=1", "IN5=1")
        lost = next(status for status in map(json.loads, watcher.stdout) if status["safe_reason"] == "link down")
        self.assertEqual(lost["outputs"], 0)
        # Step 5 acknowledges while IN5 is on (01h); then the link counts as up again.
        self.ctl("force", "IN0=0", "IN5=1")
        back = self.until(lambda status: status["safe_reason"] == "")
        self.assertEqual((back["link"], back["link_losses"]), ("up", 1))
        events = [entry["event"] for entry in self.ctl("log")["entries"]]
        self.assertLess(events.index("link down"), events.index("link up"))

    def test_a_run_without_a_motor_says_when_it_starts(self):
        scenario = self.path("cut.scn")
        with open(scenario, "w", encoding="utf-8") as file:
            file.write("at 500 ms line cut\n")
        process = self.start()
        self.ctl("upload", self.table)
        self.end(process)
        self.start("--new", "--scenario", scenario)
        self.until(lambda status: status["link"] == "down")
        done = self.call("run")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout, "waiting for the motor, step 0; it does not answer: the sequence starts as soon as it does, "
                                      "nanoctl stop ends that\n")

    def test_two_clients_at_once(self):
        self.start()
        self.ctl("upload", self.table, "--run")
        watcher = self.watcher()
        self.ctl("verify", self.table, "--bytes")
        self.ctl("stop")
        for line in watcher.stdout:
            if json.loads(line)["state"] == "stopped":
                break
        watcher.send_signal(signal.SIGTERM)
        self.assertEqual(watcher.wait(LONG), 0)

    def test_of_two_uploads_one_is_told_of_the_other(self):
        self.start()
        tables = [self.path("first.bin"), self.path("second.bin")]
        for number, name in enumerate(tables):
            with open(name, "wb") as file:
                for term in range(300):
                    file.write(bytes([0xC0 | term % 60, term % 256, 0x3F, 0x3E, 0x80, number, 0, 0]))
                file.write(bytes([0x3F, 0, 0, 0, 0, 0, 0, 0]))
        uploads = [subprocess.Popen([NANOCTL, "--port", self.endpoint, "--patience", "2000", "upload", name],
                                    stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) for name in tables]
        self.running += uploads
        said = [upload.communicate(timeout=LONG)[1] for upload in uploads]
        codes = [upload.returncode for upload in uploads]
        self.assertTrue(set(codes) <= {0, 1} and 1 in codes, f"{codes} {said}")
        for code, text in zip(codes, said):
            if code == 1:
                self.assertIn("another client", text)
        # Whatever came of it, what is stored is one of the two, whole, or nothing.
        whole = {0}
        for name in tables:
            with open(name, "rb") as file:
                whole.add(zlib.crc32(file.read()))
        self.assertIn(self.ctl("status")["stored_crc32"], whole)
        self.ctl("upload", tables[1])
        self.ctl("verify", tables[1], "--bytes")

    def test_a_terminal_has_one_operator(self):
        gateway = self.start(endpoint="pty:" + self.path("tty"))
        gateway.send_signal(signal.SIGSTOP)
        self.addCleanup(gateway.send_signal, signal.SIGCONT)
        upload = subprocess.Popen([NANOCTL, "--port", self.endpoint, "--patience", "20000", "upload", self.table],
                                  stdout=subprocess.DEVNULL)
        self.running.append(upload)
        time.sleep(0.5)
        error = self.ctl("status", exit_code=3)["error"]
        self.assertIn(f"nanoctl (process {upload.pid}) holds this port", error)


class Operating(Case):
    """One operates; over TCP each connection is one by itself."""

    def test_others_are_told_who_operates_and_may_take_it_over(self):
        self.start(endpoint=f"tcp:127.0.0.1:{simulator.free_port()}")
        self.ctl("upload", self.table)
        holder = subprocess.Popen([NANOCTL, "--port", self.endpoint, "operate", "--take"], stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, text=True)
        self.running.append(holder)
        self.assertIn("you operate", holder.stdout.readline())
        error = self.ctl("run", exit_code=1)["error"]
        self.assertIn("127.0.0.1 over TCP operates", error)
        self.assertIn("nanoctl operate --take", error)
        self.assertIn("127.0.0.1 over TCP", self.ctl("operate")["operator"])
        self.ctl("operate", "--release", exit_code=1)
        self.ctl("stop")
        self.ctl("force")
        taker = subprocess.Popen([NANOCTL, "--port", self.endpoint, "operate", "--take"], stdout=subprocess.PIPE, text=True)
        self.running.append(taker)
        self.assertIn("taken over from 127.0.0.1 over TCP", taker.stdout.readline())
        self.assertEqual(holder.wait(LONG), 1)
        self.assertIn("127.0.0.1 over TCP has taken over", holder.stderr.read())
        taker.send_signal(signal.SIGTERM)
        self.assertEqual(taker.wait(LONG), 0)
        self.ctl("run")

    def test_a_users_clients_on_a_socket_are_one_operator(self):
        self.start()
        self.ctl("upload", self.table)
        holder = subprocess.Popen([NANOCTL, "--port", self.endpoint, "operate", "--take"], stdout=subprocess.PIPE, text=True)
        self.running.append(holder)
        holder.stdout.readline()
        self.ctl("run")
        self.assertIn(f"uid {os.getuid()}", self.ctl("operate")["operator"])
        holder.send_signal(signal.SIGTERM)
        self.assertEqual(holder.wait(LONG), 0)
        self.assertEqual(self.ctl("operate")["operator"], "nobody")


FEEDER = """PROGRAM Feeder
MOTOR MAC140;
SCALE 1 rev = 5 mm;
{points}
ON ERROR NEXT := Fault;
POWER_UP INIT(V1, A1); NEXT := Idle; END_POWER_UP
STEP Idle: {waits} IF IN0 THEN NEXT := Push; END_IF END_STEP
STEP Push: {moves} IF INPOS WITHIN T#3s THEN NEXT := Idle; ELSE NEXT := Fault; END_IF END_STEP
STEP Fault: OWN ERROR; ENTRY STOP; IF ANY ERROR AND IN1 THEN RESET_ERROR; NEXT := Idle; END_IF END_STEP
END_PROGRAM
"""


class Dropped(Case):
    def build(self, name, points, moves="ENTRY POSITION(Length);", waits=""):
        source = self.path(f"{name}.seq")
        with open(source, "w", encoding="utf-8") as file:
            file.write(FEEDER.format(points=points, moves=moves, waits=waits))
        built = subprocess.run([SEQC, "build", source, "-o", self.path(f"{name}.bin")], capture_output=True, text=True, check=False)
        self.assertEqual(built.returncode, 0, built.stderr)
        return self.path(f"{name}.bin")

    def test_what_a_new_table_does_not_take_is_named(self):
        length = "SET_POINT Length AT P2 := 80 mm RANGE 10 .. {} mm STEP 0.1 mm;"
        first = self.build("first", length.format(200))
        shorter = self.build("shorter", length.format(100))
        plain = self.build("plain", "VAR_MOTOR Length AT P2 := 80 mm; END_VAR")
        self.start()
        self.assertEqual(self.ctl("upload", first)["dropped"], [])
        self.ctl("set-points", "set", "Length=150mm")
        self.ctl("recipe", "save", "Long")
        lost = {"name": "Length", "value": "150 mm", "recipe": "", "why": "out_of_range"}
        self.assertEqual(self.ctl("upload", "--only-store", shorter)["dropped"], [lost, lost | {"recipe": "Long"}])
        self.assertEqual(self.ctl("activate")["dropped"], [lost, lost | {"recipe": "Long"}])
        told = self.call("recipe", "load", "Long").stdout
        self.assertIn("recipe 'Long': Length 150 mm is not loaded, its default 80 mm is in its place: it takes 10 mm to 100 mm", told)
        self.assertEqual(self.ctl("upload", first)["dropped"], [])
        self.assertEqual(self.ctl("recipe", "load", "Long")["recipe_name"], "Long")
        self.assertTrue(self.call("set-points").stdout.endswith("\nrecipe 'Long'\n"))
        told = self.call("upload", plain).stdout
        self.assertIn("\nLength 150 mm is dropped: the table has no such set-point", told)
        self.assertIn("\nrecipe 'Long': Length 150 mm is not loaded: the table has no such set-point", told)


class Talking(Case):
    def test_settings(self):
        self.start()
        self.assertEqual(self.ctl("settings", "get", "safe_outputs")["settings"], {"safe_outputs": 0})
        self.ctl("settings", "set", "safe_outputs=5", "enable_input=none", "--keep")
        self.ctl("reset")
        self.assertEqual(self.ctl("settings", "list")["settings"]["safe_outputs"], 5)
        self.assertEqual(self.ctl("status")["outputs"], 5)
        for wrong in ("safe_outputs=16", "safe_outputs=none", "nothing=1", "safe_outputs"):
            self.ctl("settings", "set", "autostart=0", wrong, exit_code=2)
        self.assertEqual(self.ctl("settings", "get", "autostart")["settings"], {"autostart": 1})

    def test_what_goes_wrong_is_one_line_and_an_exit_code(self):
        self.start()
        cases = [
            (1, "there is no table", ["run"]),
            (1, "does not run", ["hold"]),
            (1, "no active table", ["download", "-o", self.path("x.bin")]),
            (2, "is no table", ["upload", SHUTTLE]),
            (2, "cannot be read", ["upload", self.path("none.bin")]),
            (2, "is no step", ["break", "S3"]),
            (2, "write IN0..IN5", ["force", "IN6=1"]),
            (2, "write IN0..IN5", ["force", "IN1=2"]),
            (3, "no answer from address 77", ["--address", "77", "status"], {"patience": 20}),
            (3, "is no gateway", ["--address", "1", "status"]),
            (3, "is the program running?", ["status"], {"port": "unix:" + self.path("none")}),
        ]
        for exit_code, words, arguments, *options in cases:
            result = self.call(*arguments, **dict(*options))
            self.assertEqual(result.returncode, exit_code, f"{arguments}: {result.stderr}")
            self.assertIn(words, result.stderr)
            self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
            self.assertEqual(result.stdout, "")
        self.assertFalse(os.path.exists(self.path("x.bin")))

    def test_usage(self):
        for arguments in ([], ["frob"], ["upload"], ["--address", "0", "status"], ["step", "0"], ["status"]):
            environment = {key: value for key, value in os.environ.items() if key != "NANOCTL_PORT"}
            result = subprocess.run([NANOCTL, *arguments], capture_output=True, text=True, env=environment, check=False)
            self.assertEqual(result.returncode, 2, arguments)
            self.assertEqual(result.stderr.count("\n"), 1, result.stderr)

    def test_watch_speaks_in_the_programs_names(self):
        self.start()
        self.ctl("upload", self.table, "--run")
        self.until(lambda status: status["step"] == 1)
        result = self.call(*self.sym(), "watch", "--for", "0.3")
        self.assertIn("running, step 1 S1", result.stdout)
        with open(self.path("other.bin"), "wb") as file:
            file.write(bytes.fromhex("C000003E80010000 3F00000000000000"))
        self.ctl("upload", self.path("other.bin"), "--stop")
        self.assertIn("belongs to another table", self.ctl(*self.sym(), "status", exit_code=2)["error"])


class Files(Case):
    def refused(self, words, *arguments):
        result = self.call(*arguments)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn(words, result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)

    def test_what_is_no_table_is_refused(self):
        self.start()
        with open(self.table, "rb") as file:
            table = file.read()
        with open(self.path("long.bin"), "wb") as file:
            file.write(table + bytes(8))
        self.refused(f"term {len(table) // 8 - 1} ends the table and 8 bytes follow it", "upload", self.path("long.bin"))
        self.refused("it is a folder", "upload", self.folder.name)
        self.refused("more than", "upload", "/dev/zero")
        missing = self.ctl("verify", self.table, exit_code=1)["error"]
        self.assertIn("neither stored nor active", missing)

    def test_a_download_replaces_no_link_and_no_pipe(self):
        self.start()
        self.ctl("upload", self.table)
        with open(self.table, "rb") as file:
            table = file.read()
        os.symlink("target.bin", self.path("link.bin"))
        self.ctl("download", "-o", self.path("link.bin"))
        self.assertTrue(os.path.islink(self.path("link.bin")))
        with open(self.path("target.bin"), "rb") as file:
            self.assertEqual(file.read(), table)
        os.mkfifo(self.path("fifo"))
        end = os.open(self.path("fifo"), os.O_RDONLY | os.O_NONBLOCK)
        self.ctl("download", "-o", self.path("fifo"))
        self.assertEqual(os.read(end, 10_000), table)
        os.close(end)
        self.assertTrue(stat.S_ISFIFO(os.stat(self.path("fifo")).st_mode))
        self.refused("No space left", "download", "-o", "/dev/full")

    def test_a_full_standard_output_is_said(self):
        with open("/dev/full", "w", encoding="ascii") as full:
            for command in ([NANOCTL, "man"], [NANOCTL, "--help"], [SEQC, "--version"], [SEQC, "disasm", self.table]):
                result = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
                self.assertEqual(result.returncode, 2, result.stderr)
                self.assertIn("cannot write to standard output", result.stderr)


class Patience(Case):
    def interrupt(self, *arguments, after):
        """Its answer to SIGTERM at the time when after() comes back."""
        process = subprocess.Popen([NANOCTL, "--port", self.endpoint, "--patience", "2000", "--json", *arguments],
                                   stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.running.append(process)
        after()
        process.send_signal(signal.SIGTERM)
        text = process.communicate(timeout=LONG)[0]
        self.assertEqual(process.returncode, 130, text)
        return json.loads(text)["error"]

    def test_an_upload_is_given_up_at_a_signal(self):
        self.start()
        crc = self.ctl("upload", self.table)["crc32"]
        said = self.interrupt("upload", self.big_table(), after=lambda: self.until(lambda status: status["upload"]))
        self.assertIn("the upload was aborted", said)
        status = self.ctl("status")
        self.assertEqual((status["upload"], status["stored_crc32"]), (False, crc))

    def test_a_step_that_comes_to_nothing_is_cancelled(self):
        self.start()
        self.ctl("upload", self.table, "--run")
        self.until(lambda status: status["step"] == 1)
        self.assertIn("nanoctl hold", self.ctl("step", exit_code=1)["error"])
        self.assertIn("runs already", self.ctl("run", exit_code=1)["error"])
        self.assertEqual(self.ctl("hold")["state"], "held")
        said = self.ctl("step", "--wait", "1", exit_code=1)["error"]
        self.assertIn("was cancelled: the sequence is held in step 1", said)
        said = self.interrupt("step", after=lambda: self.until(lambda status: status["state"] == "running"))
        self.assertIn("interrupted and cancelled: the sequence is held", said)


    def test_a_stop_is_asked_for_longer_than_anything_else(self):
        self.start()
        self.ctl("upload", self.table, "--run")
        proxy = NoisyProxy(self.path("deaf"), self.path("port"), 0, 1)
        deaf = "unix:" + self.path("deaf")
        proxy.swallow = 30
        self.ctl("status", port=deaf, patience=100, exit_code=3)
        proxy.swallow = 30
        self.ctl("stop", port=deaf, patience=100)
        proxy.close()
        self.assertEqual(self.ctl("status")["state"], "stopped")


class Words(Case):
    def test_wrong_usage_is_a_document_too(self):
        for arguments, words in ((["badcmd"], "'badcmd' is no command"), (["settings", "foo"], "'foo' is no command"),
                                 (["step", "0"], "0")):
            said = self.ctl(*arguments, exit_code=2)["error"]
            self.assertIn(words, said)

    def test_settings_say_which_and_why(self):
        self.start()
        said = self.ctl("settings", "set", "motor_address=128", exit_code=1)["error"]
        self.assertIn("motor_address=128: the address is taken", said)
        self.ctl("settings", "set", "user_baud=1201", exit_code=2)
        text = self.call("settings", "set", "user_baud=38400").stdout
        self.assertIn("only if kept", text)

    def test_a_kept_address_counts_from_the_reset_on(self):
        self.start()
        text = self.call("settings", "set", "gateway_address=6", "--keep").stdout
        self.assertIn("next reset", text)
        self.assertEqual(self.ctl("status")["state"], "stopped", "still at 128")
        self.assertEqual(self.ctl("reset")["address"], 6)
        self.assertEqual(self.ctl("--address", "6", "status")["state"], "stopped")
        self.assertIn("no answer from address 128", self.ctl("status", exit_code=3, patience=20)["error"])

    def test_a_motor_speed_that_the_motor_has_not_is_said(self):
        process = self.start()
        self.ctl("upload", self.table)
        self.ctl("settings", "set", "motor_baud=38400", "--keep")
        self.assertTrue(self.ctl("status")["ok"])
        process.send_signal(signal.SIGTERM)
        process.wait(LONG)
        process = self.start()
        self.assertNotEqual(self.ctl("status")["link"], "up")
        process.send_signal(signal.SIGTERM)
        self.assertIn("setting motor_baud is 38400 and the motor's is 19200", process.communicate(timeout=LONG)[1])

    def test_forces(self):
        self.start()
        self.assertIn("named twice", self.ctl("force", "IN0=1", "IN0=0", exit_code=2)["error"])
        self.assertTrue(self.ctl("force", "OUT2=1")["outputs_kept_safe"])
        self.assertIn("the safe state keeps the outputs", self.call("force").stdout)

    def test_a_force_of_an_inverted_input_is_of_its_wire(self):
        with open(self.path("g.seq"), "w", encoding="utf-8") as file:
            file.write("PROGRAM G MOTOR MAC140; VAR_INPUT Estop AT NOT IN2; END_VAR STEP A: OWN ERROR; IF NOT Estop THEN "
                       "NEXT := B; END_IF END_STEP STEP B: OWN ERROR; IF Estop THEN NEXT := A; END_IF END_STEP END_PROGRAM\n")
        subprocess.run([SEQC, "build", self.path("g.seq"), "--quiet", "-o", self.path("g.bin")], check=True)
        names = "--sym", self.path("g.sym")
        self.start()
        self.ctl("upload", self.path("g.bin"), "--run")
        self.assertIn("Estop", self.call(*names, "status").stdout)
        refused = self.ctl(*names, "force", "Estop=1", exit_code=2)["error"]
        self.assertIn("Estop is NOT IN2, and a force is of the wire: write IN2=0 for Estop on, IN2=1 for off", refused)
        self.assertEqual(self.ctl(*names, "force", "IN2=1")["forced"], {"NOT Estop": 1})
        self.until(lambda status: status["step"] == 2)

    def test_kept_forces_that_are_ended_elsewhere_end_it(self):
        self.start()
        for end, by in ((("force", "--off"), "ended elsewhere"), (("safe",), "ended by a safe command")):
            forcing = subprocess.Popen([NANOCTL, "--port", self.endpoint, "--patience", "2000", "force", "IN0=1", "--keep"],
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            self.running.append(forcing)
            self.assertIn("IN0 = 1", forcing.stdout.readline())
            self.ctl(*end)
            self.assertIn("the forces were " + by, forcing.communicate(timeout=LONG)[1])
            self.assertEqual(forcing.returncode, 1)
            self.running.remove(forcing)

    def test_watch_and_kept_forces_end_with_who_reads_them(self):
        self.start()
        for arguments in (("watch", "--interval", "60000"), ("force", "IN0=1", "--keep")):
            process = subprocess.Popen([NANOCTL, "--port", self.endpoint, "--patience", "2000", *arguments],
                                       stdout=subprocess.PIPE, text=True)
            self.running.append(process)
            process.stdout.readline()
            process.stdout.close()
            self.assertEqual(process.wait(LONG), 0)
            self.running.remove(process)
        self.assertFalse(self.ctl("status")["forced_inputs"])

    def test_terms_are_counted_as_seqc_does(self):
        self.start()
        terms = os.path.getsize(self.table) // 8 - 1
        self.assertIn(f"{terms} terms and the end term", self.call("upload", self.table).stdout)
        self.assertIn(f"{terms} terms and the end term", self.call("status").stdout)


class Generated(unittest.TestCase):
    def output(self, *arguments):
        return subprocess.run([NANOCTL, *arguments], capture_output=True, text=True, check=True).stdout

    def completed(self, *words):
        script = ('source /dev/stdin; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _nanoctl; printf "%s\n" "${COMPREPLY[@]}"')
        result = subprocess.run(["bash", "-c", script, "bash", "nanoctl", *words], input=self.output("completion", "bash"),
                                capture_output=True, text=True, check=True)
        return result.stdout.split()

    def test_bash_completes_commands_and_options(self):
        self.assertEqual(self.completed("up"), ["upload"])
        self.assertEqual(self.completed("upload", "--only"), ["--only-store"])
        self.assertEqual(self.completed("settings", "ge"), ["get"])
        self.assertIn("--json", self.completed("status", "--"))

    def test_zsh_completes_commands_and_options(self):
        if shutil.which("zsh") is None:
            self.skipTest("zsh is not installed: its completion is not tried")
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "_nanoctl"), "w", encoding="utf-8") as file:
                file.write(self.output("completion", "zsh"))
            shell = zsh.Zsh(folder)
            try:
                self.assertTrue(shell.completes("nanoctl up", "nanoctl upload "))
                self.assertTrue(shell.completes("nanoctl settings ge", "nanoctl settings get "))
                self.assertTrue(shell.completes("nanoctl upload --only", "--only-store "))
                self.assertTrue(shell.completes("nanoctl --json up", "nanoctl --json upload "), "a flag has no value")
            finally:
                shell.close()

    def test_the_manual_page_is_sound(self):
        page = self.output("man")
        for words in (".SS upload table", ".SS settings set values", "\\-\\-port", "Exit codes: 0"):
            self.assertIn(words, page)
        if shutil.which("groff") is None:
            return print("groff is not installed: the manual page is not shown")
        shown = subprocess.run(["groff", "-man", "-Tascii", "-ww"], input=page, capture_output=True, text=True, check=True)
        self.assertEqual(shown.stderr, "")
        self.assertIn("nanoctl", shown.stdout)


if __name__ == "__main__":
    NANOCTL, SIM, SEQC, SHUTTLE, MACREG = sys.argv[1:6]
    unittest.main(argv=[sys.argv[0], *sys.argv[6:]])
