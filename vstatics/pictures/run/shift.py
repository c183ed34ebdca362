"""A run over time: states of the elements, speeds, slips, torques, heat, and what happens when."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

from vstatics.errors import CaseError, printable
from vstatics.numerics.arrays import Floats
from vstatics.pictures.run.events import (
    MOST_NAMED_EVENTS,
    draw_events,
    event_text,
    named_events,
)
from vstatics.pictures.run.lines import (
    ElementStates,
    MotionLine,
    MotionPanel,
    panels,
    states,
    thinned,
)
from vstatics.pictures.sheet.ends import LineEnd, along, beside, height_of, width_of
from vstatics.pictures.sheet.head import Meaning, headed
from vstatics.pictures.sheet.labels import LEADER, Label, height, ticks, widest, wrapped
from vstatics.pictures.sheet.line_styles import (
    Look,
    element_look,
    link_looks,
    spring_look,
    striped_look,
)
from vstatics.pictures.sheet.pen import AxisScale, Pen
from vstatics.pictures.sheet.style import LEADER_WIDTH, MARGIN, Style, number
from vstatics.pictures.sheet.words import TURN_TOGETHER, title
from vstatics.simulation.record.motion import Motion
from vstatics.statics.results import Results

PANEL_SIZE = (400.0, 92.0)
"""Width of a panel without its labels, and its height at least. [pt]"""
STATE_ROW_HEIGHT = 13.0
"""Of the states of an element. [pt]"""
STATE_BAR_HEIGHT = 0.6
"""Height of its bar over that."""
PANEL_SCALE_WIDTH = 64.0
"""For the scale of a panel, and what it is of. [pt]"""
TIME_SCALE_HEIGHT = 34.0
"""For the scale of the time. [pt]"""
LINE_NAME_WIDTH = 130.0
"""Names at the right are wrapped to this width. [pt]"""
SIGNS_ON_LINE = 4
"""Of an element or spring."""
MOST_LEFT_OUT = 12
"""Names of lines that are not drawn, of each panel."""


class _RunContent(NamedTuple):
    """What the picture shows."""

    motion: Motion
    panels: Sequence[MotionPanel]
    rows: Sequence[ElementStates]
    events: Sequence[Label]
    """Those that are named, at their times [s]."""


def draw(
    results: Results,
    style: Style,
    gears: Sequence[int] = (),  # noqa: ARG001 - a run has them all
    motion: Motion | None = None,
) -> list[Figure]:
    """Draw a run of a case.

    Raises
    ------
    CaseError
        If there is none, or nothing moves in it.
    """
    if motion is None:
        raise CaseError("E407", "this picture shows a run: expected a scenario, not a case")
    shown = panels(results.case, motion)
    if len(motion.time) < 2 or not shown:
        raise CaseError("E408", "a picture of a run shows what moves, and nothing moves in this")
    named = named_events(motion.events, MOST_NAMED_EVENTS)
    events = [Label(event.time, event_text(event, style), style.ink) for event in named]
    content = _RunContent(motion, shown, states(motion), events)
    subject = style.text("run over time", "движение во времени")
    return [_figure(content, printable(title(results.case, subject)), style)]


def _figure(content: _RunContent, name: str, style: Style) -> Figure:
    """The states of the elements, then the panels, on one scale of time."""
    motion, rows, (wide, least) = content.motion, content.rows, PANEL_SIZE
    ends = [_line_ends(panel, style) for panel in content.panels]
    heights = [max(least, height_of(own)) for own in ends]
    row_ends, states_high = _row_ends(rows, style), STATE_ROW_HEIGHT * len(rows)
    left = MARGIN + max(PANEL_SCALE_WIDTH, width_of(row_ends))
    across = left + wide + max(map(width_of, ends)) + MARGIN
    high = TIME_SCALE_HEIGHT + sum(heights) + MARGIN * (len(heights) - 1 + bool(rows))
    top = high + states_high
    above = widest(label.text for label in content.events) + LEADER + MARGIN / 2
    signs = _signs(content, style)
    pen = headed(name, _notes(content, style), signs, (across, top + above), style)
    time = AxisScale(float(motion.time[0]), float(motion.time[-1]))
    drawn: list[Pen] = []
    bottom = high - MARGIN * bool(rows)
    for one, tall in zip(content.panels, heights, strict=True):
        bottom -= tall
        drawn.append(pen.panel((left, bottom), (wide, tall), time, _range(one)))
        _draw_lines(drawn[-1], motion, one)
        bottom -= MARGIN
    if rows:
        scale = AxisScale(len(rows), 0)
        drawn.insert(0, pen.panel((left, high), (wide, states_high), time, scale))
        _draw_states(drawn[0], rows)
        beside(drawn[0], "left", row_ends)
    numbers = ticks(time.low, time.high, 8)
    for panel in drawn:
        panel.frame()
        panel.scale("bottom", numbers, None if panel is drawn[-1] else ())
        draw_events(panel, motion.events)
    at = [label._replace(at=drawn[0].across(label.at)) for label in content.events]
    along(drawn[0], "top", at, upright=True)
    drawn[-1].name("bottom", style.text("time, s", "время, с"), TIME_SCALE_HEIGHT - 12)
    return pen.figure


def _signs(content: _RunContent, style: Style) -> list[Meaning]:
    rows, lines = content.rows, [line for panel in content.panels for line in panel.lines]
    sticks, slips = (_state_look(style, sticks=one) for one in (True, False))
    striped = any(len(line.names) > 1 for line in lines)
    return [
        (any(row.sticks for row in rows), "sticks", "сцеплено", sticks),
        (any(row.slips for row in rows), "slips under torque", "буксует под моментом", slips),
        (striped, *TURN_TOGETHER, striped_look(style)),
    ]


def _notes(content: _RunContent, style: Style) -> str:
    """What the picture does not show."""
    motion, said = content.motion, []
    for panel in content.panels:
        if panel.left_out:
            names = ", ".join(panel.left_out[:MOST_LEFT_OUT])
            more = len(panel.left_out) - MOST_LEFT_OUT
            names += style.text(f" and {more} more", f" и ещё {more}") if more > 0 else ""
            of = style.text(panel.english, panel.russian).split(", ")[0]
            said.append(f"{of}, {style.text('not drawn', 'не показаны')}: {names}")
    unnamed = len(motion.events) - MOST_NAMED_EVENTS
    if unnamed > 0:
        said.append(f"{style.text('events without a name', 'событий без подписи')}: {unnamed}")
    if motion.stopped is not None:
        stopped = style.text("the run was stopped", "расчёт остановлен")
        said.append(f"{stopped}: {printable(motion.stopped.message)[:200]}")
    return "; ".join(said)


def _looks(line: MotionLine, place: int, style: Style) -> list[Look]:
    """Of the line of links, or of a shift element or spring."""
    if line.links:
        return link_looks(line.links, style)
    if line.element is None:
        return [spring_look(place, style)]
    return [element_look(line.element, style)]


def _line_ends(shown: MotionPanel, style: Style) -> list[LineEnd]:
    """The names of lines at their last values."""
    scale = _range(shown)
    return [
        LineEnd(
            scale.part(float(line.values[-1])),
            [wrapped(name, LINE_NAME_WIDTH) for name in line.names],
            [look for one in line.each for look in _looks(one, place, style)],
        )
        for place, line in enumerate(shown.lines)
    ]


def _row_ends(rows: Sequence[ElementStates], style: Style) -> list[LineEnd]:
    """The names of elements beside their bars, with their lines in the panels."""
    return [
        LineEnd(1 - (place + 0.5) / len(rows), [row.name], [element_look(row.element, style)])
        for place, row in enumerate(rows)
    ]


def _draw_lines(pen: Pen, motion: Motion, shown: MotionPanel) -> None:
    """The lines of a panel with their names at the right, at their last values."""
    wide, style = pen.size[0], pen.style
    pen.scale("left", ticks(pen.y.low, pen.y.high, 5), grid=True)
    rest = pen.up(0.0)
    pen.line((0.0, rest), (wide, rest), color=style.soft, width=LEADER_WIDTH, zorder=0.5)
    for place, line in enumerate(shown.lines):
        time, values = thinned(motion.time, line.values)
        marked = _signs_at(time, place, len(shown.lines))
        for look in _looks(line, place, style):
            pen.plot(time, values, markevery=marked, title=line.name, **look)
    beside(pen, "right", _line_ends(shown, style))
    what = wrapped(style.text(shown.english, shown.russian), PANEL_SIZE[1])
    pen.name("left", what, PANEL_SCALE_WIDTH - height(what) / 2)


def _signs_at(time: Floats, place: int, count: int) -> list[int]:
    """The points of a line that get its sign: no two lines have theirs at the same time.

    >>> _signs_at(np.linspace(0.0, 1.0, 21), 1, 2)
    [4, 9, 14, 19]
    """
    parts = (np.arange(SIGNS_ON_LINE) + (place + 0.5) / count) / SIGNS_ON_LINE
    near = np.searchsorted(time, time[0] + parts * (time[-1] - time[0]))
    return sorted({int(one) for one in near})


def _range(shown: MotionPanel) -> AxisScale:
    """A scale that has 0."""
    low = min(0.0, *(float(np.min(line.values)) for line in shown.lines))
    high = max(0.0, *(float(np.max(line.values)) for line in shown.lines))
    room = 0.06 * (high - low) if math.isfinite(high - low) and high > low else 1.0
    return AxisScale(low - room, high + room)


def _state_look(style: Style, *, sticks: bool) -> Look:
    """Of a bar while an element sticks, or slips under torque."""
    inside = {"facecolor": style.engaged} if sticks else {"facecolor": style.paper, "hatch": "////"}
    return {"edgecolor": style.engaged, "width": 0.5, **inside}


def _draw_states(pen: Pen, rows: Sequence[ElementStates]) -> None:
    """A bar for each element that carries torque."""
    style, high = pen.style, STATE_BAR_HEIGHT * STATE_ROW_HEIGHT
    for place, row in enumerate(rows):
        low = pen.up(place + 0.5) - high / 2
        for spans, does, sticks in (
            (row.sticks, style.text("sticks", "сцеплено"), True),
            (row.slips, style.text("slips", "буксует"), False),
        ):
            look = _state_look(style, sticks=sticks)
            for start, end in spans:
                left, right = pen.across(start), pen.across(end)
                said = f"{row.name} {does}, {number(start)}–{number(end)} {style.text('s', 'с')}"
                pen.box((left, low), (right - left, high), title=said, **look)
