"""seqc and nanoplc-sim as programs, and a table's bytes executed as 001 §6.1 says."""

import json
import os
import subprocess

SYNTAX = ("E001", "E002", "E003", "E004", "E010", "E012", "E013", "E014", "E064", "E090")


class Tools:
    def __init__(self, seqc, nanoplc_sim, folder):
        self.seqc, self.nanoplc_sim, self.folder = seqc, nanoplc_sim, folder

    def path(self, name, text=None):
        path = os.path.join(self.folder, name)
        if text is not None:
            with open(path, "w", encoding="utf-8", newline="") as file:
                file.write(text)
        return path

    def build(self, program):
        """Diagnostics; the table is in p.bin if none of them is an error."""
        done = subprocess.run([self.seqc, "build", self.path("p.seq", program), "-o", self.path("p.bin"),
                               "--json"], capture_output=True, text=True, check=False)
        said = json.loads(done.stdout)
        if (done.returncode == 0) != said["ok"] or done.returncode not in (0, 1):
            raise AssertionError(f"exit code {done.returncode}: {done.stdout}{done.stderr}")
        return said["diagnostics"]

    def verify(self, program):
        """Results of seqc verify."""
        done = subprocess.run([self.seqc, "verify", self.path("p.seq", program), "--json"], capture_output=True, text=True,
                              check=False)
        if done.returncode not in (0, 1, 4):
            raise AssertionError(f"exit code {done.returncode}: {done.stderr}")
        return json.loads(done.stdout)["results"]

    def table(self):
        with open(self.path("p.bin"), "rb") as file:
            return file.read()

    def steps(self):
        """Number -> the step's entry in F.sym."""
        with open(self.path("p.sym"), encoding="utf-8") as file:
            return {step["number"]: step for step in json.load(file)["steps"]}

    def scan(self, course):
        """Rows of nanoplc-sim scan for [(image, milliseconds)]: step, timer, counter, outputs, commands, values."""
        lines = [f"{ms},{image & 63},{image >> 6 & 1},{image >> 7}" for image, ms in course]
        stimulus = self.path("s.csv", "\n".join(["dt_ms,inputs,inpos,error", *lines]) + "\n")
        done = subprocess.run([self.nanoplc_sim, "scan", self.path("p.bin"), "--stimulus", stimulus],
                              capture_output=True, text=True, check=True)
        rows = [line.split(",") for line in done.stdout.split("\n")[1:-1]]
        return [[*map(int, row[1:5]), row[5], row[6]] for row in rows]


HELPER = -1


def step_of_program(step, program):
    """Of a step of the table: the program's number; a copy is the step that it is one of."""
    why = step.get("made_for", "")
    if why.startswith("helper step"):
        return HELPER
    name = why.split("'")[1] if why.startswith("copy of") else step["name"]
    return 0 if name == "POWER_UP" else program.step(name.upper()).number


def is_syntax(diagnostic):
    """A message of the parser rather than of what comes after it."""
    return (diagnostic["code"] in SYNTAX
            or (diagnostic["code"] == "E011" and "is a word of the language" in diagnostic["message"])
            or (diagnostic["code"] == "E094" and "has one condition" in diagnostic["message"]))


def as_columns(sends):
    """What nanoplc-sim scan prints of what was sent."""
    return [" ".join(f"{s:02X}" for s in sends if isinstance(s, int)),
            " ".join(f"{s[0]}={s[1]}" for s in sends if isinstance(s, tuple))]


def sent_in_order(table, step, case):
    """What the true terms of a table send, in table order; `case`: bit 8 timer = 0, bit 9 counter = 0."""
    sends = []
    for at in range(0, len(table), 8):
        state, given, care, next_reg, command, _, low, high = table[at:at + 8]
        if state & 63 == 63:
            break
        zeros = (state & 0x80 or case & 0x100) and (state & 0x40 or case & 0x200)
        if state & 63 != step or not zeros or (given ^ case) & (care & 0x7F | 0x80):
            continue
        if care & 0x80:
            value = table[at + 4] | table[at + 5] << 8 | ((low << 16 | high << 24) if next_reg & 0x80 else 0)
            sends.append((next_reg & 0x7F, value))
        elif not command & 0x80:
            sends.append(command)
    return sends
