"""Split of redundant torques within torque limits."""

from __future__ import annotations

import math
from functools import lru_cache
from itertools import combinations
from typing import TypeAlias

import numpy as np

from vstatics.core.numerics.arrays import Floats, Integers, largest
from vstatics.simulation.tolerances import NO_SPLIT, REGULAR_CORNER, SAME_ROOM, WITHIN_LIMITS

_MOST_TORQUE_CORNERS = 3000
"""Number of candidate splits up to which all are enumerated, instead of linear programming."""
_MOST_ROOM = 10.0
"""Largest result of linear programming for the smallest slack, relative to the largest slack."""
_MOST_EXCHANGES = 30
"""Largest number of simplex steps from the latest best split; usually, 0 to 3 are needed."""
KnownLimits: TypeAlias = dict[tuple[int, bytes], tuple[Integers, Floats]]
"""Limits with equal slacks in the latest best split, and their inverse matrix, by directions.

Several splits can be best. Each run has its own limits, so no result depends on other runs.
"""


def widest(slack: Floats, directions: Floats, known: KnownLimits) -> Floats:
    """Return the slacks of the split whose smallest slack is largest.

    The smallest slack is negative if no split is within all limits.

    Parameters
    ----------
    slack : ndarray, shape (limits,)
        Slacks of any split: distances of the torques to their limits. [N*m]
    directions : ndarray, shape (limits, d)
        Changes of the slacks along the d redundant directions.
    known : KnownLimits
        Limits found in the same run, to which further limits are added.

    Examples
    --------
    Two clutches of 50 and 80 N*m that carry 100 N*m together, 60 of these by the first:

    >>> widest(np.array([-10.0, 40.0]), np.array([[1.0], [-1.0]]), {})
    array([15., 15.])
    """
    equations = _to_corners(directions.tobytes(), *directions.shape)
    if equations is None:
        places = _by_programming(slack, directions, known)[:, None]
    else:
        places = (equations @ slack).reshape(directions.shape[1], -1)
    slacks = slack[:, None] + directions @ places
    sizes = slacks.min(axis=0)
    best = int(sizes.argmax())
    return slacks[:, best] if sizes[best] > slack.min() else slack


def most_room(slack: Floats, directions: Floats, known: KnownLimits) -> float:
    """Return the smallest slack of the split from `widest`, infinity if it has no upper bound.

    Unlike `widest`, this function accepts directions that depend on each other.

    Examples
    --------
    The second direction changes neither clutch. A single limit lets the slack grow:

    >>> round(most_room(np.array([-10.0, 40.0]), np.array([[1.0, 0.0], [-1.0, 0.0]]), {}), 6)
    15.0
    >>> most_room(np.array([-10.0]), np.array([[1.0]]), {})
    inf
    """
    independent = _independent(directions.tobytes(), *directions.shape)
    return math.inf if independent is None else float(widest(slack, independent, known).min())


@lru_cache(maxsize=64)
def _independent(bytes_of_directions: bytes, limits: int, count: int) -> Floats | None:
    """Return independent directions of the same splits, None if all slacks can grow together."""
    from scipy.optimize import linprog

    directions = np.frombuffer(bytes_of_directions).reshape(limits, count)
    left, sizes, _ = np.linalg.svd(directions, full_matrices=False)
    independent = (left * sizes)[:, sizes > REGULAR_CORNER * largest(sizes)]
    if not (columns := independent.shape[1]):
        return None
    growing = linprog(
        [0.0] * columns + [-1.0],
        A_ub=np.hstack([-independent, np.ones((limits, 1))]),
        b_ub=np.zeros(limits),
        bounds=[(None, None)] * columns + [(None, 1.0)],
    )
    if growing.x is None or growing.x[-1] > REGULAR_CORNER:
        return None
    return np.ascontiguousarray(independent)


