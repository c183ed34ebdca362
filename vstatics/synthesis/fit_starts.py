"""Where a search begins: points at which all gears turn as wanted."""

from __future__ import annotations

import numpy as np

from vstatics.errors import CaseError, Problem
from vstatics.numerics.arrays import Booleans, Floats
from vstatics.synthesis.fit_space import FitPoints, FitSpace

MOST_STARTS, LEAST_STARTS = 128, 8
START_NUMBERS = 12_800
"""So large are the matrices of all starts together: with many ratios there are fewer starts."""
SAMPLES, ROUNDS = 2048, 4
"""Points that are tried at a time, and how many times."""


def start_count(space: FitSpace) -> int:
    """How many starts a search has: 128, but for more than ten ratios fewer."""
    count = len(space.varied)
    return max(LEAST_STARTS, min(MOST_STARTS, START_NUMBERS // max(count**2, 1)))


def fit_starts(space: FitSpace) -> FitPoints:
    """The points at which a search begins: the case's own ratios if they do, half of them good.

    Raises
    ------
    CaseError
        If no point is found at which all gears turn as wanted.
    """
    count = start_count(space)
    random = np.random.default_rng(14)
    turning = np.zeros(len(space.targets))
    with np.errstate(all="ignore"):
        for number in range(ROUNDS):
            points = _sampled(space, random, own=not number)
            turning += turns(space, points).sum(axis=0)
            found = _turning(space, points)
            if len(found.sizes) < count:
                more = _turning(space, space.turned(_nearly(space, points, count)))
                found = FitPoints(*map(np.concatenate, zip(found, more, strict=True)))
            if len(found.sizes):
                return _chosen(space, found, count)
    raise CaseError([_no_start(space, turning)])


def _turning(space: FitSpace, points: FitPoints) -> FitPoints:
    """Those at which all gears turn as wanted."""
    return points.at(np.all(turns(space, points), axis=1))


def turns(space: FitSpace, points: FitPoints) -> Booleans:
    """Whether gears turn as wanted, (points, gears)."""
    quotients = space.quotients(points)
    right: Booleans = (quotients > 0) & np.isfinite(quotients)
    return right


def _sampled(space: FitSpace, random: np.random.Generator, *, own: bool) -> FitPoints:
    """Points all over the bounds; the first of them may be the case's own ratios."""
    low, high = (np.array(one)[space.varied] for one in space.problem.bounds)
    shape = (SAMPLES, len(space.varied))
    signs = np.where(random.random(shape) * (high - low) < np.maximum(high, 0), 1.0, -1.0)
    signs = np.where(low >= 0, 1.0, np.where(high <= 0, -1.0, signs))
    if own:
        signs[0] = space.own.signs
    nearest, farthest = space.within(signs)
    sizes = nearest + random.random(shape) * (farthest - nearest)
    if own:
        sizes[0] = space.own.sizes
    return FitPoints(signs, sizes)


def _nearly(space: FitSpace, points: FitPoints, count: int) -> FitPoints:
    """The points at which most gears turn as wanted."""
    wrong = np.argsort(-turns(space, points).sum(axis=1), kind="stable")
    return points.at(wrong[:count])


def _chosen(space: FitSpace, points: FitPoints, count: int) -> FitPoints:
    """The first point, which may be the case's own, half good ones, and half any."""
    squares = np.square(np.log(space.quotients(points)) * space.roots).sum(axis=1)
    best = np.argsort(squares, kind="stable")[: count // 2]
    chosen = list(dict.fromkeys([0, *best.tolist(), *range(len(squares))]))[:count]
    return points.at(chosen)


def _no_start(space: FitSpace, turning: Floats) -> Problem:
    names = [space.problem.own.case.gears[index].name for index in space.problem.fitted]
    seldom = int(np.argmin(turning))
    message = (
        f"of {ROUNDS * SAMPLES} sets of ratios within the bounds none lets all gears turn as "
        f"wanted, {turning[seldom]:.0f} let gear {names[seldom]}: expected other signs or bounds"
    )
    return Problem(message, ("ratios",))
