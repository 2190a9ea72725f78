#!/usr/bin/env python3
"""MQTT with Sparkplug B: a real broker (mosquitto), a host with a client (paho) and a separate decoder.

usage: mqtt_test.py NANOPLC_SIM NANOPLC MACSIM NANOCTL SEQC SHUTTLE MENDING EXAMPLES [TEST ...]
"""

import os
import random
import signal
import socket
import subprocess
import sys
import time
import types
import unittest

import certificates
import program_case
import service_case
from patience import halt
from sparkplug_host import Broker, Host, command, values

SIM = SHUTTLE = EXAMPLES = ""
LONG = 60
BAD_VALUE, NOT_ALLOWED, TOO_LATE, OUT_OF_RANGE = 4, 8, 19, 23
GOOD = 192


class View:
    """The state that a host has: births give names to aliases, data brings values; the order is held against seq."""

    def __init__(self):
        self.names = {}
        self.values = {}
        self.seq = None

    def take(self, message):
        if message.kind == "NBIRTH":
            assert message.seq == 0
        elif message.seq is not None and self.seq is not None:
            assert message.seq == (self.seq + 1) % 256, (message.topic, message.seq, self.seq)
        if message.kind != "NDEATH":
            self.seq = message.seq
        for metric in message.metrics:
            if message.kind.endswith("BIRTH") and metric.alias is not None:
                self.names[metric.alias] = (message.device, metric.name)
            key = (message.device, metric.name) if metric.name else self.names[metric.alias]
            if not metric.historical:
                self.values[key] = metric


class Case:
    def begin_broker(self, **settings):
        self.broker = Broker(self.folder.name, **settings)
        self.addCleanup(lambda: self.broker.stop())
        return self.broker

    def begin_host(self, **options):
        host = Host(self.broker.port, **options)
        self.addCleanup(host.end)
        return host

    def wait_value(self, host, device, name, wanted, after=0):
        """Until a host that has heard everything sees it."""
        end = time.monotonic() + LONG
        while time.monotonic() < end:
            view = View()
            for message in list(host.messages):
                view.take(message)
            metric = view.values.get((device, name))
            if metric is not None and wanted(metric):
                return metric
            host.wait(lambda _: True, after=len(host.messages))
        raise AssertionError(name)


