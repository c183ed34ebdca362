"""Natural frequencies by the stiffness of one device, for many stiffnesses at once.

In the modes that a system has without a device, ``omega_j`` of modal mass 1 with the twists
``b_j`` of the device, its frequencies with the device are the roots x of

    1/c = sum_j b_j^2/(x - omega_j^2)

(the secular equation of a change of rank one: Golub, Some modified matrix eigenvalue problems,
1973, section 5). Between two squares ``omega_j^2`` there is exactly one root, and it grows with
the stiffness c. So each mode is one equation for one unknown, whose poles are the same for all
variants.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.torsion.tolerances import AT_NEXT_POLE, AT_POLE, LAST_STEP, LOST_WEIGHT, SAME_SQUARE

MOST_ITERATIONS = 60
"""Iterations; each gains more digits than the last, or halves the interval."""


class Poles(NamedTuple):
    """A system without a device.

    Attributes
    ----------
    squares : ndarray, shape (modes,)
        Squares of its frequencies, ascending, 0 for a motion that the device alone resists.
        [rad^2/s^2]
    weights : ndarray, shape (modes,)
        Squares of the device's twist in its modes of modal mass 1. [1/(kg*m^2)]
    """

    squares: Floats
    weights: Floats


def squares_with_device(poles: Poles, compliances: Floats, mode: int) -> Floats:
    """The square of a natural frequency of the system with the device.

    Parameters
    ----------
    poles : Poles
    compliances : ndarray, shape (variants,)
        Of the device, above 0. [rad/(N*m)]
    mode : int
        From 0.

    Returns
    -------
    ndarray, shape (variants,)
        [rad^2/s^2]

    Examples
    --------
    A mass of 1 on a spring of 1, and a second one beside it; a shaft of 1.5, 4 between the two:
    ``x^2 - (1 + 2 c) x + c = 0``.

    >>> poles = Poles(np.array([0.0, 1.0]), np.array([1.0, 1.0]))
    >>> squares_with_device(poles, np.array([1/1.5, 1/4]), 0).round(9)
    array([0.41886117, 0.46887113])
    """
    pole, total = float(poles.squares[mode]), float(poles.weights.sum())
    if total == 0:
        return np.full(len(compliances), pole)
    weights = np.maximum(poles.weights, LOST_WEIGHT * total)
    below = pole - poles.squares[: mode + 1], weights[: mode + 1]
    above = poles.squares[mode + 1 :] - pole, weights[mode + 1 :]
    if len(above[0]) and above[0][0] <= SAME_SQUARE * pole:
        return np.full(len(compliances), pole)
    with np.errstate(all="ignore"):
        if len(above[0]):
            further = _between(below, above, compliances, pole)
        else:
            further = _beyond(below, compliances, pole)
    squares: Floats = pole + further
    return squares


_Terms = tuple[Floats, Floats]
"""Distances of poles from that below the root, and their weights."""


def _beyond(below: _Terms, compliances: Floats, pole: float) -> Floats:
    """How far the last root is above the last pole: by Newton's method for its inverse.

    The sum is concave in the inverse and the first guess is beyond the root, so that every
    step is towards it and none too long.
    """
    x: Floats = below[1].sum() / compliances
    for _ in range(MOST_ITERATIONS):
        value, slope = _sums(below, x)
        found = slope * x**2 / (compliances - value + slope * x)
        done = np.abs(found - x) <= LAST_STEP * (pole + x)
        x = found
        if np.all(done):
            break
    return x


def _between(below: _Terms, above: _Terms, compliances: Floats, pole: float) -> Floats:
    """How far the roots are above a pole that has others above it.

    Each step replaces the poles on either side by one at the end of the interval, with the
    same value and slope (Bunch, Nielsen, Sorensen, Rank-one modification of the symmetric
    eigenproblem, 1978), and stays within bounds that enclose the root.
    """
    gap = float(above[0][0])
    middle = np.array([gap / 2])
    rest = _value(below[0][:-1], below[1][:-1], middle)
    rest = rest - _value(above[0][1:], above[1][1:], -middle)
    x = _of_two_poles(rest - compliances, below[1][-1], above[1][0], gap)
    low, high = np.full_like(x, gap * AT_POLE), np.full_like(x, gap)
    x = np.clip(x, gap * AT_POLE, gap * (1 - AT_NEXT_POLE))
    for _ in range(MOST_ITERATIONS):
        value, slope = _sums(below, x)
        against, its_slope = _sums(above, -x)
        left = gap - x
        too_low = value - against > compliances
        low, high = np.where(too_low, x, low), np.where(too_low, high, x)
        level = (value - slope * x) - (against - its_slope * left) - compliances
        found = _of_two_poles(level, slope * x**2, its_slope * left**2, gap)
        done = np.abs(found - x) <= LAST_STEP * (pole + x)
        if np.all(done):
            break
        inside = (found > low) & (found < high)
        x = np.where(done, x, np.where(inside, found, np.sqrt(low) * np.sqrt(high)))
    return x


def _sums(terms: _Terms, x: Floats) -> tuple[Floats, Floats]:
    """``sum_j w_j/(x + d_j)``, and its slope without the sign."""
    value, slope = np.zeros_like(x), np.zeros_like(x)
    for distance, weight in zip(*terms, strict=True):
        inverse = 1 / (x + distance)
        term = weight * inverse
        value += term
        term *= inverse
        slope += term
    return value, slope


def _value(distances: Floats, weights: Floats, x: Floats) -> Floats:
    return _sums((distances, weights), x)[0]


def _of_two_poles(
    level: Floats, first: Floats | float, second: Floats | float, gap: float
) -> Floats:
    """The root of ``level + first/x - second/(gap - x) = 0`` between 0 and the gap."""
    of_gap = level * gap
    b = of_gap - first - second
    root = np.sqrt((of_gap + first - second) ** 2 + 4 * first * second)
    small: Floats = 2 * first * gap / (root - b)
    return np.where(b < 0, small, (b + root) / (2 * level))
