"""Drawing of lines, areas, texts and scales in a rectangle of a canvas; all lengths in points."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Literal, NamedTuple

import numpy as np

from vstatics.core.model.empty import EMPTY
from vstatics.core.numerics.arrays import Floats
from vstatics.core.tables.numbers import typeset
from vstatics.pictures.drawing.canvas import (
    Canvas,
    CanvasArea,
    CanvasLine,
    CanvasPart,
    CanvasPlace,
    CanvasText,
    Look,
    MarkGroup,
    Outline,
    PartMark,
    Point,
)
from vstatics.pictures.drawing.labels import LINE_HEIGHT
from vstatics.pictures.drawing.style import FRAME_WIDTH, LARGE_NUMBER, SIZE, TICK_LENGTH, Style
from vstatics.pictures.drawing.tolerances import SAME_TICK

LINE_WIDTH = 1.3
"""Default width of a line. [pt]"""
MOST_DECIMALS = 8
"""Largest number of decimals of a number on a scale."""
NO_DATA: Mapping[str, str] = EMPTY
GAP = (math.nan, math.nan)
"""Point that separates two pieces of an interrupted line."""
Side = Literal["left", "right", "bottom", "top"]
_UPRIGHT: Look = {"rotation": 90, "ha": "center", "va": "center", "linespacing": LINE_HEIGHT}


class AxisScale(NamedTuple):
    """Linear or logarithmic scale along an edge of a panel.

    >>> AxisScale(0.0, 4.0).part(1.0), AxisScale(1.0, 100.0, is_log=True).part(10.0)
    (0.25, 0.5)
    """

    low: float
    high: float
    is_log: bool = False

    def part(self, value: float) -> float:
        """Return the position of a value on the edge: 0 at the low end, 1 at the high end."""
        if self.is_log:
            return math.log(value / self.low) / math.log(self.high / self.low)
        return (value - self.low) / (self.high - self.low)


WHOLE = AxisScale(0.0, 1.0)
"""Scale of an edge on which positions are given directly, from 0 to 1."""


class Pen(NamedTuple):
    """Drawing tool for a rectangle of a canvas, with coordinates from the lower left corner."""

    canvas: Canvas
    style: Style
    place: CanvasPlace = CanvasPlace()
    """Transformation from the coordinates of the pen to the canvas."""
    corner: Point = (0.0, 0.0)
    """Lower left corner of the rectangle."""
    size: Point = (0.0, 0.0)
    x: AxisScale = WHOLE
    y: AxisScale = WHOLE
    letters: float = 1.0
    """Additional scale of letters. [-]"""
    groups: tuple[MarkGroup, ...] = ()
    """SVG groups of everything that the pen draws, the outermost first."""

    @property
    def part(self) -> float:
        """Scale from lengths of the pen to lengths on the canvas [-]."""
        return self.place.part

    def panel(self, corner: Point, size: Point, x: AxisScale = WHOLE, y: AxisScale = WHOLE) -> Pen:
        """Return a pen for a panel within the rectangle, with scales along the panel's edges."""
        return self._replace(corner=corner, size=size, x=x, y=y)

    def within(self, kind: str, **data: str) -> Pen:
        """Return a pen that draws into an SVG group: ``within("link", name="sun")``.

        An underscore in a name becomes a hyphen: ``largest_force`` gives ``data-largest-force``.
        """
        return self._replace(groups=(*self.groups, MarkGroup(kind, tuple(data.items()))))

    def tell(self, **data: str) -> None:
        """Set SVG attributes of the picture: ``tell(left_out="[]")`` gives ``data-left-out``."""
        self.canvas.data.update(data)

    def fitted(self, low: Point, high: Point) -> Pen:
        """Return a pen that scales down the area between two corners to fit into the rectangle.

        The area is centred and never enlarged.
        """
        wanted_size = high[0] - low[0], high[1] - low[1]
        part = min(
            1.0, *(room / length for room, length in zip(self.size, wanted_size, strict=True))
        )
        left, bottom = (
            start + (room - part * length) / 2
            for start, room, length in zip(self.corner, self.size, wanted_size, strict=True)
        )
        place = CanvasPlace(part, left - part * low[0], bottom - part * low[1])
        return self._replace(corner=(0.0, 0.0), place=place.within(self.place))

    def across(self, x: float) -> float:
        """Return the horizontal position of a value on the horizontal scale [pt]."""
        return self.x.part(x) * self.size[0]

    def up(self, y: float) -> float:
        """Return the vertical position of a value on the vertical scale [pt]."""
        return self.y.part(y) * self.size[1]

    def add(
        self,
        shape: CanvasLine | CanvasArea | CanvasText,
        title: str = "",
        kind: str = "",
        data: Mapping[str, str] = NO_DATA,
    ) -> None:
        """Add a shape in coordinates of the canvas. Title, class and data are for SVG."""
        self.canvas.parts.append(
            CanvasPart(shape, self.place, PartMark(title, kind, data, self.groups))
        )

    def text(  # noqa: PLR0913 - properties of a text
        self,
        x: float,
        y: float,
        text: str,
        *,
        size: float = SIZE,
        bold: bool = False,
        over: bool = False,
        title: str = "",
        zorder: float = 3.0,
        **look: Any,
    ) -> None:
        """Write a text; `over` adds a border in the colour of the paper, for a text over lines."""
        if text:
            at = self.corner[0] + x, self.corner[1] + y
            size *= self.part * self.letters
            look.setdefault("color", self.style.ink)
            self.add(CanvasText(at, text, look, size, bold, over, zorder), title)

    def line(
        self,
        *places: Point,
        width: float = LINE_WIDTH,
        title: str = "",
        kind: str = "",
        data: Mapping[str, str] = NO_DATA,
        zorder: float = 2.0,
        **look: Any,
    ) -> None:
        """Draw a line through points. A point with NaN coordinates is a gap.

        `kind` is the SVG class of the line, and `data` its attributes ``data-...``.
        """
        left, low = self.corner
        xs, ys = zip(*((left + x, low + y) for x, y in places), strict=True)
        look["linewidth"] = width * self.part
        self.add(CanvasLine(xs, ys, look, zorder), title, kind, data)

    def lines(self, pieces: Iterable[Sequence[Point]], **look: Any) -> None:
        """Draw lines of equal style, each through a sequence of points."""
        places = [place for piece in pieces for place in (*piece, GAP)]
        if places:
            self.line(*places, **look)

    def area(
        self, *corners: Point, width: float = 0.0, title: str = "", kind: str = "", **look: Any
    ) -> None:
        """Draw a polygon with an outline of a given width. `kind` is the SVG class."""
        left, low = self.corner
        outline = Outline.polygon([(left + x, low + y) for x, y in corners])
        self.fill(outline, width=width, title=title, kind=kind, **look)

    def fill(
        self,
        outline: Outline,
        *,
        width: float = 0.0,
        title: str = "",
        kind: str = "",
        zorder: float = 1.0,
        **look: Any,
    ) -> None:
        """Fill an outline in coordinates of the canvas, and draw the border with a given width."""
        look["linewidth"] = width * self.part
        self.add(CanvasArea(outline, look, zorder), title, kind)

    def box(self, corner: Point, size: Point, **look: Any) -> None:
        """Draw a rectangle with a given lower left corner."""
        self.area(*corners(*corner, corner[0] + size[0], corner[1] + size[1]), **look)

    def plot(  # noqa: PLR0913 - properties of a curve
        self,
        xs: Floats,
        ys: Floats,
        *,
        width: float = LINE_WIDTH,
        title: str = "",
        kind: str = "",
        zorder: float = 2.0,
        **look: Any,
    ) -> None:
        """Draw a curve through values on linear scales, clipped at the edges of the rectangle."""
        across, up = [
            start + (values - scale.low) / (scale.high - scale.low) * length
            for values, scale, start, length in zip(
                (xs, ys), (self.x, self.y), self.corner, self.size, strict=True
            )
        ]
        ends = zip((across, up), self.corner, self.size, strict=True)
        is_cut = any(np.any((at < start) | (at > start + length)) for at, start, length in ends)
        look["linewidth"] = width * self.part
        clip = (self.corner, self.size) if is_cut else None
        self.add(CanvasLine(across, up, look, zorder, clip), title, kind)

    def frame(self, *sides: Side) -> None:
        """Draw lines along the given edges, by default along all four edges."""
        wide, high = self.size
        ends: dict[Side, tuple[Point, Point]] = {
            "left": ((0.0, 0.0), (0.0, high)),
            "right": ((wide, 0.0), (wide, high)),
            "bottom": ((0.0, 0.0), (wide, 0.0)),
            "top": ((0.0, high), (wide, high)),
        }
        pieces = [ends[side] for side in sides or ends]
        ink = self.style.ink
        self.lines(pieces, color=ink, width=FRAME_WIDTH, solid_capstyle="projecting")

    def scale(
        self,
        side: Side,
        at: Sequence[float],
        texts: Sequence[str] | None = None,
        *,
        grid: bool = False,
    ) -> None:
        """Draw the tick marks and numbers of a scale at an edge.

        Parameters
        ----------
        at : sequence of float
            Values of the tick marks.
        texts : sequence of str, optional
            Texts instead of the numbers; empty for tick marks only.
        grid : bool
            True to draw grid lines to the opposite edge.
        """
        upright = side in ("left", "right")
        places = [self.up(value) if upright else self.across(value) for value in at]
        whole = self.size[0] if upright else self.size[1]
        edge, way = (whole, 1.0) if side in ("right", "top") else (0.0, -1.0)
        out = edge + way * TICK_LENGTH

        def turned(along: float, off: float) -> Point:
            return (off, along) if upright else (along, off)

        if grid:
            pieces = [(turned(place, edge), turned(place, whole - edge)) for place in places]
            self.lines(pieces, color=self.style.faint, width=0.4, zorder=0.4)
        pieces = [(turned(place, edge), turned(place, out)) for place in places]
        self.lines(pieces, color=self.style.ink, width=FRAME_WIDTH)
        aligned: dict[Side, Look] = {
            "left": {"ha": "right", "va": "center_baseline"},
            "right": {"va": "center_baseline"},
            "bottom": {"ha": "center", "va": "top"},
            "top": {"ha": "center", "va": "bottom"},
        }
        for place, text in zip(places, tick_texts(at) if texts is None else texts, strict=False):
            self.text(*turned(place, out + 2 * way), text, **aligned[side])

    def name(self, side: Literal["left", "right", "bottom"], text: str, off: float) -> None:
        """Write the name of a scale at a distance from the edge."""
        wide, high = self.size
        if side == "bottom":
            self.text(wide / 2, -off, text, ha="center", va="center")
        else:
            self.text(-off if side == "left" else wide + off, high / 2, text, **_UPRIGHT)


