#!/usr/bin/env python3
"""Certificates from seqc verify through nanoctl to the simulated gateway.

usage: proof_test.py SEQC NANOCTL NANOPLC_SIM MACREG
"""

import hashlib
import json
import os
import subprocess
import sys
import unittest

import nanoctl_test
from noisy_proxy import NoisyProxy

SEQC = NANOCTL = SIM = MACREG = ""

# Step 0: IN0 -> step 1, outputs 1. Step 1: always, stays (001 6.1.5, 6.1.7).
TABLE = bytes.fromhex("C001010180010000 C100003E80010000 3F00000000000000")
OTHER = bytes.fromhex("C001010180030000 C100003E80030000 3F00000000000000")
PROPERTIES = """PROPERTY On: NEVER step = 1 AND NOT OUT0;
PROPERTY There: step = 1 IS REACHABLE;
"""

SET_POINT = b"""PROGRAM P
MOTOR MAC140;
SET_POINT Dwell := 200 ms RANGE 100 .. 500 ms;
ON ERROR NEXT := Fault;
STEP Idle: IF IN0 THEN TIMER := Dwell; NEXT := Lit; END_IF END_STEP
STEP Lit: OUT OUT0; IF TIMER.Q THEN NEXT := Idle; END_IF END_STEP
STEP Fault: OWN ERROR; IF ANY ERROR AND IN1 THEN RESET_ERROR; NEXT := Idle; END_IF END_STEP
PROPERTY Short: NEVER step = Lit WHILE step = Lit FOR 300 ms;
END_PROGRAM
"""

MOVES = """PROGRAM P
MOTOR MAC140;
{declared}
VAR_MOTOR Home AT P1 := 0 counts; Away AT P2 := 4096 counts; END_VAR
ON ERROR NEXT := Fault;
POWER_UP INIT(Speed); NEXT := S; END_POWER_UP
STEP S: IF IN0 THEN POSITION(Away); NEXT := T; END_IF END_STEP
STEP T: IF INPOS THEN POSITION(Home); NEXT := U; END_IF END_STEP
STEP U: IF INPOS AND NOT IN0 THEN NEXT := S; END_IF END_STEP
STEP Fault: OWN ERROR; IF ANY ERROR AND IN1 THEN RESET_ERROR; INIT(Speed); NEXT := S; END_IF END_STEP
END_PROGRAM
"""


