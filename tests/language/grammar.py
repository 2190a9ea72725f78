"""The grammar of LANGUAGE.md: read, checked for holes, turned into a parser and a generator of random programs.

Nothing here is specific to the language; all of it is read from the document.
"""

import re

SIGN = re.compile(r'\s*(?:"(?P<word>[^"]+)"|\?(?P<special>[^?]+)\?|(?P<name>[a-z_]+)|(?P<sign>\.\.|[][(){}|=.]))')
SPECIAL = {
    "space, tab, LF, CR, form feed or vertical tab": r"[ \t\n\r\f\v]",
    "all up to the end of the line": r"[^\n]*",
    "all up to the first": r"(?s:.*?)",
    "any characters but ' and the end of the line": r"[^'\n]*",
}
NO_NAMES_EXCEPT = {"BOOL", "Q", "AFTER", "BY", "FROM", "OFF", "SET", "RESET", "R_TRIG", "F_TRIG", "BLINKING",
                   "CALL", "RETURN"}


class GrammarError(Exception):
    pass


class Reader:
    """EBNF as tuples: ("seq" or "alt", parts), ("opt" or "rep", part), ("word", "ref" or "special", text),
    ("range", first, last)."""

    def __init__(self, text):
        self.signs, at = [], 0
        text = text.rstrip()
        while at < len(text):
            found = SIGN.match(text, at)
            if not found:
                raise GrammarError(f"not EBNF: {text[at:at + 40]!r}")
            self.signs.append((found.lastgroup, found.group(found.lastgroup).strip()))
            at = found.end()
        self.at = 0

    def rules(self):
        rules = {}
        while self.at < len(self.signs):
            name = self.take("name")
            self.take("sign", "=")
            if name in rules:
                raise GrammarError(f"{name} is defined twice")
            rules[name] = self.alternatives()
            self.take("sign", ".")
        return rules

    def take(self, kind, text=None):
        found, value = self.signs[self.at]
        if found != kind or text not in (None, value):
            raise GrammarError(f"{text or kind} expected, {value} found")
        self.at += 1
        return value

    def is_next(self, *signs):
        return self.at < len(self.signs) and self.signs[self.at][0] == "sign" and self.signs[self.at][1] in signs

    def alternatives(self):
        parts = [self.sequence()]
        while self.is_next("|"):
            self.at += 1
            parts.append(self.sequence())
        return parts[0] if len(parts) == 1 else ("alt", parts)

    def sequence(self):
        parts = []
        while not self.is_next("|", ")", "]", "}", "."):
            parts.append(self.part())
        return parts[0] if len(parts) == 1 else ("seq", parts)

    def part(self):
        for start, end, kind in (("(", ")", None), ("[", "]", "opt"), ("{", "}", "rep")):
            if self.is_next(start):
                self.at += 1
                inner = self.alternatives()
                self.take("sign", end)
                return (kind, inner) if kind else inner
        kind, value = self.signs[self.at]
        self.at += 1
        if kind == "word" and self.is_next(".."):
            self.at += 1
            return ("range", value, self.take("word"))
        return ("ref" if kind == "name" else kind, value)


def parts_of(rule):
    yield rule
    if rule[0] in ("seq", "alt"):
        for part in rule[1]:
            yield from parts_of(part)
    elif rule[0] in ("opt", "rep"):
        yield from parts_of(rule[1])


class Token:
    def __init__(self, kind, text, start):
        self.kind, self.text, self.start = kind, text, start

    def __repr__(self):
        return self.text


class Node:
    """A part of a program that is one nonterminal. Its children are nodes and tokens."""

    def __init__(self, kind, children):
        self.kind, self.children = kind, children

    def nodes(self, *kinds):
        return [c for c in self.children if isinstance(c, Node) and (not kinds or c.kind in kinds)]

    def node(self, kind):
        return next(iter(self.nodes(kind)), None)

    def words(self):
        """Its own words, in capitals; not those of its nodes."""
        return [c.text.upper() for c in self.children if isinstance(c, Token)]

    def tokens(self):
        return [t for c in self.children for t in ([c] if isinstance(c, Token) else c.tokens())]

    def text(self):
        return " ".join(t.text for t in self.tokens())


