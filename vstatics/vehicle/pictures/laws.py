"""Laws of gear steps; a step is the quotient of successive ratios of a gearbox."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import accumulate, pairwise
from typing import NamedTuple


class StepLaw(NamedTuple):
    """Ratios of gears whose steps follow a law."""

    ratios: Sequence[float]
    growth: float
    """Quotient of each step and the next; 1 for equal steps. [-]"""

    @property
    def steps(self) -> list[float]:
        """Ratios, each divided by the next [-]."""
        return [ratio / following for ratio, following in pairwise(self.ratios)]


def geometric(ratios: Sequence[float]) -> StepLaw:
    """Return ratios with equal steps, between the first and the last ratio.

    >>> [round(ratio, 9) for ratio in geometric([4.0, 3.0, 1.0]).ratios]
    [4.0, 2.0, 1.0]
    """
    return _law(ratios, 0.0)


def progressive(ratios: Sequence[float]) -> StepLaw:
    """Return ratios whose steps have a constant quotient, fitted to `ratios`.

    The logarithms of the steps change linearly, with a slope fitted by least squares. The first and
    last of `ratios` remain.

    >>> law = progressive([6.0, 2.0, 1.0])
    >>> [round(ratio, 9) for ratio in law.ratios], round(law.growth, 9)
    ([6.0, 2.0, 1.0], 1.5)
    """
    logs = [math.log(ratio / following) for ratio, following in pairwise(ratios)]
    places = [place - (len(logs) - 1) / 2 for place in range(len(logs))]
    squares = sum(place**2 for place in places)
    slope = sum(place * log for place, log in zip(places, logs, strict=True)) / (squares or 1.0)
    return _law(ratios, slope)


def _law(ratios: Sequence[float], slope: float) -> StepLaw:
    """Return ratios whose logarithm of the step increases by `slope` from step to step."""
    count = len(ratios) - 1
    mean = math.log(ratios[0] / ratios[-1]) / count
    logs = [mean + slope * (place - (count - 1) / 2) for place in range(count)]
    law_ratios = [ratios[0], *(ratios[0] / math.exp(log) for log in accumulate(logs[:-1]))]
    return StepLaw([*law_ratios, ratios[-1]], math.exp(-slope))
