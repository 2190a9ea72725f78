"""A serial line with several devices on it: a terminal for the master, a socket of each device. All devices receive what the master sends, and
what they send comes to it as it comes."""

import os
import pty
import socket
import threading
import tty


class SharedLine:
    def __init__(self, path):
        self.master, self.slave = pty.openpty()
        tty.setraw(self.slave)
        os.symlink(os.ttyname(self.slave), path)
        self.devices = []
        threading.Thread(target=self.hear_master, daemon=True).start()

    def join(self, path):
        device = socket.socket(socket.AF_UNIX)
        device.connect(path)
        self.devices.append(device)
        threading.Thread(target=self.hear_device, args=(device,), daemon=True).start()

    def hear_master(self):
        try:
            while data := os.read(self.master, 4096):
                for device in list(self.devices):
                    try:
                        device.sendall(data)
                    except OSError:  # it is gone
                        self.devices.remove(device)
                        device.close()
        except OSError:  # closed
            pass

    def hear_device(self, device):
        try:
            while data := device.recv(4096):
                os.write(self.master, data)
        except OSError:
            pass

    def close(self):
        for device in self.devices:
            device.close()
        os.close(self.slave)
        os.close(self.master)
