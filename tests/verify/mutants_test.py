"""Programs with one term changed: what a random rehearsal breaks, seqc verify must call broken.

usage: mutants_test.py SEQC NANOPLC_SIM MUTANTS_EACH SEED PROGRAM...

Judged are the program's own properties that look at no time, and what the rehearsals of the program as it is suggest: which
outputs a step has, which steps follow it, and at which inputs. Only those that verify proves of the program are asked of its mutants.
"""

import json
import os
import random
import re
import subprocess
import sys
import tempfile

import naive
import programs

COURSES, SCANS = 3, 250
STAY = 0x3E  # no next step
ERROR = 0x80  # in HW_INP; compared in each term. In the mask this bit says FlexMAC
SIGNALS = [*(f"IN{i}" for i in range(6)), "INPOS", "ERROR"]
TOKEN = re.compile(r"T#[\w.]+|%[IQ]X0\.\d|[A-Za-z_]\w*|\d+|\S")
PRIMARY = r"((?:NOT )*(?:STEP = \d+|\w+|\( [^()]* \)))"
FORMS = {
    "scan": re.compile(r"EVERY_SCAN FROM (.+) ENDS IN (.+)"),
    "only": re.compile(r"(.+) ONLY AFTER (.+)"),
    "changes": re.compile(r"(.+) CHANGES ONLY IN (.+)"),
    "stays": re.compile(rf"BETWEEN {PRIMARY} AND {PRIMARY} (.+) STAYS (?:ON|OFF)"),
    "followed": re.compile(r"WHENEVER (.+) FOLLOWED BY (.+) THEN (.+)"),
    "whenever": re.compile(r"WHENEVER (.+) THEN (.+)"),
    "reachable": re.compile(r"(.+) IS REACHABLE"),
    "never": re.compile(r"NEVER (.+)"),
    "always": re.compile(r"ALWAYS (?!POSSIBLE)(.+)"),
}
NOT_JUDGED = {"WITHIN", "FOR", "WHILE", "TIMER", "MOVING", "POSSIBLE"}


class Property:
    """A property in the words of a bare table."""

    def __init__(self, name, text):
        self.name, self.text = name, text
        self.form = next(f for f, pattern in FORMS.items() if pattern.fullmatch(text))
        self.conditions = [compiled(c) for c in FORMS[self.form].fullmatch(text).groups()]

    def seen_in(self, scans):
        """Whether a course breaks the property; for IS REACHABLE, whether it gets there."""
        values = [[condition(s) for condition in self.conditions] for s in scans]
        ones = [v[0] for v in values]
        if self.form in ("never", "reachable"):
            return any(ones)
        if self.form == "always":
            return not all(ones)
        if self.form == "whenever":
            return any(c and not d for c, d in values)
        if self.form == "followed":
            return any(before[0] and d and not e for before, (_, d, e) in zip(values, values[1:]))
        if self.form == "only":
            first = next((i for i, v in enumerate(values) if v[1]), len(values))
            return any(ones[:first])
        if self.form == "changes":
            off = [condition(OFF) for condition in self.conditions]
            return any(x != before[0] and not c and not before[1]
                       for before, (x, c) in zip([off, *values], values))
        if self.form == "scan":
            begins, ends = self.conditions
            return any(begins({**before, "image": s["image"]}) and not ends(s)
                       for before, s in zip([OFF, *scans], scans))
        within, wanted = False, self.text.endswith("ON")
        for begins, ends, stays in values:
            within = (within or begins) and not ends
            if within and stays != wanted:
                return True
        return False


def compiled(text):
    """A condition as a function of a scan. Python's ~ & ^ | bind as NOT AND XOR OR do; bit 0 is the truth."""
    code = re.sub(r"STEP = (\d+)", r"(0 + (s['step'] == \1))", text)
    for pattern, value in ((r"\bNOT\b", "~"), (r"\bAND\b", "&"), (r"\bXOR\b", "^"), (r"\bOR\b", "|"),
                           (r"\bTRUE\b", "1"), (r"\bFALSE\b", "0"), (r"\bINPOS\b", "(s['image'] >> 6)"),
                           (r"\bERROR\b", "(s['image'] >> 7)"), (r"COUNTER \. Q", "(0 + (s['counter'] == 0))"),
                           (r"\bIN(\d)\b", r"(s['image'] >> \1)"), (r"\bOUT(\d)\b", r"(s['outputs'] >> \1)")):
        code = re.sub(pattern, value, code)
    code = compile(code, text, "eval")
    return lambda s: bool(eval(code, {"s": s}) & 1)  # pylint: disable=eval-used


OFF = {"step": 0, "counter": 0, "outputs": 0, "image": 0}


