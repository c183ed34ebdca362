"""The run of a case through its kinematic plan: where it is on the abscissa, and when."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from vstatics.core.model.transmission import HOUSING, SpeedOf, Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.pictures.drawing.ends import LineEnd, beside
from vstatics.pictures.drawing.labels import LABEL_GAP, LEADER, height, ticks, widest, wrapped
from vstatics.pictures.drawing.line_styles import link_look
from vstatics.pictures.drawing.pen import Pen, tick_texts
from vstatics.pictures.drawing.style import LEADER_WIDTH, Style, number
from vstatics.pictures.plan.conditions import Condition
from vstatics.pictures.plan.key import BROAD, PATH, gear_look
from vstatics.pictures.plan.rays import KinematicPlan
from vstatics.pictures.runs import PicturedEvent, PicturedRun, event_text, named_events

COURSE_HEIGHT = 60.0
"""Of the time below a plan, without its events. [pt]"""
MOST_PLAN_EVENTS = 14
"""Events that are named."""
MOST_COURSE_POINTS = 4000
"""That are drawn."""
ON_PLAN = 5e-3
"""A run is on a plan where what holds all over it holds, to this part of the largest speed."""
EVENT_NAME_WIDTH = 150.0
"""Names of events are wrapped to this width. [pt]"""


class PlanCourse(NamedTuple):
    """A run as a plan has it."""

    time: Floats
    """[s]"""
    output: Floats
    """The abscissa: output speed by input speed; NaN where the input stands. [-]"""
    paths: Floats
    """Shape (instants, rays): speed of each ray's links by the input speed. [-]"""
    on_plan: NDArray[np.bool_]
    """Whether all that holds on the plan holds: its elements stick."""

    @property
    def visits(self) -> bool:
        """Whether the run is on the plan for a while."""
        both = self.on_plan[:-1] & self.on_plan[1:] & (np.diff(self.time) > 0)
        return bool(both.any())

    def masked(self, values: Floats, *, on_plan: bool) -> Floats:
        """Values on the plan or off it; NaN elsewhere. What is off reaches back onto it."""
        kept = self.on_plan if on_plan else ~self.on_plan
        if not on_plan:
            kept = kept | np.r_[kept[1:], False] | np.r_[False, kept[:-1]]
        return np.where(kept, values, np.nan)


def course(case: Transmission, plan: KinematicPlan, motion: PicturedRun) -> PlanCourse:
    """A run in the coordinates of a plan."""
    kept = np.unique(np.linspace(0, len(motion.time) - 1, MOST_COURSE_POINTS).astype(int))
    columns = {name: place for place, name in enumerate(motion.links)}
    own = range(1, case.own_links + 1)
    speeds = {link: motion.speeds[kept, columns[case.link_name(link)]] for link in own}
    turns, out = speeds[plan.input], speeds[plan.output]
    largest = np.abs(motion.speeds).max()
    moving = np.abs(turns) > ON_PLAN * largest
    by = np.where(moving, turns, np.nan)
    on_plan = moving.copy()
    for one in _rigid(case, plan):
        fast = speeds[one.other] if one.other != HOUSING else _given(one.speed, speeds, turns)
        on_plan &= np.abs(speeds[one.link] - fast) <= ON_PLAN * largest
    paths = [speeds[ray.links[0]] / by for ray in plan.rays]
    return PlanCourse(motion.time[kept], out / by, np.stack(paths, axis=1), on_plan)


def _rigid(case: Transmission, plan: KinematicPlan) -> Iterator[Condition]:
    """What holds on a plan, but for elements that twist: their links need not turn alike."""
    for one in plan.state:
        same = [each for each in case.shift_elements if {*each.links} == {one.link, one.other}]
        if not same or any(each.stiffness is None for each in same):
            yield one


def _given(speed: float | SpeedOf, speeds: dict[int, Floats], turns: Floats) -> Floats:
    """A speed that a gear gives, over that of the input or of another link."""
    if isinstance(speed, SpeedOf):
        return speed.factor * speeds[speed.link]
    return speed * turns


def right_of(motion: PicturedRun, style: Style) -> float:
    """Width that the names of events need [pt]."""
    named = named_events(motion.events, MOST_PLAN_EVENTS)
    return LEADER + widest(_name(event, style) for event in named) + LEADER / 2


def high_of(motion: PicturedRun, style: Style) -> float:
    """Height of the time below a plan [pt]."""
    named = named_events(motion.events, MOST_PLAN_EVENTS)
    return max(COURSE_HEIGHT, sum(height(_name(one, style)) + LABEL_GAP for one in named))


def draw_paths(pen: Pen, plan: KinematicPlan, run: PlanCourse) -> None:
    """What the run goes over of each ray, and how it leaves and reaches the plan."""
    for place, ray in enumerate(plan.rays):
        is_port = plan.input in ray.links or plan.output in ray.links
        look = link_look(ray.links[0], pen.style)
        for on_plan, more in ((True, BROAD | {"linestyle": "solid"}), (False, PATH)):
            if on_plan or not is_port:
                values = run.masked(run.paths[:, place], on_plan=on_plan)
                pen.plot(run.masked(run.output, on_plan=on_plan), values, **look | more)


def draw_time(pen: Pen, plan: KinematicPlan, run: PlanCourse, motion: PicturedRun) -> None:
    """The abscissa of the run over time, which goes down, below the plan."""
    (wide, high), style = pen.size, pen.style
    gears = [pen.across(mark.output) for mark in plan.marks]
    pen.lines([((x, 0.0), (x, high)) for x in gears], **gear_look(style))
    times = [pen.up(time) for time in sorted({event.time for event in motion.events})]
    pieces = [((0.0, y), (wide, y)) for y in times]
    pen.lines(pieces, color=style.faint, width=LEADER_WIDTH, zorder=0.5)
    for on_plan, look in ((True, {"width": 2.4}), (False, PATH)):
        values = run.masked(run.output, on_plan=on_plan)
        pen.plot(values, run.time, color=style.engaged, **look)
    pen.frame()
    numbers = ticks(motion.time[0], motion.time[-1], 4)
    pen.scale("left", numbers)
    pen.name("left", style.text("time, s"), widest(tick_texts(numbers)) + 14)
    ends = [
        LineEnd(pen.y.part(one.time), [_name(one, style)])
        for one in named_events(motion.events, MOST_PLAN_EVENTS)
    ]
    beside(pen, "right", ends)


def _name(event: PicturedEvent, style: Style) -> str:
    return wrapped(f"{number(event.time)} {event_text(event, style)}", EVENT_NAME_WIDTH)


def visited(
    case: Transmission, plans: Sequence[KinematicPlan], motion: PicturedRun
) -> list[tuple[KinematicPlan, PlanCourse]]:
    """The plans on which the run is at any time, with its course."""
    every = [(plan, course(case, plan, motion)) for plan in plans]
    return [(plan, run) for plan, run in every if run.visits]
