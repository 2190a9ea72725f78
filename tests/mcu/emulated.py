"""Runs an image that ends by itself in qemu, and answers what it said."""

import subprocess
import sys


def run(machine, image, *options, characters="", seconds=500):
    """The image's lines; `characters` are for a line of it that is the standard input.

    A failure ends this program with what the image said last."""
    command = ["qemu-system-arm", "-M", machine, "-display", "none", "-monitor", "none",
               "-semihosting-config", "enable=on,target=native", *options, "-kernel", image]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=seconds, input=characters)
    except subprocess.TimeoutExpired:
        sys.exit(f"{image}: not done after {seconds} s")
    lines = (done.stdout + "\n" + done.stderr).splitlines()
    if done.returncode != 0:
        sys.exit("\n".join([*lines[-40:], f"{image}: qemu's exit code is {done.returncode}"]))
    return lines


def build(folder):
    """Target mcu_units of a build folder of preset mcu."""
    done = subprocess.run(["cmake", "--build", folder, "--target", "mcu_units"], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stdout[-4000:] + done.stderr)
