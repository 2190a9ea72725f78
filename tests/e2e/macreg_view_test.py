#!/usr/bin/env python3
"""macreg record, plot and monitor on virtual motors.

usage: macreg_view_test.py MACREG MACSIM
"""

import csv
import json
import os
import pty
import signal
import socket
import struct
import subprocess
import sys
import unittest

from xml.etree import ElementTree

from program_case import ProgramCase

MACREG = MACSIM = ""
LONG = 60  # timeout in seconds of what must come

READ = "50 50 50 08 F7 0A F5 AA AA"
READ_REPLY = "52 52 52 00 FF 0A F5 04 FB 34 CB 12 ED 00 FF 00 FF AA AA"


class Case(ProgramCase):
    def motor(self, speed=10):
        self.launch(MACSIM, "--model", "MAC140", "--address", "8", "--speed", str(speed), "--fastmac", "pty:" + self.path("f"),
                    "--mactalk", "pty:" + self.path("m"))

    def call(self, *arguments, **options):
        return subprocess.run([MACREG, "--port", self.path("m"), "--patience", "500", *arguments],
                              capture_output=True, text=True, timeout=4 * LONG, check=False, **options)

    def good(self, *arguments, **options):
        result = self.call(*arguments, **options)
        self.assertEqual(result.returncode, 0, f"{arguments}: {result.stderr}")
        return result.stdout

    def refused(self, code, words, *arguments, **options):
        result = self.call(*arguments, **options)
        self.assertEqual(result.returncode, code, f"{arguments}: {result.stderr}")
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertIn(words, result.stderr)

    def rows(self, name):
        with open(self.path(name), newline="", encoding="ascii") as file:
            return list(csv.DictReader(line for line in file if not line.startswith("#")))


class Recordings(Case):
    def test_a_move_recorded_and_drawn(self):
        self.motor()
        self.good("set", "V_SOLL", "300rpm", "A_SOLL", "20000rpm/s", "MODE_REG", "P_MODE")
        document = json.loads(self.good("--json", "record", "P_IST,V_IST", "--samples", "300", "--move", "P_SOLL=+2048",
                                        "--yes", "-o", self.path("move.csv")))
        self.assertEqual((document["ok"], document["samples"]), (True, 300))
        rows = self.rows("move.csv")
        self.assertEqual(list(rows[0]), ["time_s", "P_IST [counts]", "V_IST [rpm]"])
        self.assertLess(abs(float(rows[0]["P_IST [counts]"])), 50)
        self.assertLess(abs(float(rows[-1]["P_IST [counts]"]) - 2048), 20)
        # 300 rpm and an overshoot; 300 samples of the position loop are 0.574 s.
        self.assertGreater(max(float(row["V_IST [rpm]"]) for row in rows), 200)
        self.assertAlmostEqual(float(rows[-1]["time_s"]), 299 * 15 / 7812.5, places=5)
        self.good("plot", self.path("move.csv"), "-o", self.path("move.svg"))
        words = "".join(ElementTree.parse(self.path("move.svg")).getroot().itertext())
        for name in ("P_IST", "[counts]", "V_IST", "[rpm]", "time [ms]", "MAC50-141"):
            self.assertIn(name, words)
        self.good("plot", self.path("move.csv"), "-o", self.path("move.png"), "--width", "640", "--columns", "V_IST")
        with open(self.path("move.png"), "rb") as file:
            picture = file.read()
        self.assertEqual(picture[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack(">I", picture[16:20])[0], 640)

    def test_fast_conditions_and_polling(self):
        self.motor()
        self.good("record", "VF_OUT", "--rate", "fast", "--samples", "20", "-o", self.path("fast.csv"))
        self.assertAlmostEqual(float(self.rows("fast.csv")[-1]["time_s"]), 19 / 7812.5, places=6)
        text = self.good("record", "P_IST,P_SOLL,V_IST,ERR_STAT", "--poll", "--samples", "5", "--when", "MODE_REG=INIT_MODE")
        self.assertIn("# start when MODE_REG == INIT_MODE\n", text)
        self.assertEqual(sum(not line.startswith("#") for line in text.splitlines()), 6)

    def test_what_cannot_be_recorded_is_said(self):
        self.motor()
        target = self.path("none.csv")
        for code, words, arguments in (
                (2, "name fewer, or use --poll", ["P_IST,P_SOLL,V_IST"]),
                (2, "has no register 'P_ISR', did you mean P_IST?", ["P_ISR"]),
                (2, "is no condition", ["P_IST", "--when", "V_IST"]),
                (1, "did not come true within 0.2 s", ["P_IST", "--when", "V_IST>100", "--within", "0.2"]),
                (2, "write slow", ["P_IST", "--rate", "medium"]),
                (2, "say --yes", ["P_IST", "--move", "P_SOLL=+1"])):
            self.refused(code, words, "record", *arguments, "-o", target, stdin=subprocess.DEVNULL)
            self.assertFalse(os.path.exists(target))

    def test_an_interrupted_recording_leaves_no_file_and_the_motor_as_it_was(self):
        self.motor()
        before = self.good("get", "SAMPLE1", "SAMPLE2", "SAMPLE3", "CNTRL_BITS")
        ours, its = pty.openpty()
        process = subprocess.Popen([MACREG, "--port", self.path("m"), "record", "P_IST,V_IST", "--when", "V_IST>1000",
                                    "-o", self.path("a.csv")], stderr=its)
        self.running.append(process)
        shown = b""
        while b"waiting" not in shown:
            shown += os.read(ours, 1000)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(LONG), 130)
        os.close(its)
        os.close(ours)
        self.assertFalse(os.path.exists(self.path("a.csv")))
        self.assertEqual(self.good("get", "SAMPLE1", "SAMPLE2", "SAMPLE3", "CNTRL_BITS"), before)

    def test_a_recording_that_breaks_off_is_kept_as_far_as_it_was_read(self):
        self.motor(speed=1)  # reads for 20 s
        ours, its = pty.openpty()
        process = subprocess.Popen([MACREG, "--port", self.path("m"), "record", "P_IST,V_IST", "-o", self.path("a.csv")],
                                   stderr=its)
        self.running.append(process)
        shown = b""
        while b"Kread 5 of 895" not in shown:
            shown += os.read(ours, 1000)
        process.send_signal(signal.SIGINT)
        while b"a.csv.part, marked as incomplete" not in shown:
            shown += os.read(ours, 1000)
        self.assertEqual(process.wait(LONG), 130)
        os.close(its)
        os.close(ours)
        self.assertFalse(os.path.exists(self.path("a.csv")))
        self.assertGreaterEqual(len(self.rows("a.csv.part")), 5)
        with open(self.path("a.csv.part"), encoding="ascii") as file:
            self.assertIn("# incomplete: ", file.read())
        self.good("plot", self.path("a.csv.part"), "-o", self.path("a.svg"))

    def test_damaged_recordings_are_refused_with_their_line(self):
        with open(self.path("bad.csv"), "w", encoding="ascii") as file:
            file.write("time_s,A\n0,1\n1,x\n")
        self.refused(2, "bad.csv:3: 'x' in column 2 is no number", "plot", self.path("bad.csv"), "-o", self.path("a.svg"))
        self.refused(2, "must end with .svg or .png", "plot", self.path("bad.csv"), "-o", self.path("a.gif"))
        self.refused(2, "none.csv", "plot", self.path("none.csv"), "-o", self.path("a.svg"))
        self.assertFalse(os.path.exists(self.path("a.svg")))


