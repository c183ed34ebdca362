"""Pictures of several cases on a sheet, each in a panel with a letter.

Figures are not drawn again; their artists move to a common figure.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any, NamedTuple

from matplotlib.artist import Artist
from matplotlib.figure import Figure
from matplotlib.transforms import Affine2D, TransformedBbox

from vstatics.pictures.drawing.labels import (
    LINE_HEIGHT,
    POINTS_PER_INCH,
    Point,
    height,
    title_width,
    wrapped,
)
from vstatics.pictures.drawing.line_styles import Look
from vstatics.pictures.drawing.pen import Pen, blank
from vstatics.pictures.drawing.style import MARGIN, TITLE, Style
from vstatics.pictures.drawing.svg import told

LETTER_HEIGHT = LINE_HEIGHT * TITLE + MARGIN
"""Height of the line with the letter and the name of a case, with a margin above. [pt]"""


class LetteredFigure(NamedTuple):
    """Page of the picture of a case."""

    letter: str
    name: str
    figure: Figure

    @property
    def own(self) -> Point:
        """Size of the figure [pt]."""
        wide, high = self.figure.get_size_inches().tolist()
        return wide * POINTS_PER_INCH, high * POINTS_PER_INCH

    @property
    def head(self) -> str:
        """Letter and name of the case, in lines as wide as the picture."""
        letter = f"{self.letter}  "
        return letter + wrapped(
            self.name, self.own[0] - 2 * MARGIN - title_width(letter), title_width
        )

    @property
    def over(self) -> float:
        """Height of the heading with a margin above [pt]."""
        return height(self.head, TITLE) + MARGIN

    @property
    def size(self) -> Point:
        """Size with the heading [pt]."""
        wide, high = self.own
        return wide, high + self.over


def joined(parts: Sequence[LetteredFigure], style: Style, *, side_by_side: bool = False) -> Figure:
    """Join pictures on a page, vertically or side by side.

    Examples
    --------
    >>> from vstatics.pictures.drawing.files import settings_of
    >>> with settings_of(Style()):
    ...     pens = [blank(100.0, 50.0, Style()) for _ in "AB"]
    ...     parts = [LetteredFigure(*names, pen.figure) for *names, pen in zip("AB", "xy", pens)]
    ...     made = joined(parts, Style())
    >>> [text.get_text() for text in made.texts], made.get_size_inches().round(2).tolist()
    (['A  x', 'B  y'], [1.39, 2.07])
    """
    sizes = [part.own for part in parts]
    overs = [part.over for part in parts]
    if side_by_side:  # aligned scales
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
        _move(part.figure, panel, (left, top - high))
        left, top = (left + size[0], top) if side_by_side else (left, top - high)
    return pen.figure


def _move(figure: Figure, pen: Pen, corner: Point) -> None:
    """Move all artists of a figure into the figure of a pen, with an offset of the corner."""
    x, y = corner
    inches = Affine2D().translate(x / POINTS_PER_INCH, y / POINTS_PER_INCH)
    place = figure.dpi_scale_trans.inverted() + inches + pen.figure.dpi_scale_trans
    artists: list[Artist] = figure.get_children()
    for artist in artists:
        if artist is figure.patch:
            continue
        artist.remove()
        artist.set_transform(artist.get_transform() + place)
        box: Any = artist.get_clip_box()
        if box is not None:
            artist.set_clip_box(TransformedBbox(box, place))
        said = artist.get_gid()
        mark = json.loads(said) if said and said.startswith("{") else json.loads(told())
        groups = [*pen.groups, *mark["groups"]]
        artist.set_gid(json.dumps({**mark, "groups": groups}, ensure_ascii=False))
        pen.figure.add_artist(artist)
