#!/usr/bin/env python3
"""The grammar of LANGUAGE.md against the parser of seqc, both ways.

Programs made at random from the grammar have no syntax error. Of known programs with a token or character changed,
those that the grammar still allows have no syntax error, and those that it forbids are refused.

usage: grammar_test.py SEQC NANOPLC_SIM LANGUAGE.md EXAMPLES [PROGRAMS [SEED]]
"""

import glob
import os
import random
import sys
import tempfile

import document
import programs
from grammar import NO_NAMES_EXCEPT, parts_of
from values import based
from tools import Tools, is_syntax

NAMES = ["Fast", "Idle", "A1", "P2", "IN0", "OUT3", "STOP", "POSITION", "rpm", "mm", "s", "rev", "Bool", "q", "_x9"]
DURATIONS = {"d": 5, "h": 4, "m": 3, "s": 2, "ms": 1}
CHARACTERS = "ab01_.;:,()=+-/#%* \n\tT'&{\u00e4"


class Maker:
    """Random texts of the grammar."""

    def __init__(self, grammar, rng):
        self.grammar, self.rng = grammar, rng
        self.depths = self.find_depths()
        self.inside = []

    def find_depths(self):
        """The least depth of each rule: where a text grows too deep the shallowest way is taken."""
        depths = {name: 1 if name in self.grammar.kinds else 99 for name in [*self.grammar.rules, *self.grammar.kinds]}
        for _ in self.grammar.rules:
            for name, rule in self.grammar.rules.items():
                depths[name] = min(depths[name], 1 + self.depth(rule, depths))
        return depths

    def depth(self, rule, depths):
        kind = rule[0]
        if kind == "ref":
            return depths[rule[1]]
        if kind in ("seq", "alt"):
            return (max if kind == "seq" else min)([self.depth(part, depths) for part in rule[1]], default=0)
        return 0

    def make(self, rule, room):
        kind, rng = rule[0], self.rng
        if kind == "word":
            return [rule[1] if rng.random() < 0.8 else rule[1].lower()]
        if kind == "ref" and rule[1] in self.grammar.kinds:
            return [self.token(rule[1])]
        if kind == "ref":
            self.inside.append(rule[1])
            made = self.make(self.grammar.rules[rule[1]], room - 1)
            self.inside.pop()
            return made
        if kind == "seq":
            return [text for part in rule[1] for text in self.make(part, room)]
        if kind == "alt":
            fits = [part for part in rule[1] if self.depth(part, self.depths) <= room and not self.is_minus(part)]
            return self.make(rng.choice(fits or [min(rule[1], key=lambda p: self.depth(p, self.depths))]), room)
        fits = self.depth(rule[1], self.depths) <= room
        often = [0, 1] if kind == "opt" else [1, 2, 3, 4, 6] if len(self.inside) <= 3 else [0, 0, 1, 2]
        times = rng.choice(often) if fits else 0
        return [text for _ in range(times) for text in self.make(rule[1], room)]

    def is_minus(self, part):
        """A number below 0 where bytes stand."""
        return "raw_term" in self.inside and part[0] == "seq" and part[1][0] == ("word", "-")

    def token(self, kind):
        if kind == "name" and self.rng.random() < 0.7:
            return self.rng.choice(NAMES)
        if "raw_term" in self.inside:
            return str(self.rng.randrange(256)) if kind == "number" else f"16#{self.rng.randrange(256):X}"
        while True:
            text = self.characters(self.grammar.lexis[kind])
            if keeps_limits(kind, text) and text.upper() not in self.grammar.reserved:
                return text

    def characters(self, rule):
        kind = rule[0]
        if kind == "word":
            return rule[1]
        if kind == "range":
            return chr(self.rng.randint(ord(rule[1]), ord(rule[2])))
        if kind == "ref":
            return self.characters(self.grammar.lexis[rule[1]])
        if kind == "special":
            return "the clamp must hold; (* why *)"
        if kind == "seq":
            return "".join(self.characters(part) for part in rule[1])
        if kind == "alt":
            return self.characters(self.rng.choice(rule[1]))
        return "".join(self.characters(rule[1]) for _ in range(self.rng.randint(0, 1 if kind == "opt" else 3)))

    def program(self):
        texts = self.make(("ref", "program"), self.rng.randint(9, 15))
        gaps = [" ", " ", " ", "\n", "\t", " // a remark; IF\n", "(* two\nlines *)", " (**) "]
        return "".join(text + self.rng.choice(gaps) for text in texts)


