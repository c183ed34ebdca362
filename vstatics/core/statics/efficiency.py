"""Efficiency of a mechanism for each direction of power, and the ratio with losses.

With losses the basic ratio u of a mechanism becomes ``u * efficiency**x`` in the torque system.
Seen from the third link, x is +1 if power enters by the first link, and -1 if power leaves by the
first link (equation (5) of docs/method.md). Some mechanisms, such as worm gears, have another
efficiency for x = -1. The speed ratio of a variator is second link to first, so it is divided by
``efficiency**x`` instead.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from vstatics.core.model.transmission import Transmission
from vstatics.core.named_tuple import NamedTuple
from vstatics.core.numerics.traced import Number, chosen, is_nan

Signs = tuple[Number, ...]
"""Exponent x of the efficiency of each mechanism: +1, -1 or 0; NaN if indeterminate."""


class Efficiency(NamedTuple):
    """Efficiency of a mechanism for each direction of power."""

    forward: Number
    """Efficiency of power from the first link to the second. [-]"""
    back: Number
    """Efficiency of power from the second link to the first; 0 for a self-locking mechanism. [-]"""
    divides: bool = False
    """True if losses divide the ratio, as in a variator."""

    @property
    def lossless(self) -> bool:
        """True if power has no losses in either direction."""
        return bool(self.forward == 1 and self.back == 1)

    @property
    def lossy(self) -> bool:
        """True if power has losses in at least one direction."""
        return bool(self.forward < 1 or self.back < 1)


def efficiencies_by_direction(
    case: Transmission, efficiencies: Sequence[Number | Efficiency] | None = None
) -> list[Efficiency]:
    """Return the efficiencies of the mechanisms for both directions of power.

    Parameters
    ----------
    efficiencies : sequence of Number or Efficiency, optional
        For each mechanism, its efficiencies in both directions, or only its forward efficiency. The
        backward efficiency is then the `back_efficiency` of the case or, by default, equal.
        Default: the efficiencies of the case. [-]
    """
    if efficiencies is None:
        efficiencies = [mechanism.efficiency for mechanism in case.mechanisms]
    return [
        forward._replace(divides=mechanism.kind == "variator")
        if isinstance(forward, Efficiency)
        else Efficiency(
            forward,
            forward if mechanism.back_efficiency is None else mechanism.back_efficiency,
            mechanism.kind == "variator",
        )
        for forward, mechanism in zip(efficiencies, case.mechanisms, strict=True)
    ]


def lossy_ratio(ratio: Number, efficiency: Efficiency, exponent: Number) -> Number:
    """Return the ratio with losses [-], with the exponent x of the efficiency.

    NaN if x is NaN in a mechanism with losses, or -1 in a self-locking mechanism.

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
    """Return ``efficiency**x`` for an exponent x [-]; fractions stay exact."""
    multiplying = efficiency._replace(divides=False) if efficiency.divides else efficiency
    return lossy_ratio(1, multiplying, exponent)


def lossy_ratios(
    ratios: Sequence[Number], efficiencies: Sequence[Efficiency], signs: Sequence[Number]
) -> list[Number]:
    """Return the ratio with losses of each mechanism, for assumed signs of the power flow [-]."""
    return list(map(lossy_ratio, ratios, efficiencies, signs))


def is_possible(efficiencies: Sequence[Efficiency], signs: Signs) -> bool:
    """Return whether no self-locking mechanism is back-driven."""
    return not any(
        efficiency.back == 0 and x < 0 for x, efficiency in zip(signs, efficiencies, strict=True)
    )
