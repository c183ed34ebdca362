"""What figures say: the artists with a title, and all texts."""

import json
from typing import Any

from matplotlib.artist import Artist
from matplotlib.figure import Figure
from matplotlib.text import Text

from vstatics.pictures.drawing.canvas import Canvas

WITHOUT_PLAN = ("wheel-hub.yaml", "wolfrom.yaml")
"""Shipped cases in which nothing is free."""
WITHOUT_TWO_GEARS = (
    *("moskvich-start.yaml", "power-split.yaml", "self-locking.yaml", "toyota-p410.yaml"),
)
"""Those in which no two gears are told apart by one element."""


def titled(figure: Figure) -> list[tuple[str, Any]]:
    """The artists of a picture that have a title, with it, in their order."""
    said = [(json.loads(name)["title"], one) for one, name in _named(figure)]
    return [(title, one) for title, one in said if title]


def _named(figure: Figure) -> list[tuple[Artist, str]]:
    found = [(one, one.get_gid()) for one in figure.findobj()]
    return [(one, name) for one, name in found if name and name.startswith("{")]


def texts(figure: Figure | Canvas) -> list[str]:
    if isinstance(figure, Canvas):
        return figure.texts
    found: list[Any] = figure.findobj(Text)
    return [one.get_text() for one in found if one.get_visible() and one.get_text()]
