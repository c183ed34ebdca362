"""The search for ratios of mechanisms: from starts all over the bounds to minima that differ."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vstatics.core.errors import CaseError, Problem
from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.synthesis.ratios.least_squares import Minima
from vstatics.synthesis.ratios.problem import Advance, FitProblem, untold
from vstatics.synthesis.ratios.space import FitPoints, FitSpace, fit_space
from vstatics.synthesis.tolerances import AT_BOUND, DEPENDENT_RATIOS, MET_RATIOS, SAME_SOLUTION

ANCHORED = (0.1, 0.01)
"""Weights of the case's own ratios, one after the other, where the wanted ones leave a choice;
at last they are let go."""


class FoundRatios(NamedTuple):
    """Where a search has come to."""

    solutions: list[Floats]
    """Ratios of all mechanisms, the best first [-]."""
    free: list[int]
    """The indices of mechanisms that the wanted ratios leave a choice."""


def found_ratios(problem: FitProblem, advance: Advance = untold) -> FoundRatios:
    """The ratios of all mechanisms in all minima that differ.

    Raises
    ------
    CaseError
        If nothing is found to start from.
    """
    space = fit_space(problem, advance)
    if not space.varied:
        return FoundRatios([problem.anchor], [])
    points = fit_starts(space)
    free = _free(space, points)
    for weight in (*ANCHORED, 0.0) if free else (0.0,):
        minima = space.minima(points, weight)
        kept = _distinct(space, points.signs, minima)
        points = FitPoints(points.signs, minima.unknowns).at(kept)
    ratios = space.full(points)
    for bound in map(np.array, problem.bounds):  # as they are given, but for rounding
        ratios = np.where(np.abs(ratios - bound) <= AT_BOUND * np.abs(bound), bound, ratios)
    return FoundRatios(list(ratios), free)


def _free(space: FitSpace, points: FitPoints) -> list[int]:
    """The indices of mechanisms that the wanted ratios leave a choice."""
    slopes = space.deviations(points)[1]
    slopes = slopes[np.isfinite(slopes).all(axis=(1, 2))]
    if not len(slopes):
        return []
    _, parts, rows = np.linalg.svd(slopes)
    ranks = (parts > DEPENDENT_RATIOS * parts[:, :1]).sum(axis=1)
    where = int(np.argmax(ranks))
    loose = np.abs(rows[where, ranks[where] :]).max(axis=0, initial=0.0)
    return [index for index, one in zip(space.varied, loose, strict=True) if one > DEPENDENT_RATIOS]


def _distinct(space: FitSpace, signs: Floats, minima: Minima) -> list[int]:
    """The starts that came to minima that differ: the best first, of equals the nearest."""
    own = space.own
    settled = minima.settled & np.isfinite(minima.squares)
    if not settled.any():
        settled = np.isfinite(minima.squares)
    squares = np.where(minima.squares < MET_RATIOS, 0.0, minima.squares)
    turned = (signs != own.signs).sum(axis=1)
    away = np.square(minima.unknowns - own.sizes).sum(axis=1)
    order = np.lexsort((away, turned, squares))
    kept: list[int] = []
    for one in order[settled[order]].tolist():
        apart = np.abs(minima.unknowns[kept] - minima.unknowns[one]).max(axis=1)
        if (apart[(signs[kept] == signs[one]).all(axis=1)] >= SAME_SOLUTION).all():
            kept.append(one)
    return kept


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
                most = np.argsort(-turns(space, points).sum(axis=1), kind="stable")[:count]
                more = _turning(space, space.turned(points.at(most)))
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
    return (quotients > 0) & np.isfinite(quotients)


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
    return Problem("E832", message, ("ratios",))
