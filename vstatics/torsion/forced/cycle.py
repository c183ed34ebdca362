"""Sum of several orders: largest value over a cycle, and root mean square."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Complex, Floats
from vstatics.torsion.tolerances import SAME_ORDER

MOST_REVOLUTIONS = 720
"""Longest cycle that is evaluated, in revolutions; for a longer cycle, amplitudes are added."""
POINTS_PER_PERIOD = 32
"""Number of points per period of the highest order, evaluated before Newton's method."""
MOST_POINTS = 1_000_000
"""Largest number of points to evaluate; for more points, amplitudes are added."""


class Sum(NamedTuple):
    """Sum of all orders at each speed."""

    largest: Floats
    """Largest magnitude over a cycle; the last axis is the speed."""
    rms: Floats
    """Root mean square over a cycle; the last axis is the speed."""


def summed(orders: Sequence[float], amplitudes: Sequence[Complex]) -> Sum:
    """Sum harmonics ``Re(a exp(i order angle))`` over the angle of the excited link.

    Parameters
    ----------
    orders : sequence of float
    amplitudes : sequence of ndarray, shape (..., speeds)
        Complex amplitudes a of each order.

    Examples
    --------
    The sum ``cos x + cos 2x`` is at most 2, and its mean square is 1.

    >>> amplitude = np.ones(1, complex)
    >>> largest, rms = summed([1.0, 2.0], [amplitude, amplitude])
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
    known = np.isfinite(stacked).all(axis=0)
    largest = np.full(known.shape, np.nan)
    largest[known] = _largest(1j * np.asarray(orders), stacked[:, known], angles)
    return Sum(largest, rms)


def _cycle(orders: Sequence[float]) -> float | None:
    """Return the number of revolutions after which all orders repeat, None if it is too large."""
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


def _largest(turning: Complex, amplitudes: Complex, angles: Floats) -> Floats:
    """Return the largest magnitude of the sum over a cycle, for each column of amplitudes."""
    waves = np.exp(turning[:, None] * angles)
    highest = np.empty(amplitudes.shape[1])
    angle = np.empty((amplitudes.shape[1], 4))
    for number, column in enumerate(amplitudes.T):
        values = np.abs((column[:, None] * waves).sum(axis=0).real)
        highest[number], angle[number] = values.max(), angles[np.argsort(values)[-4:]]
    amplitudes, turning = amplitudes[:, :, None], turning[:, None, None]
    for _ in range(8):  # Newton's method starts at the four largest values of each column
        terms = amplitudes * np.exp(turning * angle)
        slope = (turning * terms).sum(axis=0).real
        bend = (turning**2 * terms).sum(axis=0).real
        step = np.where(bend != 0, -slope / np.where(bend, bend, 1.0), 0.0)
        angle += np.clip(step, -angles[1], angles[1])
    tops = np.abs((amplitudes * np.exp(turning * angle)).sum(axis=0).real)
    largest: Floats = np.maximum(highest, tops.max(axis=1))
    return largest