class Grammar:
    def __init__(self, syntax, lexis):
        self.rules, self.lexis = Reader(syntax).rules(), Reader(lexis).rules()
        kinds = [part[1] for part in parts_of(self.lexis["token"]) if part[0] == "ref"]
        self.kinds = [kind for kind in kinds if kind != "symbol"]
        self.patterns = [(kind, re.compile(self.pattern(("ref", kind)), re.IGNORECASE)) for kind in kinds]
        self.gaps = re.compile(f"(?:{self.pattern(('ref', 'gap'))})*", re.IGNORECASE)
        self.words = {p[1] for rule in self.rules.values() for p in parts_of(rule) if p[0] == "word"}
        self.reserved = {w for w in self.words if w[0].isalpha()} - NO_NAMES_EXCEPT

    def holes(self):
        """What is used and not defined, or defined and not used."""
        used = {p[1] for rule in self.rules.values() for p in parts_of(rule) if p[0] == "ref"}
        within = {p[1] for rule in self.lexis.values() for p in parts_of(rule) if p[0] == "ref"}
        missing = (used - set(self.rules) - set(self.kinds)) | (within - set(self.lexis))
        unused = (set(self.rules) - used - {"program"}) | (set(self.lexis) - within - {"token", "gap"})
        return sorted(missing), sorted(unused | (set(self.kinds) - used))

    def pattern(self, rule):
        kind = rule[0]
        if kind == "word":
            return re.escape(rule[1])
        if kind == "range":
            return f"[{rule[1]}-{rule[2]}]"
        if kind == "special":
            return SPECIAL[rule[1]]
        if kind == "ref":
            return f"(?:{self.pattern(self.lexis[rule[1]])})"
        if kind == "seq":
            return "".join(self.pattern(part) for part in rule[1])
        if kind == "alt":
            return f"(?:{'|'.join(self.pattern(part) for part in rule[1])})"
        return f"(?:{self.pattern(rule[1])}){'?' if kind == 'opt' else '*'}"

    def tokens(self, text):
        """None where some characters are no token."""
        at, found = (1 if text.startswith("\ufeff") else 0), []
        while True:
            at = self.gaps.match(text, at).end()
            if at == len(text):
                return found
            matches = [(m.end(), kind) for kind, p in self.patterns if (m := p.match(text, at))]
            if not matches:
                return None
            end, kind = max(matches, key=lambda match: match[0])
            found.append(Token(kind, text[at:end], at))
            at = end

    def parse(self, text):
        """The program as a tree; None if it is none."""
        tokens = self.tokens(text)
        if tokens is None:
            return None
        parser = Parser(self, tokens)
        return parser.tree(("ref", "program"), 0, len(tokens))[0] if parser.whole() else None


class Parser:
    """Where a rule that begins at a token can end: all places, so that no order of alternatives matters."""

    def __init__(self, grammar, tokens):
        self.grammar, self.tokens, self.known = grammar, tokens, {}

    def whole(self):
        return len(self.tokens) in self.ends(("ref", "program"), 0)

    def ends(self, rule, at):
        key = (id(rule) if rule[0] != "ref" else rule[1], at)
        if key not in self.known:
            self.known[key] = self.find_ends(rule, at)
        return self.known[key]

    def is_token(self, rule, at):
        if at == len(self.tokens):
            return False
        token = self.tokens[at]
        if rule[0] == "word":
            return token.kind in ("name", "symbol") and token.text.upper() == rule[1]
        return token.kind == rule[1] and (rule[1] != "name" or token.text.upper() not in self.grammar.reserved)

    def find_ends(self, rule, at):
        kind = rule[0]
        if kind == "word" or (kind == "ref" and rule[1] in self.grammar.kinds):
            return {at + 1} if self.is_token(rule, at) else set()
        if kind == "ref":
            return self.ends(self.grammar.rules[rule[1]], at)
        if kind == "alt":
            return set().union(*(self.ends(part, at) for part in rule[1]))
        if kind == "opt":
            return {at} | self.ends(rule[1], at)
        if kind == "seq":
            places = {at}
            for part in rule[1]:
                places = set().union(*(self.ends(part, place) for place in places))
            return places
        places, open_places = {at}, [at]
        while open_places:
            for end in self.ends(rule[1], open_places.pop()) - places:
                places.add(end)
                open_places.append(end)
        return places

    def tree(self, rule, at, end):
        """Nodes and tokens of `rule` between two places that are in `ends`."""
        kind = rule[0]
        if kind == "word" or (kind == "ref" and rule[1] in self.grammar.kinds):
            return [self.tokens[at]]
        if kind == "ref":
            return [Node(rule[1], self.tree(self.grammar.rules[rule[1]], at, end))]
        if kind == "alt":
            return self.tree(next(part for part in rule[1] if end in self.ends(part, at)), at, end)
        if kind == "opt":
            return [] if at == end else self.tree(rule[1], at, end)
        if kind == "seq":
            return self.sequence(rule[1], at, end)
        found = []
        while at != end:
            place = next(p for p in self.ends(rule[1], at) if p > at and end in self.ends(rule, p))
            found += self.tree(rule[1], at, place)
            at = place
        return found

    def sequence(self, parts, at, end):
        if not parts:
            return []
        rest = ("seq", parts[1:])
        for place in self.ends(parts[0], at):
            if end in self.find_ends(rest, place):
                return self.tree(parts[0], at, place) + self.sequence(parts[1:], place, end)
        raise AssertionError("no such end")
