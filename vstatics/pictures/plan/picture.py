"""The generalised kinematic plan as a picture; see `rays` for what it shows."""

from __future__ import annotations

import json
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

from matplotlib.figure import Figure

from vstatics.core.errors import CaseError, Problem
from vstatics.core.model.transmission import Transmission
from vstatics.core.statics.results import Results
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
"""Width of the axes of a plan at most; two plans stand side by side where they have the other."""
ABSCISSA_NAME_HEIGHT = 18.0
"""For the name of the abscissa, below the scale. [pt]"""
ORDINATE_NAME_WIDTH = 18.0
"""For the name of the ordinates, beside the scale. [pt]"""
AFTER_SCALE = 8.0
"""From a scale to its name, or to the next plan. [pt]"""
PLAN_GAP = 7.0
"""Between plans. [pt]"""


class PlanSheet(NamedTuple):
    """What all pages of a picture share; lengths in points."""

    case: Transmission
    motion: PicturedRun | None
    left_out: Sequence[str]
    """Names of the gears on no plan."""
    style: Style
    columns: int
    left: float
    """For the names of rays."""
    wide: float
    """Of the axes."""
    scale: float
    """For the numbers of the ordinates."""
    right: float
    """For these, or the names of events."""

    @property
    def size(self) -> float:
        """Width of a page."""
        cells = self.columns * (self.left + self.wide + self.right)
        gaps = PLAN_GAP * (self.columns - 1) + ORDINATE_NAME_WIDTH * (self.motion is None)
        return 2 * MARGIN + cells + gaps

    def head(self, shown: Sequence[DrawnPlan]) -> SheetHead:
        """What stands over a page."""
        style = self.style
        subject = style.text("generalised kinematic plan")
        if self.motion is not None:
            subject += style.text(" with a run")
        own = [one.plan for one in shown]
        runs = [one.run.on_plan for one in shown if one.run]
        signs = plan_signs(own, [one.x for one in shown], style, runs) if shown else []
        note = plan_note(self.case, own, self.left_out, style)
        return sheet_head(title(self.case, subject), note, signs, self.size - 2 * MARGIN, style)


class PlanRow(NamedTuple):
    """Plans side by side; lengths in points."""

    plans: Sequence[DrawnPlan]
    above: float
    high: float
    """Of the axes."""
    below: float
    """For the numbers, and the run below with the name of the abscissa above it."""

    @property
    def size(self) -> float:
        """All of it."""
        return self.above + self.high + self.below


def draw(
    results: Results, style: Style, gears: Sequence[int] = (), motion: PicturedRun | None = None
) -> list[Figure]:
    """Draw all plans of a case, or those that have one of some gears, on pages.

    With a run those on which it is at any time are drawn, and its course through them.
    Where there is none, the page says why.

    Raises
    ------
    CaseError
        If nothing is free in any gear, or some gears are on no plan.
    """
    case, every = results.case, plans(results)
    chosen = _chosen(case, every, gears)
    runs = [(plan, None) for plan in chosen] if motion is None else visited(case, chosen, motion)
    sheet = _sheet(case, runs, off_plans(case, every), motion, style)
    drawn = [drawn_plan(case, plan, run, sheet.wide, style) for plan, run in runs]
    rows = [_row(sheet, drawn[n : n + sheet.columns]) for n in range(0, len(drawn), sheet.columns)]
    room = style.height - sheet.head(drawn).high - MARGIN - ABSCISSA_NAME_HEIGHT
    return [_page(sheet, some) for some in _pages(rows, room)]


def _chosen(
    case: Transmission, every: Sequence[KinematicPlan], gears: Sequence[int]
) -> list[KinematicPlan]:
    """All plans, or those that have one of some gears."""
    chosen = [plan for plan in every if not gears or {*gears} & {*plan.gears}]
    if gears and every and not chosen:
        names = ", ".join(case.gears[gear - 1].name for gear in gears)
        problem = Problem("E404", f"gear {names} is on no kinematic plan", ("gears", gears[0]))
        raise CaseError([problem])
    return chosen