def keeps_limits(kind, text):
    """The document's rules beside the grammar: 32 bits; the units of a time from the largest down, each once."""
    if kind == "based":
        return based(text) < 2 ** 32
    if kind == "time":
        units, word = [], ""
        for c in text.split("#")[1].lower() + "0":
            if c.isalpha():
                word += c
            elif word:
                units.append(DURATIONS[word])
                word = ""
        return all(a > b for a, b in zip(units, units[1:]))
    return True


def is_a_program(grammar, text):
    tree = grammar.parse(text)
    if tree is None or not all(keeps_limits(token.kind, token.text) for token in tree.tokens()):
        return False
    return all(is_byte(node.text().replace(" ", ""))
               for raw in nodes_of(tree, "raw_term") for node in raw.nodes("whole"))


def nodes_of(tree, kind):
    for node in tree.nodes():
        if node.kind == kind:
            yield node
        yield from nodes_of(node, kind)


def is_byte(text):
    return 0 <= (based(text.lstrip("+")) if "#" in text else float(text.replace("_", ""))) <= 255


def changed(grammar, text, rng):
    """`text` with a token or a character taken out, put in, doubled, exchanged."""
    tokens = grammar.tokens(text)
    at = rng.randrange(len(tokens))
    here, other = tokens[at], rng.choice(tokens)
    after = here.start + len(here.text)
    if rng.random() < 0.3:
        at = rng.randrange(len(text))
        return text[:at] + rng.choice(["", rng.choice(CHARACTERS)]) + text[at + rng.randint(0, 1):]
    kind = rng.randrange(5)
    if kind == 0:
        return text[:here.start] + text[after:]
    if kind == 1:
        return text[:after] + " " + here.text + " " + text[after:]
    if kind == 2:
        return text[:here.start] + other.text + text[after:]
    if kind == 3:
        return text[:here.start] + other.text + " " + text[here.start:]
    word = rng.choice(sorted(grammar.words))
    return text[:here.start] + word + " " + text[here.start if rng.random() < 0.5 else after:]


# The grammar does not know what a name stands for: a command, a register or an output.
NO_COMMANDS = {f"there is no '{word}' in this language" for word in NO_NAMES_EXCEPT}
NO_COMMANDS.add("':=' gives a register a number: it switches nothing")


class Trial:
    def __init__(self, tools, grammar, rng, known):
        self.tools, self.grammar, self.rng, self.known = tools, grammar, rng, known
        self.allowed = 0

    def made(self):
        text = Maker(self.grammar, self.rng).program()
        if not is_a_program(self.grammar, text):
            return f"the grammar makes it and does not take it:\n{text}"
        return self.syntax_errors(text)

    def syntax_errors(self, text):
        said = [d for d in self.tools.build(text) if is_syntax(d) and d["message"] not in NO_COMMANDS]
        return f"{said[0]['line']}:{said[0]['column']}: {said[0]['code']} {said[0]['message']}:\n{text}" if said else ""

    def mutated(self):
        text = changed(self.grammar, self.rng.choice(self.known), self.rng)
        if is_a_program(self.grammar, text):
            self.allowed += 1
            return self.syntax_errors(text)
        errors = [d for d in self.tools.build(text) if d["severity"] == "error"]
        return "" if errors else f"the grammar forbids it and seqc takes it:\n{text}"


def uses_all(grammar, rng):
    """Every rule and word of the grammar occurs in what Maker makes."""
    seen = " ".join(Maker(grammar, rng).program().upper() for _ in range(600))
    return [word for rule in grammar.rules.values() for part in parts_of(rule) if part[0] == "word"
            for word in [part[1]] if word not in seen]


def main():
    seqc, nanoplc_sim, language, examples = sys.argv[1:5]
    count = int(sys.argv[5]) if len(sys.argv) > 5 else 300
    seed = int(sys.argv[6]) if len(sys.argv) > 6 else random.SystemRandom().randrange(10 ** 9)
    print(f"{count} programs of each kind from seed {seed} on", flush=True)
    doc = document.Document(language)
    known = [document.read(path) for path in sorted(glob.glob(os.path.join(examples, "*.seq")))]
    known += [example.program for example in doc.examples]
    failures = [f"never made: {word}" for word in uses_all(doc.grammar, random.Random(1))]
    allowed = 0
    with tempfile.TemporaryDirectory() as folder:
        tools = Tools(seqc, nanoplc_sim, folder)
        for number in range(seed, seed + count):
            rng = random.Random(number)
            trial = Trial(tools, doc.grammar, rng, known + [programs.program(rng)])
            failures += [f"seed {number}: {f}" for f in (trial.made(), trial.mutated(), trial.mutated()) if f]
            allowed += trial.allowed
    for failure in failures[:10]:
        print(failure)
    print(f"{len(failures)} failures; {allowed} of {2 * count} changed programs are still in the grammar")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
