"""What the drawing of a typical element is made of."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Literal, NamedTuple

from vstatics.core.model.transmission import HOUSING
from vstatics.pictures.drawing.labels import Point, Segment, wrapped
from vstatics.pictures.drawing.pen import LINE_WIDTH

TOOTH, SLEEVE = 0.9, 2.6
"""Widths of the lines of teeth and of the sleeves that join rims. [pt]"""
FACE = 9.0
"""Half the width of a wheel. [pt]"""
MESH = 3.0
"""Between the lines of teeth of two wheels that mesh. [pt]"""


DEVICE_NAME_LETTERS = 14
"""Longer names of devices are broken at blanks. [letters]"""
HATCH_STEP, HATCH_WIDTH = 5.0, 0.5
"""From slanted line to slanted line, and their width. [pt]"""


def lines_of(name: str, letters: int = DEVICE_NAME_LETTERS) -> str:
    """A name on as many lines as it needs.

    >>> lines_of("low and reverse brake").split(chr(10))
    ['low and', 'reverse brake']
    """
    return wrapped(" ".join(name.split()), letters, len)


def ground(at: Point, side: int) -> list[Segment]:
    """A piece of the housing at a point: a line with strokes toward a side."""
    x, y = at
    strokes = [((x + by, y), (x + by + 4.5, y + 5 * side)) for by in (-9.0, -3.0, 3.0)]
    return [((x - 10, y), (x + 10, y)), *strokes]


def hatching(low: Point, high: Point) -> Iterator[Segment]:
    """Slanted lines within a rectangle."""
    (left, bottom), (right, top) = low, high
    start = left - (top - bottom)
    while start < right:
        first, last = max(start, left), min(start + top - bottom, right)
        if last - first > 1:
            yield (first, bottom + first - start), (last, bottom + last - start)
        start += HATCH_STEP


ABOVE, BELOW = 1, -1
Reach = Literal["row", "none"]
"""Whether a tap leads to a line of its link; a member that stands still has none."""


class Tap(NamedTuple):
    """Where a link meets an element."""

    wire: int
    side: int
    """ABOVE or BELOW."""
    x: float
    """From the left end of the element. [pt]"""
    reach: Reach = "row"
    label: str = ""
    """Member of the element."""
    depth: float = 0.0
    """Distance from the middle of the row to the place where the line begins. [pt]"""


class Stroke(NamedTuple):
    """A line of a glyph."""

    points: tuple[Point, ...]
    width: float = LINE_WIDTH
    dashed: bool = False


class Glyph(NamedTuple):
    """One way to draw an element; x from its left end, y from the middle of the row [pt]."""

    width: float
    strokes: Sequence[Stroke]
    taps: Sequence[Tap]
    texts: Sequence[tuple[Point, str, str]] = ()
    """Names and teeth of wheels: left end, ``top`` or ``bottom`` there, text."""

    @property
    def wheels(self) -> tuple[Point, Point]:
        """Corners of a rectangle about its wheels."""
        points = [
            point for stroke in self.strokes if stroke.width == TOOTH for point in stroke.points
        ]
        xs, ys = zip(*points, strict=True)
        return (min(xs), min(ys)), (max(xs), max(ys))

    @property
    def half(self) -> float:
        """How far it reaches above or below the middle."""
        heights = [abs(y) for stroke in self.strokes for _, y in stroke.points]
        return max(heights, default=0.0)


def member_tap(member: str, link: int, side: int, x: float, y: float) -> Tap:
    """The tap of a member that leaves the element at a point toward a side."""
    reach: Reach = "none" if link == HOUSING else "row"
    return Tap(link, side, x, reach, member, y if side == ABOVE else -y)


def teeth(x: float, y: float, half: float = FACE) -> Stroke:
    """A level line of teeth."""
    return Stroke(((x - half, y), (x + half, y)), TOOTH)


def wheel(x: float, y: float, radius: float) -> list[Stroke]:
    """A wheel on a level axis, seen from the side."""
    web = Stroke(((x, y - radius), (x, y + radius)))
    return [web, teeth(x, y + radius), teeth(x, y - radius)]
