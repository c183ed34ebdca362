"""Pages of generalised kinematic plans, whose theory is in `rays`."""

from __future__ import annotations

import json
from collections.abc import Sequence
from functools import partial
from itertools import zip_longest
from operator import attrgetter
from typing import NamedTuple

from vstatics.core.errors import CaseError, Problem
from vstatics.core.groups import filled
from vstatics.core.model.transmission import Transmission
from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.canvas import Canvas
from vstatics.pictures.drawing.head import SheetHead, sheet_head
from vstatics.pictures.drawing.labels import widest
from vstatics.pictures.drawing.pen import AxisScale, Pen, tick_texts
from vstatics.pictures.drawing.style import MARGIN, Style
from vstatics.pictures.drawing.words import title
from vstatics.pictures.plan.course import (
    PlanCourse,
    draw_paths,
    draw_time,
    high_of,
    right_of,
    visited,
)
from vstatics.pictures.plan.key import plan_note, plan_signs
from vstatics.pictures.plan.panel import DrawnPlan, draw_plan, drawn_plan
from vstatics.pictures.plan.rays import KinematicPlan, off_plans, plans
from vstatics.pictures.runs import PicturedRun

MOST_PLAN_WIDTH, LEAST_PLAN_WIDTH = 300.0, 92.0
"""Largest width of the axes of a plan, and smallest width of two plans side by side. [pt]"""
ABSCISSA_NAME_HEIGHT = 18.0
"""Height of the name of the horizontal axis, below the numbers. [pt]"""
ORDINATE_NAME_WIDTH = 18.0
"""Width of the name of the vertical axis, right of the numbers. [pt]"""
AFTER_SCALE = 8.0
"""Distance from the numbers of a scale to the name, or to the next plan. [pt]"""
PLAN_GAP = 7.0
"""Distance between plans. [pt]"""


class PlanSheet(NamedTuple):
    """Layout common to all pages of a picture; lengths in points."""

    case: Transmission
    motion: PicturedRun | None
    left_out: Sequence[str]
    """Names of the gears that are not on any plan."""
    style: Style
    columns: int
    left: float
    """Width of the names of rays."""
    wide: float
    """Width of the axes."""
    scale: float
    """Width of the numbers of the vertical scale."""
    right: float
    """Width right of the axes: numbers of the vertical scale, or names of events."""

    @property
    def size(self) -> float:
        """Width of a page [pt]."""
        cells = self.columns * (self.left + self.wide + self.right)
        gaps = PLAN_GAP * (self.columns - 1) + ORDINATE_NAME_WIDTH * (self.motion is None)
        return 2 * MARGIN + cells + gaps

    def head(self, shown: Sequence[DrawnPlan]) -> SheetHead:
        """Return the heading of a page with some plans."""
        style = self.style
        subject = style.text("generalised kinematic plan")
        if self.motion is not None:
            subject += style.text(" with a run")
        plans_shown = [drawn.plan for drawn in shown]
        runs = [drawn.run.on_plan for drawn in shown if drawn.run]
        signs = plan_signs(plans_shown, [drawn.x for drawn in shown], style, runs) if shown else []
        note = plan_note(self.case, plans_shown, self.left_out, style)
        return sheet_head(title(self.case, subject), note, signs, self.size - 2 * MARGIN, style)


class PlanRow(NamedTuple):
    """Plans side by side; lengths in points."""

    plans: Sequence[DrawnPlan]
    above: float
    high: float
    """Height of the axes."""
    below: float
    """Height below the axes: numbers, name of the horizontal axis, and the simulated run."""

    @property
    def size(self) -> float:
        """Total height of the row."""
        return self.above + self.high + self.below


def draw(
    results: Results, style: Style, gears: Sequence[int] = (), motion: PicturedRun | None = None
) -> list[Canvas]:
    """Draw all plans of a case, or only plans that contain chosen gears, on pages.

    If a simulated run is given, only plans whose constraints it satisfies for an interval are
    drawn.

    Raises
    ------
    CaseError
        If no gear has a plan, or the chosen gears are not on a plan.
    """
    case, every = results.case, plans(results)
    chosen = _chosen(case, every, gears)
    runs = [(plan, None) for plan in chosen] if motion is None else visited(case, chosen, motion)
    sheet = _sheet(case, runs, off_plans(case, every), motion, style)
    drawn = [drawn_plan(case, plan, run, sheet.wide, style) for plan, run in runs]
    rows = [_row(sheet, drawn[n : n + sheet.columns]) for n in range(0, len(drawn), sheet.columns)]
    room = style.height - sheet.head(drawn).high - MARGIN - ABSCISSA_NAME_HEIGHT
    return [_page(sheet, some) for some in filled(rows, room, attrgetter("size"))]


def _chosen(
    case: Transmission, every: Sequence[KinematicPlan], gears: Sequence[int]
) -> list[KinematicPlan]:
    chosen = [plan for plan in every if not gears or {*gears} & {*plan.gears}]
    if gears and every and not chosen:
        names = ", ".join(case.gears[gear - 1].name for gear in gears)
        problem = Problem(
            "E404", f"gear {names} does not appear on any kinematic plan", ("gears", gears[0])
        )
        raise CaseError([problem])
    return chosen


