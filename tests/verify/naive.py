"""Explores a small table in the plainest way: every image, every time, one scan after the other (001 §6.1)."""

from collections import deque
from dataclasses import dataclass

INPOS, ERROR = 0x40, 0x80
# What was ordered of the motor. LATE: to a place, and for how long is not known, because of an ERROR or another target or speed
# on the way; IN_PLACE: in position mode; *_0: with V_SOLL 0.
INIT, TO_PLACE, ENDLESS, LATE, IN_PLACE, IN_PLACE_0, ON_ITS_WAY_0, ENDLESS_0, HOMING, HOMING_LATE = range(10)
MOVING = {TO_PLACE, ENDLESS, LATE, HOMING, HOMING_LATE}
TIMED = {TO_PLACE, HOMING}
CLEARS = {0x62: "P_SOLL", 0x63: "P_IST", 0x64: "P_FNC"}


def motion_after(motion, command):
    """What one FastMAC command makes of it (001 5.2.1.4), of those that the tests' tables have."""
    if command == 0x08:  # INIT(V1)
        return INIT
    if command == 0x40:  # POSITION(P1)
        return TO_PLACE
    if command == 0x28:  # VELOCITY(V1)
        return ENDLESS
    if command == 0x70:  # HOME
        return HOMING
    if command == 0x65:  # STOP
        return {TO_PLACE: ON_ITS_WAY_0, LATE: ON_ITS_WAY_0, ENDLESS: ENDLESS_0, IN_PLACE: IN_PLACE_0}.get(motion, motion)
    if command == 0x48:  # POSITION(V1): on to the target that stands, at some speed
        return motion if motion in (TO_PLACE, IN_PLACE) else IN_PLACE if motion == IN_PLACE_0 else LATE
    if command in (0x62, 0x64):  # another target
        return {TO_PLACE: LATE, IN_PLACE: LATE, IN_PLACE_0: ON_ITS_WAY_0}.get(motion, motion)
    return motion


def motion_after_scan(motion, commands):
    """P_SOLL, P_IST and P_FNC cleared, with nothing else between, move nothing."""
    cleared, before = set(), motion
    for command in commands:
        then = motion_after(motion, command)
        if command in CLEARS:
            before = before if cleared else motion
            cleared.add(command)
            motion = before if len(cleared) == len(CLEARS) else then
        else:
            cleared = cleared if command & 0x80 or command in NO_MOTION else set()
            motion = then
    return motion


NO_MOTION = {0x60, 0x61}  # NOP, RESET_ERROR


def scan(table, state, image):
    """State after the scan's commands: step, outputs, timer, counter."""
    step, outputs, timer, counter = state[:4]
    next_step, out_byte, timer_preset, counter_preset = None, None, 0, 0
    for term in table:
        if term[0] & 0x3F == 0x3F:
            break
        if (term[0] & 0x3F) != step:
            continue
        if not term[0] & 0x80 and timer != 0:
            continue
        if not term[0] & 0x40 and counter != 0:
            continue
        if (term[1] ^ image) & ((term[2] & 0x7F) | 0x80):
            continue
        if term[2] & 0x80:  # FlexMAC
            continue
        if term[3] & 0x3F != 0x3E:
            next_step = term[3] & 0x3F
        out_byte = term[5]
        word = term[6] | term[7] << 8
        if word:
            if term[3] & 0x40:
                counter_preset = word
            else:
                timer_preset = word
    if next_step is not None:
        step = next_step
    if out_byte is not None:
        outputs = out_byte & 0x0F
        if out_byte & 0x40:
            counter = 0
        elif counter_preset:
            counter = counter_preset
        elif out_byte & 0x80 and counter:
            counter -= 1
        if timer_preset:
            timer = timer_preset
    return step, outputs, timer, counter


