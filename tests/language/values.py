"""Constants and arithmetic of LANGUAGE.md section 8. A value is a fraction with its unit; times are in ms."""

from fractions import Fraction

TIME = {"ms": 1, "s": 1000, "m": 60000, "h": 3600000, "d": 86400000}


class Value:
    def __init__(self, number, unit="", is_bits=False):
        self.number, self.unit, self.is_bits = Fraction(number), unit.lower(), is_bits

    def as_time(self):
        return Value(self.number * TIME[self.unit], "ms") if self.unit in ("ms", "s") else self


def based(text):
    base, digits = text.split("#")
    return int(digits.replace("_", ""), int(base))


def milliseconds(text):
    """Of T#1s500ms."""
    total, number, unit = Fraction(0), "", ""
    for c in text.split("#")[1].lower().replace("_", "") + "0":
        if unit and not c.isalpha():
            total, number, unit = total + Fraction(number) * TIME[unit], "", ""
        if c.isalpha():
            unit += c
        else:
            number += c
    return total


def amount(node):
    tokens = [t.text for t in node.tokens()]
    sign = -1 if tokens[0] == "-" else 1
    number, *unit = tokens[1:] if tokens[0] in "+-" else tokens
    if number.upper().startswith("T"):
        return Value(milliseconds(number), "ms")
    if "#" in number:
        return Value(based(number), is_bits=True)
    return Value(sign * Fraction(number.replace("_", "")), "".join(unit))


class Reckoner:
    """`constants` by capital name; `named(name)` and `part(name, value)` are the bits of a register's own names."""

    def __init__(self, constants, named=None, part=None):
        self.constants, self.named, self.part = constants, named, part

    def value(self, node):
        kind = {"value": self.sum, "product_value": self.product, "factor_value": self.factor,
                "named_value": self.name, "amount": self.amount}
        return kind[node.kind](node)

    def amount(self, node):
        value = amount(node)
        head, _, last = value.unit.rpartition("/")
        if head and last.upper() in self.constants:
            return Value(value.number / self.constants[last.upper()].number, head)
        return value

    def name(self, node):
        name = node.words()[0]
        if "=" in node.words():
            chosen = node.words()[2] if len(node.words()) > 2 else int(amount(node.node("amount")).number)
            return Value(self.part(name, chosen), is_bits=True)
        return self.constants[name] if name in self.constants else Value(self.named(name), is_bits=True)

    def factor(self, node):
        value = self.value(node.nodes()[0])
        return Value(-value.number, value.unit) if node.words()[:1] == ["-"] else value

    def sum(self, node):
        total, *others = [self.value(part) for part in node.nodes()]
        for sign, other in zip([w for w in node.words() if w in "+-"], others):
            if total.is_bits:
                total = Value(int(total.number) | int(other.number), is_bits=True)
                continue
            total, other = total.as_time(), other.as_time()
            assert total.unit == other.unit, "E045"
            total = Value(total.number + (other.number if sign == "+" else -other.number), total.unit)
        return total

    def product(self, node):
        first, *others = node.nodes()
        total = self.value(first)
        for sign, part in zip([w for w in node.words() if w in "*/"], others):
            name = part.text().upper()
            if sign == "/" and total.unit and name.isidentifier() and name not in self.constants:
                total.unit += f"/{name.lower()}"        # a unit is as long as it can be
                continue
            other = self.value(part)
            if sign == "*":
                total = Value(total.number * other.number, total.unit or other.unit)
            else:
                total = Value(total.number / other.number, "" if total.unit == other.unit else total.unit)
        return total
