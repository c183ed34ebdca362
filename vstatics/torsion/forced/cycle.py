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
    derivatives = turning ** np.arange(3)[:, None]
    largest = np.empty(amplitudes.shape[1])
    for number, column in enumerate(amplitudes.T):
        values, slopes, bends = (derivatives * column @ waves).real
        steps = _steps(slopes, bends, angles[1])
        tops = np.abs(values + steps * (slopes + bends * steps / 2))
        angle = angles[np.argsort(tops)[-8:]]
        for _ in range(3):  # Newton's method starts at the eight highest tops of parabolas
            terms = derivatives * column @ np.exp(turning[:, None] * angle)
            angle += _steps(terms[1].real, terms[2].real, angles[1])
        tops = np.abs((column @ np.exp(turning[:, None] * angle)).real)
        largest[number] = max(np.abs(values).max(), tops.max())
    return largest


def _steps(slopes: Floats, bends: Floats, spacing: float) -> Floats:
    """Return Newton steps to extremes, up to half the spacing of the points."""
    return np.clip(-slopes / np.where(bends, bends, 1.0), -spacing / 2, spacing / 2)