def bare(text, symbols):
    """The text of a property with the numbers of a bare table for the names of its program."""
    steps = {s["name"].upper(): s["number"] for s in symbols["steps"]}
    signals = {name.upper(): f"{kind}{i}" for kind, names in (("IN", symbols["inputs"]), ("OUT", symbols["outputs"]))
               for i, name in enumerate(names) if name}
    result = []
    for token in (t.upper() for t in TOKEN.findall(text)):
        direct = re.fullmatch(r"%([IQ])X0\.(\d)", token)
        if result[-2:] == ["STEP", "="]:
            token = str(steps.get(token, token))
        elif direct:
            token = ("IN" if direct.group(1) == "I" else "OUT") + direct.group(2)
        result.append(signals.get(token, token))
    return " ".join(result)


class Bench(programs.Programs):
    courses_replayed = 0

    def build(self, program):
        """Terms, names and own properties."""
        table = self.path("program.bin")
        subprocess.run([self.seqc, "build", program, "--quiet", "-o", table], check=True)
        with open(table, "rb") as file:
            content = file.read()
        with open(self.path("program.sym"), encoding="utf-8") as file:
            symbols = json.load(file)
        with open(program, encoding="utf-8") as file:
            source = re.sub(r"//[^\n]*|\(\*.*?\*\)|/\*.*?\*/", " ", file.read(), flags=re.S)
        texts = [(name, bare(text, symbols)) for name, text in
                 re.findall(r"\bPROPERTY\s+(\w+)\s*:(.*?);", source, flags=re.S | re.I)]
        return ([content[i:i + 8] for i in range(0, len(content) - 8, 8)],
                [Property(name, text) for name, text in texts if not NOT_JUDGED & set(text.split())],
                len(texts))

    def write(self, terms):
        self.path("m.bin", b"".join(terms) + bytes([0x3F, 0, 0, 0, 0, 0, 0, 0]))

    def rehearse(self, terms, rng):
        """Courses of what is so after each scan."""
        self.write(terms)
        return [self.play(stimulus(terms, rng)) for _ in range(COURSES)]

    def play(self, rows):
        lines = ["dt_ms,inputs,inpos,error"] + [f"{dt},{i & 0x3F},{i >> 6 & 1},{i >> 7}" for dt, i in rows]
        done = subprocess.run([self.nanoplc_sim, "scan", self.path("m.bin"), "--stimulus",
                               self.path("s.csv", ("\n".join(lines) + "\n").encode())],
                              capture_output=True, text=True, check=True)
        scans = [line.split(",") for line in done.stdout.split("\n")[1:-1]]
        return [{"step": int(s[1]), "counter": int(s[3]), "outputs": int(s[4]), "image": image}
                for s, (_, image) in zip(scans, rows, strict=True)]

    def verify(self, properties):
        """Names and verdicts, of the table that was rehearsed last."""
        text = "".join(f"PROPERTY {p.name}: {p.text};\n" for p in properties)
        done = subprocess.run([self.seqc, "verify", self.path("m.bin"), "--assume", "any", "--json", "--property",
                               self.path("m.prop", text.encode())],
                              capture_output=True, text=True, check=False)
        assert done.returncode in (0, 1, 4), f"exit code {done.returncode}: {done.stderr}"
        document = json.loads(done.stdout)
        self.courses_replayed += self.replay_all(self.path("m.bin"), document)
        return {r["name"]: r["verdict"] for r in document["results"] if "code" not in r}


def stimulus(terms, rng):
    """Times and images: now what some term of the step waits for, now anything, now what it was."""
    rows, image, state = [], 0, (0, 0, 0, 0)
    for _ in range(SCANS):
        term = rng.choice([t for t in terms if t[0] & 0x3F == state[0]] or terms)
        cared = (term[2] & 0x7F) | ERROR
        choice = rng.random()
        if choice < 0.4:
            image = image & ~cared | term[1] & cared
        elif choice < 0.6:
            image = rng.randrange(128)
        elif choice < 0.7:
            image ^= 1 << rng.randrange(7)
        if rng.random() < 0.7:
            image &= ~ERROR
        rows.append((rng.choice([0, 1, 2, 10, 100, 1000, 10000]), image))
        step, outputs, timer, counter = naive.scan(terms, state, image)
        state = step, outputs, max(0, timer - rows[-1][0]), counter
    return rows


def mutant(terms, rng):
    """The table with one bit or field of one term changed, and what that was."""
    at = rng.randrange(len(terms))
    term = bytearray(terms[at])
    flexmac = term[2] & 0x80
    fields = ["timer", "counter", "value", "mask"]
    fields += ["flexmac"] if flexmac else ["next", "command", "output", "preset", "purpose"]
    field = rng.choice(fields)
    if field in ("timer", "counter"):
        term[0] ^= 0x80 if field == "timer" else 0x40
    elif field == "value":
        cared = (term[2] & 0x7F) | ERROR
        term[1] ^= rng.choice([1 << bit for bit in range(8) if cared >> bit & 1])
    elif field == "mask":
        term[2] ^= 1 << rng.randrange(7)
    elif field == "flexmac":
        term[rng.randrange(4, 8)] ^= 1 << rng.randrange(8)
    elif field == "next":
        term[3] = term[3] & 0xC0 | rng.choice(sorted({STAY, *(t[0] & 0x3F for t in terms)}))
    elif field == "command":
        term[4] = rng.choice([0x80, *(t[4] for t in terms if not t[2] & 0x80)])
    elif field == "output":
        term[5] ^= 1 << rng.choice([0, 1, 2, 3, 6, 7])
    elif field == "preset":
        term[6:8] = rng.choice([0, 1, 3, 500]).to_bytes(2, "little")
    else:
        term[3] ^= 0x40
    return [*terms[:at], bytes(term), *terms[at + 1:]], f"term {at}, {field}"


