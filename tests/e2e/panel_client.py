"""A client of the panel's protocol: texts of a WebSocket (RFC 6455)."""

import base64
import itertools
import json
import os
import socket
import struct
import time

LONG = 60
TEXT = 0x81  # the whole message in a frame


class Panel:
    def __init__(self, port):
        self.numbers = itertools.count(1)
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=LONG)
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall(f"GET /live HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                            f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n".encode())
        self.file = self.socket.makefile("rb")
        assert b" 101 " in self.file.readline()
        while self.file.readline() != b"\r\n":
            pass

    def close(self):
        self.file.close()
        self.socket.close()

    def message(self):
        kind, size = self.file.read(2)
        if size == 126:
            size, = struct.unpack(">H", self.file.read(2))
        elif size == 127:
            size, = struct.unpack(">Q", self.file.read(8))
        data = self.file.read(size)
        return json.loads(data) if kind == TEXT else {}

    def first(self, wanted):
        """The first message that `wanted` takes."""
        end = time.monotonic() + LONG
        while time.monotonic() < end:
            message = self.message()
            if wanted(message):
                return message
        raise AssertionError("never came")

    def ask(self, what, **members):
        """The answer. A client's frames are masked, here with zeros."""
        number = next(self.numbers)
        data = json.dumps({"id": number, "do": what, **members}).encode()
        size = bytes([0x80 | len(data)]) if len(data) < 126 else struct.pack(">BH", 0x80 | 126, len(data))
        self.socket.sendall(bytes([TEXT]) + size + bytes(4) + data)
        return self.first(lambda message: message.get("t") == "answer" and message["id"] == number)
