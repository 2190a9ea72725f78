"""Sets of cases, and what happens in one scan: sections 2 to 4 of LANGUAGE.md."""

BITS = {**{f"IN{n}": n for n in range(6)}, "INPOS": 6, "ERROR": 7, "TIMER": 8, "COUNTER": 9}
ALL = (1 << 1024) - 1
TRUE_OF = [sum(1 << case for case in range(1024) if case >> bit & 1) for bit in range(10)]
ERROR = TRUE_OF[7]


class Action:
    """What happens in one scan: section 3 and 4."""

    def __init__(self):
        self.next = None
        self.sends = []     # bytes as int, register values as (number, value)
        self.timer = None
        self.count = None   # an int, "down" or "clear"
        self.sets = self.resets = 0  # outputs
        self.points = []    # what of this is a set-point's: two with the same default are not the same
        self.faults = set()
        self.times_itself = False  # presets the timer for WITHIN or BLINKING
        self.is_quiet = True  # nothing that EVERY_SCAN would have to announce

    def key(self):
        return self.next, tuple(self.sends), self.timer, self.count, self.sets, self.resets, tuple(self.points)

    def is_empty(self):
        return self.key() == Action().key()

    def once(self, is_free):
        if not is_free:
            self.faults.add("E061")

    def then(self, entry):
        """With the ENTRY of the step that is entered."""
        self.sends = self.sends + entry.sends
        self.points = self.points + entry.points
        if self.timer is not None and entry.timer is not None:
            self.faults.add("E073" if entry.times_itself else "E061")
        self.once(self.count is None or entry.count is None)
        self.timer = entry.timer if entry.timer is not None else self.timer
        self.count = entry.count if entry.count is not None else self.count
        self.switch(entry.sets, entry.resets)

    def switch(self, on, off):
        self.once(not (self.sets & off or self.resets & on))
        self.sets, self.resets = self.sets | on, self.resets | off
