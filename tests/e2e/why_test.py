#!/usr/bin/env python3
"""Why nothing moves, of one axis, by every program and face that tells it: the same number, name and sentence.

usage: why_test.py NANOPLC_SIM NANOCTL MACREG SHUTTLE [TEST ...]
"""

import json
import re
import struct
import subprocess
import sys
import unittest
import urllib.request

from panel_client import Panel
from patience import until
from program_case import ProgramCase
from sparkplug_host import Broker, Host

# Debian's packages, whichever Python this is.
sys.path.append("/usr/lib/python3/dist-packages")
from pymodbus.client import ModbusTcpClient  # noqa: E402

SIM = NANOCTL = MACREG = SHUTTLE = ""
LONG = 60
WHY = 900  # input registers: the number, its severity, 98 words of text
# firmware/causes/README.md, Codes
HEAT, BLOCKED = (54, "error_i2t_err"), (101, "blocked")
# Both stops where the shaft stands.
HELD = "motor stop above -9999 rev, motor stop below 9999 rev\nat 100 ms IN0 := 1\n"


class WhyNothingMoves(ProgramCase):
    def start(self, scenario):
        self.port = "unix:" + self.path("port")
        with open(self.path("held.scn"), "w", encoding="ascii") as file:
            file.write(scenario)
        broker = Broker(self.folder.name)
        self.addCleanup(broker.stop)
        self.host = Host(broker.port)
        self.addCleanup(self.host.end)
        _, lines = self.launch(SIM, "run", SHUTTLE, "--realtime", "--quiet", "--scenario", self.path("held.scn"), "--mactalk", self.port,
                               "--modbus", "tcp:127.0.0.1:0", "--metrics", "127.0.0.1:0", "--panel", "127.0.0.1:0",
                               "--mqtt", f"127.0.0.1:{broker.port}")
        said = "".join(lines)
        self.metrics = re.search(r"metrics: (\S+)", said).group(1)
        self.master = ModbusTcpClient("127.0.0.1", port=int(re.search(r"modbus: tcp:127\.0\.0\.1:(\d+)", said).group(1)), timeout=10)
        self.addCleanup(self.master.close)
        self.assertTrue(self.master.connect())
        self.panel = Panel(int(re.search(r"panel: http://127\.0\.0\.1:(\d+)", said).group(1)))
        self.addCleanup(self.panel.close)

    def of_modbus(self, number):
        def told():
            answer = self.master.read_input_registers(WHY, 100, slave=1)
            return not answer.isError() and answer.registers[0] == number and answer.registers
        text = struct.pack(">98H", *until(told, "Modbus")[2:])
        return text.rstrip(b"\0").decode()

    def of_metrics(self):
        def told():
            with urllib.request.urlopen(self.metrics, timeout=LONG) as answer:
                return re.search(r'^nanoplc_why\{axis="sim",cause="(\w+)"\} (\d+)$', answer.read().decode(), re.M)
        name, number = until(told, "metrics").groups()
        return int(number), name

    def of_mqtt(self, name):
        """The last value that a host has heard."""
        names, value = {}, None
        for message in list(self.host.messages):
            for metric in message.metrics:
                if message.kind.endswith("BIRTH") and metric.alias is not None:
                    names[metric.alias] = metric.name
                if (metric.name or names.get(metric.alias)) == name:
                    value = metric.value
        return value

    def of_program(self, *command):
        """`nanoctl` gives the number, `macreg` has no numbers: its first finding."""
        ended = subprocess.run(command, capture_output=True, text=True, timeout=2 * LONG, check=True)
        said = json.loads(ended.stdout)
        return next(iter(said["why"] if "why" in said else said["findings"]))

    def check(self, scenario, wanted):
        self.start(scenario)
        number, name = wanted
        cause = self.panel.first(lambda message: message.get("t") == "why" and message["causes"] and message["causes"][0]["code"] == name)["causes"][0]
        told, sentence = (cause["number"], cause["code"]), cause["text"]
        self.assertEqual(told, wanted)
        text = self.of_modbus(number)
        self.assertEqual(text, sentence[:len(text)])
        self.assertTrue(text == sentence or len(text) > 190, text)  # cut to what fits
        self.assertEqual(self.of_metrics(), wanted)
        until(lambda: self.of_mqtt("why") == number, "MQTT")
        until(lambda: (self.of_mqtt("why_text") or "").startswith(sentence), "MQTT's text")
        named = self.of_program(NANOCTL, "--port", self.port, "--json", "status", "--why")
        self.assertEqual(((named["number"], named["code"]), named["sentence"]), (wanted, sentence))
        named = self.of_program(MACREG, "--port", self.port, "--address", "1", "--json", "why")
        self.assertEqual((named["code"], named["sentence"]), (name, sentence))

    def test_a_blocked_shaft(self):
        # I2T has 16 bits: this motor pushes for ever.
        self.check("motor I2TLIM := 65535\n" + HELD, BLOCKED)

    def test_a_blocked_shaft_whose_motor_has_protected_itself(self):
        self.check(HELD, HEAT)


if __name__ == "__main__":
    SIM, NANOCTL, MACREG, SHUTTLE = sys.argv[1:5]
    unittest.main(argv=[sys.argv[0], *sys.argv[5:]])
