"""Building blocks of the drawing of a gear set: gears, teeth, hatching, ends of links."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from vstatics.pictures.drawing.canvas import Point
from vstatics.pictures.drawing.labels import Segment, wrapped
from vstatics.pictures.drawing.pen import LINE_WIDTH

TOOTH, SLEEVE = 0.9, 2.6
"""Line widths of teeth, and of sleeves between the gears of a planet. [pt]"""
FACE = 9.0
"""Half the drawn face width of a gear. [pt]"""
MESH = 3.0
"""Distance between the tooth lines of meshing gears. [pt]"""


DEVICE_NAME_LETTERS = 14
"""Number of letters above which the name of a component is broken at a blank."""
HATCH_STEP, HATCH_WIDTH = 5.0, 0.5
"""Distance and width of the lines of a hatching. [pt]"""


def lines_of(name: str, letters: int = DEVICE_NAME_LETTERS) -> str:
    """Break a name at blanks into lines of a number of letters, if possible.

    >>> lines_of("low and reverse brake").split(chr(10))
    ['low and', 'reverse brake']
    """
    return wrapped(" ".join(name.split()), letters, len)


def ground(at: Point, side: int) -> list[Segment]:
    """Return the symbol of the housing at a point: a line with strokes above or below."""
    x, y = at
    strokes = [((x + by, y), (x + by + 4.5, y + 5 * side)) for by in (-9.0, -3.0, 3.0)]
    return [((x - 10, y), (x + 10, y)), *strokes]


def hatching(low: Point, high: Point) -> Iterator[Segment]:
    """Yield the slanted lines of a hatching within a rectangle."""
    (left, bottom), (right, top) = low, high
    start = left - (top - bottom)
    while start < right:
        first, last = max(start, left), min(start + top - bottom, right)
        if last - first > 1:
            yield (first, bottom + first - start), (last, bottom + last - start)
        start += HATCH_STEP


ABOVE, BELOW = 1, -1


class Tap(NamedTuple):
    """Point where the line of a link meets a gear set."""

    wire: int
    """Number of the link; 0 for a fixed member."""
    side: int
    """Direction in which the line of the link leaves: `ABOVE` or `BELOW`."""
    x: float
    """Distance from the left end of the gear set. [pt]"""
    y: float
    """Height of the start of the link's line, from the middle of the row of planets. [pt]"""
    label: str
    """Name of the member of the gear set."""


class Stroke(NamedTuple):
    """Line of the drawing of a gear set."""

    points: tuple[Point, ...]
    width: float = LINE_WIDTH


class Glyph(NamedTuple):
    """Drawing of a gear set; x from the left end, y from the middle of the row of planets [pt]."""

    width: float
    strokes: Sequence[Stroke]
    taps: Sequence[Tap]
    texts: Sequence[tuple[Point, str, str]] = ()
    """Names and tooth numbers: left end, vertical alignment (``top`` or ``bottom``), and text."""

    @property
    def half(self) -> float:
        """Largest distance of any line above or below the middle of the row [pt]."""
        heights = [abs(y) for stroke in self.strokes for _, y in stroke.points]
        return max(heights, default=0.0)


def teeth(x: float, y: float, half: float = FACE) -> Stroke:
    """Return a horizontal line of teeth, with the middle at a point."""
    return Stroke(((x - half, y), (x + half, y)), TOOTH)
