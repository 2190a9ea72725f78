#!/usr/bin/env python3
"""OpenSSL signs random messages with random keys; signature_judge reports which signatures are good.

usage: openssl_test.py SIGNATURE_JUDGE [SEED]
"""

import os
import random
import subprocess
import sys
import tempfile

KEYS, MESSAGES, LONGEST = 5, 8, 300


def openssl(*arguments):
    return subprocess.run(["openssl", *arguments], check=True, capture_output=True).stdout


def damaged(data, seeded):
    bit = seeded.randrange(8 * len(data))
    changed = bytearray(data)
    changed[bit // 8] ^= 1 << bit % 8
    return bytes(changed)


def cases(folder, seeded):
    """Key, signature, message, and whether it is good."""
    path = os.path.join(folder, "message")
    key = os.path.join(folder, "key.pem")
    for _ in range(KEYS):
        openssl("genpkey", "-algorithm", "ed25519", "-out", key)
        public = openssl("pkey", "-in", key, "-pubout", "-outform", "DER")[-32:]
        for _ in range(MESSAGES):
            message = seeded.randbytes(seeded.randrange(1, LONGEST))
            with open(path, "wb") as file:
                file.write(message)
            signature = openssl("pkeyutl", "-sign", "-rawin", "-inkey", key, "-in", path)
            yield public, signature, message, True
            yield public, damaged(signature, seeded), message, False
            yield public, signature, damaged(message, seeded), False
            yield damaged(public, seeded), signature, message, False


def main():
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else 20261126
    print("seed", seed)
    with tempfile.TemporaryDirectory() as folder:
        all_cases = list(cases(folder, random.Random(seed)))
    text = "".join(f"{key.hex()} {signature.hex()} {message.hex()}\n" for key, signature, message, _ in all_cases)
    told = subprocess.run([sys.argv[1]], input=text, check=True, capture_output=True, text=True).stdout.split()
    wrong = [case for case, answer in zip(all_cases, told, strict=True) if (answer == "yes") != case[3]]
    for key, signature, message, good in wrong[:3]:
        print(f"key {key.hex()} signature {signature.hex()} message {message.hex()}: it is {'good' if good else 'forged'}")
    print(len(all_cases), "signatures,", len(wrong), "judged wrongly")
    sys.exit(1 if wrong or not all_cases else 0)


if __name__ == "__main__":
    main()
