"""How links are marked on levers: what turns with the input, with the output, what stands."""

from __future__ import annotations

import math
from typing import NamedTuple

from vstatics.model.transmission import HOUSING, Transmission
from vstatics.pictures import labels
from vstatics.pictures.labels import Panel
from vstatics.pictures.style import Style

LEGEND = 16.0
"""Height of a row of the legend. [pt]"""
MARGIN = 14.0
"""[pt]"""


class Joined(NamedTuple):
    """What turns with the input, with the output and with the housing in a gear."""

    input: frozenset[int]
    output: frozenset[int]
    housing: frozenset[int]


def joined(case: Transmission, chosen: int) -> Joined:
    """The links that engaged elements join to the input, the output and the housing."""
    gear = case.gears[chosen - 1]
    pairs = [case.shift_elements[one - 1][:2] for one in gear.engaged]

    def with_(link: int) -> frozenset[int]:
        found = {link}
        for _ in pairs:
            for pair in pairs:
                if found & set(pair):
                    found |= set(pair)
        return frozenset(found)

    return Joined(with_(case.gear_input(gear)), with_(case.gear_output(gear)), with_(HOUSING))


class Sign(NamedTuple):
    """How a point of a lever is marked."""

    marker: str
    colour: str
    meaning: str = ""


def _signs(style: Style) -> list[Sign]:
    """The marks of the input, the output and the housing, and of links that turn with them."""
    first, last = style.colour(0), style.colour(1)
    return [
        Sign("o", first, style.text("input, and what is joined to it", "вход и соединённое с ним")),
        Sign(
            "D", last, style.text("output, and what is joined to it", "выход и соединённое с ним")
        ),
        Sign("s", style.ink, style.text("held", "остановлено")),
        Sign("", style.soft, style.text("other links", "прочие звенья")),
    ]


def sign(case: Transmission, chosen: int, link: int, with_: Joined, style: Style) -> Sign:
    """The mark of a link in a gear.

    >>> from vstatics import Gear, Mechanism, ShiftElement
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> [sign(case, 1, link, joined(case, 1), Style()).meaning for link in (1, 2)]
    ['input, and what is joined to it', 'held']
    """
    gear = case.gears[chosen - 1]
    first, last, held, other = _signs(style)
    if link in with_.housing or gear.speeds.get(link) == 0:
        return held
    if link == case.gear_output(gear):
        return last  # also where the input is joined to it
    if link in with_.input:
        return first
    return last if link in with_.output else other


def legend_height(style: Style, wide: float) -> float:
    """Height of the legend in a figure of this width [pt]."""
    return _rows(style, wide) * LEGEND


def _sign_width(style: Style) -> float:
    return 2 * MARGIN + 24 + max(labels.width(sign.meaning) for sign in _signs(style))


def _rows(style: Style, wide: float) -> int:
    in_a_row = max(1, int((wide - MARGIN) // _sign_width(style)))
    return math.ceil(len(_signs(style)) / in_a_row)


def legend(whole: Panel, style: Style, bottom: float) -> None:
    """What the marks mean, in rows from a height [pt] upwards."""
    signs = _signs(style)
    rows = _rows(style, whole.width)
    in_a_row = math.ceil(len(signs) / rows)
    for place, sign in enumerate(signs):
        row, column = divmod(place, in_a_row)
        x = MARGIN + column * _sign_width(style)
        y = bottom + (rows - row - 0.5) * LEGEND
        how = {"color": sign.colour, "marker": sign.marker, "markevery": [1], "markersize": 6}
        whole.line((x, y), (x + 14, y), linewidth=2.5, **how)
        whole.write(x + 24, y, sign.meaning, va="center", color=sign.colour)
