"""How links are marked on levers: what turns with the input, with the output, what stands."""

from __future__ import annotations

import math
from typing import NamedTuple

from vstatics.model.transmission import HOUSING
from vstatics.pictures import labels
from vstatics.pictures.labels import Panel
from vstatics.pictures.state import PictureState
from vstatics.pictures.style import Style

LEGEND = 16.0
"""Height of a row of the legend. [pt]"""
MARGIN = 14.0
"""[pt]"""


class LinkMark(NamedTuple):
    """How a point of a lever is marked."""

    marker: str
    colour: str
    meaning: str = ""


def _marks(style: Style) -> list[LinkMark]:
    """The marks of the input, the output and the housing, and of links that turn with them."""
    first, last = style.colour(0), style.colour(1)
    return [
        LinkMark(
            "o", first, style.text("input, and what is joined to it", "вход и соединённое с ним")
        ),
        LinkMark(
            "D", last, style.text("output, and what is joined to it", "выход и соединённое с ним")
        ),
        LinkMark("s", style.ink, style.text("held", "остановлено")),
        LinkMark("", style.soft, style.text("other links", "прочие звенья")),
    ]


def mark_of(link: int, state: PictureState, style: Style) -> LinkMark:
    """The mark of a link in a gear.

    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> from vstatics.pictures.state import state_of
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> state = state_of(solve(case), 1)
    >>> [mark_of(link, state, Style()).meaning for link in (1, 2)]
    ['input, and what is joined to it', 'held']
    """
    first, last, held, other = _marks(style)
    body = state.joined[link]
    if body == HOUSING or state.gear.speeds.get(link) == 0:
        return held
    if link == state.output:
        return last  # also where the input is joined to it
    if body == state.joined[state.input]:
        return first
    return last if body == state.joined[state.output] else other


def legend_height(style: Style, wide: float) -> float:
    """Height of the legend in a figure of this width [pt]."""
    return _rows(style, wide) * LEGEND


def _mark_width(style: Style) -> float:
    return 2 * MARGIN + 24 + max(labels.width(mark.meaning) for mark in _marks(style))


def _rows(style: Style, wide: float) -> int:
    in_a_row = max(1, int((wide - MARGIN) // _mark_width(style)))
    return math.ceil(len(_marks(style)) / in_a_row)


def legend(whole: Panel, style: Style, bottom: float) -> None:
    """What the marks mean, in rows from a height [pt] upwards."""
    marks = _marks(style)
    rows = _rows(style, whole.width)
    in_a_row = math.ceil(len(marks) / rows)
    for place, mark in enumerate(marks):
        row, column = divmod(place, in_a_row)
        x = MARGIN + column * _mark_width(style)
        y = bottom + (rows - row - 0.5) * LEGEND
        how = {"color": mark.colour, "marker": mark.marker, "markevery": [1], "markersize": 6}
        whole.line((x, y), (x + 14, y), linewidth=2.5, **how)
        whole.write(x + 24, y, mark.meaning, va="center", color=mark.colour)