def orders(table, state, image):
    """FastMAC commands of the terms that are true."""
    for term in table:
        if term[0] & 0x3F == 0x3F:
            return
        waits = (not term[0] & 0x80 and state[2]) or (not term[0] & 0x40 and state[3])
        compared = (term[2] & 0x7F) | 0x80
        if term[0] & 0x3F == state[0] and not waits and not (term[1] ^ image) & compared and not term[2] & 0x80:
            yield term[4]


def holds(condition, image, state):
    """A condition as a tree: ("in", bit), ("out", bit), ("timer",), ("counter",), ("step", n), ("group", numbers), ("moving",), ("not", x),
    ("and"|"or"|"xor", x, y)."""
    kind = condition[0]
    if kind == "in":
        return bool(image >> condition[1] & 1)
    if kind == "out":
        return bool(state[1] >> condition[1] & 1)
    if kind == "timer":
        return state[2] == 0
    if kind == "counter":
        return state[3] == 0
    if kind == "moving":
        return state[4] in MOVING
    if kind == "step":
        return state[0] == condition[1]
    if kind == "group":
        return state[0] in condition[1]
    if kind == "not":
        return not holds(condition[1], image, state)
    left, right = holds(condition[1], image, state), holds(condition[2], image, state)
    return {"and": left and right, "or": left or right, "xor": left != right}[kind]


@dataclass
class Scan:
    image: int
    after: tuple
    depth: int  # scans up to and including this one


