"""What holds in a gear of what is engaged and given, and what of it leaves the output free."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from vstatics.core.errors import CaseError
from vstatics.core.model.transmission import HOUSING, Gear, ShiftElement, SpeedOf, Transmission
from vstatics.core.numerics.traced import plain
from vstatics.core.statics.matrix import columns
from vstatics.core.statics.speeds import solve_speeds
from vstatics.pictures.drawing.gear_state import PictureState

MOST_STATES = 300
"""Of a gear that are tried."""


class Condition(NamedTuple):
    """What an engaged element, or a given speed, says: one link turns with another, or so fast."""

    link: int
    other: int
    speed: float | SpeedOf = 0.0
    """Of the link, where the other is the housing. [-]"""


Conditions = frozenset[Condition]


def conditions(case: Transmission, gear: Gear) -> Conditions:
    """What is engaged and given in a gear; two elements that do the same are one."""
    engaged = (case.shift_elements[number - 1] for number in gear.engaged)
    given = (Condition(link, HOUSING, speed) for link, speed in gear.speeds.items())
    return frozenset([*map(_condition, engaged), *given])


def _condition(element: ShiftElement) -> Condition:
    return Condition(max(element.links), min(element.links))


def carrying(case: Transmission, gear: PictureState) -> Conditions:
    """The same without what is engaged and carries no torque, as a dog clutch that waits.

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
    loaded = [number for number in gear.gear.engaged if gear.loaded_elements[number - 1]]
    return conditions(case, gear.gear._replace(engaged=tuple(loaded)))


def elements_of(case: Transmission, gear: Gear, some: Conditions) -> tuple[int, ...]:
    """The numbers of the engaged elements of a gear that say some of what holds in it."""
    return tuple(
        number for number in gear.engaged if _condition(case.shift_elements[number - 1]) in some
    )


class FreeOutputs:
    """Whether conditions leave the output free; what was found is kept."""

    def __init__(self, case: Transmission) -> None:
        """Of a case."""
        self._case = case
        self._known: dict[tuple[int, int, Conditions], bool] = {}

    def is_free(self, first: int, last: int, chosen: Conditions) -> bool:
        """Whether the output may have any speed while the input has its own."""
        key = first, last, chosen
        if key not in self._known:
            speeds = speeds_under(self._case, first, last, sorted(chosen))
            self._known[key] = math.isnan(speeds[last - 1])
        return self._known[key]

    def largest(self, gear: PictureState, given: Conditions) -> Iterator[tuple[Condition, ...]]:
        """The largest parts of the conditions of a gear under which its output is free.

        Of a smallest part that determines the output one condition at least has to go, so only
        these ways are followed.

        Raises
        ------
        CaseError
            If there are too many.
        """
        found: list[Conditions] = []
        seen: set[Conditions] = set()
        waiting = [given]
        while waiting:
            chosen = waiting.pop()
            if chosen in seen or any(larger >= chosen for larger in found):
                continue
            seen.add(chosen)
            if len(seen) > MOST_STATES:
                message = (
                    f"gear {gear.gear.name} has too many plans, {MOST_STATES} are drawn at most"
                )
                raise CaseError("E406", f"{message}: its elements do the same in many ways")
            if self.is_free(gear.input, gear.output, chosen):
                found = [one for one in found if not chosen > one] + [chosen]
                continue
            needed = chosen
            for one in sorted(chosen):
                if not self.is_free(gear.input, gear.output, needed - {one}):
                    needed -= {one}
            waiting += [chosen - {one} for one in sorted(needed)]
        yield from (tuple(sorted(one)) for one in found)


def speeds_under(
    case: Transmission,
    first: int,
    last: int,
    state: Sequence[Condition],
    output: float | None = None,
) -> list[float]:
    """Speeds of all links, NaN for what is free; that of the output may be given [-]."""
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
