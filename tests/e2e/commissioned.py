"""A store of nanoplc in which the first run has been commanded (firmware/boards/linux/README.md)."""

import os
import zlib

FIRST_RUN, GIVEN = 1, 2


def commission(state, axis, permission=GIVEN):
    """Unless the axis has a folder in `state` already."""
    folder = os.path.join(state, axis)
    if os.path.exists(folder):
        return
    os.makedirs(folder)
    record = b"NPO1" + bytes([permission, len(axis)]) + axis.encode()
    record += zlib.crc32(record).to_bytes(4, "little")
    with open(os.path.join(folder, "store.bin"), "wb") as file:
        file.write(b"\xFF" * 14 * 2048 + record.ljust(2 * 2048, b"\xFF"))
    checked = b"ended/2 " + 36 * b"-" + b" "
    with open(os.path.join(folder, "running"), "wb") as file:
        file.write(checked + f"{zlib.crc32(checked):08x}\n".encode())
