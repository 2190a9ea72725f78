#!/usr/bin/env python3
"""The Debian packages for other processors: their metadata, and their programs under qemu-user.

usage: foreign_test.py ARCHITECTURE[=BUILD_FOLDER]...

ARCHITECTURE is arm64, armhf or riscv64; arm64 and armhf without a folder are built with the presets of the tests. 77: the
compiler, the emulator or the libraries for one of them are not to be had; the reason is printed.
"""

import contextlib
import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "e2e"))
import bill  # noqa: E402
import certificates  # noqa: E402
from sparkplug_host import Broker, Host  # noqa: E402

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
PRESETS = {"arm64": "board", "armhf": "board-armhf"}
# Compiler, emulator, and how `file` would call it: class and machine of the ELF header.
ARCHITECTURES = {
    "arm64": ("aarch64-linux-gnu-g++", "qemu-aarch64-static", (2, 183)),
    "armhf": ("arm-linux-gnueabihf-g++", "qemu-arm-static", (1, 40)),
    "riscv64": ("riscv64-linux-gnu-g++", "qemu-riscv64-static", (2, 243)),
}
EXAMPLE = "etc/nanoplc/nanoplc.toml"
NO_MQTT = ("riscv64",)  # Debian 12 has no OpenSSL for it
CONFIG = """[service]
state_directory = "{folder}/state"
[mqtt]
broker = "localhost:{port}"
node = "cell"
user = "cell"
password_file = "{folder}/password"
ca_file = "{folder}/{ca}"
[[axis]]
name = "x"
table = "none"
[axis.motor]
port = "{folder}/no_motor"
[axis.user]
port = "unix:{folder}/user"
"""


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


@contextlib.contextmanager
def service(emulator, program, folder, port, ca):
    """nanoplc under way, its axis without a motor: its output."""
    config = os.path.join(folder, "nanoplc.toml")
    with open(config, "w", encoding="utf-8") as file:
        file.write(CONFIG.format(folder=folder, port=port, ca=ca))
    with subprocess.Popen([emulator, program, "--config", config], stderr=subprocess.PIPE, text=True) as process:
        try:
            yield process.stderr
        finally:
            process.kill()


def speaks_mqtt(emulator, program):
    """What is wrong: births over TLS to a broker with the right name, and none to one with another's certificate."""
    with tempfile.TemporaryDirectory() as folder:
        broker = Broker(folder, certificates.make(folder))
        host = Host(broker.port, user=("cell", "right"), ca=os.path.join(folder, "ca.pem"))
        try:
            with open(os.path.join(folder, "password"), "w", encoding="utf-8") as file:
                file.write("right\n")
            with service(emulator, program, folder, broker.port, "ca.pem"):
                host.wait(lambda m: m.kind == "NBIRTH")
                born, _ = host.wait(lambda m: m.kind == "DBIRTH")
            if born.device != "x" or not born.named("position").null:
                return [f"its birth is {born.device}'s"]
            with service(emulator, program, folder, broker.port, "other.pem") as said:
                line = next((line for line in said if "no connection" in line), "")
            return [] if "certificate verify failed" in line else [f"a wrong certificate: {line}"]
        finally:
            host.end()
            broker.stop()


def materials(architecture, package):
    """What is wrong with its bill of materials, and lintian's findings."""
    path = package.removesuffix(".deb") + ".spdx.json"
    wrong = bill.problems(path, package)
    document = bill.read(path)
    static = {"libgpiod-dev", "libsodium-dev", "mosquitto", "libssl-dev"} if architecture not in NO_MQTT else {"libgpiod"}
    wrong += [f"{name} is linked and not in its bill" for name in static - bill.related(document, "STATIC_LINK")]
    wrong += [f"it needs {name}" for name in bill.related(document, "DYNAMIC_LINK")]
    if shutil.which("lintian"):
        said = run("lintian", "--allow-root", package)
        wrong += (said.stdout + said.stderr).splitlines()
    return wrong


def openssl(architecture, package):
    """Whether the bill has the version that the library's own header names."""
    if architecture in NO_MQTT:
        return []
    header, = glob.glob(os.path.join(ROOT, "build/sysroot", architecture, "usr/include/openssl/opensslv.h")) or glob.glob(
        os.path.join(ROOT, "build/sysroot", architecture, "usr/include/*/openssl/opensslv.h"))
    with open(header, encoding="utf-8") as file:
        said = re.search(r'OPENSSL_VERSION_STR "([0-9.]+)"', file.read())[1]
    billed = [one["versionInfo"] for one in bill.read(package.removesuffix(".deb") + ".spdx.json")["packages"] if one["name"] == "libssl-dev"]
    return [] if len(billed) == 1 and billed[0].startswith(said + "-") else [f"OpenSSL {said} is in it, and {billed} in its bill"]


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
    wrong += materials(architecture, package) + openssl(architecture, package)
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
        if architecture not in NO_MQTT:
            wrong += speaks_mqtt(emulator, os.path.join(root, "usr/sbin/nanoplc"))
    print(f"{architecture}: {os.path.getsize(package) // 1024} kB, {'; '.join(wrong) if wrong else 'in order'}")
    return wrong


def main():
    if not sys.argv[1:]:
        sys.exit(__doc__)
    named = [argument.partition("=") for argument in sys.argv[1:]]
    folders = {name: folder or os.path.join(ROOT, "build", PRESETS[name]) for name, _, folder in named}
    packages = {name: build(name, folder) for name, folder in folders.items()}
    wrong = [check(name, package) for name, package in packages.items() if package]
    if any(wrong):
        return 1
    return 77 if None in packages.values() else 0


if __name__ == "__main__":
    sys.exit(main())
