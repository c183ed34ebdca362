"""Further gears of a transmission: combinations of shift elements not used by the case."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import combinations as subsets
from typing import NamedTuple, TypeVar

from vstatics.core.errors import CaseError
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.statics.diagnosis.freedom import freedom
from vstatics.core.statics.results import Results
from vstatics.core.statics.solve import solve
from vstatics.core.summary.design_table import is_same

MOST_UNUSED_SETS = 10_000
"""Default of the largest number of combinations to calculate, which takes some seconds."""

Key = TypeVar("Key")


class Combination(NamedTuple):
    """Combination of engaged shift elements that has a ratio."""

    engaged: Sequence[str]
    holding: Sequence[str]
    """Freewheels that hold."""
    ratio: float
    efficiency: float
    gear: str
    """Gear of the case with the same ratio; empty without such a gear."""
    state: str
    """State of the combination, as in the design table."""


def needed(case: Transmission) -> int:
    """Return the number of shift elements that a gear must engage: degrees of freedom minus 1.

    >>> from vstatics.core.model.transmission import Mechanism, ShiftElement
    >>> needed(Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])]))
    1
    """
    return max(freedom(case) - 1, 0)


def combinations(results: Results, at_most: int = MOST_UNUSED_SETS) -> list[Combination]:
    """Return unused combinations of shift elements that have a ratio, largest ratio first.

    All sets with the required number of shift elements are calculated, with input and output of the
    case and without prescribed speeds. Smaller sets are included if freewheels can hold instead of
    engaged elements, and larger sets if they bypass converters. Tied-up sets are excluded. Drag
    torques common to all gears are included.

    Parameters
    ----------
    at_most : int
        Largest number of sets to calculate.

    Returns
    -------
    list of Combination
        Unused combinations with their ratios, in descending order of ratio.

    Raises
    ------
    CaseError
        If there are more sets than `at_most`.

    Examples
    --------
    >>> from vstatics import Mechanism, ShiftElement, solve
    >>> case = Transmission(3, [ShiftElement(1, 2, "C"), ShiftElement(2, 0, "B")],
    ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([2])])
    >>> [combination] = combinations(solve(case))
    >>> combination.engaged, combination.ratio
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
    return sorted(_usable(tried, ratios), key=lambda combination: -combination.ratio)


def _sizes(case: Transmission) -> range:
    """Return possible numbers of engaged elements: fewer with freewheels, more with converters."""
    most = needed(case)
    converters = [mechanism for mechanism in case.mechanisms if mechanism.kind == "converter"]
    return range(max(most - len(case.freewheels), 0), most + len(converters) + 1)


def _check(case: Transmission, at_most: int) -> None:
    elements = len(case.shift_elements) - len(case.freewheels)
    count = sum(math.comb(elements, size) for size in _sizes(case))
    if count > at_most:
        raise CaseError(
            "E420",
            f"{needed(case)} of {len(case.shift_elements)} shift elements have {count} "
            f"combinations, more than the limit of {at_most}",
            ("shift_elements",),
        )


def _tried(case: Transmission) -> Iterator[tuple[int, ...]]:
    """Yield the sets of shift elements, by number, that no gear engages."""
    numbers = [n for n, element in enumerate(case.shift_elements, 1) if not element.is_freewheel]
    used = {frozenset(gear.joining) for gear in case.gears if is_plain(case, gear)}
    most = needed(case)
    for size in _sizes(case):
        for chosen in subsets(numbers, size):
            if frozenset(chosen) not in used and size <= most + len(case.bypassed(Gear(chosen))):
                yield chosen


def is_plain(case: Transmission, gear: Gear) -> bool:
    """Return whether a gear has input and output of the case, and no prescribed speeds or slips.

    >>> from vstatics.core.model.transmission import Mechanism
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, -2.5)], [Gear(), Gear(input=2, output=1)])
    >>> [is_plain(case, gear) for gear in case.gears]
    [True, False]
    """
    ports = case.gear_input(gear), case.gear_output(gear)
    return ports == (case.input, case.output) and not gear.speeds and not gear.slipping


def shared(by_gear: Sequence[Mapping[Key, float]]) -> dict[Key, float]:
    """Return the entries that all mappings have in common.

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
