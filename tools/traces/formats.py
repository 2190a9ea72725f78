"""Pictures of rectangles, lines and texts as SVG, PNG or PDF."""

import subprocess
from xml.sax.saxutils import escape

from .plain import plain

FORMATS = ("svg", "png", "pdf")
DPI = 144
PIECE = 200  # points of a line in one of Graphviz' strings, which are short


class Bad(Exception):
    pass


class Canvas:
    """What is drawn, back to front; x to the right, y down, in points."""

    def __init__(self, width):
        self.width = width
        self.height = 0
        self.shapes = []

    def rectangle(self, x, y, width, height, fill, stroke):
        self.shapes.append(("rectangle", x, y, max(width, 0.5), height, fill, stroke))

    def line(self, points, colour, width=1.5):
        self.shapes.append(("line", points, colour, width))

    def text(self, x, y, words, anchor="start", colour="#333", size=12):
        self.shapes.append(("text", x, y, plain(words), anchor, colour, size))


def svg(canvas):
    parts = []
    for kind, *shape in canvas.shapes:
        if kind == "rectangle":
            x, y, width, height, fill, stroke = shape
            parts.append(f'<rect x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{height:.1f}" fill="{fill}" '
                         f'stroke="{stroke}" stroke-width="0.5"/>')
        elif kind == "line":
            points, colour, width = shape
            parts.append(f'<polyline points="{" ".join(f"{x:.1f},{y:.1f}" for x, y in points)}" fill="none" '
                         f'stroke="{colour}" stroke-width="{width}"/>')
        else:
            x, y, words, anchor, colour, size = shape
            parts.append(f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{colour}" '
                         f'font-size="{size}">{escape(words)}</text>')
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{canvas.width}" height="{canvas.height:.0f}" '
            f'font-family="sans-serif"><rect width="100%" height="100%" fill="white"/>' + "\n".join(parts) + "</svg>\n")


def colour_in_full(colour):
    return "#" + "".join(2 * digit for digit in colour[1:]) if len(colour) == 4 else colour


def graphviz(canvas):
    """For `neato -n2`: everything has its place already."""
    up = lambda y: canvas.height - y
    parts = ['digraph { graph [pad=0, margin=0, splines=true, outputorder=edgesfirst, bgcolor="#ffffff"];',
             'node [shape=box, fixedsize=true, margin=0, label="", fontname="Helvetica"]; edge [arrowhead=none];',
             f'page [pos="{canvas.width / 2},{canvas.height / 2}", width={canvas.width / 72:.4f}, '
             f'height={canvas.height / 72:.4f}, style=invis];',
             'hook [pos="0,0", width=0, height=0, style=invis];']
    for kind, *shape in canvas.shapes:
        if kind == "rectangle":
            x, y, width, height, fill, stroke = shape
            parts.append(f'n{len(parts)} [pos="{x + width / 2:.2f},{up(y + height / 2):.2f}", width={width / 72:.5f}, '
                         f'height={height / 72:.5f}, style=filled, penwidth=0.5, fillcolor="{colour_in_full(fill)}", '
                         f'color="{colour_in_full(stroke)}"];')
        elif kind == "line":
            points, colour, width = shape
            places = [f"{x:.2f},{up(y):.2f}" for x, y in points]
            for at in range(0, max(len(places) - 1, 1), PIECE):
                piece = places[at:at + PIECE + 1]
                curve = piece[0] + "".join(f" {a} {b} {b}" for a, b in zip(piece, piece[1:]))
                parts.append(f'hook -> hook [pos="{curve}", color="{colour_in_full(colour)}", penwidth={width}];')
        else:
            parts.append(graphviz_text(len(parts), up, *shape))
    return "\n".join(parts) + "}\n"


def graphviz_text(number, up, x, y, words, anchor, colour, size):
    width = 0.8 * size * max(len(words), 1)
    middle = {"start": x + width / 2, "middle": x, "end": x - width / 2}[anchor]
    side = {"start": "\\l", "middle": "\\n", "end": "\\r"}[anchor]
    label = words.replace("\\", "\\\\").replace('"', '\\"') + side
    return (f'n{number} [shape=plaintext, pos="{middle:.2f},{up(y) + 0.3 * size:.2f}", width={width / 72:.4f}, '
            f'height={size * 1.2 / 72:.4f}, fontsize={size}, fontcolor="{colour_in_full(colour)}", label="{label}"];')


def written_as(canvas, kind):
    if kind == "svg":
        return svg(canvas).encode()
    command = ["dot", "-Kneato", "-n2", f"-Gdpi={DPI}" if kind == "png" else "-Gdpi=72", f"-T{kind}"]
    try:
        done = subprocess.run(command, input=graphviz(canvas).encode(), capture_output=True, check=False)
    except OSError as error:
        raise Bad("Graphviz' program 'dot' is missing: install it (on Debian: apt-get install graphviz), or name an .svg, "
                  "which needs no Graphviz") from error
    if done.returncode != 0 or not done.stdout:
        raise Bad("'dot' failed: " + (done.stderr.decode(errors="replace").splitlines() or ["without a word"])[0])
    return done.stdout
