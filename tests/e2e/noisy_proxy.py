"""A bad line between a client and a socket."""

import random
import socket
import threading


class NoisyProxy:
    """A socket between a client and the gateway's socket that damages a share of the bytes, both ways, and breaks after
    so many bytes. Like the gateway's, it serves one client at a time: the next one waits until the last has gone."""

    def __init__(self, path, target, share, seed, breaks_after=None, change=None):
        self.share = share
        self.swallow = 0  # messages of the client that never arrive
        self.left = breaks_after
        self.change = change  # of what the gateway sends
        self.random = random.Random(seed)
        self.damaged = 0
        self.ends = []
        self.listener = socket.socket(socket.AF_UNIX)
        self.listener.bind(path)
        self.listener.listen(1)
        self.target = target
        self.acceptor = threading.Thread(target=self.accept, daemon=True)
        self.acceptor.start()

    def accept(self):
        while True:
            try:
                client, _ = self.listener.accept()
            except OSError:
                return
            gateway = socket.socket(socket.AF_UNIX)
            gateway.connect(self.target)
            self.ends = [client, gateway]
            pumps = [threading.Thread(target=self.pump, args=ends, daemon=True)
                     for ends in ((client, gateway, True), (gateway, client, False))]
            for pump in pumps:
                pump.start()
            for pump in pumps:
                pump.join()
            client.close()
            gateway.close()

    def pump(self, source, sink, from_client):
        while True:
            try:
                data = bytearray(source.recv(4096))
                if data and from_client and self.swallow > 0:
                    self.swallow -= 1
                    continue
                if self.change and not from_client:
                    data = self.change(data)
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
        """The gateway's socket is free again when this is done."""
        for end in (self.listener, *self.ends):
            try:
                end.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass
        self.acceptor.join()
        self.listener.close()
