#!/usr/bin/env python3
"""Metrics in Prometheus's text form, read with Prometheus's own parser, of the simulator and the service.

usage: metrics_test.py NANOPLC_SIM NANOPLC MACSIM NANOCTL SEQC SHUTTLE MENDING EXAMPLES [TEST ...]
"""

import os
import re
import socket
import subprocess
import sys
import unittest
import urllib.error
import urllib.request

import program_case
import service_case
from patience import until

SIM = SHUTTLE = EXAMPLES = ""
LONG = 60


def fetch(url):
    with urllib.request.urlopen(url, timeout=LONG) as answer:
        assert answer.headers["Content-Type"].startswith("text/plain; version=0.0.4"), answer.headers
        return answer.read().decode()


def read(text):
    """{(name, ((label, value), ...)): number}"""
    values = {}
    for line in text.splitlines():
        if line.startswith("#"):
            continue
        name, labels, value = re.fullmatch(r"(\w+)\{(.*)\} (\S+)", line).groups()
        values[name, tuple(re.findall(r'(\w+)="([^"]*)"', labels))] = float(value)
    return values


def check_with_promtool(test, text):
    """The parser and its lint, both."""
    checked = subprocess.run(["promtool", "check", "metrics"], input=text, capture_output=True, text=True, check=False)
    test.assertEqual((checked.returncode, checked.stdout + checked.stderr), (0, ""))


class Simulated(program_case.ProgramCase):
    def serve(self, program=""):
        process, lines = self.launch(SIM, "run", program or SHUTTLE, "--realtime", "--quiet", "--metrics", "127.0.0.1:0")
        return process, re.search(r"metrics: (\S+)", "".join(lines)).group(1)

    @staticmethod
    def until(url, come):
        return until(lambda: (values := read(fetch(url))) and come(values) and values)

    def test_prometheus_reads_them(self):
        _, url = self.serve()
        axis = ("axis", "sim")
        running = ("nanoplc_running", (axis,))
        position = ("nanoplc_position", (axis, ("unit", "rev")))
        values = self.until(url, lambda values: values.get(running) == 1 and position in values)
        check_with_promtool(self, fetch(url))
        self.assertEqual(values["nanoplc_axis_up", (axis,)], 1)
        self.assertEqual(values[position], 0)
        self.assertEqual(values["nanoplc_events_total", (axis, ("event", "started"))], 1)
        # A MAC140 does not report a temperature: no line, and no 0.
        self.assertNotIn("nanoplc_motor_temperature_celsius", {name for name, _ in values})

    def test_set_points_are_gauges(self):
        _, url = self.serve(os.path.join(EXAMPLES, "cut_to_length.seq"))
        length = (("axis", "sim"), ("name", "Length"), ("unit", "mm"))
        values = self.until(url, lambda values: ("nanoplc_set_point", length) in values)
        check_with_promtool(self, fetch(url))
        self.assertEqual((values["nanoplc_set_point", length], values["nanoplc_set_point_wanted", length]), (80, 80))
        self.assertEqual(values["nanoplc_recipe", (("axis", "sim"),)], 0)

    def test_why_is_a_number_with_a_name(self):
        _, url = self.serve()
        values = self.until(url, lambda values: any(name == "nanoplc_why" for name, _ in values))
        check_with_promtool(self, fetch(url))
        (labels, number), = [(dict(labels), value) for (name, labels), value in values.items() if name == "nanoplc_why"]
        self.assertTrue(labels["cause"] and number > 0)

    def test_scan_times_are_a_histogram(self):
        _, url = self.serve()
        values = self.until(url, lambda values: values["nanoplc_scan_seconds_count", (("axis", "sim"),)] > 100)
        buckets = [(float(dict(labels)["le"]), value) for (name, labels), value in values.items()
                   if name == "nanoplc_scan_seconds_bucket"]
        self.assertEqual([le for le, _ in buckets], sorted(le for le, _ in buckets))
        self.assertEqual([count for _, count in buckets], sorted(count for _, count in buckets))
        count = values["nanoplc_scan_seconds_count", (("axis", "sim"),)]
        self.assertEqual(buckets[-1], (float("inf"), count))
        # The simulated board polls every 250 us at the least: no idle scan is longer.
        self.assertGreaterEqual(dict(buckets)[0.00025], count - 10)

    def test_only_reading_and_only_here(self):
        _, url = self.serve()
        for wrong, method, code in ((url + "x", "GET", 404), (url.replace("/metrics", "/"), "GET", 404), (url, "POST", 405)):
            with self.assertRaises(urllib.error.HTTPError) as answer:
                urllib.request.urlopen(urllib.request.Request(wrong, method=method), timeout=LONG)
            self.assertEqual(answer.exception.code, code)
        with urllib.request.urlopen(urllib.request.Request(url, method="HEAD"), timeout=LONG) as answer:
            self.assertEqual(answer.read(), b"")

    def test_misuse_disturbs_nobody(self):
        _, url = self.serve()
        port = int(re.search(r":(\d+)/", url).group(1))
        crowd = [socket.create_connection(("127.0.0.1", port)) for _ in range(40)]
        for number, one in enumerate(crowd):
            try:
                one.sendall((b"GET /met", b"\x00\xff" * 8000, b"GET /metrics HTTP/1.1\r\nX: " + b"y" * 9000,
                             b"GET /metrics HTTP/1.1\r\n\r\n")[number % 4])
            except OSError:
                pass  # it was turned away
        for _ in range(20):
            self.assertEqual(read(fetch(url))["nanoplc_axis_up", (("axis", "sim"),)], 1)
        with socket.create_connection(("127.0.0.1", port)) as line:
            for byte in b"GET /metrics HTTP/1.0\r\n\r\n":
                line.sendall(bytes([byte]))
            line.settimeout(LONG)
            self.assertTrue(line.makefile("rb").read().startswith(b"HTTP/1.1 200 OK\r\n"))
        for one in crowd:
            one.close()


