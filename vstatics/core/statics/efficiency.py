"""Efficiency of a mechanism for each direction of power, and its ratio with losses.

With losses the internal ratio u of a mechanism becomes ``u * efficiency**x`` in the
torque system; x is +1 where power enters by the first link, seen from the third, and
-1 where it leaves by it (equation (5) of docs/method.md). Some mechanisms, worm gears
say, have another efficiency for x = -1. The speed ratio of a variator, which is that of the
second link to the first, is divided by what the ratio of a mechanism is multiplied with.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.traced import Number, chosen, is_nan

Signs = tuple[Number, ...]
"""By mechanism: the exponent x of its efficiency, +1, -1 or 0; NaN where it is open."""


class Efficiency(NamedTuple):
    """The efficiency of a mechanism for each direction of power."""

    forward: Number
    """From the first link to the second."""
    back: Number
    """0: power can't flow back."""
    divides: bool = False
    """Whether losses divide the ratio, as of a variator."""

    @property
    def lossless(self) -> bool:
        """Whether the direction does not matter."""
        return bool(self.forward == 1 and self.back == 1)

    @property
    def lossy(self) -> bool:
        """Whether there are losses in one of the directions."""
        return bool(self.forward < 1 or self.back < 1)


def efficiencies_by_direction(
    case: Transmission, efficiencies: Sequence[Number | Efficiency] | None = None
) -> list[Efficiency]:
    """The efficiencies of the mechanisms, where a case may give others for the way back.

    Parameters
    ----------
    efficiencies : sequence of Number or Efficiency, optional
        Forward, or of both directions; the case's own when not given. [-]
    """
    if efficiencies is None:
        efficiencies = [mechanism.efficiency for mechanism in case.mechanisms]
    return [
        forward._replace(divides=one.kind == "variator")
        if isinstance(forward, Efficiency)
        else Efficiency(
            forward,
            forward if one.back_efficiency is None else one.back_efficiency,
            one.kind == "variator",
        )
        for forward, one in zip(efficiencies, case.mechanisms, strict=True)
    ]


def lossy_ratio(ratio: Number, efficiency: Efficiency, exponent: Number) -> Number:
    """``u * efficiency**x``; NaN where power can't flow back, or x is open.

    >>> [lossy_ratio(-2.0, Efficiency(0.5, 0.25), x) for x in (1.0, -1.0)]
    [-1.0, -8.0]
    """
    if exponent == 0:
        return ratio
    if is_nan(exponent):
        return ratio if efficiency.lossless else math.nan
    if efficiency.divides:
        return ratio / passed(efficiency, exponent)
    forward = ratio if efficiency.forward == 1 else ratio * efficiency.forward
    if efficiency.back == 0:
        return forward if exponent > 0 else math.nan
    back = ratio if efficiency.back == 1 else ratio / efficiency.back
    return chosen(exponent > 0, forward, back)


def passed(efficiency: Efficiency, exponent: Number) -> Number:
    """``efficiency**x``; a whole 1 keeps fractions exact."""
    own = efficiency._replace(divides=False) if efficiency.divides else efficiency
    return lossy_ratio(1, own, exponent)


def lossy_ratios(
    ratios: Sequence[Number], efficiencies: Sequence[Efficiency], signs: Sequence[Number]
) -> list[Number]:
    """The ratios of all mechanisms with losses under given signs; see `lossy_ratio`."""
    return list(map(lossy_ratio, ratios, efficiencies, signs))


def is_possible(efficiencies: Sequence[Efficiency], signs: Signs) -> bool:
    """Whether power flows back through no mechanism that is self-locking."""
    return not any(
        efficiency.back == 0 and x < 0 for x, efficiency in zip(signs, efficiencies, strict=True)
    )
