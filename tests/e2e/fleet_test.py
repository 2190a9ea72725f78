#!/usr/bin/env python3
"""nanofleet with gateways and a real broker: what they run, and a roll-out to all of them.

usage: fleet_test.py NANOPLC MACSIM NANOCTL MACREG SEQC MENDING NANOFLEET [TEST ...]
"""

import json
import os
import signal
import socket
import subprocess
import sys
import threading
import unittest

import fleet_case
import service_case
from fleet_case import nanofleet

AXES = ("a", "b", "c", "d")


def deny(server):
    """A broker that takes a connection and refuses its subscription (MQTT 3.1.1, 3.2 and 3.9)."""
    connection, _ = server.accept()
    with connection:
        connection.recv(1000)
        connection.sendall(b"\x20\x02\x00\x00")
        asked = connection.recv(1000)
        header = 2 if asked[1] < 0x80 else 3
        connection.sendall(b"\x90\x03" + asked[header:header + 2] + b"\x80")
        while connection.recv(1000):
            pass


class Fleet(fleet_case.FleetCase):
    def begin_fleet(self, table, gateways=None):
        for axis in AXES:
            self.plug_in("motor_" + axis)
        config = self.write(*(self.axis(axis, motor="motor_" + axis, table=self.table) for axis in AXES),
                            service=f'[mqtt]\nbroker = "127.0.0.1:{self.broker.port}"\ngroup = "plant"\nnode = "cell"\n'
                                    f'[mqtt.orders]\nkeys = "{self.trusted}"\nactivate = "restart"\nhealthy_after = 500\n'
                                    'healthy_within = 600000\n')
        service = self.start(config)
        targets = [f"plant/cell/{axis}" for axis in AXES]
        for target in targets:
            self.plant.wait(target, lambda report: report["table"]["sha256"])
        with open(self.path("fleet.toml"), "w", encoding="utf-8") as file:
            file.write(f'[broker]\naddress = "127.0.0.1:{self.broker.port}"\n[[group]]\nname = "all"\ntable = "{os.path.basename(table)}"\n'
                       f'gateways = {json.dumps(gateways or targets)}\n')
        return service, targets

    def test_a_broker_that_lets_us_read_nothing(self):
        with socket.create_server(("127.0.0.1", 0)) as server:
            threading.Thread(target=deny, args=(server,), daemon=True).start()
            with open(self.path("fleet.toml"), "w", encoding="utf-8") as file:
                file.write(f'[broker]\naddress = "127.0.0.1:{server.getsockname()[1]}"\n'
                           '[[group]]\nname = "all"\ntable = "mending.bin"\ngateways = ["plant/cell/x"]\n')
            self.assertIn("does not let us read reports", self.fleet("status", exit_code=3)["error"])

    def fleet(self, *arguments, exit_code=0):
        told = nanofleet("--fleet", self.path("fleet.toml"), "--json", *arguments, exit_code=exit_code)
        return json.loads(told.stdout.splitlines()[-1])

    def roll_out(self, *arguments, exit_code=0):
        return self.fleet("roll-out", "all", "--key", os.path.join(self.keys, "maker.key"), "--patience", "60", *arguments, exit_code=exit_code)

    def test_a_table_to_all_and_back(self):
        table, wanted = self.build("two", 1024)
        _, targets = self.begin_fleet(table)
        before = self.fleet("status", exit_code=1)
        self.assertEqual([one["standing"] for one in before["gateways"]], ["differs"] * 4)
        done = self.roll_out("--report", self.path("report.json"))
        self.assertEqual((done["done"], done["all"], done["sha256"], done["stopped"]), (4, 4, wanted, False))
        with open(self.path("report.json"), encoding="utf-8") as file:
            self.assertEqual([one["outcome"] for one in json.load(file)["gateways"]], ["done"] * 4)
        status = self.fleet("status")
        self.assertEqual((status["as_wanted"], [one["report"]["table"]["sha256"] for one in status["gateways"]]), (4, [wanted] * 4))
        text = nanofleet("--fleet", self.path("fleet.toml"), "status").stdout
        self.assertIn("4 of 4 as wanted; oldest contact", text)
        self.assertEqual(self.roll_out()["done"], 4)
        self.assertTrue(all(self.plant.reports[target]["order"]["counter"] == 1 for target in targets), "nothing is ordered twice")
        back = self.roll_out("--table", self.table)
        self.assertEqual(back["done"], 4)
        for target in targets:
            self.plant.wait(target, lambda report: report["table"]["sha256"] == back["sha256"])

    def test_killed_and_begun_again(self):
        table, wanted = self.build("two", 1024)
        _, targets = self.begin_fleet(table)
        command = [fleet_case.NANOFLEET, "--fleet", self.path("fleet.toml"), "roll-out", "all", "--key",
                   os.path.join(self.keys, "maker.key")]
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as killed:
            self.plant.wait(targets[0], lambda report: report["order"]["counter"] == 1)
            killed.send_signal(signal.SIGKILL)
        done = self.roll_out()
        self.assertEqual(done["done"], 4)
        for target in targets:
            report = self.plant.wait(target, lambda report: report["table"]["sha256"] == wanted)
            self.assertEqual(report["order"]["counter"], 1)

    def test_a_silent_one_is_named_and_mistakes_too(self):
        table, _ = self.build("two", 1024)
        self.begin_fleet(table, ["plant/cell/a", "plant/gone/x"])
        done = self.roll_out(exit_code=1)
        self.assertEqual([(one["target"], one["outcome"], one["text"]) for one in done["gateways"]][1],
                         ("plant/gone/x", "silent", "it has never reported"))
        self.assertEqual(done["gateways"][0]["outcome"], "done")
        self.assertEqual(self.fleet("status", exit_code=1)["as_wanted"], 1)
        self.assertIn("there is no group some", self.fleet("status", "some", exit_code=2)["error"])
        self.broker.stop()
        self.assertIn("no connection", self.fleet("status", exit_code=3)["error"])
        with open(self.path("fleet.toml"), "a", encoding="utf-8") as file:
            file.write("more = 1\n")
        self.assertIn("fleet.toml:7: there is no key `more` here", self.fleet("status", exit_code=2)["error"])


if __name__ == "__main__":
    (service_case.NANOPLC, service_case.MACSIM, service_case.NANOCTL, service_case.MACREG, service_case.SEQC, service_case.MENDING,
     fleet_case.NANOFLEET) = sys.argv[1:8]
    unittest.main(argv=[sys.argv[0], *sys.argv[8:]])
