"""MacTalk to the gateway's own registers (firmware/gateway/REGISTERS.md), a message at a time, as bytes on a socket."""

import re
import socket
import time

import sockets

GATEWAY = 128
FW_VERSION, TABLE_CRC, TABLE_BYTES, STORED_CRC, STORE_FLAGS, STATUS, SAFE_REASON = 2, 4, 5, 6, 9, 16, 17
UPTIME, LOG_COUNT, RESULT, MESSAGES, LINE_FAULTS = 19, 30, 31, 38, 40
COMMAND, UPLOAD_STATE, UPLOAD_RECEIVED, UPLOAD_BYTES, UPLOAD_CRC, TABLE_POINTER, TABLE_DATA = 48, 56, 57, 58, 59, 60, 61
STOP, RESET, KEEP, BEGIN, COMMIT, ACTIVATE = 2, 7, 8, 16, 17, 19
STORED, FAILED = 4, 5  # upload states
STORAGE_FAILED, NOT_FOR_MOTOR = 15, 36  # results
STORE_DAMAGED, NOT_STARTED, BAD_SETTINGS = 26, 1, 9  # an event, and reasons, which are events too
LOG = 128
ACCEPT = b"\x11\x11\x11"


def protected(data):
    return b"".join(bytes([byte, byte ^ 0xFF]) for byte in data)


def read_message(register):
    return b"\x50\x50\x50" + protected([GATEWAY, register]) + b"\xAA\xAA"


def write_message(register, data):
    return b"\x52\x52\x52" + protected([GATEWAY, register, len(data), *data]) + b"\xAA\xAA"


def number(value):
    return value.to_bytes(4, "little")


class UserLine:
    def __init__(self, path):
        self.socket = sockets.connected(path)

    def close(self):
        self.socket.close()

    def drain(self):
        self.socket.setblocking(False)
        try:
            while self.socket.recv(4096):
                pass
        except BlockingIOError:
            pass

    def exchange(self, message, found, seconds):
        """What `found` finds in all that comes; empty if it finds nothing. So a late answer to an earlier message is passed over."""
        self.drain()
        self.socket.setblocking(True)
        self.socket.sendall(message)
        came, end = b"", time.monotonic() + seconds
        while not (answer := found(came)):
            self.socket.settimeout(max(0.01, end - time.monotonic()))
            try:
                more = self.socket.recv(4096)
            except socket.timeout:
                return b""
            if not more:
                return b""
            came += more
        return answer

    def ask(self, message, answer_bytes, seconds=2.0):
        """The first bytes that come; empty if there are fewer."""
        return self.exchange(message, lambda came: came[:answer_bytes] if len(came) >= answer_bytes else b"", seconds)

    def read(self, register):
        """Asked again when no answer comes: a reset may have eaten the message."""
        answer = re.compile(re.escape(b"\x52\x52\x52" + protected([0, register, 4])) + b"(.{8})\xAA\xAA", re.DOTALL)
        for _ in range(200):
            found = self.exchange(read_message(register), answer.search, 0.3)
            if found:
                return int.from_bytes(found.group(1)[::2], "little")
        raise AssertionError(f"register {register} never answered")

    def write(self, register, data):
        """True if it was accepted. No data have three equal bytes in a row."""
        return self.exchange(write_message(register, data), lambda came: ACCEPT in came, 2.0) is True

    def must_write(self, register, value):
        if not self.write(register, number(value)):
            raise AssertionError(f"register {register} did not take {value}: RESULT {self.read(RESULT):08X}h")

    def log(self):
        """Events, oldest first, each with its detail."""
        entries = []
        for index in range(self.read(LOG_COUNT)):
            entry = self.read(LOG + 2 * (index % 16) + 1)
            entries.append((entry & 0xFF, entry >> 16))
        return entries
