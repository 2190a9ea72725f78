#!/usr/bin/env python3
"""What nanoplc check-config says of the faces: what listens, and where, whatever is missing.

usage: check_config_test.py NANOPLC
"""

import os
import subprocess
import sys
import unittest

from folder_case import FolderCase

NANOPLC = ""

FACES = """[panel]
listen = "127.0.0.1:8080"
[modbus]
listen = "tcp:{address}:{port}"
[metrics]
listen = "127.0.0.1:9464"
[mqtt]
broker = "{broker}"
node = "n"
{mqtt}
"""
AXIS = """[[axis]]
name = "x"
[axis.motor]
port = "{port}"
"""


class CheckConfig(FolderCase):
    def check(self, *arguments, address="127.0.0.1", port=1502, mqtt="", broker="192.168.10.2:1883"):
        text = f'[service]\nstate_directory = "{self.path("state")}"\n' + FACES.format(address=address, port=port, mqtt=mqtt, broker=broker)
        file = self.put("nanoplc.toml", text + AXIS.format(port=self.path("no_such_port")))
        result = subprocess.run([NANOPLC, "check-config", *arguments, file], capture_output=True, text=True, check=False)
        return result.returncode, result.stdout, result.stderr

    def test_the_faces_are_told_whatever_is_missing(self):
        code, said, complaint = self.check()
        self.assertEqual(code, 3)
        self.assertIn(f"there is no {self.path('no_such_port')}", complaint)
        for part in ("the panel listens at 127.0.0.1:8080\n", "Modbus TCP listens at tcp:127.0.0.1:1502, and operates",
                     "metrics are served at 127.0.0.1:9464", "MQTT goes out to 192.168.10.2:1883 without TLS"):
            self.assertIn(part, said)
        self.assertNotIn("in order", said)

    def test_a_port_that_needs_a_right_is_warned_of(self):
        """Linux keeps ports below 1024 for CAP_NET_BIND_SERVICE, unless a setting of the kernel says otherwise."""
        with open("/proc/sys/net/ipv4/ip_unprivileged_port_start", encoding="ascii") as file:
            first = int(file.read())
        code, _, complaint = self.check("--no-devices", port=502)
        self.assertEqual(code, 0)
        for part in ("6: modbus.listen: warning: port 502", "AmbientCapabilities=CAP_NET_BIND_SERVICE", "above 1023"):
            self.assertEqual(part in complaint, first > 502, complaint)
        self.assertNotIn("port 1502", self.check("--no-devices")[2])

    def test_an_address_of_another_machine_is_named(self):
        """192.0.2.0/24 is for documents (RFC 5737)."""
        code, said, complaint = self.check(address="192.0.2.7")
        self.assertEqual(code, 3)
        self.assertIn("6: modbus.listen: tcp:192.0.2.7:1502: this machine has no such address", complaint)
        self.assertIn("Modbus TCP listens at tcp:192.0.2.7:1502", said)

    def test_what_the_packages_service_must_be_given_is_told(self):
        """The package's systemd unit has IPAddressDeny=any and IPAddressAllow=localhost."""
        out, let_in = "the package's service reaches {} only after `systemctl edit nanoplc`", "the package's service lets another machine in"
        said = self.check("--no-devices")[1]
        self.assertIn(f"{out.format('192.168.10.2')} with [Service], IPAddressAllow=192.168.10.2 and a restart\n", said)
        self.assertNotIn(let_in, said)
        for broker, told in (("abc.de:1883", "IPAddressAllow=ADDRESS (the broker's, and the name server's"), ("[fd00::2]:1883", "IPAddressAllow=fd00::2 ")):
            said = self.check("--no-devices", broker=broker)[1]
            self.assertIn(told, said)
        for broker in ("127.0.0.1:1883", "[::1]:1883", "localhost:1883"):
            self.assertNotIn("the package's service", self.check("--no-devices", broker=broker)[1], broker)
        for address in ("0.0.0.0", "[::]", "192.168.10.3"):
            self.assertIn(let_in, self.check("--no-devices", address=address)[1], address)

    def test_a_user_without_password_is_warned_of(self):
        complaint = self.check("--no-devices", mqtt='user = "cell4"')[2]
        self.assertIn("mqtt.user: warning: cell4 goes to the broker without a password; name a password_file", complaint)
        self.assertNotIn("mqtt.user", self.check("--no-devices", mqtt=f'user = "cell4"\npassword_file = "{self.path("password")}"')[2])


if __name__ == "__main__":
    NANOPLC = os.path.abspath(sys.argv[1])
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
