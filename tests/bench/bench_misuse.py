#!/usr/bin/env python3
"""What floods and misuse of the faces cost the sequence: mean time of a scan while they go on, beside the quiet turns between them.
A PLC reads the status and why nothing moves ten times a second all the time. See --help."""

import argparse
import os
import random
import socket
import statistics
import struct
import tempfile
import threading
import time

from bench_faces import STATUS, WHY, Reader, Service, request_of, write_program
import simulator
from sparkplug_host import Broker

CLIENTS = 20
WANTED = 1.05
LONG_SCAN = 0.003  # s
SETTLED = 8  # s: the first look at all of the motor's registers


class Attack:
    """Processes that do it again and again until the end. They run at the lowest priority: a client's own
    processor is elsewhere, and here it would keep the kernel's worker from the bytes of the motor's line."""

    def __init__(self, what, port, url):
        self.children = []
        for number in range(CLIENTS if what is not scrape else 2):
            child = os.fork()
            if child == 0:
                os.sched_setscheduler(0, os.SCHED_IDLE, os.sched_param(0))
                random.seed(number)
                while True:
                    try:
                        what(port, url)
                    except OSError:
                        time.sleep(0.01)
            self.children.append(child)

    def end(self):
        for child in self.children:
            os.kill(child, 9)
            os.waitpid(child, 0)


def connected(port):
    return socket.create_connection(("127.0.0.1", port))


def flood(port, _):
    """Requests without a pause."""
    with connected(port) as line:
        for block in (STATUS, WHY) * 50:
            line.sendall(request_of(*block))
            head = line.recv(6, socket.MSG_WAITALL)
            line.recv(struct.unpack(">H", head[4:])[0], socket.MSG_WAITALL)


def half_frames(port, _):
    """The beginning of a request, then nothing, then another connection."""
    with connected(port) as line:
        line.sendall(request_of(*STATUS)[:random.randrange(1, 11)])


def noise(port, _):
    with connected(port) as line:
        line.sendall(random.randbytes(2000))


def never_read(port, _):
    """Requests whose answers are never read."""
    with connected(port) as line:
        line.settimeout(1)
        while True:
            line.sendall(request_of(*STATUS) * 50)


def wrong_units(port, _):
    with connected(port) as line:
        for _ in range(50):
            line.sendall(struct.pack(">HHHBBHH", 1, 0, 6, random.randrange(2, 250), random.randrange(256), random.randrange(65536), 125))
            line.settimeout(0.2)
            line.recv(260)


def scrape(_, url):
    host, _, rest = url.removeprefix("http://").partition("/")
    address, _, port = host.rpartition(":")
    with socket.create_connection((address, int(port))) as line:
        line.sendall(f"GET /{rest} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n".encode())
        while line.recv(65536):
            pass


ATTACKS = {f"{CLIENTS} PLCs without a pause": flood, f"{CLIENTS} that send half frames": half_frames, f"{CLIENTS} that send noise": noise,
           f"{CLIENTS} that never read": never_read, f"{CLIENTS} with wrong units and functions": wrong_units,
           "2 that scrape metrics without a pause": scrape}


def scans(service, seconds):
    """Their mean in us, and how many of a million were longer than LONG_SCAN."""
    first, before = service.scrape()
    time.sleep(seconds)
    last, after = service.scrape()
    count = last[float("inf")] - first[float("inf")]
    return (after - before) / count * 1e6, (1 - (last[LONG_SCAN] - first[LONG_SCAN]) / count) * 1e6


def compare(service, seconds, turns, begin):
    """Means of the quiet turns and of those in which what begin() starts goes on: their medians; and the share of long scans."""
    quiet, busy = [], []
    for _ in range(turns):
        quiet.append(scans(service, seconds))
        end = begin()
        try:
            time.sleep(0.2)
            busy.append(scans(service, seconds))
        finally:
            end()
        time.sleep(0.2)
    return [(statistics.median(mean for mean, _ in turns_of), statistics.mean(late for _, late in turns_of)) for turns_of in (quiet, busy)]


def tell(label, figures):
    (quiet, quiet_late), (busy, busy_late) = figures
    print(f"{label}: {busy:.1f} us, between them {quiet:.1f} us, ratio {busy / quiet:.3f}; of a million {busy_late:.0f} and "
          f"{quiet_late:.0f} were longer than {LONG_SCAN * 1000:g} ms", flush=True)
    return busy / quiet


def broker_goes(broker):
    """Stopped, and started again at the end."""
    broker.stop()
    return broker.start


def measure(service, broker, options):
    worst = 0
    for label, attack in ATTACKS.items():
        figures = compare(service, options.seconds, options.turns, lambda what=attack: Attack(what, int(service.modbus), service.url).end)
        worst = max(worst, tell(label, figures))
    worst = max(worst, tell("the broker gone", compare(service, options.seconds, options.turns, lambda: broker_goes(broker))))
    print(f"worst ratio {worst:.3f}, wanted at most {WANTED}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for program in ("nanoplc", "macsim", "seqc"):
        parser.add_argument(program)
    parser.add_argument("--seconds", type=float, default=1, help="of each turn (default: %(default)s)")
    parser.add_argument("--turns", type=int, default=15, help="with it and without (default: %(default)s)")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        broker = Broker(folder)
        write_program(options.seqc, folder)
        motor, _ = simulator.start("chrt", "-f", "40", options.macsim, "--model", "MAC140", "--fastmac", f"pty:{folder}/motor")
        service = Service(options.nanoplc, folder, broker.port, service="real_time_priority = 50\nlock_memory = true\n")
        plc = Reader(service.modbus, STATUS, WHY)
        try:
            time.sleep(SETTLED)
            measure(service, broker, options)
        finally:
            plc.end()
            service.end()
            motor.terminate()
            motor.communicate()
            broker.stop()


if __name__ == "__main__":
    main()