class Simulated(program_case.ProgramCase, Case):
    def serve(self):
        self.begin_broker()
        host = self.begin_host()
        process, _ = self.launch(SIM, "run", SHUTTLE, "--realtime", "--quiet", "--mqtt", f"127.0.0.1:{self.broker.port}")
        return host, process

    def test_births_data_and_death(self):
        host, process = self.serve()
        birth, _ = host.wait(lambda m: m.kind == "NBIRTH")
        self.assertEqual((birth.seq, birth.named("Node Control/Rebirth").value), (0, False))
        born, place = host.wait(lambda m: m.kind == "DBIRTH")
        self.assertEqual((born.device, born.seq, born.retained), ("sim", 1, False))
        position = born.named("position")
        self.assertEqual(position.properties["engUnit"], "rev")
        self.assertEqual(position.description, "P_IST")
        aliases = [metric.alias for metric in born.metrics]
        self.assertEqual(len(set(aliases)), len(aliases))
        # A MAC140 does not report a temperature.
        self.assertTrue(born.named("temperature").null)
        self.assertNotEqual(born.named("temperature").properties["Quality"], GOOD)
        data, _ = host.wait(lambda m: m.kind == "DDATA", after=place)
        self.assertTrue(all(metric.alias in aliases and not metric.name for metric in data.metrics))
        self.wait_value(host, "sim", "running", lambda metric: metric.value is True)
        process.kill()
        death, _ = host.wait(lambda m: m.kind == "NDEATH")
        self.assertEqual([metric.name for metric in death.metrics], ["bdSeq"])
        self.assertEqual(death.metrics[0].value, birth.named("bdSeq").value)

    def test_commands_and_their_results(self):
        host, _ = self.serve()
        self.wait_value(host, "sim", "running", lambda metric: metric.value is True)
        host.tell("DCMD", "sim", command("Command/stop"))
        self.wait_value(host, "sim", "safe", lambda metric: metric.value is True)
        self.wait_value(host, "sim", "Command/result", lambda metric: metric.value == 0)
        host.tell("DCMD", "sim", command("Command/run"))
        self.wait_value(host, "sim", "running", lambda metric: metric.value is True)
        host.tell("DCMD", "sim", command("Command/reset"))
        self.wait_value(host, "sim", "Command/result", lambda metric: metric.value == NOT_ALLOWED)

    def test_why_nothing_moves(self):
        host, _ = self.serve()
        self.wait_value(host, "sim", "running", lambda metric: metric.value is True)
        host.tell("DCMD", "sim", command("Command/stop"))
        self.wait_value(host, "sim", "why", lambda metric: metric.value == 11)
        self.wait_value(host, "sim", "why_text", lambda metric: "safe state: stop command" in (metric.value or ""))

    def cutter(self):
        self.begin_broker()
        host = self.begin_host()
        self.launch(SIM, "run", os.path.join(EXAMPLES, "cut_to_length.seq"), "--realtime", "--quiet", "--mqtt",
                    f"127.0.0.1:{self.broker.port}")
        self.wait_value(host, "sim", "Set Points/Length", lambda metric: metric.value == 80)
        return host

    def test_set_points_are_metrics_with_unit_and_range(self):
        host = self.cutter()
        born, _ = host.wait(lambda m: m.kind == "DBIRTH" and any(metric.name == "Set Points/Length" for metric in m.metrics))
        length = born.named("Set Points/Length")
        self.assertEqual((length.properties["engUnit"], length.properties["engLow"], length.properties["engHigh"]), ("mm", 10, 200))
        self.assertEqual(born.named("Set Points/Pieces").value, 3)
        self.assertEqual(born.named("Set Points/Recipe").value, 0)

    def test_set_points_are_changed_whole_or_not_at_all(self):
        host = self.cutter()
        host.tell("DCMD", "sim", command("Command/stop"))
        self.wait_value(host, "sim", "Command/last", lambda metric: metric.value == "stop")
        self.wait_value(host, "sim", "Command/result", lambda metric: metric.value == 0)
        host.tell("DCMD", "sim", values({"Set Points/Length": 123.4, "Set Points/Speed": 2000.0}))
        self.wait_value(host, "sim", "Set Points/Length", lambda metric: metric.value == 123.4)
        self.wait_value(host, "sim", "Set Points/Speed", lambda metric: metric.value == 2000)
        host.tell("DCMD", "sim", values({"Set Points/Length": 50.0, "Set Points/Speed": 2501.0}))
        self.wait_value(host, "sim", "Command/result", lambda metric: metric.value == OUT_OF_RANGE)
        said = self.wait_value(host, "sim", "Command/text", lambda metric: "Speed" in metric.value)
        self.assertEqual(said.value, "Speed: a set-point is out of its range; it takes 100 rpm to 2500 rpm; nothing was changed")
        self.wait_value(host, "sim", "Set Points/Length", lambda metric: metric.value == 123.4)
        for wrong, code in ((float("nan"), OUT_OF_RANGE), (1e300, OUT_OF_RANGE)):
            host.tell("DCMD", "sim", values({"Set Points/Length": wrong}))
            self.wait_value(host, "sim", "Command/last", lambda metric: metric.value == "Set Points/Length")
            self.wait_value(host, "sim", "Command/result", lambda metric, code=code: metric.value == code)
        host.tell("DCMD", "sim", values({"Set Points/Pieces": 1.5}))
        self.wait_value(host, "sim", "Command/text", lambda metric: metric.value == "1.5 is no whole number; nothing was changed")
        self.wait_value(host, "sim", "Command/result", lambda metric: metric.value == BAD_VALUE)
        host.tell("DCMD", "sim", values({"Set Points/Length": 60.0}), retain=True)
        host.tell("DCMD", "sim", values({"Set Points/Length": 60.0}, timestamp=int(time.time() * 1000) - 60_000))
        self.wait_value(host, "sim", "Command/result", lambda metric: metric.value == TOO_LATE)
        self.wait_value(host, "sim", "Set Points/Length", lambda metric: metric.value == 123.4)

    def test_old_retained_and_repeated_commands_are_not_carried_out(self):
        host, _ = self.serve()
        self.wait_value(host, "sim", "running", lambda metric: metric.value is True)
        now = int(time.time() * 1000)
        host.tell("DCMD", "sim", command("Command/stop", timestamp=now - 60_000))
        self.wait_value(host, "sim", "Command/result", lambda metric: metric.value == TOO_LATE)
        stop = command("Command/stop")
        host.tell("DCMD", "sim", stop)
        self.wait_value(host, "sim", "safe", lambda metric: metric.value is True)
        self.wait_value(host, "sim", "Command/result", lambda metric: metric.value == 0)
        run = command("Command/run")
        host.tell("DCMD", "sim", run)
        self.wait_value(host, "sim", "running", lambda metric: metric.value is True)
        host.tell("DCMD", "sim", command("Command/stop"))
        self.wait_value(host, "sim", "safe", lambda metric: metric.value is True)
        host.tell("DCMD", "sim", run)  # the same again
        self.wait_value(host, "sim", "Command/result", lambda metric: metric.value == TOO_LATE)
        self.wait_value(host, "sim", "safe", lambda metric: metric.value is True)

    def test_a_retained_command_waits_for_nobody(self):
        self.begin_broker()
        host = self.begin_host()
        host.tell("DCMD", "sim", command("Command/stop"), retain=True)
        self.launch(SIM, "run", SHUTTLE, "--realtime", "--quiet", "--mqtt", f"127.0.0.1:{self.broker.port}")
        host.wait(lambda m: m.kind == "DBIRTH")
        self.wait_value(host, "sim", "running", lambda metric: metric.value is True)

    def test_noise_and_floods_disturb_nobody(self):
        host, _ = self.serve()
        self.wait_value(host, "sim", "running", lambda metric: metric.value is True)
        seed = random.randrange(2**32)
        chance = random.Random(seed)
        whole = command("Command/hold", timestamp=1)
        for number in range(1000):
            noise = bytes(chance.randrange(256) for _ in range(chance.randrange(64))) if number % 2 else whole[:chance.randrange(len(whole))]
            host.client.publish(f"spBv1.0/nanoplc/{('NCMD/sim', 'DCMD/sim/sim', 'DCMD/sim/none')[number % 3]}", noise, 0)
        host.client.publish("spBv1.0/nanoplc/DCMD/sim/sim", bytes(1_000_000), 0)
        for _ in range(300):
            host.client.publish("spBv1.0/nanoplc/DCMD/sim/sim", command("Command/hold", timestamp=1), 0)
        self.wait_value(host, "sim", "Command/result", lambda metric: metric.value == TOO_LATE)
        self.wait_value(host, "sim", "running", lambda metric: metric.value is True)
        host.tell("DCMD", "sim", command("Command/stop"))
        self.wait_value(host, "sim", "safe", lambda metric: metric.value is True)
        print(f"seed {seed}")

    def test_rebirth(self):
        host, _ = self.serve()
        birth, place = host.wait(lambda m: m.kind == "NBIRTH")
        host.wait(lambda m: m.kind == "DBIRTH")
        host.tell("NCMD", None, command("Node Control/Rebirth"))
        again, place = host.wait(lambda m: m.kind == "NBIRTH", after=place + 1)
        self.assertEqual((again.seq, again.named("bdSeq").value), (0, birth.named("bdSeq").value))
        host.wait(lambda m: m.kind == "DBIRTH" and m.seq == 1, after=place)


    def test_two_nodes_of_one_name_say_so_and_try_ever_more_seldom(self):
        host, first = self.serve()
        host.wait(lambda m: m.kind == "DBIRTH")
        # The broker throws out whom it has under the name.
        self.launch(SIM, "run", SHUTTLE, "--realtime", "--quiet", "--mqtt", f"127.0.0.1:{self.broker.port}")
        told = []
        for line in first.stderr:
            told.append(line)
            if "is there another client nanoplc-nanoplc-sim?" in line:
                break
        self.assertEqual(sum("mqtt: connected" in line for line in told), 3, told)


