"""What LANGUAGE.md holds besides its sentences: examples, the tables of their scans, the grammar, commands."""

import re

import grammar
from expand import Expander
from meaning import Program

BLOCK = re.compile(r"(?m)((?:^    .*\n)+)")
MARK = "// the example"
OUTPUTS = ("OUT0", "OUT1", "OUT2", "OUT3")


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


class Example:
    """A program with the messages that the compiler must give, and the scans that are printed below it."""

    def __init__(self, text, program, first_line):
        self.text, self.program, self.first_line = text, program, first_line
        self.scans = []

    def said(self):
        """(line, code) of each comment with a code, lines as in `program`."""
        return sorted((self.first_line + number, code) for number, line in enumerate(self.text.split("\n"))
                      for code in re.findall(r"// .*?\b([EW]\d{3})\b", line))


    def verdicts(self):
        """{property: verdict} of each comment with one."""
        return dict(re.findall(r"(?m)^ *PROPERTY (\w+):.*// (proved|broken|undecided)$", self.text))


class Document:
    def __init__(self, path):
        self.text = read(path)
        self.blocks = [re.sub(r"(?m)^    ", "", block).strip("\n") for block in BLOCK.findall(self.text)]
        rules = [block for block in self.blocks if re.match(r"[a-z]+ +=", block)]
        if len(rules) != 2:
            raise AssertionError("the grammar stands in two blocks: tokens to programs, characters to tokens")
        self.grammar = grammar.Grammar(*rules)
        self.frame = next(block for block in self.blocks if MARK in block)
        self.examples = []
        self.files = {}
        for block in (b for b in self.blocks if b not in rules):
            if name := re.match(r"\(\* (\S+\.seqi) \*\)\n", block):
                self.files[name[1]] = block + "\n"
            elif re.match(r"PROGRAM\b", block):
                self.examples.append(Example(block, block + "\n", 1))
            elif re.match(r"(STEP|POWER_UP|ON|GROUP|VAR_\w+|TERM)\b", block):
                before = self.frame[:self.frame.index(MARK)].count("\n")
                self.examples.append(Example(block, self.frame.replace(MARK, block) + "\n", before + 1))
            elif "|" in block.split("\n")[0]:
                self.examples[-1].scans = scans(block)
            else:
                raise AssertionError(f"neither program, scans nor grammar:\n{block}")

    def included(self, text):
        """A program with its files in the place of INCLUDE, each once."""
        seen = set()

        def put(found):
            is_new = found[1] not in seen
            seen.add(found[1])
            return self.files[found[1]] if is_new else ""

        return re.sub(r"INCLUDE '([^']*)';", put, text)

    def program(self, tree, register_map, command_bytes):
        """What a program means; its sequences are put in the place of their calls first."""
        expander = Expander(tree)
        if expander.has_calls():
            tree = self.grammar.parse(expander.program())
        return Program(tree, register_map, command_bytes)

    def command_bytes(self):
        """Name -> byte of the commands that select nothing, from the table of section 8."""
        found = {}
        for names, numbers in re.findall(r"(?m)^\| (`[^|]+`) \| ([0-9A-F]{2}h[^|]*) \|", self.text):
            names, numbers = re.findall(r"`([^`]+)`", names), re.findall(r"([0-9A-F]{2})h", numbers)
            if len(names) == len(numbers) and "+ r" not in names[0]:
                found.update(zip(names, (int(number, 16) for number in numbers)))
        first, last = found.pop("USE_SET(1)"), found.pop("USE_SET(4)")
        found.update({f"USE_SET({n})": first + n - 1 for n in range(1, last - first + 2)})
        return found


def scans(block):
    """[({column: cell}, {column: cell})] of a table: what a scan reads, what holds after it."""
    header, *lines = block.split("\n")
    left, right = (half.split() for half in header.split("|"))
    rows = []
    for line in lines:
        read_half, after_half = (half.split() for half in line.split("|"))
        after = dict(zip(right, after_half))
        if right[-1] == "sends":
            after["sends"] = after_half[len(right) - 1:]
        rows.append((dict(zip(left, read_half)), after))
    return rows
