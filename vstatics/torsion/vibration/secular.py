"""Natural frequencies as a function of the stiffness of a component, for many stiffnesses at once.

Without the component, a system has modes of frequency ``omega_j`` and modal mass 1, in which the
component has the twists ``b_j``. The squared frequencies x of the system with a component of
stiffness c are the roots of

    1/c = sum_j b_j^2/(x - omega_j^2)

(the secular equation of a modification of rank one: Golub, Some modified matrix eigenvalue
problems, 1973, section 5). Between two neighbouring squares ``omega_j^2`` (poles) there is exactly
one root, which increases with c. Each mode thus requires an equation in a single unknown, with the
same poles in all variants.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.torsion.tolerances import AT_NEXT_POLE, AT_POLE, LAST_STEP, LOST_WEIGHT, SAME_SQUARE

MOST_ITERATIONS = 60
"""Largest number of iterations; each at least halves the interval, or converges quadratically."""


class Poles(NamedTuple):
    """Modes of a system without a component.

    Attributes
    ----------
    squares : ndarray, shape (modes,)
        Squares of the frequencies without the component, ascending; 0 for a motion that only the
        component resists. [rad^2/s^2]
    weights : ndarray, shape (modes,)
        Squares of the twists of the component in modes of modal mass 1. [1/(kg*m^2)]
    """

    squares: Floats
    weights: Floats


def squares_with_device(poles: Poles, compliances: Floats, mode: int) -> Floats:
    """Return the square of a natural frequency of the system with the component.

    Parameters
    ----------
    poles : Poles
        Modes without the component.
    compliances : ndarray, shape (variants,)
        Compliances of the component, above 0. [rad/(N*m)]
    mode : int
        Number of the mode, from 0.

    Returns
    -------
    ndarray, shape (variants,)
        Squares of the angular frequency. [rad^2/s^2]

    Examples
    --------
    A mass of 1 on a spring of 1, a free mass of 1, and a shaft of 1.5 or 4 between the two:
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
            distances = _between(below, above, compliances, pole)
        else:
            distances = _beyond(below, compliances, pole)
    return pole + distances


_Terms = tuple[Floats, Floats]
"""Distances of poles from the pole below the root, and the weights of these poles."""


def _beyond(below: _Terms, compliances: Floats, pole: float) -> Floats:
    """Return the distances of the last root from the last pole, by Newton's method.

    The unknown is the inverse distance. The sum is concave in it, and the first guess is beyond the
    root, so every step approaches the root from the same side.
    """
    x: Floats = below[1].sum() / compliances
    for _ in range(MOST_ITERATIONS):
        value, slope = _sums(below, x)
        improved = slope * x**2 / (compliances - value + slope * x)
        done = np.abs(improved - x) <= LAST_STEP * (pole + x)
        x = improved
        if np.all(done):
            break
    return x


def _between(below: _Terms, above: _Terms, compliances: Floats, pole: float) -> Floats:
    """Return the distances of roots from the pole below, for roots between two poles.

    Each step replaces the poles on either side by a single pole at the end of the interval, with
    the same value and derivative (Bunch, Nielsen, Sorensen, Rank-one modification of the symmetric
    eigenproblem, 1978). Bounds always enclose the root.
    """
    gap = float(above[0][0])
    middle = np.array([gap / 2])
    of_lower_poles, _ = _sums((below[0][:-1], below[1][:-1]), middle)
    of_higher_poles, _ = _sums((above[0][1:], above[1][1:]), -middle)
    level = of_lower_poles - of_higher_poles - compliances
    x = _of_two_poles(level, below[1][-1], above[1][0], gap)
    low, high = np.full_like(x, gap * AT_POLE), np.full_like(x, gap)
    x = np.clip(x, gap * AT_POLE, gap * (1 - AT_NEXT_POLE))
    for _ in range(MOST_ITERATIONS):
        value, slope = _sums(below, x)
        value_above, slope_above = _sums(above, -x)
        left = gap - x
        too_low = value - value_above > compliances
        low, high = np.where(too_low, x, low), np.where(too_low, high, x)
        level = (value - slope * x) - (value_above - slope_above * left) - compliances
        improved = _of_two_poles(level, slope * x**2, slope_above * left**2, gap)
        done = np.abs(improved - x) <= LAST_STEP * (pole + x)
        if np.all(done):
            break
        inside = (improved > low) & (improved < high)
        x = np.where(done, x, np.where(inside, improved, np.sqrt(low) * np.sqrt(high)))
    return x


def _sums(terms: _Terms, x: Floats) -> tuple[Floats, Floats]:
    """Return ``sum_j w_j/(x + d_j)`` and the magnitude of the derivative."""
    value, slope = np.zeros_like(x), np.zeros_like(x)
    for distance, weight in zip(*terms, strict=True):
        inverse = 1 / (x + distance)
        term = weight * inverse
        value += term
        term *= inverse
        slope += term
    return value, slope


def _of_two_poles(
    level: Floats, first: Floats | float, second: Floats | float, gap: float
) -> Floats:
    """Return the root of ``level + first/x - second/(gap - x) = 0`` between 0 and the gap."""
    of_gap = level * gap
    b = of_gap - first - second
    root = np.sqrt((of_gap + first - second) ** 2 + 4 * first * second)
    small = 2 * first * gap / (root - b)
    return np.where(b < 0, small, (b + root) / (2 * level))
