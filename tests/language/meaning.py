"""What a program means, from LANGUAGE.md alone: conditions as sets of cases, branches, entries, and the scan.

A case is one of the 1,024 values of the ten things that a condition can test; a set of them is an int with a bit each.
"""

import math
from fractions import Fraction

import registers
from action import ALL, BITS, ERROR, TRUE_OF, Action
from judge import Judge
from memory import EDGES, Memory, is_edge, timer_value
from values import Reckoner, Value, based


class Refused(Exception):
    """The program uses something that this interpreter does not support."""


def is_switch(action):
    return action.words()[:1] in (["SET"], ["RESET"])


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
        self.choices_in, self.terms, self.owns_error = [], [], False  # choices by the state of the memory
        self.covers = []    # ON conditions, the first one first
        self.memory, self.held, self.named_outputs = None, 0, 0
        self.no_helper, self.helpers = False, {}

    @property
    def choices(self):
        """Where all that its memory can hold holds."""
        return self.choices_in[-1]


class Program(Judge):
    def __init__(self, tree, register_map, command_bytes):
        self.tree, self.map, self.bytes = tree, register_map, command_bytes
        self.inputs = {f"IN{n}": n for n in range(6)} | {f"%IX0.{n}": n for n in range(6)}
        self.inverted = set()  # names of inputs that are on while the wire is off
        self.outputs = {f"OUT{n}": n for n in range(4)} | {f"%QX0.{n}": n for n in range(4)}
        self.set_points = {}
        self.names, self.values, self.faults, self.groups, self.helpers = {}, [], set(), {}, {}
        self.constants, self.gets = {}, {}
        self.on_error = self.per_rev = None
        self.power_up, self.steps, self.power_up_outputs = Action(), [], 0
        self.switched = {}
        self.armed = None  # what R_TRIG and F_TRIG see: (bit, rising)
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
            turns, length = (value.tokens() for value in scale.nodes("amount"))
            self.per_rev = float(length[0].text) / float(turns[0].text), length[1].text.upper()
        for block in self.items("signals"):
            known = self.inputs if "VAR_INPUT" in block.words() else self.outputs
            names = [t for t in block.words()[1:] if t not in ("AT", "NOT", ":", "BOOL", ";", "END_VAR")]
            for name, address in zip(names, block.nodes("signal")):
                known[name] = known[address.text().upper()]
                before = block.children[block.children.index(address) - 1]
                self.inverted |= {name} if before.text.upper() == "NOT" else set()
        for constant in self.items("constant"):
            self.constants[constant.words()[1]] = Reckoner(self.constants).value(constant.node("value"))
        for block in self.items("registers"):
            names = [t for t in block.words()[1:] if t not in ("AT", ":=", ";", "END_VAR")]
            for name, target in zip(names, block.nodes("register")):
                self.names[name] = self.register(target)
                at = block.children.index(target)
                if block.children[at + 1] is not None and getattr(block.children[at + 1], "text", "") == ":=":
                    self.values.append(self.write(self.names[name], block.children[at + 2], self.gets))
                    self.keep_what_it_gets(name, block.children[at + 2])
        for item in self.items("set_point"):
            self.declare_set_point(item)
        for item in self.items("on_error"):
            self.on_error = item.words()[4]

    def declare_set_point(self, item):
        """Its default is what the table has: a name for a value, and with AT for a register too."""
        name, value = item.words()[1], item.node("value")
        self.set_points[name] = value
        if item.node("register"):
            self.names[name] = self.register(item.node("register"))
            self.values.append(self.write(self.names[name], value))

    def value_of(self, node):
        """Of a statement: what is written there, or the default of the set-point that is named."""
        written = node.node("value")
        return self.set_points.get(written.text().strip().upper(), written) if written else None

    def misplaced(self):
        """What the rules behind the grammar forbid: `ON ERROR NEXT` is no condition for many steps, and stands once."""
        likewise = [on for on in self.items("on_condition")
                    if on.node("expression").text().strip().upper() == "ERROR" and not on.nodes("names")]
        to_power_up = [on for on in likewise if on.node("next").words()[2] == "POWER_UP"]
        times = len(self.items("on_error")) + len(likewise) - len(to_power_up)
        return ({"E011"} if to_power_up else set()) | ({"E020"} if times > 1 else set())

    # Values

    def register(self, node):
        if node.node("whole"):
            number = whole(node.node("whole"))
            return next(r for r in self.map.values() if r.number == number)
        name = node.words()[0]
        return self.names.get(name) or self.map[name]

    def keep_what_it_gets(self, name, value):
        """In the unit in which it was written, for the values of VAR_MOTOR below."""
        register, known = self.names[name], self.constants | self.gets
        written = Reckoner(known, register.bits_named, register.bits_of_part).value(value)
        if not written.is_bits and written.number:
            exact, steps = self.exact_steps(register, written), self.steps_of(register, value, self.gets)
            self.gets[name] = Value(written.number * steps / Fraction(exact), written.unit)

    def write(self, register, value, more=()):
        return register.number, self.steps_of(register, value, more) % (1 << (32 if register.is_wide else 16))

    def steps_of(self, register, value, more=()):
        known = self.constants | dict(more)
        reckoned = Reckoner(known, register.bits_named, register.bits_of_part).value(value)
        if reckoned.is_bits:
            return int(reckoned.number)
        exact = self.exact_steps(register, reckoned)
        return int(math.copysign(math.floor(abs(exact) + 0.5), exact))

    def exact_steps(self, register, reckoned):
        exact, text = float(reckoned.number), reckoned.unit
        if text:
            if self.per_rev and text.upper().startswith(self.per_rev[1]):
                exact, text = exact / self.per_rev[0], "rev" + text[len(self.per_rev[1]):]
            exact *= register.steps_in(text)
        return exact

    # Steps

    def read_steps(self):
        for node in self.items("power_up"):
            self.power_up = self.action([a for s in node.nodes("statement") for a in s.nodes()])
            self.power_up_outputs = sum(self.bits(outputs) for outputs in node.nodes("outputs"))
        for node in self.items("step"):
            step = Step(node.words()[1])
            step.number = whole(node.node("whole")) if node.node("whole") else None
            self.steps.append(step)
            self.read_parts(step, [part.nodes()[0] for part in node.nodes("part") if part.nodes()])
        for node in self.items("named_term"):
            next(s for s in self.steps if s.name == node.words()[1]).terms.append(node.node("term_if"))

    def read_parts(self, step, parts):
        entry = []
        step.memory = Memory(parts, self)
        self.faults |= step.memory.faults
        for part in parts:
            if part.kind == "out":
                step.named_outputs |= self.bits(part.node("outputs"))
            if part.kind == "out" and part.node("expression"):
                step.when.append((self.bits(part.node("outputs")), self.condition(part.node("expression"))))
            elif part.kind == "out" and not part.node("value"):
                step.outputs |= self.bits(part.node("outputs"))
            elif part.kind == "own_error":
                step.owns_error = True
            elif part.kind == "no_helper":
                step.no_helper = True
            elif part.kind == "takes":
                pass    # what a gateway does between scans changes no table
            elif part.kind == "entry":
                entry.append(part.node("action"))
            elif part.kind in ("term", "named_term"):
                step.terms.append(part.node("term_if"))
        step.entry = self.action(entry)
        if step.memory.limit or step.memory.blinking:
            step.entry.timer = step.memory.time_of(0) if step.memory.blinking else step.memory.limit
            step.entry.times_itself = True
        if any(step.memory.blinking & bits for bits in [step.outputs, *(bits for bits, _ in step.when)]):
            self.faults.add("E065")
        for state in range(step.memory.states()):
            self.armed = step.memory.armed(state)
            step.choices_in.append(self.read_choices(parts, step.memory.runs(state), step.memory.cases_of_else(state)))
            if step.memory.holds:
                step.held = self.condition(step.memory.holds[0])
        self.armed = None

    def read_choices(self, parts, runs, cases_of_else):
        bare, choices = None, []
        for part in parts:
            if part.kind == "statement":
                if bare is None:
                    bare = []
                    choices.append([(ALL & ~ERROR, bare)])
                bare.append(part)
            elif part.kind == "if":
                bare = None
                choices.append(self.branches(part, runs, cases_of_else))
        return choices

    def branches(self, node, runs, cases_of_else):
        """`runs`: the time of FOR, so that its condition holds when the timer is at 0; `cases_of_else`: of WITHIN."""
        words = node.words()
        conditions = [self.condition(e) for e in node.nodes("expression")]
        at = [n for n, child in enumerate(node.children) if getattr(child, "kind", "") == "expression"]
        for n, place in enumerate(at):
            follows = node.children[place + 1]
            if getattr(follows, "text", None) and not hasattr(follows, "children") and follows.text.upper() == "FOR":
                conditions[n] &= TRUE_OF[8] if runs else 0
        conditions.append(ALL & ~ERROR & (cases_of_else if "WITHIN" in words else ALL))
        return [(c, body.nodes("statement")) for c, body in zip(conditions, node.nodes("body"))]

    def time(self, node):
        return timer_value(Reckoner(self.constants).value(node))

    def remembers(self):
        return bool(self.switched or not all(step.memory.is_plain() for step in self.steps))

    def cover_steps(self):
        """ON conditions: the first branches of each choice, and a choice of their own."""
        for group in self.items("group"):
            self.groups[group.words()[1]] = self.steps_in(group.node("names"))
        for out in self.items("group_out"):
            lists, bits = out.nodes("names"), self.bits(out.node("outputs"))
            named = self.steps_in(lists[0]) - (self.steps_in(lists[1]) if len(lists) > 1 else set())
            for step in self.steps:
                if step.name in named:
                    step.outputs |= bits
                    step.named_outputs |= bits
                    self.faults |= {"E065"} if step.memory.blinking & bits else set()
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
            step.choices_in = [([conditions] if conditions else []) + [without + choice for choice in choices]
                               for choices in step.choices_in]

    def steps_in(self, names):
        return set().union(*(self.groups.get(name, {name}) for name in names.words() if name != ","))

    def bits(self, outputs):
        return sum({1 << self.outputs[s.text().upper()] for s in outputs.nodes("signal")})

    def number_steps(self):
        free = (n for n in range(1, 62) if n not in {step.number for step in self.steps})
        for step in self.steps:
            if step.number is None:
                step.number = next(free, None)
                self.faults |= {"E083"} if step.number is None else set()

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
        if is_edge(node):
            return self.edge(*self.edge_of(node))
        if words[:1] == ["NOT"]:
            return ALL & ~parts[0]
        if parts:
            return parts[0]
        if node.node("signal"):
            name = node.node("signal").text().upper()
            return TRUE_OF[self.inputs[name]] ^ (ALL if name in self.inverted else 0)
        if words[0] in ("TRUE", "ANY", "FALSE"):
            return 0 if words[0] == "FALSE" else ALL
        return TRUE_OF[BITS[words[0]]]

    def edge_of(self, node):
        """The bit, and whether its wire rises."""
        name = node.node("signal").text().upper()
        return self.inputs[name], EDGES[node.words()[0]] != (name in self.inverted)

    def edge(self, bit, rising):
        if self.armed is None:
            self.faults.add("E066")
        if (bit, rising) not in (self.armed or ()):
            return 0
        return TRUE_OF[bit] if rising else ALL & ~TRUE_OF[bit]

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
        if words[-2:-1] == [":="] and words[-1] in self.set_points:
            done.points.append((words[0], words[-1]))
        if node.node("register"):
            done.sends.append(self.write(self.register(node.node("register")), self.value_of(node)))
        elif node.node("command"):
            done.sends += self.command(node.node("command"))
        elif words[0] == "TIMER":
            done.once(done.timer is None)
            done.timer = self.time(self.value_of(node))
        elif words[0] in ("SET", "RESET"):
            bits = self.bits(node.node("outputs"))
            self.switched[words[0]] = self.switched.get(words[0], 0) | bits
            done.switch(*((bits, 0) if words[0] == "SET" else (0, bits)))
        else:
            done.once(done.count is None)
            done.count = {"COUNT_DOWN": "down", "CLEAR_COUNTER": "clear"}.get(words[0])
            done.count = done.count or int(Reckoner(self.constants).value(self.value_of(node)).number) or "clear"

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
            step.choices_in = [[[self.branch(step, *branch) for branch in choice] for choice in choices]
                               for choices in step.choices_in]

    def branch(self, step, cases, statements):
        action = self.action([node for s in statements for node in s.nodes()])
        unmarked = any(s.node("action") and "EVERY_SCAN" not in s.words() and not is_switch(s.node("action"))
                       for s in statements)
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


def whole(node):
    text = node.text().replace(" ", "")
    return based(text.lstrip("+")) if "#" in text else int(float(text.replace("_", "")))


def whole(node):
    text = node.text().replace(" ", "")
    return based(text.lstrip("+")) if "#" in text else int(float(text.replace("_", "")))
