"""Design table of a gearbox: ratios, step ratios, spread and efficiencies.

Gears of the same direction are sorted by descending ratio. A step ratio is the quotient of the
ratios of neighbouring gears. The order of gears in the case does not matter.
"""

from __future__ import annotations

import math
import re
from collections.abc import Hashable, Sequence
from itertools import pairwise
from typing import NamedTuple

from vstatics.core.groups import grouped
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.tolerances import SAME_RATIO
from vstatics.core.statics.results import Results


class GearLine(NamedTuple):
    """Row of a gear in the design table."""

    gear: str
    ratio: float
    next: str
    """Gear of the same direction with the next smaller ratio; empty for the last gear."""
    step: float
    """Step ratio: ratio of the gear divided by the ratio of the next gear. [-]"""
    efficiency: float
    state: str
    """Status that explains missing values; empty if no value is missing."""


class Design(NamedTuple):
    """Design table of a transmission."""

    gears: Sequence[GearLine]
    """Gears in the order of the case."""
    forward: Sequence[str]
    """Names of the forward gears from the largest ratio to the smallest."""
    spread: float
    """Largest forward ratio divided by the smallest [-]; NaN without forward gears."""


def design(results: Results) -> Design:
    """Return ratios, step ratios and efficiencies of all gears of a case.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(1, 2), ShiftElement(2)],
    ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([2]), Gear([1])])
    >>> table = design(solve(case))
    >>> table.spread, [line.step for line in table.gears]
    (3.5, [3.5, nan])
    """
    names = results.gears
    ratios = results.ratio.tolist()
    comparable = ranges(results)
    following = {gear: after for indices in comparable for gear, after in pairwise(indices)}
    lines = [
        GearLine(
            name,
            ratios[index],
            names[following[index]] if index in following else "",
            ratios[index] / ratios[following[index]] if index in following else math.nan,
            float(results.efficiency[index]),
            results.status(index + 1).name,
        )
        for index, name in enumerate(names)
    ]
    forward = comparable[0] if comparable else []
    spread = ratios[forward[0]] / ratios[forward[-1]] if forward else math.nan
    return Design(lines, [names[index] for index in forward], spread)


def is_same(first: float, second: float) -> bool:
    """Return whether two ratios are equal except for rounding.

    >>> is_same(1.0, 1 + 1e-15), is_same(1.0, 1.001), is_same(math.nan, math.nan)
    (True, False, False)
    """
    return math.isclose(first, second, rel_tol=SAME_RATIO)


def ranges(results: Results) -> list[list[int]]:
    """Group the gears of a case by input, output and direction; return lists of indices.

    A group (range) is sorted by the magnitude of the ratio, largest first. The first range is taken
    as forward; see `ranges_of`. Gears without a ratio, and gears of the kind `point`, are omitted.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(1, 2), ShiftElement(2)],
    ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([1]), Gear(), Gear([2])])
    >>> ranges(solve(case))
    [[2, 0]]
    """
    names = [gear.name for gear in results.case.gears]
    return ranges_of(results.ratio.tolist(), ends_of(results.case), names)


def ends_of(case: Transmission) -> list[tuple[int, int] | None]:
    """Return input and output link of each gear; None for a gear of the kind `point`."""
    return [
        (case.gear_input(gear), case.gear_output(gear)) if gear.kind == "gear" else None
        for gear in case.gears
    ]


def ranges_of(
    ratios: Sequence[float], kinds: Sequence[Hashable | None], names: Sequence[str]
) -> list[list[int]]:
    """Group ratios by sign and kind (such as input and output); return lists of indices.

    The first group (range) is taken as forward. It is the longest range, because the sign of ratios
    is not conclusive if a final drive reverses all gears. Ranges with only names of reverse gears
    are last. Of ranges with equal length, the range with the fewest such names is first, then the
    range whose gear is first in the case.

    >>> ranges_of([-3.3, 1.0, 4.7, math.nan], ["a", "a", "a", "a"], ["R", "2", "1", "N"])
    [[2, 1], [0]]
    >>> ranges_of([-3.3, 4.7], ["a", "a"], ["R", "F"]), ranges_of([-3.3, 4.7], [1, 1], ["", ""])
    ([[1], [0]], [[0], [1]])
    >>> ranges_of([3.3, -4.7], ["a", "a"], ["road 1", "low R"])
    [[0], [1]]
    """
    alike = grouped(
        ((kind, ratio > 0), index)
        for index, (ratio, kind) in enumerate(zip(ratios, kinds, strict=True))
        if math.isfinite(ratio) and ratio and kind is not None
    )
    # gears whose ratios are equal except for rounding keep their order
    for indices in alike.values():
        indices.sort(key=lambda index: -float(f"{abs(ratios[index]):.9e}"))
    return sorted(alike.values(), key=lambda indices: _likeness_of_reverse(indices, names))


def is_guess(ranges_: Sequence[Sequence[int]], names: Sequence[str]) -> bool:
    """Return whether the first range is taken as forward only because of the order of gears.

    >>> is_guess([[0, 1], [2, 3]], ["F1", "F2", "R1", "R2"]), is_guess([[0], [1]], ["a", "b"])
    (False, True)
    """
    return len({_likeness_of_reverse(gears, names) for gears in ranges_[:2]}) < len(ranges_[:2])


def _likeness_of_reverse(indices: Sequence[int], names: Sequence[str]) -> tuple[bool, int, int]:
    named = sum(bool(_REVERSE.match(names[index])) for index in indices)
    return named == len(indices), -len(indices), named


_REVERSE = re.compile(
    r"-|[\W\d_]*(r[\W\d_]|r[a-z]?[\W\d_]*$|rev|rück|з\W*х|задн)"
    r"|.*([\W_]r[\W\d_]*$|revers|rückw|rueckw|backw|задн)",
    re.IGNORECASE,
)
"""Pattern of names of reverse gears, such as -1, R, R1, RL, 1R, low R, Rückwärts or ЗХ, but not
road or range.
"""
