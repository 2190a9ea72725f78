"""A test case with nanoplc as a service, virtual motors that are plugged in and pulled out, and client programs.

Who uses it sets the programs' paths below first.
"""

import json
import os
import signal
import re
import subprocess
import threading

import simulator
from commissioned import commission
from folder_case import FolderCase
from patience import LONG, until

NANOPLC = MACSIM = NANOCTL = MACREG = SEQC = MENDING = ""


class Service:
    """A nanoplc under way, and what it has said."""

    def __init__(self, config, inside=(), **environment):
        # pylint: disable-next=consider-using-with
        self.process = subprocess.Popen([*inside, NANOPLC, "--config", config], stdin=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                        text=True, env={**os.environ, **environment})
        self.lines = []
        self.reader = threading.Thread(target=lambda: self.lines.extend(iter(self.process.stderr.readline, "")))
        self.reader.start()

    def said(self):
        return "".join(self.lines)

    def end(self, how=signal.SIGTERM):
        if self.process.poll() is None:
            self.process.send_signal(how)
        code = self.process.wait(LONG)
        self.reader.join(LONG)
        self.process.stderr.close()
        return code


class ServiceCase(FolderCase):
    PATIENCE = "motor_silence = 200\npoll_limit = 1000000\n"  # machines that test are busy

    def setUp(self):
        super().setUp()
        self.running = []
        self.motors = {}
        self.table = self.path("mending.bin")
        subprocess.run([SEQC, "build", MENDING, "-o", self.table], check=True, stdout=subprocess.DEVNULL)

    def tearDown(self):
        for service in self.running:
            service.end(signal.SIGKILL)
        for name in list(self.motors):
            self.pull_out(name)
        super().tearDown()

    def plug_in(self, name="motor"):
        process, _ = simulator.start(MACSIM, "--model", "MAC140", "--address", "1", "--fastmac", "pty:" + self.path(name),
                                     "--mactalk", "unix:" + self.path(name + ".mactalk"))
        self.motors[name] = process

    def pull_out(self, name="motor"):
        process = self.motors.pop(name)
        process.terminate()
        process.wait(LONG)
        process.stdout.close()
        process.stderr.close()

    def axis(self, name="x", motor="motor", port=None, table="none", more=""):
        if "[axis.settings]" not in more:
            more += "\n[axis.settings]\n"
        more = more.replace("[axis.settings]\n", "[axis.settings]\n" + self.PATIENCE)
        return (f'[[axis]]\nname = "{name}"\ntable = "{table}"\n[axis.motor]\nport = "{self.path(motor)}"\n'
                f'[axis.user]\nport = "{port or "unix:" + self.path(name)}"\n{more}')

    def state_folder(self):
        return self.path("state")

    def write(self, *axes, service="", are_new=False):
        """Punctual where it may be: machines that test are busy."""
        for axis in () if are_new else axes:
            commission(self.state_folder(), re.search(r'^name = "(.*)"$', axis, re.M).group(1))
        head = f'[service]\nstate_directory = "{self.path("state")}"\nreal_time_priority = 10\n{service}\n'
        return self.put("nanoplc.toml", head + "\n".join(axes))

    def start(self, config, wait_for="started with", **environment):
        service = Service(config, **environment)
        self.running.append(service)
        self.until(lambda: wait_for in service.said() or service.process.poll() is not None, service)
        return service

    def end(self, service, how=signal.SIGTERM):
        self.running.remove(service)
        return service.end(how)

    @staticmethod
    def until(come, seen=None):
        until(come, seen.said if seen else "it")

    def ctl(self, *arguments, port="x", exit_code=0):
        """What is refused is refused by silence: then patience is time, and what is read afterwards is asked for ten times."""
        endpoint = port if port.startswith("/") else "unix:" + self.path(port)
        result = subprocess.run([NANOCTL, "--port", endpoint, "--patience", "500" if exit_code else "2000", "--json", *arguments],
                                capture_output=True, text=True, timeout=4 * LONG, check=False)
        return self.document_of(result, exit_code)

    def until_status(self, wanted, port="x"):
        return until(lambda: wanted(status := self.ctl("status", port=port)) and status, lambda: self.ctl("status", port=port))

    def moves(self, port="x"):
        """Orders are being executed."""
        before = self.ctl("status", port=port)["orders"]
        self.until_status(lambda status: status["orders"] > before + 4, port=port)

    def mode(self, name="motor"):
        result = subprocess.run([MACREG, "--port", "unix:" + self.path(name + ".mactalk"), "--patience", "500", "--json", "get",
                                 "MODE_REG"], capture_output=True, text=True, timeout=LONG, check=False)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return json.loads(result.stdout)["registers"][0]["value"]

    def check(self, text, *flags):
        config = self.put("checked.toml", text)
        result = subprocess.run([NANOPLC, "check-config", config, *flags], capture_output=True, text=True, check=False)
        return result.returncode, [line.removeprefix(config + ":") for line in result.stderr.splitlines()]
