"""Search for mechanism ratios by least squares from many starting points (multistart).

`fit_starts` samples the bounds and keeps points at which all gears have the wanted sign.
`found_ratios` minimises from each of these points, and returns the different minima, best first.
"""

from __future__ import annotations

import numpy as np

from vstatics.core.errors import CaseError, Problem
from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.synthesis.ratios.problem import Advance, FitProblem, untold
from vstatics.synthesis.ratios.space import FitPoints, FitSpace, fit_space
from vstatics.synthesis.tolerances import AT_BOUND, DEPENDENT_RATIOS, MET_RATIOS, SAME_SOLUTION

ANCHORED = (0.1, 0.01)
"""Weights of the pull towards the ratios of the case in successive minimisations, which determines
ratios that the wanted ratios do not. [-]

A last minimisation without this pull follows.
"""


def found_ratios(problem: FitProblem, advance: Advance = untold) -> tuple[list[Floats], list[int]]:
    """Return the ratios of all mechanisms at all different minima.

    Returns
    -------
    list of ndarray
        Ratios of all mechanisms, the best first. [-]
    list of int
        Indices of mechanisms that the wanted ratios leave undetermined.

    Raises
    ------
    CaseError
        If no starting point is found.
    """
    space = fit_space(problem, advance)
    if not space.varied:
        return [problem.anchor], []
    points = fit_starts(space)
    free = _free(space, points)
    for weight in (*ANCHORED, 0.0) if free else (0.0,):
        minima = space.minima(points, weight)
        # Order of the minima: the best first; of equally good ones, the nearest to the case first.
        signs, anchor = points.signs, space.case_point
        settled = minima.settled & np.isfinite(minima.squares)
        if not settled.any():
            settled = np.isfinite(minima.squares)
        squares = np.where(minima.squares < MET_RATIOS, 0.0, minima.squares)
        turned = (signs != anchor.signs).sum(axis=1)
        away = np.square(minima.unknowns - anchor.sizes).sum(axis=1)
        order = np.lexsort((away, turned, squares))
        chosen: list[int] = []
        for start in order[settled[order]].tolist():
            apart = np.abs(minima.unknowns[chosen] - minima.unknowns[start]).max(axis=1)
            if (apart[(signs[chosen] == signs[start]).all(axis=1)] >= SAME_SOLUTION).all():
                chosen.append(start)
        points = FitPoints(points.signs, minima.unknowns).at(chosen)
    ratios = space.full(points)
    # A ratio at a bound should not differ from it by rounding.
    for bound in map(np.array, problem.bounds):
        ratios = np.where(np.abs(ratios - bound) <= AT_BOUND * np.abs(bound), bound, ratios)
    return list(ratios), free


def _free(space: FitSpace, points: FitPoints) -> list[int]:
    """Return the indices of mechanisms that the wanted ratios leave undetermined."""
    slopes = space.deviations(points)[1]
    slopes = slopes[np.isfinite(slopes).all(axis=(1, 2))]
    if not len(slopes):
        return []
    _, parts, rows = np.linalg.svd(slopes)
    ranks = (parts > DEPENDENT_RATIOS * parts[:, :1]).sum(axis=1)
    where = int(np.argmax(ranks))
    loose = np.abs(rows[where, ranks[where] :]).max(axis=0, initial=0.0)
    return [
        index for index, size in zip(space.varied, loose, strict=True) if size > DEPENDENT_RATIOS
    ]


MOST_STARTS, LEAST_STARTS = 128, 8
START_NUMBERS = 12_800
"""Largest number of matrix entries of all starts; with more ratios there are fewer starts."""
SAMPLES, ROUNDS = 2048, 4
"""Number of points that are tried together, and largest number of trials."""


def start_count(space: FitSpace) -> int:
    """Return the number of starting points: 128, or fewer for more than ten ratios."""
    count = len(space.varied)
    return max(LEAST_STARTS, min(MOST_STARTS, START_NUMBERS // max(count**2, 1)))


def fit_starts(space: FitSpace) -> FitPoints:
    """Return starting points: the case if valid, then the best and further random points.

    Raises
    ------
    CaseError
        If no point is found at which all gears have the wanted sign.
    """
    count = start_count(space)
    random = np.random.default_rng(14)  # the seed is fixed, so that results are reproducible
    turning = np.zeros(len(space.targets))
    with np.errstate(all="ignore"):
        for number in range(ROUNDS):
            points = _sampled(space, random, with_case=not number)
            turning += turns(space, points).sum(axis=0)
            valid = _turning(space, points)
            if len(valid.sizes) < count:
                most = np.argsort(-turns(space, points).sum(axis=1), kind="stable")[:count]
                more = _turning(space, space.turned(points.at(most)))
                valid = FitPoints(*map(np.concatenate, zip(valid, more, strict=True)))
            if len(valid.sizes):
                squares = np.square(np.log(space.quotients(valid)) * space.roots).sum(axis=1)
                best = np.argsort(squares, kind="stable")[: count // 2]
                chosen = list(dict.fromkeys([0, *best.tolist(), *range(len(squares))]))[:count]
                return valid.at(chosen)
    names = [space.problem.links.case.gears[index].name for index in space.problem.fitted]
    seldom = int(np.argmin(turning))
    message = (
        f"none of {ROUNDS * SAMPLES} sets of ratios within the bounds lets all gears rotate as "
        f"wanted, {turning[seldom]:.0f} let gear {names[seldom]}: change the signs or the bounds"
    )
    raise CaseError([Problem("E832", message, ("ratios",))])


def _turning(space: FitSpace, points: FitPoints) -> FitPoints:
    return points.at(np.all(turns(space, points), axis=1))


def turns(space: FitSpace, points: FitPoints) -> Booleans:
    """Return whether each gear has the wanted sign at each point, shape (points, gears)."""
    quotients = space.quotients(points)
    return (quotients > 0) & np.isfinite(quotients)


def _sampled(space: FitSpace, random: np.random.Generator, *, with_case: bool) -> FitPoints:
    """Return random points within the bounds. The first can be the ratios of the case."""
    low, high = (np.array(bound)[space.varied] for bound in space.problem.bounds)
    shape = (SAMPLES, len(space.varied))
    signs = np.where(random.random(shape) * (high - low) < np.maximum(high, 0), 1.0, -1.0)
    signs = np.where(low >= 0, 1.0, np.where(high <= 0, -1.0, signs))
    if with_case:
        signs[0] = space.case_point.signs
    nearest, farthest = space.within(signs)
    sizes = nearest + random.random(shape) * (farthest - nearest)
    if with_case:
        sizes[0] = space.case_point.sizes
    return FitPoints(signs, sizes)