def blank(wide: float, high: float, style: Style) -> Pen:
    """Return a pen for an empty canvas of a given size."""
    return Pen(Canvas((wide, high), style, [], {}), style)


def corners(left: float, low: float, right: float, high: float) -> list[Point]:
    """Return the corners of a rectangle, from the lower left."""
    return [(left, low), (right, low), (right, high), (left, high)]


def zigzag(x: float, y: float, half: float, high: float) -> list[Point]:
    """Return a horizontal zigzag line, the symbol of a spring, with the middle at (x, y)."""
    turns = [(x + half * (step / 4 - 1), y + high * (1, -1)[step % 2]) for step in range(1, 8)]
    return [(x - half, y), *turns, (x + half, y)]


def tick_texts(values: Sequence[float], alike: Sequence[float] = ()) -> list[str]:
    """Return the numbers of a scale as texts, all with as many decimals as the longest needs.

    >>> tick_texts([-0.5, 0.0, 0.5, 1.0]), tick_texts([0.0, 2000.0]), tick_texts([1.0], [0.25])
    (['−0.5', '0.0', '0.5', '1.0'], ['0', '2000'], ['1.00'])
    """
    every = [*values, *alike]
    largest = max(map(abs, every), default=0.0)
    if largest >= LARGE_NUMBER or 0 < largest < 10.0**-MOST_DECIMALS:
        return [typeset(f"{value:g}") for value in values]
    decimals = 0
    while decimals < MOST_DECIMALS and any(
        abs(round(value, decimals) - value) > SAME_TICK * largest for value in every
    ):
        decimals += 1
    return [typeset(f"{value:z.{decimals}f}") for value in values]
