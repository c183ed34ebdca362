"""Names at the edge of a panel: at the ends of its lines, and of its verticals."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import zip_longest
from typing import Literal, NamedTuple

from vstatics.pictures.drawing.labels import (
    LABEL_GAP,
    LEADER,
    LINE_HEIGHT,
    Label,
    across_size,
    height,
    spread,
    width,
)
from vstatics.pictures.drawing.line_styles import Look
from vstatics.pictures.drawing.pen import Pen
from vstatics.pictures.drawing.style import LEADER_WIDTH, SIGN_WIDTH

AFTER_END_SIGN = 4.0
"""From the piece of its line before a name to the name. [pt]"""


class LineEnd(NamedTuple):
    """A line that reaches the edge, with the names of what shares it."""

    at: float
    """The part of the edge below it."""
    names: Sequence[str]
    """Wrapped."""
    looks: Sequence[Look] = ()
    """Of each name's own line; none of what is no line."""

    @property
    def high(self) -> float:
        """Of its names [pt]."""
        return sum(map(height, self.names)) + LABEL_GAP

    @property
    def aside(self) -> float:
        """From the edge to the names [pt]."""
        return LEADER + AFTER_END_SIGN + (SIGN_WIDTH if self.looks else 0.0)


def width_of(ends: Sequence[LineEnd]) -> float:
    """From the edge to the outer end of the names [pt]."""
    wide = (end.aside + width(name) for end in ends for name in end.names)
    return max(wide, default=0.0)


def height_of(ends: Sequence[LineEnd]) -> float:
    """That an edge needs so that no name covers another [pt]."""
    return sum(end.high for end in ends)


def beside(pen: Pen, side: Literal["left", "right"], ends: Sequence[LineEnd]) -> None:
    """The names at an edge, each after a piece of its line; what shares a line has one leader."""
    wanted = [end.at * pen.size[1] for end in ends]
    places = spread(wanted, [end.high for end in ends], 0.0, pen.size[1])
    edge, way, ha = (0.0, -1.0, "right") if side == "left" else (pen.size[0], 1.0, "left")
    inner = edge + LEADER * way
    leaders, brackets = [], []
    for end, at, place in zip(ends, wanted, places, strict=True):
        leaders.append(((edge, at), (inner, place)))
        top = place + (end.high - LABEL_GAP) / 2
        middles = []
        for name, look in zip_longest(end.names, end.looks):
            own = height(name)
            middles.append(top - own / 2)
            if look is not None:
                piece = [(inner + part * SIGN_WIDTH * way, middles[-1]) for part in (0, 0.5, 1)]
                pen.line(*piece, markevery=[1], **{"width": 1.6, **look})
            pen.text(
                edge + end.aside * way,
                middles[-1],
                name,
                ha=ha,
                va="center",
                linespacing=LINE_HEIGHT,
            )
            top -= own
        if len(middles) > 1:
            brackets.append(((inner, middles[0]), (inner, middles[-1])))
    pen.lines([*leaders, *brackets], color=pen.style.soft, width=LEADER_WIDTH)


def along(
    pen: Pen, edge: Literal["bottom", "top"], texts: Sequence[Label], *, upright: bool
) -> None:
    """Texts at the lower or upper edge, each with a line to its place.

    Parameters
    ----------
    upright : bool
        Texts run upwards, and need little room along the edge.
    """
    sizes = [height(one.text) + LABEL_GAP if upright else across_size(one.text) for one in texts]
    places = spread([one.at for one in texts], sizes, 0.0, pen.size[0])
    start, way, va = (0.0, -1.0, "top") if edge == "bottom" else (pen.size[1], 1.0, "bottom")
    both = list(zip(texts, places, strict=True))
    pen.lines(
        [((one.at, start), (x, start + 0.5 * LEADER * way)) for one, x in both if one.text],
        color=pen.style.soft,
        width=LEADER_WIDTH,
    )
    look: Look = {"ha": "center", "va": va, "linespacing": LINE_HEIGHT}
    for one, x in both:
        y, turn = start + 0.65 * LEADER * way, 90 * upright
        pen.text(x, y, one.text, color=one.colour, rotation=turn, **look)
