#!/usr/bin/env python3
"""What the faces towards the plant cost: from a Modbus request to its answer beside libmodbus's bare server in one run; scan times,
processor and memory of the service with no face asked, and with Modbus, MQTT and metrics under load. See --help."""

import argparse
import os
import re
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time
import urllib.request

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path += [os.path.join(HERE, "..", "e2e"), HERE]
import simulator  # noqa: E402  pylint: disable=wrong-import-position
from bench_service import CONFIG, memory, used  # noqa: E402  pylint: disable=wrong-import-position
from sparkplug_host import Broker  # noqa: E402  pylint: disable=wrong-import-position

# Every scan sets an output, so that every scan has a time.
PROGRAM = """
PROGRAM Toggles
MOTOR MAC140;
VAR_OUTPUT Lamp AT %QX0.0 : BOOL; END_VAR
POWER_UP NEXT := A; END_POWER_UP
STEP A: OWN ERROR; OUT Lamp; IF ERROR THEN EVERY_SCAN RESET_ERROR; END_IF NEXT := B; END_STEP
STEP B: OWN ERROR; IF ERROR THEN EVERY_SCAN RESET_ERROR; END_IF NEXT := A; END_STEP
END_PROGRAM
"""
FACES = '[modbus]\nlisten = "tcp:127.0.0.1:0"\n[metrics]\nlisten = "127.0.0.1:0"\n'
MQTT = '[mqtt]\nbroker = "127.0.0.1:{port}"\nperiod = 100\n'
STATUS, WHY = (0, 45), (900, 100)  # input registers: the first one, how many


def request_of(first, count):
    """Modbus TCP: input registers of unit 1."""
    return struct.pack(">HHHBBHH", 1, 0, 6, 1, 4, first, count)


class Service:
    def __init__(self, nanoplc, folder, port=None, service=""):
        """With MQTT if there is the port of a broker. `service`: more lines of its section."""
        config = f"{folder}/nanoplc.toml"
        with open(config, "w", encoding="utf-8") as file:
            file.write(CONFIG.format(folder=folder, motor=f"{folder}/motor").replace("waits.bin", "toggles.bin").replace("[service]\n", "[service]\n" + service) + "[axis.settings]\nmotor_silence = 200\n")
            file.write(FACES + (MQTT.format(port=port) if port else ""))
        wanted = ["the sequence runs", "listens at", "served at"] + (["MQTT: connected"] if port else [])
        # pylint: disable-next=consider-using-with
        self.process = subprocess.Popen([nanoplc, "--config", config], stderr=subprocess.PIPE, text=True)
        said = ""
        while not all(word in said for word in wanted):
            line = self.process.stderr.readline()
            assert line, said
            said += line
        threading.Thread(target=self.process.stderr.read, daemon=True).start()
        self.modbus = re.search(r"listens at tcp:127.0.0.1:(\d+)", said).group(1)
        self.url = re.search(r"served at (\S+)", said).group(1)

    def end(self):
        self.process.terminate()
        self.process.wait()

    def scrape(self):
        """{upper bound of scan times: how many}, their sum."""
        with urllib.request.urlopen(self.url) as answer:
            text = answer.read().decode()
        assert "nanoplc_scan_seconds_sum" in text, text
        found = re.findall(r'nanoplc_scan_seconds_bucket\{axis="x",le="([^"]+)"\} (\d+)', text)
        return {float(bound): int(count) for bound, count in found}, float(re.search(r"nanoplc_scan_seconds_sum\S+ (\S+)", text).group(1))


def scans(service, seconds, label):
    first, sum_before = service.scrape()
    begun, before = time.monotonic(), used(service.process)
    time.sleep(seconds)
    share = (used(service.process) - before) / (time.monotonic() - begun) * 100
    last, sum_after = service.scrape()
    count = last[float("inf")] - first[float("inf")]
    over = [f"{(count - last[bound] + first[bound]) / count * 100:.3f} % over {bound * 1000:g} ms" for bound in (0.003, 0.005, 0.01)]
    print(f"{label}: {count} scans, mean {(sum_after - sum_before) / count * 1e6:.0f} us, {', '.join(over)}; {share:.1f} % of a processor, "
          f"{memory(service.process)['VmRSS']} kB")


class Reader:
    """A PLC that reads these blocks ten times a second."""

    def __init__(self, port, *blocks):
        self.line = socket.create_connection(("127.0.0.1", int(port)))
        self.blocks = blocks
        self.reads = True
        self.thread = threading.Thread(target=self.read)
        self.thread.start()

    def read(self):
        while self.reads:
            for block in self.blocks:
                self.line.sendall(request_of(*block))
                head = self.line.recv(6, socket.MSG_WAITALL)
                self.line.recv(struct.unpack(">H", head[4:])[0], socket.MSG_WAITALL)
            time.sleep(0.1)

    def end(self):
        self.reads = False
        self.thread.join()
        self.line.close()


def write_program(seqc, folder):
    with open(f"{folder}/toggles.seq", "w", encoding="utf-8") as file:
        file.write(PROGRAM)
    subprocess.run([seqc, "build", f"{folder}/toggles.seq", "-o", f"{folder}/toggles.bin"], check=True, stdout=subprocess.DEVNULL)


def without_mqtt(options, folder):
    """What reading costs, and what asking why does, for which the motor's registers are read every 10 s."""
    service = Service(options.nanoplc, folder)
    scans(service, options.seconds, "nobody asks")
    for label, blocks in (("a PLC reads the status", [STATUS]), ("and why", [STATUS, WHY])):
        plc = Reader(service.modbus, *blocks)
        scans(service, options.seconds, label)
        plc.end()
    service.end()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for program in ("nanoplc", "macsim", "seqc", "bench_modbus"):
        parser.add_argument(program)
    parser.add_argument("--seconds", type=float, default=20, help="of each measurement of scans (default: %(default)s)")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        broker = Broker(folder)
        write_program(options.seqc, folder)
        motor, _ = simulator.start(options.macsim, "--model", "MAC140", "--fastmac", f"pty:{folder}/motor")
        without_mqtt(options, folder)
        service = Service(options.nanoplc, folder, broker.port)
        scans(service, options.seconds, "nobody asks but MQTT")
        with socket.create_server(("127.0.0.1", 0)) as free:
            bare = str(free.getsockname()[1])
        with subprocess.Popen([options.bench_modbus, "serve", bare], stdout=subprocess.PIPE, text=True) as other:
            assert other.stdout.readline() == "ready\n", "libmodbus cannot listen"
            if subprocess.run([options.bench_modbus, "measure", service.modbus, bare], check=False).returncode:
                other.kill()
                sys.exit("bench_faces: a server did not answer")
            asking = True

            def load():
                while asking:
                    subprocess.run([options.bench_modbus, "measure", service.modbus, bare], stdout=subprocess.DEVNULL, check=False)

            def scrape():
                while asking:
                    service.scrape()
                    time.sleep(0.1)

            threads = [threading.Thread(target=load), threading.Thread(target=scrape)]
            for thread in threads:
                thread.start()
            scans(service, options.seconds, "Modbus without a pause, ten scrapes a second, MQTT")
            asking = False
            for thread in threads:
                thread.join()
            other.kill()
        service.end()
        motor.terminate()
        motor.communicate()
        broker.stop()


if __name__ == "__main__":
    main()