class Certificates(nanoctl_test.Case):
    def setUp(self):
        nanoctl_test.ProgramCase.setUp(self)
        self.endpoint = "unix:" + self.path("port")
        self.table, self.other = self.written("t.bin", TABLE), self.written("other.bin", OTHER)
        self.written("p.prop", PROPERTIES.encode())
        self.proof = self.path("t.proof")

    def written(self, name, content):
        with open(self.path(name), "wb") as file:
            file.write(content)
        return self.path(name)

    def prove(self, table=None, proof=None, properties="p.prop", exit_code=0):
        done = subprocess.run([SEQC, "verify", table or self.table, "--property", self.path(properties), "--proof",
                               proof or self.proof], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, exit_code, done.stdout + done.stderr)
        return done

    def content(self):
        with open(self.proof, "rb") as file:
            return file.read()

    def test_it_names_the_table_what_was_proved_and_what_was_assumed(self):
        self.prove()
        proof = json.loads(self.content())
        self.assertEqual(proof["format"], "nanoplc-proof-2")
        self.assertEqual(proof["table"]["sha256"], hashlib.sha256(TABLE).hexdigest())
        self.assertEqual((proof["table"]["file"], proof["table"]["bytes"]), ("t.bin", 24))
        self.assertEqual(proof["assume"], "driver")
        self.assertTrue(proof["assumptions"][0])
        self.assertTrue(proof["version"].startswith("seqc "))
        named = [(r["name"], r["verdict"]) for r in proof["results"] if "code" not in r]
        self.assertEqual(named, [("On", "proved"), ("There", "proved")])

    def test_it_says_for_which_values_of_set_points_it_holds(self):
        program = self.written("p.seq", SET_POINT)
        verify = [SEQC, "verify", program, "--proof", self.proof]
        broken = subprocess.run(verify, capture_output=True, text=True, check=False)  # 500 ms is in the range
        self.assertEqual((broken.returncode, os.path.exists(self.proof)), (1, False), broken.stdout)
        subprocess.run([*verify, "--set-points", "default"], capture_output=True, check=True)
        self.assertIn("set-points have their defaults", json.loads(self.content())["assumptions"][0])
        self.written("p.seq", SET_POINT.replace(b"500 ms", b"250 ms"))
        subprocess.run(verify, capture_output=True, check=True)
        self.assertIn("set-points have any value of their ranges", json.loads(self.content())["assumptions"][0])

    def verdicts(self, program, *options):
        """The exit code, and the codes of checks by their verdict."""
        path = self.written("p.seq", program.encode())
        done = subprocess.run([SEQC, "verify", path, "--json", *options], capture_output=True, text=True, check=False)
        found = {}
        for result in json.loads(done.stdout)["results"]:
            found.setdefault(result["verdict"], set()).add(result.get("code", result["name"]))
        return done.returncode, found

    def test_a_velocity_that_is_0_or_may_be_moves_nothing(self):
        stands = {"V010", "V011"}  # INPOS that never comes, a move without velocity
        for declared, broken in (
            ("VAR_MOTOR Speed AT V1 := 0 rpm; END_VAR", stands),
            ("VAR_MOTOR Speed AT V1 := 500 rpm; END_VAR", set()),
            ("SET_POINT Speed AT V1 := 500 rpm RANGE 0 .. 1000 rpm;", stands),
            ("SET_POINT Speed AT V1 := 500 rpm RANGE 10 .. 1000 rpm;", set()),
        ):
            code, found = self.verdicts(MOVES.format(declared=declared))
            self.assertEqual((code, found.get("broken", set()) & stands), (1 if broken else 0, broken), declared)
        code, found = self.verdicts(MOVES.format(declared="SET_POINT Speed AT V1 := 500 rpm RANGE 0 .. 1000 rpm;"), "--set-points", "default")
        self.assertEqual((code, found.get("broken", set()) & stands), (0, set()))

    def test_a_range_that_is_not_explored_whole_proves_nothing(self):
        program = """PROGRAM P
MOTOR MAC140;
SET_POINT Parts := 3 RANGE 1 .. 65535;
ON ERROR NEXT := Fault;
STEP S: IF IN0 THEN COUNTER := Parts; NEXT := Go; END_IF END_STEP
STEP Go: IF COUNTER.Q THEN NEXT := S; ELSIF NOT IN0 THEN COUNT_DOWN; NEXT := Wait; END_IF END_STEP
STEP Wait: IF IN0 THEN NEXT := Go; END_IF END_STEP
STEP Fault: OWN ERROR; IF ANY ERROR AND IN1 THEN RESET_ERROR; NEXT := S; END_IF END_STEP
PROPERTY Dark: NEVER OUT0;
END_PROGRAM
"""
        code, found = self.verdicts(program)
        self.assertEqual((code, set(found)), (4, {"undecided"}))
        self.assertIn("Dark", found["undecided"])
        self.assertEqual(self.verdicts(program, "--set-points", "default")[0], 0)
        self.assertEqual(self.verdicts(program.replace("65535", "40"))[0], 0)

    def test_it_is_written_only_if_all_is_proved(self):
        self.written("bad.prop", b"PROPERTY No: NEVER step = 1;")
        self.assertIn("not all is proved", self.prove(properties="bad.prop", exit_code=1).stderr)
        self.assertFalse(os.path.exists(self.proof))
        self.prove(proof=self.table, exit_code=2)
        with open(self.table, "rb") as file:
            self.assertEqual(file.read(), TABLE)

    def test_its_digest_goes_with_the_table_and_an_upload_without_clears_it(self):
        self.prove()
        digest = hashlib.sha256(self.content()).hexdigest()
        self.start()
        self.assertEqual(self.ctl("upload", self.table, "--proof", self.proof)["proof"], digest)
        status = self.ctl("status")
        self.assertEqual((status["proof"], status["stored_differs"]), (digest, False))
        self.assertIn(digest, self.call("status").stdout)
        self.ctl("verify", self.table, "--bytes")
        self.ctl("verify", self.table, "--proof", self.proof)
        self.ctl("download", "-o", self.path("back.bin"))
        with open(self.path("back.bin"), "rb") as file:
            self.assertEqual(file.read(), TABLE)
        self.ctl("upload", self.table)
        self.assertEqual(self.ctl("status")["proof"], "")
        self.assertIn("has not this certificate", self.ctl("verify", self.table, "--proof", self.proof, exit_code=1)["error"])

    def test_a_gateway_that_requires_one_starts_nothing_else(self):
        self.prove()
        self.start()
        self.ctl("settings", "set", "require_proof=1", "--keep")
        refused = self.ctl("upload", self.table, "--run", exit_code=1)
        self.assertIn("require_proof", refused["error"])
        self.assertEqual(self.ctl("status")["safe_reason"], "no certificate")
        why = subprocess.run([MACREG, "--port", self.endpoint, "why"], capture_output=True, text=True, check=False)
        self.assertIn("no certificate", why.stdout)
        self.ctl("upload", self.table, "--proof", self.proof, "--run")
        self.until(lambda status: status["state"] == "running")

    def test_what_is_damaged_or_of_another_table_is_not_uploaded(self):
        self.prove()
        whole = self.content()
        self.start()
        self.assertIn("of another table", self.refused(self.other, self.proof))
        for length in (0, 1, len(whole) // 2, len(whole) - 3):
            self.refused(self.table, self.written("cut.proof", whole[:length]))
        for at in range(0, len(whole), 37):
            flipped = bytearray(whole)
            flipped[at] ^= 0x04
            self.refused(self.table, self.written("flipped.proof", flipped))
        self.refused(self.table, self.written("deep.proof", b"[" * 200_000))
        self.refused(self.table, self.table)
        self.refused(self.table, self.path("missing.proof"))
        unproved = json.loads(whole)
        unproved["results"][0]["verdict"] = "broken"
        self.refused(self.table, self.written("broken.proof", json.dumps(unproved).encode()))
        self.assertEqual(self.ctl("status")["stored_bytes"], 0)

    def test_only_the_bytes_that_seqc_writes_are_taken(self):
        self.prove()
        whole = self.content()
        self.start()
        twice = whole.replace(b'"assume":', b'"assume": "any",\n  "assume":', 1)
        for other in (whole + b"\0", whole + b" ", whole.replace(b"\n", b"\r\n"), json.dumps(json.loads(whole)).encode(), twice):
            self.assertIn("was changed", self.refused(self.table, self.written("other.proof", other)))
        older = whole.replace(b"nanoplc-proof-2", b"nanoplc-proof-1")
        self.assertIn("older seqc verify", self.refused(self.table, self.written("older.proof", older)))
        newer = whole.replace(b"nanoplc-proof-2", b"nanoplc-proof-9")
        self.assertIn("does not know", self.refused(self.table, self.written("newer.proof", newer)))

    def test_a_proof_of_nothing_says_so(self):
        self.written("p.prop", b"PROPERTY Nothing: WHENEVER OUT1 THEN IN0;\nPROPERTY On: NEVER step = 1 AND NOT OUT0;\n")
        self.prove()
        results = json.loads(self.content())["results"]
        self.assertEqual([r["name"] for r in results if r.get("vacuous")], ["Nothing"])

    def refused(self, table, proof):
        error = self.ctl("upload", table, "--proof", proof, exit_code=2)["error"]
        self.assertNotIn("\n", error)
        return error

    def test_a_gateway_of_older_firmware_gets_no_certificate(self):
        self.prove()
        self.start()
        proxy = NoisyProxy(self.path("old"), self.path("port"), 0, 1, change=OlderFirmware())
        error = self.ctl("upload", self.table, "--proof", self.proof, port="unix:" + self.path("old"), exit_code=1)["error"]
        proxy.close()
        self.assertIn("too old", error)
        self.assertEqual(self.ctl("status")["stored_bytes"], 0)


class OlderFirmware:
    """Zeros in the answer to a block read from register 62 on (001 5.1)."""

    HEAD = bytes.fromhex("525252 00FF 3EC1 40BF")

    def __init__(self):
        self.seen = b""
        self.left = 0

    def __call__(self, data):
        sent = bytearray()
        for byte in data:
            self.seen = (self.seen + bytes([byte]))[-len(self.HEAD):]
            sent.append(byte if self.left == 0 else 0xFF if self.left % 2 else 0x00)
            self.left = 128 if self.left == 0 and self.seen == self.HEAD else max(0, self.left - 1)
        return sent


if __name__ == "__main__":
    SEQC, NANOCTL, SIM, MACREG = sys.argv[1:5]
    nanoctl_test.NANOCTL, nanoctl_test.SIM, nanoctl_test.SEQC = NANOCTL, SIM, SEQC
    unittest.main(argv=sys.argv[:1] + sys.argv[5:])
