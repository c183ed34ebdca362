"""Redundant torques: whether some split of them lies within all limits, and the least such one."""

from __future__ import annotations

import numpy as np

from vstatics.numerics.arrays import Floats


def widest(slack: Floats, directions: Floats) -> float:
    """The largest least slack that a split has: below 0 where no split lies within all limits.

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
    15.0
    """
    if not len(slack):
        return np.inf
    if not directions.shape[1]:
        return float(slack.min())
    if directions.shape[1] == 1:
        return _widest_along(slack, directions[:, 0])
    from scipy.optimize import linprog

    count = directions.shape[1]
    goal = np.zeros(count + 1)
    goal[-1] = -1.0
    scale = float(np.abs(slack).max()) or 1.0
    limits = np.hstack([-directions, np.ones((len(slack), 1))])
    bounds = [(None, None)] * count + [(None, 10.0)]
    made = linprog(goal, A_ub=limits, b_ub=slack / scale, bounds=bounds)
    return float(made.x[-1]) * scale if made.success and made.x is not None else float(slack.min())


def _widest_along(slack: Floats, slopes: Floats) -> float:
    """The same along one direction: at a crossing of two lines, or where all are level."""
    best = float(slack.min())
    rises, falls = np.flatnonzero(slopes > 0), np.flatnonzero(slopes < 0)
    if not len(rises) or not len(falls):
        level = slack[slopes == 0]
        return float(level.min()) if len(level) else np.inf
    places = [(slack[j] - slack[i]) / (slopes[i] - slopes[j]) for i in rises for j in falls]
    return max(best, *(float((slack + slopes * place).min()) for place in places))


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

    scale = float(np.abs(slack).max())
    needed = -slack / scale
    stacked = np.vstack([directions.T, needed[None, :]])
    goal = np.zeros(count + 1)
    goal[-1] = 1.0
    found, _ = nnls(stacked, goal)
    rest = stacked @ found - goal
    if abs(rest[-1]) < 1e-12:
        return None
    change: Floats = -rest[:-1] / rest[-1] * scale
    return change
