"""Positions of the lines of a text for its alignment, as in matplotlib."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from vstatics.pictures.drawing.canvas import CanvasPlace, CanvasText, Point
from vstatics.pictures.drawing.metrics import ASCENT, DESCENT, LINE_GAP, line_extent

_SIDES = {"left": 0.0, "center": 0.5, "right": 1.0}
"""Share of the width of a text left of the reference point, by horizontal alignment. [-]"""


class TextLine(NamedTuple):
    """Text and size of a line [pt]."""

    text: str
    wide: float
    above: float
    """Height above the baseline."""
    below: float


def placed_lines(letters: CanvasText, place: CanvasPlace) -> list[tuple[float, float, str]]:
    """Return the position on the canvas [pt] of the left end of each line's baseline, and the line.

    A rotated text is aligned by the upright rectangle around its rotated lines.
    """
    lines, places = [*_lines(letters)], []
    wide = max(line.wide for line in lines)
    side, turn = _SIDES[letters.look.get("ha", "left")], letters.look.get("rotation", 0.0)
    x, y = place.of(*letters.at)
    off = _offset(letters, lines, wide)
    down = 0.0
    for line in lines:
        down -= line.above
        if line.text:
            along, up = _turned((side * (wide - line.wide), down), turn)
            places.append((x + along - off[0], y + up - off[1], line.text))
        down -= line.below
    return places


def _lines(letters: CanvasText) -> Iterator[TextLine]:
    size, texts = letters.size, letters.text.split("\n")
    spacing = letters.look.get("linespacing")
    for text in texts:
        extent = line_extent(text, size, bold=letters.is_bold)
        above, below = extent.high - extent.low, extent.low
        if spacing is None:
            more = LINE_GAP * size / 2 * (len(texts) > 1)
            above, below = max(above, ASCENT * size), max(below, DESCENT * size)
        else:
            more = (spacing * (ASCENT + DESCENT) * size - (above + below)) / 2
        yield TextLine(text, extent.wide, above + more, below + more)


def _offset(letters: CanvasText, lines: list[TextLine], wide: float) -> Point:
    """Return the offset of the reference point from the upper left corner of the rotated text."""
    look, last = letters.look, lines[-1]
    deep = sum(line.above + line.below for line in lines)
    rectangle = (0.0, -deep), (0.0, 0.0), (wide, 0.0), (wide, -deep)
    xs, ys = zip(*(_turned(at, look.get("rotation", 0.0)) for at in rectangle), strict=True)
    low, high = min(ys), max(ys)
    up = {
        "bottom": low,
        "top": high,
        "center": (low + high) / 2,
        "baseline": low + last.below,
        "center_baseline": high - (deep - last.below) / 2,
    }[look.get("va", "baseline")]
    return min(xs) + _SIDES[look.get("ha", "left")] * (max(xs) - min(xs)), up


def _turned(point: Point, degrees: float) -> Point:
    if not degrees:
        return point
    turn = math.radians(degrees)
    x, y = point
    return x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn)
