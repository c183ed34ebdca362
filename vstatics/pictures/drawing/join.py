"""Pictures of several cases on one sheet, each headed by a letter and the name of its case.

Finished pictures are moved to a common canvas without being drawn again.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from vstatics.pictures.drawing.canvas import Canvas, CanvasPart, CanvasPlace, Look, Point
from vstatics.pictures.drawing.labels import LINE_HEIGHT, height, title_width, wrapped
from vstatics.pictures.drawing.pen import Pen, blank
from vstatics.pictures.drawing.style import MARGIN, TITLE, Style

LETTER_HEIGHT = LINE_HEIGHT * TITLE + MARGIN
"""Height of the line with the letter and the name of a case, including the margin above. [pt]"""


class LetteredPicture(NamedTuple):
    """Picture of a case with the letter and the name of the case."""

    letter: str
    name: str
    canvas: Canvas

    @property
    def own(self) -> Point:
        """Size of the picture without the heading [pt]."""
        return self.canvas.size

    @property
    def head(self) -> str:
        """Letter and name of the case, wrapped to the width of the picture."""
        letter = f"{self.letter}  "
        return letter + wrapped(
            self.name, self.own[0] - 2 * MARGIN - title_width(letter), title_width
        )

    @property
    def over(self) -> float:
        """Height of the heading, including the margin above [pt]."""
        return height(self.head, TITLE) + MARGIN

    @property
    def size(self) -> Point:
        """Size of the picture with the heading [pt]."""
        wide, high = self.own
        return wide, high + self.over


def joined(parts: Sequence[LetteredPicture], style: Style, *, side_by_side: bool = False) -> Canvas:
    """Join pictures on a page, vertically or side by side.

    Examples
    --------
    >>> pens = [blank(100.0, 50.0, Style()) for _ in "AB"]
    >>> parts = [LetteredPicture(*names, pen.canvas) for *names, pen in zip("AB", "xy", pens)]
    >>> page = joined(parts, Style())
    >>> page.texts, page.size
    (['A  x', 'B  y'], (100.0, 149.0))
    """
    sizes = [part.own for part in parts]
    overs = [part.over for part in parts]
    if side_by_side:  # upper edges are aligned, so that scales are at equal heights
        overs = [max(overs)] * len(parts)
    highs = [over + size[1] for over, size in zip(overs, sizes, strict=True)]
    wides = [size[0] for size in sizes]
    wide, tall = (sum(wides), max(highs)) if side_by_side else (max(wides), sum(highs))
    pen = blank(wide, tall, style)
    left, top = 0.0, tall
    for part, size, high in zip(parts, sizes, highs, strict=True):
        panel = pen.within("panel", case=part.letter)
        at = left + MARGIN, top - MARGIN
        look: Look = {"va": "top", "linespacing": LINE_HEIGHT, "color": style.soft}
        panel.text(*at, part.head, size=TITLE, bold=True, **look)
        _move(part.canvas, panel, (left, top - high))
        left, top = (left + size[0], top) if side_by_side else (left, top - high)
    return pen.canvas


def _move(canvas: Canvas, pen: Pen, corner: Point) -> None:
    offset = CanvasPlace(1.0, *corner)
    for shape, place, mark in canvas.parts:
        groups = (*pen.groups, *mark.groups)
        pen.canvas.parts.append(
            CanvasPart(shape, place.within(offset), mark._replace(groups=groups))
        )
