"""The search for ratios of mechanisms: from starts all over the bounds to minima that differ."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vstatics.numerics.arrays import Floats
from vstatics.synthesis.fit_problem import Advance, FitProblem, untold
from vstatics.synthesis.fit_space import FitPoints, FitSpace, fit_space
from vstatics.synthesis.fit_starts import fit_starts
from vstatics.synthesis.least_squares import Minima

ANCHORED = (0.1, 0.01)
"""Weights of the case's own ratios, one after the other, where the wanted ones leave a choice;
at last they are let go."""
MET_RATIOS = 1e-20
"""Sums of squares below this are all the same: nothing is left but rounding."""
SAME_SOLUTION = 1e-5
"""Solutions whose ratios differ by less than this part are one."""
AT_BOUND = 1e-14
"""A ratio that differs from a bound by less than this part stands at it."""
DEPENDENT = 1e-9
"""Directions in which the ratios change by less than this part, of the most, are free."""


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
    return FoundRatios(list(_at_bounds(problem, space.full(points))), free)


def _at_bounds(problem: FitProblem, ratios: Floats) -> Floats:
    """Ratios that are those of bounds but for rounding, as they are given."""
    for bound in map(np.array, problem.bounds):
        ratios = np.where(np.abs(ratios - bound) <= AT_BOUND * np.abs(bound), bound, ratios)
    return ratios


def _free(space: FitSpace, points: FitPoints) -> list[int]:
    """The indices of mechanisms that the wanted ratios leave a choice."""
    slopes = space.deviations(points)[1]
    slopes = slopes[np.isfinite(slopes).all(axis=(1, 2))]
    if not len(slopes):
        return []
    _, parts, rows = np.linalg.svd(slopes)
    ranks = (parts > DEPENDENT * parts[:, :1]).sum(axis=1)
    where = int(np.argmax(ranks))
    loose = np.abs(rows[where, ranks[where] :]).max(axis=0, initial=0.0)
    return [index for index, one in zip(space.varied, loose, strict=True) if one > DEPENDENT]


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
