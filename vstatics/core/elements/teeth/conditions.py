"""Conditions on teeth as formulas, for a gear set or for arrays of candidates.

All checks of teeth and searches for teeth use these formulas. Lengths are in modules. A negative
clearance means contact. The conditions assume the usual profile with a pressure angle of 20 degrees
and an addendum of one module.
"""

from __future__ import annotations

from typing import Any, TypeVar

import numpy as np

from vstatics.core.numerics.arrays import Floats

UNCUT, UNCUT_SHIFTED = 17, 14
"""Smallest number of teeth without undercut: standard profile, and shifted profile."""
INSIDE = 8
"""Smallest permitted difference of tooth numbers between a ring and the gear inside."""
TEETH_BETWEEN_TIPS = 4
"""Gap between two pitch circles at which tips just touch: two addenda, in half modules."""
TIPS = 2
"""Sum of two addenda, in modules."""
SHIFT = 2
"""Largest difference of teeth between coaxial gears that profile shift can compensate."""

Amount = TypeVar("Amount", float, Floats)
"""Number for a single gear set, or array for many gear sets."""


def neighbours_room(span: Amount, teeth: Amount, sine: Amount) -> Amount:
    """Return the clearance between the tips of neighbouring planets [modules].

    The clearance is ``2 a sin(pi/n) - (z + 2)``: distance of neighbouring planet axes minus tip
    diameter. Here a is the distance of the planets from the central axis, and z the number of
    teeth.

    Parameters
    ----------
    span : float or ndarray
        Twice the distance of the planet from the central axis, 2 a. [modules]
    teeth : float or ndarray
        Teeth of the planet.
    sine : float or ndarray
        sin(pi/n) for n planets.

    Examples
    --------
    >>> import math
    >>> round(neighbours_room(47.0, 15.0, math.sin(math.pi / 4)), 2)
    16.23
    """
    return span * sine - teeth - TIPS


def closes(first: Amount, second: Amount, apart: Amount) -> Any:
    """Return whether planet axes at radii `first` and `second` can have the distance `apart`.

    >>> bool(closes(20.0, 25.0, 20.0)), bool(closes(20.0, 45.0, 20.0))
    (True, False)
    """
    return (np.abs(first - second) < apart) & (apart < first + second)


def lean(first: Amount, second: Amount, apart: Amount) -> Amount:
    """Return the angle between two planets, seen from the central axis [rad]; NaN if impossible.

    >>> round(float(lean(20.0, 20.0, 20.0)), 6)
    1.047198
    """
    with np.errstate(invalid="ignore", divide="ignore"):
        angle: Amount = np.arccos((first**2 + second**2 - apart**2) / (2 * first * second))
    return angle


def crossing_distance(first: Amount, second: Amount, apart: Amount, turn: Amount) -> Amount:
    """Return the distance between planet axes of neighbouring pairs of planets [modules].

    Parameters
    ----------
    first, second : float or ndarray
        Radii of the two axes. [modules]
    apart : float or ndarray
        Distance between the axes of planets in mesh. [modules]
    turn : float or ndarray
        Angle between neighbouring pairs of planets, 2 pi/n for n pairs. [rad]

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
    """Return twice the clearance between a planet and a gear that it must not touch [modules].

    >>> passing_room(40, 20, 66, internal=True), passing_room(40, 20, 16, internal=False)
    (2, 0)
    """
    return (passed - span if internal else span - passed) - teeth - TEETH_BETWEEN_TIPS


def common_step(rows: Any, planets: int) -> Any:
    """Return the number of equidistant angles at which planets fit; 0 for any angle.

    Seen from a planet at an angle of ``k/n`` turn, a central gear of z teeth is shifted by ``z
    k/n`` teeth (a ring in the opposite direction). Each mesh is an equation in the rotations of
    planets. The planets fit if each integer combination of the equations that eliminates the
    rotations gives a whole number of teeth. So n must divide the greatest common divisor of these
    combinations.

    Parameters
    ----------
    rows : ndarray of int or object, shape (meshes, planets + 1, ...)
        For each mesh: teeth of the meshing rim of each planet, then teeth of the central gear
        (negative for a ring, 0 if two planets mesh). Further axes are for candidates. The array is
        overwritten.
    planets : int
        Number of planets of a train.

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
    """Return whether `count` planets fit at equal angles. `step` is the result of `common_step`."""
    return step % count == 0
