"""Redundant torques: whether some split of them lies within all limits, and the least such one."""

from __future__ import annotations

import math
from itertools import combinations

import numpy as np

from vstatics.core.numerics.arrays import Floats, largest
from vstatics.simulation.tolerances import NO_SPLIT, REGULAR_CORNER, WITHIN_LIMITS

_MOST_TORQUE_CORNERS = 3000


def widest(slack: Floats, directions: Floats) -> Floats:
    """The slacks of the split whose least one is largest: below 0 where none fits all limits.

    Parameters
    ----------
    slack : ndarray, shape (limits,)
        Of one split.
    directions : ndarray, shape (limits, d)
        Changes of it along the redundant directions.

    Examples
    --------
    Two clutches of 50 and 80 N*m that carry 100 N*m together, 60 of these by the first:

    >>> widest(np.array([-10.0, 40.0]), np.array([[1.0], [-1.0]]))
    array([15., 15.])
    """
    places = _corners(slack, directions)
    if places is None:
        places = _by_programming(slack, directions)[:, None]
    found = slack[:, None] + directions @ places
    sizes = found.min(axis=0)
    best = int(sizes.argmax())
    made: Floats = found[:, best] if sizes[best] > slack.min() else slack
    return made


def _corners(slack: Floats, directions: Floats) -> Floats | None:
    """Splits at which as many slacks are equal as can be, shape (d, corners); None: too many.

    The widest split is one of them.
    """
    limits, count = directions.shape
    if math.comb(limits, count + 1) > _MOST_TORQUE_CORNERS:
        return None
    chosen = np.array(list(combinations(range(limits), count + 1)), dtype=int)
    if not len(chosen):
        return np.zeros((count, 1))
    steep = largest(directions) or 1.0
    ones = np.ones((*chosen.shape, 1))
    matrices = np.concatenate([directions[chosen] / steep, -ones], axis=2)
    sizes = np.abs(np.linalg.det(matrices))
    regular = sizes > REGULAR_CORNER
    if not regular.any():
        return np.zeros((count, 1))
    found = np.linalg.solve(matrices[regular], -slack[chosen[regular]][..., None])
    places: Floats = found[:, :count, 0].T / steep
    return places


def _by_programming(slack: Floats, directions: Floats) -> Floats:
    """The same by linear programming, where there are many redundant directions."""
    from scipy.optimize import linprog

    count = directions.shape[1]
    goal = np.zeros(count + 1)
    goal[-1] = -1.0
    scale = largest(slack) or 1.0
    steep = largest(directions) or 1.0
    limits = np.hstack([-directions / steep, np.ones((len(slack), 1))])
    bounds = [(None, None)] * count + [(None, 10.0)]
    made = linprog(goal, A_ub=limits, b_ub=slack / scale, bounds=bounds)
    if not made.success or made.x is None:
        return np.zeros(count)
    place: Floats = made.x[:-1] * scale / steep
    return place


def least(slack: Floats, directions: Floats) -> Floats | None:
    """The least change of a split that brings it within all limits; None where none does.

    Examples
    --------
    >>> least(np.array([-10.0, 40.0]), np.array([[1.0], [-1.0]]))
    array([10.])
    """
    count = directions.shape[1]
    if not len(slack) or slack.min() >= 0:
        return np.zeros(count)
    from scipy.optimize import nnls

    scale = largest(slack)
    steep = largest(directions) or 1.0
    needed = -slack / scale
    stacked = np.vstack([directions.T / steep, needed[None, :]])
    goal = np.zeros(count + 1)
    goal[-1] = 1.0
    found, _ = nnls(stacked, goal)
    rest = stacked @ found - goal
    if abs(rest[-1]) < NO_SPLIT:
        return None
    change: Floats = -rest[:-1] / rest[-1] * scale / steep
    fits = (slack + directions @ change).min() >= -WITHIN_LIMITS * scale
    return change if fits else None
