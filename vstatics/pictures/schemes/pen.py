"""Lines, symbols and text in points on a figure; the same for all schemes."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Any, NamedTuple

from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Polygon, Rectangle
from matplotlib.textpath import TextToPath

from vstatics.pictures import labels
from vstatics.pictures.labels import Point
from vstatics.pictures.style import FONT, Style

SIZE, SMALL = 9.0, 7.5
"""Of text. [pt]"""
LINE = 1.3
"""Width of a line. [pt]"""
WRAP = 14
"""Longer names are broken at blanks. [letters]"""


@cache
def width_of(text: str, size: float = SIZE, *, bold: bool = False) -> float:
    """The width of text, of its longest line [pt]."""
    font = FontProperties(family=FONT, size=size, weight="bold" if bold else "normal")
    return max(
        float(TextToPath().get_text_width_height_descent(line, font, ismath=False)[0])
        for line in text.split("\n")
    )


def wrapped(name: str, letters: int = WRAP) -> str:
    """A name on as many lines as it needs.

    >>> wrapped("low and reverse brake").split(chr(10))
    ['low and', 'reverse brake']
    """
    lines: list[str] = []
    for word in name.split():
        if lines and len(lines[-1]) + 1 + len(word) <= letters:
            lines[-1] += f" {word}"
        else:
            lines.append(word)
    return "\n".join(lines)


class Window(NamedTuple):
    """A rectangle of a figure, in which a picture is drawn smaller."""

    figure: Figure
    corner: Point
    """Lower left, from that of the figure. [pt]"""
    size: Point
    """[pt]"""
    letters: float = 1.0
    """Size of letters over what they would have."""


class Pen:
    """Draws on a figure of a given size, with points as its unit.

    Parameters
    ----------
    low, high : (float, float)
        Corners of the picture. [pt]
    style : Style
    within : Window, optional
        Where on another figure it stands, as large as has room there, and no larger than it is.
    """

    def __init__(self, low: Point, high: Point, style: Style, within: Window | None = None) -> None:
        """Make the figure, or its place in another one."""
        self.style = style
        own = high[0] - low[0], high[1] - low[1]
        if within is None:
            within = Window(labels.figure(*own), (0.0, 0.0), own)
        self.figure = within.figure
        self.scale = min(1.0, *(room / size for room, size in zip(within.size, own, strict=True)))
        self.letters = within.letters
        size = own[0] * self.scale, own[1] * self.scale
        left, bottom = (
            start + (room - length) / 2
            for start, room, length in zip(within.corner, within.size, size, strict=True)
        )
        self.axes = labels.panel(self.figure, left, bottom, *size).axes
        self.axes.set_axis_off()
        self.axes.set_xlim(low[0], high[0])
        self.axes.set_ylim(low[1], high[1])

    def line(self, *points: Point, color: str, width: float = LINE, **more: Any) -> None:
        """A line through points."""
        xs, ys = zip(*points, strict=True)
        options = {"solid_capstyle": "butt", "solid_joinstyle": "miter", "zorder": 3, **more}
        # what `plot` does besides, as fitting the limits, costs most of the time
        self.axes.add_artist(Line2D(xs, ys, color=color, linewidth=width * self.scale, **options))

    def dot(self, at: Point, color: str) -> None:
        """Where wires are joined."""
        self.axes.add_patch(Circle(at, 2.3, facecolor=color, edgecolor="none", zorder=6))

    def shape(self, points: Sequence[Point], *, fill: str, edge: str, width: float = LINE) -> None:
        """A filled polygon."""
        self.axes.add_patch(
            Polygon(
                points,
                closed=True,
                facecolor=fill,
                edgecolor=edge,
                linewidth=width * self.scale,
                zorder=4,
            )
        )

    def text(  # noqa: PLR0913 - a text has these
        self,
        at: Point,
        text: str,
        *,
        color: str,
        size: float = SIZE,
        across: str = "center",
        up: str = "center",
        bold: bool = False,
    ) -> None:
        """Text on the paper, over any line."""
        self.axes.text(
            *at,
            text,
            color=color,
            fontsize=size * self.scale * self.letters,
            family=FONT,
            weight="bold" if bold else "normal",
            ha=across,
            va=up,
            zorder=8,
            linespacing=1.0,
            parse_math=False,
        )

    def blank(self, at: Point, width: float, height: float) -> None:
        """Paper over whatever was drawn there."""
        corner = at[0] - width / 2, at[1] - height / 2
        self.axes.add_patch(
            Rectangle(corner, width, height, facecolor=self.style.paper, edgecolor="none", zorder=7)
        )

    def arrow(self, tip: Point, way: float, color: str) -> None:
        """The head of an arrow to the right (way 1) or left (-1)."""
        x, y = tip
        points = [(x, y), (x - 9 * way, y + 3.5), (x - 9 * way, y - 3.5)]
        self.shape(points, fill=color, edge=color, width=0.5)

    def ground(self, at: Point, side: int, color: str) -> None:
        """A piece of the housing at a point: a line with strokes toward a side."""
        x, y = at
        self.line((x - 8, y), (x + 8, y), color=color, width=1.6)
        for number in range(3):
            middle = x - 8 + 16 / 3 * (number + 0.5)
            self.line((middle - 2.5, y), (middle + 2.5, y + 5 * side), color=color, width=0.8)
