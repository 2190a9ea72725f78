#!/usr/bin/env python3
"""A tap on a serial line: what comes from the gateway goes to the motor and back, and the times of what the gateway sends are printed.

usage: line_relay.py LINK MOTOR

LINK becomes the gateway's end, MOTOR is the motor's. A line `SECONDS HEX` on standard output for each read.
"""

import os
import select
import sys
import time
import tty


def main():
    link, motor_path = sys.argv[1:3]
    gateway, own = os.openpty()
    tty.setraw(own)
    os.symlink(os.ttyname(own), link)
    motor = os.open(motor_path, os.O_RDWR | os.O_NOCTTY)
    tty.setraw(motor)
    print("ready", flush=True)
    while True:
        ready, _, _ = select.select([gateway, motor], [], [])
        if gateway in ready:
            now = time.monotonic()
            data = os.read(gateway, 256)
            os.write(motor, data)
            print(f"{now:.6f} {data.hex()}", flush=True)
        if motor in ready:
            os.write(gateway, os.read(motor, 256))


if __name__ == "__main__":
    main()
