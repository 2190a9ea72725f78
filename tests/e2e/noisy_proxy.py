"""A bad line between a client and a socket."""

import random
import socket
import threading


class NoisyProxy:
    """A socket between a client and the gateway's socket that damages a share of the bytes, both ways, and breaks after
    so many bytes."""

    def __init__(self, path, target, share, seed, breaks_after=None):
        self.share = share
        self.left = breaks_after
        self.random = random.Random(seed)
        self.damaged = 0
        self.ends = []
        self.listener = socket.socket(socket.AF_UNIX)
        self.listener.bind(path)
        self.listener.listen(1)
        self.target = target
        threading.Thread(target=self.accept, daemon=True).start()

    def accept(self):
        while True:
            try:
                client, _ = self.listener.accept()
            except OSError:
                return
            gateway = socket.socket(socket.AF_UNIX)
            self.ends += [client, gateway]
            gateway.connect(self.target)
            for ends in ((client, gateway), (gateway, client)):
                threading.Thread(target=self.pump, args=ends, daemon=True).start()

    def pump(self, source, sink):
        while True:
            try:
                data = bytearray(source.recv(4096))
                for i in range(len(data)):
                    if self.random.random() < self.share:
                        data[i] ^= 1 << self.random.randrange(8)
                        self.damaged += 1
                if self.left is not None:
                    self.left -= len(data)
                    if self.left < 0:
                        data = b""
                sink.sendall(data)
                if not data:
                    return sink.shutdown(socket.SHUT_RDWR)
            except OSError:
                return

    def close(self):
        for end in (*self.ends, self.listener):
            end.close()
