"""Bounds of numbers that may have any sign: of their products, and what they settle."""

from __future__ import annotations

import math

Interval = tuple[float, float]
"""The least and the largest number."""

OPEN = -math.inf, math.inf
SURE = 1e-9
"""Bounds settle a comparison only beyond this part of them, their own rounding."""


def bounds_of_product(one: Interval, other: Interval) -> Interval:
    """Bounds of the product of two numbers.

    >>> bounds_of_product((-2.0, 3.0), (1.0, 4.0))
    (-8.0, 12.0)
    """
    return _around([a * b for a in one for b in other])


def bounds_of_quotient(one: Interval, other: Interval) -> Interval:
    """Bounds of the quotient of two numbers; none where the divisor may be 0.

    >>> bounds_of_quotient((-2.0, 3.0), (1.0, 4.0)), bounds_of_quotient((1.0, 2.0), (-1.0, 1.0))
    ((-2.0, 3.0), (-inf, inf))
    """
    if other[0] > 0 or other[1] < 0:
        return _around([a / b for a in one for b in other])
    return OPEN


def _around(ends: list[float]) -> Interval:
    return OPEN if any(map(math.isnan, ends)) else (min(ends), max(ends))


def is_below(one: Interval, other: Interval) -> bool | None:
    """Whether a number is less than another one; None where bounds do not tell.

    >>> is_below((-2.0, -1.0), (0.0, 0.0)), is_below((1.0, 3.0), (2.0, 4.0))
    (True, None)
    """
    if _lies_below(one, other):
        return True
    return False if _lies_below(other, one) else None


def _lies_below(one: Interval, other: Interval) -> bool:
    """With some room between them, but for an end that is 0 or infinite."""
    end, start = one[1], other[0]
    if start == math.inf or end == -math.inf or (0 in (end, start) and end < start):
        return True
    return end + SURE * abs(end) < start - SURE * abs(start)
