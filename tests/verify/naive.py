"""Explores a small table in the plainest way: every image, every time, one scan after the other (001 §6.1)."""

from collections import deque
from dataclasses import dataclass

INPOS, ERROR = 0x40, 0x80


def scan(table, state, image):
    """State after the scan's commands: step, outputs, timer, counter."""
    step, outputs, timer, counter = state
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


def holds(condition, image, state):
    """A condition as a tree: ("in", bit), ("out", bit), ("timer",), ("counter",), ("step", n), ("not", x),
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
    if kind == "step":
        return state[0] == condition[1]
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
    """All scans that can be, with everything free (`any`). Times up to the longest preset are tried."""

    def __init__(self, table, images, longest):
        self.table, self.images = table, images
        self.scans = {}  # (image, state after) -> depth
        self.after = {}  # state before a scan -> {(image, state after)}
        start = (0, 0, 0, 0)
        depth = {start: 0}
        queue = deque([start])
        while queue:
            state = queue.popleft()
            self.after[state] = set()
            for image in images:
                done = scan(table, state, image)
                self.after[state].add((image, done))
                self.scans.setdefault((image, done), depth[state] + 1)
                for later in self.elapsed(done, longest):
                    if later not in depth:
                        depth[later] = depth[state] + 1
                        queue.append(later)
        self.longest = longest
        self.begun = {state[0] for state in self.after}

    @staticmethod
    def elapsed(state, longest):
        step, outputs, timer, counter = state
        return {(step, outputs, max(0, timer - ms), counter) for ms in range(min(timer, longest) + 1)}

    def first(self, wanted):
        """Least number of scans to one that `wanted` takes; None if there is none."""
        return min((d for (image, state), d in self.scans.items() if wanted(image, state)), default=None)

    def broken_after(self, begin, step):
        """Least number of scans after which `step` says that they break what it watches; None if none do. It takes what
        is remembered, the state before a scan, its image and the state after it, and answers (broken, remembered)."""
        queue, seen = deque([((0, 0, 0, 0), begin, 0)]), {((0, 0, 0, 0), begin)}
        while queue:
            state, memory, depth = queue.popleft()
            for image in self.images:
                done = scan(self.table, state, image)
                broken, after = step(memory, state, image, done)
                if broken:
                    return depth + 1
                for later in self.elapsed(done, self.longest):
                    if (later, after) not in seen:
                        seen.add((later, after))
                        queue.append((later, after, depth + 1))
        return None

    def held_too_long(self, c, d, ms):
        """The same for c while d has held for `ms`: the time is counted up to `ms`, from each scan on where d begins."""
        queue, seen = deque([((0, 0, 0, 0), None, 0)]), {((0, 0, 0, 0), None)}
        while queue:
            state, held, depth = queue.popleft()
            for image in self.images:
                done = scan(self.table, state, image)
                now = (held or 0) if holds(d, image, done) else None
                if held is not None and now is not None and held >= ms and holds(c, image, done):
                    return depth + 1
                for dt in range(max(ms, self.longest) + 1):
                    later = (done[0], done[1], max(0, done[2] - dt), done[3])
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

        def followed(before, _, image, done):
            return before and holds(d, image, done) and not holds(e, image, done), holds(c, image, done)

        off = (0, 0, 0, 0)
        begin = (holds(c, 0, off), holds(d, 0, off)) if form == "changes" else False
        return self.broken_after(begin, {"only": only_after, "stays": stays, "changes": changes, "scan": scan_ends,
                                         "followed": followed}[form])

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
        elif form in ("only", "stays", "changes", "scan", "followed"):
            shortest = self.remembered(form, c, d, e)
        elif form == "reachable":
            shortest = self.first(lambda i, s: holds(c, i, s))
            return shortest is not None, shortest
        else:
            ways = self.ways_to(c)
            shortest = self.first(lambda i, s: (form == "possible" or holds(d, i, s)) and not holds(c, i, s)
                                  and not any(e in ways for e in self.elapsed(s, self.longest)))
        return shortest is None, shortest

    def ways_to(self, c):
        """States in which a scan can begin from which some course leads to `c`."""
        ways = {s for s, after in self.after.items() if any(holds(c, i, e) for i, e in after)}
        while True:
            more = {s for s, after in self.after.items() if s not in ways
                    and any(e in ways for _, end in after for e in self.elapsed(end, self.longest))}
            if not more:
                return ways
            ways |= more
