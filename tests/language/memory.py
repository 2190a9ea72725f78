"""A step's memory of earlier scans, by LANGUAGE.md: edges, times of FOR, blinking, outputs that are set.

A state is the set of armed edges with, in the bit above them, whether the time of FOR runs.
"""

from fractions import Fraction
import math

ALL = (1 << 1024) - 1
TIMER_AT_0 = sum(1 << case for case in range(1024) if case >> 8 & 1)
EDGES = {"R_TRIG": True, "F_TRIG": False}


def timer_value(value):
    return max(1, math.floor(value.as_time().number + Fraction(1, 2)))


def find(node, kind):
    """All nodes of a kind below a node."""
    for child in node.nodes():
        if child.kind == kind:
            yield child
        yield from find(child, kind)


def is_edge(node):
    return node.kind == "primary" and node.words()[:1] and node.words()[0] in EDGES


def bare_branches(parts):
    """The statements outside of IFs, which an IF divides."""
    runs = [[]]
    for part in parts:
        if part.kind == "if":
            runs.append([])
        elif part.kind == "statement":
            runs[-1].append(part)
    return runs


class Memory:
    """`reckon`: a time of the program in milliseconds; `bit`: of an input's name; `cases`: of a condition in a state."""

    def __init__(self, parts, program):
        self.faults, self.edges, self.uses, self.holds = set(), [], [], None
        self.limit = self.blink_for = 0
        self.blinking = 0
        ifs = [part for part in parts if part.kind == "if"]
        for node in ifs:
            for edge in filter(is_edge, find(node, "primary")):
                key = program.edge_of(edge)
                self.edges += [key] if key not in self.edges else []
        if len(self.edges) > 4:
            self.faults.add("E074")
        for node in ifs:
            self.read_times(node, program)
        for node in parts:
            if node.kind == "out" and "BLINKING" in node.words():
                self.uses.append("BLINKING")
                self.blinking |= program.bits(node.node("outputs"))
                self.blink_for = program.time(node.node("value"))
        self.find_other_uses(parts)

    def read_times(self, node, program):
        """A value stands behind WITHIN or FOR, and that behind the condition that it belongs to."""
        for at, child in enumerate(node.children):
            if getattr(child, "kind", "") != "value":
                continue
            word, condition = node.children[at - 1].text.upper(), node.children[at - 2]
            self.uses.append(word)
            if word == "WITHIN":
                self.limit = program.time(child)
            else:
                self.holds = condition, program.time(child)
                if any(map(is_edge, find(condition, "primary"))):
                    self.faults.add("E066")

    def find_other_uses(self, parts):
        if not self.uses:
            return
        tested = [t for part in parts if part.kind in ("if", "out") for t in find(part, "test")]
        others = any(t.words()[:1] == ["TIMER"] for t in tested)
        others |= any(part.kind == "entry" and part.node("action").words()[:1] == ["TIMER"] for part in parts)
        bodies = [body.nodes("statement") for part in parts if part.kind == "if" for body in part.nodes("body")]
        for statements in [*bodies, *bare_branches(parts)]:
            leaves = any(s.node("next") for s in statements)
            others |= not leaves and any(s.node("action") and s.node("action").words()[:1] == ["TIMER"] for s in statements)
        if others or len(self.uses) > 1 and sorted(self.uses) != ["BLINKING", "WITHIN"]:
            self.faults.add("E073")

    def combinations(self):
        return 1 << len(self.edges) + (self.holds is not None)

    def states(self):
        return self.combinations() * (3 if self.counts_halves() else 1)

    def counts_halves(self):
        """WITHIN and BLINKING: halves of the blinking are counted until the limit has passed."""
        return bool(self.limit and self.blink_for)

    def halves(self):
        return -(-self.limit // self.blink_for)

    def half_after(self, half):
        if not self.counts_halves():
            return 1 - half
        return half + 1 if half <= self.halves() else half - 1

    def time_of(self, half):
        is_last = self.counts_halves() and half == self.halves() - 1
        return self.limit - half * self.blink_for if is_last else self.blink_for

    def state_of(self, state, half):
        """With what is left of the limit: 0 it still runs, 1 it is over, 2 it ends with the timer."""
        if not self.counts_halves():
            return state
        left = self.halves() - 1 - half
        return state + self.combinations() * (0 if left > 0 else 2 if left == 0 else 1)

    def cases_of_else(self, state):
        left = state // self.combinations() if self.counts_halves() else 2
        return (0, ALL, TIMER_AT_0)[left]

    def is_plain(self):
        return not self.edges and not self.holds and not self.blinking

    def runs(self, state):
        return self.holds is not None and bool(state >> len(self.edges) & 1)

    def armed(self, state):
        return {key for n, key in enumerate(self.edges) if state >> n & 1}

    def next_state(self, state, case, held):
        """The state after a scan that stays, and the preset that FOR needs; `held`: the cases of its condition."""
        after = sum(1 << n for n, (bit, rising) in enumerate(self.edges) if bool(case >> bit & 1) != rising)
        if self.holds is None or not held >> case & 1:
            return after, None
        return after | 1 << len(self.edges), None if self.runs(state) else self.holds[1]
