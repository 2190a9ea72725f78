"""SEQUENCE and CALL as LANGUAGE.md section 4 says: the program without them, as a text of the same language."""


class Expander:
    def __init__(self, tree):
        self.tree = tree
        self.sequences = {}
        self.instances, self.pending, self.steps = {}, [], {}
        for item in tree.nodes("item"):
            for node in item.nodes("sequence"):
                self.sequences[node.words()[1]] = node
            for node in item.nodes("step"):
                self.steps[node.words()[1]] = True

    def has_calls(self):
        return bool(self.sequences)

    def program(self):
        """The text: sequences gone, the steps of each call behind the program's."""
        lines = ["PROGRAM " + self.tree.words()[1]]
        items = [item for item in self.tree.nodes("item") if not item.nodes("sequence")]
        done = {id(item): self.body(item, (), {}) for kind in ("power_up", "step") for item in items if item.nodes(kind)}
        lines += [done.get(id(item)) or self.body(item, (), {}) for item in items]
        for instance in self.pending:
            lines += [self.body(step, *instance[1:]) for step in instance[0].nodes("step")]
        return "\n".join([*lines, "END_PROGRAM"])

    def body(self, node, callers, names):
        """A node's text with what stands for its names; statements of one branch stand side by side."""
        texts, run = [], []
        for child in [*node.children, None]:
            inner = child.nodes("statement") if getattr(child, "kind", "") == "part" else []
            if inner or getattr(child, "kind", "") == "statement":
                run.append(inner[0] if inner else child)
                continue
            texts += self.statements(run, callers, names)
            run = []
            if hasattr(child, "children"):
                texts.append(self.body(child, callers, names))
            elif child is not None:
                texts.append(self.named(child, names))
        return " ".join(texts)

    def statements(self, run, callers, names):
        call = next((s for s in run if s.words()[:1] == ["CALL"]), None)
        texts = []
        for statement in run:
            words = statement.words()
            if statement is call:
                continue
            if statement.text().upper() == "RETURN ;":
                texts.append(f"NEXT := {names['RETURN']} ;")
            elif statement.node("next") and call:
                back = self.named_word(statement.node("next").words()[2], names)
                texts.append(f"NEXT := {self.instance(call, back, callers, names)} ;")
            else:
                texts.append(self.body(statement, callers, names))
        return texts

    def instance(self, call, back, callers, names):
        """The name of the first step of the call."""
        name = call.words()[1]
        sequence = self.sequences[name]
        given = [self.body(node, callers, names) for node in call.nodes("given")]
        key = (name, back, *given)
        if key not in self.instances:
            own = {}
            for parameter, text in zip(sequence.nodes("parameter"), given):
                is_value = parameter.words()[0] == "CONST"
                own[parameter.words()[1]] = f"({text})" if is_value else text
            for step in sequence.nodes("step"):
                own[step.words()[1]] = self.free(f"{name}_{step.words()[1]}")
            own["RETURN"] = back
            self.instances[key] = own[sequence.nodes("step")[0].words()[1]]
            self.pending.append((sequence, (*callers, name), own))
        return self.instances[key]

    def free(self, wanted):
        name, number = wanted, 2
        while name in self.steps:
            name, number = f"{wanted}_{number}", number + 1
        self.steps[name] = True
        return name

    def named(self, token, names):
        return self.named_word(token.text, names) if token.kind == "name" else token.text

    @staticmethod
    def named_word(word, names):
        return names.get(word.upper(), word) if word.upper() != "RETURN" else word
