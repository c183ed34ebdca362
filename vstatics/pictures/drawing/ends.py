"""Names of curves or vertical lines, written where these meet the edge of a panel."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import zip_longest
from typing import Literal, NamedTuple

from vstatics.pictures.drawing.canvas import Look
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
from vstatics.pictures.drawing.pen import Pen
from vstatics.pictures.drawing.style import LEADER_WIDTH, SIGN_WIDTH

AFTER_END_SIGN = 4.0
"""Distance from the sample of a line style to the name of the style. [pt]"""


class LineEnd(NamedTuple):
    """End of a curve at the edge of a panel, with the names of the links that the curve shows."""

    at: float
    """Position of the end along the edge: 0 at the lower end, 1 at the upper end. [-]"""
    names: Sequence[str]
    """Names of the links, each wrapped into lines."""
    looks: Sequence[Look] = ()
    """Style of the short line before each name, as in a legend; empty without such lines."""

    @property
    def high(self) -> float:
        """Height of all names with the gap to the next label [pt]."""
        return sum(map(height, self.names)) + LABEL_GAP

    @property
    def aside(self) -> float:
        """Distance from the edge to the names [pt]."""
        return LEADER + AFTER_END_SIGN + (SIGN_WIDTH if self.looks else 0.0)


def width_of(ends: Sequence[LineEnd]) -> float:
    """Return the distance from the edge to the outer end of the names [pt]."""
    wide = (end.aside + width(name) for end in ends for name in end.names)
    return max(wide, default=0.0)


def height_of(ends: Sequence[LineEnd]) -> float:
    """Return the length of an edge that the names need without overlap [pt]."""
    return sum(end.high for end in ends)


def beside(pen: Pen, side: Literal["left", "right"], ends: Sequence[LineEnd]) -> None:
    """Write names of curves at a vertical edge, each with a line sample and a leader line."""
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
            name_height = height(name)
            middles.append(top - name_height / 2)
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
            top -= name_height
        if len(middles) > 1:
            brackets.append(((inner, middles[0]), (inner, middles[-1])))
    pen.lines([*leaders, *brackets], color=pen.style.soft, width=LEADER_WIDTH)


def along(
    pen: Pen, edge: Literal["bottom", "top"], texts: Sequence[Label], *, upright: bool
) -> None:
    """Write texts along the lower or upper edge, with leader lines to the named points.

    Parameters
    ----------
    upright : bool
        True to write vertical texts, which need less room along the edge.
    """
    sizes = [
        height(label.text) + LABEL_GAP if upright else across_size(label.text) for label in texts
    ]
    places = spread([label.at for label in texts], sizes, 0.0, pen.size[0])
    start, way, va = (0.0, -1.0, "top") if edge == "bottom" else (pen.size[1], 1.0, "bottom")
    both = list(zip(texts, places, strict=True))
    pen.lines(
        [((label.at, start), (x, start + 0.5 * LEADER * way)) for label, x in both if label.text],
        color=pen.style.soft,
        width=LEADER_WIDTH,
    )
    look: Look = {"ha": "center", "va": va, "linespacing": LINE_HEIGHT}
    for label, x in both:
        y, turn = start + 0.65 * LEADER * way, 90 * upright
        pen.text(x, y, label.text, color=label.colour, rotation=turn, **look)
