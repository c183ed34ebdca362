"""Simulated run of a case in the coordinates of a plan, and the ratio over time."""

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
"""Height of the time axis below a plan, without the names of events. [pt]"""
MOST_PLAN_EVENTS = 14
"""Largest number of events whose names are written."""
MOST_COURSE_POINTS = 4000
"""Largest number of instants of a run that are drawn."""
ON_PLAN = 5e-3
"""Speed difference, relative to the largest speed, up to which a constraint counts as satisfied.
[-]
"""
EVENT_NAME_WIDTH = 150.0
"""Width to which names of events are wrapped. [pt]"""


class PlanCourse(NamedTuple):
    """Simulated run in the coordinates of a plan."""

    time: Floats
    """Time of each instant. [s]"""
    output: Floats
    """Output speed divided by input speed, the abscissa; NaN if the input is at rest. [-]"""
    paths: Floats
    """Speed of the links of each ray divided by input speed, shape (instants, rays). [-]"""
    on_plan: NDArray[np.bool_]
    """Whether all constraints of the plan are satisfied, at each instant."""

    @property
    def visits(self) -> bool:
        """Whether the run satisfies the plan's constraints for an interval of time."""
        both = self.on_plan[:-1] & self.on_plan[1:] & (np.diff(self.time) > 0)
        return bool(both.any())

    def masked(self, values: Floats, *, on_plan: bool) -> Floats:
        """Return the values where the run is on the plan (or off the plan), NaN elsewhere.

        Values off the plan include the neighbouring instants on the plan, so that the two curves
        meet.
        """
        mask = self.on_plan if on_plan else ~self.on_plan
        if not on_plan:
            mask = mask | np.r_[mask[1:], False] | np.r_[False, mask[:-1]]
        return np.where(mask, values, np.nan)


def course(case: Transmission, plan: KinematicPlan, motion: PicturedRun) -> PlanCourse:
    """Convert a simulated run to the coordinates of a plan."""
    instants = np.unique(np.linspace(0, len(motion.time) - 1, MOST_COURSE_POINTS).astype(int))
    columns = {name: place for place, name in enumerate(motion.links)}
    links = range(1, case.own_links + 1)
    speeds = {link: motion.speeds[instants, columns[case.link_name(link)]] for link in links}
    w_input, out = speeds[plan.input], speeds[plan.output]
    largest = np.abs(motion.speeds).max()
    moving = np.abs(w_input) > ON_PLAN * largest
    nonzero_input = np.where(moving, w_input, np.nan)
    on_plan = moving.copy()
    for condition in _rigid(case, plan):
        given = condition.speed
        if condition.other != HOUSING:
            fast = speeds[condition.other]
        elif isinstance(given, SpeedOf):
            fast = given.factor * speeds[given.link]
        else:
            fast = given * w_input
        on_plan &= np.abs(speeds[condition.link] - fast) <= ON_PLAN * largest
    paths = [speeds[ray.links[0]] / nonzero_input for ray in plan.rays]
    return PlanCourse(motion.time[instants], out / nonzero_input, np.stack(paths, axis=1), on_plan)


def _rigid(case: Transmission, plan: KinematicPlan) -> Iterator[Condition]:
    """Yield the constraints of a plan, leaving out elastic shift elements, which twist."""
    for condition in plan.state:
        elements = [
            element
            for element in case.shift_elements
            if {*element.links} == {condition.link, condition.other}
        ]
        if not elements or any(element.stiffness is None for element in elements):
            yield condition


def right_of(motion: PicturedRun, style: Style) -> float:
    """Return the width to the right of a plan that the names of events need [pt]."""
    named = named_events(motion.events, MOST_PLAN_EVENTS)
    return LEADER + widest(_name(event, style) for event in named) + LEADER / 2


def high_of(motion: PicturedRun, style: Style) -> float:
    """Return the height below a plan that the time axis and the names of events need [pt]."""
    named = named_events(motion.events, MOST_PLAN_EVENTS)
    return max(COURSE_HEIGHT, sum(height(_name(event, style)) + LABEL_GAP for event in named))


def draw_paths(pen: Pen, plan: KinematicPlan, run: PlanCourse) -> None:
    """Draw the run along each ray of a plan, and the paths while the run is not on the plan."""
    for place, ray in enumerate(plan.rays):
        is_port = plan.input in ray.links or plan.output in ray.links
        look = link_look(ray.links[0], pen.style)
        for on_plan, more in ((True, BROAD | {"linestyle": "solid"}), (False, PATH)):
            if on_plan or not is_port:
                values = run.masked(run.paths[:, place], on_plan=on_plan)
                pen.plot(run.masked(run.output, on_plan=on_plan), values, **look | more)


def draw_time(pen: Pen, plan: KinematicPlan, run: PlanCourse, motion: PicturedRun) -> None:
    """Draw output speed divided by input speed over time, which runs downwards below the plan."""
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
        LineEnd(pen.y.part(event.time), [_name(event, style)])
        for event in named_events(motion.events, MOST_PLAN_EVENTS)
    ]
    beside(pen, "right", ends)


def _name(event: PicturedEvent, style: Style) -> str:
    return wrapped(f"{number(event.time)} {event_text(event, style)}", EVENT_NAME_WIDTH)


def visited(
    case: Transmission, plans: Sequence[KinematicPlan], motion: PicturedRun
) -> list[tuple[KinematicPlan, PlanCourse]]:
    """Return the plans on which the run stays for an interval, each with the converted run."""
    every = [(plan, course(case, plan, motion)) for plan in plans]
    return [(plan, run) for plan, run in every if run.visits]
