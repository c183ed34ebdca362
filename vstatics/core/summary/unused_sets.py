"""What else the shift elements could give: combinations that no gear of the case engages."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import combinations as subsets
from typing import NamedTuple, TypeVar

from vstatics.core.errors import CaseError
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.statics.diagnosis import freedom
from vstatics.core.statics.results import Results
from vstatics.core.statics.solve import solve
from vstatics.core.summary.design_table import is_same

MOST_UNUSED_SETS = 10_000
"""So many combinations are tried unless more are asked for: some seconds."""

Key = TypeVar("Key")


class Combination(NamedTuple):
    """Shift elements that give a ratio when they are engaged together."""

    engaged: Sequence[str]
    holding: Sequence[str]
    """Freewheels that hold besides."""
    ratio: float
    efficiency: float
    gear: str
    """A gear of the case with the same ratio, if there is one."""
    state: str
    """As in the design table."""


def needed(case: Transmission) -> int:
    """How many engaged elements the speeds need: the degrees of freedom less the input.

    >>> from vstatics.core.model.transmission import Mechanism, ShiftElement
    >>> needed(Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])]))
    1
    """
    return max(freedom(case) - 1, 0)


def combinations(results: Results, at_most: int = MOST_UNUSED_SETS) -> list[Combination]:
    """All other combinations of shift elements that give one case a gear, largest ratio first.

    Tried are all sets of as many elements as the speeds need, with the input and the
    output of the case and no given speeds; freewheels find by themselves whether they
    hold, so where there are any, sets that are smaller by these are tried, too. A gear is
    what has a ratio and is not tied up. Drag that all gears share is kept.

    Parameters
    ----------
    at_most : int
        So many sets may be tried.

    Raises
    ------
    CaseError
        If there are more.

    Examples
    --------
    >>> from vstatics import Mechanism, ShiftElement, solve
    >>> case = Transmission(3, [ShiftElement(1, 2, "C"), ShiftElement(2, 0, "B")],
    ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([2])])
    >>> [found] = combinations(solve(case))
    >>> found.engaged, found.ratio
    (['C'], 1.0)
    """
    case = results.case
    _check(case, at_most)
    common = shared([gear.drag for gear in case.gears])
    open_drag = shared([gear.open_drag for gear in case.gears])
    gears = [Gear(engaged, drag=common, open_drag=open_drag) for engaged in _tried(case)]
    if not gears:
        return []
    tried = solve(replace(case, gears=gears))
    ratios = {
        gear.name: ratio
        for gear, ratio in zip(case.gears, results.ratio.tolist(), strict=True)
        if is_plain(case, gear)
    }
    return sorted(_usable(tried, ratios), key=lambda one: -one.ratio)


def _sizes(case: Transmission) -> range:
    """How many elements are engaged: fewer, where freewheels may hold; more, with lock-ups."""
    most = needed(case)
    converters = [one for one in case.mechanisms if one.kind == "converter"]
    return range(max(most - len(case.freewheels), 0), most + len(converters) + 1)


def _check(case: Transmission, at_most: int) -> None:
    elements = len(case.shift_elements) - len(case.freewheels)
    count = sum(math.comb(elements, size) for size in _sizes(case))
    if count > at_most:
        message = (
            f"{needed(case)} of {len(case.shift_elements)} shift elements have {count} "
            f"combinations, more than the {at_most} that may be tried"
        )
        raise CaseError("E420", message, ("shift_elements",))


def _tried(case: Transmission) -> Iterator[tuple[int, ...]]:
    """The sets that no gear engages, as numbers of elements."""
    numbers = [n for n, one in enumerate(case.shift_elements, 1) if not one.is_freewheel]
    own = {frozenset(gear.engaged) for gear in case.gears if is_plain(case, gear)}
    most = needed(case)
    for size in _sizes(case):
        for chosen in subsets(numbers, size):
            if frozenset(chosen) not in own and size <= most + len(case.bypassed(Gear(chosen))):
                yield chosen


def is_plain(case: Transmission, gear: Gear) -> bool:
    """Whether a gear has the ports of the case, and no given speeds.

    >>> from vstatics.core.model.transmission import Mechanism
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, -2.5)], [Gear(), Gear(input=2, output=1)])
    >>> [is_plain(case, gear) for gear in case.gears]
    [True, False]
    """
    ports = case.gear_input(gear), case.gear_output(gear)
    return ports == (case.input, case.output) and not gear.speeds


def shared(by_gear: Sequence[Mapping[Key, float]]) -> dict[Key, float]:
    """What all gears give alike.

    >>> shared([{"F1": 0.5, "F2": 0.1}, {"F1": 0.5, "F2": 0.2}])
    {'F1': 0.5}
    """
    first, *others = by_gear
    return {
        key: value
        for key, value in first.items()
        if all(key in other and is_same(other[key], value) for other in others)
    }


def _usable(tried: Results, ratios: Mapping[str, float]) -> Iterator[Combination]:
    names = [element.name for element in tried.case.shift_elements]
    for index, (gear, ratio) in enumerate(zip(tried.case.gears, tried.ratio.tolist(), strict=True)):
        if tried.calculable[index] and math.isfinite(ratio):
            yield Combination(
                [names[number - 1] for number in gear.engaged],
                [names[n - 1] for n in tried.case.freewheels if tried.holds[index, n - 1]],
                ratio,
                float(tried.efficiency[index]),
                next((name for name, other in ratios.items() if is_same(other, ratio)), ""),
                tried.status(index + 1).name,
            )
