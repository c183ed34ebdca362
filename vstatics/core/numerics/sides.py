"""Changes of sign of a function of one variable."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats

Sided: TypeAlias = Callable[[Floats], tuple[Floats, Floats]]
"""Function of x (an array) that returns values, and the magnitudes up to which values count as 0.
"""

_PLACES = 2**15 + 1
"""Number of x at which a function is evaluated first."""
_CLOSER = np.linspace(0.0, 1.0, 9)
"""Positions in an interval (0 to 1) at which a function is evaluated near an extremum."""
_TIMES_CLOSER = 24
"""Number of refinements near an extremum, each of which makes the interval four times shorter."""
_BISECTIONS = 100
"""Number of bisections at a change of sign."""


def changes_of_side(of: Sided, low: float, high: float) -> Floats:
    """Return the x where a function crosses or touches 0, even by a jump or a pole.

    The function is evaluated at 32,769 points, and at closer points near extrema next to 0. A pair
    of zeros between two points is found if the function is smooth there. The result for a crossing
    is the first float after the crossing.

    Examples
    --------
    >>> def pulse(x):
    ...     return np.sin(100 * x) - 0.9999999999, 1e-13 + 0 * x
    >>> changes_of_side(pulse, 0.0, 0.05).round(9)
    array([0.01570782, 0.0157081 ])
    >>> def pole(x):
    ...     return 1 / (x - 1), 1e-13 + 0 * x
    >>> changes_of_side(pole, 0.0, 3.0)
    array([1.])
    """
    with np.errstate(all="ignore"):
        places = np.linspace(low, high, _PLACES)
        places = np.union1d(places, _nearest_to_0(of, places))
        sides = _sides(of, places)
        touches = np.flatnonzero((sides[:-2] != 0) & (sides[1:-1] == 0) & (sides[2:] != 0)) + 1
        at, places, sides = places[touches], np.delete(places, touches), np.delete(sides, touches)
        changes = np.flatnonzero(sides[1:] != sides[:-1])
        before, behind, side = places[changes], places[changes + 1], sides[changes]
        # at a change of sign, small values count as nonzero
        passes = side * sides[changes + 1] == -1
        for _ in range(_BISECTIONS):
            middle = before / 2 + behind / 2
            same = _sides(of, middle, may_be_0=~passes) == side
            before, behind = np.where(same, middle, before), np.where(same, behind, middle)
    return np.sort([*at, *behind])


def _sides(of: Sided, places: Floats, *, may_be_0: Booleans | bool = True) -> Floats:
    """Return the sign of a function: +1, -1 or 0, and 2 for NaN."""
    values, zero = of(places)
    is_0 = may_be_0 & (np.abs(values) <= zero)
    return np.where(np.isnan(values), 2.0, np.where(is_0, 0.0, np.sign(values)))


def _nearest_to_0(of: Sided, places: Floats) -> Floats:
    """Return points near extrema next to 0, where a function can touch or cross 0 unnoticed."""
    values, sides = of(places)[0], _sides(of, places)
    stays = (sides[:-2] == sides[1:-1]) & (sides[1:-1] == sides[2:]) & (abs(sides[1:-1]) == 1)
    ahead, behind = (
        sides[1:-1] * (values[1:-1] - neighbours) for neighbours in (values[:-2], values[2:])
    )
    turns = np.flatnonzero(stays & (ahead <= 0) & (behind <= 0) & (ahead + behind < 0))
    first, last, side = places[turns], places[turns + 2], sides[turns + 1, None]
    rows = np.arange(len(turns))
    for _ in range(_TIMES_CLOSER):
        near = first[:, None] + (last - first)[:, None] * _CLOSER
        lowest = (side * of(near.reshape(-1))[0].reshape(near.shape)).argmin(axis=1).clip(1, 7)
        first, last = near[rows, lowest - 1], near[rows, lowest + 1]
    return near[rows, lowest] if len(turns) else first