class Served(service_case.ServiceCase, Case):
    def begin(self, settings="", node="cell", wait_for="started with", **broker):
        self.plug_in()
        if not hasattr(self, "broker"):
            self.begin_broker(**broker)
        config = self.write(self.axis(table=self.table),
                            service=f'[mqtt]\nbroker = "127.0.0.1:{self.broker.port}"\nnode = "{node}"\nperiod = 100\n{settings}')
        return self.start(config, wait_for=wait_for)

    def test_no_command_is_taken_unless_it_is_named(self):
        self.begin_broker()
        host = self.begin_host()
        service = self.begin('commands = ["stop"]')
        born, _ = host.wait(lambda m: m.kind == "DBIRTH")
        self.assertEqual([metric.name for metric in born.metrics if metric.name.startswith("Command/")],
                         ["Command/stop", "Command/last", "Command/result", "Command/text"])
        self.wait_value(host, "x", "running", lambda metric: metric.value is True)
        host.tell("DCMD", "x", command("Command/hold"), node="cell")
        self.wait_value(host, "x", "Command/result", lambda metric: metric.value == NOT_ALLOWED)
        host.tell("DCMD", "x", command("Command/stop"), node="cell")
        self.until_status(lambda status: status["safe_reason"] == "stop command")
        count = len(host.messages)
        self.assertEqual(self.end(service), 0)
        host.wait(lambda m: m.kind == "NDEATH", after=count)

    def test_what_waited_while_it_was_halted_is_not_carried_out(self):
        self.begin_broker()
        host = self.begin_host()
        service = self.begin('commands = ["stop", "run"]\ncommand_age = 60000')
        self.wait_value(host, "x", "running", lambda metric: metric.value is True)
        host.tell("DCMD", "x", command("Command/stop"), node="cell")
        self.until_status(lambda status: status["safe_reason"] == "stop command")
        halt(service.process.pid)
        host.tell("DCMD", "x", command("Command/run"), node="cell")
        time.sleep(1.6)
        service.process.send_signal(signal.SIGCONT)
        self.wait_value(host, "x", "Command/result", lambda metric: metric.value == TOO_LATE)
        self.assertEqual(self.ctl("status")["safe_reason"], "stop command")

    def test_a_primary_host_decides(self):
        self.begin_broker()
        host = self.begin_host()
        self.begin('primary_host = "scada"', wait_for="MQTT: connected")
        self.assertFalse(any(message.kind == "NBIRTH" for message in host.messages))
        host.announce(True)
        birth, place = host.wait(lambda m: m.kind == "NBIRTH")
        host.wait(lambda m: m.kind == "DBIRTH", after=place)
        host.announce(False)
        death, place = host.wait(lambda m: m.kind == "NDEATH", after=place)
        self.assertEqual(death.metrics[0].value, birth.named("bdSeq").value)
        host.announce(True)
        again, _ = host.wait(lambda m: m.kind == "NBIRTH", after=place)
        self.assertNotEqual(again.named("bdSeq").value, birth.named("bdSeq").value)

    def test_a_broker_that_goes_loses_nothing(self):
        self.begin_broker()
        host = self.begin_host()
        host.announce(True)
        service = self.begin('primary_host = "scada"')  # the others wait for a host that has subscribed to all
        birth, _ = host.wait(lambda m: m.kind == "NBIRTH")
        alias = host.wait(lambda m: m.kind == "DBIRTH")[0].named("orders").alias
        self.wait_value(host, "x", "running", lambda metric: metric.value is True)
        self.broker.stop()
        before = self.ctl("status")["orders"]
        self.until_status(lambda status: status["orders"] > before + 10)
        count = len(host.messages)
        host.ready.clear()
        self.broker.start()
        host.announce(True)
        again, place = host.wait(lambda m: m.kind == "NBIRTH", after=count)
        self.assertGreater(again.named("bdSeq").value, birth.named("bdSeq").value)
        self.assertEqual(again.named("Node Info/Dropped").value, 0)

        def kept(message):
            return [metric.value for metric in message.metrics if metric.historical and metric.alias == alias and metric.value > before + 3]

        # Changes while the broker was away are sent afterwards, as history.
        old, _ = host.wait(kept, after=place)
        self.assertTrue(all(metric.timestamp <= again.timestamp for metric in old.metrics if metric.historical))
        self.assertEqual(self.end(service), 0)

    def test_the_oldest_are_dropped_and_counted(self):
        self.begin_broker()
        host = self.begin_host()
        host.announce(True)
        service = self.begin('store = 5\nprimary_host = "scada"', wait_for="MQTT: connected")
        host.wait(lambda m: m.kind == "DBIRTH")
        self.broker.stop()
        self.until(lambda: "no connection to" in service.said(), service)
        losses = self.ctl("status")["orders"]
        self.until_status(lambda status: status["orders"] > losses + 20)
        count = len(host.messages)
        host.ready.clear()
        self.broker.start()
        host.announce(True)
        birth, place = host.wait(lambda m: m.kind == "NBIRTH", after=count)
        self.assertGreater(birth.named("Node Info/Dropped").value, 0)
        old, _ = host.wait(lambda m: any(metric.historical for metric in m.metrics), after=place)
        self.assertLessEqual(sum(metric.historical for metric in old.metrics), 5)
        self.assertEqual(self.end(service), 0)

    def secret(self, text):
        with open(self.path("password"), "w", encoding="utf-8") as file:
            file.write(text + "\n")
        return f'user = "cell"\npassword_file = "{self.path("password")}"\nca_file = "{self.path("ca.pem")}"\n'

    def test_tls_and_passwords(self):
        self.begin_broker(settings=certificates.make(self.folder.name))
        service = self.begin(self.secret("right"), wait_for="MQTT: connected")
        self.assertIn("MQTT: connected to 127.0.0.1", service.said())
        self.assertEqual(self.end(service), 0)
        self.pull_out()
        service = self.begin(self.secret("wrong"), wait_for="MQTT: no connection")
        self.assertRegex(service.said(), "not authori[sz]ed")
        self.moves()
        self.assertEqual(self.end(service), 0)
        self.pull_out()
        service = self.begin(self.secret("right").replace("ca.pem", "other.pem"), wait_for="MQTT: no connection")
        self.assertIn("certificate verify failed", service.said())
        self.moves()

    def refused(self, said, secret, **broker):
        """What is said of a connection that TLS does not let come about: a broker's alert may be lost in the first attempt."""
        if broker:
            self.begin_broker(**broker)
        service = self.begin(secret, wait_for="MQTT: no connection")
        self.until(lambda: f"MQTT: no connection to 127.0.0.1:{self.broker.port}: {said}" in service.said(), service)
        self.assertNotIn("MQTT: connected", service.said())
        self.moves()
        self.assertEqual(self.end(service), 0)
        self.pull_out()

    def test_a_brokers_certificate_that_is_refused_is_said_with_the_reason(self):
        settings = certificates.make(self.folder.name)
        secret = self.secret("right")
        for name, said in (("stranger", "the broker's certificate is of another name; its subjectAltName must have `broker`"),
                           ("expired", "the broker's certificate, or its CA's, has expired; renew it, or set this machine's clock"),
                           ("selfmade", "the broker's certificate has signed itself, and is not the one in ca_file; name it there")):
            self.refused(said, secret, settings=settings.replace("broker.pem", f"{name}.pem"))
            self.broker.stop()
        self.refused("the CA in ca_file has not signed the broker's certificate; name the file of the CA that has",
                     secret.replace("ca.pem", "other.pem"), settings=settings)
        self.broker.stop()
        self.refused("the broker ends the connection in the place of TLS; name its port for TLS, or leave ca_file out if it has none", secret,
                     settings="allow_anonymous true\n")

    def test_a_certificate_of_ours_that_is_refused_is_said_with_the_reason(self):
        self.begin_broker(settings=certificates.make(self.folder.name) + "require_certificate true\n")
        secret = self.secret("right")
        ours = f'{secret}key_file = "{self.path("mine.key")}"\ncertificate_file = "{self.path("NAME.pem")}"\n'
        self.refused("the broker wants a certificate of its clients; name certificate_file and key_file", secret)
        self.refused("the broker refuses certificate_file; name one that the broker's own CA has signed", ours.replace("NAME", "foreign"))
        self.refused("the broker refuses certificate_file, which has expired; renew it, or set the broker's clock", ours.replace("NAME", "old"))
        service = self.begin(ours.replace("NAME", "mine"), wait_for="MQTT: connected")
        self.assertNotIn("no connection", service.said())

    def test_files_of_tls_that_hold_something_else_are_refused_before(self):
        certificates.make(self.folder.name)
        self.plug_in()

        def openssl(*arguments):
            subprocess.run(["openssl", *arguments], check=True, capture_output=True, cwd=self.folder.name)

        openssl("x509", "-in", "ca.pem", "-outform", "DER", "-out", "ca.der")
        openssl("pkey", "-in", "mine.key", "-aes256", "-passout", "pass:secret", "-out", "locked.key")
        openssl("genrsa", "-out", "rsa.key", "1024")
        os.mkdir(self.path("folder"))
        names = {"ca_file": "ca.pem", "certificate_file": "mine.pem", "key_file": "mine.key"}

        def check(**wrong):
            files = "".join(f'{key} = "{self.path(name)}"\n' for key, name in {**names, **wrong}.items())
            return self.check(f'[mqtt]\nbroker = "cell4:8883"\nnode = "n"\n{files}{self.axis()}')

        self.assertEqual(check(), (0, []))
        for key, name, said in (
                ("ca_file", "ca.der", "holds no certificate in PEM form (-----BEGIN CERTIFICATE-----); `openssl x509 -inform DER -in "),
                ("ca_file", "mine.key", "holds no certificate in PEM form"),
                ("certificate_file", "mine.key", "holds no certificate in PEM form"),
                ("key_file", "mine.pem", "holds no key in PEM form without a password (-----BEGIN PRIVATE KEY-----); `openssl pkey -in "),
                ("key_file", "locked.key", "holds no key in PEM form without a password"),
                ("key_file", "broker.key", "is the key of another certificate; name the one that certificate_file was made with"),
                ("key_file", "rsa.key", "is the key of another certificate")):
            code, lines = check(**{key: name})
            line = 4 + list(names).index(key)
            self.assertEqual((code, len(lines)), (3, 1), lines)
            self.assertIn(f"{line}: mqtt.{key}: {self.path(name)}: {said}", lines[0])
        for key in names:
            for name in ("folder", "nothing"):
                code, lines = check(**{key: name})
                self.assertEqual((code, len(lines)), (3, 1), lines)
                self.assertIn(f"mqtt.{key}: there is no file {self.path(name)}; put it there, or name another", lines[0])

    def test_a_key_of_another_certificate_is_said_and_tried_again(self):
        self.begin_broker(settings=certificates.make(self.folder.name))
        os.link(self.path("broker.key"), self.path("key"))
        service = self.begin(f'{self.secret("right")}certificate_file = "{self.path("mine.pem")}"\nkey_file = "{self.path("key")}"\n',
                             wait_for="tries again")
        self.assertIn(f"MQTT: {self.path('key')}: is the key of another certificate", service.said())
        self.moves()
        os.replace(self.path("mine.key"), self.path("key"))
        self.until(lambda: "MQTT: connected" in service.said(), service)

    def test_files_that_are_not_there_are_told_and_tried_again(self):
        settings = certificates.make(self.folder.name)
        self.begin_broker(settings=settings)
        secret = self.secret("right")
        for name, lost in (("ca", "ca.pem"), ("password", "password")):
            os.rename(self.path(lost), self.path("away"))
            service = self.begin(secret, wait_for="tries again")
            self.assertIn(self.path(lost), service.said(), name)
            self.moves()
            os.rename(self.path("away"), self.path(lost))
            self.until(lambda service=service: "MQTT: connected" in service.said(), service)
            self.assertEqual(self.end(service), 0)
            self.pull_out()

    def test_what_is_no_broker_or_says_half_of_it_delays_nothing(self):
        chance = random.Random(5)
        for said in (b"", b"\x20", b"\x20\x02\x00", b"HTTP/1.1 400 Bad Request\r\n\r\n", chance.randbytes(2_000)):
            with socket.create_server(("127.0.0.1", 0)) as listener:
                self.broker = types.SimpleNamespace(port=listener.getsockname()[1], stop=lambda: None)
                service = self.begin()
                line, _ = listener.accept()
                line.sendall(said)  # and then nothing
                self.moves()
                self.ctl("stop")
                self.assertEqual(self.end(service), 0, said)
                line.close()
            self.pull_out()

    def test_a_broker_that_is_halted_is_said_to_be_silent(self):
        self.begin_broker()
        service = self.begin(wait_for="MQTT: connected")
        halt(self.broker.process.pid)
        self.until(lambda: "no connection" in service.said(), service)
        self.assertIn("the broker is silent", service.said())
        self.moves()

    def test_mistakes_are_named_and_the_place_is_told(self):
        code, said = self.check(f'[mqtt]\nbroker = "plc"\nnode = "a/b"\ncommands = ["start"]\nkey_file = "x"\n{self.axis()}', "--no-devices")
        self.assertEqual(code, 2)
        for key in ("broker", "node", "commands", "key_file"):
            self.assertTrue(any(f"mqtt.{key}: " in line for line in said), said)
        for name, text in (("empty", "\n"), ("whole", "secret\n")):
            with open(self.path(name), "w", encoding="utf-8") as file:
                file.write(text)
        self.plug_in()
        secret = f'[mqtt]\nbroker = "cell4:8883"\nnode = "n"\nuser = "u"\npassword_file = "{self.path("empty")}"\nca_file = "{self.path("nothing")}"\n'
        code, said = self.check(f"{secret}{self.axis()}")
        self.assertEqual(code, 3, said)
        self.assertTrue(any("5: mqtt.password_file: the first line" in line for line in said), said)
        self.assertTrue(any("6: mqtt.ca_file: there is no file" in line for line in said), said)
        certificates.make(self.folder.name)
        code, said = self.check(f"{secret.replace('empty', 'whole').replace('nothing', 'ca.pem')}{self.axis()}")
        self.assertEqual((code, [line for line in said if "mqtt" in line]), (0, []), said)
        config = self.write(self.axis(), service='[mqtt]\nbroker = "cell4:8883"\nnode = "n"\nca_file = "/x"\ncommands = ["stop"]')
        checked = subprocess.run([service_case.NANOPLC, "check-config", "--no-devices", config], capture_output=True, text=True,
                                 check=True)
        self.assertIn("MQTT goes out to cell4:8883 with TLS, as nanoplc/n, and takes stop\n", checked.stdout)

    def test_clear_text_is_warned_of(self):
        with open(self.path("password"), "w", encoding="utf-8") as file:
            file.write("secret\n")
        password = f'user = "u"\npassword_file = "{self.path("password")}"\n'
        for broker, more, said in (
                ("cell4:8883", "", ["mqtt.broker: warning: port 8883 is TLS's, and without a ca_file clear text goes to it; name a ca_file"]),
                ("127.0.0.1:8883", password, ["mqtt.broker: warning: port 8883 is TLS's, and without a ca_file clear text goes to it, the password "
                                              "with it; name a ca_file"]),
                ("cell4:1883", password, ["mqtt.password_file: warning: without a ca_file the password goes to cell4 in clear text; name a ca_file"]),
                ("cell4:1883", "", []), ("127.0.0.1:1883", password, []), ("[::1]:1883", password, []),
                ("cell4:8883", f'{password}ca_file = "{self.path("password")}"\n', [])):
            code, lines = self.check(f'[mqtt]\nbroker = "{broker}"\nnode = "n"\n{more}{self.axis()}', "--no-devices")
            self.assertEqual((code, [line.split(": ", 1)[1] for line in lines]), (0, said), broker)


if __name__ == "__main__":
    (SIM, service_case.NANOPLC, service_case.MACSIM, service_case.NANOCTL, service_case.SEQC, SHUTTLE,
     service_case.MENDING, EXAMPLES) = sys.argv[1:9]
    unittest.main(argv=[sys.argv[0], *sys.argv[9:]])
