"""Random programs that mostly compile, and random courses of what scans read."""

import random

DECLARATIONS = """MOTOR MAC140;
SCALE 1 rev = 8 mm;
VAR_INPUT Start AT IN0 : BOOL; Guard AT %IX0.1; Ack AT IN2 : BOOL; END_VAR
VAR_OUTPUT Lamp AT OUT0 : BOOL; Grip AT %QX0.1 : BOOL; END_VAR
"""
CONSTANTS = """CONST Pieces := 3;
CONST Pitch := 40 mm;
CONST Third := (Pitch + 8 mm)/Pieces - 2 * 1.5 mm;
CONST Pause := T#1ms + 0.004 s;
"""
SET_POINTS = """SET_POINT Depth AT P5 := 30 mm RANGE 10 .. 80.5 mm STEP 0.5 mm;
SET_POINT Halt := 5 ms RANGE 1 ms .. 0.02 s;
SET_POINT Rest := T#5ms RANGE T#1ms .. T#9ms;
SET_POINT Parts := 2 RANGE 1..9;
SET_POINT Other AT REG(34) := 2 RANGE 1 .. 2#111;
SET_POINT Creep := 90 rpm RANGE -90 .. 100 rpm;
"""
VALUES = ["Fast AT V1 := 500 rpm;", "Place AT P2 := -(Pitch - 1 mm)/Pieces; Back AT P3 := Pitch + 2 * Place;", "Window AT INPOSWIN := 16#20;",
          "Soft AT A1 := 5000 rpm/s;"]
NAMES = ["Fast AT V1;", "Place AT P2;", "Window AT REG(33);", "Soft AT A1;"]
INPUTS = ["Start", "Guard", "Ack", "IN3", "IN4", "%IX0.5", "INPOS"]
OUTPUTS = ["Lamp", "Grip", "OUT2", "%QX0.3"]
SENDS = ["STOP", "HOME", "NOP", "RESET_ERROR", "CLEAR_IN_POS", "INIT(Fast, Soft)", "VELOCITY(Soft, Fast)", "USE_SET(3)",
         "INIT(P3, V2, Z1)", "POSITION(Place)", "V_SOLL := -1500 rpm", "Window := 1_000", "P_SOLL := -2.5 rev",
         "REG(33) := 2#11", "A_SOLL := 9", "P_SOLL := -Third + Pitch/Pieces", "P_SOLL := Pieces * Third", "MODE_REG := GP_MODE", "CNTRL_BITS := HICLK + INPSIGN + USERINTF = OUTPUT",
         "HOME_MODE := BY_COMMAND = HOME2_MODE", "INPOSWIN := Pieces * 2 + Pitch / Pitch", "POSITIONS_RELATIVE_P_SOLL", "MOVE_P8_BY_P_SOLL"]
SET_POINT_SENDS = ["POSITION(Depth)", "V_SOLL := Creep"]
COUNTS = ["COUNT_DOWN", "CLEAR_COUNTER", "COUNTER := Pieces - 1", "COUNTER := 2", "COUNTER := 1", "COUNTER := 0"]
TIMES = ["2 * Pause - T#3ms", "T#1ms", "T#0.004s", "7 ms", "0.012 s"]


