#!/usr/bin/env python3
"""Signed orders for tables, over a real broker: taken, tried, confirmed or rolled back; forged, old and halves refused.

usage: orders_test.py NANOPLC MACSIM NANOCTL MACREG SEQC MENDING NANOFLEET [TEST ...]
"""

import hashlib
import json
import os
import random
import signal
import stat
import subprocess
import sys
import time
import unittest

import fleet_case
import service_case
from fleet_case import nanofleet
from stored_case import SmallDisk

RESTART = 'activate = "restart"\n'


class Taken(fleet_case.FleetCase):
    def test_from_the_order_to_a_healthy_table(self):
        service = self.begin(RESTART)
        table, wanted = self.build("two", 1024)
        self.moves()
        self.order(table, 1)
        report = self.plant.wait_state(self.TARGET, "confirmed", 1)
        self.assertEqual((report["table"]["sha256"], report["table"]["name"], report["state"]), (wanted, "two", "running"))
        self.assertEqual(self.what_runs(), wanted)
        self.moves()
        self.assertIn("order 1 (table two): confirmed", service.said())
        # In their order; what was quick may be left out.
        states = [report["order"]["state"] for report in self.plant.history if report["order"]["counter"] == 1]
        steps = ["fetching", "waiting", "activating", "trial", "confirmed"]
        self.assertEqual(states, sorted(states, key=steps.index))
        self.assertEqual(self.end(service), 0)
        # After a restart it is what runs, since then, and nothing is done again.
        service = self.start(self.configure(RESTART))
        again = self.plant.wait(self.TARGET, lambda new: new["time"] > report["time"])
        self.assertEqual((again["table"], again["order"]), (report["table"], report["order"]))
        self.assertNotIn("order 1", service.said())

    def test_a_running_sequence_is_never_stopped_unless_told(self):
        self.begin()
        table, wanted = self.build("two", 1024)
        self.moves()
        self.order(table, 1)
        self.plant.wait(self.TARGET, lambda report: report["order"]["text"] == "waits until the sequence is stopped")
        self.moves()
        self.assertEqual(self.what_runs(), self.first)
        self.ctl("stop")
        self.plant.wait_state(self.TARGET, "trial", 1)
        self.assertEqual(self.what_runs(), wanted)
        self.assertEqual(self.ctl("status")["state"], "stopped")
        self.ctl("run")
        self.plant.wait_state(self.TARGET, "confirmed", 1)

    def test_only_in_the_window(self):
        hour = time.localtime().tm_hour
        out = f"{(hour + 2) % 24:02}:00-{(hour + 4) % 24:02}:00"
        service = self.begin(f'{RESTART}window = "{out}"')
        table, wanted = self.build("two", 1024)
        self.order(table, 1)
        self.plant.wait(self.TARGET, lambda report: report["order"]["text"] == f"waits for the window {out}")
        self.moves()
        self.assertEqual(self.what_runs(), self.first)
        self.assertEqual(self.end(service), 0)
        self.start(self.configure(f'{RESTART}window = "{(hour + 4) % 24:02}:00-{(hour + 2) % 24:02}:00"'))
        self.plant.wait_state(self.TARGET, "confirmed", 1)
        self.assertEqual(self.what_runs(), wanted)

    def test_pieces_that_come_late_wrong_and_without_an_order(self):
        """A full table has three pieces."""
        self.begin(RESTART)
        table = self.path("full.bin")
        with open(self.table, "rb") as file:
            terms = file.read()
        with open(table, "wb") as file:
            file.write(terms[:-8] + terms[-16:-8] * (1025 - len(terms) // 8) + terms[-8:])
        order, *pieces = self.sign(table, 1)
        self.assertEqual(len(pieces), 3)
        self.plant.publish(*order)
        self.plant.wait_state(self.TARGET, "fetching", 1)
        for topic, payload in reversed(pieces):
            self.plant.publish(topic, payload[:-1])
            self.plant.publish(topic.rsplit("/", 1)[0] + "/7", payload)
        self.plant.wait(self.TARGET, lambda report: "cannot have" in (report["order"]["text"] or ""))
        for topic, payload in reversed(pieces):
            self.plant.publish(topic, bytes(len(payload)))
        self.plant.wait(self.TARGET, lambda report: "do not fit" in (report["order"]["text"] or ""))
        self.assertEqual(self.what_runs(), self.first)
        self.broker.stop()
        self.plant.ready.clear()
        self.broker.start()  # has forgotten everything
        self.assertTrue(self.plant.ready.wait(fleet_case.LONG))
        for message in pieces[2:] + pieces[:1] * 3 + pieces[1:]:
            self.plant.publish(*message)
        report = self.plant.wait_state(self.TARGET, "confirmed", 1)
        self.assertEqual(report["table"]["sha256"], self.what_runs())
        self.assertEqual(report["table"]["bytes"], os.path.getsize(table))

    def test_a_newer_order_takes_the_place_of_one_that_waits(self):
        self.begin()
        self.moves()
        old, _ = self.build("two", 1024)
        new, wanted = self.build("three", 512)
        self.order(old, 1)
        self.plant.wait_state(self.TARGET, "waiting", 1)
        self.order(new, 5)
        self.plant.wait_state(self.TARGET, "waiting", 5)
        self.ctl("stop")
        self.plant.wait_state(self.TARGET, "trial", 5)
        self.assertEqual(self.what_runs(), wanted)

    def test_what_runs_already_is_confirmed_at_once(self):
        self.begin()
        self.moves()
        self.order(self.table, 3)
        report = self.plant.wait_state(self.TARGET, "confirmed", 3)
        self.assertEqual(report["order"]["text"], "it runs already")
        self.moves()


class Refused(fleet_case.FleetCase):
    def test_forged_old_and_foreign_orders(self):
        service = self.begin(RESTART)
        nanofleet("keys", "make", "stranger", "--folder", self.keys)
        table, _ = self.build("two", 1024)
        (topic, text), *pieces = self.sign(table, 7)
        for piece in pieces:
            self.plant.publish(*piece)
        changed = text.replace(b"counter 7", b"counter 8")
        _, stranger = self.sign(table, 9, "stranger")[0]
        with open(os.path.join(self.keys, "maker.pub"), encoding="utf-8") as file:
            maker = file.read().split()[2].encode()
        forged = stranger.replace(stranger.split(b"key ")[1][:64], maker)
        _, other = self.sign(table, 9, target="plant/cell/y")[0]
        for payload, words in ((changed, "its signature is not of key maker"), (stranger, "its key "),
                               (forged, "its signature is not of key maker"), (other, "it is for plant/cell/y"),
                               (text[:-2], "it has no line `signature`"), (b"\xff" * 900, "it is no order"),
                               (text * 4, "it is longer than 1024 bytes")):
            self.plant.publish(topic, payload)
            self.wait_refused(words)
            self.assertIn(words, service.said())
        self.moves()
        self.assertEqual(self.what_runs(), self.first)
        # The right one is taken all the same, and then no older and no repeated one.
        self.plant.publish(topic, text)
        self.plant.wait_state(self.TARGET, "confirmed", 7)
        for counter in (7, 6):
            old, _ = self.build("old", 300 + counter)
            self.order(old, counter)
            self.wait_refused(f"its counter {counter} is not greater than the last one, 7")
        count = self.plant.reports[self.TARGET]["refused"]["count"]
        self.plant.publish(topic, text)  # as a broker repeats it
        self.order(old, 5)
        report = self.wait_refused("its counter 5 ")
        self.assertEqual(report["refused"]["count"], count + 1)
        self.assertEqual((report["order"]["state"], report["order"]["counter"]), ("confirmed", 7))
        self.assertEqual(self.what_runs(), report["table"]["sha256"])

    def test_a_key_that_was_taken_away(self):
        self.begin(RESTART)
        os.remove(os.path.join(self.trusted, "maker.pub"))
        table, _ = self.build("two", 1024)
        self.order(table, 1)
        self.wait_refused("its key ")
        with open(os.path.join(self.trusted, "broken.pub"), "w", encoding="utf-8") as file:
            file.write("nanoplc-public-key\n")
        self.trust("maker")
        self.order(table, 2)
        self.wait_refused("broken.pub: is no public key of `nanofleet keys`; no order is taken until it is mended")
        os.remove(os.path.join(self.trusted, "broken.pub"))
        self.order(table, 3)
        self.plant.wait_state(self.TARGET, "confirmed", 3)

    def test_what_the_firmware_does_not_take(self):
        service = self.begin(RESTART, axis="[axis.settings]\nrequire_proof = false\n")
        bad = self.path("bad.bin")
        with open(self.table, "rb") as file:
            terms = file.read()
        with open(bad, "wb") as file:
            file.write(terms[:-8])
        # Made as nanofleet makes them, though it would not sign such a table.
        with open(self.path("good.bin"), "wb") as file:
            file.write(terms)
        self.plant.wait(self.TARGET, lambda report: report["table"]["sha256"] == self.first)
        self.assertEqual(nanofleet("sign", bad, "--target", self.TARGET, "--counter", "1", "--key",
                                   os.path.join(self.keys, "maker.key"), "-o", self.path("bad"), exit_code=2).stdout, "")
        self.assertFalse(os.path.exists(self.path("bad")))
        self.ctl("stop")
        self.ctl("settings", "set", "require_proof=1")
        table, _ = self.build("two", 1024)
        self.order(table, 2)
        report = self.plant.wait_state(self.TARGET, "failed", 2)
        self.assertIn("it has no certificate", report["order"]["text"])
        self.assertEqual(self.what_runs(), self.first)
        self.assertIn("order 2 (table two): failed", service.said())

    def test_a_record_that_is_damaged_or_gone_takes_no_order(self):
        service = self.begin(RESTART)
        table, wanted = self.build("two", 1024)
        self.order(table, 1)
        self.plant.wait_state(self.TARGET, "confirmed", 1)
        self.assertEqual(self.end(service), 0)
        record = self.path("state/x/orders")
        with open(record, "rb") as file:
            whole = file.read()
        for damaged in (None, b"", whole[:50], whole.replace(b'"counter":1', b'"counter":0')):
            os.remove(record)
            if damaged is not None:
                with open(record, "wb") as file:
                    file.write(damaged)
            service = self.start(self.configure(RESTART))
            report = self.plant.wait(self.TARGET, lambda report: "which orders came before is not known" in (report["order"]["text"] or ""))
            self.assertEqual(report["table"]["sha256"], wanted)
            again, _ = self.build("three", 512)
            self.order(again, 9)
            self.wait_refused("which orders came before is not known")
            self.assertEqual(self.end(service), 0)
            self.plant.reports.clear()
            with open(record, "wb") as file:
                file.write(whole)

    def test_a_disk_that_takes_nothing(self):
        service = self.begin(RESTART)
        table, wanted = self.build("two", 1024)
        self.until(lambda: os.path.exists(self.path("state/x/orders")), service)
        os.remove(self.path("state/x/orders"))
        os.mkdir(self.path("state/x/orders"))
        self.order(table, 1)
        self.plant.wait(self.TARGET, lambda report: "cannot be written" in (report["order"]["text"] or ""))
        self.moves()
        self.assertEqual(self.what_runs(), self.first)
        os.rmdir(self.path("state/x/orders"))
        self.plant.wait_state(self.TARGET, "confirmed", 1)
        self.assertEqual(self.what_runs(), wanted)


class OnAFullDisk(SmallDisk, fleet_case.FleetCase):
    def test_an_order_waits_for_room_and_says_so_once(self):
        service = self.start_inside(self.configure(RESTART))
        with open(self.table, "rb") as file:
            first = hashlib.sha256(file.read()).hexdigest()
        self.plant.wait(self.TARGET, lambda report: report["table"]["sha256"] == first)
        table, wanted = self.build("two", 1024)
        self.fill()
        self.order(table, 1)
        self.plant.wait(self.TARGET, lambda report: "No space left on device" in (report["order"]["text"] or report["refused"]["last"] or ""))
        self.moves()
        self.assertEqual(self.what_runs(), first)
        self.assertEqual(service.said().count("No space left on device"), 1, service.said())
        os.remove(self.state + "/fill")
        self.plant.wait_state(self.TARGET, "confirmed", 1)
        self.assertEqual(self.what_runs(), wanted)


class RolledBack(fleet_case.FleetCase):
    def test_error_on_trial_brings_the_former_table_back(self):
        self.healthy_after, self.healthy_within = 60_000, 65_000
        service = self.begin(RESTART)
        table, wanted = self.build("two", 1024)
        self.order(table, 1)
        self.plant.wait_state(self.TARGET, "trial", 1)
        self.until_status(lambda status: status["state"] == "running")
        self.assertEqual(self.what_runs(), wanted)
        self.pull_out()
        self.plant.wait_state(self.TARGET, "failing", 1)
        self.plug_in()
        report = self.plant.wait_state(self.TARGET, "rolled_back", 1)
        self.assertIn("ERROR in step", report["order"]["text"])
        self.assertEqual((report["table"]["sha256"], self.what_runs()), (self.first, self.first))
        self.assertIn("rolled_back: ERROR in step", service.said())
        self.order(table, 2)
        self.plant.wait_state(self.TARGET, "trial", 2)

    def test_it_does_not_stop_a_sequence_to_go_back(self):
        self.healthy_after, self.healthy_within = 60_000, 65_000
        self.begin()
        table, _ = self.build("two", 1024)
        self.ctl("stop")
        self.order(table, 1)
        self.plant.wait_state(self.TARGET, "trial", 1)
        self.ctl("run")
        self.moves()
        self.pull_out()
        self.plant.wait_state(self.TARGET, "failing", 1)
        self.plug_in()
        self.moves()
        self.plant.wait(self.TARGET, lambda report: "waits until the sequence is stopped" in report["order"]["text"])
        self.ctl("stop")
        self.plant.wait_state(self.TARGET, "rolled_back", 1)
        self.assertEqual(self.what_runs(), self.first)

    def test_somebody_elses_table_ends_the_trial(self):
        self.healthy_after, self.healthy_within = 60_000, 65_000
        self.begin(RESTART)
        table, _ = self.build("two", 1024)
        self.order(table, 1)
        self.plant.wait_state(self.TARGET, "trial", 1)
        mine, wanted = self.build("three", 512)
        self.until_status(lambda status: status["state"] == "running")
        while self.what_runs() != wanted:  # on a machine that is busy a command may be too late
            nanoctl = [service_case.NANOCTL, "--port", "unix:" + self.path("x"), "upload", mine, "--stop", "--run"]
            subprocess.run(nanoctl, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=fleet_case.LONG, check=False)
        report = self.plant.wait_state(self.TARGET, "failed", 1)
        self.assertEqual((report["table"]["sha256"], report["table"]["name"]), (wanted, None))


class Killed(fleet_case.FleetCase):
    def test_at_any_place(self):
        """kill -9 at random moments: at the end it is the table of the last order, and never a half or an older one."""
        seed = random.randrange(1_000_000)
        print(f"seed {seed}")
        chance = random.Random(seed)
        service = self.begin(RESTART)
        hashes = {self.first}
        config = self.configure(RESTART)
        for counter in range(1, 7):
            table, wanted = self.build("new", 1000 + counter)
            hashes.add(wanted)
            self.order(table, counter)
            for _ in range(3):
                time.sleep(chance.uniform(0, 0.7))
                self.end(service, signal.SIGKILL)
                service = self.start(config)
            # A run that was killed waits for the user; the order does not.
            self.plant.wait(self.TARGET, lambda report, counter=counter: report["order"]["counter"] == counter and
                            report["order"]["state"] in ("trial", "confirmed"))
            self.ctl("run", exit_code=0 if self.ctl("status")["state"] == "stopped" else 1)
            report = self.plant.wait_state(self.TARGET, "confirmed", counter)
            self.assertEqual((report["table"]["sha256"], self.what_runs()), (wanted, wanted))
            self.assertTrue(all(report["table"]["sha256"] in hashes for report in self.plant.history))
        self.moves()


class Keys(fleet_case.FleetCase):
    def test_made_once_listed_and_told(self):
        secret = os.path.join(self.keys, "maker.key")
        self.assertEqual(stat.S_IMODE(os.stat(secret).st_mode), 0o600)
        with open(secret, "rb") as file:
            before = file.read()
        said = nanofleet("keys", "make", "maker", "--folder", self.keys, exit_code=2).stderr
        self.assertIn("is there already, and a key is never overwritten", said)
        with open(secret, "rb") as file:
            self.assertEqual(file.read(), before)
        listed = json.loads(nanofleet("--json", "keys", "list", "--folder", self.keys).stdout)["keys"]
        self.assertEqual([(key["name"], key["secret"]) for key in listed], [("maker", True)])
        with open(os.path.join(self.keys, "maker.pub"), encoding="utf-8") as file:
            self.assertEqual(nanofleet("keys", "public", secret).stdout, file.read())
        os.chmod(secret, 0o640)
        said = nanofleet("keys", "public", secret, exit_code=2).stderr
        self.assertIn("can be read or written by others", said)

    def test_mistakes_of_the_configuration(self):
        code, said = self.check('[mqtt]\nbroker = "h:1883"\nnode = "a "\n[mqtt.orders]\nkeys = "keys"\nactivate = "now"\n'
                                f'window = "25:00-26:00"\nhealthy_step = 63\nrepeat = 1\n{self.axis()}', "--no-devices")
        self.assertEqual(code, 2)
        for key in ("mqtt.node", "mqtt.orders.keys", "mqtt.orders.activate", "mqtt.orders.window", "mqtt.orders.healthy_step",
                    "mqtt.orders.repeat"):
            self.assertTrue(any(f"{key}: " in line for line in said), said)


if __name__ == "__main__":
    (service_case.NANOPLC, service_case.MACSIM, service_case.NANOCTL, service_case.MACREG, service_case.SEQC, service_case.MENDING,
     fleet_case.NANOFLEET) = sys.argv[1:8]
    unittest.main(argv=[sys.argv[0], *sys.argv[8:]])
