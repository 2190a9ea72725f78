"""Random small programs of the language, with what the compiler makes steps of its own for: ON, groups, helper steps and copies.

They use the inputs IN0 and IN1, the outputs OUT0 and OUT1, and times and counts up to 3.
"""

import json
import subprocess

HEAD = ("PROGRAM Random\nMOTOR MAC140;\nVAR_INPUT A AT IN0 : BOOL; B AT IN1 : BOOL; END_VAR\n"
        "VAR_OUTPUT X AT OUT0 : BOOL; Y AT OUT1 : BOOL; END_VAR\nVAR_MOTOR Fast AT V1 := 100 rpm; Far AT P1 := 1 rev; END_VAR\n")


class Writer:
    def __init__(self, rng, longest):
        self.rng, self.longest = rng, longest
        self.names = [f"S{n}" for n in range(rng.randint(2, 4))]
        self.group = rng.sample(self.names, 2)
        self.latched = rng.random() < 0.2
        self.edges = False

    def chance(self, probability):
        return self.rng.random() < probability

    def time(self):
        return f"T#{self.rng.randint(1, self.longest)}ms"

    def condition(self, depth=1):
        rng = self.rng
        if depth and self.chance(0.4):
            return f"({self.condition(0)} {rng.choice(['AND', 'AND', 'OR', 'XOR'])} {self.condition(0)})"
        atom = rng.choice(["A", "A", "B", "B", "INPOS", "TIMER.Q", "COUNTER.Q"])
        if self.edges and atom in "AB" and self.chance(0.4):
            return f"{rng.choice(['R_TRIG', 'F_TRIG'])}({atom})"
        return f"NOT {atom}" if self.chance(0.3) else atom

    def branch(self, own):
        rng = self.rng
        parts = []
        if self.chance(0.5):
            parts.append(rng.choice([f"TIMER := {self.time()}", f"COUNTER := {rng.randint(1, 3)}", "COUNT_DOWN", "COUNT_DOWN", "STOP",
                                     "POSITION(Far)"]))
        if self.latched and self.chance(0.4):
            parts.append(f"{rng.choice(['SET', 'RESET'])} Y")
        parts.append(f"NEXT := {rng.choice([name for name in self.names if name != own])}")
        return "; ".join(parts) + ";"

    def step(self, name):
        rng = self.rng
        last = name == self.names[-1]
        self.edges = self.chance(0.3)
        text = f"STEP {name}: " + ("OWN ERROR; " if last else "") + ("OUT X; " if self.chance(0.4) else "")
        if self.chance(0.35):  # beside what a branch does on the way in, this asks for a helper step
            text += f"ENTRY {rng.choice(['INIT(Fast)', f'TIMER := {self.time()}', 'COUNTER := 2', 'POSITION(Far)'])}; "
        limit = rng.choice(["", "", "", f" WITHIN {self.time()}", f" FOR {self.time()}"])
        text += f"IF {'ANY ERROR AND ' if last and self.chance(0.5) else ''}{self.condition()}{limit} THEN {self.branch(name)} "
        if limit.startswith(" WITHIN"):
            return text + f"ELSE {self.branch(name)} END_IF END_STEP\n"
        if self.chance(0.6):
            text += f"ELSIF {self.condition()} THEN {self.branch(name)} "
        return text + "END_IF END_STEP\n"

    def program(self):
        text = HEAD + f"GROUP G: {', '.join(self.group)};\nON ERROR NEXT := {self.names[-1]};\n"
        if self.chance(0.7):
            only = self.rng.choice([" IN G", "", f" IN {self.names[0]}", f" IN G EXCEPT {self.group[0]}"])
            text += f"ON {self.condition(0)}{only} NEXT := {self.rng.choice(self.names)};\n"
        text += "" if self.latched or self.chance(0.6) else "OUT Y IN G;\n"
        text += f"POWER_UP INIT(Fast); NEXT := {self.names[0]}; END_POWER_UP\n"
        return text + "".join(self.step(name) for name in self.names) + "END_PROGRAM\n"


class Program:
    """A program that compiles: its table, the number of each step, and those of group G with their copies."""

    def __init__(self, text, table, symbols):
        self.text, self.table = text, table
        self.numbers = {step["name"]: step["number"] for step in symbols["steps"]}
        (group,) = (set(group["steps"]) for group in symbols["groups"] if group["name"] == "G")
        self.group = frozenset(group | {s["number"] for s in symbols["steps"] if s.get("copy_of") in group})


def built(case, text):
    """None if the compiler refuses it."""
    program = case.path("r.seq", text.encode())
    done = subprocess.run([case.seqc, "build", program, "--quiet", "-o", case.path("t.bin")], capture_output=True, text=True, check=False)
    assert done.returncode in (0, 1), done.stderr
    if done.returncode == 1:
        return None
    with open(case.path("t.bin"), "rb") as file:
        content = file.read()
    with open(case.path("t.sym"), encoding="utf-8") as file:
        return Program(text, [content[i:i + 8] for i in range(0, len(content), 8)], json.load(file))


def random_program(case, rng, longest=3):
    """The next that compiles."""
    while True:
        program = built(case, Writer(rng, longest).program())
        if program is not None:
            return program
