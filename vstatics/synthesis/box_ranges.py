"""Which wanted ratios a gear can have within bounds: exactly, from the corners alone.

A ratio is a quotient of two polynomials that are linear in the ratio of each set. Where the
denominator has no zero the quotient goes one way along each of them, so its extremes are at
corners; and a polynomial of this kind has no zero within if it has one sign at all corners.
"""

from __future__ import annotations

from vstatics.numerics.arrays import Floats
from vstatics.numerics.compiled import compiled


@compiled
def reached(numerator: Floats, denominator: Floats, low: Floats, high: Floats) -> int:
    """The targets that the quotient reaches, as bits.

    Parameters
    ----------
    numerator, denominator : array, shape (corners,)
    low, high : array, shape (targets,)
        Between which a target is met; of one sign. [-]

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
        return _within(numerator, denominator, low, high)
    found = 0
    if has_one_sign(numerator):
        least = most = denominator[0] / numerator[0]
        for corner in range(1, len(numerator)):
            inverse = denominator[corner] / numerator[corner]
            least = min(least, inverse)
            most = max(most, inverse)
        for target in range(len(low)):
            if 1.0 / high[target] <= most and 1.0 / low[target] >= least:
                found |= 1 << target
        return found
    return (1 << len(low)) - 1


@compiled
def has_one_sign(values: Floats) -> bool:
    """Whether all numbers are above zero, or all below."""
    first = values[0]
    for one in values[1:]:
        if one * first <= 0:
            return False
    return bool(first != 0)


@compiled
def _within(numerator: Floats, denominator: Floats, low: Floats, high: Floats) -> int:
    """The targets between the least and the greatest quotient at a corner."""
    least = most = numerator[0] / denominator[0]
    for corner in range(1, len(numerator)):
        ratio = numerator[corner] / denominator[corner]
        least = min(least, ratio)
        most = max(most, ratio)
    found = 0
    for target in range(len(low)):
        if least <= high[target] and most >= low[target]:
            found |= 1 << target
    return found
