"""A panel of lines over the time of a run, with what they are of and the capacities behind them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.pictures.drawing.ends import LineEnd
from vstatics.pictures.drawing.head import BETWEEN_SIGNS, SIGN_ROW_HEIGHT, KeySign
from vstatics.pictures.drawing.labels import height, ticks, wrapped
from vstatics.pictures.drawing.line_styles import Look
from vstatics.pictures.drawing.pen import AxisScale, Pen
from vstatics.pictures.drawing.style import LEADER_WIDTH, Style
from vstatics.pictures.runs import short
from vstatics.simulation.pictures.lines import MotionLine, MotionPanel, capacity_side, thinned

PANEL_HEIGHT = 78.0
"""Of a panel at least. [pt]"""
LINE_NAME_WIDTH = 72.0
"""Names at the right are wrapped to this width. [pt]"""
CAPACITY: Look = {"linestyle": (0, (2.5, 2)), "width": 0.8}
"""How the line of a capacity differs from that of its torque."""
CAPACITY_ROOM = 1.25
"""A capacity enlarges the scale of the torques to this part at most."""


def line_ends(shown: MotionPanel, style: Style, numbers: Mapping[str, int]) -> list[LineEnd]:
    """The names of lines at their last values."""
    scale = range_of(shown)
    return [
        LineEnd(
            scale.part(float(line.values[-1]) / shown.unit),
            [wrapped(short(name), LINE_NAME_WIDTH) for name in line.labels],
            line.looks(style, numbers),
        )
        for line in shown.lines
    ]


def names_over(
    shown: MotionPanel, style: Style, numbers: Mapping[str, int], room: float
) -> list[list[KeySign]]:
    """The names of lines in rows, where a page is too narrow for them at the right."""
    rows: list[list[KeySign]] = []
    for line in shown.lines:
        for name, look in zip(line.labels, line.looks(style, numbers), strict=True):
            sign = KeySign(short(name), look)
            if not rows or sum(one.wide + BETWEEN_SIGNS for one in rows[-1]) + sign.wide > room:
                rows.append([])
            rows[-1].append(sign)
    return rows


def draw_names_over(pen: Pen, rows: Sequence[Sequence[KeySign]]) -> None:
    """Names in rows over a panel."""
    for place, row in enumerate(reversed(rows)):
        x = 0.0
        for sign in row:
            sign.draw(pen, x, pen.size[1] + (place + 1) * SIGN_ROW_HEIGHT)
            x += sign.wide + BETWEEN_SIGNS


def draw_lines(
    pen: Pen, time: Floats, shown: MotionPanel, numbers: Mapping[str, int], *, off: float
) -> None:
    """The lines of a panel.

    Parameters
    ----------
    numbers : mapping of str to int
        Of things that are no links, for their colours.
    off : float
        From the left edge to what its scale is of. [pt]
    """
    wide, style = pen.size[0], pen.style
    pen.scale("left", ticks_of(pen.y), grid=True)
    rest = pen.up(0.0)
    pen.line((0.0, rest), (wide, rest), color=style.soft, width=LEADER_WIDTH, zorder=0.5)
    further = {"part": str(shown.part)} if shown.part > 1 else {}  # else both would be one group
    own = pen.within("panel", panel=shown.kind.replace("_", "-"), **further)
    for line in shown.lines:
        looks = line.looks(style, numbers)
        last = repr(float(line.values[-1]))
        for name, look in zip(line.names, looks, strict=True):
            if line.capacity is not None:
                _draw_capacity(own, name, line, time, look)
            said = own.within("line", name=name, last=last)
            said.plot(*thinned(time, line.values / shown.unit), title=short(name), **look)
    what = what_of(shown, style)
    pen.name("left", what, off + height(what) / 2)


def what_of(shown: MotionPanel, style: Style) -> str:
    """What the scale of a panel is of."""
    return wrapped(style.text(shown.text), PANEL_HEIGHT)


def ticks_of(scale: AxisScale) -> list[float]:
    """The numbers at the scale of a panel."""
    return ticks(scale.low, scale.high, 5)


def _draw_capacity(pen: Pen, name: str, line: MotionLine, time: Floats, look: Look) -> None:
    """What an element can carry, on the side on which it carries; nothing while it is endless."""
    assert line.capacity is not None  # noqa: S101 - it is asked of these alone
    side = capacity_side(line.values, line.capacity)
    drawn = np.where(np.isfinite(line.capacity), side * line.capacity, np.nan)
    turns = np.flatnonzero(np.diff(side)) + 1
    times, values = np.insert(time, turns, time[turns]), np.insert(drawn, turns, np.nan)
    said = pen.within("capacity", name=name, last=repr(float(line.capacity[-1])))
    text = pen.style.text("capacity")
    look = {"color": look["color"], **CAPACITY}
    said.plot(times, values, title=f"{short(name)}: {text}", zorder=1.8, **look)


def range_of(shown: MotionPanel) -> AxisScale:
    """A scale that has 0, in the unit of the panel, and room for panels of other runs."""
    ends = [_ends(one) for one in (shown, *shown.others)]
    low, high = min(low for low, _ in ends), max(high for _, high in ends)
    room = 0.06 * (high - low) if math.isfinite(high - low) and high > low else 1.0
    return AxisScale(low - room, high + room)


def _ends(shown: MotionPanel) -> tuple[float, float]:
    low = min(0.0, *(float(np.min(line.values)) for line in shown.lines)) / shown.unit
    high = max(0.0, *(float(np.max(line.values)) for line in shown.lines)) / shown.unit
    most = CAPACITY_ROOM * max(-low, high)
    for line in shown.lines:
        if line.capacity is not None:
            limit = capacity_side(line.values, line.capacity) * line.capacity
            near = np.abs(limit) <= most
            low = min(low, float(np.min(limit, where=near, initial=0.0)))
            high = max(high, float(np.max(limit, where=near, initial=0.0)))
    return low, high
