"""What a search varies, and how far its gears are off: on arrays of points.

A point has a sign and the logarithm of a size for each ratio that is varied.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats, Integers
from vstatics.synthesis.ratios.arrays import RatioArrays, ratio_arrays
from vstatics.synthesis.ratios.least_squares import MOST_FIT_STEPS, Minima, minimize
from vstatics.synthesis.ratios.problem import Advance, FitProblem, untold
from vstatics.synthesis.tolerances import NARROWEST_RATIO


class FitPoints(NamedTuple):
    """Some points: both of shape (points, varied ratios)."""

    signs: Floats
    sizes: Floats
    """Logarithms."""

    def at(self, chosen: Sequence[int] | Integers | Booleans) -> FitPoints:
        """Some of them."""
        return FitPoints(self.signs[chosen], self.sizes[chosen])


class FitSpace(NamedTuple):
    """The ratios that are varied, and the gears that are fitted by them."""

    problem: FitProblem
    arrays: RatioArrays
    """Of the gears."""
    varied: Sequence[int]
    """Indices of mechanisms."""
    targets: Floats
    """By gear [-]."""
    roots: Floats
    """Of the weights, the largest of which is 1."""
    advance: Advance
    """Called at every step of a search."""

    @property
    def own(self) -> FitPoints:
        """The case's own ratios, or the bounds nearest to them: one point."""
        ratios = self.problem.anchor[np.newaxis, self.varied]
        return FitPoints(np.sign(ratios), np.log(np.abs(ratios)))

    def full(self, points: FitPoints) -> Floats:
        """The ratios of all mechanisms, (points, mechanisms) [-]."""
        ratios = np.tile(self.problem.anchor, (len(points.sizes), 1))
        ratios[:, self.varied] = points.signs * np.exp(points.sizes)
        return ratios

    def within(self, signs: Floats) -> tuple[Floats, Floats]:
        """The least and the largest logarithms within the bounds, for signs of each point."""
        low, high = (np.array(one)[self.varied] for one in self.problem.bounds)
        least = np.where(signs > 0, np.maximum(low, 0), np.maximum(-high, 0))
        most = np.where(signs > 0, high, -low)
        return np.log(np.where(least > 0, least, NARROWEST_RATIO * most)), np.log(most)

    def quotients(self, points: FitPoints) -> Floats:
        """The ratios of gears by those that are wanted, (points, gears) [-]."""
        self.advance(1)
        return self.arrays.ratios(self.full(points)) / self.targets

    def deviations(self, points: FitPoints) -> tuple[Floats, Floats]:
        """``ln(i/target)`` by the roots of weights, and derivatives by the logarithms of sizes.

        NaN where a gear turns the other way.
        """
        full = self.full(points)
        quotients = self.arrays.ratios(full) / self.targets
        values = np.log(np.where(quotients > 0, quotients, np.nan)) * self.roots
        slopes = self.arrays.sensitivities(full)[:, :, self.varied]
        return values, slopes * self.roots[:, np.newaxis]

    def minima(self, starts: FitPoints, weight: float = 0.0, steps: int = MOST_FIT_STEPS) -> Minima:
        """The minima to which starts lead, with a weight of the case's own ratios."""
        own = self.own.sizes

        def residuals(sizes: Floats, which: Integers) -> tuple[Floats, Floats]:
            self.advance(1)
            found = self.deviations(FitPoints(starts.signs[which], sizes))
            return _anchored(*found, weight, sizes - own) if weight else found

        return minimize(residuals, starts.sizes, *self.within(starts.signs), steps)

    def turned(self, starts: FitPoints) -> FitPoints:
        """Points at which gears may turn as wanted, from starts at which they do not.

        For ``i = Q/P`` the deviation ``(Q/target - P)/sqrt((Q/target)^2 + P^2)`` has no poles, and
        is the same where a gear turns the other way.
        """

        def residuals(sizes: Floats, which: Integers) -> tuple[Floats, Floats]:
            self.advance(1)
            full = self.full(FitPoints(starts.signs[which], sizes))
            quotients = self.arrays.ratios(full) / self.targets
            size = np.hypot(quotients, 1)
            slopes = quotients * (quotients + 1) / size**3
            slopes = slopes[:, :, np.newaxis] * self.arrays.sensitivities(full)[:, :, self.varied]
            return (quotients - 1) / size, slopes

        found = minimize(residuals, starts.sizes, *self.within(starts.signs))
        return FitPoints(starts.signs, found.unknowns)


def fit_space(problem: FitProblem, advance: Advance = untold) -> FitSpace:
    """The space of a problem."""
    fitted = problem.fitted
    formulas = [problem.formulas[index] for index in fitted]
    mechanisms = len(problem.own.case.mechanisms)
    targets = np.array([problem.targets[index] for index in fitted])
    weights = np.array([problem.weights.get(index, 1.0) for index in fitted])
    roots = np.sqrt(weights / weights.max(initial=0.0)) if fitted else weights
    arrays = ratio_arrays(formulas, mechanisms)
    return FitSpace(problem, arrays, problem.varied, targets, roots, advance)


def _anchored(values: Floats, slopes: Floats, weight: float, off: Floats) -> tuple[Floats, Floats]:
    """Deviations, and how far the logarithms are off the case's own."""
    count = off.shape[1]
    held = np.broadcast_to(weight * np.eye(count), (len(off), count, count))
    return (
        np.concatenate([values, weight * off], axis=1),
        np.concatenate([slopes, held], axis=1),
    )
