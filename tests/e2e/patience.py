"""Waits for what must come, however slow the machine is."""

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
