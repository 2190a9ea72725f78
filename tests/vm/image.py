"""The initial file system of the virtual board, made of what fetch_packages left in build/vm."""

import glob
import gzip
import os
import re
import stat

HERE = os.path.dirname(os.path.abspath(__file__))
VM = os.path.join(HERE, "..", "..", "build", "vm")

PROGRAMS = [
    "bin/busybox", "bin/ip",
    "usr/bin/gpiodetect", "usr/bin/gpioinfo", "usr/bin/gpioget", "usr/bin/gpioset", "usr/bin/gpiomon",
    "usr/bin/candump", "usr/bin/cansend", "usr/bin/cangen",
]
LIBRARIES = "libc.so.6 libm.so.6 libgpiod.so.2 libbpf.so.1 libelf.so.1 libz.so.1 libmnl.so.0 libbsd.so.0 libmd.so.0 libcap.so.2"
# Loaded at the start.
MODULES = "virtio_pci 9pnet_virtio 9p can-raw vcan kvaser_pci i6300esb".split()
# There for tests that load them themselves, with modprobe.
MORE_MODULES = "gpio_keys xhci-pci ftdi_sio virtio_blk ext4 crc32c_generic configfs board_gpio".split()


class Cpio:
    """An archive of the kind that the kernel unpacks (newc)."""

    def __init__(self):
        self.bytes = bytearray()
        self.count = 0
        self.folders = set()

    def add(self, name, mode, data=b"", device=(0, 0)):
        parent = os.path.dirname(name)
        if parent and parent not in self.folders:
            self.folders.add(parent)
            self.add(parent, stat.S_IFDIR | 0o755)
        self.count += 1
        path = name.encode() + b"\0"
        head = (self.count, mode, 0, 0, 1, 0, len(data), 0, 0, *device, len(path), 0)
        self.bytes += b"070701" + b"".join(b"%08x" % field for field in head) + path
        self.align()
        self.bytes += data
        self.align()

    def add_file(self, name, path):
        with open(path, "rb") as file:
            self.add(name, stat.S_IFREG | 0o755, file.read())

    def align(self):
        self.bytes += bytes(-len(self.bytes) % 4)

    def end(self):
        self.add("TRAILER!!!", 0)
        return bytes(self.bytes)


def modules_by_name():
    found = glob.glob(os.path.join(VM, "kernel/lib/modules/*/kernel/**/*.ko"), recursive=True)
    paths = {os.path.basename(path)[:-3].replace("-", "_"): path for path in found}
    simulated = os.path.join(VM, "gpio-sim.ko")  # of fetch_gpio_sim
    if os.path.exists(simulated):
        paths["board_gpio"] = simulated
    return paths


def needed(path):
    with open(path, "rb") as file:
        match = re.search(rb"\0depends=([^\0]*)\0", file.read())
    return [name.replace("-", "_") for name in match.group(1).decode().split(",") if name]


def with_needed(names, paths):
    """Each after what it needs. What is not a module is in the kernel."""
    order = []

    def take(name):
        if name in order or name not in paths:
            return
        for other in needed(paths[name]):
            take(other)
        order.append(name)

    for name in names:
        take(name.replace("-", "_"))
    return order


def add_modules(archive):
    """As modprobe looks for them."""
    paths = modules_by_name()
    folder = "lib/modules/" + os.path.basename(glob.glob(os.path.join(VM, "kernel/lib/modules/*"))[0])
    lines = []
    for name in with_needed(MODULES + MORE_MODULES, paths):
        archive.add_file(f"{folder}/{name}.ko", paths[name])
        needs = reversed(with_needed([name], paths)[:-1])
        lines.append(f"{name}.ko:" + "".join(f" {other}.ko" for other in needs) + "\n")
    archive.add(f"{folder}/modules.dep", stat.S_IFREG | 0o644, "".join(lines).encode())
    archive.add("etc/modules", stat.S_IFREG | 0o644, "\n".join(MODULES).encode() + b"\n")


def library(name):
    for folder in ("lib/aarch64-linux-gnu", "usr/lib/aarch64-linux-gnu"):
        path = os.path.join(VM, "root", folder, name)
        if os.path.exists(path):
            return os.path.realpath(path)
    raise FileNotFoundError(name)


def make(target):
    archive = Cpio()
    archive.folders |= {"dev", "proc", "sys"}
    for folder in ("dev", "proc", "sys"):
        archive.add(folder, stat.S_IFDIR | 0o755)
    archive.add("dev/console", stat.S_IFCHR | 0o600, device=(5, 1))
    archive.add_file("init", os.path.join(HERE, "init"))
    for program in PROGRAMS:
        archive.add_file(("usr/bin/", "bin/")[program.endswith("busybox")] + os.path.basename(program), os.path.join(VM, "root", program))
    archive.add_file("lib/ld-linux-aarch64.so.1", library("ld-linux-aarch64.so.1"))
    for name in LIBRARIES.split():
        archive.add_file("lib/" + name, library(name))
    add_modules(archive)
    with open(target + ".new", "wb") as file:
        file.write(gzip.compress(archive.end(), compresslevel=1))
    os.replace(target + ".new", target)
