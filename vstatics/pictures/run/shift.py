"""A run over time: states of the elements, speeds, slips, torques, heat, and what happens when."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.figure import Figure

from vstatics.errors import CaseError, Problem, printable
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
from vstatics.pictures.sheet import labels
from vstatics.pictures.sheet.chart import AxisScale, Chart
from vstatics.pictures.sheet.ends import LineEnd, along, beside, height_of, width_of
from vstatics.pictures.sheet.head import ChartHead, KeySign, chart_head
from vstatics.pictures.sheet.labels import LEADER, Label, Paper
from vstatics.pictures.sheet.line_styles import (
    Look,
    element_look,
    link_looks,
    spring_look,
    striped_look,
)
from vstatics.pictures.sheet.style import Style, number
from vstatics.pictures.sheet.svg import told
from vstatics.pictures.sheet.words import title
from vstatics.simulation.record.motion import Motion
from vstatics.statics.results import Results

WIDE, HIGH = 400.0, 92.0
"""Of a panel without its labels. [pt]"""
STATE_ROW_HEIGHT = 13.0
"""Of the states of an element. [pt]"""
STATE_BAR_HEIGHT = 0.6
"""Height of its bar over that."""
PANEL_GAP = 12.0
"""Between panels. [pt]"""
RUN_MARGIN = 12.0
"""[pt]"""
PANEL_SCALE_WIDTH = 64.0
"""For the scale of a panel, and what it is of. [pt]"""
TIME_SCALE_HEIGHT = 34.0
"""For the scale of the time. [pt]"""
LINE_NAME_WIDTH = 130.0
"""Names at the right are wrapped to this width. [pt]"""
SIGNS = 4
"""On a line of an element or spring."""
LEFT_OUT = 12
"""Names of lines that are not drawn, of each panel."""


class _RunContent(NamedTuple):
    """What the picture shows."""

    motion: Motion
    panels: Sequence[MotionPanel]
    rows: Sequence[ElementStates]
    events: Sequence[Label]
    """Those that are named, at their times [s]."""


class _RunLayout(NamedTuple):
    """Where the parts of the picture stand; lengths in points."""

    left: float
    size: tuple[float, float]
    head: ChartHead
    rows_bottom: float
    """Of the states of the elements."""
    corners: tuple[tuple[float, float], ...]
    """Bottom and height of each panel."""


def draw(
    results: Results,
    style: Style,
    gears: Sequence[int] = (),  # noqa: ARG001 - a run has them all
    motion: Motion | None = None,
) -> Figure:
    """Draw a run of a case.

    Raises
    ------
    CaseError
        If there is none, or nothing moves in it.
    """
    if motion is None:
        raise CaseError([Problem("this picture shows a run: expected a scenario, not a case")])
    shown = panels(results.case, motion)
    if len(motion.time) < 2 or not shown:
        raise CaseError([Problem("a picture of a run shows what moves, and nothing moves in this")])
    named = named_events(motion.events, MOST_NAMED_EVENTS)
    events = [Label(event.time, event_text(event, style), style.ink) for event in named]
    content = _RunContent(motion, shown, states(motion), events)
    subject = style.text("run over time", "движение во времени")
    return _figure(content, printable(title(results.case, subject)), style)


def _figure(content: _RunContent, name: str, style: Style) -> Figure:
    """The states of the elements, then the panels, on one scale of time."""
    motion, layout = content.motion, _layout(content, name, style)
    paper = Paper(labels.figure(*layout.size))
    layout.head.draw(paper, RUN_MARGIN, layout.size[1] - RUN_MARGIN, style)
    time = AxisScale(float(motion.time[0]), float(motion.time[-1]))
    drawn = [
        Chart(paper, (layout.left, bottom), WIDE, high, time, _range(one))
        for one, (bottom, high) in zip(content.panels, layout.corners, strict=True)
    ]
    for one, chart in zip(content.panels, drawn, strict=True):
        _draw_lines(chart, motion, one, style)
    if content.rows:
        count = len(content.rows)
        corner = layout.left, layout.rows_bottom
        drawn.insert(
            0, Chart(paper, corner, WIDE, STATE_ROW_HEIGHT * count, time, AxisScale(count, 0))
        )
        _draw_states(drawn[0], content.rows, style)
    ticks = labels.ticks(time.low, time.high, 8)
    for chart in drawn:
        chart.frame(style, "left", "right", "bottom", "top")
        chart.scale("bottom", ticks, style, None if chart is drawn[-1] else ())
        draw_events(chart, motion.events, style)
    at = [label._replace(at=drawn[0].across(label.at)) for label in content.events]
    along(drawn[0], "top", at, style, upright=True)
    drawn[-1].name("bottom", style.text("time, s", "время, с"), TIME_SCALE_HEIGHT - 12)
    return paper.figure


def _layout(content: _RunContent, name: str, style: Style) -> _RunLayout:
    shown, rows = content.panels, content.rows
    ends = [_line_ends(panel, HIGH, style) for panel in shown]
    right = max(map(width_of, ends)) + RUN_MARGIN
    left = RUN_MARGIN + max(PANEL_SCALE_WIDTH, width_of(_row_ends(rows, style)))
    wide = left + WIDE + right
    head = chart_head(name, _notes(content, style), _signs(content, style), wide - 24, style)
    events = max((labels.width(label.text) for label in content.events), default=0.0) + LEADER
    down = RUN_MARGIN + head.high + events + PANEL_GAP / 2
    down += STATE_ROW_HEIGHT * len(rows)
    rows_bottom, corners = down, []
    down += PANEL_GAP if rows else 0.0
    for own in ends:
        high = max(HIGH, height_of(own))
        corners.append((down + high, high))
        down += high + PANEL_GAP
    high = down - PANEL_GAP + TIME_SCALE_HEIGHT
    places = tuple((high - bottom, own) for bottom, own in corners)
    return _RunLayout(left, (wide, high), head, high - rows_bottom, places)


def _wrapped(name: str) -> str:
    return labels.wrapped(name, LINE_NAME_WIDTH)


def _signs(content: _RunContent, style: Style) -> list[KeySign]:
    """The key, of what occurs."""
    signs = []
    if any(row.sticks for row in content.rows):
        signs.append(KeySign(style.text("sticks", "сцеплено"), _state_look(style, sticks=True)))
    if any(row.slips for row in content.rows):
        text = style.text("slips under torque", "буксует под моментом")
        signs.append(KeySign(text, _state_look(style, sticks=False)))
    if any(len(line.names) > 1 for panel in content.panels for line in panel.lines):
        text = style.text("striped: links turn together", "полосы: звенья вращаются вместе")
        signs.append(KeySign(text, striped_look(style)))
    return signs


def _notes(content: _RunContent, style: Style) -> str:
    """What the picture does not show."""
    motion, said = content.motion, []
    for panel in content.panels:
        if panel.left_out:
            names = ", ".join(panel.left_out[:LEFT_OUT])
            more = len(panel.left_out) - LEFT_OUT
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


def _line_ends(shown: MotionPanel, height: float, style: Style) -> list[LineEnd]:
    """The names of lines at their last values, in a panel of a height [pt]."""
    scale = _range(shown)
    return [
        LineEnd(
            scale.part(float(line.values[-1])) * height,
            tuple(_wrapped(name) for name in line.names),
            tuple(look for one in line.each for look in _looks(one, place, style)),
        )
        for place, line in enumerate(shown.lines)
    ]


def _row_ends(rows: Sequence[ElementStates], style: Style) -> list[LineEnd]:
    """The names of elements beside their bars, with their lines in the panels."""
    high = STATE_ROW_HEIGHT * len(rows)
    return [
        LineEnd(
            high - STATE_ROW_HEIGHT * (place + 0.5),
            (row.name,),
            (element_look(row.element, style),),
        )
        for place, row in enumerate(rows)
    ]


def _draw_lines(chart: Chart, motion: Motion, shown: MotionPanel, style: Style) -> None:
    """The lines of a panel with their names at the right, at their last values."""
    ticks = labels.ticks(chart.y.low, chart.y.high, 5)
    chart.scale("left", ticks, style, grid=True)
    rest = chart.up(0.0)
    chart.line((0.0, rest), (chart.width, rest), color=style.soft, linewidth=0.6, zorder=0.5)
    for place, line in enumerate(shown.lines):
        time, values = thinned(motion.time, line.values)
        for look in _looks(line, place, style):
            how: dict[str, Any] = {"linewidth": 1.3, "gid": told(line.name), **look}
            chart.plot(time, values, markevery=_signs_at(time, place, len(shown.lines)), **how)
    beside(chart, "right", _line_ends(shown, chart.height, style), style)
    what = labels.wrapped(style.text(shown.english, shown.russian), HIGH)
    chart.name("left", what, PANEL_SCALE_WIDTH - labels.height(what) / 2)


def _signs_at(time: Floats, place: int, count: int) -> list[int]:
    """The points of a line that get its sign: no two lines have theirs at the same time.

    >>> _signs_at(np.linspace(0.0, 1.0, 21), 1, 2)
    [4, 9, 14, 19]
    """
    parts = (np.arange(SIGNS) + (place + 0.5) / count) / SIGNS
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
    edge: Look = {"edgecolor": style.engaged, "linewidth": 0.5}
    inside = {"facecolor": style.engaged} if sticks else {"facecolor": style.paper, "hatch": "////"}
    return edge | inside


def _draw_states(chart: Chart, rows: Sequence[ElementStates], style: Style) -> None:
    """A bar for each element that carries torque."""
    high = STATE_BAR_HEIGHT * STATE_ROW_HEIGHT
    for place, row in enumerate(rows):
        low = chart.up(place + 0.5) - high / 2
        for spans, sticks in ((row.sticks, True), (row.slips, False)):
            look = _state_look(style, sticks=sticks)
            does = style.text("sticks", "сцеплено") if sticks else style.text("slips", "буксует")
            for start, end in spans:
                left, right = chart.across(start), chart.across(end)
                said = told(
                    f"{row.name} {does}, {number(start)}–{number(end)} {style.text('s', 'с')}"
                )
                chart.box((left, low), (right - left, high), gid=said, **look)
    beside(chart, "left", _row_ends(rows, style), style)
