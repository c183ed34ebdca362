"""Laws of steps that the ratios of a box are compared with; the first and the last are its own."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import accumulate, pairwise
from typing import NamedTuple


class StepLaw(NamedTuple):
    """Ratios by a law."""

    ratios: Sequence[float]
    growth: float
    """Each step over the next one; 1 of equal steps. [-]"""

    @property
    def steps(self) -> list[float]:
        """Each ratio over the next one [-]."""
        return [one / other for one, other in pairwise(self.ratios)]


def geometric(ratios: Sequence[float]) -> StepLaw:
    """Equal steps.

    >>> [round(one, 9) for one in geometric([4.0, 3.0, 1.0]).ratios]
    [4.0, 2.0, 1.0]
    """
    return _law(ratios, 0.0)


def progressive(ratios: Sequence[float]) -> StepLaw:
    """Steps of which each is the next one times a factor, which fits the ratios best.

    The logarithms of the steps lie on a straight line: of all with the sum that the first
    and the last ratio give that with the least squares.

    >>> made = progressive([6.0, 2.0, 1.0])
    >>> [round(one, 9) for one in made.ratios], round(made.growth, 9)
    ([6.0, 2.0, 1.0], 1.5)
    """
    logs = [math.log(one / other) for one, other in pairwise(ratios)]
    places = [place - (len(logs) - 1) / 2 for place in range(len(logs))]
    squares = sum(place**2 for place in places)
    slope = sum(place * log for place, log in zip(places, logs, strict=True)) / (squares or 1.0)
    return _law(ratios, slope)


def _law(ratios: Sequence[float], slope: float) -> StepLaw:
    """Ratios whose steps have logarithms of a slope."""
    count = len(ratios) - 1
    mean = math.log(ratios[0] / ratios[-1]) / count
    logs = [mean + slope * (place - (count - 1) / 2) for place in range(count)]
    made = [ratios[0], *(ratios[0] / math.exp(log) for log in accumulate(logs[:-1]))]
    return StepLaw([*made, ratios[-1]], math.exp(-slope))
