"""A broker, and a host that reads Sparkplug B with a decoder of its own, written from sparkplug_b.proto."""

import json
import shutil
import socket
import struct
import subprocess
import sys
import threading
import time

# Debian's packages, whichever Python this is.
sys.path.append("/usr/lib/python3/dist-packages")
import paho.mqtt.client as paho  # noqa: E402

LONG = 60
DOUBLE, BOOLEAN = 10, 11


def fields(data):
    """[(number, value)] of a protobuf message; a value is an int, or bytes."""
    out = []
    at = 0

    def varint():
        nonlocal at
        value = shift = 0
        while True:
            byte = data[at]
            at += 1
            value |= (byte & 0x7F) << shift
            shift += 7
            if byte < 0x80:
                return value

    while at < len(data):
        tag = varint()
        if tag & 7 == 0:
            out.append((tag >> 3, varint()))
            continue
        size = {1: 8, 5: 4}.get(tag & 7)
        if size is None:
            assert tag & 7 == 2, tag
            size = varint()
        assert at + size <= len(data)
        out.append((tag >> 3, data[at:at + size]))
        at += size
    return out


def signed(value):
    return value - 2**64 if value >= 2**63 else value


class Metric:
    def __init__(self, data):
        known = dict(fields(data))
        self.name = known.get(1, b"").decode()
        self.alias = known.get(2)
        self.timestamp = known.get(3)
        self.type = known.get(4)
        self.historical = bool(known.get(5))
        self.null = bool(known.get(7))
        self.description = dict(fields(known.get(8, b""))).get(8, b"").decode()
        self.value = None
        for number, take in ((10, int), (11, signed), (13, lambda raw: struct.unpack("<d", raw)[0]), (14, bool), (15, bytes.decode)):
            if number in known:
                self.value = take(known[number])
        self.properties = {}
        inner = fields(known.get(9, b""))
        for key, value in zip([v for n, v in inner if n == 1], [dict(fields(v)) for n, v in inner if n == 2]):
            number = struct.unpack("<d", value[6])[0] if 6 in value else value.get(3)
            self.properties[key.decode()] = value[8].decode() if 8 in value else number


class Message:
    def __init__(self, topic, data, retained):
        self.topic = topic
        self.retained = retained
        parts = topic.split("/")
        self.kind, self.device = parts[2], parts[4] if len(parts) > 4 else None
        known = fields(data)
        self.timestamp = dict(known).get(1)
        self.seq = dict(known).get(3)
        self.metrics = [Metric(value) for number, value in known if number == 2]

    def named(self, name):
        return next(metric for metric in self.metrics if metric.name == name)


def varint(value):
    out = b""
    while value >= 0x80:
        out += bytes([value & 0x7F | 0x80])
        value >>= 7
    return out + bytes([value])


def command(name, value=True, timestamp=None):
    """The payload of an NCMD or DCMD."""
    stamp = int(time.time() * 1000) if timestamp is None else timestamp
    metric = b"\x0a" + varint(len(name)) + name.encode() + b"\x18" + varint(stamp) + b"\x20" + varint(BOOLEAN) + b"\x70" + varint(value)
    return b"\x08" + varint(stamp) + b"\x12" + varint(len(metric)) + metric


def values(metrics, timestamp=None):
    """The payload of a DCMD with numbers by their names."""
    stamp = int(time.time() * 1000) if timestamp is None else timestamp
    out = b"\x08" + varint(stamp)
    for name, value in metrics.items():
        metric = b"\x0a" + varint(len(name)) + name.encode() + b"\x18" + varint(stamp) + b"\x20" + varint(DOUBLE)
        metric += b"\x69" + struct.pack("<d", value)
        out += b"\x12" + varint(len(metric)) + metric
    return out


class Broker:
    def __init__(self, folder, settings="allow_anonymous true\n", port=0):
        self.folder = folder
        self.settings = settings
        if not port:
            with socket.create_server(("127.0.0.1", 0)) as free:
                port = free.getsockname()[1]
        self.port = port
        self.process = None
        self.start()

    def start(self):
        config = f"{self.folder}/mosquitto.conf"
        with open(config, "w", encoding="utf-8") as file:
            file.write(f"listener {self.port} 127.0.0.1\n{self.settings}")
        program = shutil.which("mosquitto", path="/usr/sbin:/usr/local/sbin:/usr/bin")
        # pylint: disable-next=consider-using-with
        self.process = subprocess.Popen([program, "-c", config], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        end = time.monotonic() + LONG
        while time.monotonic() < end:
            try:
                self.is_thrown_out()
                return
            except ConnectionRefusedError:
                time.sleep(0.02)
        raise AssertionError("no broker")

    def is_thrown_out(self):
        """It listens before it reads its files, which a test may take away; what is no MQTT and no TLS it reads afterwards."""
        with socket.create_connection(("127.0.0.1", self.port), LONG) as stranger:
            try:
                stranger.sendall(bytes(8))
                stranger.recv(100)
            except (ConnectionResetError, BrokenPipeError):
                pass

    def stop(self):
        self.process.kill()
        self.process.wait()


class Host:
    def __init__(self, port, group="nanoplc", name="host", user=None, ca=None):
        self.group = group
        self.messages = []
        self.news = threading.Condition()
        self.client = paho.Client(name)
        self.ready = threading.Event()
        self.client.on_connect = lambda client, *_: client.subscribe(f"spBv1.0/{group}/#", 1)
        self.client.on_subscribe = lambda *_: self.ready.set()
        self.client.on_message = self.take
        self.client.reconnect_delay_set(1, 1)
        if user:
            self.client.username_pw_set(*user)
        if ca:
            self.client.tls_set(ca)
        self.client.connect("127.0.0.1", port)
        self.client.loop_start()
        assert self.ready.wait(LONG)

    def take(self, _client, _data, message):
        if "/STATE/" in message.topic or "CMD/" in message.topic:
            return
        with self.news:
            self.messages.append(Message(message.topic, message.payload, message.retain))
            self.news.notify_all()

    def wait(self, wanted, after=0):
        """The first message from number `after` on that is wanted, and its number."""
        with self.news:
            found = self.news.wait_for(
                lambda: next(((m, i) for i, m in enumerate(self.messages) if i >= after and wanted(m)), None), LONG)
        assert found, [f"{m.kind} {m.device}" for m in self.messages[-20:]]
        return found

    def tell(self, kind, device, payload, node="sim", retain=False):
        topic = f"spBv1.0/{self.group}/{kind}/{node}" + (f"/{device}" if device else "")
        self.client.publish(topic, payload, 1, retain).wait_for_publish()

    def announce(self, online):
        """The state of primary host scada (Sparkplug 3.0 §6.4.13), once this client has subscribed to everything."""
        assert self.ready.wait(LONG)
        state = json.dumps({"online": online, "timestamp": int(time.time() * 1000)})
        self.client.publish("spBv1.0/STATE/scada", state, 1, True).wait_for_publish()

    def end(self):
        self.client.loop_stop()
        self.client.disconnect()
