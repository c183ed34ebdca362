"""Bars of the largest shares in the energy of a mode."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from vstatics.core.tables.numbers import certain
from vstatics.pictures.drawing.labels import LINE_HEIGHT, height, widest, wrapped
from vstatics.pictures.drawing.pen import Pen
from vstatics.pictures.drawing.style import SHORT_NAME, Style

FULL_BAR = 52.0
"""Length of a bar of 100 %. [pt]"""
BAR_HEIGHT = 6.0
"""[pt]"""
PERCENT_WIDTH = 26.0
"""For the number behind a bar. [pt]"""
BAR_GAP = 5.0
"""From a name to its bar, from a bar to its number. [pt]"""
SHARE_BAR_WIDTH = FULL_BAR + BAR_GAP + PERCENT_WIDTH
"""From the start of a bar to its right. [pt]"""
MOST_BARS = 5
"""So many bars at most, and one for the rest."""
LEAST_SHARE = 0.01
"""Smaller shares are among the rest."""


class Share(NamedTuple):
    """A bar."""

    name: str
    part: float
    """Of the energy. [-]"""
    colour: str


def largest_shares(
    shares: Mapping[str, float], marks: Mapping[str, str], colours: Mapping[str, str], style: Style
) -> list[Share]:
    """The largest shares of a mode, and what is left.

    Parameters
    ----------
    marks : mapping of str to str
        What stands before some of the names.
    colours : mapping of str to str
        Of some of the names.

    Examples
    --------
    >>> shares = {"engine": 0.99, "wheel": 0.008, "disc": 0.002}
    >>> [one[:2] for one in largest_shares(shares, {"engine": "1"}, {}, Style())]
    [('1 engine', 0.99), ('others', 0.01)]
    """
    order = sorted(shares, key=lambda name: -certain(shares[name]))
    shown = [name for name in order if certain(shares[name]) >= LEAST_SHARE]
    if len(shown) > MOST_BARS + 1:
        shown = shown[:MOST_BARS]
    found = []
    for name in shown:
        said = f"{marks[name]} {name}" if name in marks else name
        colour = colours.get(name, style.soft)
        found.append(Share(wrapped(said, SHORT_NAME), shares[name], colour))
    rest = round(sum(shares.values()) - sum(one.part for one in found), 9)
    if rest >= LEAST_SHARE / 2:
        found.append(Share(style.text("others"), rest, style.soft))
    return found


def shares_height(shares: Sequence[Share]) -> float:
    """Of the bars, one below another [pt]."""
    return sum(height(one.name) for one in shares)


def shares_width(shares: Sequence[Share]) -> float:
    """Of the bars with their names and numbers [pt]."""
    return widest(one.name for one in shares) + BAR_GAP + SHARE_BAR_WIDTH


def draw_shares(pen: Pen, right: float, top: float, shares: Sequence[Share]) -> None:
    """Bars that end before an abscissa, from an ordinate downwards [pt]."""
    start, y = right - SHARE_BAR_WIDTH, top
    for one in shares:
        middle = y - height(one.name) / 2
        at, spaced = (start - BAR_GAP, middle), LINE_HEIGHT
        pen.text(*at, one.name, ha="right", va="center", linespacing=spaced)
        length, percent = FULL_BAR * one.part, f"{100 * one.part:.0f}%"
        bar = (start, middle - BAR_HEIGHT / 2), (length, BAR_HEIGHT)
        pen.box(*bar, facecolor=one.colour, title=f"{one.name}: {percent}")
        pen.text(start + length + BAR_GAP, middle, percent, va="center")
        y -= height(one.name)
