"""Random small tables and properties."""

IN = [0, 1, 6, 7]  # bits of HW_INP that the tables and properties name


def images():
    result = [0]
    for bit in IN:
        result += [image | 1 << bit for image in result]
    return result


def random_term(rng, steps, moves):
    timer_bit, counter_bit = rng.random() < 0.7, rng.random() < 0.7
    state = rng.randrange(steps) | (0x80 if timer_bit else 0) | (0x40 if counter_bit else 0)
    care = sum(1 << bit for bit in IN if bit != 7 and rng.random() < 0.4)
    wanted = sum(1 << bit for bit in IN if rng.random() < (0.15 if bit == 7 else 0.5))
    if rng.random() < 0.1:
        register = rng.randrange(40, 128) if moves else rng.randrange(1, 128)  # none that moves the motor or stops it
        return bytes([state, wanted, care | 0x80, register, rng.randrange(256), 0, 0, 0])
    next_step = rng.choice([0x3E, *range(steps), *range(steps)])
    counter_preset = rng.random() < 0.5
    preset = rng.choice([0, 0, 1, 2, 3])
    command = 0x61 if rng.random() < 0.2 else 0x80
    if moves and rng.random() < 0.4:
        command = rng.choice([0x40, 0x40, 0x28, 0x65, 0x08, 0x70, 0x48, 0x62, 0x63, 0x64])  # moves, ends of them, other targets
    output = rng.randrange(4) | (0x40 if rng.random() < 0.1 else 0) | (0x80 if rng.random() < 0.3 else 0)
    return bytes([state, wanted, care, next_step | (0x40 if counter_preset else 0), command, output, preset, 0])


def random_table(rng, moves=False):
    steps = rng.randint(2, 5)
    terms = [random_term(rng, steps, moves) for _ in range(rng.randint(steps, 4 * steps))]
    return terms + [bytes([0x3F, 0, 0, 0, 0, 0, 0, 0])], steps


def random_condition(rng, steps, moves=False, depth=2):
    if moves and rng.random() < 0.1:
        return ("moving",)
    if depth == 0 or rng.random() < 0.3:
        return rng.choice([("in", rng.choice(IN)), ("out", rng.randrange(2)), ("timer",), ("counter",),
                           ("step", rng.randrange(steps)), ("step", rng.randrange(steps))])
    kind = rng.choice(["not", "and", "and", "or", "xor"])
    if kind == "not":
        return (kind, random_condition(rng, steps, moves, depth - 1))
    return (kind, random_condition(rng, steps, moves, depth - 1), random_condition(rng, steps, moves, depth - 1))


def text_of(condition):
    kind = condition[0]
    if kind == "in":
        return {6: "INPOS", 7: "ERROR"}.get(condition[1], f"IN{condition[1]}")
    if kind == "out":
        return f"OUT{condition[1]}"
    if kind == "step":
        return f"step = {condition[1]}"
    if kind == "moving":
        return kind
    if kind == "group":
        return "STEP IN G"
    if kind in ("timer", "counter"):
        return f"{kind.upper()}.Q"
    if kind == "not":
        return f"NOT ({text_of(condition[1])})"
    return f"({text_of(condition[1])}) {kind.upper()} ({text_of(condition[2])})"


def text_of_form(form, c, d, e, ms):
    one, two, three = text_of(c), text_of(d), text_of(e)
    return {"never": f"NEVER {one}", "always": f"ALWAYS {one}", "reachable": f"{one} IS REACHABLE",
            "possible": f"ALWAYS POSSIBLE {one}", "whenever": f"WHENEVER {one} THEN {two} WITHIN {ms} ms",
            "after": f"AFTER {two} ALWAYS POSSIBLE {one}", "while": f"NEVER {one} WHILE {two} FOR {ms} ms",
            "only": f"{one} ONLY AFTER {two}", "stays": f"BETWEEN ({one}) AND ({two}) {three} STAYS ON",
            "changes": f"{one} CHANGES ONLY IN {two}", "scan": f"EVERY_SCAN FROM {one} ENDS IN {two}",
            "followed": f"WHENEVER {one} FOLLOWED BY {two} THEN {three}", "from": f"{one} ONLY FROM {two}",
            "both": f"{one} ONLY AFTER {two} FOLLOWED BY {three}"}[form]


BASIC = ["never", "always", "reachable", "possible", "whenever"]
FORMS = [*BASIC, "after", "while", "only", "stays", "changes", "scan", "followed", "from", "both"]


def group_properties(rng, group, steps, first):
    """What the table's steps are called in the program, by numbers of the steps."""
    group = ("group", group)
    chosen = [("never", group), ("possible", group), ("reachable", group), ("always", group), ("scan", group), ("stays", group)]
    result = []
    for number, (form, c) in enumerate(rng.sample(chosen, 2), first):
        d, e = (random_condition(rng, steps) for _ in range(2))
        result.append((form, c, d, 2, f"PROPERTY P{number}: {text_of_form(form, c, d, e, 2)};", e))
    return result


def random_properties(rng, steps, count, forms=tuple(FORMS), moves=False):
    """(form, c, d, milliseconds, text, e)"""
    result = []
    for number in range(count):
        form = rng.choice(forms)
        c, d, e = (random_condition(rng, steps, moves) for _ in range(3))
        ms = rng.choice([1, 2, 5] if form == "while" else [0, 1, 2, 5, 20])
        result.append((form, c, d, ms, f"PROPERTY P{number}: {text_of_form(form, c, d, e, ms)};", e))
    return result
