#!/usr/bin/env python3
"""macreg ui on virtual motors, driven in a terminal of tmux.

usage: macreg_ui_test.py MACREG MACSIM
"""

import os
import shlex
import signal
import subprocess
import sys
import time
import unittest

from program_case import ProgramCase

MACREG = MACSIM = ""
LONG = 240  # timeout in seconds of what must come
RECORDING = 2_000  # milliseconds of patience where a gateway is asked for


class Case(ProgramCase):
    def setUp(self):
        super().setUp()
        self.servers = 0
        self.start_motor()

    def tearDown(self):
        self.tmux("kill-server", check=False)
        super().tearDown()

    def start_motor(self, speed=10):
        self.launch(MACSIM, "--model", "MAC140", "--address", "8", "--speed", str(speed), "--fastmac", "pty:" + self.path("f"),
                    "--mactalk", "pty:" + self.path("m"))

    def stop_motor(self):
        motor = self.running[-1]
        motor.send_signal(signal.SIGTERM)
        motor.wait(LONG)

    def tmux(self, *arguments, check=True):
        result = subprocess.run(["tmux", "-S", self.path(f"tmux{self.servers}"), "-f", "/dev/null", *arguments], capture_output=True,
                                text=True, check=check, env={**os.environ, "LC_ALL": "C.UTF-8"})
        return result.stdout

    def start(self, columns=80, rows=24, locale="C.UTF-8", term="screen-256color", keys=None, patience=20_000):
        """The screen within a shell that prints the exit status and the terminal's settings. A connected motor answers at
        some time; how long a slow machine takes is not what is tested. A recording first asks whether a gateway is there, and
        none answers: that takes twice `patience`."""
        script = (f"stty -g > {self.path('before')}; LC_ALL={locale} TERM={term} {MACREG} --port {self.path('m')} "
                  f"--patience {patience} ui; echo ended with $?; stty -g > {self.path('after')}; echo all done; sleep 600")
        self.tmux("new-session", "-d", "-x", str(columns), "-y", str(rows), "sh -c " + shlex.quote(script))
        if keys is not None:
            self.keys(keys)
            return
        self.until("INIT_MODE, no error")

    def screen(self):
        return self.tmux("capture-pane", "-p")

    def until(self, *words, gone=(), holds=lambda screen: True):
        """What is asked of the screen is asked of the same one: the next may be half drawn."""
        end = time.monotonic() + LONG
        while time.monotonic() < end:
            screen = self.screen()
            if all(word in screen for word in words) and not any(word in screen for word in gone) and holds(screen):
                return
            time.sleep(0.05)
        self.fail(f"never came: {words}, without {gone}; the screen is\n{screen}")

    def keys(self, *keys):
        self.tmux("send-keys", *keys)

    def type(self, text):
        self.tmux("send-keys", "-l", text)

    def select(self, name):
        self.keys("/")
        self.type(name)
        self.until("search: " + name)
        self.keys("Enter")
        self.until("/ search", gone=("search: ",))

    def pid(self):
        shell = self.tmux("list-panes", "-F", "#{pane_pid}").strip()
        return int(subprocess.run(["pgrep", "-P", shell, "macreg"], capture_output=True, text=True, check=True).stdout)

    def assert_ended(self, code):
        self.until(f"ended with {code}", "all done")
        with open(self.path("before"), encoding="ascii") as before, open(self.path("after"), encoding="ascii") as after:
            self.assertEqual(before.read(), after.read())
        self.assertEqual(self.tmux("display-message", "-p", "#{alternate_on} #{cursor_flag}").strip(), "0 1")


