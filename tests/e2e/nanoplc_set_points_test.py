#!/usr/bin/env python3
"""Set-points and recipes of nanoplc: many clients at once, clients that are halted or killed, a slow, full or read-only disk, damaged values.

usage: nanoplc_set_points_test.py NANOPLC MACSIM NANOCTL MACREG SEQC PROGRAM.seq SLOW_DISK.so
"""

import json
import random
import re
import signal
import socket
import struct
import subprocess
import sys
import threading
import time
import unittest

import service_case
from service_case import LONG
from stored_case import SET_POINTS, SmallDisk, Stored

SLOW_DISK = ""
DEFAULTS = {"Length": 80, "Speed": 1500, "Blade_Time": 300, "Pieces": 3}


def changed(number):
    """One set, which no other change has a value of."""
    return {"Length": 20 + number, "Speed": 200 + number, "Blade_Time": 400 + number, "Pieces": 10 + number}


class Values(Stored):
    def begin(self, kind="unix", slow=0):
        """With a disk that takes so many milliseconds for every write."""
        self.kind = kind
        config = self.write(self.axis(port=f"{kind}:{self.path('x')}"))
        more = {"LD_PRELOAD": SLOW_DISK, "SLOW_DISK_MS": str(slow), "ASAN_OPTIONS": "verify_asan_link_order=0"} if slow else {}
        service = self.start(config, **more)
        self.upload_first()
        return config, service

    def upload_first(self):
        self.until(lambda: self.status()["link"] in ("up", "not acknowledged"))
        if self.status()["table_bytes"] == 0:  # a busy machine may lose the link meanwhile
            self.until(lambda: self.end_of(self.nanoctl("upload", "--stop", self.table, "--run"))[0] == 0)

    def nanoctl(self, *arguments):
        command = [service_case.NANOCTL, "--port", f"{self.kind}:{self.path('x')}", "--patience", "500", "--json", *arguments]
        # pylint: disable-next=consider-using-with
        return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def end_of(self, process):
        output, errors = process.communicate(timeout=2 * LONG)
        return process.returncode, output + errors

    def ask(self, *arguments):
        code, told = self.end_of(self.nanoctl(*arguments))
        self.assertEqual(code, 0, told)
        return json.loads(told.splitlines()[-1])

    def status(self):
        return self.ask("status")

    @staticmethod
    def changing(number):
        return ["set-points", "set", *(f"{name}={value}" for name, value in changed(number).items())]

    def values(self):
        return {point["name"]: point["value"] for point in self.ask("set-points")["set_points"]}

    def recipes(self):
        return {recipe["name"]: recipe["values"] for recipe in self.ask("recipe", "list")["recipes"]}

    def until_done(self, *arguments):
        """Refused meanwhile only because another client operates or is being served; how often."""
        end = time.monotonic() + LONG
        refusals = 0
        while time.monotonic() < end:
            code, told = self.end_of(self.nanoctl(*arguments))
            if code == 0:
                return refusals
            refusals += 1
            self.assertRegex(told, "operates|not now; try again|waited longer than 1 s")
        self.fail(f"never done: {arguments}: {told}")