def _sheet(
    case: Transmission,
    runs: Sequence[tuple[KinematicPlan, PlanCourse | None]],
    left_out: Sequence[str],
    motion: PicturedRun | None,
    style: Style,
) -> PlanSheet:
    """Lay out a page: two plans side by side on a wide page without a run, else a single plan."""
    drawn = [drawn_plan(case, plan, run, MOST_PLAN_WIDTH, style) for plan, run in runs]
    left = max((plan_drawn.left(style) for plan_drawn in drawn), default=0.0)
    scale = (
        widest(text for plan_drawn in drawn for text in _numbers(drawn, plan_drawn)) + AFTER_SCALE
    )
    right, name_width = scale, ORDINATE_NAME_WIDTH
    if motion is not None:
        right, name_width = max(scale + name_width, right_of(motion, style)), 0.0
    for columns in (2, 1):
        room = style.width - 2 * MARGIN - name_width - PLAN_GAP * (columns - 1)
        wide = min(room / columns - left - right, MOST_PLAN_WIDTH)
        if columns == 1 or (len(drawn) > 1 and motion is None and wide >= LEAST_PLAN_WIDTH):
            break
    return PlanSheet(case, motion, left_out, style, columns, left, wide, scale, right)


def _numbers(drawn: Sequence[DrawnPlan], plan_drawn: DrawnPlan) -> list[str]:
    """Return the numbers of a plan's vertical scale, with equally many decimals on all plans."""
    return tick_texts(
        plan_drawn.ticks(), sorted({tick for other in drawn for tick in other.ticks()})
    )


def _row(sheet: PlanSheet, some: Sequence[DrawnPlan]) -> PlanRow:
    below = max(drawn.below for drawn in some) + PLAN_GAP
    if sheet.motion is not None:
        below += ABSCISSA_NAME_HEIGHT + high_of(sheet.motion, sheet.style) + MARGIN
    return PlanRow(
        some,
        max(drawn.above for drawn in some),
        max(drawn.high(sheet.style) for drawn in some),
        below,
    )


def _page(sheet: PlanSheet, rows: Sequence[PlanRow]) -> Canvas:
    drawn = [plan_drawn for row in rows for plan_drawn in row.plans]
    up = sum(row.size for row in rows) + ABSCISSA_NAME_HEIGHT * bool(rows)
    pen = sheet.head(drawn).over((sheet.size, up), MARGIN, sheet.style)
    as_json = partial(json.dumps, ensure_ascii=False)
    pen.tell(left_out=as_json(sheet.left_out))
    bottom = up
    for row, below in zip_longest(rows, rows[1:]):
        bottom -= row.above + row.high
        for column, plan_drawn in enumerate(row.plans):
            x = MARGIN + sheet.left + column * (sheet.left + sheet.wide + sheet.right + PLAN_GAP)
            names = [sheet.case.gears[number - 1].name for number in plan_drawn.plan.gears]
            common = [*plan_drawn.plan.engaged, *plan_drawn.plan.given]
            group = pen.within("panel", gears=as_json(names), engaged=as_json(common))
            panel = group.panel((x, bottom), (sheet.wide, row.high), plan_drawn.x, plan_drawn.y)
            draw_plan(panel, sheet.case, plan_drawn, row.above, sheet.left)
            panel.scale("right", plan_drawn.ticks(), _numbers(drawn, plan_drawn), grid=True)
            is_lowest = below is None or column >= len(below.plans)
            is_last = column == len(row.plans) - 1
            _name_scales(panel, plan_drawn, sheet, is_lowest=is_lowest, is_last=is_last)
            _draw_run(panel, plan_drawn, row, sheet)
        bottom -= row.below
    return pen.canvas


def _name_scales(
    pen: Pen, drawn: DrawnPlan, sheet: PlanSheet, *, is_lowest: bool, is_last: bool
) -> None:
    """Write the axis names: horizontal below the lowest plan, vertical at the last plan."""
    text = sheet.style.text
    if is_lowest or drawn.run is not None:
        output = text("1/i = output speed / input speed")
        pen.name("bottom", output, drawn.below + ABSCISSA_NAME_HEIGHT / 2)
    if is_last:
        link = text("link speed / input speed")
        pen.name("right", link, sheet.scale + ORDINATE_NAME_WIDTH / 2)


def _draw_run(pen: Pen, drawn: DrawnPlan, row: PlanRow, sheet: PlanSheet) -> None:
    if drawn.run is None or sheet.motion is None:
        return
    draw_paths(pen, drawn.plan, drawn.run)
    motion, tall = sheet.motion, high_of(sheet.motion, sheet.style)
    time = AxisScale(float(motion.time[-1]), float(motion.time[0]))
    foot = pen.corner[0], pen.corner[1] - row.below + PLAN_GAP + MARGIN
    draw_time(pen.panel(foot, (sheet.wide, tall), drawn.x, time), drawn.plan, drawn.run, motion)