class Screen(Case):
    def test_reads_searches_and_quits(self):
        self.start()
        self.until("[Parameters]", "PROG_VERSION", "Transmit and receive", "> 5", "< 52 52 52", "? help",
                   holds=lambda screen: max(len(line) for line in screen.splitlines()) == 80)
        self.select("V_SO")
        self.keys("r")
        self.until("V_SOLL = ", "rpm")
        self.keys("q")
        self.assert_ended(0)

    def test_writes_and_asks_before_danger(self):
        self.start()
        self.select("V_SOLL")
        self.keys("w")
        self.until("V_SOLL (")
        self.type("100 bananas")
        self.keys("Enter")
        self.until("takes rpm")
        for _ in range(len("bananas")):
            self.keys("BSpace")
        self.type("rpm")
        self.keys("Enter")
        # 001 §3.2.5: 100 rpm are 209.7 steps; 210 are 100.14 rpm.
        self.until("written; V_SOLL now reads 100.1")
        self.select("AMPLITUDE")
        self.keys("w")
        self.until("AMPLITUDE (")
        self.type("0.5")
        self.keys("Enter")
        self.until("type yes")
        self.keys("n", "Enter")
        self.until("not confirmed, nothing was written")
        self.keys("q")
        self.assert_ended(0)

    def test_keys_before_the_first_reading_act(self):
        self.start(keys="?")
        self.until("Any key goes back")
        self.keys("x")
        self.until("INIT_MODE, no error", "[Parameters]")
        self.keys("q")
        self.assert_ended(0)

    def test_a_refusal_is_shown_with_its_remedy(self):
        self.start()
        self.select("MODE_REG")
        self.keys("w")
        self.until("MODE_REG (")
        self.type("256")
        self.keys("Enter")
        self.until("MODE_REG: 256 to 258 rewrite flash", "ask first")
        self.keys("Escape")
        self.until("/ search")
        self.keys("q")
        self.assert_ended(0)

    def test_bits_have_names_and_can_be_written(self):
        self.start()
        self.select("CNTRL_BITS")
        self.until("USERINTF", "COMMUNICATION", "RECORDBIT")
        self.keys("Tab")
        self.until("[CNTRL_BITS")
        for _ in range(8):
            self.keys("Down")
        # AUTO_RESYNC's meaning, and its value: an unread bit cannot be written.
        self.until("INIT_MODE P_FNC follows P_IST", "AUTO_RESYNC   0")
        self.keys("w")
        self.until("CNTRL_BITS.AUTO_RESYNC :=")
        self.keys("1", "Enter")
        self.until("written; CNTRL_BITS now reads")
        self.until("AUTO_RESYNC   1")
        self.keys("q")
        self.assert_ended(0)

    def test_records_and_shows_a_curve(self):
        self.start(patience=RECORDING)
        self.keys("s")
        self.until("slow or fast): P_IST,V_IST slow")
        self.keys("Enter")
        self.until("Samples: P_IST [counts] 1 of 2", "895 samples in 1.716 s",
                   holds=lambda screen: any("\u2800" <= c <= "\u28ff" for c in screen))
        self.keys("Right")
        self.until("Samples: V_IST [rpm] 2 of 2")
        self.keys("s")
        self.until("slow or fast): ")
        self.type(",P_SOLL")
        self.keys("Enter")
        self.until("need 5")
        self.keys("q")
        self.assert_ended(0)

    def test_saves_resets_and_goes_into_safe_mode_and_out(self):
        self.start()
        self.select("GEARF2")
        self.keys("w")
        self.until("GEARF2 (")
        self.keys("7", "Enter")
        self.until("GEARF2 now reads 7")
        for key, question, answer, then in (("X", "unsaved values are lost; starts in INIT_MODE", "no", "nothing was done"),
                                            ("F", "save all memory to flash; resets", "yes", "done; the motor is in INIT_MODE"),
                                            ("P", "SAFE_MODE: passive, deaf to FastMAC", "yes", "the motor is in SAFE_MODE"),
                                            ("P", "leave SAFE_MODE", "yes", "done; the motor is in INIT_MODE"),
                                            ("X", "unsaved values are lost", "yes", "done; the motor is in INIT_MODE")):
            self.keys(key)
            self.until(question, "type yes:")
            self.type(answer)
            self.keys("Enter")
            self.until(then)
        self.select("GEARF2")
        self.keys("r")
        self.until("GEARF2 = 7")  # saved before the reset
        self.keys("q")
        self.assert_ended(0)

    def test_samples_as_numbers(self):
        self.start(patience=RECORDING)
        self.keys("s")
        self.until("slow or fast): P_IST,V_IST slow")
        self.keys("Enter")
        self.until("895 samples in 1.716 s")
        self.keys("v")
        # 001 §3.2.112: 520.83 Hz, 1.92 ms between two.
        self.until("P_IST", "V_IST", "0.0000            0            0", "0.0019            0            0")
        self.keys("Tab", "Tab", "End")
        self.until("1.7165")
        self.keys("q")
        self.assert_ended(0)

    def test_without_colours_and_braille(self):
        self.start(locale="C", term="vt100", patience=RECORDING)
        self.keys("s")
        self.until("slow or fast): P_IST,V_IST slow")
        self.keys("Enter")
        self.until("Samples: P_IST [counts] 1 of 2", "****")
        self.keys("?")
        self.until("Any key goes back")
        self.keys("x")
        self.until("[Parameters]")
        self.keys("q")
        self.assert_ended(0)

    def test_follows_the_size_of_the_window(self):
        self.start(columns=120, rows=40)
        self.tmux("resize-window", "-x", "80", "-y", "24")
        self.until("[Parameters]", "q quit")
        self.tmux("resize-window", "-x", "40", "-y", "10")
        self.until("40 by 10 is too small")
        self.tmux("resize-window", "-x", "100", "-y", "30")
        self.until("[Parameters]", "q quit")
        self.keys("q")
        self.assert_ended(0)