class Monitors(Case):
    def test_replays_bytes(self):
        text = self.good("monitor", "--replay", "-", input=f"{READ} # a remark\n{READ_REPLY.replace(' ', '')}\n")
        self.assertEqual(text, "0.000 s  -> motor 8: read P_IST (10)   <- 00001234 = 4660 counts\n")
        text = self.good("monitor", "--replay", "-", "--protocol", "fastmac", input="E1 61 FF 63 63 63 E8 17 03 FC")
        self.assertIn("FlexMAC: write V_SOLL (5) := 03E8", text)
        # As the manuals write it.
        text = self.good("monitor", "--replay", "-", input="50h,50h,50h - 08h,F7h - 0Ah,F5h - AAh,AAh\n50h,50h")
        self.assertIn("-> motor 8: read P_IST (10)   <- no answer", text)
        self.assertIn("cut off after 2 bytes: 50 50", text)
        document = json.loads(self.good("--json", "monitor", "--replay", "-", input=READ))
        self.assertEqual((document["register"], document["answer"]), (10, "no answer"))
        # A byte that no message has, while the request waits for its answer.
        text = self.good("monitor", "--replay", "-", input=f"{READ} 42 42 {READ} {READ_REPLY}")
        times = [float(line.split()[0]) for line in text.splitlines()]
        self.assertEqual((len(times), times), (3, sorted(times)), text)
        self.refused(2, "standard input:2: '5G' is no byte", "monitor", "--replay", "-", input="50\n5G\n")

    def test_listens_until_it_is_ended(self):
        listener = socket.socket(socket.AF_UNIX)
        listener.bind(self.path("line"))
        listener.listen(1)
        process = subprocess.Popen([MACREG, "--port", "unix:" + self.path("line"), "monitor"], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        self.running.append(process)
        line, _ = listener.accept()
        line.sendall(bytes.fromhex("42" + READ + READ_REPLY))
        self.assertIn("!! noise: 42", process.stdout.readline())
        self.assertIn("-> motor 8: read P_IST (10)   <- 00001234 = 4660 counts", process.stdout.readline())
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(LONG), 0)
        self.assertEqual(process.stderr.read(), "")
        process = subprocess.Popen([MACREG, "--port", "unix:" + self.path("line"), "monitor"], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        self.running.append(process)
        listener.accept()[0].detach()
        process.send_signal(signal.SIGINT)
        self.assertIn("nothing was heard", process.communicate(timeout=LONG)[1])
        line.close()
        listener.close()


if __name__ == "__main__":
    MACREG, MACSIM = sys.argv[1:3]
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