class Clients(Values):
    def test_eight_clients_save_new_recipes_at_once(self):
        self.begin()
        names = [f"Product {number}" for number in range(8)]
        threads = [threading.Thread(target=self.until_done, args=("recipe", "save", name)) for name in names]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        recipes = self.ask("recipe", "list")["recipes"]
        self.assertEqual(sorted(recipe["name"] for recipe in recipes), names)
        self.assertEqual(sorted(recipe["number"] for recipe in recipes), list(range(1, 9)))
        code, told = self.end_of(self.nanoctl("recipe", "save", "Ninth"))
        self.assertEqual(code, 1, told)
        self.assertIn("all recipes are taken; delete one, or save under a name that is there", told)
        self.ask("recipe", "save", "PRODUCT 3")

    def halted_in_the_middle(self, kind):
        self.begin(kind)
        before = self.values()
        dice = random.Random(4)
        for number in range(1, 9):
            client = self.nanoctl(*self.changing(number))
            time.sleep(dice.uniform(0, 0.1))
            client.send_signal(signal.SIGSTOP)
            self.others_go_on(client, (before, changed(number)))
            client.send_signal(signal.SIGCONT)
            code, told = self.end_of(client)
            if code == 0:
                before = changed(number)
            else:
                self.assertEqual(code, 1, told)
                self.assertRegex(told, "operates|waited longer than 1 s")
            self.assertEqual(self.values(), before, told)

    def others_go_on(self, client, sets):
        """Or get a message that names the other program: one program uses a terminal at a time."""
        if self.kind == "pty":
            code, told = self.end_of(self.nanoctl("recipe", "save", "Beside"))
            if code != 0:
                self.assertIn(f"nanoctl (process {client.pid}) holds this port; end it first", told)
                return
        else:
            self.until_done("recipe", "save", "Beside")
        self.assertIn(self.recipes()["Beside"], sets, "a mixture")

    def test_one_that_is_halted_in_the_middle_at_a_socket(self):
        self.halted_in_the_middle("unix")

    def test_one_that_is_halted_in_the_middle_at_a_terminal(self):
        self.halted_in_the_middle("pty")

    def test_one_that_is_killed_in_the_middle(self):
        for kind in ("unix", "pty"):
            with self.subTest(kind=kind):
                _, service = self.begin(kind)
                before = self.values()
                dice = random.Random(5)
                for number in range(1, 13):
                    client = self.nanoctl(*self.changing(number))
                    time.sleep(dice.uniform(0, 0.1))
                    client.kill()
                    client.communicate()
                    self.until_done("recipe", "save", "After")
                    after = self.values()
                    self.assertIn(after, (before, changed(number)), "a mixture")
                    before = after
                self.end(service)
                self.pull_out()
                self.plug_in()


