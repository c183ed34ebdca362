"""A run over time: states of the elements, speeds, slips, torques, heat, and what happens when."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.figure import Figure

from vstatics.errors import CaseError, Problem, printable
from vstatics.pictures import labels
from vstatics.pictures.labels import LEADER, Label, Panel
from vstatics.pictures.shift_lines import (
    ElementStates,
    MotionPanel,
    event_text,
    panels,
    states,
    thinned,
    told,
)
from vstatics.pictures.style import TITLE, Style
from vstatics.pictures.words import title
from vstatics.simulation.motion import Event, Motion
from vstatics.statics.results import Results

WIDE, HIGH = 400.0, 92.0
"""Of a panel without its labels. [pt]"""
ROW = 12.0
"""Of the states of an element. [pt]"""
GAP = 12.0
"""Between panels. [pt]"""
MARGIN = 12.0
"""[pt]"""
SCALE = 66.0
"""For the scale of a panel, and what it is of. [pt]"""
NUMBERS = 38.0
"""For the scale alone. [pt]"""
BELOW = 34.0
"""For the scale of the time. [pt]"""
LONGEST = 130.0
"""Names at the right are wrapped to this width. [pt]"""
LABELS = 24
"""Events that are named."""
DASHES = ("solid", (0, (5, 2)), (0, (1, 1.5)), (0, (5, 1.5, 1, 1.5)))
"""What tells lines of one colour apart."""


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
    head: str
    notes: str
    rows_bottom: float
    """Of the states of the elements."""
    bottoms: tuple[float, ...]
    """Of the panels."""


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
    named = told(motion.events, LABELS)
    events = [Label(event.time, event_text(event, style), style.ink) for event in named]
    content = _RunContent(motion, shown, states(motion), events)
    subject = style.text("run over time", "движение во времени")
    return _figure(content, printable(title(results.case, subject)), style)


def _figure(content: _RunContent, name: str, style: Style) -> Figure:
    """The states of the elements, then the panels, on one scale of time."""
    motion, layout = content.motion, _layout(content, name, style)
    wide, high = layout.size
    figure = labels.figure(wide, high)
    how: dict[str, Any] = {"ha": "left", "va": "top", "linespacing": labels.LINE}
    figure.text(MARGIN / wide, 1 - MARGIN / high, layout.head, fontsize=TITLE, **how)
    notes_high = labels.height(layout.notes) + MARGIN / 2
    figure.text(MARGIN / wide, notes_high / high, layout.notes, color=style.soft, **how)
    drawn = [labels.panel(figure, layout.left, bottom, WIDE, HIGH) for bottom in layout.bottoms]
    for one, panel in zip(content.panels, drawn, strict=True):
        _draw_lines(panel, motion, one, style)
    if content.rows:
        high = ROW * len(content.rows)
        drawn.insert(0, labels.panel(figure, layout.left, layout.rows_bottom, WIDE, high))
        _draw_states(drawn[0], content.rows, style)
    for panel in drawn:
        panel.axes.set_xlim(motion.time[0], motion.time[-1])
        panel.axes.set_xticks(labels.ticks(motion.time[0], motion.time[-1], 8))
        panel.axes.tick_params(axis="x", labelbottom=panel is drawn[-1], length=2)
        _draw_events(panel, motion.events, style)
    at = [label._replace(at=drawn[0].across(label.at)) for label in content.events]
    drawn[0].along("top", at, upright=True)
    drawn[-1].axes.set_xlabel(style.text("time, s", "время, с"), labelpad=2)
    return figure


def _layout(content: _RunContent, name: str, style: Style) -> _RunLayout:
    shown, rows = content.panels, content.rows
    names = [_wrapped(line.name) for panel in shown for line in panel.lines]
    right = LEADER + max(map(labels.width, names)) + MARGIN
    left = MARGIN + max(SCALE, *(labels.width(row.name) + LEADER for row in rows), 0.0)
    wide = left + WIDE + right
    head = labels.wrapped(name, wide - 2 * MARGIN, TITLE)
    notes = labels.wrapped(_notes(content, style), wide - 2 * MARGIN)
    heads = max((labels.width(label.text) for label in content.events), default=0.0) + LEADER
    down = MARGIN + labels.height(head, TITLE) + heads + GAP
    down += ROW * len(rows) + (GAP if rows else 0.0)
    below = BELOW + (labels.height(notes) + MARGIN if notes else MARGIN / 2)
    high = down + len(shown) * (HIGH + GAP) - GAP + below
    bottoms = [high - down - HIGH - number * (HIGH + GAP) for number in range(len(shown))]
    return _RunLayout(left, (wide, high), head, notes, high - down + GAP, tuple(bottoms))


def _wrapped(name: str) -> str:
    return labels.wrapped(name, LONGEST)


def _notes(content: _RunContent, style: Style) -> str:
    """What the picture does not show, and how bars are to be read."""
    motion, said = content.motion, []
    if content.rows:
        said.append(
            style.text(
                "full bars: sticks; hatched: slips under torque",
                "сплошные полосы: сцеплено; штриховые: буксует под моментом",
            )
        )
    left_out = sum(panel.left_out for panel in content.panels)
    if left_out:
        said.append(f"{style.text('lines not drawn', 'линий не показано')}: {left_out}")
    unnamed = len(motion.events) - LABELS
    if unnamed > 0:
        said.append(f"{style.text('events without a name', 'событий без подписи')}: {unnamed}")
    if motion.stopped is not None:
        stopped = style.text("the run was stopped", "расчёт остановлен")
        said.append(f"{stopped}: {printable(motion.stopped.message)[:200]}")
    return "; ".join(said)


def _draw_lines(panel: Panel, motion: Motion, shown: MotionPanel, style: Style) -> None:
    """The lines of a panel with their names at the right, at their last values."""
    axes = panel.axes
    low, high = _range(shown)
    axes.set_ylim(low, high)
    axes.axhline(0, color=style.faint, linewidth=0.6)
    at_edge = []
    for place, line in enumerate(shown.lines):
        number = place if line.element is None else line.element
        time, values = thinned(motion.time, line.values)
        dashes = DASHES[number // len(style.colours) % len(DASHES)]
        how: dict[str, Any] = {"color": style.colour(number), "linewidth": 1.2}
        axes.plot(time, values, linestyle=dashes, **how)
        at_edge.append(Label(panel.up(values[-1]), _wrapped(line.name), style.colour(number)))
    panel.beside("right", at_edge)
    axes.set_yticks(labels.ticks(low, high, 5))
    axes.tick_params(axis="y", length=2)
    axes.grid(axis="y", linewidth=0.4, alpha=0.6)
    what = labels.wrapped(style.text(shown.english, shown.russian), HIGH)
    axes.set_ylabel(what, linespacing=labels.LINE)
    axes.yaxis.set_label_coords(-NUMBERS / WIDE, 0.5)


def _range(shown: MotionPanel) -> tuple[float, float]:
    """The ends of a scale that has 0."""
    low = min(0.0, *(float(np.min(line.values)) for line in shown.lines))
    high = max(0.0, *(float(np.max(line.values)) for line in shown.lines))
    room = 0.06 * (high - low) if math.isfinite(high - low) and high > low else 1.0
    return low - room, high + room


def _draw_states(panel: Panel, rows: Sequence[ElementStates], style: Style) -> None:
    """A bar for each element that carries torque."""
    axes = panel.axes
    axes.set_ylim(len(rows), 0)
    axes.set_yticks([])
    for place, row in enumerate(rows):
        colour = style.colour(row.element)
        y = panel.up(place + 0.5)
        panel.write(-6, y, row.name, color=colour, ha="right", va="center")
        how: dict[str, Any] = {"edgecolor": colour, "linewidth": 0.7}
        spans = [(start, end - start) for start, end in row.sticks]
        axes.broken_barh(spans, (place + 0.2, 0.6), facecolor=colour, **how)
        spans = [(start, end - start) for start, end in row.slips]
        how["hatch"] = "//////"
        axes.broken_barh(spans, (place + 0.2, 0.6), facecolor=style.paper, **how)


def _draw_events(panel: Panel, events: Sequence[Event], style: Style) -> None:
    """A vertical at each event."""
    for time in sorted({event.time for event in events}):
        panel.axes.axvline(time, color=style.faint, linewidth=0.6, zorder=0.5)