class Writer:
    def __init__(self, rng):
        self.rng = rng
        self.names = [f"S{n}" for n in range(rng.randint(2, 5))]
        self.has_on_error = rng.random() < 0.6
        self.at_zero = rng.random() < 0.15
        apart = random.Random(repr(rng.getstate()[1][:8]))  # other programs are the same with and without
        self.has_set_points = not self.at_zero and apart.random() < 0.3
        self.is_timed = False                     # the step at hand tests timer or counter
        self.is_careful = rng.random() < 0.8      # avoids what the compiler refuses, mostly
        self.remembers = rng.random() < 0.4       # has SET, edges, FOR, WITHIN, BLINKING; then no TERM
        self.latched = rng.sample(OUTPUTS, rng.choice([0, 1, 1, 2])) if self.remembers else []
        self.sequence = rng.random() < 0.25
        self.nested = self.sequence and apart.random() < 0.6
        self.called_first = self.sequence and apart.random() < 0.5
        self.unlatched = [output for output in OUTPUTS if output not in self.latched]
        self.edges = []                           # inputs of which the step at hand may see edges
        self.free_timer = False                   # FOR or WITHIN may use the timer of the step at hand
        self.blinks = False                       # BLINKING uses it, and WITHIN may too

    def chance(self, probability):
        return self.rng.random() < probability

    def some(self, pool, most):
        return self.rng.sample(pool, self.rng.randint(0, min(most, len(pool))))

    def condition(self, owns_error, depth=2):
        rng = self.rng
        if depth and self.chance(0.6):
            parts = [self.condition(owns_error, depth - 1) for _ in range(2)]
            joined = f" {rng.choice(['AND', 'AND', 'OR', 'XOR'])} ".join(parts)
            return f"({joined})" if self.chance(0.7) else joined
        atom = rng.choice(INPUTS)
        if self.edges and self.chance(0.3):
            atom = f"{rng.choice(['R_TRIG', 'R_TRIG', 'F_TRIG'])}({rng.choice(self.edges)})"
        elif self.chance(0.25 if self.is_timed else 0.02):
            atom = rng.choice(["TIMER.Q", "TIMER.Q", "COUNTER.Q", "TRUE"])
        if self.chance(0.25 if owns_error else 0 if self.is_careful else 0.05):
            atom = rng.choice(["ERROR", "ANY ERROR"])
        return f"NOT {atom}" if self.chance(0.25) else atom

    def statements(self, every_scan=False, counts=True):
        chosen = self.some(SENDS + (SET_POINT_SENDS if self.has_set_points else []), 2) if self.chance(0.5) else []
        if self.latched and self.chance(0.3):
            chosen.append(f"{self.rng.choice(['SET', 'SET', 'RESET'])} {self.rng.choice(self.latched)}")
        if counts and self.chance(0.3):
            chosen.append(f"TIMER := {self.rng.choice(TIMES + (['Halt', 'Rest'] if self.has_set_points else []))}")
        if counts and self.chance(0.3):
            chosen.append(self.rng.choice(COUNTS + (["COUNTER := Parts"] if self.has_set_points else [])))
        self.rng.shuffle(chosen)
        return [("EVERY_SCAN " if every_scan else "") + text + ";" for text in chosen]

    def branch(self, own):
        kind = self.rng.random()
        if kind < 0.08:
            return ""
        if kind < 0.2:
            stay = [f"NEXT := {own};"] if self.chance(0.3) and not (self.is_careful and own in self.entries) else []
            return " ".join(self.statements(self.is_careful or not self.chance(0.1)) + stay)
        if self.sequence and self.chance(0.4):
            return self.call()
        others = [name for name in self.names if name != own or not self.is_careful]
        target = "POWER_UP" if not self.at_zero and self.chance(0.1) else self.rng.choice(others)
        busy = self.is_careful and target in self.entries
        parts = [] if busy and self.chance(0.5) else self.statements(self.chance(0.05), not busy)
        parts.append(f"NEXT := {target};")
        self.rng.shuffle(parts)
        return " ".join(parts)

    def call(self):
        """Through the sequence to a step of the program."""
        rng = self.rng
        given = f"{rng.choice(self.unlatched)}, {rng.choice(INPUTS[:5])}, {self.time()}, {rng.choice(self.names)}"
        return f"CALL Part({given}); NEXT := {rng.choice(self.names)};"

    def sequence_text(self):
        """Two steps that use their parameters; the second one leads back."""
        sends = f"{self.rng.choice(SENDS)}; " if self.chance(0.5) else ""
        inner = ""
        second = "IF NOT Seen AND IN4 THEN NEXT := Away; ELSIF IN4 THEN RETURN; END_IF"
        if self.remembers and self.chance(0.5):
            second = "IF F_TRIG(Seen) THEN RETURN; ELSIF IN3 THEN NEXT := First; END_IF"
        if self.nested:
            second += " END_STEP STEP Final: OWN ERROR; IF IN4 THEN CALL Inner(Seen, Away); NEXT := First; ELSIF IN3 THEN RETURN; END_IF"
            second = second.replace("RETURN", "CALL Inner(IN3, Away); NEXT := Final", 1)
            inner = ("SEQUENCE Inner(VAR_INPUT Told, STEP Aside)\n"
                     "STEP Await: OWN ERROR; IF Told THEN RETURN; ELSIF IN4 THEN NEXT := Aside; END_IF END_STEP END_SEQUENCE\n")
        first = "IF Seen THEN TIMER := Wait; NEXT := Second; END_IF"
        if self.remembers and self.chance(0.5):
            first = f"IF Seen WITHIN Wait THEN {sends}NEXT := Second; ELSE NEXT := Away; END_IF"
        return (inner + "SEQUENCE Part(VAR_OUTPUT Shown, VAR_INPUT Seen, CONST Wait, STEP Away)\n"
                f"STEP First: OWN ERROR; OUT Shown; {first} END_STEP STEP Second: OWN ERROR; {second} END_STEP END_SEQUENCE\n")

    def choice(self, own, owns_error, within=""):
        """`within`: what all of its conditions begin with."""
        limit = f" WITHIN {self.time()}" if not within and (self.takes_timer(0.3) or self.counts_halves()) else ""
        text = f"IF {self.timed(within, owns_error, limit)} THEN {self.branch(own)}"
        for _ in range(self.rng.randint(0, 2)):
            text += f" ELSIF {self.timed(within, owns_error)} THEN {self.branch(own)}"
        if limit:
            return f"{text} ELSE {self.branch(own)} END_IF"
        return text + (f" ELSE {self.branch(own)}" if not within and self.chance(0.3) else "") + " END_IF"

    def takes_timer(self, probability):
        """Nothing else of the step has taken it, mostly."""
        if not (self.free_timer and self.chance(probability)):
            return False
        self.free_timer = not self.is_careful
        return True

    def counts_halves(self):
        """One WITHIN may stand beside BLINKING."""
        counts, self.blinks = self.blinks and self.chance(0.5), False
        return counts

    def time(self):
        return self.rng.choice(TIMES)

    def timed(self, within, owns_error, limit=""):
        edges = self.edges
        lasts = f" FOR {self.time()}" if not limit and self.takes_timer(0.25) else ""
        self.edges = [] if lasts and self.is_careful else edges
        text = f"{within}({self.condition(owns_error)}){limit}{lasts}"
        self.edges = edges
        return text

    def choices(self, own, owns_error):
        if self.is_careful and self.chance(0.8):
            return [self.choice(own, owns_error)]
        if self.is_careful and self.chance(0.2):
            return [self.branch(own)] + ([self.choice(own, True, "ERROR AND ")] if owns_error else [])
        if self.is_careful:
            bit = self.rng.choice(INPUTS)
            return [self.choice(own, owns_error, f"{word} AND ") for word in (bit, f"NOT {bit}")]
        bare = [self.branch(own)] if self.chance(0.1) else []
        return bare + [self.choice(own, owns_error) for _ in range(self.rng.choice([1, 1, 2]))]

    def step(self, name, number):
        owns = name == self.names[-1] or not self.has_on_error or self.chance(0.2)
        owns = owns and (self.is_careful or not self.chance(0.1))
        uses_timer = any("TIMER" in text for text in self.entries.get(name, []))
        self.free_timer = self.remembers and not (self.is_careful and uses_timer) and self.chance(0.6)
        self.is_timed = self.chance(0.25) and not (self.free_timer and self.is_careful)
        parts = ["OWN ERROR;"] if owns else []
        parts += ["NO_HELPER;"] if self.chance(0.15) else []
        listed = [o for o in OUTPUTS if o not in self.latched or self.chance(0.02)]
        self.outputs[name] = self.some(listed, 2)
        if self.outputs[name]:
            parts.append(f"OUT {', '.join(self.outputs[name])};")
        for _ in range(self.rng.choice([0, 0, 0, 1, 2])):
            parts.append(f"OUT {self.rng.choice(listed)} WHEN {self.condition(owns)};")
        if len(listed) > 2 and self.takes_timer(0.3):
            blinks = [o for o in listed if not any(o in part for part in parts if part.startswith("OUT")) or self.chance(0.1)]
            parts += [f"OUT {self.rng.choice(blinks)} BLINKING {self.time()};"] if blinks else []
            self.blinks = bool(blinks)
        self.edges = self.rng.sample(["Start", "Guard", "IN3"], self.rng.choice([0, 0, 1, 1, 2])) if self.remembers else []
        if self.has_set_points and name not in self.entries and self.chance(0.3):
            parts.append("TAKES SET_POINTS;")
        parts += [f"ENTRY {text}" for text in self.entries.get(name, [])]
        parts += self.choices(name, owns)
        self.edges, self.free_timer, self.blinks = [], False, False
        return f"STEP {name}{number}: {' '.join(parts)} {{{name}}} END_STEP"

    def term(self):
        """Beside branches it names a next step and that one's outputs, so that outputs stay certain."""
        words = self.some(INPUTS, 2) + self.some(["TIMER.Q"], 1) + self.some(["ERROR"], 1)
        literals = [f"NOT {w}" if w != "TIMER.Q" and self.chance(0.4) else w for w in words] or ["TRUE"]
        condition = f"TERM IF {' AND '.join(literals)} THEN"
        if self.chance(0.2):
            return f"{condition} Window := {self.rng.randint(1, 99)}; END_IF;"
        target = self.rng.choice(self.names)
        parts = self.some(["HOME;", "STOP;", "POSITION(Place);"], 1) + [f"NEXT := {target};"]
        parts += self.some([f"TIMER := {self.rng.choice(TIMES)};", f"{self.rng.choice(COUNTS[2:])};"], 1)
        parts += self.some(["COUNT_DOWN;"] if not any("COUNTER" in p for p in parts) else [], 1)
        if self.outputs[target]:
            parts.append(f"OUT {', '.join(self.outputs[target])};")
        return f"{condition} {' '.join(parts)} END_IF;"

    def on_condition(self):
        rng = self.rng
        group = f"G{rng.randrange(10 ** 9)}" if self.chance(0.5) else ""
        declared = f"GROUP {group}: {', '.join(rng.sample(self.names, 2))};\n" if group else ""
        only = f" IN {', '.join(self.some(self.names, 2) + ([group] if group else [self.names[0]]))}"
        only = only if group or self.chance(0.3) else ""
        left_out = f" EXCEPT {rng.choice(self.names)}" if self.chance(0.3) else ""
        target = "POWER_UP" if not self.at_zero and self.chance(0.1) else rng.choice(self.names)
        self.is_timed = self.chance(0.1)
        return f"{declared}ON {self.condition(False, 1)}{only}{left_out} NEXT := {target};\n"

    def group_out(self):
        rng = self.rng
        left_out = f" EXCEPT {rng.choice(self.names)}" if self.chance(0.3) else ""
        return f"OUT {rng.choice(OUTPUTS)} IN {', '.join(rng.sample(self.names, 2))}{left_out};\n"

    def program(self):
        self.outputs = {}
        self.entries = {name: self.statements() for name in self.names if self.chance(0.25)}
        numbers = self.rng.sample(range(1, 62), len(self.names))
        spelt = [f" AT {n}" if self.chance(0.2) else "" for n in numbers]
        if self.at_zero:
            spelt[self.rng.randrange(len(spelt))] = " AT 0"
        steps = [self.step(name, number) for name, number in zip(self.names, spelt)]
        terms = {n: self.term() if self.chance(0.25) and not self.at_zero and not self.remembers else "" for n in self.names}
        text = "PROGRAM Random\n" + DECLARATIONS + CONSTANTS
        text += SET_POINTS if self.has_set_points else ""
        text += f"VAR_MOTOR {' '.join(NAMES if self.at_zero or self.chance(0.3) else VALUES)} END_VAR\n"
        text += f"ON ERROR NEXT := {self.names[-1]};\n" if self.has_on_error else ""
        text += self.sequence_text() if self.sequence else ""
        text += "".join(self.on_condition() for _ in range(self.rng.choice([0, 0, 1, 2])))
        grouped = self.group_out() if not self.latched and self.chance(0.3) else ""
        text += grouped if not any(terms.values()) else ""  # a TERM does not name what it switches on
        if not self.at_zero and self.chance(0.6):
            first = f"NEXT := {self.rng.choice(self.names)};"
            if self.called_first:
                first = f"CALL Inner(Guard, {self.names[0]}); {first}" if self.nested and self.chance(0.6) else self.call()
            kept = f"OUT {self.rng.choice(OUTPUTS)}; " if not self.latched and self.chance(0.2) else ""
            text += f"POWER_UP {kept}{' '.join(self.statements(False, False))} {first} END_POWER_UP\n"
        text += "\n".join(step.format(**terms) for step in steps) + "\nEND_PROGRAM\n"
        return text.replace("Ack AT IN2", "Ack AT NOT IN2") if self.chance(0.5) else text


def program(rng):
    return Writer(rng).program()


def course(rng, length):
    """[(image, milliseconds)]: levels that stay a while, so that steps are left and waited in."""
    image, rows = rng.randrange(128), []
    for _ in range(length):
        for bit in range(8):
            if rng.random() < (0.25 if bit < 7 else 0.15):
                image ^= 1 << bit
        if rng.random() < 0.4:
            image &= 0x7F
        rows.append((image, rng.choice([0, 1, 1, 2, 5, 20])))
    return rows
