"""Names at the edge of a chart: at the ends of its lines, and of its verticals."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import zip_longest
from typing import Any, Literal, NamedTuple

from vstatics.pictures.sheet import labels
from vstatics.pictures.sheet.chart import Chart
from vstatics.pictures.sheet.labels import LABEL_GAP, LEADER, Label, spread
from vstatics.pictures.sheet.line_styles import Look
from vstatics.pictures.sheet.style import Style

SWATCH = 20.0
"""Length of the piece of its line before a name. [pt]"""
AFTER = 4.0
"""From there to the name. [pt]"""


class LineEnd(NamedTuple):
    """A line that reaches the edge, with the names of what shares it."""

    at: float
    """Along the edge, from its lower end. [pt]"""
    names: tuple[str, ...]
    """Wrapped."""
    looks: tuple[Look, ...] = ()
    """Of each name's own line; none of what is no line."""

    @property
    def high(self) -> float:
        """Of its names [pt]."""
        return sum(map(labels.height, self.names)) + LABEL_GAP

    @property
    def aside(self) -> float:
        """From the edge to the names [pt]."""
        return LEADER + AFTER + (SWATCH if self.looks else 0.0)


def width_of(ends: Sequence[LineEnd]) -> float:
    """From the edge to the outer end of the names [pt]."""
    wide = (end.aside + labels.width(name) for end in ends for name in end.names)
    return max(wide, default=0.0)


def height_of(ends: Sequence[LineEnd]) -> float:
    """That an edge needs so that no name covers another [pt]."""
    return sum(end.high for end in ends)


def beside(
    chart: Chart, side: Literal["left", "right"], ends: Sequence[LineEnd], style: Style
) -> None:
    """The names at an edge, each after a piece of its line; what shares a line has one leader."""
    places = spread([end.at for end in ends], [end.high for end in ends], 0.0, chart.height)
    edge, way = (0.0, -1.0) if side == "left" else (chart.width, 1.0)
    aligned = {"ha": "right" if side == "left" else "left", "va": "center"}
    inner = edge + LEADER * way
    leaders, brackets = [], []
    for end, place in zip(ends, places, strict=True):
        leaders.append(((edge, end.at), (inner, place)))
        top = place + (end.high - LABEL_GAP) / 2
        middles = []
        for name, look in zip_longest(end.names, end.looks):
            own = labels.height(name)
            middles.append(top - own / 2)
            if look is not None:
                piece = [(inner + part * SWATCH * way, middles[-1]) for part in (0.0, 0.5, 1.0)]
                how: dict[str, Any] = {"linewidth": 1.6, "solid_capstyle": "butt", **look}
                chart.line(*piece, markevery=[1], **how)
            x = edge + end.aside * way
            chart.write(x, middles[-1], name, linespacing=labels.LINE_HEIGHT, **aligned)
            top -= own
        if len(middles) > 1:
            brackets.append(((inner, middles[0]), (inner, middles[-1])))
    chart.lines([*leaders, *brackets], color=style.soft, linewidth=0.6)


def along(
    chart: Chart,
    edge: Literal["bottom", "top"],
    texts: Sequence[Label],
    style: Style,
    *,
    upright: bool,
) -> None:
    """Texts at the lower or upper edge, each with a line to its place.

    Parameters
    ----------
    upright : bool
        Texts run upwards, and need little room along the edge.
    """
    sizes = [
        labels.height(one.text) + LABEL_GAP if upright else labels.across_size(one.text)
        for one in texts
    ]
    places = spread([one.at for one in texts], sizes, 0.0, chart.width)
    start, way = (0.0, -1.0) if edge == "bottom" else (chart.height, 1.0)
    pieces = [
        ((one.at, start), (place, start + 0.5 * LEADER * way))
        for one, place in zip(texts, places, strict=True)
        if one.text
    ]
    chart.lines(pieces, color=style.soft, linewidth=0.6)
    how: dict[str, Any] = {"ha": "center", "va": "top" if edge == "bottom" else "bottom"}
    how |= {"rotation": 90} if upright else {}
    for one, place in zip(texts, places, strict=True):
        y = start + 0.65 * LEADER * way
        chart.write(place, y, one.text, color=one.colour, linespacing=labels.LINE_HEIGHT, **how)
