"""Generalised kinematic plans: the speeds of all links versus the output speed.

The input speed is 1, and the constraints of the plan fix all degrees of freedom except one. The
speed of each link is then a linear function of the output speed: a ray. A gear of ratio i is the
point ``1/i`` of the horizontal axis, where the gear's shift element brings a link to rest or
connects two links.

Source: Voloshko, Galimyanov, Salakhov, Mavleev, Kinematic and force analysis of the
universal multi-flow differential mechanism (in Russian), figure 5.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache, partial
from typing import NamedTuple

from vstatics.core.errors import CaseError
from vstatics.core.model.open_converters import with_mechanisms
from vstatics.core.model.transmission import ShiftElement, Transmission
from vstatics.core.numerics.tolerances import SAME_RATIO
from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.gear_state import PictureState, state_of
from vstatics.pictures.plan.conditions import (
    Condition,
    Conditions,
    FreeOutput,
    carrying,
    conditions,
    elements_of,
    is_free,
    largest,
    speeds_under,
)


class Ray(NamedTuple):
    """Links of relative speed ``start + slope*x`` at the relative output speed x [-]."""

    links: tuple[int, ...]
    start: float
    slope: float

    def at(self, output: float) -> float:
        """Return the speed at an output speed, both relative to the input speed [-]."""
        return self.start + self.slope * output


class Mark(NamedTuple):
    """Point on the horizontal axis, with the gears that have this output speed.

    These gears differ only in shift elements without torque.
    """

    gears: tuple[int, ...]
    """Numbers of the gears, from 1."""
    output: float
    """Output speed relative to the input speed, 1/i. [-]"""
    elements: tuple[int, ...]
    """Numbers of the gears' torque-carrying shift elements that are not common to the plan."""


class KinematicPlan(NamedTuple):
    """Generalised kinematic plan: constraints common to the gears, rays of links, and gears."""

    input: int
    output: int
    state: tuple[Condition, ...]
    """Constraints that hold in all gears of the plan."""
    engaged: tuple[str, ...]
    """Names of the shift elements engaged in all gears, with equivalent elements as "A/B"."""
    given: tuple[str, ...]
    """Link speeds that all gears of the plan prescribe, as text."""
    rays: tuple[Ray, ...]
    marks: tuple[Mark, ...]
    standing: tuple[int, ...]
    """Numbers of links at rest in all gears of the plan, which have no ray."""

    @property
    def gears(self) -> tuple[int, ...]:
        """Numbers of the gears on the plan."""
        return tuple(sorted(number for mark in self.marks for number in mark.gears))

    @property
    def has_unit_point(self) -> bool:
        """Whether all rays meet at (1, 1), so that the train can rotate as a block."""
        return all(abs(ray.at(1.0) - 1.0) < SAME_RATIO for ray in self.rays)


def plans(results: Results) -> list[KinematicPlan]:
    """Calculate the generalised kinematic plans of a case.

    A train of two degrees of freedom has a single plan. With more degrees of freedom, gears of
    different ratios form a plan if they share constraints, and each of them needs just one more
    shift element. Shift elements without torque, such as the preselected dog clutch of a
    dual-clutch transmission, are ignored. A case without two such gears has no plan.

    Raises
    ------
    CaseError
        If no gear has a degree of freedom that a single shift element fixes.

    Examples
    --------
    In a planetary set with the sun as input and the carrier as output, the ring is at rest where
    the output rotates at 1/3.5, and rotates with the sun in the direct gear.

    >>> from vstatics import Gear, Mechanism, ShiftElement, solve
    >>> set_, gears = Mechanism(1, 2, 3, ratio=-2.5), [Gear([1]), Gear([2])]
    >>> case = Transmission(3, [ShiftElement(2), ShiftElement(1, 2)], [set_], gears)
    >>> [plan] = plans(solve(case))
    >>> [round(ray.start + 0.0, 3) for ray in plan.rays], [round(ray.slope, 3) for ray in plan.rays]
    ([1.0, -0.4, 0.0], [0.0, 1.4, 1.0])
    """
    case = _with_ratios(results)
    gears = [state_of(results, number) for number in range(1, len(case.gears) + 1)]
    known = {
        number: gear
        for number, gear in enumerate(gears, 1)
        if math.isfinite(gear.speeds[gear.output]) and not gear.gear.slipping
    }
    carried = {number: carrying(case, gear) for number, gear in known.items()}
    free = cache(partial(is_free, case))
    states = dict.fromkeys(
        (gear.input, gear.output, state)
        for number, gear in known.items()
        for state in largest(gear, carried[number], free)
    )
    if not states:
        message = "a kinematic plan shows the speeds that all shift elements but one leave free"
        raise CaseError("E405", f"{message}, but no gear of this case leaves a speed free")
    drawn = []
    for first, last, state in sorted(states, key=lambda key: (key[:2], len(key[2]), key[2])):
        gears_of_ports = {
            n: gear for n, gear in known.items() if (first, last) == (gear.input, gear.output)
        }
        marks = _marks(case, gears_of_ports, carried, state, free)
        if marks:
            rays, standing = _rays(case, first, last, state)
            engaged, given = _names(case, state, marks)
            drawn.append(KinematicPlan(first, last, state, engaged, given, rays, marks, standing))
    return drawn


