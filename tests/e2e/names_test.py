#!/usr/bin/env python3
"""Who serves at a name: every program that offers a terminal or a socket, twice on one name, killed and started again.

usage: names_test.py MACSIM MIDISIM NANOPLC_SIM [NANOPLC]
"""

import os
import signal
import subprocess
import sys
import unittest

import program_case
from patience import until

LONG = 60  # timeout in seconds of what must come
MACSIM = MIDISIM = NANOPLC_SIM = NANOPLC = ""


def identity(place):
    """None if nothing is there: a program may be taking it over."""
    try:
        status = os.lstat(place)
    except FileNotFoundError:
        return None
    return status.st_ino, status.st_ctime_ns


class Names(program_case.ProgramCase):
    def nanoplc(self, endpoint, number):
        """Its own state folder: a second one that took the first one's would be refused for that."""
        config = self.path(f"nanoplc{number}.toml")
        ends = os.openpty()
        for end in ends:
            self.addCleanup(os.close, end)
        with open(config, "w", encoding="utf-8") as file:
            file.write(f'[service]\nstate_directory = "{self.path("state" + str(number))}"\n[[axis]]\nname = "x"\ntable = "none"\n'
                       f'[axis.motor]\nport = "{os.ttyname(ends[1])}"\n[axis.user]\nport = "{endpoint}"\n')
        return [NANOPLC, "--config", config]

    def commands(self, endpoint, number=1):
        """Name and command line of each program that serves there."""
        table = self.path(f"table{number}.bin")
        with open(table, "wb") as file:
            file.write(bytes.fromhex("C000003E80010000 3F00000000000000"))
        commands = {
            "macsim": [MACSIM, "--mactalk", endpoint],
            "midisim": [MIDISIM, "--model", "MAC34-1", "--v24", endpoint],
            "nanoplc-sim": [NANOPLC_SIM, "run", table, "--realtime", "--mactalk", endpoint],
        }
        if NANOPLC:
            commands["nanoplc"] = self.nanoplc(endpoint, number)
        return commands

    def begin(self, command):
        """A program that serves there, known by its lock."""
        with open(self.path("log"), "w", encoding="utf-8") as log:
            process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log)
        self.running.append(process)
        return process

    def serve(self, command, place, before=None):
        """Until it has made its name."""
        process = self.begin(command)
        until(lambda: process.poll() is not None or identity(place) not in (None, before))
        self.assertIsNone(process.poll(), f"{command}: {self.log()}")
        return process

    def log(self):
        with open(self.path("log"), encoding="utf-8") as log:
            return log.read()

    def kinds(self):
        for kind in ("pty:", "unix:"):
            for program in self.commands("none"):
                yield kind, program, self.path(f"{kind[:-1]}-{program}")

    def ask(self, command):
        # pylint: disable-next=consider-using-with
        return subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def ended(self, name, second):
        """nanoplc stays, with that axis stopped, and tries again: it is terminated here. Its output until then."""
        said = ""
        while name == "nanoplc" and "already serves" not in said:
            said += second.stderr.readline()
        if name == "nanoplc":
            second.send_signal(signal.SIGTERM)
        return said

    def refusal(self, name, second, said):
        with second:
            said += second.communicate(timeout=LONG)[1]
            self.assertIn(second.returncode, (0,) if name == "nanoplc" else (2, 3), said)
            return said

    def test_a_second_program_is_refused_and_the_first_stays(self):
        """All seconds at once: each waits half a second for the name, and nanoplc two for a motor at its end."""
        for program in self.commands("none"):
            asked = []
            firsts = []
            for number, kind in enumerate(("pty:", "unix:")):
                place = self.path(f"{kind[:-1]}-{program}")
                first = self.serve(self.commands(kind + place, number)[program], place)
                firsts.append((first, place))
                for name, second in self.commands(kind + place, number + 2).items():
                    asked.append((name, self.ask(second), f"{kind}{place}: {program} (process {first.pid})"))
            before = [identity(place) for _, place in firsts]
            heard = [self.ended(name, second) for name, second, _ in asked]
            for (name, second, who), said in zip(asked, heard):
                self.assertIn(f"{who} already serves there; end it, or name another path", self.refusal(name, second, said))
                self.assertEqual([identity(place) for _, place in firsts], before, name)
            for first, _ in firsts:
                self.assertIsNone(first.poll())
                first.send_signal(signal.SIGTERM)
            for first, place in firsts:
                self.assertEqual(first.wait(LONG), 0)
                self.assertEqual([name for name in os.listdir(self.folder.name) if os.path.basename(place) in name], [], program)

    def test_the_name_of_a_killed_program_is_taken_over(self):
        for kind, program, place in self.kinds():
            first = self.serve(self.commands(kind + place)[program], place)
            before = identity(place)
            first.kill()
            first.wait(LONG)
            self.assertTrue(os.path.lexists(place), program)
            second = self.serve(self.commands(kind + place)[program], place, before)
            second.send_signal(signal.SIGTERM)
            self.assertEqual(second.wait(LONG), 0, self.log())
            self.assertFalse(os.path.lexists(place), program)

    def test_a_program_is_started_right_after_another_was_killed(self):
        for kind in ("pty:", "unix:"):
            place = self.path(kind[:-1])
            command = [MACSIM, "--mactalk", kind + place]
            process = self.serve(command, place)
            for _ in range(20):
                before = identity(place)
                process.kill()  # and is not waited for
                process = self.serve(command, place, before)

    def test_of_many_that_start_at_once_one_serves(self):
        for kind in ("pty:", "unix:"):
            place = self.path(kind[:-1])
            for _ in range(3):  # the second and third time in the place of one that was killed
                all_of_them = [self.begin([MACSIM, "--mactalk", kind + place]) for _ in range(6)]
                until(lambda some=all_of_them: sum(process.poll() is None for process in some) == 1)
                left = [process for process in all_of_them if process.poll() is None]
                self.assertTrue(os.path.lexists(place))
                left[0].kill()
                left[0].wait(LONG)


if __name__ == "__main__":
    MACSIM, MIDISIM, NANOPLC_SIM, NANOPLC = (sys.argv[1:] + [""])[:4]
    unittest.main(argv=sys.argv[:1])
