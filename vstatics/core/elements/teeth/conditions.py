"""The conditions on teeth as numbers: of one element, or of arrays of candidates at once.

Whatever checks teeth or looks for some takes them from here. Lengths are in modules; a room below
0 is too little. They hold for the usual profile of 20 degrees with tips one module high.
"""

from __future__ import annotations

from typing import Any, TypeVar

import numpy as np

from vstatics.core.numerics.arrays import Floats

UNCUT, UNCUT_SHIFTED = 17, 14
"""Fewest teeth of a wheel without undercut, and of one with a shifted profile."""
INSIDE = 8
"""Teeth that a ring must have more than the wheel in it."""
TEETH_BETWEEN_TIPS = 4
"""Of two tips on either side: teeth by which wheels differ whose tips just touch."""
TIPS = 2
"""Of two tips on either side, in modules."""
SHIFT = 2
"""Teeth by which wheels of one axis may differ where profiles are shifted."""

Amount = TypeVar("Amount", float, Floats)
"""Of one element, or of many."""


def neighbours_room(span: Amount, teeth: Amount, sine: Amount) -> Amount:
    """Between the tips of neighbouring planets.

    Parameters
    ----------
    span : float or ndarray
        Twice the distance of the planet from the axis. [modules]
    teeth : float or ndarray
        Of the planet.
    sine : float or ndarray
        sin(pi/n) of n planets.

    Examples
    --------
    >>> import math
    >>> round(neighbours_room(47.0, 15.0, math.sin(math.pi / 4)), 2)
    16.23
    """
    return span * sine - teeth - TIPS


def closes(first: Amount, second: Amount, apart: Amount) -> Any:
    """Whether planets at two radii from the axis can be so far apart.

    >>> bool(closes(20.0, 25.0, 20.0)), bool(closes(20.0, 45.0, 20.0))
    (True, False)
    """
    return (np.abs(first - second) < apart) & (apart < first + second)


def lean(first: Amount, second: Amount, apart: Amount) -> Amount:
    """The angle at which meshing planets stand, seen from the axis, NaN where none closes [rad].

    >>> round(float(lean(20.0, 20.0, 20.0)), 6)
    1.047198
    """
    with np.errstate(invalid="ignore", divide="ignore"):
        angle: Amount = np.arccos((first**2 + second**2 - apart**2) / (2 * first * second))
    return angle


def crossing_distance(first: Amount, second: Amount, apart: Amount, turn: Amount) -> Amount:
    """From a planet to the planet of the next place with which its own partner meshes.

    Parameters
    ----------
    first, second : float or ndarray
        Radii of the two axes. [modules]
    apart : float or ndarray
        Distance of planets that mesh. [modules]
    turn : float or ndarray
        2 pi/n of n places. [rad]

    Examples
    --------
    >>> import math
    >>> round(float(crossing_distance(20.0, 20.0, 20.0, 2 * math.pi / 3)), 6)
    20.0
    """
    beyond = first**2 + second**2 - 2 * first * second * np.cos(turn - lean(first, second, apart))
    distance: Amount = np.sqrt(np.maximum(beyond, 0.0))
    return distance


def passing_room(span: Amount, teeth: Amount, passed: Amount, *, internal: bool) -> Amount:
    """How many teeth more there are than where a planet's tips touch a wheel that it passes.

    >>> passing_room(40, 20, 66, internal=True), passing_room(40, 20, 16, internal=False)
    (2, 0)
    """
    return (passed - span if internal else span - passed) - teeth - TEETH_BETWEEN_TIPS


def common_step(rows: Any, planets: int) -> Any:
    """In how many places around the axis planets would go in; 0 in any.

    At a place ``k/n`` turn from the first, a wheel of z teeth stands ``z k/n`` teeth further in
    the planet's eyes (a ring backward). Phases of the planets that fit all meshes exist where
    every whole combination of meshes that leaves no planet has a whole number of teeth; the
    greatest common divisor of these is what n must divide.

    Parameters
    ----------
    rows : ndarray of int or object, shape (meshes, planets + 1, ...)
        Teeth of the rim that each planet has in a mesh, and of the wheel there, negative of a
        ring, 0 where planets mesh. Any further axes are candidates. It is used up.
    planets : int
        Planets of a train.

    Returns
    -------
    ndarray, shape (...)

    Examples
    --------
    Rims of 20 and 25 teeth in a sun of 30 and a ring of 95: (30 * 25 + 95 * 20)/gcd(20, 25).

    >>> int(common_step(np.array([[20, 30], [25, -95]]), 1))
    530
    """
    for column in range(planets):
        entries = np.abs(rows[:, column])
        while ((entries != 0).sum(axis=0) > 1).any():
            least = np.where(entries == 0, entries.max() + 1, entries).argmin(axis=0)[np.newaxis]
            pivot = np.take_along_axis(rows, least[:, np.newaxis], axis=0)
            divisor = np.where(pivot[:, column] == 0, 1, pivot[:, column])
            times = rows[:, column] // divisor
            np.put_along_axis(times, least, 0, axis=0)
            rows -= times[:, np.newaxis] * pivot
            entries = np.abs(rows[:, column])
        rows *= (entries == 0)[:, np.newaxis]
    return np.gcd.reduce(rows[:, -1], axis=0)


def seated(step: Any, count: Any) -> Any:
    """Whether so many planets go in at equal angles, by `common_step`."""
    return step % count == 0
