"""Between which numbers the ratios of mechanisms are looked for."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from vstatics.errors import CaseError, Problem, listed, nearest, quoted, spoken, typed_number
from vstatics.explain.bodies import OwnLinks
from vstatics.model.transmission import HOUSING
from vstatics.synthesis.tolerances import PART_FOR_ZERO_BOUND

LARGEST_SET_RATIO = 14.0
"""The ratio of a planetary set with three planets is below 13.93, as they must not touch."""
SMALLEST, LARGEST = 1e-9, 1e9
"""No bound is smaller or larger: products of ratios are to be numbers."""
ALL = "all"
"""Stands for all mechanisms that are not named themselves."""


class Bounds(NamedTuple):
    """Least and largest ratio of each mechanism [-]."""

    low: Sequence[float]
    high: Sequence[float]

    def is_fixed(self, index: int) -> bool:
        """Whether a ratio is given."""
        return self.low[index] == self.high[index]


def bounds_of(own: OwnLinks, given: Mapping[str, tuple[float, float]]) -> Bounds:
    """The bounds of all mechanisms: as they are given, else as suit the case.

    Parameters
    ----------
    own : OwnLinks
    given : mapping of str to (float, float)
        By the name of a mechanism; `all` for those that are not named. [-]

    Raises
    ------
    CaseError
        If there is no such mechanism, or no ratio is within the bounds.

    Examples
    --------
    >>> from vstatics.explain.bodies import on_own_links
    >>> from vstatics.model.transmission import Gear, Mechanism, Transmission
    >>> mechanisms = [Mechanism(1, 2, 3, -2.5), Mechanism(1, 2, 0, 0.8)]
    >>> own = on_own_links(Transmission(3, [], mechanisms, [Gear()]))
    >>> bounds_of(own, {})
    Bounds(low=(-14.0, 0.07142857142857142), high=(-1.0, 14.0))
    >>> bounds_of(own, {"D1": (-4, -1.5)}).low
    (-4.0, 0.07142857142857142)
    """
    names = [mechanism.name for mechanism in own.case.mechanisms]
    problems: list[Problem] = []
    found = [usual(own, index) for index in range(len(names))]
    by_index: dict[int, tuple[float, float]] = {}
    for name, pair in given.items():
        path = ("bounds", name)
        problems += (Problem(f"{name}: {text}", path) for text in _wrong(*pair))
        try:
            index = None if name == ALL and ALL not in names else mechanism_index(own, name)
        except ValueError as error:
            problems.append(Problem(str(error), path))
            continue
        if index is None:
            free = [n for n in range(len(names)) if not own.is_fixed(n)]
            by_index |= {n: pair for n in free if n not in by_index}
        elif index in by_index and ALL not in given:
            problems.append(Problem(f"{names[index]} is given twice", path))
        else:
            by_index[index] = pair
    if problems:
        raise CaseError(problems)
    for index, pair in by_index.items():
        found[index] = _without_zero(*map(float, pair))
    return Bounds(tuple(low for low, _ in found), tuple(high for _, high in found))


def usual(own: OwnLinks, index: int) -> tuple[float, float]:
    """The bounds of a mechanism for which none are given.

    Its ratio keeps its sign, and between moving links stays above or below 1; what is no matter
    of teeth stays as it is.
    """
    mechanism = own.case.mechanisms[index]
    size = abs(mechanism.ratio)
    if own.is_fixed(index):
        return mechanism.ratio, mechanism.ratio
    widest = max(LARGEST_SET_RATIO, 2 * size, 2 / size)
    least, most = 1 / widest, widest
    if mechanism.third != HOUSING and size != 1:
        least, most = (1.0, widest) if size > 1 else (1 / widest, 1.0)
    return (least, most) if mechanism.ratio > 0 else (-most, -least)


def mechanism_index(own: OwnLinks, asked: str) -> int:
    """The index of the mechanism of a name, or else of a number from 1.

    Raises
    ------
    ValueError
        If there is none, or an element that is called has several; it tells which.
    """
    names = [mechanism.name for mechanism in own.case.mechanisms]
    if asked in names:
        return names.index(asked)
    of_element = [
        lowered.mechanism.name
        for part in own.parts
        if part.name == asked
        for lowered in part.lowered
    ]
    if of_element:
        message = f"{quoted(asked)} has several ratios: expected {spoken(of_element, 'or')}"
        raise ValueError(message)
    number = typed_number(asked, len(names))
    if number is not None:
        return number - 1
    hint = nearest(asked, names) or f"; mechanisms are {listed(names, 12)}"
    raise ValueError(f"no mechanism {quoted(asked)}{hint}")


def _wrong(low: float, high: float) -> Iterator[str]:
    """What is wrong with bounds."""
    if not (math.isfinite(low) and math.isfinite(high)):
        yield f"read {low:g}:{high:g}, expected finite numbers"
    elif low > high:
        hint = f"did you mean {high:g}:{low:g}?"
        yield f"read {low:g}:{high:g}, expected the lower bound first; {hint}"
    elif low == high == 0:
        yield "read 0:0, expected a ratio other than 0"
    elif any(one and not SMALLEST <= abs(one) <= LARGEST for one in (low, high)):
        yield f"read {low:g}:{high:g}, expected sizes from {SMALLEST:g} to {LARGEST:g}"


def _without_zero(low: float, high: float) -> tuple[float, float]:
    if low == 0:
        return PART_FOR_ZERO_BOUND * high, high
    return (low, PART_FOR_ZERO_BOUND * low) if high == 0 else (low, high)
