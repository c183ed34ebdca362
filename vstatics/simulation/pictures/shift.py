"""A run over time: gears, states of elements, speeds, slips, torques, heat; what happens when."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

from vstatics.core.errors import CaseError, printable
from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.ends import beside, height_of, width_of
from vstatics.pictures.drawing.head import SIGN_ROW_HEIGHT, Meaning, sheet_head
from vstatics.pictures.drawing.labels import height, ticks, widest
from vstatics.pictures.drawing.line_styles import striped_look
from vstatics.pictures.drawing.pen import AxisScale, Pen, blank, tick_texts
from vstatics.pictures.drawing.style import MARGIN, TICK_LENGTH, Style
from vstatics.pictures.drawing.words import TURN_TOGETHER, title
from vstatics.pictures.runs import short
from vstatics.simulation.pictures.elements import states
from vstatics.simulation.pictures.events import draw_verticals
from vstatics.simulation.pictures.gears import common, element_sets, gear_pieces, phases
from vstatics.simulation.pictures.line_panel import (
    CAPACITY,
    PANEL_HEIGHT,
    draw_lines,
    draw_names_over,
    line_ends,
    names_over,
    range_of,
    ticks_of,
    what_of,
)
from vstatics.simulation.pictures.lines import MotionPanel, numbers_of
from vstatics.simulation.pictures.panels import panels
from vstatics.simulation.pictures.rows import RunRows, draw_rows, name_width, run_rows
from vstatics.simulation.record.motion import Motion

BEFORE_SCALE = 3.0
"""From what a scale is of to its numbers. [pt]"""
TIME_SCALE_HEIGHT = 30.0
"""For the scale of the time. [pt]"""
MOST_ROWS, MOST_OTHER_ROWS = 14, 6
"""Of elements, and of what else has events."""
BETWEEN_PANELS = 9.0
"""[pt]"""
NARROW = 150.0
"""Where a panel would be less wide, names stand over it. [pt]"""
TICKS_APART = 28.0
"""Numbers of the time, at least. [pt]"""


class _Content(NamedTuple):
    """What the picture shows."""

    motion: Motion
    panels: Sequence[MotionPanel]
    rows: RunRows
    numbers: Mapping[str, int]
    left: float
    """For scales and names of rows. [pt]"""
    off: float
    """From a panel to what its scale is of. [pt]"""
    wide: float
    """Of a panel without its labels. [pt]"""
    over: bool
    """Whether names of lines are over the panels."""
    notes: str

    def names_high(self, panel: MotionPanel, style: Style) -> float:
        """That names over a panel need [pt]."""
        rows = names_over(panel, style, self.numbers, self.wide) if self.over else []
        return SIGN_ROW_HEIGHT * len(rows)

    def high(self, panel: MotionPanel, style: Style) -> float:
        """Of a panel with the names of its lines [pt]."""
        if self.over:
            return PANEL_HEIGHT + self.names_high(panel, style)
        return max(PANEL_HEIGHT, height_of(line_ends(panel, style, self.numbers)))


def draw(
    results: Results,
    style: Style,
    gears: Sequence[int] = (),  # noqa: ARG001 - a run has them all
    motion: Motion | None = None,
    others: Sequence[tuple[Results, Motion]] = (),
) -> list[Figure]:
    """Draw a run of a case, on as many pages as it needs, with the scales of other runs, too.

    Raises
    ------
    CaseError
        If there is none, or nothing moves in it.
    """
    if motion is None:
        raise CaseError("E407", "this picture shows a run: expected a scenario, not a case")
    shown = panels(results.case, motion)
    if len(motion.time) < 2 or all(panel.kind == "heat" for panel in shown):
        raise CaseError("E408", "a picture of a run shows what moves, and nothing moves in this")
    there = [panel for other, run in others for panel in panels(other.case, run)]
    shown = [panel.beside(there) for panel in shown]
    content = _content(results, motion, shown, style)
    name = printable(title(results.case, style.text("run over time")))
    return list(_pages(content, name, style))


def _content(
    results: Results, motion: Motion, shown: Sequence[MotionPanel], style: Style
) -> _Content:
    elements = states(motion)
    numbers = numbers_of([one.name for one in elements], shown)
    with_rows = elements[:MOST_ROWS]
    names = [one.name for one in with_rows]
    happens = dict.fromkeys(event.element for event in motion.events)
    others = [name for name in happens if name not in names]
    ticked = max(widest(tick_texts(ticks_of(range_of(one)))) for one in shown) + TICK_LENGTH + 2
    off = ticked + BEFORE_SCALE
    scale = off + max(height(what_of(one, style)) for one in shown)
    left = MARGIN + max(scale, name_width([*names, *others[:MOST_OTHER_ROWS]], style))
    right = max(width_of(line_ends(one, style, numbers)) for one in shown)
    wide = style.width - left - right - MARGIN
    over = wide < NARROW
    if over:
        wide = style.width - left - MARGIN
    time = blank(0.0, 0.0, style).panel((0.0, 0.0), (wide, 0.0), _time(motion))
    rows = run_rows(with_rows, others[:MOST_OTHER_ROWS], motion.events, time)
    sets = element_sets(results)
    pieces = gear_pieces(sets, motion)
    between = phases(sets, motion, pieces, elements)
    unseen = [one.name for one in elements[MOST_ROWS:]]
    unseen += [name for name in others[MOST_OTHER_ROWS:] if name not in unseen]
    of = RunRows(pieces, between, rows, common(sets, motion))
    notes = _notes(motion, shown, of, unseen, style)
    return _Content(motion, shown, of, numbers, left, off, wide, over, notes)


def _time(motion: Motion) -> AxisScale:
    return AxisScale(float(motion.time[0]), float(motion.time[-1]))


def _pages(content: _Content, name: str, style: Style) -> Iterator[Figure]:
    """The rows, then the panels: as many on a page as it has room for."""
    shown, rows = content.panels, content.rows
    heights = [content.high(one, style) for one in shown]
    start, page = 0, 1
    while start < len(shown):
        own, notes, signs = f"{name} ({page})", "", []
        if page == 1:
            own, notes, signs = name, content.notes, _signs(content, style)
        head = sheet_head(own, notes, signs, style.width - 2 * MARGIN, style)
        over = (rows.high + BETWEEN_PANELS) * (page == 1)
        free = style.height - head.high - MARGIN - TIME_SCALE_HEIGHT - over
        count = _fitting(heights[start:], free)
        of = slice(start, start + count)
        high = sum(heights[of]) + BETWEEN_PANELS * (count - 1)
        top = TIME_SCALE_HEIGHT + high + over
        pen = head.over((style.width, top), MARGIN, style)
        upper: list[Pen] = []
        if page == 1:
            corner = content.left, top - rows.high
            upper = [pen.panel(corner, (content.wide, rows.high), _time(content.motion))]
            draw_rows(upper[0], rows, content.numbers)
        inner = pen.panel((content.left, TIME_SCALE_HEIGHT), (content.wide, high))
        _draw_panels(inner, content, of, heights[of], upper)
        yield pen.figure
        start, page = start + count, page + 1


def _fitting(heights: Sequence[float], free: float) -> int:
    """How many panels a height has room for, one at least."""
    ends = np.cumsum(heights) + BETWEEN_PANELS * np.arange(len(heights))
    return max(1, int((ends <= free).sum()))


def _draw_panels(
    pen: Pen, content: _Content, of: slice, heights: Sequence[float], upper: Sequence[Pen]
) -> None:
    """Panels one below the other, with one scale of time for them and for what is above."""
    top, time = pen.size[1], _time(content.motion)
    drawn: list[Pen] = []
    for one, high in zip(content.panels[of], heights, strict=True):
        corner = pen.corner[0], pen.corner[1] + top - high
        inner = pen.size[0], high - content.names_high(one, pen.style)
        drawn.append(pen.panel(corner, inner, time, range_of(one)))
        draw_lines(drawn[-1], content.motion.time, one, content.numbers, off=content.off)
        drawn[-1].frame()
        if content.over:
            rows = names_over(one, pen.style, content.numbers, content.wide)
            draw_names_over(drawn[-1], rows)
        else:
            beside(drawn[-1], "right", line_ends(one, pen.style, content.numbers))
        top -= high + BETWEEN_PANELS
    numbers = ticks(time.low, time.high, min(8, max(2, int(content.wide / TICKS_APART))))
    for panel in drawn:
        panel.scale("bottom", numbers, None if panel is drawn[-1] else ())
    named = [word.event.time for row in content.rows.rows for word in row.words]
    for panel in (*upper, *drawn):
        draw_verticals(panel, named)
    drawn[-1].name("bottom", pen.style.text("time, s"), TIME_SCALE_HEIGHT - 10)


def _signs(content: _Content, style: Style) -> list[Meaning]:
    lines = [line for panel in content.panels for line in panel.lines]
    striped = any(len(line.names) > 1 for line in lines)
    limited = any(line.capacity is not None for line in lines)
    return [
        *content.rows.meanings(style),
        (limited, "capacity", {"color": style.ink, **CAPACITY}),
        (striped, TURN_TOGETHER, striped_look(style)),
    ]


def _notes(
    motion: Motion, shown: Sequence[MotionPanel], rows: RunRows, unseen: Sequence[str], style: Style
) -> str:
    """What the picture does not show."""
    said = []
    if unseen:
        names = ", ".join(map(short, unseen))
        said.append(f"{style.text('without a row')}: {names}")
    unnamed = len(motion.events) - sum(len(row.words) for row in rows.rows)
    if unnamed > 0:
        said.append(f"{style.text('events without a word')}: {unnamed}")
    if motion.stopped is not None:
        stopped = style.text("the run was stopped")
        said.append(f"{stopped}: {printable(motion.stopped.message)[:200]}")
    for panel in shown:
        if panel.left_out:
            of = style.text(panel.text).split(", ")[0]
            names = ", ".join(panel.left_out)
            said.append(f"{of}, {style.text('left out')}: {names}")
    return "; ".join(said)
