"""Several orders together: the largest value over a cycle, and the root of the mean square."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from vstatics.numerics.arrays import Complex, Floats
from vstatics.torsion.tolerances import SAME_ORDER

MOST_REVOLUTIONS = 720
"""Revolutions of a cycle; orders that have no such cycle in common meet in every phase."""
POINTS_PER_PERIOD = 32
"""By period of the highest order, from where the largest value is found by Newton's rule."""
MOST_POINTS = 1_000_000
"""Orders that need more, far apart from each other, meet in every phase, too."""


class Sum(NamedTuple):
    """Of one link or device, at each speed: all orders together."""

    largest: Floats
    """Over a cycle."""
    rms: Floats
    """Root of the mean square over a cycle."""


def summed(orders: Sequence[float], amplitudes: Sequence[Complex]) -> Sum:
    """The sum of harmonics ``Re(a exp(i order angle))``.

    Parameters
    ----------
    orders : sequence of float
    amplitudes : sequence of ndarray, shape (speeds,)
        Complex, one of each order.

    Examples
    --------
    ``cos x + cos 2x`` is at most 2, its mean square is 1.

    >>> one = np.ones(1, complex)
    >>> largest, rms = summed([1.0, 2.0], [one, one])
    >>> round(float(largest[0]), 9), float(rms[0])
    (2.0, 1.0)
    """
    stacked = np.array(amplitudes)
    sizes = np.abs(stacked)
    with np.errstate(over="ignore"):
        rms = np.sqrt((sizes**2).sum(axis=0) / 2)
    cycle = _cycle(orders)
    if cycle is None or POINTS_PER_PERIOD * max(orders) * cycle > MOST_POINTS:
        return Sum(sizes.sum(axis=0), rms)
    count = math.ceil(POINTS_PER_PERIOD * max(orders) * cycle)
    angles = 2 * math.pi * cycle * np.arange(count) / count
    turning = 1j * np.asarray(orders)
    largest = np.array([_largest(turning, column, angles) for column in stacked.T])
    return Sum(largest, rms)


def _cycle(orders: Sequence[float]) -> float | None:
    """Revolutions until all orders are as before; None if it takes too long."""
    parts = [Fraction(order).limit_denominator(MOST_REVOLUTIONS) for order in orders]
    if any(
        abs(float(part) - order) > SAME_ORDER * order
        for part, order in zip(parts, orders, strict=True)
    ):
        return None
    least = math.lcm(*(part.denominator for part in parts))
    common = math.gcd(*(int(part * least) for part in parts))
    revolutions = Fraction(least, common)
    return float(revolutions) if revolutions <= MOST_REVOLUTIONS else None


def _largest(turning: Complex, amplitudes: Complex, angles: Floats) -> float:
    """The largest absolute value over a cycle."""
    if not np.isfinite(amplitudes).all():
        return math.nan
    values = np.abs((amplitudes[:, None] * np.exp(turning[:, None] * angles)).sum(axis=0).real)
    best = np.sort(np.argsort(values)[-4:])
    angle = angles[best]
    for _ in range(8):  # to the top of each of the highest points
        terms = amplitudes[:, None] * np.exp(turning[:, None] * angle)
        slope = (turning[:, None] * terms).sum(axis=0).real
        bend = (turning[:, None] ** 2 * terms).sum(axis=0).real
        step = np.where(bend != 0, -slope / np.where(bend, bend, 1.0), 0.0)
        limit = angles[1] if len(angles) > 1 else 0.0
        angle = angle + np.clip(step, -limit, limit)
    tops = np.abs((amplitudes[:, None] * np.exp(turning[:, None] * angle)).sum(axis=0).real)
    return float(max(values.max(), tops.max()))
