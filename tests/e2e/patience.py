"""Waits for what must come, however slow the machine is."""

import glob
import os
import signal
import time

LONG = 60  # seconds


def until(come, what="it"):
    """What `come` answers once that is true. `what`: words, or a function that finds them when it is too late."""
    end = time.monotonic() + LONG
    while not (answer := come()):
        if time.monotonic() > end:
            raise AssertionError(f"never came: {what() if callable(what) else what}")
        time.sleep(0.02)
    return answer


def halt(pid):
    """Returns when all threads of the process stand: a signal takes its time, in which they go on."""
    def stands():
        states = []
        for path in glob.glob(f"/proc/{pid}/task/*/stat"):
            try:
                with open(path, encoding="ascii", errors="replace") as file:
                    states.append(file.read().rpartition(")")[2].split()[0])
            except OSError:  # a thread that has just ended
                return False
        return states and all(state in "Tt" for state in states)

    os.kill(pid, signal.SIGSTOP)
    until(stands, "that it is halted")
