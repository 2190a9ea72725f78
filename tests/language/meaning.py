"""What a program means, from LANGUAGE.md alone: conditions as sets of cases, branches, entries, and the scan.

A case is one of the 1,024 values of the ten things that a condition can test; a set of them is an int with a bit each.
"""

import math

import registers

BITS = {**{f"IN{n}": n for n in range(6)}, "INPOS": 6, "ERROR": 7, "TIMER": 8, "COUNTER": 9}
ALL = (1 << 1024) - 1
TRUE_OF = [sum(1 << case for case in range(1024) if case >> bit & 1) for bit in range(10)]
ERROR = TRUE_OF[7]


class Refused(Exception):
    """The program uses something that this interpreter does not know."""


class Action:
    """What happens in one scan: section 3 and 4."""

    def __init__(self):
        self.next = None
        self.sends = []     # bytes as int, register values as (number, value)
        self.timer = None
        self.count = None   # an int, "down" or "clear"
        self.faults = set()
        self.is_quiet = True  # nothing that EVERY_SCAN would have to announce

    def key(self):
        return self.next, tuple(self.sends), self.timer, self.count

    def is_empty(self):
        return self.key() == (None, (), None, None)

    def once(self, is_free):
        if not is_free:
            self.faults.add("E061")

    def then(self, entry):
        """With the ENTRY of the step that is entered."""
        self.sends = self.sends + entry.sends
        self.once(self.timer is None or entry.timer is None)
        self.once(self.count is None or entry.count is None)
        self.timer = entry.timer if entry.timer is not None else self.timer
        self.count = entry.count if entry.count is not None else self.count


class Statement:
    """A statement that the program does not write out."""

    def __init__(self, *children):
        self.children = children

    def nodes(self, *kinds):
        return [c for c in self.children if not kinds or c.kind in kinds]

    def node(self, kind):
        return next(iter(self.nodes(kind)), None)

    def words(self):
        return []


class Step:
    def __init__(self, name):
        self.name, self.number = name, None
        self.outputs, self.when, self.entry = 0, [], Action()
        self.choices, self.terms, self.owns_error = [], [], False
        self.covers = []    # ON conditions, the first one first
        self.no_helper, self.helpers = False, {}