def off_plans(case: Transmission, drawn: Sequence[KinematicPlan]) -> list[str]:
    """Return the names of the gears that are not on any plan."""
    on_plans = {number for plan in drawn for number in plan.gears}
    return [gear.name for number, gear in enumerate(case.gears, 1) if number not in on_plans]


def _with_ratios(results: Results) -> Transmission:
    """Set the speed ratios that the load determines, and open mechanisms with several ratios.

    Such a mechanism becomes a shift element that no gear engages.
    """
    case = results.with_freewheels_engaged
    if not any(mechanism.kind for mechanism in case.mechanisms):
        return case
    solved = results.points.gears if results.points else case.gears
    remaining, opened = {}, list(case.shift_elements)
    for number, mechanism in enumerate(case.mechanisms[case.own_mechanisms], 1):
        in_gears = (gear.speed_ratios.get(number, mechanism.ratio) for gear in solved)
        ratios = [ratio for ratio in in_gears if math.isfinite(ratio)]
        if ratios and max(ratios) - min(ratios) < SAME_RATIO:
            remaining[number] = mechanism._replace(ratio=ratios[0])
        else:
            opened.append(ShiftElement(mechanism.first, mechanism.second, mechanism.name))
    numbers = {number: place for place, number in enumerate(remaining, 1)}
    gears = [gear.renumbered(numbers) for gear in case.gears]
    return with_mechanisms(case, [*remaining.values()], shift_elements=opened, gears=gears)


def _marks(
    case: Transmission,
    gears: dict[int, PictureState],
    carried: dict[int, Conditions],
    state: Sequence[Condition],
    free: FreeOutput,
) -> tuple[Mark, ...]:
    """Return the marks of the gears that share the constraints `state`, for the horizontal axis.

    The result is empty if all these gears have the same ratio.
    """
    marks: list[Mark] = []
    common = frozenset(state)
    for number, gear in gears.items():
        further = carried[number] - common
        if not conditions(case, gear.gear) >= common or any(
            free(gear.input, gear.output, common | {condition}) for condition in further
        ):
            continue
        mark = Mark((number,), gear.speeds[gear.output], elements_of(case, gear.gear, further))
        for place, other in enumerate(marks):
            if _same(other, mark) and other.elements == mark.elements:
                marks[place] = other._replace(gears=(*other.gears, number))
                break
        else:
            marks.append(mark)
    return () if all(_same(mark, marks[0]) for mark in marks) else tuple(marks)


def _same(mark: Mark, other: Mark) -> bool:
    return math.isclose(mark.output, other.output, rel_tol=SAME_RATIO)


def _rays(
    case: Transmission, first: int, last: int, state: Sequence[Condition]
) -> tuple[tuple[Ray, ...], tuple[int, ...]]:
    link_count = case.own_links
    ends = [speeds_under(case, first, last, state, output) for output in (0.0, 1.0)]
    rays: list[Ray] = []
    standing = []
    for link, (start, end) in enumerate(
        zip(*(speeds[:link_count] for speeds in ends), strict=True), 1
    ):
        slope = end - start
        if math.isnan(slope):
            continue
        if abs(start) < SAME_RATIO and abs(slope) < SAME_RATIO:
            standing.append(link)
            continue
        for place, ray in enumerate(rays):
            if abs(ray.start - start) < SAME_RATIO and abs(ray.slope - slope) < SAME_RATIO:
                rays[place] = ray._replace(links=(*ray.links, link))
                break
        else:
            rays.append(Ray((link,), start, slope))
    return tuple(rays), tuple(standing)


def _names(
    case: Transmission, state: Sequence[Condition], marks: Sequence[Mark]
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the names of shift elements that impose the constraints, and the given speeds."""
    gears = [case.gears[number - 1] for mark in marks for number in mark.gears]
    elements: list[tuple[list[int], str]] = []
    given = []
    for condition in state:
        same = frozenset([condition])
        numbers = sorted({element for gear in gears for element in elements_of(case, gear, same)})
        if numbers:
            names = [element.name for element in case.elements_at(numbers)]
            elements.append((numbers, "/".join(names)))
        else:
            given.append(f"{case.link_name(condition.link)} = {case.speed_text(condition.speed)}")
    return tuple(names for _, names in sorted(elements)), tuple(given)
