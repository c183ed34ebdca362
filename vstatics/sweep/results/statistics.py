"""Statistics of many variants: mean, standard deviation and quantiles of columns."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.tolerances import ROUNDED_DEVIATION
from vstatics.core.tables.answer import json_keys

PARTS = (0.05, 0.5, 0.95)
"""Fractions of the variants with values below each quantile. [-]"""

_LARGE = 2.0**500
"""Magnitude above which numbers are divided by a power of 2, because squares would overflow."""


@json_keys("variants", "mean", "deviation", "least", quantiles="by_part", largest="largest")
class Statistics(NamedTuple):
    """Statistics of a column over variants with a value; NaN if there are too few."""

    variants: int
    mean: float
    deviation: float
    """Standard deviation, with n - 1 in the denominator."""
    least: float
    quantiles: tuple[float, ...]
    """Quantiles at the fractions `PARTS`."""
    largest: float

    @property
    def by_part(self) -> dict[str, float]:
        """Quantiles, by the fraction in %."""
        return {
            f"{part:.0%}": quantile for part, quantile in zip(PARTS, self.quantiles, strict=True)
        }


def statistics(numbers: Floats) -> Statistics:
    """Return the statistics of numbers; NaN is ignored.

    Examples
    --------
    >>> summary = statistics(np.array([1.0, 2.0, 3.0, np.nan]))
    >>> summary.variants, summary.mean, summary.deviation, summary.quantiles[1]
    (3, 2.0, 1.0, 2.0)

    Rounding noise in the last digits gives the standard deviation 0:

    >>> statistics(np.array([2500.000000000005, 2500.0])).deviation
    0.0
    """
    known = numbers[~np.isnan(numbers)]
    if not len(known):
        nothing = float("nan")
        return Statistics(0, nothing, nothing, nothing, (nothing,) * len(PARTS), nothing)
    least, largest, most = float(known.min()), float(known.max()), float(np.abs(known).max())
    is_large = _LARGE < most < math.inf
    scale = math.ldexp(0.5, math.frexp(most)[1]) if is_large else 1.0
    with np.errstate(invalid="ignore"):  # infinite numbers give NaN without a warning
        known = known / scale
        deviation = float(np.std(known, ddof=1)) * scale if len(known) > 1 else float("nan")
        mean = float(known.mean()) * scale
        quantiles = tuple(part * scale for part in np.quantile(known, PARTS).tolist())
    if deviation <= ROUNDED_DEVIATION * most:
        deviation = 0.0
    return Statistics(len(known), mean, deviation, least, quantiles, largest)
