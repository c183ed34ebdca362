"""Variables of a fit, and deviations of the gears, for arrays of points.

A point consists of the sign and the logarithm of the magnitude of each varied ratio.
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
    """Points with the signs and magnitudes of ratios, each of shape (points, varied ratios)."""

    signs: Floats
    sizes: Floats
    """Logarithms of the magnitudes. [-]"""

    def at(self, chosen: Sequence[int] | Integers | Booleans) -> FitPoints:
        """Return a selection of the points."""
        return FitPoints(self.signs[chosen], self.sizes[chosen])


class FitSpace(NamedTuple):
    """Mechanism ratios to vary, and gears to fit."""

    problem: FitProblem
    arrays: RatioArrays
    """Formulas of the gears to fit."""
    varied: Sequence[int]
    """Indices of the varied mechanisms."""
    targets: Floats
    """Wanted ratio of each gear to fit. [-]"""
    roots: Floats
    """Square roots of the weights, scaled so that the largest is 1. [-]"""
    advance: Advance
    """Function that is called after every step of a search."""

    @property
    def case_point(self) -> FitPoints:
        """Mechanism ratios of the case, clipped to the bounds, as a single point."""
        ratios = self.problem.anchor[np.newaxis, self.varied]
        return FitPoints(np.sign(ratios), np.log(np.abs(ratios)))

    def full(self, points: FitPoints) -> Floats:
        """Return the ratios of all mechanisms, shape (points, mechanisms) [-]."""
        ratios = np.tile(self.problem.anchor, (len(points.sizes), 1))
        ratios[:, self.varied] = points.signs * np.exp(points.sizes)
        return ratios

    def within(self, signs: Floats) -> tuple[Floats, Floats]:
        """Return the smallest and largest logarithms within the bounds, for given signs."""
        low, high = (np.array(bound)[self.varied] for bound in self.problem.bounds)
        least = np.where(signs > 0, np.maximum(low, 0), np.maximum(-high, 0))
        most = np.where(signs > 0, high, -low)
        return np.log(np.where(least > 0, least, NARROWEST_RATIO * most)), np.log(most)

    def quotients(self, points: FitPoints) -> Floats:
        """Return the gear ratios divided by the wanted ratios, shape (points, gears) [-]."""
        self.advance(1)
        return self.arrays.ratios(self.full(points)) / self.targets

    def deviations(self, points: FitPoints) -> tuple[Floats, Floats]:
        """Return weighted deviations ``ln(i/target)``, and the derivatives.

        The derivatives are with respect to the logarithms of points. Values are NaN where a gear
        has the wrong sign.
        """
        full = self.full(points)
        quotients = self.arrays.ratios(full) / self.targets
        values = np.log(np.where(quotients > 0, quotients, np.nan)) * self.roots
        slopes = self.arrays.sensitivities(full)[:, :, self.varied]
        return values, slopes * self.roots[:, np.newaxis]

    def minima(self, starts: FitPoints, weight: float = 0.0, steps: int = MOST_FIT_STEPS) -> Minima:
        """Return the minima from starting points; `weight` pulls towards the ratios of the case."""
        anchor = self.case_point.sizes

        def residuals(sizes: Floats, which: Integers) -> tuple[Floats, Floats]:
            self.advance(1)
            values, slopes = self.deviations(FitPoints(starts.signs[which], sizes))
            if not weight:
                return values, slopes
            off = sizes - anchor
            held = np.broadcast_to(weight * np.eye(off.shape[1]), (*off.shape, off.shape[1]))
            values = np.concatenate([values, weight * off], axis=1)
            return values, np.concatenate([slopes, held], axis=1)

        return minimize(residuals, starts.sizes, *self.within(starts.signs), steps)

    def turned(self, starts: FitPoints) -> FitPoints:
        """Move starting points with wrong signs to points at which gears can have the wanted sign.

        For a ratio ``i = Q/P``, the deviation ``(Q/target - P)/sqrt((Q/target)^2 + P^2)`` is
        minimised. It has no poles, and is defined for both directions of the gear.
        """

        def residuals(sizes: Floats, which: Integers) -> tuple[Floats, Floats]:
            self.advance(1)
            full = self.full(FitPoints(starts.signs[which], sizes))
            quotients = self.arrays.ratios(full) / self.targets
            size = np.hypot(quotients, 1)
            slopes = quotients * (quotients + 1) / size**3
            slopes = slopes[:, :, np.newaxis] * self.arrays.sensitivities(full)[:, :, self.varied]
            return (quotients - 1) / size, slopes

        minima = minimize(residuals, starts.sizes, *self.within(starts.signs))
        return FitPoints(starts.signs, minima.unknowns)


def fit_space(problem: FitProblem, advance: Advance = untold) -> FitSpace:
    """Return the variables and targets of a problem."""
    fitted = problem.fitted
    formulas = [problem.formulas[index] for index in fitted]
    mechanisms = len(problem.links.case.mechanisms)
    targets = np.array([problem.targets[index] for index in fitted])
    weights = np.array([problem.weights.get(index, 1.0) for index in fitted])
    roots = np.sqrt(weights / weights.max(initial=0.0)) if fitted else weights
    arrays = ratio_arrays(formulas, mechanisms)
    return FitSpace(problem, arrays, problem.varied, targets, roots, advance)