class Ends(Case):
    def test_a_motor_that_vanishes_is_shown_and_found_again(self):
        self.start()
        self.stop_motor()
        self.until("PORT GONE")
        self.start_motor()
        self.until("INIT_MODE, no error")
        self.select("P_IST")
        self.keys("r")
        self.until("P_IST = 0 counts")
        self.keys("q")
        self.assert_ended(0)

    def test_signals_give_the_terminal_back(self):
        for number in (signal.SIGTERM, signal.SIGHUP, signal.SIGINT, signal.SIGQUIT):
            self.start()
            os.kill(self.pid(), number)
            self.assert_ended(0)
            self.tmux("kill-server")
            self.servers += 1

    def test_a_crash_gives_the_terminal_back(self):
        self.start()
        os.kill(self.pid(), signal.SIGABRT)
        self.assert_ended(128 + signal.SIGABRT)

    def test_a_signal_in_a_recording_leaves_the_motor_as_it_was(self):
        self.stop_motor()
        self.start_motor(speed=1)  # reads for 20 s, so that the signal comes before the end
        self.start(patience=RECORDING)
        self.keys("s")
        self.until("slow or fast): ")
        self.keys("Enter")
        self.until("Esc gives it up")
        os.kill(self.pid(), signal.SIGTERM)
        self.assert_ended(0)
        result = subprocess.run([MACREG, "--port", self.path("m"), "get", "SAMPLE1", "SAMPLE2"], capture_output=True,
                                text=True, check=True)
        self.assertEqual(result.stdout.count("= 0"), 2, result.stdout)

    def test_without_a_terminal_it_says_so(self):
        result = subprocess.run([MACREG, "--port", self.path("m"), "ui"], stdin=subprocess.DEVNULL, capture_output=True,
                                text=True, check=False)
        self.assertEqual((result.returncode, result.stderr.count("\n")), (2, 1), result.stderr)
        self.assertIn("needs a terminal", result.stderr)


if __name__ == "__main__":
    MACREG, MACSIM = sys.argv[1:3]
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
