"""A chart without axes of matplotlib, which take most of the time: two scales in a rectangle."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any, Literal, NamedTuple

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle
from matplotlib.transforms import Affine2D, Bbox, TransformedBbox

from vstatics.numerics.arrays import Floats
from vstatics.pictures.sheet.labels import LINE_HEIGHT, POINTS_PER_INCH, Paper, Point, width
from vstatics.pictures.sheet.style import LARGE_NUMBER, Style
from vstatics.tables.numbers import typeset

TICK = 3.0
"""Length of a mark of a scale. [pt]"""
FRAME = 0.8
"""Width of lines around a chart. [pt]"""
DECIMALS = 8
"""Of the numbers of a scale, at most."""
Side = Literal["left", "right", "bottom", "top"]


class AxisScale(NamedTuple):
    """What the length of an edge stands for.

    >>> AxisScale(0.0, 4.0).part(1.0), AxisScale(1.0, 100.0, is_log=True).part(10.0)
    (0.25, 0.5)
    """

    low: float
    high: float
    is_log: bool = False

    def part(self, value: float) -> float:
        """The part of the edge from its low end to a value."""
        if self.is_log:
            return math.log(value / self.low) / math.log(self.high / self.low)
        return (value - self.low) / (self.high - self.low)


class Chart(NamedTuple):
    """A rectangle of a picture; places are in points from its lower left corner."""

    paper: Paper
    corner: Point
    """Its lower left one. [pt]"""
    width: float
    """[pt]"""
    height: float
    """[pt]"""
    x: AxisScale
    y: AxisScale

    def across(self, x: float) -> float:
        """The place of an abscissa [pt]."""
        return self.x.part(x) * self.width

    def up(self, y: float) -> float:
        """The place of an ordinate [pt]."""
        return self.y.part(y) * self.height

    def write(self, x: float, y: float, text: str, **how: Any) -> None:
        """A text at a place."""
        self.paper.write(self.corner[0] + x, self.corner[1] + y, text, **how)

    def line(self, *places: Point, **how: Any) -> None:
        """A line through places; a place of NaN is a gap."""
        left, low = self.corner
        self.paper.line(*((left + x, low + y) for x, y in places), **how)

    def lines(self, pieces: Iterable[tuple[Point, Point]], **how: Any) -> None:
        """Many lines of one look."""
        gap = (math.nan, math.nan)
        places = [place for piece in pieces for place in (*piece, gap)]
        if places:
            self.line(*places, **how)

    def box(self, corner: Point, size: Point, **how: Any) -> None:
        """A rectangle by its lower left corner and its size."""
        at = self.corner[0] + corner[0], self.corner[1] + corner[1]
        self.paper.add(Rectangle(at, *size, **how))

    def plot(self, xs: Floats, ys: Floats, **how: Any) -> None:
        """A line through points of both scales, which need not be logarithmic; cut at the edge."""
        left = self.corner[0] + (xs - self.x.low) / (self.x.high - self.x.low) * self.width
        low = self.corner[1] + (ys - self.y.low) / (self.y.high - self.y.low) * self.height
        line = Line2D(left, low, **how)
        self.paper.add(line)
        places = zip((left, low), self.corner, (self.width, self.height), strict=True)
        if any(np.any((at < start) | (at > start + length)) for at, start, length in places):
            points = Affine2D().scale(1 / POINTS_PER_INCH) + self.paper.figure.dpi_scale_trans
            own = Bbox.from_bounds(*self.corner, self.width, self.height)
            line.set_clip_box(TransformedBbox(own, points))

    def frame(self, style: Style, *sides: Side) -> None:
        """Lines along some edges."""
        wide, high = self.width, self.height
        ends = {
            "left": ((0.0, 0.0), (0.0, high)),
            "right": ((wide, 0.0), (wide, high)),
            "bottom": ((0.0, 0.0), (wide, 0.0)),
            "top": ((0.0, high), (wide, high)),
        }
        how: dict[str, Any] = {"color": style.ink, "linewidth": FRAME}
        self.lines([ends[side] for side in sides], solid_capstyle="projecting", **how)

    def scale(
        self,
        side: Side,
        at: Sequence[float],
        style: Style,
        texts: Sequence[str] | None = None,
        *,
        grid: bool = False,
    ) -> None:
        """Marks at an edge with their numbers.

        Parameters
        ----------
        at : sequence of float
            In the unit of the scale.
        texts : sequence of str, optional
            Instead of the numbers; none of them for a scale that another chart numbers.
        grid : bool
            Lines from here to the edge beyond.
        """
        upright = side in ("left", "right")
        places = [self.up(one) if upright else self.across(one) for one in at]
        edge = {"left": 0.0, "right": self.width, "bottom": 0.0, "top": self.height}[side]
        way = 1.0 if side in ("right", "top") else -1.0
        out = edge + way * TICK

        def turned(along: float, off: float) -> Point:
            return (off, along) if upright else (along, off)

        if grid:
            far = (self.width if upright else self.height) - edge
            pieces = [(turned(one, edge), turned(one, far)) for one in places]
            self.lines(pieces, color=style.faint, linewidth=0.4, zorder=0.4)
        pieces = [(turned(one, edge), turned(one, out)) for one in places]
        self.lines(pieces, color=style.ink, linewidth=FRAME)
        aligned: dict[str, Any] = {
            "left": {"ha": "right", "va": "center_baseline"},
            "right": {"ha": "left", "va": "center_baseline"},
            "bottom": {"ha": "center", "va": "top"},
            "top": {"ha": "center", "va": "bottom"},
        }[side]
        for one, text in zip(places, tick_texts(at) if texts is None else texts, strict=False):
            self.write(*turned(one, out + 2 * way), text, **aligned)

    def name(self, side: Side, text: str, off: float) -> None:
        """What a scale is of, so far from its edge [pt]."""
        if side in ("left", "right"):
            x = -off if side == "left" else self.width + off
            how: dict[str, Any] = {"rotation": 90, "ha": "center", "va": "center"}
            self.write(x, self.height / 2, text, linespacing=LINE_HEIGHT, **how)
        else:
            y = -off if side == "bottom" else self.height + off
            self.write(self.width / 2, y, text, ha="center", va="center")


def tick_texts(values: Sequence[float], alike: Sequence[float] = ()) -> list[str]:
    """The numbers of a scale, all with the decimals that one of them, or of others, needs.

    >>> tick_texts([-0.5, 0.0, 0.5, 1.0]), tick_texts([0.0, 2000.0]), tick_texts([1.0], [0.25])
    (['−0.5', '0.0', '0.5', '1.0'], ['0', '2000'], ['1.00'])
    """
    every = [*values, *alike]
    largest = max(map(abs, every), default=0.0)
    if largest >= LARGE_NUMBER or 0 < largest < 10.0**-DECIMALS:
        return [typeset(f"{one:g}") for one in values]
    decimals = 0
    while decimals < DECIMALS and any(
        abs(round(one, decimals) - one) > 1e-9 * largest for one in every
    ):
        decimals += 1
    return [typeset(f"{one:z.{decimals}f}") for one in values]


def widest(texts: Iterable[str]) -> float:
    """Width of the widest text [pt]."""
    return max((width(one) for one in texts), default=0.0)
