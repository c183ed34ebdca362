"""The generalised kinematic plan as a picture; see `rays` for what it shows."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from matplotlib.figure import Figure

from vstatics.errors import CaseError, Problem
from vstatics.model.transmission import HOUSING, Transmission
from vstatics.numerics.tolerances import SAME
from vstatics.pictures import labels
from vstatics.pictures.labels import LEADER, Label, Panel
from vstatics.pictures.plan_course import draw_paths, draw_time, high_of, right_of, visited
from vstatics.pictures.rays import KinematicPlan, plans
from vstatics.pictures.style import TITLE, Style, number
from vstatics.pictures.words import title
from vstatics.simulation.motion import Motion
from vstatics.statics.results import Results
from vstatics.statics.status import OUTPUT_STANDS

WIDE, HIGH = 300.0, 230.0
"""Of a plan without its labels. [pt]"""
LONGEST = 110.0
"""Labels of rays are wrapped to this width. [pt]"""
MARGIN = 12.0
"""[pt]"""
BELOW = 66.0
"""For what stands below a plan. [pt]"""
RIGHT = 48.0
"""For the ordinates. [pt]"""
FAR = 0.25
"""Where all gears are slower, the abscissa does not reach to 1."""
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
    runs = dict(enumerate(visited(case, chosen, motion))) if motion is not None else {}
    chosen = [plan for plan, _ in runs.values()] or chosen
    layout = _layout(case, chosen, style, motion)
    wide, high = layout.size
    figure = labels.figure(wide, high)
    how: dict[str, Any] = {"ha": "center", "va": "top", "fontsize": TITLE}
    figure.text(0.5, 1 - MARGIN / high, layout.title, **how)
    for place, plan in enumerate(chosen):
        row, column = divmod(place, layout.columns)
        left = column * wide / layout.columns + layout.left
        bottom = high - layout.title_high - (row + 1) * layout.up + layout.below
        panel = labels.panel(figure, left, bottom, WIDE, HIGH)
        _draw_plan(panel, case, plan, style)
        if motion is not None:
            _, run = runs[place]
            draw_paths(panel, plan, run, style)
            under = labels.panel(
                figure, left, bottom - layout.below + MARGIN, WIDE, high_of(motion)
            )
            under.axes.set_xlim(panel.axes.get_xlim())
            draw_time(under, plan, run, motion, style)
    return figure


class _PlanLayout(NamedTuple):
    """Where the plans of a figure stand; lengths in points."""

    columns: int
    left: float
    """Of the labels of rays."""
    up: float
    """A plan with all its labels."""
    below: float
    """What of it stands below the axes."""
    title: str
    title_high: float
    size: tuple[float, float]


def _layout(
    case: Transmission, chosen: Sequence[KinematicPlan], style: Style, motion: Motion | None
) -> _PlanLayout:
    columns = min(math.ceil(math.sqrt(len(chosen))), SIDE_BY_SIDE)
    names = [name for plan in chosen for name in _ray_names(case, plan)]
    left = MARGIN + LEADER + max(map(labels.width, names))
    above = max(_top(case, plan, style).height for plan in chosen) + LEADER + MARGIN / 2
    heads = [_heading(plan, style) for plan in chosen]
    if any(heads):
        above += max(map(labels.height, heads))
    below, right = BELOW, RIGHT
    if motion is not None:
        below, right = BELOW + high_of(motion) + 2 * MARGIN, max(RIGHT, right_of(motion, style))
    up, wide = above + HIGH + below, columns * (left + WIDE + right)
    subject = style.text("generalised kinematic plan", "обобщённый кинематический план")
    if motion is not None:
        subject += style.text(
            " with a run (full where it is on the rays)",
            " и движение (сплошная линия там, где оно на лучах)",
        )
    head = labels.wrapped(title(case, subject), wide - 2 * MARGIN, TITLE)
    title_high = labels.height(head, TITLE) + 2 * MARGIN
    high = math.ceil(len(chosen) / columns) * up + title_high
    return _PlanLayout(columns, left, up, below, head, title_high, (wide, high))


def _draw_plan(panel: Panel, case: Transmission, plan: KinematicPlan, style: Style) -> None:
    """A plan with all its labels."""
    _draw_rays(panel, case, plan, style)
    _draw_scales(panel, plan, style)
    top = _top(case, plan, style)
    panel.along("top", top.labels, upright=top.upright)
    head = _heading(plan, style)
    panel.write(WIDE / 2, HIGH + LEADER + top.height + 2, head, ha="center", va="bottom")


def _heading(plan: KinematicPlan, style: Style) -> str:
    """What all gears of a plan have in common."""
    parts = []
    if plan.engaged:
        parts.append(f"{style.text('engaged', 'включены')}: {', '.join(plan.engaged)}")
    if plan.given:
        parts.append(f"{style.text('given', 'задано')}: {', '.join(plan.given)}")
    return labels.wrapped("; ".join(parts), WIDE)


def _ray_names(case: Transmission, plan: KinematicPlan) -> list[str]:
    """The links of each ray in lines."""
    return [
        labels.wrapped(" = ".join(case.link_name(link) for link in ray.links), LONGEST)
        for ray in plan.rays
    ]


def _gear_text(case: Transmission, plan: KinematicPlan, place: int, between: str) -> str:
    mark = plan.marks[place]
    elements = ", ".join(case.shift_elements[number - 1].name for number in mark.elements)
    name = case.gears[mark.gear - 1].name
    return f"{name}{between}{elements}" if elements else name


class _Top(NamedTuple):
    """The gears with the elements that make them, above a plan."""

    labels: list[Label]
    upright: bool
    height: float
    """[pt]"""


def _top(case: Transmission, plan: KinematicPlan, style: Style) -> _Top:
    """The names of gears, across if each can stand near to its vertical, else upwards."""
    low, high = _frame(plan)[:2]
    at = [(mark.output - low) / (high - low) * WIDE for mark in plan.marks]
    taken = any(abs(mark.output) < SAME for mark in plan.marks)
    at_origin = "" if taken else style.text(OUTPUT_STANDS.name, OUTPUT_STANDS.russian)
    neutral = Label(-low / (high - low) * WIDE, at_origin, style.soft)

    def gears(between: str) -> list[Label]:
        texts = [_gear_text(case, plan, place, between) for place in range(len(at))]
        return [Label(x, text, style.ink) for x, text in zip(at, texts, strict=True)]

    for across in ([*gears("\n"), neutral], gears("\n")):
        sizes = [labels.across_size(label.text) for label in across]
        wanted = [label.at for label in across]
        places = labels.spread(wanted, sizes, 0.0, WIDE)
        if all(abs(a - b) <= labels.LEADER for a, b in zip(places[: len(at)], at, strict=True)):
            return _Top(across, upright=False, height=max(labels.height(a.text) for a in across))
    turned = [*gears(": "), neutral]
    return _Top(turned, upright=True, height=max(labels.width(a.text) for a in turned))


def _frame(plan: KinematicPlan) -> tuple[float, float, float, float]:
    """The ends of the abscissa, and of all rays between them."""
    outputs = [0.0, *(mark.output for mark in plan.marks)]
    if max(map(abs, outputs)) > FAR:
        outputs.append(1.0)
    room = 0.06 * (max(outputs) - min(outputs))
    low, high = min(outputs) - room, max(outputs) + room
    reached = [ray.at(x) for ray in plan.rays for x in (low, high)] + [0.0, 1.0]
    room = 0.05 * (max(reached) - min(reached))
    return low, high, min(reached) - room, max(reached) + room


def _draw_rays(panel: Panel, case: Transmission, plan: KinematicPlan, style: Style) -> None:
    """Rays with their labels at the left, verticals, and what stops or joins links."""
    axes = panel.axes
    low, high, lowest, highest = _frame(plan)
    axes.set_xlim(low, high)
    axes.set_ylim(lowest, highest)
    axes.axhline(0, color=style.ink, linewidth=0.8)
    axes.axvline(0, color=style.ink, linewidth=0.8)
    at_edge = []
    for place, (ray, name) in enumerate(zip(plan.rays, _ray_names(case, plan), strict=True)):
        is_port = plan.input in ray.links or plan.output in ray.links
        colour, wide = (style.ink, 1.8) if is_port else (style.colour(place), 1.3)
        dashes = "dashdot" if plan.output in ray.links else "solid"
        ends = [ray.at(low), ray.at(high)]
        axes.plot([low, high], ends, linestyle=dashes, color=colour, linewidth=wide)
        at_edge.append(Label(panel.up(ray.at(low)), name, colour))
    for mark in plan.marks:
        axes.axvline(mark.output, color=style.faint, linewidth=0.9, linestyle=(0, (4, 3)))
        for x, y in _stops(case, plan, mark.elements, mark.output):
            axes.plot([x], [y], "o", color=style.ink, markersize=4.5, zorder=4)
    if plan.has_unit_point and high > 1:
        how: dict[str, Any] = {"markerfacecolor": style.paper, "markeredgecolor": style.ink}
        axes.plot([1], [1], "o", markersize=8, zorder=3, **how)
    panel.beside("left", at_edge)


def _stops(
    case: Transmission, plan: KinematicPlan, elements: Sequence[int], output: float
) -> list[tuple[float, float]]:
    """Where the rays of two links that an element joins meet, or one crosses the abscissa."""
    speeds = {link: ray.at(output) for ray in plan.rays for link in ray.links}
    joined = (case.shift_elements[number - 1].links for number in elements)
    return [(output, 0.0 if HOUSING in links else speeds.get(links[0], 0.0)) for links in joined]


def _draw_scales(panel: Panel, plan: KinematicPlan, style: Style) -> None:
    """1/i of the gears at the abscissa, ordinates at the right."""
    outputs = sorted({round(mark.output, 9) + 0.0 for mark in plan.marks})
    scale = [Label(panel.across(x), number(x), style.ink) for x in outputs]
    common = [x for x in (0.0, 1.0) if x not in outputs and x < panel.axes.get_xlim()[1]]
    scale += [Label(panel.across(x), f"{x:.0f}", style.soft) for x in common]
    panel.along("bottom", scale, upright=True)
    axes = panel.axes
    axes.set_xticks([])
    axes.yaxis.tick_right()
    axes.grid(axis="y", linewidth=0.4, alpha=0.6)
    x = style.text("output speed / input speed, 1/i", "скорость выхода / скорость входа, 1/i")
    y = style.text("link speed / input speed", "скорость звена / скорость входа")
    panel.write(WIDE / 2, -BELOW + MARGIN + 2, x, ha="center", va="bottom")
    panel.write(WIDE + RIGHT - 8, HIGH / 2, y, ha="center", va="center", rotation=90)
