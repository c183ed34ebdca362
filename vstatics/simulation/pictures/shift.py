"""Picture of a run over time: gears and shift elements, speeds, slips, torques, heat, events."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import CaseError, printable
from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.canvas import Canvas
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
"""Distance between the title and the numbers of a scale. [pt]"""
TIME_SCALE_HEIGHT = 30.0
"""Height of the time scale. [pt]"""
MOST_ROWS, MOST_OTHER_ROWS = 14, 6
"""Largest number of rows of shift elements, and of other components and sequences."""
BETWEEN_PANELS = 9.0
"""Distance between panels. [pt]"""
NARROW = 150.0
"""Width of a panel below which the names of lines are above it. [pt]"""
TICKS_APART = 28.0
"""Smallest distance between numbers of the time scale. [pt]"""


class _Content(NamedTuple):
    """Content and layout of the picture of a run."""

    motion: Motion
    panels: Sequence[MotionPanel]
    rows: RunRows
    numbers: Mapping[str, int]
    left: float
    """Width to the left of panels, for scales and row names. [pt]"""
    off: float
    """Distance from a panel to the title of the scale. [pt]"""
    wide: float
    """Width of a panel, without scale and names. [pt]"""
    over: bool
    """True if the names of lines are above the panels, False if to the right."""
    notes: str

    def names_high(self, panel: MotionPanel, style: Style) -> float:
        """Return the height of the names above a panel [pt]."""
        rows = names_over(panel, style, self.numbers, self.wide) if self.over else []
        return SIGN_ROW_HEIGHT * len(rows)

    def high(self, panel: MotionPanel, style: Style) -> float:
        """Return the height of a panel, including the names of lines [pt]."""
        if self.over:
            return PANEL_HEIGHT + self.names_high(panel, style)
        return max(PANEL_HEIGHT, height_of(line_ends(panel, style, self.numbers)))


def draw(
    results: Results,
    style: Style,
    gears: Sequence[int] = (),  # noqa: ARG001 - a run shows all gears
    motion: Motion | None = None,
    others: Sequence[tuple[Results, Motion]] = (),
) -> list[Canvas]:
    """Draw a run of a case on one or more pages, on scales that also cover the other runs.

    Raises
    ------
    CaseError
        If the run is missing, or if nothing moves.
    """
    if motion is None:
        raise CaseError(
            "E407", "this picture shows a run over time: expected a scenario, not a case"
        )
    shown = panels(results.case, motion)
    if len(motion.time) < 2 or all(panel.kind == "heat" for panel in shown):
        raise CaseError("E408", "nothing moves in this run, so there is nothing to draw")
    panels_of_others = [panel for other, run in others for panel in panels(other.case, run)]
    shown = [panel.with_scale_of(panels_of_others) for panel in shown]
    content = _content(results, motion, shown, style)
    name = printable(title(results.case, style.text("run over time")))
    return list(_pages(content, name, style))


def _content(
    results: Results, motion: Motion, shown: Sequence[MotionPanel], style: Style
) -> _Content:
    elements = states(motion)
    numbers = numbers_of([element.name for element in elements], shown)
    with_rows = elements[:MOST_ROWS]
    names = [element.name for element in with_rows]
    happens = dict.fromkeys(event.element for event in motion.events)
    others = [name for name in happens if name not in names]
    ticked = max(widest(tick_texts(ticks_of(range_of(panel)))) for panel in shown) + TICK_LENGTH + 2
    off = ticked + BEFORE_SCALE
    scale = off + max(height(what_of(panel, style)) for panel in shown)
    left = MARGIN + max(scale, name_width([*names, *others[:MOST_OTHER_ROWS]], style))
    right = max(width_of(line_ends(panel, style, numbers)) for panel in shown)
    wide = style.width - left - right - MARGIN
    over = wide < NARROW
    if over:
        wide = style.width - left - MARGIN
    time = blank(0.0, 0.0, style).panel((0.0, 0.0), (wide, 0.0), _time(motion))
    rows = run_rows(with_rows, others[:MOST_OTHER_ROWS], motion.events, time)
    sets = element_sets(results)
    pieces = gear_pieces(sets, motion, elements)
    between = phases(sets, motion, pieces, elements)
    unseen = [element.name for element in elements[MOST_ROWS:]]
    unseen += [name for name in others[MOST_OTHER_ROWS:] if name not in unseen]
    all_rows = RunRows(pieces, between, rows, common(sets, motion))
    notes = _notes(motion, shown, all_rows, unseen, style)
    return _Content(motion, shown, all_rows, numbers, left, off, wide, over, notes)


def _time(motion: Motion) -> AxisScale:
    return AxisScale(float(motion.time[0]), float(motion.time[-1]))


def _pages(content: _Content, name: str, style: Style) -> Iterator[Canvas]:
    shown, rows = content.panels, content.rows
    heights = [content.high(panel, style) for panel in shown]
    start, page = 0, 1
    while start < len(shown):
        page_name, notes, signs = f"{name} ({page})", "", []
        if page == 1:
            page_name, notes, signs = name, content.notes, _signs(content, style)
        head = sheet_head(page_name, notes, signs, style.width - 2 * MARGIN, style)
        over = (rows.high + BETWEEN_PANELS) * (page == 1)
        free = style.height - head.high - MARGIN - TIME_SCALE_HEIGHT - over
        ends = np.cumsum(heights[start:]) + BETWEEN_PANELS * np.arange(len(shown) - start)
        count = max(1, int((ends <= free).sum()))
        on_page = slice(start, start + count)
        high = sum(heights[on_page]) + BETWEEN_PANELS * (count - 1)
        top = TIME_SCALE_HEIGHT + high + over
        pen = head.over((style.width, top), MARGIN, style)
        upper: list[Pen] = []
        if page == 1:
            corner = content.left, top - rows.high
            upper = [pen.panel(corner, (content.wide, rows.high), _time(content.motion))]
            draw_rows(upper[0], rows, content.numbers)
        inner = pen.panel((content.left, TIME_SCALE_HEIGHT), (content.wide, high))
        _draw_panels(inner, content, on_page, heights[on_page], upper)
        yield pen.canvas
        start, page = start + count, page + 1


def _draw_panels(
    pen: Pen, content: _Content, on_page: slice, heights: Sequence[float], upper: Sequence[Pen]
) -> None:
    top, time = pen.size[1], _time(content.motion)
    drawn: list[Pen] = []
    for shown, high in zip(content.panels[on_page], heights, strict=True):
        corner = pen.corner[0], pen.corner[1] + top - high
        inner = pen.size[0], high - content.names_high(shown, pen.style)
        drawn.append(pen.panel(corner, inner, time, range_of(shown)))
        draw_lines(drawn[-1], content.motion.time, shown, content.numbers, off=content.off)
        drawn[-1].frame()
        if content.over:
            rows = names_over(shown, pen.style, content.numbers, content.wide)
            draw_names_over(drawn[-1], rows)
        else:
            beside(drawn[-1], "right", line_ends(shown, pen.style, content.numbers))
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
    """Return the remarks below the title about contents that the picture leaves out."""
    remarks = []
    if unseen:
        names = ", ".join(map(short, unseen))
        remarks.append(f"{style.text('without a row')}: {names}")
    unnamed = len(motion.events) - sum(len(row.words) for row in rows.rows)
    if unnamed > 0:
        remarks.append(f"{style.text('events without a word')}: {unnamed}")
    if motion.stopped is not None:
        stopped = style.text("the run was stopped")
        remarks.append(f"{stopped}: {printable(motion.stopped.message)[:200]}")
    for panel in shown:
        if panel.left_out:
            quantity = style.text(panel.text).split(", ")[0]
            names = ", ".join(panel.left_out)
            remarks.append(f"{quantity}, {style.text('left out')}: {names}")
    return "; ".join(remarks)