class Program:
    def __init__(self, tree, register_map, command_bytes):
        self.tree, self.map, self.bytes = tree, register_map, command_bytes
        self.inputs = {f"IN{n}": n for n in range(6)} | {f"%IX0.{n}": n for n in range(6)}
        self.outputs = {f"OUT{n}": n for n in range(4)} | {f"%QX0.{n}": n for n in range(4)}
        self.names, self.values, self.faults, self.groups, self.helpers = {}, [], set(), {}, {}
        self.on_error = self.per_rev = None
        self.power_up, self.steps = Action(), []
        self.read_declarations()
        self.read_steps()
        self.number_steps()
        self.cover_steps()
        self.start = next((step for step in self.steps if step.number == 0), None)
        self.finish_branches()
        self.find_faults()

    # Declarations

    def items(self, kind):
        return [item.nodes()[0] for item in self.tree.nodes("item") if item.nodes(kind)]

    def read_declarations(self):
        for scale in self.items("scale"):
            turns, length = (value.tokens() for value in scale.nodes("value"))
            self.per_rev = float(length[0].text) / float(turns[0].text), length[1].text.upper()
        for block in self.items("signals"):
            known = self.inputs if "VAR_INPUT" in block.words() else self.outputs
            names = [t for t in block.words()[1:] if t not in ("AT", ":", "BOOL", ";", "END_VAR")]
            for name, address in zip(names, block.nodes("signal")):
                known[name] = known[address.text().upper()]
        for block in self.items("registers"):
            names = [t for t in block.words()[1:] if t not in ("AT", ":=", ";", "END_VAR")]
            for name, target in zip(names, block.nodes("register")):
                self.names[name] = self.register(target)
                at = block.children.index(target)
                if block.children[at + 1] is not None and getattr(block.children[at + 1], "text", "") == ":=":
                    self.values.append(self.write(self.names[name], block.children[at + 2]))
        for item in self.items("on_error"):
            self.on_error = item.words()[4]

    # Values

    def register(self, node):
        if node.node("whole"):
            number = whole(node.node("whole"))
            return next(r for r in self.map.values() if r.number == number)
        name = node.words()[0]
        return self.names.get(name) or self.map[name]

    def write(self, register, value):
        return register.number, self.steps_of(register, value) % (1 << (32 if register.is_wide else 16))

    def steps_of(self, register, value):
        tokens = [t.text for t in value.tokens()]
        sign = -1 if tokens[0] == "-" else 1
        number, *unit = tokens[1:] if tokens[0] in "+-" else tokens
        if "#" in number:
            return based(number)
        exact = sign * float(number.replace("_", ""))
        if unit:
            text = "".join(unit)
            if self.per_rev and text.upper().startswith(self.per_rev[1]):
                exact, text = exact / self.per_rev[0], "rev" + text[len(self.per_rev[1]):]
            exact *= register.steps_in(text)
        return int(math.copysign(math.floor(abs(exact) + 0.5), exact))

    # Steps

    def read_steps(self):
        for node in self.items("power_up"):
            self.power_up = self.action([a for s in node.nodes("statement") for a in s.nodes()])
        for node in self.items("step"):
            step = Step(node.words()[1])
            step.number = whole(node.node("whole")) if node.node("whole") else None
            self.steps.append(step)
            self.read_parts(step, [part.nodes()[0] for part in node.nodes("part") if part.nodes()])
        for node in self.items("named_term"):
            next(s for s in self.steps if s.name == node.words()[1]).terms.append(node.node("term_if"))

    def read_parts(self, step, parts):
        bare = None
        entry = []
        for part in parts:
            if part.kind == "out" and part.node("expression"):
                step.when.append((self.bits(part.node("outputs")), self.condition(part.node("expression"))))
            elif part.kind == "out":
                step.outputs |= self.bits(part.node("outputs"))
            elif part.kind == "own_error":
                step.owns_error = True
            elif part.kind == "no_helper":
                step.no_helper = True
            elif part.kind == "entry":
                entry.append(part.node("action"))
            elif part.kind == "statement":
                if bare is None:
                    bare = []
                    step.choices.append([(ALL & ~ERROR, bare)])
                bare.append(part)
            elif part.kind == "if":
                bare = None
                step.choices.append(self.branches(part))
            else:
                step.terms.append(part.node("term_if"))
        step.entry = self.action(entry)

    def branches(self, node):
        conditions = [self.condition(e) for e in node.nodes("expression")] + [ALL & ~ERROR]
        return [(c, body.nodes("statement")) for c, body in zip(conditions, node.nodes("body"))]

    def cover_steps(self):
        """ON conditions: the first branches of each choice, and a choice of their own."""
        for group in self.items("group"):
            self.groups[group.words()[1]] = self.steps_in(group.node("names"))
        for on in reversed(self.items("on_condition")):
            words, lists = on.words(), on.nodes("names")
            only = self.steps_in(lists[0]) if "IN" in words else {s.name for s in self.steps} - {self.on_error}
            left_out = self.steps_in(lists[-1]) if "EXCEPT" in words else set()
            target = on.node("next")
            for step in self.steps:
                if step.name in only - left_out - {target.words()[2]}:
                    step.covers.insert(0, (self.condition(on.node("expression")), target))
        for step in self.steps:
            conditions = [(cases, [Statement(target)]) for cases, target in step.covers]
            without = [(cases, []) for cases, target in step.covers]
            step.choices = ([conditions] if conditions else []) + [without + choice for choice in step.choices]

    def steps_in(self, names):
        return set().union(*(self.groups.get(name, {name}) for name in names.words() if name != ","))

    def bits(self, outputs):
        return sum({1 << self.outputs[s.text().upper()] for s in outputs.nodes("signal")})

    def number_steps(self):
        free = (n for n in range(1, 62) if n not in {step.number for step in self.steps})
        for step in self.steps:
            if step.number is None:
                step.number = next(free)

    def step(self, name):
        return next((s for s in self.steps if s.name == name), None)

    # Conditions

    def condition(self, node):
        cases = self.cases(node)
        return cases if "ERROR" in [t.text.upper() for t in node.tokens()] else cases & ~ERROR

    def cases(self, node):
        parts = [self.cases(part) for part in node.nodes() if part.kind != "signal"]
        if node.kind in ("expression", "exclusive", "conjunction", "product"):
            total = parts[0]
            for part in parts[1:]:
                total = {"expression": total | part, "exclusive": total ^ part}.get(node.kind, total & part)
            return total
        words = node.words()
        if words[:1] == ["NOT"]:
            return ALL & ~parts[0]
        if parts:
            return parts[0]
        if node.node("signal"):
            return TRUE_OF[self.inputs[node.node("signal").text().upper()]]
        if words[0] in ("TRUE", "ANY", "FALSE"):
            return 0 if words[0] == "FALSE" else ALL
        return TRUE_OF[BITS[words[0]]]

    # Actions

    def action(self, nodes):
        done = Action()
        for node in nodes:
            if node.kind == "next":
                done.once(done.next is None)
                done.next = node.words()[2]
            else:
                self.act(node, done)
        return done

    def act(self, node, done):
        words = node.words()
        if node.node("register"):
            done.sends.append(self.write(self.register(node.node("register")), node.node("value")))
        elif node.node("command"):
            done.sends += self.command(node.node("command"))
        elif words[0] == "TIMER":
            done.once(done.timer is None)
            done.timer = max(1, milliseconds(node.node("value")))
        else:
            done.once(done.count is None)
            done.count = {"COUNT_DOWN": "down", "CLEAR_COUNTER": "clear"}.get(words[0])
            done.count = done.count or whole(node.node("whole")) or "clear"

    def command(self, node):
        name = node.words()[0]
        arguments = [a.text().upper() for a in node.nodes("argument")]
        if name not in ("INIT", "VELOCITY", "POSITION"):
            return [self.bytes[f"{name}({arguments[0]})" if arguments else name]]
        selected = [self.names[a].name if a in self.names else a for a in arguments]
        first = [s for s in selected if name == "VELOCITY" and s[0] == "V"]
        last = [s for s in selected if s[0] == "P"]
        between = [s for s in selected if s not in first + last]
        base = {"INIT": 0x00, "VELOCITY": 0x20, "POSITION": 0x40}[name]
        return [base + registers.SELECTABLE[s[0]] + int(s[1]) - 1 for s in first + between + last]

    # Branches

    def finish_branches(self):
        """Statements to actions, with the ENTRY of the step that they enter."""
        for step in self.steps:
            step.choices = [[self.branch(step, *branch) for branch in choice] for choice in step.choices]

    def branch(self, step, cases, statements):
        action = self.action([node for s in statements for node in s.nodes()])
        unmarked = any(s.node("action") and "EVERY_SCAN" not in s.words() for s in statements)
        stays = action.next in (None, step.name)
        if stays and (unmarked or (action.next and not step.entry.is_empty())):
            action.faults.add("E060")
        if action.next and not (stays and step.entry.is_empty()):
            self.enter(action)
        return cases, action

    def enter(self, action):
        target = self.step(action.next)
        if target:
            action.then(target.entry)

    def fault(self, before=()):
        action = Action()
        action.next, action.sends = self.on_error, list(before)
        self.enter(action)
        return action

    # What the compiler must refuse

    def find_faults(self):
        fault = self.step(self.on_error) if self.on_error else None
        if fault and not fault.owns_error:
            self.faults.add("E081")
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

    def find_faults_in(self, step):
        acting = []
        for choice in step.choices:
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

    # What a table can do (section 9)

    def helper_called(self, name):
        return next((h for step in self.steps for h in step.helpers.values()
                     if f"{step.name}_TO_{h.action.next}" == name), None)

    def is_possible(self):
        """Makes the helper steps; false if there are branches that can have none."""
        return all([self.make_helpers(step) for step in self.steps])

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
            on_error = "act" if cases & ERROR else step.name if step.owns_error else "fault"
            helper = self.helpers.setdefault((action.key(), on_error), Helper(action, on_error))
            if helper.number is None:
                numbers = {s.number for s in [*self.steps, *self.helpers.values()]}
                helper.number = next(n for n in range(1, 62) if n not in numbers)
                target = self.step(action.next)
                helper.outputs = target.outputs if target else 0
            step.helpers[action.key()] = helper
        return True


class Helper:
    """A step of the compiler's: does what a branch says in the scan after."""

    def __init__(self, action, on_error):
        self.action, self.on_error, self.number, self.outputs = action, on_error, None, 0


def acts_alike(cases, once):
    """For all inputs: always, when timer = 0, when counter = 0, when both; for presets also when one of them."""
    running, timer, counter, both = (cases >> 256 * n & (1 << 256) - 1 for n in range(4))
    taken_back = running & ~(timer & counter) | (timer | counter) & ~both
    twice = timer & counter & ~running if once else 0
    return not taken_back | twice


def whole(node):
    text = node.text().replace(" ", "")
    return based(text.lstrip("+")) if "#" in text else int(float(text.replace("_", "")))


def based(text):
    base, digits = text.split("#")
    return int(digits.replace("_", ""), int(base))


def milliseconds(value):
    text = value.text().replace(" ", "").replace("_", "").lower()
    total, number = 0.0, ""
    for part in text.split("#")[-1].replace("ms", "i"):
        if part.isalpha():
            total += float(number) * {"i": 1, "s": 1000, "m": 60000, "h": 3600000, "d": 86400000}[part]
            number = ""
        else:
            number += part
    return int(math.floor(total + 0.5))
