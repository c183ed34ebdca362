"""Drawing of a kinematic plan: rays with names, lines of gears, and scales."""

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
"""Distance between the axes and the surrounding texts. [pt]"""
LEAST_PLAN_HEIGHT = 108.0
"""Smallest height of the axes of a plan. [pt]"""
UPRIGHT_NAME = 78.0
"""Width to which the vertical label of a gear is wrapped. [pt]"""
NARROW_ABSCISSA = 0.4
"""Smallest fraction of a horizontal scale that gears must cover if the scale extends to 0. [-]"""


class DrawnPlan(NamedTuple):
    """Plan with the scales, labels and dimensions."""

    plan: KinematicPlan
    run: PlanCourse | None
    x: AxisScale
    y: AxisScale
    names: Sequence[Sequence[str]]
    """Names of the links of each ray, wrapped into lines."""
    head: str
    note: str
    """Line of text between the heading and the axes."""
    top: GearRow
    foot: GearRow

    @property
    def above(self) -> float:
        """Height of the labels above the axes [pt]."""
        texts = [height(text) + 2 for text in (self.head, self.note) if text]
        return TO_TEXTS + self.top.height + 4 + sum(texts)

    @property
    def below(self) -> float:
        """Height of the numbers and leader lines below the axes [pt]."""
        return TO_TEXTS + self.foot.height

    def left(self, style: Style) -> float:
        """Return the width of the names of rays, left of the axes [pt]."""
        return width_of(self.ends(style))

    def high(self, style: Style) -> float:
        """Return the smallest height of the axes at which the names of rays do not overlap [pt]."""
        return max(LEAST_PLAN_HEIGHT, height_of(self.ends(style)))

    def ends(self, style: Style) -> list[LineEnd]:
        """Return the names of rays, at the ends of the rays on the left."""
        return [
            LineEnd(
                self.y.part(ray.at(self.x.low)),
                names,
                [link_look(link, style) for link in ray.links],
            )
            for ray, names in zip(self.plan.rays, self.names, strict=True)
        ]

    def ticks(self) -> list[float]:
        """Return the numbers of the vertical scale [-]."""
        return ticks(self.y.low, self.y.high, 6)


class GearRow(NamedTuple):
    """Row of labels above or below a plan, each near the vertical line of the gear."""

    labels: list[Label]
    upright: bool
    height: float
    """Height of the row. [pt]"""


def drawn_plan(
    case: Transmission, plan: KinematicPlan, run: PlanCourse | None, wide: float, style: Style
) -> DrawnPlan:
    """Lay out a plan, and a simulated run if any, with axes that are `wide` points wide."""
    x = _abscissa(plan, has_run=run is not None)
    ordinates = [ray.at(end) for ray in plan.rays for end in (x.low, x.high)] + [0.0, 1.0]
    room = 0.05 * (max(ordinates) - min(ordinates))
    y = AxisScale(min(ordinates) - room, max(ordinates) + room)
    names = [[wrapped(case.link_name(link), SHORT_NAME) for link in ray.links] for ray in plan.rays]
    drawn = DrawnPlan(plan, run, x, y, names, "", "", *_rows(case, plan, x, wide, style))
    room = drawn.left(style) + wide
    head, note = (wrapped(text, room) for text in _heads(case, plan, style))
    return drawn._replace(head=head, note=note)


def _abscissa(plan: KinematicPlan, *, has_run: bool) -> AxisScale:
    """Return the range of the gears, extended to 0 unless the gears would be too close together."""
    outputs = [mark.output for mark in plan.marks]
    low, high = min(outputs), max(outputs)
    whole = min(low, 0.0), max(high, 0.0)
    if has_run or high - low <= SAME_RATIO or high - low >= NARROW_ABSCISSA * (whole[1] - whole[0]):
        low, high = whole
    room = 0.06 * (high - low) or 0.1
    return AxisScale(low - room, high + room)


def mark_name(case: Transmission, mark: Mark) -> str:
    """Return the names of the gears at a point of the horizontal scale."""
    return ", ".join(case.gears[number - 1].name for number in mark.gears)


def _heads(case: Transmission, plan: KinematicPlan, style: Style) -> tuple[str, str]:
    """Return texts above a plan: common shift elements and speeds, and links at rest."""
    parts = []
    if plan.engaged:
        parts.append(f"{style.text('engaged')}: {', '.join(plan.engaged)}")
    if plan.given:
        parts.append(f"{style.text('given')}: {', '.join(plan.given)}")
    names = ", ".join(map(case.link_name, plan.standing))
    return "; ".join(parts), f"{style.text('at rest')}: {names}" if names else ""


