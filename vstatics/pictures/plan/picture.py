"""The generalised kinematic plan as a picture; see `rays` for what it shows."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from matplotlib.figure import Figure

from vstatics.errors import CaseError, Problem
from vstatics.model.transmission import Transmission
from vstatics.pictures.plan.course import draw_paths, draw_time, high_of, right_of, visited
from vstatics.pictures.plan.key import plan_note, plan_signs
from vstatics.pictures.plan.panel import DrawnPlan, draw_plan, drawn_plan
from vstatics.pictures.plan.rays import KinematicPlan, plans
from vstatics.pictures.sheet import labels
from vstatics.pictures.sheet.chart import AxisScale, Chart, tick_texts, widest
from vstatics.pictures.sheet.ends import height_of, width_of
from vstatics.pictures.sheet.head import ChartHead, chart_head
from vstatics.pictures.sheet.labels import LEADER, Paper
from vstatics.pictures.sheet.style import Style
from vstatics.pictures.sheet.words import title
from vstatics.simulation.record.motion import Motion
from vstatics.statics.results import Results

WIDE, HIGH = 300.0, 220.0
"""Of a plan without its labels. [pt]"""
MANY, LESS = 8, 0.65
"""More plans than that are drawn so much smaller: they fit two printed pages."""
PLAN_MARGIN = 12.0
"""[pt]"""
ABSCISSA_NAME_HEIGHT = 18.0
"""For the name of the abscissa, below the scale. [pt]"""
ORDINATE_NAME_WIDTH = 22.0
"""For the name of the ordinates, beside the scale. [pt]"""
SIDE_BY_SIDE = 2
"""At most so many plans in a row: they can be read on a printed page."""
ON_SHEET, ON_SHEET_WITH_RUN = 6, 4
"""So many plans fit one."""


def draw(
    results: Results, style: Style, gears: Sequence[int] = (), motion: Motion | None = None
) -> Figure:
    """Draw all plans of a case, or those that have one of some gears.

    With a run those on which it is at any time are drawn, and its course through them.

    Raises
    ------
    CaseError
        If there is no plan.
    """
    return _figure(results.case, _chosen(results, gears), style, motion)


def sheets(
    results: Results, style: Style, gears: Sequence[int] = (), motion: Motion | None = None
) -> list[Figure]:
    """The plans of a case in figures that fit a printed page each; errors as of `draw`."""
    drawn = _chosen(results, gears)
    if motion is not None:
        drawn = [plan for plan, _ in visited(results.case, drawn, motion)]
    on_sheet = ON_SHEET if motion is None else ON_SHEET_WITH_RUN
    starts = range(0, len(drawn), on_sheet)
    return [_figure(results.case, drawn[n : n + on_sheet], style, motion) for n in starts]


def _chosen(results: Results, gears: Sequence[int]) -> list[KinematicPlan]:
    """All plans, or those that have one of some gears."""
    chosen = [
        plan
        for plan in plans(results)
        if not gears or {*gears} & {mark.gear for mark in plan.marks}
    ]
    if not chosen:
        names = ", ".join(results.case.gears[gear - 1].name for gear in gears)
        problem = Problem(f"gear {names} is on no kinematic plan", ("gears", gears[0]))
        raise CaseError([problem])
    return chosen


def _figure(
    case: Transmission, chosen: Sequence[KinematicPlan], style: Style, motion: Motion | None
) -> Figure:
    """Some plans, one beside and below another, with a run if there is one."""
    runs = [(plan, None) for plan in chosen] if motion is None else visited(case, chosen, motion)
    size = LESS if len(runs) > MANY else 1.0
    drawn = [drawn_plan(case, plan, run, size * WIDE, style) for plan, run in runs]
    layout = _layout(case, drawn, size, style, motion)
    wide, high = layout.size
    paper = Paper(labels.figure(wide, high))
    layout.head.draw(paper, PLAN_MARGIN, high - PLAN_MARGIN, style)
    bottom = high - PLAN_MARGIN - layout.head.high
    for row in layout.rows:
        bottom -= row.above + layout.high
        for column, one in enumerate(row.drawn):
            left = column * layout.across + layout.left
            chart = Chart(paper, (left, bottom), layout.wide, layout.high, one.x, one.y)
            draw_plan(chart, case, one, row.above, style)
            ticks = one.ticks()
            chart.scale("right", ticks, style, tick_texts(ticks, layout.ticks), grid=True)
            _name_scales(chart, layout, row.numbers, style)
            if motion is not None and one.run is not None:
                draw_paths(chart, one.plan, one.run, style)
                time_high = high_of(motion)
                down = bottom - row.numbers - ABSCISSA_NAME_HEIGHT - time_high
                scale = AxisScale(float(motion.time[-1]), float(motion.time[0]))
                under = Chart(paper, (left, down), layout.wide, time_high, one.x, scale)
                draw_time(under, one.plan, one.run, motion, style)
        bottom -= row.numbers + layout.below
    return paper.figure


def _name_scales(chart: Chart, layout: _PlanLayout, numbers: float, style: Style) -> None:
    """What is across, and what is up."""
    text = style.text("1/i = output speed / input speed", "1/i = скорость выхода / скорость входа")
    chart.name("bottom", text, numbers + ABSCISSA_NAME_HEIGHT - 14)
    text = style.text("link speed / input speed", "скорость звена / скорость входа")
    chart.name("right", text, layout.scale + ORDINATE_NAME_WIDTH - 6)


class _PlanRow(NamedTuple):
    """Plans side by side."""

    drawn: Sequence[DrawnPlan]

    @property
    def above(self) -> float:
        """Over the axes [pt]."""
        return max(one.above for one in self.drawn)

    @property
    def numbers(self) -> float:
        """Of those below the axes [pt]."""
        return LEADER + max(one.foot.height for one in self.drawn)


class _PlanLayout(NamedTuple):
    """Where the plans of a figure stand; lengths in points."""

    rows: Sequence[_PlanRow]
    left: float
    """Of the names of rays."""
    right: float
    """Of the scale."""
    wide: float
    """Of the axes."""
    high: float
    ticks: Sequence[float]
    """Of all ordinates; their numbers have decimals alike."""
    scale: float
    """Width of these."""
    below: float
    """Below the numbers of a plan."""
    head: ChartHead
    size: tuple[float, float]

    @property
    def across(self) -> float:
        """A plan with all that belongs to it."""
        return self.left + self.wide + self.right


def _layout(
    case: Transmission,
    drawn: Sequence[DrawnPlan],
    part: float,
    style: Style,
    motion: Motion | None,
) -> _PlanLayout:
    columns = min(math.ceil(math.sqrt(len(drawn))), SIDE_BY_SIDE)
    rows = [_PlanRow(drawn[n : n + columns]) for n in range(0, len(drawn), columns)]
    ends = [one.ends(HIGH, style) for one in drawn]
    left = PLAN_MARGIN + max(map(width_of, ends))
    high = max(part * HIGH, *map(height_of, ends))
    ticks = sorted({tick for one in drawn for tick in one.ticks()})
    scale = widest(tick_texts(ticks))
    right = scale + 8 + ORDINATE_NAME_WIDTH
    below = ABSCISSA_NAME_HEIGHT
    if motion is not None:
        below += high_of(motion) + PLAN_MARGIN
        right = max(right, right_of(motion, style))
    wide = columns * (left + part * WIDE + right)
    subject = style.text("generalised kinematic plan", "обобщённый кинематический план")
    if motion is not None:
        subject += style.text(" with a run", " и движение")
    shown = [one.plan for one in drawn]
    ranges = [(one.x.low, one.x.high) for one in drawn]
    runs = [one.run.on_plan for one in drawn if one.run is not None]
    signs = plan_signs(shown, ranges, style, runs)
    head = chart_head(
        title(case, subject), plan_note(case, shown, style), signs, wide - 2 * PLAN_MARGIN, style
    )
    up = sum(row.above + high + row.numbers + below for row in rows)
    size = wide, PLAN_MARGIN + head.high + up
    return _PlanLayout(rows, left, right, part * WIDE, high, ticks, scale, below, head, size)
