"""Gateways that take signed orders from a real broker, and who signs and publishes them.

Who uses it sets the programs' paths below and those of service_case first.
"""

import hashlib
import json
import os
import subprocess
import sys
import threading

import service_case
from sparkplug_host import Broker

# Debian's packages, whichever Python this is.
sys.path.append("/usr/lib/python3/dist-packages")
import paho.mqtt.client as paho  # noqa: E402

NANOFLEET = ""
LONG = 60


def nanofleet(*arguments, exit_code=0, **options):
    result = subprocess.run([NANOFLEET, *arguments], capture_output=True, text=True, timeout=4 * LONG, check=False, **options)
    assert result.returncode == exit_code, (arguments, result.returncode, result.stdout, result.stderr)
    return result


class Plant:
    """An MQTT client that may publish, and receives the reports."""

    def __init__(self, port):
        self.reports = {}
        self.history = []
        self.news = threading.Condition()
        self.ready = threading.Event()
        self.client = paho.Client("plant")
        self.client.on_connect = lambda client, *_: client.subscribe("nanoplc/v1/+/+/+/report", 1)
        self.client.on_subscribe = lambda *_: self.ready.set()
        self.client.on_message = self.take
        self.client.reconnect_delay_set(1, 1)
        self.client.connect("127.0.0.1", port)
        self.client.loop_start()
        assert self.ready.wait(LONG)

    def take(self, _client, _data, message):
        with self.news:
            report = json.loads(message.payload)
            self.reports["/".join(message.topic.split("/")[2:5])] = report
            self.history.append(report)
            self.news.notify_all()

    def publish(self, topic, payload):
        self.client.publish(topic, payload, 1, True).wait_for_publish()

    def wait(self, target, wanted):
        def found():
            report = self.reports.get(target)
            return report is not None and wanted(report)
        with self.news:
            assert self.news.wait_for(found, LONG), json.dumps(self.reports.get(target), indent=1)
            return self.reports[target]

    def wait_state(self, target, state, counter):
        return self.wait(target, lambda report: (report["order"]["state"], report["order"]["counter"]) == (state, counter))

    def end(self):
        self.client.loop_stop()
        self.client.disconnect()


class FleetCase(service_case.ServiceCase):
    TARGET = "plant/cell/x"
    healthy_after, healthy_within = 500, 600_000  # machines that test are busy

    def setUp(self):
        super().setUp()
        self.keys = self.path("keys")
        os.mkdir(self.keys)
        nanofleet("keys", "make", "maker", "--folder", self.keys)
        self.trusted = self.path("trusted")
        os.mkdir(self.trusted)
        self.trust("maker")
        self.broker = Broker(self.folder.name)
        self.plant = Plant(self.broker.port)

    def tearDown(self):
        self.plant.end()
        self.broker.stop()
        super().tearDown()

    def trust(self, name):
        with open(os.path.join(self.keys, name + ".pub"), encoding="utf-8") as file:
            text = file.read()
        with open(os.path.join(self.trusted, name + ".pub"), "w", encoding="utf-8") as file:
            file.write(text)

    def build(self, name, places=2048):
        """Another table than any of other places; its file and the hash that it is reported with."""
        source = self.path(name + ".seq")
        with open(service_case.MENDING, encoding="utf-8") as file:
            text = file.read().replace("2048", str(places))
        with open(source, "w", encoding="utf-8") as file:
            file.write(text)
        table = self.path(name + ".bin")
        subprocess.run([service_case.SEQC, "build", source, "-o", table], check=True, stdout=subprocess.DEVNULL)
        with open(table, "rb") as file:
            return table, hashlib.sha256(file.read()).hexdigest()

    def sign(self, table, counter, key="maker", target=None):
        """[(topic, payload)]: the order, then its pieces."""
        told = nanofleet("--json", "sign", table, "--target", target or self.TARGET, "--counter", str(counter), "--key",
                         os.path.join(self.keys, key + ".key"), "-o", self.path(f"order-{counter}"))
        messages = []
        for message in json.loads(told.stdout)["messages"]:
            with open(message["file"], "rb") as file:
                messages.append((message["topic"], file.read()))
        return messages

    def order(self, table, counter, **options):
        for topic, payload in reversed(self.sign(table, counter, **options)):
            self.plant.publish(topic, payload)

    def configure(self, orders="", axis=""):
        return self.write(self.axis(table=self.table, more=axis),
                          service=f'[mqtt]\nbroker = "127.0.0.1:{self.broker.port}"\ngroup = "plant"\nnode = "cell"\n'
                                  f'[mqtt.orders]\nkeys = "{self.trusted}"\nhealthy_after = {self.healthy_after}\n'
                                  f'healthy_within = {self.healthy_within}\n{orders}')

    def begin(self, orders="", axis=""):
        self.plug_in()
        service = self.start(self.configure(orders, axis))
        with open(self.table, "rb") as file:
            self.first = hashlib.sha256(file.read()).hexdigest()
        report = self.plant.wait(self.TARGET, lambda report: report["table"]["sha256"] == self.first)
        self.assertEqual(report["order"]["state"], "none")
        return service

    def what_runs(self):
        """SHA-256 of what really runs, from the user's port: its bytes, not the hash that MQTT reports."""
        file = self.path("downloaded.bin")
        self.ctl("download", "--force", "-o", file)
        with open(file, "rb") as table:
            return hashlib.sha256(table.read()).hexdigest()

    def wait_refused(self, words):
        return self.plant.wait(self.TARGET, lambda report: words in (report["refused"]["last"] or ""))
