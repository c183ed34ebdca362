"""Bars of the shares that links and devices have in the energy of a mode."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from vstatics.pictures.sheet import labels
from vstatics.pictures.sheet.chart import Chart
from vstatics.pictures.sheet.style import Style
from vstatics.pictures.sheet.svg import told
from vstatics.tables.numbers import certain

FULL_BAR = 64.0
"""Length of a bar of 100 %. [pt]"""
THICK = 6.0
"""[pt]"""
PERCENT = 30.0
"""For the number behind a bar. [pt]"""
BAR_GAP = 6.0
"""From a name to its bar, from a bar to its number. [pt]"""
RIGHT = FULL_BAR + BAR_GAP + PERCENT
"""From the start of a bar to its right. [pt]"""
SHARE_NAME_WIDTH = 110.0
"""Names are wrapped to this width. [pt]"""
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


def largest(
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
    >>> [one[:2] for one in largest(shares, {"engine": "1"}, {}, Style())]
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
        found.append(Share(labels.wrapped(said, SHARE_NAME_WIDTH), shares[name], colour))
    rest = round(sum(shares.values()) - sum(one.part for one in found), 9)
    if rest >= LEAST_SHARE / 2:
        found.append(Share(style.text("others", "прочие"), rest, style.soft))
    return found


def height(shares: Sequence[Share]) -> float:
    """Of the bars, one below another [pt]."""
    return sum(labels.height(one.name) for one in shares)


def width(shares: Sequence[Share]) -> float:
    """Of the bars with their names and numbers [pt]."""
    return max((labels.width(one.name) for one in shares), default=0.0) + BAR_GAP + RIGHT


def draw(panel: Chart, right: float, top: float, shares: Sequence[Share]) -> None:
    """Bars that end before an abscissa, from an ordinate downwards [pt]."""
    start, y = right - RIGHT, top
    for one in shares:
        middle = y - labels.height(one.name) / 2
        how = {"va": "center", "linespacing": labels.LINE_HEIGHT}
        panel.write(start - BAR_GAP, middle, one.name, ha="right", **how)
        length, percent = FULL_BAR * one.part, f"{100 * one.part:.0f}%"
        said = told(f"{one.name}: {percent}")
        look = {"facecolor": one.colour, "linewidth": 0, "gid": said}
        panel.box((start, middle - THICK / 2), (length, THICK), **look)
        panel.write(start + length + BAR_GAP, middle, percent, va="center")
        y -= labels.height(one.name)
