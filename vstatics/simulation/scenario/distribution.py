"""Probability distributions of random numbers in a scenario."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import Path, Problem
from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.tolerances import LEAST_PROBABILITY


class Distribution(NamedTuple):
    """Normal, lognormal or uniform distribution of a number.

    Parameters
    ----------
    normal : (float, float), optional
        Mean and standard deviation.
    lognormal : (float, float), optional
        Mean and standard deviation of the natural logarithm.
    uniform : (float, float), optional
        Smallest and largest number.
    min, max : float, optional
        Limits to which numbers are clipped, such as the governed speed of an engine.
    """

    normal: tuple[float, float] | None = None
    lognormal: tuple[float, float] | None = None
    uniform: tuple[float, float] | None = None
    min: float | None = None
    max: float | None = None

    def quantiles(self, parts: Floats) -> Floats:
        """Return the quantiles of the distribution.

        Parameters
        ----------
        parts : ndarray
            Probabilities, from 0 to 1.

        Examples
        --------
        >>> Distribution(normal=(262.0, 6.0), max=270.0).quantiles(np.array([0.5, 0.999]))
        array([262., 270.])
        >>> Distribution(uniform=(1.0, 3.0)).quantiles(np.array([0.25]))
        array([1.5])
        """
        if self.uniform is not None:
            first, last = self.uniform
            numbers = (1 - parts) * first + parts * last
        else:
            from scipy.special import ndtri

            mean, deviation = self.normal or self.lognormal or (0.0, 0.0)
            numbers = mean + deviation * ndtri(
                np.clip(parts, LEAST_PROBABILITY, 1 - LEAST_PROBABILITY)
            )
            numbers = np.exp(numbers) if self.normal is None else numbers
        least = -np.inf if self.min is None else self.min
        return np.clip(numbers, least, np.inf if self.max is None else self.max)


def distribution_problems(distribution: Distribution, path: Path) -> Iterator[Problem]:
    """Yield the problems of a distribution.

    Examples
    --------
    >>> print(*distribution_problems(Distribution(normal=(0.7, -0.1)), ()))
    normal: read -0.1, expected a standard deviation of 0 or more [E655]
    """
    least = -math.inf if distribution.min is None else distribution.min
    largest = math.inf if distribution.max is None else distribution.max
    for key in ("normal", "lognormal"):
        given = getattr(distribution, key)
        if given is not None and given[1] < 0:
            yield Problem(
                "E655",
                f"read {given[1]:g}, expected a standard deviation of 0 or more",
                (*path, key),
            )
    if distribution.normal is not None and distribution.normal[1] >= 0:
        mean = distribution.normal[0]
        if not least <= mean <= largest:
            yield Problem(
                "E656",
                f"read a mean of {mean:g}, expected a mean from min to max",
                (*path, "normal"),
            )
    if distribution.uniform is not None:
        first, last = distribution.uniform
        if first > last:
            yield Problem(
                "E657",
                f"read {first:g} to {last:g}, expected the smaller number first",
                (*path, "uniform"),
            )
        elif first > largest or last < least:
            yield Problem(
                "E658",
                f"read {first:g} to {last:g}, expected a part of it from min to max",
                (*path, "uniform"),
            )
    if least > largest:
        yield Problem(
            "E659", f"read {largest:g}, expected at least {least:g}, its min", (*path, "max")
        )
