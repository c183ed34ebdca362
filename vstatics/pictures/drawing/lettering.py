"""Places of the lines of a text by its alignment, as matplotlib places them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from vstatics.pictures.drawing.canvas import CanvasPlace, CanvasText, Point
from vstatics.pictures.drawing.metrics import ASCENT, DESCENT, LINE_GAP, line_extent

_SIDES = {"left": 0.0, "center": 0.5, "right": 1.0}
"""Part of the width that is left of the point of a text."""


class TextLine(NamedTuple):
    """Line of a text with its share of the line spacing, in points."""

    text: str
    wide: float
    above: float
    """Height above the baseline."""
    below: float


def placed_lines(letters: CanvasText, place: CanvasPlace) -> list[tuple[float, float, str]]:
    """Return the left end of the baseline of each line on the canvas [pt], and the line.

    A text is aligned by the rectangle around its lines, after a rotation.
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
    """Return the aligned point of the rectangle around a text, from its upper left corner."""
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
