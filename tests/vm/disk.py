"""A disk for the virtual board that loses at a power cut what had not been flushed.

    disk = Disk(path_of_image, folder)
    board.Board(..., more=disk.arguments())
    disk.cut_at(17, machine.kill)     # in the 17th request from now on; nothing is done any more after it
    disk.power_off(random)

What is written is in a cache until the board asks for a flush (or writes through, FUA). At a power cut each sector of the
cache reaches the medium or not, as chance will have it, in no order: a real disk promises no more. The protocol is NBD.
"""

import os
import socket
import struct
import threading

SECTOR = 512
_READ, _WRITE, _END, _FLUSH = 0, 1, 2, 3
_FUA = 1
_FLAGS = 1 | 4 | 8  # has flags, flush, FUA
_OPTION_GO, _REPLY_ACK, _REPLY_INFO, _REPLY_UNKNOWN = 7, 1, 3, 0x80000001
_REPLY = 0x3E889045565A9


class Disk:
    def __init__(self, image, folder):
        with open(image, "rb") as file:
            self.medium = bytearray(file.read())
        self.place = os.path.join(folder, "disk")
        self.cache = {}
        self.requests = 0  # that change something
        self._cut_at = self._cut = None
        self._dead = False
        self._lock = threading.Lock()
        self._listener = socket.socket(socket.AF_UNIX)
        self._listener.bind(self.place)
        self._listener.listen()
        threading.Thread(target=self._accept, daemon=True).start()

    def arguments(self):
        return ["-drive", f"if=none,id=disk,format=raw,cache=writeback,file=nbd:unix:{self.place}",
                "-device", "virtio-blk-pci,drive=disk"]

    def cut_at(self, request, cut):
        """`cut` is called instead of that request, counted from 1 on from now."""
        with self._lock:
            self._cut_at, self._cut = self.requests + request, cut

    def power_off(self, chance):
        """After the board has ended."""
        with self._lock:
            for sector, data in self.cache.items():
                if chance.random() < 0.5:
                    self._keep(sector, data)
            self.cache = {}
            self._cut_at = None
            self._dead = False

    def _keep(self, sector, data):
        self.medium[sector * SECTOR:(sector + 1) * SECTOR] = data

    def _accept(self):
        while True:
            connection, _ = self._listener.accept()
            threading.Thread(target=self._serve, args=[connection], daemon=True).start()

    def _serve(self, connection):
        file = connection.makefile("rwb")
        try:
            self._shake_hands(file)
            while self._answer(file):
                file.flush()
        except (OSError, struct.error):
            pass  # the board has ended
        connection.close()

    def _shake_hands(self, file):
        file.write(b"NBDMAGIC" b"IHAVEOPT" + struct.pack(">H", 3))
        file.flush()
        file.read(4)
        while True:
            _, option, length = struct.unpack(">8sII", file.read(16))
            file.read(length)
            if option == _OPTION_GO:
                info = struct.pack(">HQH", 0, len(self.medium), _FLAGS)
                file.write(struct.pack(">QIII", _REPLY, option, _REPLY_INFO, len(info)) + info)
            known = option == _OPTION_GO
            file.write(struct.pack(">QIII", _REPLY, option, _REPLY_ACK if known else _REPLY_UNKNOWN, 0))
            file.flush()
            if known:
                return

    def _answer(self, file):
        _, flags, kind, handle, offset, length = struct.unpack(">IHHQQI", file.read(28))
        data = file.read(length) if kind == _WRITE else b""
        with self._lock:
            if kind == _END or not self._is_alive(kind):
                return False
            if kind == _WRITE:
                self._write(offset, data, flags & _FUA)
            if kind == _FLUSH:
                self._flush(self.cache)
            answer = self._read(offset, length) if kind == _READ else b""
        file.write(struct.pack(">IIQ", 0x67446698, 0, handle) + answer)
        return True

    def _is_alive(self, kind):
        if kind != _READ:
            self.requests += 1
        if self.requests == self._cut_at and not self._dead:
            self._dead = True
            self._cut()
        return not self._dead

    def _write(self, offset, data, through):
        sectors = {offset // SECTOR + i: data[i * SECTOR:(i + 1) * SECTOR] for i in range(len(data) // SECTOR)}
        self.cache.update(sectors)
        if through:
            self._flush(sectors)

    def _flush(self, sectors):
        for sector in list(sectors):
            self._keep(sector, self.cache.pop(sector))

    def _read(self, offset, length):
        first = offset // SECTOR
        return b"".join(self.cache.get(i) or bytes(self.medium[i * SECTOR:(i + 1) * SECTOR])
                        for i in range(first, first + length // SECTOR))
