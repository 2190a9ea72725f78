"""The speed of a serial line. The emulator's have none: it hands a whole message to the firmware before its loop has come round
once, and what its buffer of 64 characters cannot hold is lost, as no line could do it."""

import fcntl
import os
import select
import socket
import struct
import termios
import threading
import time

import sockets


def unread(end):
    """Something that was sent to the other end waits there."""
    return struct.unpack("i", fcntl.ioctl(end, termios.TIOCOUTQ, bytes(4)))[0] != 0


class Wire:
    """Listens at `path`, one client at a time, and hands on to the emulator's socket `chip`: towards it 16 characters a
    millisecond, none before it has taken those before."""

    PORTION, PAUSE = 16, 0.001

    def __init__(self, path, chip):
        self.chip = chip
        if os.path.exists(path):
            os.unlink(path)
        self.listener = socket.socket(socket.AF_UNIX)
        self.listener.bind(path)
        self.listener.listen()
        threading.Thread(target=self.serve, daemon=True).start()

    def close(self):
        """When the emulator has ended."""
        self.listener.shutdown(socket.SHUT_RDWR)
        self.listener.close()

    def serve(self):
        while True:
            try:
                client = self.listener.accept()[0]
            except OSError:
                return
            with client, sockets.connected(self.chip) as chip:
                try:
                    self.carry(client, chip)
                except OSError:  # one of them has gone
                    pass

    def carry(self, client, chip):
        """What a client has sent arrives, also when it has gone."""
        waiting, ends = b"", [client, chip]
        while waiting or client in ends:
            readable = select.select(ends, [], [], 0 if waiting else None)[0]
            if chip in readable:
                answer = chip.recv(4096)
                if not answer:
                    return
                if client in ends:
                    client.sendall(answer)
            if client in readable:
                more = client.recv(4096)
                waiting += more
                if not more:
                    ends.remove(client)
            if waiting and not unread(chip):
                chip.sendall(waiting[: self.PORTION])
                waiting = waiting[self.PORTION :]
            if waiting:
                time.sleep(self.PAUSE)
