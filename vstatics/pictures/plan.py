"""The generalised kinematic plan as a picture; see `rays` for what it shows."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from matplotlib.figure import Figure

from vstatics.errors import CaseError, Problem
from vstatics.model.transmission import HOUSING, Transmission
from vstatics.numerics.tolerances import SAME
from vstatics.pictures import labels
from vstatics.pictures.chart import AxisScale, Chart, tick_texts, widest
from vstatics.pictures.chart_ends import LineEnd, along, beside, height_of, width_of
from vstatics.pictures.heads import ChartHead, chart_head
from vstatics.pictures.labels import LEADER, Label, Paper
from vstatics.pictures.looks import link_looks
from vstatics.pictures.plan_course import (
    PlanCourse,
    draw_paths,
    draw_time,
    high_of,
    right_of,
    visited,
)
from vstatics.pictures.plan_key import (
    THICK,
    THIN,
    dot_look,
    gear_look,
    plan_note,
    plan_signs,
    unit_look,
)
from vstatics.pictures.rays import KinematicPlan, Ray, plans
from vstatics.pictures.style import Style, number
from vstatics.pictures.svg import told
from vstatics.pictures.words import gear_title, title
from vstatics.simulation.motion import Motion
from vstatics.statics.results import Results

WIDE, HIGH = 300.0, 220.0
"""Of a plan without its labels. [pt]"""
LONGEST = 110.0
"""Labels of rays are wrapped to this width. [pt]"""
MARGIN = 12.0
"""[pt]"""
BELOW = 26.0
"""For the name of the abscissa, below the scale. [pt]"""
RIGHT = 22.0
"""For the name of the ordinates, beside the scale. [pt]"""
ALONE = 0.4
"""Where gears take less of the abscissa from 0 on, it does not reach to 0."""
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
    drawn = [_drawn(case, plan, run, style) for plan, run in runs]
    layout = _layout(case, drawn, style, motion)
    wide, high = layout.size
    paper = Paper(labels.figure(wide, high))
    layout.head.draw(paper, MARGIN, high - MARGIN, style)
    for place, one in enumerate(drawn):
        row, column = divmod(place, layout.columns)
        left = column * layout.across + layout.left
        bottom = high - layout.head_high - row * layout.up - layout.above - layout.high
        chart = Chart(paper, (left, bottom), WIDE, layout.high, one.x, one.y)
        _draw_plan(chart, case, one, style)
        if place + layout.columns >= len(drawn):
            text = style.text(
                "1/i = output speed / input speed", "1/i = скорость выхода / скорость входа"
            )
            chart.name("bottom", text, layout.numbers + BELOW - 8)
        if column == layout.columns - 1 or place == len(drawn) - 1:
            text = style.text("link speed / input speed", "скорость звена / скорость входа")
            chart.name("right", text, widest(tick_texts(one.ticks())) + RIGHT - 6)
        if motion is not None and one.run is not None:
            draw_paths(chart, one.plan, one.run, style)
            time_high = high_of(motion)
            down = bottom - layout.numbers - BELOW - time_high
            scale = AxisScale(float(motion.time[-1]), float(motion.time[0]))
            under = Chart(paper, (left, down), WIDE, time_high, one.x, scale)
            draw_time(under, one.plan, one.run, motion, style)
    return paper.figure


class _DrawnPlan(NamedTuple):
    """A plan with what follows from it."""

    plan: KinematicPlan
    run: PlanCourse | None
    x: AxisScale
    y: AxisScale
    names: tuple[tuple[str, ...], ...]
    """Of the links of each ray, wrapped."""
    head: str
    top: _GearRow
    foot: _GearRow

    def ends(self, height: float, style: Style) -> list[LineEnd]:
        """The names of rays at the left, in a chart of a height [pt]."""
        return [
            LineEnd(
                self.y.part(ray.at(self.x.low)) * height,
                names,
                tuple(link_looks([link], style)[0] for link in ray.links),
            )
            for ray, names in zip(self.plan.rays, self.names, strict=True)
        ]

    def ticks(self) -> list[float]:
        """Of the ordinates."""
        return labels.ticks(self.y.low, self.y.high, 6)


class _GearRow(NamedTuple):
    """Texts above or below a plan, each near to its vertical."""

    labels: list[Label]
    upright: bool
    height: float
    """[pt]"""


def _drawn(
    case: Transmission, plan: KinematicPlan, run: PlanCourse | None, style: Style
) -> _DrawnPlan:
    x = _abscissa(plan, has_run=run is not None)
    reached = [ray.at(end) for ray in plan.rays for end in (x.low, x.high)] + [0.0, 1.0]
    room = 0.05 * (max(reached) - min(reached))
    y = AxisScale(min(reached) - room, max(reached) + room)
    names = tuple(
        tuple(labels.wrapped(case.link_name(link), LONGEST) for link in ray.links)
        for ray in plan.rays
    )
    return _DrawnPlan(plan, run, x, y, names, _heading(plan, style), *_rows(case, plan, x, style))


def _abscissa(plan: KinematicPlan, *, has_run: bool) -> AxisScale:
    """From the first gear to the last; from 0 on where gears take a good part of that."""
    outputs = [mark.output for mark in plan.marks]
    low, high = min(outputs), max(outputs)
    whole = min(low, 0.0), max(high, 0.0)
    if has_run or high - low <= SAME or high - low >= ALONE * (whole[1] - whole[0]):
        low, high = whole
    room = 0.06 * (high - low) or 0.1
    return AxisScale(low - room, high + room)


class _PlanLayout(NamedTuple):
    """Where the plans of a figure stand; lengths in points."""

    columns: int
    left: float
    """Of the names of rays."""
    right: float
    """Of the scale."""
    above: float
    """Of the gears."""
    high: float
    """Of the axes."""
    numbers: float
    """Of those below the axes."""
    up: float
    """A plan with all that belongs to it."""
    head: ChartHead
    size: tuple[float, float]

    @property
    def across(self) -> float:
        """A plan with all that belongs to it."""
        return self.left + WIDE + self.right

    @property
    def head_high(self) -> float:
        """What stands over the plans."""
        return MARGIN + self.head.high


def _layout(
    case: Transmission, drawn: Sequence[_DrawnPlan], style: Style, motion: Motion | None
) -> _PlanLayout:
    columns = min(math.ceil(math.sqrt(len(drawn))), SIDE_BY_SIDE)
    ends = [one.ends(HIGH, style) for one in drawn]
    left = MARGIN + max(map(width_of, ends))
    high = max(HIGH, *map(height_of, ends))
    above = max(one.top.height for one in drawn) + LEADER + 4
    if any(one.head for one in drawn):
        above += max(labels.height(one.head) for one in drawn) + 2
    right = widest(text for one in drawn for text in tick_texts(one.ticks())) + 8 + RIGHT
    numbers = max(one.foot.height for one in drawn) + LEADER
    below = numbers + BELOW
    if motion is not None:
        below += high_of(motion) + MARGIN
        right = max(right, right_of(motion, style))
    up, wide = above + high + below, columns * (left + WIDE + right)
    subject = style.text("generalised kinematic plan", "обобщённый кинематический план")
    if motion is not None:
        subject += style.text(" with a run", " и движение")
    shown = [one.plan for one in drawn]
    ranges = [(one.x.low, one.x.high) for one in drawn]
    runs = [one.run.on_plan for one in drawn if one.run is not None]
    signs = plan_signs(shown, ranges, style, runs)
    head = chart_head(
        title(case, subject), plan_note(case, shown, style), signs, wide - 2 * MARGIN, style
    )
    size = wide, MARGIN + head.high + math.ceil(len(drawn) / columns) * up
    return _PlanLayout(columns, left, right, above, high, numbers, up, head, size)


def _heading(plan: KinematicPlan, style: Style) -> str:
    """What all gears of a plan have in common."""
    parts = []
    if plan.engaged:
        parts.append(f"{style.text('engaged', 'включены')}: {', '.join(plan.engaged)}")
    if plan.given:
        parts.append(f"{style.text('given', 'задано')}: {', '.join(plan.given)}")
    return labels.wrapped("; ".join(parts), WIDE)


def _rows(
    case: Transmission, plan: KinematicPlan, x: AxisScale, style: Style
) -> tuple[_GearRow, _GearRow]:
    """The gears with the elements that make them above a plan, 1/i of each below it."""
    at = [x.part(mark.output) * WIDE for mark in plan.marks]
    texts = [
        (
            case.gears[mark.gear - 1].name,
            ", ".join(case.shift_elements[number - 1].name for number in mark.elements),
        )
        for mark in plan.marks
    ]
    across, turned = (
        [
            Label(place, between.join(filter(None, text)), style.ink)
            for place, text in zip(at, texts, strict=True)
        ]
        for between in ("\n", ": ")
    )
    outputs = sorted({round(mark.output, 9) + 0.0 for mark in plan.marks})
    scale = [Label(x.part(one) * WIDE, number(one), style.ink) for one in outputs]
    common = [one for one in (0.0, 1.0) if one not in outputs and x.low < one < x.high]
    scale += [Label(x.part(one) * WIDE, f"{one:.0f}", style.soft) for one in common]
    return _near(across, turned), _near(scale, scale)


def _near(across: list[Label], turned: list[Label]) -> _GearRow:
    """Texts across if each can stand near to its vertical, else upwards."""
    sizes = [labels.across_size(label.text) for label in across]
    wanted = [label.at for label in across]
    places = labels.spread(wanted, sizes, 0.0, WIDE)
    if all(abs(one - other) <= LEADER for one, other in zip(places, wanted, strict=True)):
        return _GearRow(across, upright=False, height=max(labels.height(a.text) for a in across))
    return _GearRow(turned, upright=True, height=max(labels.width(a.text) for a in turned))


def _draw_plan(chart: Chart, case: Transmission, one: _DrawnPlan, style: Style) -> None:
    """A plan with all its labels."""
    chart.frame(style, "left", "right", "bottom", "top")
    chart.scale("right", one.ticks(), style, grid=True)
    _draw_rays(chart, case, one.plan, style)
    _draw_gears(chart, case, one.plan, style)
    beside(chart, "left", one.ends(chart.height, style), style)
    along(chart, "top", one.top.labels, style, upright=one.top.upright)
    along(chart, "bottom", one.foot.labels, style, upright=one.foot.upright)
    chart.write(0, chart.height + LEADER + one.top.height + 2, one.head, weight="bold", va="bottom")


def _draw_rays(chart: Chart, case: Transmission, plan: KinematicPlan, style: Style) -> None:
    """The line of each link, and those of what stands."""
    ends = chart.x.low, chart.x.high
    rest = [((0.0, chart.up(0.0)), (chart.width, chart.up(0.0)))]
    if ends[0] < 0 < ends[1]:
        rest.append(((chart.across(0.0), 0.0), (chart.across(0.0), chart.height)))
    chart.lines(rest, color=style.ink, linewidth=0.8)
    for ray in plan.rays:
        is_port = plan.input in ray.links or plan.output in ray.links
        places = [(chart.across(end), chart.up(ray.at(end))) for end in ends]
        for look in link_looks(ray.links, style):
            how: dict[str, Any] = {"linewidth": THICK if is_port else THIN, **look}
            chart.line(*places, solid_capstyle="butt", gid=told(_ray_told(case, ray)), **how)


def _ray_told(case: Transmission, ray: Ray) -> str:
    names = " = ".join(case.link_name(link) for link in ray.links)
    sign = "−" if ray.slope < 0 else "+"
    return f"{names}: {number(ray.start)} {sign} {number(abs(ray.slope))}·(1/i)"


def _draw_gears(chart: Chart, case: Transmission, plan: KinematicPlan, style: Style) -> None:
    """A vertical for each gear, and what stops or joins links there."""
    for mark in plan.marks:
        x, name = chart.across(mark.output), gear_title(case.gears[mark.gear - 1].name, style)
        said = told(f"{name}: 1/i {number(mark.output)}", gear=str(mark.gear))
        chart.line((x, 0.0), (x, chart.height), gid=said, **gear_look(style))
        for text, y in _stops(case, plan, mark.elements, mark.output, style):
            chart.line((x, chart.up(y)), gid=told(f"{name}: {text}"), **dot_look(style))
    if plan.has_unit_point and chart.x.low < 1 < chart.x.high:
        chart.line((chart.across(1.0), chart.up(1.0)), **unit_look(style))


def _stops(
    case: Transmission,
    plan: KinematicPlan,
    elements: Sequence[int],
    output: float,
    style: Style,
) -> Iterator[tuple[str, float]]:
    """What holds a link where its ray crosses the abscissa, or joins two whose rays meet."""
    speeds = {link: ray.at(output) for ray in plan.rays for link in ray.links}
    for element in (case.shift_elements[place - 1] for place in elements):
        names = [case.link_name(link) for link in element.links if link != HOUSING]
        does = style.text("holds", "держит"), style.text("joins", "соединяет")
        is_brake = HOUSING in element.links
        text = f"{element.name} {does[not is_brake]} {' + '.join(names)}"
        yield text, 0.0 if is_brake else speeds.get(element.links[0], 0.0)
