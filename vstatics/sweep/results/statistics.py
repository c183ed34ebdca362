"""What many variants have in common: means, deviations and quantiles of their columns."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.tolerances import ROUNDED_DEVIATION
from vstatics.core.tables.answer import json_keys

PARTS = (0.05, 0.5, 0.95)
"""Of all variants that lie below a quantile."""

_LARGE = 2.0**500
"""Size above which numbers are divided by a power of 2, so exactly, before they are squared."""


@json_keys("variants", "mean", "deviation", "least", quantiles="by_part", largest="largest")
class Statistics(NamedTuple):
    """Of a column, over the variants in which it exists; NaN if there are too few of them."""

    variants: int
    mean: float
    deviation: float
    """Standard deviation, as of a sample: with one variant less in the denominator."""
    least: float
    quantiles: tuple[float, ...]
    """By `PARTS`."""
    largest: float

    @property
    def by_part(self) -> dict[str, float]:
        """The quantiles, by the parts in per cent."""
        return {f"{part:.0%}": one for part, one in zip(PARTS, self.quantiles, strict=True)}


def statistics(numbers: Floats) -> Statistics:
    """The statistics of numbers, of which NaN are none.

    Examples
    --------
    >>> found = statistics(np.array([1.0, 2.0, 3.0, np.nan]))
    >>> found.variants, found.mean, found.deviation, found.quantiles[1]
    (3, 2.0, 1.0, 2.0)

    Last digits are no deviation:

    >>> statistics(np.array([2500.000000000005, 2500.0])).deviation
    0.0
    """
    known = numbers[~np.isnan(numbers)]
    if not len(known):
        nothing = float("nan")
        return Statistics(0, nothing, nothing, nothing, (nothing,) * len(PARTS), nothing)
    least, largest, most = float(known.min()), float(known.max()), float(np.abs(known).max())
    is_large = _LARGE < most < math.inf  # sums and squares would overflow
    scale = math.ldexp(0.5, math.frexp(most)[1]) if is_large else 1.0
    with np.errstate(invalid="ignore"):  # of infinite numbers
        known = known / scale
        deviation = float(np.std(known, ddof=1)) * scale if len(known) > 1 else float("nan")
        mean = float(known.mean()) * scale
        quantiles = tuple(part * scale for part in np.quantile(known, PARTS).tolist())
    if deviation <= ROUNDED_DEVIATION * most:
        deviation = 0.0
    return Statistics(len(known), mean, deviation, least, quantiles, largest)
