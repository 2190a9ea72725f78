"""The scan of programs with SET, RESET, R_TRIG, F_TRIG, FOR and BLINKING: a machine that is in a copy of a step."""

from collections import namedtuple

from machine import Machine
from action import ERROR
from judge import acts_alike
from tools import HELPER

Copy = namedtuple("Copy", "name state half latched")  # the step's name; None: POWER_UP
# What is done, whether by ON ERROR, where it ends, what FOR or BLINKING preset, the outputs of OUT .. WHEN in another copy.
Outcome = namedtuple("Outcome", "key is_fault copy timer outputs")
Pending = namedtuple("Pending", "action outcome on_error back")

class Impossible(Exception):
    """A table cannot do it, and no helper step can stand in."""


class RememberingMachine(Machine):
    def __init__(self, program):
        super().__init__(program)
        self.copy = Copy(None if program.start is None else program.start.name, 0, 0, 0)
        self.pending, self.known = None, {}

    def named(self, name):
        return None if name in (None, "POWER_UP") else self.program.step(name)

    def outcome(self, copy, case):
        """(action, Outcome) of a scan in a copy."""
        step = self.named(copy.name)
        action = self.action_of(step, case, step.memory.state_of(copy.state, copy.half) if step else copy.state)
        return action, self.after(copy, step, action, case)

    def after(self, copy, step, action, case):
        latched = (copy.latched | action.sets) & ~action.resets
        is_fault = bool(self.program.on_error and step and not step.owns_error and case >> 7 & 1)
        if action.next not in (None, copy.name or "POWER_UP"):
            entered = Copy(None if action.next == "POWER_UP" else action.next, 0, 0, latched)
            return Outcome(action.key(), is_fault, entered, None, 0)
        if step is None:
            return Outcome(action.key(), is_fault, copy._replace(latched=latched), None, 0)
        state, timer = step.memory.next_state(copy.state, case, step.held)
        half = copy.half
        if step.memory.blinking and case >> 8 & 1:
            half = step.memory.half_after(half)
            timer = step.memory.time_of(half)
        other = Copy(copy.name, state, half, latched)
        changes = other != copy and step.when
        return Outcome(action.key(), is_fault, other, timer, self.outputs_of(other) | self.follows(step, case) if changes else 0)

    @staticmethod
    def follows(step, case):
        """The outputs that OUT .. WHEN switches on."""
        return sum({bit for outputs, cases in step.when if cases >> case & 1 for bit in (1, 2, 4, 8) if outputs & bit})

    def cases_of(self, copy, outcome):
        if copy not in self.known:
            together = self.known[copy] = {}
            for case in range(1024):
                other = self.outcome(copy, case)[1]
                together[other] = together.get(other, 0) | 1 << case
        return self.known[copy][outcome]

    def scan(self, image, milliseconds):
        case = self.case(image)
        self.preset = self.set_to = self.change = None
        sends = self.scan_helper(case) if self.pending else self.scan_step(case)
        self.next = HELPER if self.pending else self.number_of(self.copy.name or "POWER_UP", 0)
        self.finish(milliseconds)
        return sends

    def scan_step(self, case):
        action, outcome = self.outcome(self.copy, case)
        step, cases = self.named(self.copy.name), self.cases_of(self.copy, outcome)
        timed = action.timer or outcome.timer or isinstance(action.count, int)
        if (action.sends or timed) and not acts_alike(cases, bool(action.sends)):
            if outcome.copy == self.copy or step is None or step.no_helper:
                raise Impossible
            has_own = step.owns_error or not self.program.on_error
            on_error = "act" if cases & ERROR else "back" if has_own else "fault"
            self.pending = Pending(action, outcome, on_error, self.copy)
            self.outputs = self.outputs_of(outcome.copy)
            return []
        return self.perform(action, outcome, case)

    def scan_helper(self, case):
        pending, self.pending = self.pending, None
        if case >> 7 & 1 and pending.on_error == "fault":
            action = self.program.fault()
            return self.perform(action, self.after(pending.back, None, action, case), case)
        if case >> 7 & 1 and pending.on_error == "back":
            self.copy = pending.back
            self.outputs = self.outputs_of(self.copy)
            return []
        return self.perform(pending.action, pending.outcome, case, False)

    def perform(self, action, outcome, case, follows=True):
        before, self.copy = self.copy, outcome.copy
        self.take(action)
        if outcome.timer is not None:
            self.preset = outcome.timer
        step = self.named(self.copy.name)
        if before != self.copy or step is None and self.program.power_up_outputs:
            self.outputs = self.outputs_of(self.copy)
        if step and follows and before.name == self.copy.name and (step.when or step.number == 0 and step.outputs):
            self.outputs = self.outputs_of(self.copy) | self.follows(step, case)
        return list(action.sends)

    def outputs_of(self, copy):
        step = self.named(copy.name)
        if step is None:
            return self.program.power_up_outputs | copy.latched
        return step.outputs | copy.latched | (0 if copy.half % 2 else step.memory.blinking)


def machine_for(program):
    return RememberingMachine(program) if program.remembers() else Machine(program)
