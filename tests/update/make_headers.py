#!/usr/bin/env python3
"""Writes signed_headers.h: headers of the tests' images, signed by tools/sign_firmware with keys made for it and thrown away.

usage: make_headers.py SIGN_FIRMWARE > signed_headers.h
"""

import os
import subprocess
import sys
import tempfile

SLOTS, BOARD, BYTES, HEADER = (0x3000, 0x4000), 1, 300, 160


def image_of(version, slot):
    """As bench.h has it."""
    return bytes((i * 3 + version * 7 + slot) & 0xFF for i in range(BYTES))


def rows(data):
    texts = [f"0x{byte:02X}" for byte in data]
    return ",\n     ".join(", ".join(texts[i : i + 16]) for i in range(0, len(texts), 16))


def main():
    sign = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        path = lambda name: os.path.join(folder, name)
        for key in ("own.pem", "other.pem"):
            subprocess.run(["openssl", "genpkey", "-algorithm", "ed25519", "-out", path(key)], check=True)
        der = subprocess.run(["openssl", "pkey", "-in", path("own.pem"), "-pubout", "-outform", "DER"], check=True, capture_output=True).stdout

        def header(version, slot, key="own.pem", board=BOARD):
            with open(path("image"), "wb") as file:
                file.write(image_of(version, slot))
            subprocess.run([sign, "sign", "--key", path(key), "--board", str(board), "--version", f"0.0.{version}",
                            f"{SLOTS[slot]:#x}={path('image')}", "-o", path("signed")], check=True)
            with open(path("signed"), "rb") as file:
                return rows(file.read(HEADER))

        print("// Written by make_headers.py.\n#pragma once\n\n#include \"update/image.h\"\n\nnamespace nplc::update {\n")
        print("using HeaderBytes = std::array<std::uint8_t, kHeaderBytes>;\n")
        print(f"inline constexpr signature::PublicKey kKey{{{{\n     {rows(der[-32:])}}}}};\n")
        print("/// Of versions 0.0.1 to 0.0.4, for slots 0 and 1.\ninline constexpr std::array<std::array<HeaderBytes, 2>, 4> kHeaders{{")
        for version in range(1, 5):
            print("    {{{{" + "}},\n     {{".join(header(version, slot) for slot in (0, 1)) + "}}}},")
        print("}};\n")
        for name, text in (("kForged", header(2, 1, key="other.pem")), ("kOtherBoards", header(2, 1, board=2))):
            print(f"/// Version 0.0.2, for slot 1.\ninline constexpr HeaderBytes {name}{{{{\n     {text}}}}};\n")
        print("}  // namespace nplc::update")


if __name__ == "__main__":
    main()
