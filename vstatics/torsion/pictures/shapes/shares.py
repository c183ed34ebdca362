"""Bars of the largest shares of links or components in the energy of a mode."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from vstatics.core.tables.numbers import certain
from vstatics.pictures.drawing.labels import LINE_HEIGHT, height, widest, wrapped
from vstatics.pictures.drawing.pen import Pen
from vstatics.pictures.drawing.style import SHORT_NAME, Style

FULL_BAR = 52.0
"""Length of a bar of 100 %. [pt]"""
SHARE_BAR_HEIGHT = 6.0
"""Thickness of a bar. [pt]"""
PERCENT_WIDTH = 26.0
"""Width of the number to the right of a bar. [pt]"""
BAR_GAP = 5.0
"""Gap between a name and a bar, and between a bar and a number. [pt]"""
SHARE_BAR_WIDTH = FULL_BAR + BAR_GAP + PERCENT_WIDTH
"""Width of a full bar with its number. [pt]"""
MOST_BARS = 5
"""Largest number of bars, apart from a bar for all other shares."""
LEAST_SHARE = 0.01
"""Smallest share with a bar."""


class Share(NamedTuple):
    """Share of a link or component in the energy of a mode, drawn as a bar."""

    name: str
    part: float
    """Share in the energy. [-]"""
    colour: str


def largest_shares(
    shares: Mapping[str, float], marks: Mapping[str, str], colours: Mapping[str, str], style: Style
) -> list[Share]:
    """Return the largest energy shares in a mode, and the sum of all other shares.

    Parameters
    ----------
    shares : mapping of str to float
    marks : mapping of str to str
        Texts in front of some of the names, by name.
    colours : mapping of str to str
        Colours of some of the names, by name.
    style : Style

    Examples
    --------
    >>> shares = {"engine": 0.99, "wheel": 0.008, "disc": 0.002}
    >>> [share[:2] for share in largest_shares(shares, {"engine": "1"}, {}, Style())]
    [('1 engine', 0.99), ('others', 0.01)]
    """
    order = sorted(shares, key=lambda name: -certain(shares[name]))
    shown = [name for name in order if certain(shares[name]) >= LEAST_SHARE]
    if len(shown) > MOST_BARS + 1:
        shown = shown[:MOST_BARS]
    bars = []
    for name in shown:
        label = f"{marks[name]} {name}" if name in marks else name
        colour = colours.get(name, style.soft)
        bars.append(Share(wrapped(label, SHORT_NAME), shares[name], colour))
    others = round(sum(shares.values()) - sum(bar.part for bar in bars), 9)
    if others >= LEAST_SHARE / 2:
        bars.append(Share(style.text("others"), others, style.soft))
    return bars


def shares_height(shares: Sequence[Share]) -> float:
    """Return the height of the bars of shares [pt]."""
    return sum(height(share.name) for share in shares)


def shares_width(shares: Sequence[Share]) -> float:
    """Return the width of bars with names and numbers [pt]."""
    return widest(share.name for share in shares) + BAR_GAP + SHARE_BAR_WIDTH


def draw_shares(pen: Pen, right: float, top: float, shares: Sequence[Share]) -> None:
    """Draw bars from `top` down; they begin at the abscissa `right` - `SHARE_BAR_WIDTH` [pt]."""
    start, y = right - SHARE_BAR_WIDTH, top
    for share in shares:
        middle = y - height(share.name) / 2
        at, spaced = (start - BAR_GAP, middle), LINE_HEIGHT
        pen.text(*at, share.name, ha="right", va="center", linespacing=spaced)
        length, percent = FULL_BAR * share.part, f"{100 * share.part:.0f}%"
        bar = (start, middle - SHARE_BAR_HEIGHT / 2), (length, SHARE_BAR_HEIGHT)
        pen.box(*bar, facecolor=share.colour, title=f"{share.name}: {percent}")
        pen.text(start + length + BAR_GAP, middle, percent, va="center")
        y -= height(share.name)
