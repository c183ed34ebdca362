"""Constraints on speeds in a gear, and their subsets that leave the output speed free."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

from vstatics.core.errors import CaseError
from vstatics.core.model.transmission import HOUSING, Gear, ShiftElement, SpeedOf, Transmission
from vstatics.core.numerics.traced import plain
from vstatics.core.statics.matrix import rows
from vstatics.core.statics.speeds import solve_speeds
from vstatics.pictures.drawing.gear_state import PictureState

MOST_STATES = 300
"""Largest number of subsets of constraints that are tried for a gear."""


class Condition(NamedTuple):
    """Constraint on the speed of a link: equal to the speed of a second link, or a given speed."""

    link: int
    other: int
    speed: float | SpeedOf = 0.0
    """Speed of the link relative to the input, if the second link is the housing. [-]"""


Conditions = frozenset[Condition]
FreeOutput = Callable[[int, int, Conditions], bool]
"""The function `is_free` for a case, whose results are remembered."""


def conditions(case: Transmission, gear: Gear) -> Conditions:
    """Return the constraints of a gear, a single constraint for equivalent shift elements."""
    engaged = case.elements_at(gear.joining)
    given = (Condition(link, HOUSING, speed) for link, speed in gear.speeds.items())
    return frozenset([*map(_condition, engaged), *given])


def _condition(element: ShiftElement) -> Condition:
    return Condition(max(element.links), min(element.links))


def carrying(case: Transmission, gear: PictureState) -> Conditions:
    """Return the constraints of a gear, leaving out shift elements without torque.

    The preselected dog clutch of a dual-clutch transmission is engaged without torque.

    Examples
    --------
    >>> from vstatics import Mechanism, solve
    >>> from vstatics.pictures.drawing.gear_state import state_of
    >>> brakes = [ShiftElement(2), ShiftElement(4)]
    >>> sets = [Mechanism(1, 2, 3, ratio=-2.5), Mechanism(3, 4, 5, ratio=-2)]
    >>> case = Transmission(5, brakes, sets, [Gear([1, 2])], output=3)
    >>> sorted(carrying(case, state_of(solve(case), 1)))
    [Condition(link=2, other=0, speed=0.0)]
    """
    loaded = [number for number in gear.gear.joining if gear.loaded_elements[number - 1]]
    return conditions(case, gear.gear._replace(engaged=tuple(loaded), slip={}))


def elements_of(case: Transmission, gear: Gear, some: Conditions) -> tuple[int, ...]:
    """Return the numbers of the engaged elements that impose some of the constraints."""
    return tuple(
        number for number in gear.joining if _condition(case.shift_elements[number - 1]) in some
    )


def is_free(case: Transmission, first: int, last: int, chosen: Conditions) -> bool:
    """Check whether constraints leave the output speed indeterminate for a given input speed."""
    return math.isnan(speeds_under(case, first, last, sorted(chosen))[last - 1])


def largest(
    gear: PictureState, given: Conditions, free: FreeOutput
) -> Iterator[tuple[Condition, ...]]:
    """Yield the largest subsets of a gear's constraints that leave the output undetermined.

    Every such subset lacks at least one constraint of each minimal set that determines the
    output. The search therefore removes only constraints of such a minimal set.

    Raises
    ------
    CaseError
        If the gear has too many such subsets.
    """
    maximal: list[Conditions] = []
    seen: set[Conditions] = set()
    waiting = [given]
    while waiting:
        chosen = waiting.pop()
        if chosen in seen or any(larger >= chosen for larger in maximal):
            continue
        seen.add(chosen)
        if len(seen) > MOST_STATES:
            message = f"gear {gear.gear.name} has too many plans, {MOST_STATES} are drawn at most"
            raise CaseError("E406", f"{message}: its shift elements are equivalent in many ways")
        if free(gear.input, gear.output, chosen):
            maximal = [smaller for smaller in maximal if not chosen > smaller] + [chosen]
            continue
        needed = chosen
        for condition in sorted(chosen):
            if not free(gear.input, gear.output, needed - {condition}):
                needed -= {condition}
        waiting += [chosen - {condition} for condition in sorted(needed)]
    yield from (tuple(sorted(subset)) for subset in maximal)


def speeds_under(
    case: Transmission,
    first: int,
    last: int,
    state: Sequence[Condition],
    output: float | None = None,
) -> list[float]:
    """Return the speeds of all links relative to the input `first`; NaN if undetermined.

    The constraints are `state` and, if given, the relative speed `output` of the link `last`.
    """
    ratios = [mechanism.ratio for mechanism in case.mechanisms]
    speeds = {condition.link: condition.speed for condition in state if condition.other == HOUSING}
    engaged = [
        next(n for n, item in enumerate(case.shift_elements, 1) if _condition(item) == condition)
        for condition in state
        if condition.other != HOUSING
    ]
    if output is not None:
        speeds[last] = output
    gear = Gear(engaged, speeds, input=first, output=last)
    return [plain(speed) for speed in solve_speeds(case, gear, rows(case, ratios)).links]