class Plant(Values):
    def master(self):
        config = self.write(self.axis(port="unix:" + self.path("x")), service='[modbus]\nlisten = "tcp:127.0.0.1:0"\n')
        self.kind = "unix"
        service = self.start(config, wait_for="Modbus: listens")
        self.upload_first()
        port = int(re.search(r"Modbus: listens\D*127\.0\.0\.1:(\d+)", service.said()).group(1))
        master = socket.create_connection(("127.0.0.1", port))
        self.addCleanup(master.close)
        master.sendall(self.writing(0, 0, 0))  # its numbers begin
        self.assertEqual(len(master.recv(12)), 12)
        return master

    @staticmethod
    def writing(address, *words):
        body = struct.pack(f">BBHHB{len(words)}H", 1, 16, address, len(words), 2 * len(words), *words)
        return struct.pack(">HHH", 1, 0, len(body)) + body

    def test_a_master_that_falls_silent_before_its_command_has_changed_nothing(self):
        master = self.master()
        master.sendall(self.writing(6, 0, 900, 0, 20_000))  # Length 90.0 mm, Speed 2000.0 rpm
        self.assertEqual(len(master.recv(12)), 12)
        self.assertEqual(self.until_done("set-points", "set", "Pieces=7"), 0)
        self.assertEqual(self.values(), DEFAULTS | {"Pieces": 7})

    def test_one_that_is_silent_after_it_lets_others_operate_soon(self):
        master = self.master()
        for half in (0, 1):
            master.sendall(self.writing(6, 0, 900 + half, 0, 20_000))
            self.assertEqual(len(master.recv(12)), 12)
            command = self.writing(0, 34, 1 + half)
            master.sendall(command[:len(command) // 2] if half else command)
            self.until_done("set-points", "set", f"Pieces={7 + half}")
            if not half:
                self.assertEqual(len(master.recv(12)), 12)
                master.sendall(struct.pack(">HHHBBHH", 1, 0, 6, 1, 4, 41, 2))
                self.assertEqual(struct.unpack(">HH", master.recv(13)[9:]), (1, 0), "done")
            self.assertEqual(self.values(), DEFAULTS | {"Length": 90, "Speed": 2000, "Pieces": 7 + half})


class SlowDisk(Values):
    """It takes 300 ms for every write, so some eight seconds for a change: longer than any answer is waited for."""

    def test_the_answer_is_the_real_end_and_others_go_on(self):
        self.begin(slow=300)
        begun = time.monotonic()
        client = self.nanoctl(*self.changing(1))
        while time.monotonic() < begun + 1:
            self.status()
            self.assertIsNone(client.poll(), "the disk was not slow")
        stop = time.monotonic()
        self.ask("stop")
        self.assertLess(time.monotonic() - stop, 1)
        self.assertIsNone(client.poll(), "the disk was not slow")
        self.until_done("recipe", "save", "Beside")
        code, told = self.end_of(client)
        self.assertEqual(code, 0, told)
        self.assertGreater(time.monotonic() - begun, 3, "the disk was not slow")
        self.assertEqual(self.values(), changed(1))
        self.assertIn("Beside", self.recipes())

    def test_a_service_that_is_killed_meanwhile_has_the_old_or_the_new_set(self):
        config, service = self.begin(slow=100)  # a change takes a third as long
        for number, wait in enumerate((0.2, 0.4, 0.7, 1, 1.7, 2.7), 1):
            before = self.values()
            client = self.nanoctl(*self.changing(number))
            time.sleep(wait)
            self.end(service, signal.SIGKILL)
            code, told = self.end_of(client)
            if code != 0:
                self.assertEqual(code, 3, told)
                self.assertIn("whether it was stored is not known", told)
            self.pull_out()  # the killed one's exclusive use of the line outlives it
            self.plug_in()
            service = self.start(config)
            self.until(lambda: self.status()["link"] in ("up", "not acknowledged"))
            after = self.values()
            self.assertIn(after, (before, changed(number)), "a mixture")
            if code == 0:
                self.assertEqual(after, changed(number))
            self.ask(*self.changing(40))
            self.end(service)
            _, service = self.begin(slow=100)


class Damaged(Values):
    def stored(self):
        config, service = self.begin()
        self.ask(*self.changing(1))
        self.ask("recipe", "save", "Kept")
        self.end(service)
        return config

    def test_a_flipped_bit_starts_nothing_and_is_said(self):
        config = self.stored()
        # The change and the recipe: the second one is in the second slot. Its active recipe, a value, the recipe's name.
        for offset in (24 + 2, 24 + 8 + 4, 24 + 8 + 144):
            self.flip(self.store, SET_POINTS[1] + offset)
            service, status = self.expect_waits(config, "bad set-points", "set-points")
            self.assertEqual(self.values(), changed(1), "the older ones")
            self.assertEqual(self.recipes(), {})
            code, told = self.end_of(self.nanoctl("set-points"))
            self.assertEqual(code, 0)
            self.assertTrue(json.loads(told)["damaged"], told)
            self.assertTrue(status["set_points_damaged"])
            self.flip(self.store, SET_POINTS[1] + offset)
            self.end(service)
        self.flip(self.store, SET_POINTS[1] + 24 + 8 + 4)
        service, _ = self.expect_waits(config, "bad set-points", "set-points")
        self.ask(*self.changing(2))
        self.ask("run")
        self.end(service)
        self.start(config)
        self.until_status(lambda status: status["state"] == "running")
        self.assertEqual(self.values(), changed(2))

    def test_both_slots_lost(self):
        config = self.stored()
        for slot in SET_POINTS:
            self.erase(slot, 0)
        self.expect_waits(config, "bad set-points", "set-points")
        self.assertEqual(self.values(), DEFAULTS)


class FullDisk(SmallDisk, Values):
    def stored_inside(self):
        self.kind = "unix"
        config = self.write(self.axis())
        service = self.start_inside(config)
        self.upload_first()
        self.ask(*self.changing(1))
        return config, service

    def test_a_full_one_takes_changes_all_the_same(self):
        config, service = self.stored_inside()
        self.fill()
        self.ask(*self.changing(2))
        self.ask("recipe", "save", "Full")
        self.assertEqual(self.end(service), 0)
        self.start_inside(config)
        self.assertEqual(self.values(), changed(2))
        self.assertEqual(self.recipes(), {"Full": changed(2)})

    def test_a_read_only_one_changes_nothing_and_says_so(self):
        config, service = self.stored_inside()
        self.assertEqual(self.end(service), 0)
        subprocess.run([*self.inside, "mount", "-o", "remount,ro", self.path("state")], check=True)
        service = self.start_inside(config)
        self.until(lambda: "Read-only file system" in service.said(), service)
        status = self.status()
        self.assertEqual((status["state"], status["safe_reason"]), ("stopped", "no store"))
        code, told = self.end_of(self.nanoctl(*self.changing(2)))
        self.assertEqual(code, 1, told)
        subprocess.run([*self.inside, "mount", "-o", "remount,rw", self.path("state")], check=True)
        self.until_status(lambda status: status["safe_reason"] != "no store")
        self.assertEqual(self.values(), changed(1))


if __name__ == "__main__":
    (service_case.NANOPLC, service_case.MACSIM, service_case.NANOCTL, service_case.MACREG, service_case.SEQC,
     service_case.MENDING, SLOW_DISK) = sys.argv[1:8]
    unittest.main(argv=sys.argv[:1] + sys.argv[8:])
