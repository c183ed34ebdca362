"""Targets that a gear ratio can reach within the bounds of the gear-set ratios.

The decision is exact, from values at the corners of the bounds. A gear ratio is a quotient of two
polynomials, each linear in every gear-set ratio. Where the denominator has no zero, the quotient is
monotonic along each gear-set ratio, so its extremes are at corners. Such a polynomial has no zero
within the bounds if it has the same sign at all corners.
"""

from __future__ import annotations

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.synthesis.compiled import compiled_part
from vstatics.synthesis.tolerances import INDEPENDENT_RATIO


@compiled_part
def reached(numerator: Floats, denominator: Floats, low: Floats, high: Floats) -> int:
    """Return the targets that a quotient of polynomials reaches within the bounds, as bits.

    Parameters
    ----------
    numerator, denominator : array, shape (corners,)
    low, high : array, shape (targets,)
        Range of quotients that meet each target; both ends have the same sign. [-]

    Examples
    --------
    >>> import numpy as np
    >>> low, high = np.array([1.9, 0.9, -3.1]), np.array([2.1, 1.1, -2.9])
    >>> bin(reached(np.array([1.0, 2.5]), np.array([1.0, 1.0]), low, high))
    '0b11'
    >>> bin(reached(np.array([1.0, 1.0]), np.array([1.0, -1.0]), low, high))  # 1 to inf, -inf to -1
    '0b111'
    """
    if has_one_sign(denominator):
        return _within(numerator, denominator, low, high, 0)
    if has_one_sign(numerator):
        return _within(denominator, numerator, low, high, 1)
    return (1 << len(low)) - 1


@compiled_part
def has_one_sign(values: Floats) -> bool:
    """Return whether all numbers are positive, or all negative."""
    first = values[0]
    for corner in range(1, len(values)):
        if values[corner] * first <= 0:
            return False
    return bool(first != 0)


@compiled_part
def extremes(numerator: Floats, denominator: Floats) -> tuple[float, float]:
    """Return the smallest and largest quotient of polynomials that are given at the corners."""
    least = most = numerator[0] / denominator[0]
    for corner in range(1, len(numerator)):
        ratio = numerator[corner] / denominator[corner]
        least = min(least, ratio)
        most = max(most, ratio)
    return least, most


@compiled_part
def _within(numerator: Floats, denominator: Floats, low: Floats, high: Floats, inverse: int) -> int:
    """Return the targets that a quotient reaches or, with `inverse`, that its inverse reaches."""
    least, most = extremes(numerator, denominator)
    targets = 0
    for target in range(len(low)):
        first = 1.0 / high[target] if inverse else low[target]
        last = 1.0 / low[target] if inverse else high[target]
        if least <= last and most >= first:
            targets |= 1 << target
    return targets


@compiled_part
def divide(above: Floats, below: Floats, within: Floats) -> None:
    """Remove a common factor of numerator and denominator, in place.

    Both are linear in each gear-set ratio, so the quotient does not depend on the gear-set ratios
    in a common factor. These are set to the values at which the factor is largest.

    Parameters
    ----------
    above, below : array, shape (corners,)
    within : array, shape (corners, sets)
        Weights from the function `lines`. On the line along gear-set ratio j, the corners with bit
        j clear give the value at the lower end, the corners with bit j set the value at the upper
        end. [-]

    Examples
    --------
    >>> above = np.array([1.0, -1.0])  # (k - 1/2) 2 / (k - 1/2)
    >>> below = np.array([0.5, -0.5])
    >>> divide(above, below, np.ones((2, 1)))
    >>> above, below
    (array([1., 1.]), array([0.5, 0.5]))
    """
    corners = len(within)
    factor = _independent(above, below, within)
    if factor == 0:
        return
    best, most = 0, -1.0
    for start in range(corners):
        if start & ~factor == 0:
            total = 0.0
            for corner in range(corners):
                if corner & factor == start:
                    total += abs(below[corner])
            if total > most:
                best, most = start, total
    for corner in range(corners):
        above[corner] = above[(corner & ~factor) | best]
        below[corner] = below[(corner & ~factor) | best]


@compiled_part
def _independent(above: Floats, below: Floats, within: Floats) -> int:
    """Return the gear-set ratios on which a quotient does not depend, as bits."""
    corners, sets = within.shape
    independent = 0
    for number in range(sets):
        first_above = first_below = last_above = last_below = 0.0
        for corner in range(corners):
            weight = within[corner, number]
            if (corner >> number) & 1:
                last_above += weight * above[corner]
                last_below += weight * below[corner]
            else:
                first_above += weight * above[corner]
                first_below += weight * below[corner]
        first_product, last_product = first_above * last_below, last_above * first_below
        if abs(first_product - last_product) <= INDEPENDENT_RATIO * (
            abs(first_product) + abs(last_product)
        ):
            independent |= 1 << number
    return independent


def lines(sets: int) -> Floats:
    """Return interpolation weights of the corners of the bounds, for `divide`.

    Column j gives the values at both ends of a line along gear-set ratio j. All lines pass through
    the same point within the bounds.

    >>> lines(2)[:, 0]  # along the first ratio, with the second fixed
    array([0.58578644, 0.58578644, 0.41421356, 0.41421356])
    """
    places = np.sqrt(np.array([3, 2, 5, 7, 11, 13, 17, 19, 23, 29][:sets])) % 1
    bits = (np.arange(2**sets)[:, None] >> np.arange(sets)) & 1
    weights = np.where(bits, places, 1 - places)
    others = [np.delete(weights, number, axis=1).prod(axis=1) for number in range(sets)]
    return np.stack(others, axis=1)
