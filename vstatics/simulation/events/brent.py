"""Zero of a function between two places, by Brent's method.

The steps are those of `scipy.optimize.brentq`, whose import takes longer than many runs. Source: R.
P. Brent, Algorithms for Minimization Without Derivatives, 1973, chapter 4.
"""

from __future__ import annotations

import math
from collections.abc import Callable

_MOST_STEPS = 100
_LAST_BITS = 4 * math.ulp(1.0)


def zero(
    function: Callable[[float], float],
    ends: tuple[float, float],
    absolute: float,
    relative: float = _LAST_BITS,
) -> float:
    """Return a place between the ends at which a function is 0.

    Parameters
    ----------
    function : callable
        Continuous function; its values at both ends have different signs.
    ends : tuple of float
    absolute, relative : float
        Tolerance of the place, and tolerance relative to the place.

    Examples
    --------
    >>> zero(lambda x: x**3 - 2, (0.0, 2.0), 1e-15) ** 3
    2.0
    """
    (before, at), beyond = ends, ends[0]
    height_before, height = function(before), function(at)
    height_beyond, last = height_before, at - before
    step = last
    for _ in range(_MOST_STEPS):
        if (height_before > 0) != (height > 0):
            beyond, height_beyond = before, height_before
            last = step = at - before
        if abs(height_beyond) < abs(height):
            before, at, beyond = at, beyond, at
            height_before, height, height_beyond = height, height_beyond, height
        least, half = (absolute + relative * abs(at)) / 2, (beyond - at) / 2
        if height == 0 or abs(half) < least:
            break
        trial = math.inf
        if abs(last) > least and abs(height) < abs(height_before):
            places = (before, height_before), (at, height), (beyond, height_beyond)
            trial = _interpolated(*places)
        is_short = 2 * abs(trial) < min(abs(last), 3 * abs(half) - least)
        last, step = (step, trial) if is_short else (half, half)
        before, height_before = at, height
        at += step if abs(step) > least else math.copysign(least, half)
        height = function(at)
    return at


_Point = tuple[float, float]


def _interpolated(before: _Point, at: _Point, beyond: _Point) -> float:
    """Return the step to the zero of a line or of an inverse parabola through three points."""
    (x0, y0), (x1, y1), (x2, y2) = before, at, beyond
    if x0 == x2:
        return -y1 * (x1 - x0) / (y1 - y0)
    slope, other = (y0 - y1) / (x0 - x1), (y2 - y1) / (x2 - x1)
    below = other * slope * (y2 - y0)
    return -y1 * (y2 * other - y0 * slope) / below if below else math.inf
