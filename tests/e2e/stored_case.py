"""What nanoplc has stored, damaged or on a disk that is full: what the tests of it share."""

import os
import subprocess

from service_case import ServiceCase

# firmware/store: two table slots of five blocks, two settings slots and two of set-points of one, a header of 24 bytes and a
# mark of 8.
BLOCK = 2048
TABLES, SETTINGS, SET_POINTS = (0, 5 * BLOCK), (10 * BLOCK, 11 * BLOCK), (12 * BLOCK, 13 * BLOCK)


class Stored(ServiceCase):
    def setUp(self):
        super().setUp()
        self.plug_in()
        self.store, self.mark = self.path("state/x/store.bin"), self.path("state/x/running")

    def change(self, path, offset, change):
        with open(path, "r+b") as file:
            file.seek(offset)
            old = file.read(1)[0]
            file.seek(offset)
            file.write(bytes([change(old)]))

    def flip(self, path, offset, bit=0):
        self.change(path, offset, lambda byte: byte ^ 1 << bit)

    def erase(self, offset, byte=0xFF):
        with open(self.store, "r+b") as file:
            file.seek(offset)
            file.write(bytes([byte]) * BLOCK)

    def expect_waits(self, config, reason, said):
        """It does not start by itself, and every interface gives the reason."""
        service = self.start(config)
        self.until(lambda: said in service.said(), service)
        status = self.ctl("status")
        self.assertEqual((status["state"], status["safe_reason"]), ("stopped", reason), service.said())
        return service, status

    def expect_refuses(self):
        """Neither run nor stop and run, step or reset get round it."""
        for commands in (["run"], ["stop", "run"], ["step"]):
            for command in commands[:-1]:
                self.ctl(command)
            self.ctl(commands[-1], exit_code=1)
        self.assertEqual(self.ctl("status")["state"], "stopped")

    def stored_run(self, more=""):
        """A table that starts by itself is stored, and the service has ended."""
        config = self.write(self.axis(more=more))
        service = self.start(config)
        self.ctl("upload", "--only-store", self.table)
        self.assertEqual(self.end(service), 0)
        return config


class SmallDisk(Stored):
    """The state directory is a disk of 64 KiB."""

    def setUp(self):
        super().setUp()
        state = self.path("state")
        os.mkdir(state)
        # pylint: disable-next=consider-using-with
        self.disk = subprocess.Popen(["unshare", "-rm", "sh", "-c", 'mount -t tmpfs -o size=64k none "$0" && echo ready && '
                                      'exec sleep infinity', state], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        if self.disk.stdout.readline() != "ready\n":
            self.let_go()
            self.skipTest("this machine does not let a program mount a disk of its own")
        self.addCleanup(self.let_go)
        self.inside = ["nsenter", "-t", str(self.disk.pid), "-U", "-m", "--preserve-credentials"]
        self.state = f"/proc/{self.disk.pid}/root{state}"
        self.mark = self.state + "/x/running"

    def state_folder(self):
        return self.state

    def let_go(self):
        self.disk.kill()
        self.disk.communicate()

    def start_inside(self, config):
        service = self.start(config, inside=self.inside)
        self.assertIsNone(service.process.poll(), service.said())
        return service

    def fill(self):
        with self.assertRaises(OSError), open(self.state + "/fill", "wb", buffering=0) as file:
            while True:
                file.write(bytes(4096))
