"""The generalised kinematic plan as a picture; see `rays` for what it shows."""

from __future__ import annotations

import math
from collections.abc import Sequence

from matplotlib.figure import Figure

from vstatics.errors import CaseError, Problem
from vstatics.model.transmission import Transmission
from vstatics.pictures.plan.course import draw_paths, draw_time, high_of, right_of, visited
from vstatics.pictures.plan.key import plan_note, plan_signs
from vstatics.pictures.plan.panel import draw_plan, drawn_plan
from vstatics.pictures.plan.rays import KinematicPlan, plans
from vstatics.pictures.sheet.ends import height_of, width_of
from vstatics.pictures.sheet.head import headed
from vstatics.pictures.sheet.labels import LEADER, widest
from vstatics.pictures.sheet.pen import AxisScale, Pen, tick_texts
from vstatics.pictures.sheet.style import MARGIN, Style
from vstatics.pictures.sheet.words import title
from vstatics.simulation.record.motion import Motion
from vstatics.statics.results import Results

PLAN_SIZE = (300.0, 220.0)
"""Width of a plan without its labels, and its height at least. [pt]"""
MANY_PLANS, SMALL_PLAN_SCALE = 8, 0.65
"""More plans than that are drawn so much smaller: they fit two printed pages."""
ABSCISSA_NAME_HEIGHT = 18.0
"""For the name of the abscissa, below the scale. [pt]"""
ORDINATE_NAME_WIDTH = 22.0
"""For the name of the ordinates, beside the scale. [pt]"""
PLANS_SIDE_BY_SIDE = 2
"""At most so many plans in a row: they can be read on a printed page."""
PLANS_ON_SHEET, PLANS_ON_SHEET_WITH_RUN = 6, 4
"""So many plans fit one."""


def draw(
    results: Results, style: Style, gears: Sequence[int] = (), motion: Motion | None = None
) -> list[Figure]:
    """Draw all plans of a case, or those that have one of some gears, on pages.

    With a run those on which it is at any time are drawn, and its course through them.

    Raises
    ------
    CaseError
        If there is no plan.
    """
    drawn = _chosen(results, gears)
    if math.isinf(style.height):
        return [_figure(results.case, drawn, style, motion)]
    if motion is not None:
        drawn = [plan for plan, _ in visited(results.case, drawn, motion)]
    on_sheet = PLANS_ON_SHEET if motion is None else PLANS_ON_SHEET_WITH_RUN
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
        problem = Problem("E404", f"gear {names} is on no kinematic plan", ("gears", gears[0]))
        raise CaseError([problem])
    return chosen


def _figure(
    case: Transmission, chosen: Sequence[KinematicPlan], style: Style, motion: Motion | None
) -> Figure:
    """Some plans, one beside and below another, with a run if there is one."""
    runs = [(plan, None) for plan in chosen] if motion is None else visited(case, chosen, motion)
    part = SMALL_PLAN_SCALE if len(runs) > MANY_PLANS else 1.0
    wide, least = (part * length for length in PLAN_SIZE)
    drawn = [drawn_plan(case, plan, run, wide, style) for plan, run in runs]
    columns = min(math.ceil(math.sqrt(len(drawn))), PLANS_SIDE_BY_SIDE)
    rows = [drawn[n : n + columns] for n in range(0, len(drawn), columns)]
    ends = [one.ends(style) for one in drawn]
    left = MARGIN + max(map(width_of, ends))
    high = max(least, *map(height_of, ends))
    ticks = sorted({tick for one in drawn for tick in one.ticks()})
    scale, below = widest(tick_texts(ticks)), ABSCISSA_NAME_HEIGHT
    right = scale + 8 + ORDINATE_NAME_WIDTH
    subject = style.text("generalised kinematic plan", "обобщённый кинематический план")
    if motion is not None:
        below += high_of(motion) + MARGIN
        right = max(right, right_of(motion, style))
        subject += style.text(" with a run", " и движение")
    above = [max(one.above for one in row) for row in rows]
    numbers = [LEADER + max(one.foot.height for one in row) for row in rows]
    across = left + wide + right
    up = sum(over + high + under + below for over, under in zip(above, numbers, strict=True))
    on_plan = [one.run.on_plan for one in drawn if one.run is not None]
    plans_shown = [one.plan for one in drawn]
    signs = plan_signs(plans_shown, [one.x for one in drawn], style, on_plan)
    note = plan_note(case, plans_shown, style)
    pen = headed(title(case, subject), note, signs, (columns * across, up), style)
    bottom = up
    for row, over, under in zip(rows, above, numbers, strict=True):
        bottom -= over + high
        for column, one in enumerate(row):
            corner = column * across + left, bottom
            panel = pen.panel(corner, (wide, high), one.x, one.y)
            draw_plan(panel, case, one, over)
            own = one.ticks()
            panel.scale("right", own, tick_texts(own, ticks), grid=True)
            _name_scales(panel, under, scale)
            if motion is not None and one.run is not None:
                draw_paths(panel, one.plan, one.run)
                tall = high_of(motion)
                time = AxisScale(float(motion.time[-1]), float(motion.time[0]))
                foot = corner[0], bottom - under - ABSCISSA_NAME_HEIGHT - tall
                draw_time(pen.panel(foot, (wide, tall), one.x, time), one.plan, one.run, motion)
        bottom -= under + below
    return pen.figure


def _name_scales(pen: Pen, numbers: float, scale: float) -> None:
    """What is across, below its numbers, and what is up, beside its scale."""
    text = pen.style.text
    output = text("1/i = output speed / input speed", "1/i = скорость выхода / скорость входа")
    pen.name("bottom", output, numbers + ABSCISSA_NAME_HEIGHT - 14)
    link = text("link speed / input speed", "скорость звена / скорость входа")
    pen.name("right", link, scale + ORDINATE_NAME_WIDTH - 6)
