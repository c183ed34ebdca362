"""How lines of links and of shift elements look, and the parts of a loss: one way in all charts."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from vstatics.pictures.drawing.style import Style

Look = dict[str, Any]
"""Of a line of matplotlib."""
STRIPE = 5.0
"""Length of a stripe over the width of its line."""
TINTS = (0.5, 0.16, 0.34)
"""How much of the colour of losses is in the parts of a loss; letters on them stay readable."""
PARTS = ("", "////", "....", "\\\\\\\\", "xx")
"""Hatches of these: fifteen parts differ."""


def link_looks(links: Sequence[int], style: Style) -> list[Look]:
    """The line of links, numbered from 1: one for each, with stripes where they share it.

    >>> [look["color"] for look in link_looks([1], Style())]
    ['#0c4cff']
    >>> [look["linestyle"] for look in link_looks([1, 2], Style())]
    [(0.0, (5.0, 5.0)), (5.0, (5.0, 5.0))]
    """
    if len(links) == 1:
        return [link_look(links[0], style)]
    count = len(links)
    return [
        {
            "color": style.colour(link - 1),
            "linestyle": ((count - place) % count * STRIPE, (STRIPE, (count - 1) * STRIPE)),
        }
        for place, link in enumerate(links)
    ]


def striped_look(style: Style) -> Look:
    """Of the sign in a key for lines with stripes."""
    dashes = (0, (STRIPE / 2, STRIPE / 2))
    return {"color": style.ink, "gapcolor": style.faint, "linestyle": dashes, "width": 2.8}


def link_look(link: int, style: Style) -> Look:
    """The line of one link."""
    return thing_look(link - 1, style)


def thing_look(number: int, style: Style) -> Look:
    """The line of a shift element, or of what else is no link, by its number from 0.

    >>> thing_look(1, Style())["color"] == Style().colour(1), thing_look(1, Style())["linestyle"]
    (True, 'solid')
    """
    return {"color": style.colour(number), "linestyle": style.dash(number)}


def loss_look(place: int, style: Style) -> Look:
    """The area of a part of the loss, from 0: a tint of the colour of losses, with a hatch."""
    return {
        "facecolor": mixed(style.lost, style.paper, TINTS[place % len(TINTS)]),
        "hatch": PARTS[place // len(TINTS) % len(PARTS)],
        "edgecolor": style.lost,
        "width": 0.6,
    }


def mixed(colour: str, other: str, part: float) -> str:
    """A colour with so much of another one that the part of the first is left.

    >>> mixed("#ff0000", "#ffffff", 0.5)
    '#ff8080'
    """
    pairs = zip(bytes.fromhex(colour[1:]), bytes.fromhex(other[1:]), strict=True)
    return "#" + "".join(f"{round(part * one + (1 - part) * two):02x}" for one, two in pairs)