def _rows(
    case: Transmission, plan: KinematicPlan, x: AxisScale, wide: float, style: Style
) -> tuple[GearRow, GearRow]:
    """Return the rows of a plan: gears with shift elements above, and values of 1/i below."""
    at = [x.part(mark.output) * wide for mark in plan.marks]
    texts = [
        (
            mark_name(case, mark),
            ", ".join(element.name for element in case.elements_at(mark.elements)),
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
    scale = [Label(x.part(output) * wide, number(output), style.ink) for output in outputs]
    common = [output for output in (0.0, 1.0) if output not in outputs and x.low < output < x.high]
    scale += [Label(x.part(output) * wide, f"{output:.0f}", style.soft) for output in common]
    return _near(across, turned, wide), _near(scale, scale, wide)


def _near(across: list[Label], turned: list[Label], wide: float) -> GearRow:
    """Return horizontal labels if each label has room near the line, else vertical labels."""
    sizes = [across_size(label.text) for label in across]
    wanted = [label.at for label in across]
    places = spread(wanted, sizes, 0.0, wide)
    if all(abs(place - vertical) <= LEADER for place, vertical in zip(places, wanted, strict=True)):
        return GearRow(across, upright=False, height=max(height(a.text) for a in across))
    return GearRow(turned, upright=True, height=widest(label.text for label in turned))


def draw_plan(pen: Pen, case: Transmission, drawn: DrawnPlan, above: float, left: float) -> None:
    """Draw a plan with all labels except the numbers of the vertical scale.

    Parameters
    ----------
    above, left : float
        Height of the labels above the axes and width of the names on the left, equal in a row. [pt]
    """
    pen.frame()
    _draw_rays(pen, case, drawn.plan)
    _draw_gears(pen, case, drawn.plan)
    beside(pen, "left", drawn.ends(pen.style))
    along(pen, "top", drawn.top.labels, upright=drawn.top.upright)
    along(pen, "bottom", drawn.foot.labels, upright=drawn.foot.upright)
    top = pen.size[1] + above
    if drawn.head:
        pen.text(-left, top, drawn.head, bold=True, **BELOW)
        top -= height(drawn.head) + 2
    if drawn.note:
        pen.text(-left, top, drawn.note, color=pen.style.soft, **BELOW)


def _draw_rays(pen: Pen, case: Transmission, plan: KinematicPlan) -> None:
    (wide, high), ends = pen.size, (pen.x.low, pen.x.high)
    axes = [((0.0, pen.up(0.0)), (wide, pen.up(0.0)))]
    if ends[0] < 0 < ends[1]:
        axes.append(((pen.across(0.0), 0.0), (pen.across(0.0), high)))
    pen.lines(axes, color=pen.style.ink, width=0.8)
    for ray in plan.rays:
        is_port = plan.input in ray.links or plan.output in ray.links
        places = [(pen.across(end), pen.up(ray.at(end))) for end in ends]
        names = " = ".join(map(case.link_name, ray.links))
        sign = "−" if ray.slope < 0 else "+"
        title = f"{names}: {number(ray.start)} {sign} {number(abs(ray.slope))}·(1/i)"
        for look in link_looks(ray.links, pen.style):
            pen.line(*places, title=title, width=PORT_RAY_WIDTH if is_port else RAY_WIDTH, **look)


def _draw_gears(pen: Pen, case: Transmission, plan: KinematicPlan) -> None:
    style = pen.style
    for mark in plan.marks:
        x, name = pen.across(mark.output), gear_title(mark_name(case, mark), style)
        title = f"{name}: 1/i {number(mark.output)}"
        pen.line((x, 0.0), (x, pen.size[1]), title=title, **gear_look(style))
        for text, y in _stops(case, plan, mark, style):
            pen.line((x, pen.up(y)), title=f"{name}: {text}", **dot_look(style))
    if plan.has_unit_point and pen.x.low < 1 < pen.x.high:
        pen.line((pen.across(1.0), pen.up(1.0)), **unit_look(style))


def _stops(
    case: Transmission, plan: KinematicPlan, mark: Mark, style: Style
) -> Iterator[tuple[str, float]]:
    """Yield each shift element of a gear, and the imposed speed, at which the dot is drawn."""
    speeds = {link: ray.at(mark.output) for ray in plan.rays for link in ray.links}
    for element in case.elements_at(mark.elements):
        names = [case.link_name(link) for link in element.links if link != HOUSING]
        does = style.text("holds"), style.text("joins")
        is_brake = HOUSING in element.links
        text = f"{element.name} {does[not is_brake]} {' + '.join(names)}"
        at = 0.0 if is_brake else speeds.get(element.links[0], speeds.get(element.links[1]))
        if at is not None:
            yield text, at
