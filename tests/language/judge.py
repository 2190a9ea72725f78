"""What the compiler must refuse, and what a table can do: the codes and section 9 of LANGUAGE.md."""

from action import ALL, ERROR, Action


class Judge:
    """The part of a program that finds its faults and the helper steps that it needs."""

    def find_faults(self):
        fault = self.step(self.on_error) if self.on_error else None
        if fault and not fault.owns_error:
            self.faults.add("E081")
            fault.owns_error = True  # as which its branches are checked
        first = self.power_up.next or self.steps[0].name
        if first == "POWER_UP" or (self.items("power_up") and not self.power_up.next):
            self.faults.add("E085")
        elif not self.start:
            start = Action()
            start.__dict__.update(self.power_up.__dict__, sends=self.values + self.power_up.sends, next=first)
            self.enter(start)
            self.power_up = start
            self.faults |= start.faults
        for step in self.steps:
            self.faults |= step.entry.faults
            if not self.on_error and not step.owns_error:
                self.faults.add("E080")
            self.find_faults_in(step)

        if any(depends_on_timer(cases) for step in self.steps if step.memory.uses for cases, _ in step.covers):
            self.faults.add("E073")
        if any(step.named_outputs & bits for step in self.steps for bits in self.switched.values()):
            self.faults.add("E065")
        if not self.faults and self.shares_timer():
            self.faults.add("E073")

    def find_faults_in(self, step):
        for choices in step.choices_in:
            self.find_faults_in_choices(step, choices)

    def find_faults_in_choices(self, step, choices):
        acting = []
        for choice in choices:
            taken, own = 0, []
            for cases, action in choice:
                self.faults |= action.faults
                if cases & ~taken and not action.is_empty():
                    own.append((cases & ~taken, action))
                taken |= cases
            for cases, action in own:
                if self.on_error and not step.owns_error and cases & ERROR:
                    self.faults.add("E082")
                if any(cases & other and action.key() != before.key() for other, before in acting):
                    self.faults.add("E070")
            acting += own

    def shares_timer(self):
        """A timer is tested that a step with WITHIN, FOR or BLINKING has changed."""
        ways = {step.name: self.merged(step) for step in self.steps}
        ways["POWER_UP"] = [(self.power_up, ALL)] if not self.start else []
        own = {step.name for step in self.steps if step.memory.uses}
        changed, again = set(), True
        while again:
            after = {action.next for name in own | changed for action, _ in ways[name]
                     if action.next not in (None, name) and action.timer is None} - own
            again, changed = bool(after - changed), changed | after
        tested = {name for name in ways for action, cases in ways[name] if name != "POWER_UP" and depends_on_timer(cases)}
        return bool(tested & changed)

    def merged(self, step):
        """What its branches do, each with all its cases."""
        together = {}
        for choice in step.choices:
            taken = 0
            for cases, action in choice:
                if cases & ~taken and not action.is_empty():
                    together.setdefault(action.key(), [action, 0])[1] |= cases & ~taken
                taken |= cases
        fault = [(self.fault(), ERROR)] if self.on_error and not step.owns_error else []
        return [tuple(both) for both in together.values()] + fault

    # What a table can do (section 9)

    def helper_called(self, name):
        return next((h for step in self.steps for h in step.helpers.values()
                     if f"{step.name}_TO_{h.action.next}" == name), None)

    def is_possible(self):
        """Makes the helper steps; false if there are branches that can have none."""
        return all([self.make_helpers(step) for step in self.steps])

    def way_of_error(self, step):
        """Back to a step that owns ERROR; that is the way of ON ERROR too if it leads there and nothing else happens."""
        back = Action()
        back.next = step.name
        is_own = step.owns_error and not (self.on_error and self.fault().key() == back.key())
        return step.name if is_own else "fault"

    def make_helpers(self, step):
        together = {}
        for choice in step.choices:
            taken = 0
            for cases, action in choice:
                together.setdefault(action.key(), [action, 0])[1] |= cases & ~taken
                taken |= cases
        trouble = [(action, cases) for action, cases in together.values()
                   if (action.sends or action.timer or isinstance(action.count, int))
                   and not acts_alike(cases, bool(action.sends))]
        for action, cases in trouble:
            if action.next in (None, step.name) or step.no_helper:
                return False
            on_error = "act" if cases & ERROR else self.way_of_error(step)
            helper = self.helpers.setdefault((action.key(), on_error), Helper(action, on_error))
            if helper.number is None:
                numbers = {s.number for s in [*self.steps, *self.helpers.values()]}
                helper.number = next(n for n in range(1, 62) if n not in numbers)
                target = self.step(action.next)
                helper.outputs = target.outputs if target else self.power_up_outputs
            step.helpers[action.key()] = helper
        return True


class Helper:
    """A step added by the compiler: carries out a branch in the next scan."""

    def __init__(self, action, on_error):
        self.action, self.on_error, self.number, self.outputs = action, on_error, None, 0


def depends_on_timer(cases):
    return bool((cases >> 256 ^ cases) & sum((1 << 256) - 1 << 256 * n for n in (0, 2)))


def acts_alike(cases, once):
    """For all inputs: always, when timer = 0, when counter = 0, when both; for presets also when one of them."""
    running, timer, counter, both = (cases >> 256 * n & (1 << 256) - 1 for n in range(4))
    taken_back = running & ~(timer & counter) | (timer | counter) & ~both
    twice = timer & counter & ~running if once else 0
    return not taken_back | twice
