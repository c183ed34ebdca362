"""Deviations of ratios of gears or gear sets from targets, for tooth numbers and for regions."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.synthesis.ratios.arrays import at_corners, factors
from vstatics.synthesis.ratios.formula import GearFormula

TeethError = Literal["ln", "absolute"]
"""Kind of error of a ratio: |ln(i/target)|, or |i - target|."""


@dataclass(frozen=True)
class TeethTarget:
    """Wanted ratio of a gear or gear set, with the formula in the ratios of gear sets.

    Parameters
    ----------
    name : str
        Name of a gear, or of a ratio of a gear set.
    wanted : float
        Wanted ratio. [-]
    formula : GearFormula
        Formula of the ratio.
    columns : dict of int to int
        Column of a mechanism's ratio in arrays of points, by the index of the mechanism.
    error : {"ln", "absolute"}
        Kind of error.

    Examples
    --------
    >>> from fractions import Fraction
    >>> one = Fraction(1)
    >>> low = GearFormula("ratio", {0: one, 1: -one}, {0: one})
    >>> target = TeethTarget("1", 3.0, low, {0: 0}, "absolute")
    >>> target.errors(np.array([[-2.5], [-1.0]]))
    array([0.5, 1. ])
    >>> target.least(np.array([[-4.0]]), np.array([[-2.5]]))
    array([0.5])
    """

    name: str
    wanted: float
    formula: GearFormula
    columns: dict[int, int]
    error: TeethError

    @cached_property
    def used(self) -> list[int]:
        """Columns of the gear-set ratios in the formula."""
        return [self.columns[index] for index in self.formula.ratios]

    @cached_property
    def _factors(self) -> list[Floats]:
        return [factors(polynomial, self.formula.ratios) for polynomial in self.formula[1:]]

    def ratios(self, points: Floats) -> Floats:
        """Return the ratio at points of gear-set ratios with shape (points, columns) [-].

        The result is not finite where the output is at rest.
        """
        used_points = points[:, self.used]
        with np.errstate(all="ignore"):
            above, below = (
                at_corners(part, used_points, used_points)[..., 0] for part in self._factors
            )
            return np.asarray(above / below)

    def errors(self, points: Floats) -> Floats:
        """Return the errors at points of gear-set ratios with shape (points, columns) [-]."""
        return self.apart(self.ratios(points))

    def apart(self, ratios: Floats) -> Floats:
        """Return the errors of given ratios [-]."""
        with np.errstate(all="ignore"):
            if self.error == "absolute":
                errors = np.abs(ratios - self.wanted)
            else:
                quotient = ratios / self.wanted
                errors = np.abs(np.log(np.where(quotient > 0, quotient, 0.0)))
        return np.where(np.isfinite(ratios), errors, np.inf)

    def least(self, low: Floats, high: Floats) -> Floats:
        """Return a lower bound of the error in regions, whose bounds have shape (regions, columns).

        The extremes of the quotient are at corners, unless the output can be at rest in the region.
        """
        *ends, stands = self._ends(low, high)
        holds = (ends[0] <= self.wanted) & (self.wanted <= ends[1])
        nearest = np.minimum(self.apart(ends[0]), self.apart(ends[1]))
        return np.where(holds | stands, 0.0, nearest)

    def ends(self, low: Floats, high: Floats) -> tuple[float, float] | None:
        """Return the smallest and largest ratio in a region [-].

        Return None if the ratio is unbounded.
        """
        least, largest, stands = self._ends(low, high)
        return None if stands[0] else (float(least[0]), float(largest[0]))

    def _ends(self, low: Floats, high: Floats) -> tuple[Floats, Floats, Booleans]:
        """Return the smallest and largest ratios in regions, and True where unbounded."""
        used_bounds = low[:, self.used], high[:, self.used]
        above, below = (at_corners(part, *used_bounds) for part in self._factors)
        with np.errstate(all="ignore"):
            corners = above / below
        keeps_sign = np.abs(np.sign(below).sum(axis=1)) == below.shape[1]
        return corners.min(axis=1), corners.max(axis=1), ~keeps_sign

    def within(self, points: Floats, column: int, most: float) -> tuple[Floats, Floats, Booleans]:
        """Return the range of a gear-set ratio with errors up to `most`, all other ratios fixed.

        Returns
        -------
        low, high : ndarray, shape (points,)
            Ends of the range. [-]
        is_sure : ndarray, shape (points,)
            True if the range is finite and contains no pole.
        """
        used_points = points[:, self.used]
        place = self.used.index(column)
        at = used_points.copy()
        ends = []
        for value in (0.0, 1.0):
            at[:, place] = value
            ends.append([at_corners(part, at, at)[..., 0] for part in self._factors])
        (above, below), (above_1, below_1) = ends
        slope, slope_below = above_1 - above, below_1 - below
        with np.errstate(all="ignore"):
            limits = [
                (limit * below - above) / (slope - limit * slope_below)
                for limit in self._limits(most)
            ]
            pole = -below / slope_below
        low, high = np.minimum(*limits), np.maximum(*limits)
        is_sure = np.isfinite(low) & np.isfinite(high) & ~((low <= pole) & (pole <= high))
        return low, high, is_sure

    def _limits(self, most: float) -> tuple[float, float]:
        if self.error == "absolute":
            return self.wanted - most, self.wanted + most
        return self.wanted * math.exp(-most), self.wanted * math.exp(most)


def largest_errors(targets: Sequence[TeethTarget], points: Floats) -> Floats:
    """Return the largest error of all targets at points with shape (points, columns) [-]."""
    errors: Floats = np.max([target.errors(points) for target in targets], axis=0, initial=0.0)
    return errors


def least_errors(targets: Sequence[TeethTarget], low: Floats, high: Floats) -> Floats:
    """Return a lower bound of the largest error of all targets in regions [-]."""
    errors: Floats = np.max([target.least(low, high) for target in targets], axis=0, initial=0.0)
    return errors