class Served(service_case.ServiceCase):
    def test_the_service_tells_of_its_axes_and_a_lost_link(self):
        self.plug_in()
        config = self.write(self.axis(table=self.table), service='[metrics]\nlisten = "127.0.0.1:0"\n')
        service = self.start(config, wait_for="metrics: served at")
        url = re.search(r"served at (\S+)", service.said()).group(1)
        axis = ("axis", "x")
        self.until(lambda: read(fetch(url)).get(("nanoplc_running", (axis,))) == 1)
        check_with_promtool(self, fetch(url))
        losses = ("nanoplc_link_losses_total", (axis,))
        self.assertEqual(read(fetch(url))[losses], 0)
        self.pull_out()
        self.until(lambda: read(fetch(url))[losses] == 1)
        self.until(lambda: read(fetch(url))["nanoplc_motor_contact_age_seconds", (axis,)] > 1)
        values = read(fetch(url))
        self.assertEqual(values["nanoplc_events_total", (axis, ("event", "link_down"))], 1)
        self.assertEqual(values["nanoplc_link_up", (axis,)], 0)
        self.assertNotIn(("nanoplc_position", (axis, ("unit", "rev"))), values)  # what it was is not what it is
        self.assertEqual(self.end(service), 0)

    def test_of_a_motor_that_is_gone_or_never_was_nothing_is_known(self):
        self.plug_in()
        config = self.write(self.axis(table=self.table), self.axis("y", "absent", table=self.table),
                            service='[metrics]\nlisten = "127.0.0.1:0"\n')
        service = self.start(config, wait_for="metrics: served at")
        url = re.search(r"served at (\S+)", service.said()).group(1)
        of_motor = ["position", "velocity_per_second", "motor_error_word", "motor_mode", "motor_torque_ratio", "motor_load_ratio",
                    "follow_error", "target"]

        def known(values, axis):
            return [name for name in of_motor if any(one == f"nanoplc_{name}" and ("axis", axis) in labels for one, labels in values)]

        self.until(lambda: "motor_mode" in known(read(fetch(url)), "x"))
        self.pull_out()
        link = ("nanoplc_link_up", (("axis", "x"),))
        self.until(lambda: read(fetch(url))[link] == 0)
        values = read(fetch(url))
        self.assertEqual(known(values, "x"), [])
        self.assertEqual(known(values, "y"), [])
        for axis in ("x", "y"):
            self.assertEqual(values["nanoplc_why", (("axis", axis), ("cause", "gateway_link_down"))], 10)
        self.assertNotIn(("nanoplc_motor_contact_age_seconds", (("axis", "y"),)), values)
        self.assertEqual(self.end(service), 0)

    def test_a_port_that_is_taken_stops_no_axis(self):
        self.plug_in()
        with socket.create_server(("127.0.0.1", 0)) as one, socket.create_server(("127.0.0.1", 0)) as other:
            metrics, modbus = (f"127.0.0.1:{taken.getsockname()[1]}" for taken in (one, other))
            config = self.write(
                self.axis(table=self.table),
                service=f'[metrics]\nlisten = "{metrics}"\n[modbus]\nlisten = "tcp:{modbus}"',
            )
            service = self.start(config)
            self.until(lambda: service.said().count("tries again") == 2, service)
            self.moves()
        self.until(lambda: "served at" in service.said() and "listens at" in service.said(), service)
        self.moves()

    def test_mistakes_are_named_and_the_place_is_told(self):
        axis = self.axis()
        code, said = self.check(f'[metrics]\nlisten = "plc:x"\n{axis}', "--no-devices")
        self.assertEqual(code, 2)
        self.assertIn('2: metrics.listen: is no address with a port; write such as "127.0.0.1:9464" or "[::]:9464"', said)
        config = self.write(axis, service='[metrics]\nlisten = "0.0.0.0:9464"')
        checked = subprocess.run([service_case.NANOPLC, "check-config", "--no-devices", config], capture_output=True, text=True,
                                 check=True)
        self.assertIn("metrics are served at 0.0.0.0:9464, for reading only\n", checked.stdout)


if __name__ == "__main__":
    (SIM, service_case.NANOPLC, service_case.MACSIM, service_case.NANOCTL, service_case.SEQC, SHUTTLE,
     service_case.MENDING, EXAMPLES) = sys.argv[1:9]
    unittest.main(argv=[sys.argv[0], *sys.argv[9:]])