@lru_cache(maxsize=64)
def _to_corners(bytes_of_directions: bytes, limits: int, count: int) -> Floats | None:
    """Return the matrix from slacks to all splits in which d + 1 slacks are equal.

    The split whose smallest slack is largest is among them. A run contains few sets of directions,
    so each matrix is used for many slacks.

    Returns
    -------
    ndarray, shape (d * splits, limits)
        None if there are too many splits.
    """
    if math.comb(limits, count + 1) > _MOST_TORQUE_CORNERS:
        return None
    directions = np.frombuffer(bytes_of_directions).reshape(limits, count)
    chosen = np.array(list(combinations(range(limits), count + 1)), dtype=int)
    chosen = chosen.reshape(-1, count + 1)
    steep = largest(directions) or 1.0
    matrices = np.concatenate([directions[chosen] / steep, -np.ones((*chosen.shape, 1))], axis=2)
    regular = np.abs(np.linalg.det(matrices)) > REGULAR_CORNER
    if not regular.any():
        return np.zeros((count, limits))
    meeting = chosen[regular]
    to_places = np.zeros((count, len(meeting), limits))
    inverses = -np.linalg.inv(matrices[regular])[:, :count] / steep
    np.put_along_axis(to_places, meeting[None], inverses.transpose(1, 0, 2), axis=2)
    return to_places.reshape(-1, limits)


def _by_programming(slack: Floats, directions: Floats, known: KnownLimits) -> Floats:
    """Return the split with the largest smallest slack, by linear programming.

    With d directions, usually d + 1 slacks are equal in the best split. Whether the weights of
    these limits are positive depends on the directions alone, so the best split of other slacks is
    a few steps of the dual simplex method away.
    """
    scale = largest(slack) or 1.0
    count = directions.shape[1]
    steep = largest(directions) or 1.0
    limits = np.hstack([-directions / steep, np.ones((len(slack), 1))])
    key = count, directions.tobytes()
    for _ in range(_MOST_EXCHANGES if key in known else 0):
        rows, inverse = known[key]
        split: Floats = inverse[:count] @ slack[rows] / steep
        slacks = slack + directions @ split
        worst = int(slacks.argmin())
        if slacks[worst] >= slacks[rows].max() - SAME_ROOM * scale:
            return split
        shares = limits[worst] @ inverse
        weights = np.maximum(inverse[-1], 0.0) / np.maximum(shares, REGULAR_CORNER)
        rows = rows.copy()
        rows[np.where(shares > REGULAR_CORNER, weights, np.inf).argmin()] = worst
        known[key] = rows, np.linalg.inv(limits[rows])
    from scipy.optimize import linprog

    goal = np.zeros(count + 1)
    goal[-1] = -1.0
    bounds = [(None, None)] * count + [(None, _MOST_ROOM)]
    solution = linprog(goal, A_ub=limits, b_ub=slack / scale, bounds=bounds)
    if not solution.success or solution.x is None:
        return np.zeros(count)
    split = solution.x[:-1] * scale / steep
    # Limits with a weight have equal slacks. Limits with small slacks complete the corner.
    order = np.lexsort((slack + directions @ split, solution.ineqlin.marginals > -REGULAR_CORNER))
    rows = order[:0]
    for row in order:
        more = np.append(rows, row)
        if np.linalg.matrix_rank(limits[more], tol=REGULAR_CORNER) == len(more):
            rows = more
    if len(rows) > count and solution.x[-1] < _MOST_ROOM:
        known[key] = rows, np.linalg.inv(limits[rows])
    return split


def least(slack: Floats, directions: Floats) -> Floats | None:
    """Return the shortest step along `directions` to within all limits, None if impossible.

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
    weights, _ = nnls(stacked, goal)
    residual = stacked @ weights - goal
    if abs(residual[-1]) < NO_SPLIT:
        return None
    change = -residual[:-1] / residual[-1] * scale / steep
    return change if (slack + directions @ change).min() >= -WITHIN_LIMITS * scale else None