class Naive:
    """All scans that can be, with everything free (`any`). Times up to the longest preset are tried. With `move_ms` a move to
    a place ends within it, and states have two more parts: what was ordered of the motor, and for how long it has moved."""

    def __init__(self, table, images, longest, move_ms=None):
        self.table, self.images, self.move_ms = table, images, move_ms
        self.longest = longest
        self.scans = {}  # (image, state after) -> depth
        self.after = {}  # state before a scan -> {(image, state after)}
        start = self.off = (0, 0, 0, 0) if move_ms is None else (0, 0, 0, 0, INIT, 0)
        depth = {start: 0}
        queue = deque([start])
        while queue:
            state = queue.popleft()
            self.after[state] = set()
            for image in self.possible(state):
                done = self.scan(state, image)
                self.after[state].add((image, done))
                self.scans.setdefault((image, done), depth[state] + 1)
                for later in self.elapsed(done):
                    if later not in depth:
                        depth[later] = depth[state] + 1
                        queue.append(later)
        self.begun = {state[0] for state in self.after}

    def scan(self, state, image):
        done = scan(self.table, state, image)
        if self.move_ms is None:
            return done
        motion, moved = state[4:]
        if motion in (TO_PLACE, LATE, HOMING, HOMING_LATE) and image & INPOS:
            motion = IN_PLACE
        elif motion in TIMED and image & ERROR:
            motion = LATE if motion == TO_PLACE else HOMING_LATE
        commands = list(orders(self.table, state, image))
        motion = motion_after_scan(motion, commands)
        goes_on = motion in TIMED and motion_after_scan(INIT, commands) not in TIMED
        return (*done, motion, moved if goes_on else 0)

    def possible(self, state):
        """Images with which a scan can begin there."""
        if self.move_ms is None or state[4] not in TIMED or state[5] <= self.move_ms:
            return self.images
        return [image for image in self.images if image & (INPOS | ERROR)]

    def elapse(self, state, ms):
        step, outputs, timer, counter, *move = state
        if move and move[0] in TIMED:
            move[1] = min(move[1] + ms, self.move_ms + 1)
        return (step, outputs, max(0, timer - ms), counter, *move)

    def elapsed(self, state):
        return {self.elapse(state, ms) for ms in range(max(self.longest, (self.move_ms or 0) + 1) + 1)}

    def first(self, wanted):
        """Least number of scans to one that `wanted` takes; None if there is none."""
        return min((d for (image, state), d in self.scans.items() if wanted(image, state)), default=None)

    def broken_after(self, begin, step):
        """Least number of scans after which `step` reports a violation; None if none do. It takes what
        is remembered, the state before a scan, its image and the state after it, and answers (broken, remembered)."""
        queue, seen = deque([(self.off, begin, 0)]), {(self.off, begin)}
        while queue:
            state, memory, depth = queue.popleft()
            for image in self.possible(state):
                done = self.scan(state, image)
                broken, after = step(memory, state, image, done)
                if broken:
                    return depth + 1
                for later in self.elapsed(done):
                    if (later, after) not in seen:
                        seen.add((later, after))
                        queue.append((later, after, depth + 1))
        return None

    def held_too_long(self, c, d, ms):
        """The same for c while d has held for `ms`: the time is counted up to `ms`, from each scan on where d begins."""
        queue, seen = deque([(self.off, None, 0)]), {(self.off, None)}
        while queue:
            state, held, depth = queue.popleft()
            for image in self.possible(state):
                done = self.scan(state, image)
                now = (held or 0) if holds(d, image, done) else None
                if held is not None and now is not None and held >= ms and holds(c, image, done):
                    return depth + 1
                for dt in range(max(ms, self.longest, (self.move_ms or 0) + 1) + 1):
                    later = self.elapse(done, dt)
                    after = None if now is None else min(ms, now + dt)
                    if (later, after) not in seen:
                        seen.add((later, after))
                        queue.append((later, after, depth + 1))
        return None

    def remembered(self, form, c, d, e):
        """The forms that look at more than one scan."""
        def only_after(seen, _, image, done):
            now = seen or holds(d, image, done)
            return holds(c, image, done) and not now, now

        def stays(within, _, image, done):
            now = (within or holds(c, image, done)) and not holds(d, image, done)
            return now and not holds(e, image, done), now

        def changes(before, _, image, done):
            now = holds(c, image, done), holds(d, image, done)
            return now[0] != before[0] and not now[1] and not before[1], now

        def scan_ends(_, state, image, done):
            return holds(c, image, state) and not holds(d, image, done), None

        def only_from(seen, state, image, done):
            now = seen or holds(d, image, state)
            return holds(c, image, done) and not now, now

        def only_both(memory, _, image, done):
            seen, before = memory
            now = seen or (before and holds(e, image, done))
            return holds(c, image, done) and not now, (now, holds(d, image, done))

        def followed(before, _, image, done):
            return before and holds(d, image, done) and not holds(e, image, done), holds(c, image, done)

        begin = (holds(c, 0, self.off), holds(d, 0, self.off)) if form == "changes" else (False, False) if form == "both" else False
        return self.broken_after(begin, {"only": only_after, "stays": stays, "changes": changes, "scan": scan_ends,
                                         "followed": followed, "from": only_from, "both": only_both}[form])

    def verdict(self, form, c, d=None, e=None, ms=0):
        """Whether the property holds, and the least number of scans that show that it does not (that it does, for
        `reachable`)."""
        if form == "never":
            shortest = self.first(lambda i, s: holds(c, i, s))
        elif form == "always":
            shortest = self.first(lambda i, s: not holds(c, i, s))
        elif form == "whenever":
            shortest = self.first(lambda i, s: holds(c, i, s) and not holds(d, i, s))
        elif form == "while":
            shortest = self.held_too_long(c, d, ms)
        elif form in ("only", "stays", "changes", "scan", "followed", "from", "both"):
            shortest = self.remembered(form, c, d, e)
        elif form == "reachable":
            shortest = self.first(lambda i, s: holds(c, i, s))
            return shortest is not None, shortest
        else:
            ways = self.ways_to(c)
            shortest = self.first(lambda i, s: (form == "possible" or holds(d, i, s)) and not holds(c, i, s)
                                  and not any(e in ways for e in self.elapsed(s)))
        return shortest is None, shortest

    def ways_to(self, c):
        """States in which a scan can begin from which some course leads to `c`."""
        ways = {s for s, after in self.after.items() if any(holds(c, i, e) for i, e in after)}
        while True:
            more = {s for s, after in self.after.items() if s not in ways
                    and any(e in ways for _, end in after for e in self.elapsed(end))}
            if not more:
                return ways
            ways |= more
