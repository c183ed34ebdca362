"""Panel of lines over time, with the torque capacities of shift elements."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.pictures.drawing.canvas import Look
from vstatics.pictures.drawing.ends import LineEnd
from vstatics.pictures.drawing.head import BETWEEN_SIGNS, SIGN_ROW_HEIGHT, KeySign, rows_of
from vstatics.pictures.drawing.labels import height, ticks, wrapped
from vstatics.pictures.drawing.pen import AxisScale, Pen
from vstatics.pictures.drawing.style import LEADER_WIDTH, Style
from vstatics.pictures.runs import short
from vstatics.simulation.pictures.lines import MotionLine, MotionPanel, capacity_side, thinned

PANEL_HEIGHT = 78.0
"""Least height of a panel. [pt]"""
LINE_NAME_WIDTH = 72.0
"""Width at which the names to the right of a panel are wrapped. [pt]"""
CAPACITY: Look = {"linestyle": (0, (2.5, 2)), "width": 0.8}
"""Line style of torque capacities."""
CAPACITY_ROOM = 1.25
"""Largest factor by which a capacity enlarges the scale of torques."""


def line_ends(shown: MotionPanel, style: Style, numbers: Mapping[str, int]) -> list[LineEnd]:
    """Return the names of lines, each at the height of the line's last value."""
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
    """Return the names of lines in rows above a panel, for a page without room to the right."""
    signs = (
        KeySign(short(name), look)
        for line in shown.lines
        for name, look in zip(line.labels, line.looks(style, numbers), strict=True)
    )
    return rows_of(signs, room)


def draw_names_over(pen: Pen, rows: Sequence[Sequence[KeySign]]) -> None:
    """Draw names in rows above a panel."""
    for place, row in enumerate(reversed(rows)):
        x = 0.0
        for sign in row:
            sign.draw(pen, x, pen.size[1] + (place + 1) * SIGN_ROW_HEIGHT)
            x += sign.wide + BETWEEN_SIGNS


def draw_lines(
    pen: Pen, time: Floats, shown: MotionPanel, numbers: Mapping[str, int], *, off: float
) -> None:
    """Draw the lines of a panel.

    Parameters
    ----------
    numbers : mapping of str to int
        Colour numbers of components, by name; lines of links have other colours.
    off : float
        Distance from the left edge to the title of the scale. [pt]
    """
    wide, style = pen.size[0], pen.style
    pen.scale("left", ticks_of(pen.y), grid=True)
    zero = pen.up(0.0)
    pen.line((0.0, zero), (wide, zero), color=style.soft, width=LEADER_WIDTH, zorder=0.5)
    further = (
        {"part": str(shown.part)} if shown.part > 1 else {}
    )  # panels of the same kind need distinct groups
    group = pen.within("panel", panel=shown.kind.replace("_", "-"), **further)
    for line in shown.lines:
        looks = line.looks(style, numbers)
        last = repr(float(line.values[-1]))
        for name, look in zip(line.names, looks, strict=True):
            if line.capacity is not None:
                _draw_capacity(group, name, line, time, look)
            line_group = group.within("line", name=name, last=last)
            line_group.plot(*thinned(time, line.values / shown.unit), title=short(name), **look)
    scale_title = what_of(shown, style)
    pen.name("left", scale_title, off + height(scale_title) / 2)


def what_of(shown: MotionPanel, style: Style) -> str:
    """Return the title of a panel's vertical scale."""
    return wrapped(style.text(shown.text), PANEL_HEIGHT)


def ticks_of(scale: AxisScale) -> list[float]:
    """Return the numbers printed along the scale of a panel."""
    return ticks(scale.low, scale.high, 5)


def _draw_capacity(pen: Pen, name: str, line: MotionLine, time: Floats, look: Look) -> None:
    """Draw the finite torque capacity of a shift element, on the side of its torque."""
    assert line.capacity is not None  # noqa: S101 - callers check
    side = capacity_side(line.values, line.capacity)
    drawn = np.where(np.isfinite(line.capacity), side * line.capacity, np.nan)
    turns = np.flatnonzero(np.diff(side)) + 1
    times, values = np.insert(time, turns, time[turns]), np.insert(drawn, turns, np.nan)
    group = pen.within("capacity", name=name, last=repr(float(line.capacity[-1])))
    text = pen.style.text("capacity")
    look = {"color": look["color"], **CAPACITY}
    group.plot(times, values, title=f"{short(name)}: {text}", zorder=1.8, **look)


def range_of(shown: MotionPanel) -> AxisScale:
    """Return the vertical scale of a panel in its unit, with 0, margins and other runs."""
    ends = [_ends(panel) for panel in (shown, *shown.others)]
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
