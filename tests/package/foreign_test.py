#!/usr/bin/env python3
"""The Debian packages for other processors: what they say of themselves, and their programs under qemu-user.

usage: foreign_test.py [ARCHITECTURE=BUILD_FOLDER...]

ARCHITECTURE is arm64, armhf or riscv64. Without arguments arm64 and armhf are built with the presets of the tests. 77: the
compiler, the emulator or the libraries for one of them are not to be had; the reason is printed.
"""

import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
PRESETS = {"arm64": "board", "armhf": "board-armhf"}
# Compiler, emulator, and how `file` would call it: class and machine of the ELF header.
ARCHITECTURES = {
    "arm64": ("aarch64-linux-gnu-g++", "qemu-aarch64-static", (2, 183)),
    "armhf": ("arm-linux-gnueabihf-g++", "qemu-arm-static", (1, 40)),
    "riscv64": ("riscv64-linux-gnu-g++", "qemu-riscv64-static", (2, 243)),
}
EXAMPLE = "etc/nanoplc/nanoplc.toml"


def run(*command):
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)


def build(architecture, folder):
    """The package; nothing if something for it is missing."""
    missing = [program for program in ARCHITECTURES[architecture][:2] if shutil.which(program) is None]
    if missing:
        print(f"{architecture}: skipped: there is no {' and no '.join(missing)}; tools/setup installs them")
        return None
    if subprocess.run([os.path.join(ROOT, "tools", "sysroot"), architecture], check=False).returncode != 0:
        print(f"{architecture}: skipped: its libraries cannot be downloaded (see above)")
        return None
    shutil.rmtree(os.path.join(folder, "package"), ignore_errors=True)
    preset = os.path.basename(folder)
    for step in (["cmake", "--preset", preset],
                 ["cmake", "--build", folder, "--parallel", "2", "--target", "debian_package"]):
        done = run(*step)
        if done.returncode != 0:
            sys.exit(f"{done.stdout}{done.stderr}\n{' '.join(step)} failed")
    return glob.glob(os.path.join(folder, "package", "nanoplc_*.deb"))[0]


def check(architecture, package):
    """What is wrong."""
    _, emulator, header = ARCHITECTURES[architecture]
    fields = dict(re.findall(r"(?m)^([\w-]+): (.*)$", run("dpkg-deb", "-f", package).stdout))
    wrong = []
    if fields.get("Package") != "nanoplc" or fields.get("Architecture") != architecture:
        wrong.append(f"it is {fields.get('Package')} for {fields.get('Architecture')}")
    if not package.endswith(f"_{architecture}.deb"):
        wrong.append(f"its name is {os.path.basename(package)}")
    # The programs are static: the scripts' adduser is all they need.
    if fields.get("Depends") != "adduser":
        wrong.append(f"it depends on {fields.get('Depends')}")
    with tempfile.TemporaryDirectory() as root:
        subprocess.run(["dpkg-deb", "-x", package, root], check=True)
        for program in ("usr/sbin/nanoplc", "usr/bin/nanoctl"):
            path = os.path.join(root, program)
            with open(path, "rb") as file:
                start = file.read(20)
            if start[:4] != b"\x7fELF" or (start[4], int.from_bytes(start[18:20], "little")) != header:
                wrong.append(f"{program} is no program for {architecture}")
            told = run(emulator, path, "--version")
            if told.returncode != 0 or not told.stdout.startswith(os.path.basename(program) + " "):
                wrong.append(f"{program} --version: {told.stdout}{told.stderr}")
        checked = run(emulator, os.path.join(root, "usr/sbin/nanoplc"), "check-config", "--no-devices",
                      os.path.join(root, EXAMPLE))
        if (checked.returncode, checked.stderr) != (0, ""):
            wrong.append(f"check-config: {checked.stderr}")
    print(f"{architecture}: {os.path.getsize(package) // 1024} kB, {'; '.join(wrong) if wrong else 'in order'}")
    return wrong


def main():
    named = dict(argument.split("=", 1) for argument in sys.argv[1:])
    folders = named or {name: os.path.join(ROOT, "build", preset) for name, preset in PRESETS.items()}
    packages = {name: build(name, folder) for name, folder in folders.items()}
    wrong = [check(name, package) for name, package in packages.items() if package]
    if any(wrong):
        return 1
    return 77 if None in packages.values() else 0


if __name__ == "__main__":
    sys.exit(main())