def _sheet(
    case: Transmission,
    runs: Sequence[tuple[KinematicPlan, PlanCourse | None]],
    left_out: Sequence[str],
    motion: PicturedRun | None,
    style: Style,
) -> PlanSheet:
    """Two plans side by side where both have room; one where a run has its events beside it."""
    drawn = [drawn_plan(case, plan, run, MOST_PLAN_WIDTH, style) for plan, run in runs]
    left = max((one.left(style) for one in drawn), default=0.0)
    scale = widest(text for one in drawn for text in _numbers(drawn, one)) + AFTER_SCALE
    right, beside = scale, ORDINATE_NAME_WIDTH
    if motion is not None:
        right, beside = max(scale + beside, right_of(motion, style)), 0.0
    for columns in (2, 1):
        room = style.width - 2 * MARGIN - beside - PLAN_GAP * (columns - 1)
        wide = min(room / columns - left - right, MOST_PLAN_WIDTH)
        if columns == 1 or (len(drawn) > 1 and motion is None and wide >= LEAST_PLAN_WIDTH):
            break
    return PlanSheet(case, motion, left_out, style, columns, left, wide, scale, right)


def _numbers(drawn: Sequence[DrawnPlan], one: DrawnPlan) -> list[str]:
    """The numbers of the ordinates of a plan, with the decimals that any has."""
    return tick_texts(one.ticks(), sorted({tick for other in drawn for tick in other.ticks()}))


def _row(sheet: PlanSheet, some: Sequence[DrawnPlan]) -> PlanRow:
    below = max(one.below for one in some) + PLAN_GAP
    if sheet.motion is not None:
        below += ABSCISSA_NAME_HEIGHT + high_of(sheet.motion, sheet.style) + MARGIN
    return PlanRow(
        some, max(one.above for one in some), max(one.high(sheet.style) for one in some), below
    )


def _pages(rows: Sequence[PlanRow], room: float) -> list[list[PlanRow]]:
    """Rows that fit a page together."""
    found: list[list[PlanRow]] = [[]]
    for row in rows:
        if found[-1] and sum(one.size for one in found[-1]) + row.size > room:
            found.append([])
        found[-1].append(row)
    return found


def _page(sheet: PlanSheet, rows: Sequence[PlanRow]) -> Figure:
    """Some plans, one beside and below another, with a run if there is one."""
    drawn = [one for row in rows for one in row.plans]
    up = sum(row.size for row in rows) + ABSCISSA_NAME_HEIGHT * bool(rows)
    pen = sheet.head(drawn).over((sheet.size, up), MARGIN, sheet.style)
    pen.tell(left_out=json.dumps(sheet.left_out, ensure_ascii=False))
    bottom = up
    for row, below in pairwise([*rows, None]):
        if row is None:
            continue
        bottom -= row.above + row.high
        for column, one in enumerate(row.plans):
            x = MARGIN + sheet.left + column * (sheet.left + sheet.wide + sheet.right + PLAN_GAP)
            names = [sheet.case.gears[number - 1].name for number in one.plan.gears]
            said = [*one.plan.engaged, *one.plan.given]
            group = pen.within("panel", gears=_json(names), engaged=_json(said))
            panel = group.panel((x, bottom), (sheet.wide, row.high), one.x, one.y)
            draw_plan(panel, sheet.case, one, row.above, sheet.left)
            panel.scale("right", one.ticks(), _numbers(drawn, one), grid=True)
            is_lowest = below is None or column >= len(below.plans)
            is_last = column == len(row.plans) - 1
            _name_scales(panel, one, sheet, is_lowest=is_lowest, is_last=is_last)
            if one.run is not None:
                _draw_run(panel, one, row, sheet)
        bottom -= row.below
    return pen.figure


def _json(names: Sequence[str]) -> str:
    return json.dumps(names, ensure_ascii=False)


def _name_scales(
    pen: Pen, one: DrawnPlan, sheet: PlanSheet, *, is_lowest: bool, is_last: bool
) -> None:
    """What is across, below the lowest numbers, and what is up, beside the last scale."""
    text = sheet.style.text
    if is_lowest or one.run is not None:
        output = text("1/i = output speed / input speed")
        pen.name("bottom", output, one.below + ABSCISSA_NAME_HEIGHT / 2)
    if is_last:
        link = text("link speed / input speed")
        pen.name("right", link, sheet.scale + ORDINATE_NAME_WIDTH / 2)


def _draw_run(pen: Pen, one: DrawnPlan, row: PlanRow, sheet: PlanSheet) -> None:
    """The run on a plan, and over time below it."""
    if one.run is None or sheet.motion is None:
        return
    draw_paths(pen, one.plan, one.run)
    motion, tall = sheet.motion, high_of(sheet.motion, sheet.style)
    time = AxisScale(float(motion.time[-1]), float(motion.time[0]))
    foot = pen.corner[0], pen.corner[1] - row.below + PLAN_GAP + MARGIN
    draw_time(pen.panel(foot, (sheet.wide, tall), one.x, time), one.plan, one.run, motion)
