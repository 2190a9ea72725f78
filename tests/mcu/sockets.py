"""Sockets of the emulator."""

import os
import socket
import time

LONG = int(os.environ.get("LONG", 60))  # timeout in seconds of what must come


class Lines:
    """A socket that speaks in lines."""

    def __init__(self, path):
        self.socket = connected(path)
        self.file = self.socket.makefile("r", encoding="utf-8")

    def ask(self, line):
        self.socket.sendall(line.encode() + b"\n")
        return self.file.readline()

    def close(self):
        self.file.close()
        self.socket.close()


def connected(path):
    """qemu opens its sockets one after the other."""
    end = time.monotonic() + LONG
    while True:
        client = socket.socket(socket.AF_UNIX)
        try:
            client.connect(path)
            client.settimeout(LONG)
            return client
        except OSError:
            client.close()
            if time.monotonic() > end:
                raise
            time.sleep(0.01)
