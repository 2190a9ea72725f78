"""A simulator as a test needs it: started, and ready."""

import socket
import subprocess
import threading


def start(*command):
    """The process, and its lines until it was ready; its standard output is read on."""
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    lines = until_ready(process)
    threading.Thread(target=process.stdout.read, daemon=True).start()
    return process, lines


def until_ready(process):
    """Its lines until then."""
    lines = []
    for line in process.stdout:
        if line == "ready\n":
            return lines
        lines.append(line)
    raise AssertionError(f"ended before it was ready: {process.communicate()}")


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]
