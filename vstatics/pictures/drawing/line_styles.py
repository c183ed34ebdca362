"""Line styles of links and shift elements, and area styles of losses, common to all charts."""

from __future__ import annotations

from collections.abc import Sequence

from vstatics.pictures.drawing.canvas import Look
from vstatics.pictures.drawing.style import Style

STRIPE = 5.0
"""Length of each colour of a striped line, relative to the width of the line. [-]"""
TINTS = (0.5, 0.16, 0.34)
"""Fractions of the loss colour in areas. The rest is paper, to keep letters readable. [-]"""
PARTS = ("", "////", "....", "\\\\\\\\", "xx")
"""Hatches of the areas of losses. Five hatches and three tints distinguish fifteen areas."""


def link_looks(links: Sequence[int], style: Style) -> list[Look]:
    """Return a line style for each link number, from 1. A curve common to several links is striped.

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
    """Return the style of the symbol for striped lines in the key."""
    dashes = (0, (STRIPE / 2, STRIPE / 2))
    return {"color": style.ink, "gapcolor": style.faint, "linestyle": dashes, "width": 2.8}


def link_look(link: int, style: Style) -> Look:
    """Return the line style of a link."""
    return thing_look(link - 1, style)


def thing_look(number: int, style: Style) -> Look:
    """Return the line style of the shift element or other object with an index.

    >>> thing_look(1, Style())["color"] == Style().colour(1), thing_look(1, Style())["linestyle"]
    (True, 'solid')
    """
    return {"color": style.colour(number), "linestyle": style.dash(number)}


def loss_look(place: int, style: Style) -> Look:
    """Return the area style of a loss by index: a tint of the colour of losses, and a hatch."""
    return {
        "facecolor": mixed(style.lost, style.paper, TINTS[place % len(TINTS)]),
        "hatch": PARTS[place // len(TINTS) % len(PARTS)],
        "edgecolor": style.lost,
        "width": 0.6,
    }


def mixed(colour: str, other: str, part: float) -> str:
    """Mix two colours, with the fraction `part` of the first colour.

    >>> mixed("#ff0000", "#ffffff", 0.5)
    '#ff8080'
    """
    pairs = zip(bytes.fromhex(colour[1:]), bytes.fromhex(other[1:]), strict=True)
    return "#" + "".join(f"{round(part * a + (1 - part) * b):02x}" for a, b in pairs)
