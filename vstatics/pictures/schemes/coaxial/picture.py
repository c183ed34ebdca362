"""The picture of a half-section: its head, its size, what its title says of crossings."""

from __future__ import annotations

from vstatics.pictures.schemes.coaxial.drawing import (
    CoaxialLayout,
    Paint,
    crossings_of,
    extent,
)
from vstatics.pictures.schemes.scheme import SchemeState
from vstatics.pictures.schemes.signs import meanings
from vstatics.pictures.schemes.titles import Titles
from vstatics.pictures.sheet.head import sheet_head
from vstatics.pictures.sheet.labels import title_width
from vstatics.pictures.sheet.pen import Pen
from vstatics.pictures.sheet.style import WIDE_MARGIN, Style


def remarks(layout: CoaxialLayout, style: Style) -> list[str]:
    """What the title says besides: crossings, an output that cannot leave along the axis."""
    found = []
    count = crossings_of(layout)
    if count:
        english = f"{count} crossing{'s' * (count > 1)}"
        found.append(style.text(english, f"пересечений: {count}"))
    if not layout.own.train.end:
        found.append(style.text("output through the housing", "выход через корпус"))
    if not layout.is_ordered:
        found.append(style.text("sets in another order", "ряды в ином порядке"))
    return found


def painted(  # noqa: PLR0913, PLR0917 - what is drawn, and how
    layout: CoaxialLayout,
    style: Style,
    state: SchemeState,
    titles: Titles,
    name: str,
    note: str = "",
    within: Pen | None = None,
) -> Pen:
    """A half-section with its head, or without one at a place of another figure.

    It is no wider than a page: where there is more, lines close up, letters stay.
    """
    low, high = extent(layout)
    size = high[0] - low[0], high[1] - low[1]
    if within is None:
        named = ", ".join([name, *remarks(layout, style)])
        least = title_width(named) + 2 * WIDE_MARGIN if style.titled else 0.0
        wide = min(max(size[0], least), style.width)
        room = wide, size[1] * min(1.0, wide / size[0])
        head = sheet_head(named, note, meanings(state, style), wide - 2 * WIDE_MARGIN, style)
        within = head.over(room, WIDE_MARGIN * bool(head.high), style)._replace(size=room)
        pen = within.fitted(low, high)
        pen = pen._replace(letters=1 / pen.part)
    else:
        pen = within.fitted(low, high)
    Paint(pen, layout, state, titles).all()
    return pen
