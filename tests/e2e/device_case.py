"""What tests of programs with virtual devices share: clients of their endpoints, and a test case that starts and ends them."""

import os
import select
import socket
import subprocess
import time
import tty

import simulator
from program_case import ProgramCase

LONG = 20  # timeout in seconds of what must come


class Terminal:
    def __init__(self, path):
        self.fd = os.open(path, os.O_RDWR | os.O_NOCTTY)
        tty.setraw(self.fd)

    def send(self, data):
        os.write(self.fd, data)

    def receive(self, seconds):
        ready, _, _ = select.select([self.fd], [], [], seconds)
        return os.read(self.fd, 4096) if ready else b""

    def close(self):
        os.close(self.fd)


class Socket:
    def __init__(self, family, address):
        self.socket = socket.socket(family)
        self.socket.connect(address)

    def send(self, data):
        self.socket.sendall(data)

    def receive(self, seconds):
        self.socket.settimeout(seconds)
        try:
            return self.socket.recv(4096)
        except TimeoutError:
            return b""

    def close(self):
        self.socket.close()


class Case(ProgramCase):
    def setUp(self):
        super().setUp()
        self.clients = []

    def tearDown(self):
        for client in self.clients:
            client.close()
        super().tearDown()

    def start_program(self, *command):
        """Runs it until it is ready; answers the process and what it printed before."""
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.running.append(process)
        return process, [line.rstrip("\n") for line in simulator.until_ready(process)]

    def kept(self, client):
        self.clients.append(client)
        return client

    def ask(self, client, request, length):
        """Sends, and collects so many bytes of answer."""
        client.send(request)
        return self.collect(client, length)

    def collect(self, client, length):
        answer = b""
        end = time.monotonic() + LONG
        while len(answer) < length and time.monotonic() < end:
            answer += client.receive(0.1)
        self.assertEqual(len(answer), length, answer.hex(" "))
        return answer

    def said(self, client, line):
        """What a control port answers to a line."""
        client.send(line.encode() + b"\n")
        answer = b""
        end = time.monotonic() + LONG
        while not answer.endswith(b"\n") and time.monotonic() < end:
            answer += client.receive(0.1)
        return answer.decode().rstrip("\n")

    def refused_by(self, program, *arguments, says):
        done = subprocess.run([program, *arguments], capture_output=True, timeout=LONG, check=False, text=True)
        self.assertEqual(done.returncode, 2, arguments)
        self.assertEqual(done.stdout, "", arguments)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertIn(says, done.stderr)
