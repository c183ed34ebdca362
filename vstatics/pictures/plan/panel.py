"""One kinematic plan: rays with their names, gears, scales."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from vstatics.core.model.transmission import HOUSING, Transmission
from vstatics.core.numerics.tolerances import SAME_RATIO
from vstatics.pictures.drawing.ends import LineEnd, along, beside, height_of, width_of
from vstatics.pictures.drawing.head import BELOW
from vstatics.pictures.drawing.labels import (
    LEADER,
    Label,
    across_size,
    height,
    spread,
    ticks,
    widest,
    wrapped,
)
from vstatics.pictures.drawing.line_styles import link_look, link_looks
from vstatics.pictures.drawing.pen import AxisScale, Pen
from vstatics.pictures.drawing.style import SHORT_NAME, Style, number
from vstatics.pictures.drawing.words import gear_title
from vstatics.pictures.plan.course import PlanCourse
from vstatics.pictures.plan.key import PORT_RAY_WIDTH, RAY_WIDTH, dot_look, gear_look, unit_look
from vstatics.pictures.plan.rays import KinematicPlan, Mark

TO_TEXTS = 0.65 * LEADER
"""From the axes to the texts along them. [pt]"""
LEAST_PLAN_HEIGHT = 108.0
"""Of the axes. [pt]"""
UPRIGHT_NAME = 78.0
"""Gears with their elements that run upwards are wrapped to this width. [pt]"""
NARROW_ABSCISSA = 0.4
"""Where gears take less of the abscissa from 0 on, it does not reach to 0."""


class DrawnPlan(NamedTuple):
    """A plan with what follows from it."""

    plan: KinematicPlan
    run: PlanCourse | None
    x: AxisScale
    y: AxisScale
    names: Sequence[Sequence[str]]
    """Of the links of each ray, wrapped."""
    head: str
    note: str
    """Below that."""
    top: GearRow
    foot: GearRow

    @property
    def above(self) -> float:
        """What stands over the axes [pt]."""
        texts = [height(text) + 2 for text in (self.head, self.note) if text]
        return TO_TEXTS + self.top.height + 4 + sum(texts)

    @property
    def below(self) -> float:
        """Numbers below the axes, with the lines to their places [pt]."""
        return TO_TEXTS + self.foot.height

    def left(self, style: Style) -> float:
        """Width of the names of rays [pt]."""
        return width_of(self.ends(style))

    def high(self, style: Style) -> float:
        """Height of the axes, so that no name covers another [pt]."""
        return max(LEAST_PLAN_HEIGHT, height_of(self.ends(style)))

    def ends(self, style: Style) -> list[LineEnd]:
        """The names of rays at the left."""
        return [
            LineEnd(
                self.y.part(ray.at(self.x.low)),
                names,
                [link_look(link, style) for link in ray.links],
            )
            for ray, names in zip(self.plan.rays, self.names, strict=True)
        ]

    def ticks(self) -> list[float]:
        """Of the ordinates."""
        return ticks(self.y.low, self.y.high, 6)


class GearRow(NamedTuple):
    """Texts above or below a plan, each near to its vertical."""

    labels: list[Label]
    upright: bool
    height: float
    """[pt]"""


def drawn_plan(
    case: Transmission, plan: KinematicPlan, run: PlanCourse | None, wide: float, style: Style
) -> DrawnPlan:
    """A plan with its scales and texts, its axes in a width [pt], with a run if there is one."""
    x = _abscissa(plan, has_run=run is not None)
    reached = [ray.at(end) for ray in plan.rays for end in (x.low, x.high)] + [0.0, 1.0]
    room = 0.05 * (max(reached) - min(reached))
    y = AxisScale(min(reached) - room, max(reached) + room)
    names = [[wrapped(case.link_name(link), SHORT_NAME) for link in ray.links] for ray in plan.rays]
    one = DrawnPlan(plan, run, x, y, names, "", "", *_rows(case, plan, x, wide, style))
    room = one.left(style) + wide
    head, note = (wrapped(text, room) for text in _heads(case, plan, style))
    return one._replace(head=head, note=note)


def _abscissa(plan: KinematicPlan, *, has_run: bool) -> AxisScale:
    """From the first gear to the last; from 0 on where gears take a good part of that."""
    outputs = [mark.output for mark in plan.marks]
    low, high = min(outputs), max(outputs)
    whole = min(low, 0.0), max(high, 0.0)
    if has_run or high - low <= SAME_RATIO or high - low >= NARROW_ABSCISSA * (whole[1] - whole[0]):
        low, high = whole
    room = 0.06 * (high - low) or 0.1
    return AxisScale(low - room, high + room)


def mark_name(case: Transmission, mark: Mark) -> str:
    """The names of gears that are one on a plan."""
    return ", ".join(case.gears[number - 1].name for number in mark.gears)


def _heads(case: Transmission, plan: KinematicPlan, style: Style) -> tuple[str, str]:
    """What all gears of a plan have in common: elements and speeds, links that stand."""
    parts = []
    if plan.engaged:
        parts.append(f"{style.text('engaged')}: {', '.join(plan.engaged)}")
    if plan.given:
        parts.append(f"{style.text('given')}: {', '.join(plan.given)}")
    names = ", ".join(map(case.link_name, plan.standing))
    return "; ".join(parts), f"{style.text('stand')}: {names}" if names else ""


def _rows(
    case: Transmission, plan: KinematicPlan, x: AxisScale, wide: float, style: Style
) -> tuple[GearRow, GearRow]:
    """The gears with the elements that make them above a plan, 1/i of each below it."""
    at = [x.part(mark.output) * wide for mark in plan.marks]
    texts = [
        (
            mark_name(case, mark),
            ", ".join(case.shift_elements[number - 1].name for number in mark.elements),
        )
        for mark in plan.marks
    ]
    across, turned = (
        [
            Label(place, wrapped(between.join(filter(None, text)), longest), style.ink)
            for place, text in zip(at, texts, strict=True)
        ]
        for between, longest in (("\n", wide), (": ", UPRIGHT_NAME))
    )
    outputs = sorted({round(mark.output, 9) + 0.0 for mark in plan.marks})
    scale = [Label(x.part(one) * wide, number(one), style.ink) for one in outputs]
    common = [one for one in (0.0, 1.0) if one not in outputs and x.low < one < x.high]
    scale += [Label(x.part(one) * wide, f"{one:.0f}", style.soft) for one in common]
    return _near(across, turned, wide), _near(scale, scale, wide)


def _near(across: list[Label], turned: list[Label], wide: float) -> GearRow:
    """Texts across if each can stand near to its vertical, else upwards."""
    sizes = [across_size(label.text) for label in across]
    wanted = [label.at for label in across]
    places = spread(wanted, sizes, 0.0, wide)
    if all(abs(one - other) <= LEADER for one, other in zip(places, wanted, strict=True)):
        return GearRow(across, upright=False, height=max(height(a.text) for a in across))
    return GearRow(turned, upright=True, height=widest(one.text for one in turned))


def draw_plan(pen: Pen, case: Transmission, one: DrawnPlan, above: float, left: float) -> None:
    """A plan with all its labels but those of ordinates.

    Parameters
    ----------
    above, left : float
        From the axes to its heads, which begin like those beside it. [pt]
    """
    pen.frame()
    _draw_rays(pen, case, one.plan)
    _draw_gears(pen, case, one.plan)
    beside(pen, "left", one.ends(pen.style))
    along(pen, "top", one.top.labels, upright=one.top.upright)
    along(pen, "bottom", one.foot.labels, upright=one.foot.upright)
    top = pen.size[1] + above
    if one.head:
        pen.text(-left, top, one.head, bold=True, **BELOW)
        top -= height(one.head) + 2
    if one.note:
        pen.text(-left, top, one.note, color=pen.style.soft, **BELOW)


def _draw_rays(pen: Pen, case: Transmission, plan: KinematicPlan) -> None:
    """The line of each link, and those of what stands."""
    (wide, high), ends = pen.size, (pen.x.low, pen.x.high)
    rest = [((0.0, pen.up(0.0)), (wide, pen.up(0.0)))]
    if ends[0] < 0 < ends[1]:
        rest.append(((pen.across(0.0), 0.0), (pen.across(0.0), high)))
    pen.lines(rest, color=pen.style.ink, width=0.8)
    for ray in plan.rays:
        is_port = plan.input in ray.links or plan.output in ray.links
        places = [(pen.across(end), pen.up(ray.at(end))) for end in ends]
        names = " = ".join(map(case.link_name, ray.links))
        sign = "−" if ray.slope < 0 else "+"
        said = f"{names}: {number(ray.start)} {sign} {number(abs(ray.slope))}·(1/i)"
        for look in link_looks(ray.links, pen.style):
            pen.line(*places, title=said, width=PORT_RAY_WIDTH if is_port else RAY_WIDTH, **look)


def _draw_gears(pen: Pen, case: Transmission, plan: KinematicPlan) -> None:
    """A vertical for each gear, and what stops or joins links there."""
    style = pen.style
    for mark in plan.marks:
        x, name = pen.across(mark.output), gear_title(mark_name(case, mark), style)
        said = f"{name}: 1/i {number(mark.output)}"
        pen.line((x, 0.0), (x, pen.size[1]), title=said, **gear_look(style))
        for text, y in _stops(case, plan, mark, style):
            pen.line((x, pen.up(y)), title=f"{name}: {text}", **dot_look(style))
    if plan.has_unit_point and pen.x.low < 1 < pen.x.high:
        pen.line((pen.across(1.0), pen.up(1.0)), **unit_look(style))


def _stops(
    case: Transmission, plan: KinematicPlan, mark: Mark, style: Style
) -> Iterator[tuple[str, float]]:
    """What holds a link where its ray crosses the abscissa, or joins two whose rays meet."""
    speeds = {link: ray.at(mark.output) for ray in plan.rays for link in ray.links}
    for element in (case.shift_elements[place - 1] for place in mark.elements):
        names = [case.link_name(link) for link in element.links if link != HOUSING]
        does = style.text("holds"), style.text("joins")
        is_brake = HOUSING in element.links
        text = f"{element.name} {does[not is_brake]} {' + '.join(names)}"
        at = 0.0 if is_brake else speeds.get(element.links[0], speeds.get(element.links[1]))
        if at is not None:
            yield text, at
