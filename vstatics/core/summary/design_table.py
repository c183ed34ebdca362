"""The design table: ratios, steps, spread, efficiencies, and which gears are neighbours."""

from __future__ import annotations

import math
import re
from collections.abc import Hashable, Sequence
from itertools import pairwise
from typing import NamedTuple

from vstatics.core.numerics.tolerances import SAME_RATIO
from vstatics.core.statics.results import Results


class GearLine(NamedTuple):
    """A gear in the design table."""

    gear: str
    ratio: float
    next: str
    """The gear of the same direction with the next smaller ratio, if there is one."""
    step: float
    """Ratio of the gear by that of the next. [-]"""
    efficiency: float
    state: str
    """Why something does not exist; empty for a gear of which all is known."""


class Design(NamedTuple):
    """The design table of a transmission."""

    gears: Sequence[GearLine]
    """In the order of the case."""
    forward: Sequence[str]
    """From the largest ratio to the smallest."""
    spread: float
    """Largest by smallest forward ratio [-]; NaN without gears."""


def design(results: Results) -> Design:
    """Ratios, steps and efficiencies of all gears of one case.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(1, 2), ShiftElement(2)],
    ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([2]), Gear([1])])
    >>> made = design(solve(case))
    >>> made.spread, [line.step for line in made.gears]
    (3.5, [3.5, nan])
    """
    names = [gear.name for gear in results.case.gears]
    ratios = results.ratio.tolist()
    comparable = ranges(results)
    following = {one: other for indices in comparable for one, other in pairwise(indices)}
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


def is_same(one: float, other: float) -> bool:
    """Whether two numbers differ by rounding only.

    >>> is_same(1.0, 1 + 1e-15), is_same(1.0, 1.001), is_same(math.nan, math.nan)
    (True, False, False)
    """
    return math.isclose(one, other, rel_tol=SAME_RATIO)


def ranges(results: Results) -> list[list[int]]:
    """The gears of one case that can be compared, by their indices.

    A range has gears of one input, one output and one direction, from the largest ratio
    to the smallest, both without sign. The first range is taken as forward, as
    `ranges_of` does. Gears without a ratio and operating points are in none.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(1, 2), ShiftElement(2)],
    ...                     [Mechanism(1, 2, 3, -2.5)], [Gear([1]), Gear(), Gear([2])])
    >>> ranges(solve(case))
    [[2, 0]]
    """
    case = results.case
    kinds = [
        (case.gear_input(gear), case.gear_output(gear)) if gear.kind == "gear" else None
        for gear in case.gears
    ]
    return ranges_of(results.ratio.tolist(), kinds, [gear.name for gear in case.gears])


def ranges_of(
    ratios: Sequence[float], kinds: Sequence[Hashable | None], names: Sequence[str]
) -> list[list[int]]:
    """As `ranges`, of ratios that are told by whatever else makes gears comparable.

    The first range is the longest: a final drive may turn the sign of all gears. One whose gears
    all have names of reverse gears is behind others; of several of one length the first has the
    fewest such names, else it is written first.

    >>> ranges_of([-3.3, 1.0, 4.7, math.nan], ["a", "a", "a", "a"], ["R", "2", "1", "N"])
    [[2, 1], [0]]
    >>> ranges_of([-3.3, 4.7], ["a", "a"], ["R", "F"]), ranges_of([-3.3, 4.7], [1, 1], ["", ""])
    ([[1], [0]], [[0], [1]])
    >>> ranges_of([3.3, -4.7], ["a", "a"], ["road 1", "low R"])
    [[0], [1]]
    """
    alike: dict[Hashable, list[int]] = {}
    for index, (ratio, kind) in enumerate(zip(ratios, kinds, strict=True)):
        if math.isfinite(ratio) and kind is not None:
            alike.setdefault((kind, ratio > 0), []).append(index)
    for indices in alike.values():  # those of one ratio stay as they are, whatever rounding says
        indices.sort(key=lambda index: -float(f"{abs(ratios[index]):.9e}"))
    return sorted(alike.values(), key=lambda one: _likeness_of_reverse(one, names))


def is_guess(ranges_: Sequence[Sequence[int]], names: Sequence[str]) -> bool:
    """Whether nothing but the order of gears tells that the first range is forward.

    >>> is_guess([[0, 1], [2, 3]], ["F1", "F2", "R1", "R2"]), is_guess([[0], [1]], ["a", "b"])
    (False, True)
    """
    return len({_likeness_of_reverse(one, names) for one in ranges_[:2]}) < len(ranges_[:2])


def _likeness_of_reverse(indices: Sequence[int], names: Sequence[str]) -> tuple[bool, int, int]:
    named = sum(bool(_REVERSE.match(names[index])) for index in indices)
    return named == len(indices), -len(indices), named


_REVERSE = re.compile(
    r"-|[\W\d_]*(r[\W\d_]|r[a-z]?[\W\d_]*$|rev|rück|з\W*х|задн)"
    r"|.*([\W_]r[\W\d_]*$|revers|rückw|rueckw|backw|задн)",
    re.IGNORECASE,
)
"""Names of reverse gears: -1, R, R1, RL, 1R, low R, low reverse, Rückwärts, ЗХ; not road, range."""
