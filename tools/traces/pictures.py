"""The picture of a trace: steps, inputs, outputs, position and speed over time."""

from traces.formats import Canvas

RIGHT, TOP, WIDTH = 20, 34, 960
BAND, ROW, PLOT, GAP = 26, 18, 130, 16
LETTER = 0.6  # of a text's size: what a letter takes in usual fonts
SMALL = 10
NAME_ROW = 13
MOST_NAME_ROWS = 24
STEP_COLOURS = ("#dbe9f6", "#fde7cf", "#dff0d8", "#f6dbe6", "#e6e0f3", "#f3f0d5")


def step_of(span, most):
    """1, 2 or 5 times a power of ten: the least of which at most `most` go into the span."""
    power = 1e-9
    while True:
        for digit in (1, 2, 5):
            if span / (digit * power) <= most:
                return digit * power
        power *= 10


class Picture:
    def __init__(self, trace, step_names, signal_names, units):
        self.trace = trace
        self.step_names = step_names
        self.signal_names = signal_names
        self.units = units
        self.start = trace[0]["time_ms"]
        self.span = max(trace[-1]["time_ms"] - self.start, 1e-9)
        self.canvas = Canvas(WIDTH)
        self.left = max([130] + [16 + LETTER * 12 * len(name) for name in signal_names.values()])
        self.y = TOP

    def x(self, time_ms):
        return self.left + (time_ms - self.start) / self.span * (WIDTH - self.left - RIGHT)

    def runs(self, value_of):
        """(value, from, to) of each stretch in which a value stays."""
        begin = self.trace[0]
        for row in self.trace[1:]:
            if value_of(row) != value_of(begin):
                yield value_of(begin), begin["time_ms"], row["time_ms"]
                begin = row
        yield value_of(begin), begin["time_ms"], self.trace[-1]["time_ms"]

    def steps(self):
        self.canvas.text(self.left - 8, self.y + 17, "step", "end")
        short = []
        for step, begin, end in self.runs(lambda row: int(row["step"])):
            x, width = self.x(begin), self.x(end) - self.x(begin)
            self.canvas.rectangle(x, self.y, width, BAND, STEP_COLOURS[step % len(STEP_COLOURS)], "#888")
            name = self.step_names.get(step, str(step))
            if width > 12 * LETTER * len(name):
                self.canvas.text(x + width / 2, self.y + 17, name, "middle")
            else:
                short.append((x + width / 2, name))
        self.y += BAND
        self.name_short_steps(short)
        self.y += GAP

    def name_short_steps(self, short):
        """Below the band, each with a line to its step, none through a name."""
        placed = []  # (x, from, to, row)
        unnamed = 0
        for x, name in reversed(short):
            width = LETTER * SMALL * len(name) + 4
            row = self.row_for(placed, x, x + width)
            if row is None:
                unnamed += 1
                continue
            placed.append((x, x + width, row))
            y = self.y + (row + 1) * NAME_ROW
            self.canvas.width = max(self.canvas.width, round(x + width + 4))
            self.canvas.line([(x, self.y), (x, y)], "#bbb", 0.7)
            self.canvas.text(x + 3, y, name, size=SMALL)
        rows = 1 + max((row for _, _, row in placed), default=-1)
        if unnamed:
            self.canvas.text(self.left - 8, self.y + NAME_ROW, f"{unnamed} more", "end", "#777", SMALL)
            rows = max(rows, 1)
        self.y += rows * NAME_ROW + (4 if rows else 0)

    @staticmethod
    def row_for(placed, begin, end):
        """The highest that has room, below the lines to names on the right of it."""
        for row in range(MOST_NAME_ROWS):
            if not any(b < end and row <= r for b, _, r in placed):
                return row
        return None

    def levels(self, field, count, label):
        for bit in range(count):
            value_of = lambda row, b=bit: (int(row[field]) >> b) & 1
            stretches = list(self.runs(value_of))
            if len(stretches) == 1 and stretches[0][0] == 0:
                continue
            name = f"{label}{bit}" if count > 1 else label
            self.canvas.text(self.left - 8, self.y + 13, self.signal_names.get(name, name), "end")
            points = []
            for level, begin, end in stretches:
                y = self.y + (2 if level else ROW - 4)
                points += [(self.x(begin), y), (self.x(end), y)]
            self.canvas.line(points, "#2b6")
            self.y += ROW

    def curve(self, field, label, colour):
        factor, unit = self.units.get(field, (1, {"p_ist": "counts", "v_ist": "counts/sample"}[field]))
        self.y += GAP / 2
        values = [row[field] * factor for row in self.trace]
        low, high = min(values + [0]), max(values + [0])
        high = high if high > low else low + 1
        y = lambda value: self.y + PLOT - (value - low) / (high - low) * PLOT
        self.canvas.text(8, self.y + PLOT / 2 - 8, label, colour=colour)
        self.canvas.text(8, self.y + PLOT / 2 + 8, unit, colour=colour)
        tick = step_of(high - low, 5)
        for number in range(round(-(-low // tick)), int(high // tick) + 1):
            self.canvas.text(self.left - 8, y(number * tick) + 4, f"{number * tick:g}", "end", "#777", SMALL)
            self.canvas.line([(self.left, y(number * tick)), (WIDTH - RIGHT, y(number * tick))], "#ccc" if number == 0 else "#eee", 1)
        kept = [(row["time_ms"], now) for row, before, now, after in
                zip(self.trace, [None] + values, values, values[1:] + [None]) if not before == now == after]
        self.canvas.line([(self.x(time), y(value)) for time, value in kept], colour)
        self.y += PLOT + GAP / 2

    def axis(self):
        tick_ms = step_of(self.span, 12)
        behind = []
        for number in range(round(-(-self.start // tick_ms)), int((self.start + self.span) // tick_ms) + 1):
            x = self.x(number * tick_ms)
            behind.append(("line", [(x, TOP), (x, self.y)], "#eee", 1))
            self.canvas.text(x, self.y + 16, f"{number * tick_ms / 1000:g} s", "middle", "#777", SMALL)
        self.canvas.shapes[:0] = behind
        self.y += 26

    def drawn(self, title):
        self.canvas.text(self.left, 20, title, size=14)
        self.steps()
        self.levels("inputs", 6, "IN")
        self.levels("inpos", 1, "IN_POS")
        self.levels("error", 1, "ERROR")
        self.levels("outputs", 4, "OUT")
        for field, label, colour in (("p_ist", "P_IST", "#c33"), ("v_ist", "V_IST", "#36c")):
            if all(row[field] != "" for row in self.trace):
                self.curve(field, label, colour)
        self.axis()
        self.canvas.height = self.y
        return self.canvas
