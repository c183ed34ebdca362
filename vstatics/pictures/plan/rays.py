"""The generalised kinematic plan: speeds of all links over the output speed.

With the input speed 1 and all but one degree of freedom taken by engaged elements,
every link speed is a linear function of the output speed: a ray. A gear is a point on
the abscissa, at ``1/i``; the element that makes it stops its link there, or joins its two.

Source: Voloshko, Galimyanov, Salakhov, Mavleev, Kinematic and force analysis of the
universal multi-flow differential mechanism (in Russian), figure 5.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from vstatics.errors import CaseError
from vstatics.model.transmission import HOUSING, Gear, ShiftElement, SpeedOf, Transmission
from vstatics.numerics.tolerances import SAME_RATIO
from vstatics.numerics.traced import plain
from vstatics.pictures.sheet.gear_state import PictureState, state_of
from vstatics.statics.matrix import columns
from vstatics.statics.results import Results
from vstatics.statics.speeds import solve_speeds

MOST_STATES = 300
"""Of a gear that are tried."""


class Condition(NamedTuple):
    """What an engaged element, or a given speed, says: one link turns with another, or so fast."""

    link: int
    other: int
    speed: float | SpeedOf = 0.0
    """Of the link, where the other is the housing. [-]"""


_Freedoms = dict[tuple[int, int, frozenset[Condition]], bool]
"""By input, output and conditions: whether these leave the output free."""


class Ray(NamedTuple):
    """Links whose speed is ``start + slope*x`` at the output speed x [-]."""

    links: tuple[int, ...]
    start: float
    slope: float

    def at(self, output: float) -> float:
        """The speed at an output speed [-]."""
        return self.start + self.slope * output


class Mark(NamedTuple):
    """A gear on the abscissa."""

    gear: int
    """Number, from 1."""
    output: float
    """Its output speed, 1/i. [-]"""
    elements: tuple[int, ...]
    """Numbers of the shift elements that are engaged besides those of the plan."""


class KinematicPlan(NamedTuple):
    """One plan: what is engaged in all of it, its rays and its gears."""

    input: int
    output: int
    engaged: tuple[str, ...]
    """Names of the shift elements; where two do the same, in one with a stroke between."""
    given: tuple[str, ...]
    """Speeds that are given, in words."""
    rays: tuple[Ray, ...]
    marks: tuple[Mark, ...]
    standing: tuple[int, ...]
    """Links that stand all over the plan; these have no ray."""

    @property
    def has_unit_point(self) -> bool:
        """Whether all rays meet at (1, 1): the train may turn as one piece."""
        return all(abs(ray.at(1.0) - 1.0) < SAME_RATIO for ray in self.rays)


def plans(results: Results) -> list[KinematicPlan]:
    """The generalised kinematic plans of one case.

    A train of two degrees of freedom has one. Where there are more, there is one for
    each state of the other elements that at least two gears share; if no gears share
    any, one for each state.

    Raises
    ------
    CaseError
        If no gear leaves anything free that one of its elements takes.

    Examples
    --------
    A differential, its sun the input and its carrier the output: the ring stands where
    the output turns at 1/3.5.

    >>> from vstatics import Gear, Mechanism, ShiftElement, solve
    >>> set_ = Mechanism(1, 2, 3, ratio=-2.5)
    >>> [plan] = plans(solve(Transmission(3, [ShiftElement(2)], [set_], [Gear([1])])))
    >>> [round(ray.start + 0.0, 3) for ray in plan.rays], [round(ray.slope, 3) for ray in plan.rays]
    ([1.0, -0.4, 0.0], [0.0, 1.4, 1.0])
    """
    case = _with_free_ratios(results.with_freewheels_engaged)
    gears = [state_of(results, number) for number in range(1, len(case.gears) + 1)]
    known = [
        (number, gear)
        for number, gear in enumerate(gears, 1)
        if math.isfinite(gear.speeds[gear.output])
    ]
    free: _Freedoms = {}
    states = dict.fromkeys(
        (gear.input, gear.output, state) for _, gear in known for state in _states(case, gear, free)
    )
    drawn = []
    for first, last, state in sorted(states, key=lambda key: (key[:2], len(key[2]), key[2])):
        marks = tuple(
            Mark(number, gear.speeds[last], _further(case, gear.gear, state))
            for number, gear in known
            if (first, last) == (gear.input, gear.output)
            and _conditions(case, gear.gear).issuperset(state)
        )
        rays, standing = _rays(case, first, last, state)
        engaged, given = _names(case, state, marks)
        drawn.append(KinematicPlan(first, last, engaged, given, rays, marks, standing))
    if not drawn:
        message = "a kinematic plan shows what is left free by all elements of a gear but one"
        raise CaseError("E405", f"{message}, and no gear of this case leaves anything free")
    shared = [plan for plan in drawn if len({mark.output for mark in plan.marks}) > 1]
    return shared or drawn


def _with_free_ratios(case: Transmission) -> Transmission:
    """The case with open elements in place of what gears give a speed ratio."""
    given = {number for gear in case.gears for number in gear.speed_ratios}
    if not given:
        return case
    own = case.own_mechanisms.start
    kept, opened = [], list(case.shift_elements)
    for number, one in enumerate(case.mechanisms, 1 - own):
        if number in given:
            opened.append(ShiftElement(one.first, one.second, one.name))
        else:
            kept.append(one)
    gears = [gear._replace(speed_ratios={}) for gear in case.gears]
    return case.replace(shift_elements=opened, mechanisms=kept, gears=gears)


def _conditions(case: Transmission, gear: Gear) -> set[Condition]:
    """What is engaged and given in a gear; two elements that do the same are one."""
    engaged = (case.shift_elements[number - 1] for number in gear.engaged)
    joined = {Condition(max(element.links), min(element.links)) for element in engaged}
    return joined | {Condition(link, HOUSING, speed) for link, speed in gear.speeds.items()}


def _states(
    case: Transmission, gear: PictureState, free: _Freedoms
) -> Iterator[tuple[Condition, ...]]:
    """The largest parts of a gear's conditions under which its output is free.

    Of a smallest part that determines the output one condition at least has to go, so only
    these ways are followed. What was found for other gears is read, and kept, in `free`.
    """

    def is_free(chosen: frozenset[Condition]) -> bool:
        key = gear.input, gear.output, chosen
        if key not in free:
            speeds = _speeds(case, gear.input, gear.output, sorted(chosen))
            free[key] = math.isnan(speeds[gear.output - 1])
        return free[key]

    found: list[frozenset[Condition]] = []
    seen: set[frozenset[Condition]] = set()
    waiting = [frozenset(_conditions(case, gear.gear))]
    while waiting:
        chosen = waiting.pop()
        if chosen in seen or any(larger >= chosen for larger in found):
            continue
        seen.add(chosen)
        if len(seen) > MOST_STATES:
            message = f"gear {gear.gear.name} has too many plans, {MOST_STATES} are drawn at most"
            raise CaseError("E406", f"{message}: its elements do the same in many ways")
        if is_free(chosen):
            found = [one for one in found if not chosen > one] + [chosen]
            continue
        needed = chosen
        for one in sorted(chosen):
            if not is_free(needed - {one}):
                needed -= {one}
        waiting += [chosen - {one} for one in sorted(needed)]
    yield from (tuple(sorted(one)) for one in found)


def _speeds(
    case: Transmission,
    first: int,
    last: int,
    state: Sequence[Condition],
    output: float | None = None,
) -> list[float]:
    """Speeds of all links, NaN for what is free; that of the output may be given."""
    ratios = [mechanism.ratio for mechanism in case.mechanisms]
    speeds = {c.link: c.speed for c in state if c.other == HOUSING}
    pairs = [{c.link, c.other} for c in state if c.other != HOUSING]
    engaged = [
        next(n for n, element in enumerate(case.shift_elements, 1) if set(element.links) == pair)
        for pair in pairs
    ]
    if output is not None:
        speeds[last] = output
    gear = Gear(engaged, speeds, input=first, output=last)
    return [plain(speed) for speed in solve_speeds(case, gear, columns(case, ratios)).links]


def _rays(
    case: Transmission, first: int, last: int, state: Sequence[Condition]
) -> tuple[tuple[Ray, ...], tuple[int, ...]]:
    """The rays of the case's own links; links that stand have none, and are told."""
    own = case.own_links
    ends = [_speeds(case, first, last, state, output) for output in (0.0, 1.0)]
    rays: list[Ray] = []
    standing = []
    for link, (start, end) in enumerate(zip(*(speeds[:own] for speeds in ends), strict=True), 1):
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


def _further(case: Transmission, gear: Gear, state: Sequence[Condition]) -> tuple[int, ...]:
    """The engaged elements of a gear that do not belong to a state."""
    return tuple(
        number for number in gear.engaged if not set(state) & _conditions(case, Gear([number]))
    )


def _names(
    case: Transmission, state: Sequence[Condition], marks: Sequence[Mark]
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """The elements that make a state in its gears, in their order, and its given speeds."""
    engaged = sorted({number for mark in marks for number in case.gears[mark.gear - 1].engaged})
    elements: list[tuple[list[int], str]] = []
    given = []
    for condition in state:
        numbers = [one for one in engaged if condition in _conditions(case, Gear([one]))]
        if numbers:
            names = [case.shift_elements[number - 1].name for number in numbers]
            elements.append((numbers, "/".join(names)))
        else:
            given.append(f"{case.link_name(condition.link)} = {case.speed_text(condition.speed)}")
    return tuple(names for _, names in sorted(elements)), tuple(given)
