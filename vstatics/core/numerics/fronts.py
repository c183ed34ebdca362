"""Pareto fronts: the points that no other point dominates, by several objectives.

A point dominates another point if it is not worse in any objective and better in at least one.
Equal points do not dominate each other. Smaller objectives are better. Points with NaN are never in
a front.
"""

from __future__ import annotations

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats, Integers

LEAF = 128
"""Number of points up to which all pairs are compared."""
BLOCK = 256
"""Number of points in a block that is compared with other points at once."""
PIVOTS = 16
"""Number of good points with which all other points are compared before sorting."""


def non_dominated(objectives: Floats) -> Integers:
    """Return the rows that no other row dominates, in ascending order.

    A few good rows first eliminate most other rows, and the remaining rows are sorted. Two
    objectives then need a single pass. For more objectives the rows are halved recursively, and the
    second half is compared with the front of the first half. The comparison uses a running minimum
    for three objectives, and blocks for more.

    Parameters
    ----------
    objectives : ndarray, shape (rows, objectives)
        Smaller objectives are better.

    Returns
    -------
    ndarray of int, shape (non-dominated rows,)

    Examples
    --------
    >>> non_dominated(np.array([[1.0, 4.0], [2.0, 4.0], [3.0, 1.0], [1.0, 4.0], [np.nan, 0.0]]))
    array([0, 2, 3])
    """
    rows: Integers = np.flatnonzero(~np.isnan(objectives).any(axis=1))
    rows = _sieved(rows, objectives)
    points = objectives[rows]
    order = np.lexsort(points.T[::-1])
    points = points[order]
    new = np.ones(len(points), dtype=np.bool_)
    new[1:] = (points[1:] != points[:-1]).any(axis=1)
    best = np.zeros(np.count_nonzero(new), dtype=np.bool_)
    best[_front(points[new])] = True
    return np.sort(rows[order[best[np.cumsum(new) - 1]]])


def merged(first: Floats, second: Floats) -> tuple[Integers, Integers]:
    """Return the rows of two fronts that are non-dominated in the union of both.

    Both arguments must be fronts, such as results of `non_dominated`. With four or more objectives,
    merging is faster than calculating the front of all points.

    Parameters
    ----------
    first, second : ndarray, shape (rows, objectives)

    Returns
    -------
    first, second : ndarray of int
        Indices of the remaining rows of each front, in ascending order.

    Examples
    --------
    >>> merged(np.array([[1.0, 4.0], [3.0, 2.0]]), np.array([[0.0, 4.0], [5.0, 1.0]]))
    (array([1]), array([0, 1]))
    """
    if first.shape[1] <= 3:
        rows = non_dominated(np.concatenate([first, second]))
        return rows[rows < len(first)], rows[rows >= len(first)] - len(first)
    of_second = np.flatnonzero(~_dominated(first, second, strictly=True))
    return np.flatnonzero(~_dominated(second[of_second], first, strictly=True)), of_second


def scaled(objectives: Floats) -> Floats:
    """Return each objective scaled to 0 (best) to 1 (worst), with infinite values clipped."""
    limits = np.finfo(np.float64).max / 4
    finite = np.clip(objectives, -limits, limits)
    span = np.ptp(finite, axis=0)
    relative: Floats = (finite - finite.min(axis=0)) / np.where(span > 0, span, 1)
    return relative


def _sieved(rows: Integers, objectives: Floats) -> Integers:
    """Return the rows without most of the dominated rows.

    All rows are compared with the rows that have the smallest sums of scaled objectives. The choice
    of these rows affects only the speed.
    """
    if len(rows) <= LEAF:
        return rows
    sums = scaled(objectives[rows]).sum(axis=1)
    for _ in range(PIVOTS):
        pivot = int(np.argmin(sums))
        by = objectives[rows[pivot : pivot + 1]]
        sums[pivot] = np.inf
        left = ~_hit(by, objectives[rows], strictly=True)
        rows, sums = rows[left], sums[left]
        if np.isinf(sums).all():
            break
    return rows


def _front(points: Floats) -> Integers:
    """Return the indices of non-dominated points; the points must be distinct and ascending."""
    if points.shape[1] == 1:
        return np.arange(min(len(points), 1))
    if points.shape[1] == 2:
        least = np.minimum.accumulate(points[:, 1])
        first = np.ones(len(points), dtype=np.bool_)
        first[1:] = points[1:, 1] < least[:-1]
        return np.flatnonzero(first)
    if len(points) <= LEAF:
        # A point is non-dominated if no other point is equal or better in all objectives.
        as_good = np.ones((len(points), len(points)), dtype=np.bool_)
        for objective in points.T:
            as_good &= objective <= objective[:, None]
        best: Booleans = as_good.sum(axis=1) == 1  # each point counts itself
        return np.flatnonzero(best)
    half = len(points) // 2
    before = _front(points[:half])
    behind = half + np.flatnonzero(~_behind(points[half:], points[before]))
    return np.concatenate([before, behind[_front(points[behind])]])


def _behind(points: Floats, by: Floats) -> Booleans:
    """Return flags of points that rows of `by` dominate.

    The first objective is not compared: it must not be worse in any row of `by`.
    """
    if points.shape[1] > 3:
        return _dominated(by[:, 1:], points[:, 1:], strictly=False)
    order = np.argsort(by[:, 1], kind="stable")
    least = np.minimum.accumulate(by[order, 2])
    steps = np.searchsorted(by[order, 1], points[:, 1], side="right")
    dominated: Booleans = (steps > 0) & (least[steps - 1] <= points[:, 2])
    return dominated


def _dominated(by: Floats, points: Floats, *, strictly: bool) -> Booleans:
    """Return flags of points for which a row of `by` is equal or better in all objectives.

    If `strictly` is true, equal points are not flagged.
    """
    dominated = np.zeros(len(points), dtype=np.bool_)
    left = np.arange(len(points))
    for start in range(0, len(by), BLOCK):
        block = by[start : start + BLOCK]
        hit = np.zeros(len(left), dtype=np.bool_)
        for begin in range(0, len(left), 16 * BLOCK):
            part = slice(begin, begin + 16 * BLOCK)
            hit[part] = _hit(block, points[left[part]], strictly=strictly)
        dominated[left[hit]] = True
        left = left[~hit]
    return dominated


def _hit(by: Floats, points: Floats, *, strictly: bool) -> Booleans:
    as_good = np.ones((len(by), len(points)), dtype=np.bool_)
    better = np.zeros_like(as_good)
    for objective, point in zip(by.T, points.T, strict=True):
        as_good &= objective[:, None] <= point
        if strictly:
            better |= objective[:, None] < point
    hit: Booleans = np.logical_or.reduce(as_good & better if strictly else as_good, axis=0)
    return hit
