"""Executes a program, scan after scan, by LANGUAGE.md."""

from action import Action
from judge import Helper


class Machine:
    def __init__(self, program):
        self.program = program
        self.step = self.timer = self.counter = self.outputs = 0
        self.next = 0                             # these four: of the scan that is executed
        self.preset = self.set_to = self.change = None

    def case(self, image):
        """What conditions see: inputs in bits 0..5, INPOS bit 6, ERROR bit 7; then timer and counter at 0."""
        return image | (self.timer == 0) << 8 | (self.counter == 0) << 9

    def scan(self, image, milliseconds):
        """What it sends, in order."""
        case = self.case(image)
        step = next((s for s in self.program.steps if s.number == self.step), None)
        helper = next((h for h in self.program.helpers.values() if h.number == self.step), None)
        action = self.action_of_helper(helper, case) if helper else self.action_of(step, case)
        is_fault = self.program.on_error and case >> 7 & 1 and step and not step.owns_error
        if step and action.key() in step.helpers and not is_fault:
            helper = step.helpers[action.key()]
            action = Action()
            action.next = helper
        sends = list(action.sends)
        self.next, self.preset, self.set_to, self.change = self.number_of(action.next, self.step), None, None, None
        self.take(action)
        self.write_outputs(step, case)
        for term in step.terms if step else []:
            if self.program.condition(term.node("product")) >> case & 1:
                sends += self.execute_term(term)
        self.finish(milliseconds)
        return sends

    def action_of(self, step, case, state=-1):
        """The one action of the branches that hold; several do the same."""
        program, error = self.program, case >> 7 & 1
        if step is None:
            if not error:
                return program.power_up
            return program.fault(program.values) if program.on_error else Action()
        if program.on_error and error and not step.owns_error:
            return program.fault()
        for choice in step.choices_in[state]:
            action = next((action for cases, action in choice if cases >> case & 1), Action())
            if not action.is_empty():
                return action
        return Action()

    def action_of_helper(self, helper, case):
        if not case >> 7 & 1 or helper.on_error == "act":
            return helper.action
        if helper.on_error == "fault":
            return self.program.fault()
        back = Action()
        back.next = helper.on_error
        return back

    def number_of(self, name, otherwise):
        if name is None:
            return otherwise
        if isinstance(name, Helper):
            return name.number
        return 0 if name == "POWER_UP" else self.program.step(name).number

    def write_outputs(self, step, case):
        if self.next != self.step:
            entered = next((s for s in [*self.program.steps, *self.program.helpers.values()] if s.number == self.next), None)
            self.outputs = entered.outputs if entered else self.program.power_up_outputs
        elif step is None and self.program.power_up_outputs:
            self.outputs = self.program.power_up_outputs
        elif step and (step.when or step.number == 0 and step.outputs):
            self.outputs = step.outputs
            for outputs, cases in step.when:
                self.outputs |= outputs if cases >> case & 1 else 0

    def execute_term(self, term):
        program = self.program
        parts = [part.nodes()[0] for part in term.nodes("term_part") if part.nodes()]
        action = program.action([part for part in parts if part.kind != "outputs"])
        if any(isinstance(send, tuple) for send in action.sends):
            return action.sends
        self.next = self.number_of(action.next, self.next)
        self.outputs = sum({1 << bit for part in parts if part.kind == "outputs"
                            for bit in [program.outputs[s.text().upper()] for s in part.nodes("signal")]})
        self.take(action)
        return action.sends

    def take(self, action):
        """Presets stay until another of their kind comes; a count only until the next term."""
        counts = action.count in ("down", "clear")
        self.change = action.count if counts else None
        if action.timer is not None:
            self.preset = action.timer
        if action.count is not None and not counts:
            self.set_to = action.count

    def finish(self, milliseconds):
        self.step = self.next
        if self.change == "clear":
            self.counter = 0
        elif self.set_to is not None:
            self.counter = self.set_to
        elif self.change == "down":
            self.counter = max(0, self.counter - 1)
        if self.preset is not None:
            self.timer = self.preset
        self.timer = max(0, self.timer - milliseconds)
