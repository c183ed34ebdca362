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
    y_before, y = map(function, ends)
    y_beyond, last = y_before, at - before
    step = last
    for _ in range(_MOST_STEPS):
        if (y_before > 0) != (y > 0):
            beyond, y_beyond = before, y_before
            last = step = at - before
        if abs(y_beyond) < abs(y):
            before, at, beyond = at, beyond, at
            y_before, y, y_beyond = y, y_beyond, y
        least, half = (absolute + relative * abs(at)) / 2, (beyond - at) / 2
        if y == 0 or abs(half) < least:
            break
        trial = math.inf
        if abs(last) > least and abs(y) < abs(y_before):
            if before == beyond:  # a straight line, otherwise an inverse parabola
                over, under = at - before, y - y_before
            else:
                slope, other = (y_before - y) / (before - at), (y_beyond - y) / (beyond - at)
                over = y_beyond * other - y_before * slope
                under = other * slope * (y_beyond - y_before)
            trial = -y * over / under if under else math.inf
        is_short = 2 * abs(trial) < min(abs(last), 3 * abs(half) - least)
        last, step = (step, trial) if is_short else (half, half)
        before, y_before = at, y
        at += step if abs(step) > least else math.copysign(least, half)
        y = function(at)
    return at
