"""From what a number of a scenario is drawn."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from vstatics.errors import Path, Problem


class Distribution(NamedTuple):
    """A normal distribution by mean and standard deviation, or a uniform one between two numbers.

    Numbers below `min` or above `max` are drawn again.
    """

    normal: tuple[float, float] | None = None
    uniform: tuple[float, float] | None = None
    min: float | None = None
    max: float | None = None


def distribution_problems(one: Distribution, path: Path) -> Iterator[Problem]:
    """What is wrong with a distribution.

    Examples
    --------
    >>> print(*distribution_problems(Distribution(normal=(0.7, -0.1)), ()))
    normal: read -0.1, expected a standard deviation of 0 or more
    """
    least = -math.inf if one.min is None else one.min
    largest = math.inf if one.max is None else one.max
    if one.normal is not None:
        mean, deviation = one.normal
        if deviation < 0:
            message = f"read {deviation:g}, expected a standard deviation of 0 or more"
            yield Problem(message, (*path, "normal"))
        elif not least <= mean <= largest:
            yield Problem(
                f"read a mean of {mean:g}, expected one from min to max", (*path, "normal")
            )
    if one.uniform is not None:
        first, last = one.uniform
        if first > last:
            message = f"read {first:g} to {last:g}, expected the least number first"
            yield Problem(message, (*path, "uniform"))
        elif first > largest or last < least:
            message = f"read {first:g} to {last:g}, of which nothing is from min to max"
            yield Problem(message, (*path, "uniform"))
    if least > largest:
        yield Problem(f"read {largest:g}, expected at least min, {least:g}", (*path, "max"))