def suggested(courses):
    """Properties that hold in these courses: which outputs a step has, what follows it, and at which inputs."""
    outputs, following, images = {}, {}, {}
    for course in courses:
        for before, scan in zip(course, course[1:]):
            outputs[scan["step"]] = outputs.get(scan["step"], 0) | scan["outputs"]
            following.setdefault(before["step"], set()).add(scan["step"])
            images.setdefault((before["step"], scan["step"]), set()).add(scan["image"])
    result = [Property(f"Outputs_{step}", f"NEVER STEP = {step} AND ( " +
                       " OR ".join(f"OUT{i}" for i in range(4) if not seen >> i & 1) + " )")
              for step, seen in outputs.items() if seen != 0x0F]
    result += [Property(f"Follows_{step}", f"WHENEVER STEP = {step} FOLLOWED BY TRUE THEN " +
                        " OR ".join(f"STEP = {s}" for s in sorted(after)))
               for step, after in following.items()]
    return result + [Property(f"Needs_{a}_{b}_{bit}", f"WHENEVER STEP = {a} FOLLOWED BY STEP = {b} THEN "
                              + ("" if levels == {1} else "NOT ") + signal)
                     for (a, b), seen in images.items() for bit, signal in enumerate(SIGNALS)
                     if len(levels := {image >> bit & 1 for image in seen}) == 1]


def seen_states(courses):
    """Each state of the courses, as a property that it can be reached."""
    states = {(s["step"], s["outputs"], s["counter"] == 0) for course in courses for s in course}
    return [Property(f"Seen_{step}_{outputs}_{int(zero)}", f"STEP = {step} AND " +
                     " AND ".join(("" if outputs >> i & 1 else "NOT ") + f"OUT{i}" for i in range(4)) +
                     (" AND COUNTER . Q" if zero else " AND NOT COUNTER . Q") + " IS REACHABLE")
            for step, outputs, zero in states]


def held_against(properties, courses, verdicts):
    """Names of the properties that a course broke. Verify must not say otherwise."""
    broken = []
    for p in properties:
        if any(p.seen_in(course) for course in courses):
            expected = "proved" if p.form == "reachable" else "broken"
            assert verdicts[p.name] == expected, f"{p.name}: {p.text}: rehearsed, but {verdicts[p.name]}"
            broken += [p.name] if p.form != "reachable" else []
    return broken


def check_program(bench, program, count, rng):
    terms, own, all_own = bench.build(program)
    courses = bench.rehearse(terms, rng)
    properties = own + suggested(courses)
    states = seen_states(courses)
    verdicts = bench.verify(properties + states)
    held_against(properties + states, courses, verdicts)
    asked = [p for p in properties if verdicts[p.name] == "proved"]
    made, tries, broke, caught = {tuple(terms)}, 0, 0, 0
    while len(made) <= count:
        changed, what = mutant(terms, rng)
        tries += 1
        assert tries < 100 * count, f"{program}: too few mutants"
        if tuple(changed) in made:
            continue
        made.add(tuple(changed))
        courses = bench.rehearse(changed, rng)
        try:
            verdicts = bench.verify(asked)
            broke += bool(held_against(asked, courses, verdicts))
        except AssertionError:
            print(f"{program}: {what}\n" + "\n".join(t.hex(" ") for t in changed))
            raise
        caught += "broken" in verdicts.values()
    own_asked = sum(p in asked for p in own)
    print(f"{os.path.basename(program)}: {len(states)} states seen; {count} mutants, {broke} broke a property in rehearsal, "
          f"{caught} broken by verify; properties: {own_asked} of {all_own} own, {len(asked) - own_asked} suggested")
    return count, broke, caught


def main():
    seqc, nanoplc_sim, count, seed = sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4])
    print(f"seed {seed}")
    totals = [0, 0, 0]
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(seqc, nanoplc_sim, folder)
        for program in sys.argv[5:]:
            rng = random.Random(f"{seed} {os.path.basename(program)}")
            totals = [a + b for a, b in zip(totals, check_program(bench, program, count, rng))]
    print(f"{totals[0]} mutants; {totals[1]} broke a property in rehearsal, verify called all of them broken, and {totals[2]} in all; "
          f"{bench.courses_replayed} courses of verify's came to the same end in nanoplc-sim scan")
    assert totals[1] > 0


if __name__ == "__main__":
    main()
