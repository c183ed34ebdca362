"""How far the ratios of gears or sets are from what is wanted: of many teeth, of whole regions."""

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
"""Of a ratio: |ln(i/target)|, or |i - target|."""


@dataclass(frozen=True)
class TeethTarget:
    """A ratio that is wanted, and its formula in some ratios of teeth.

    Parameters
    ----------
    name : str
        Of a gear, or of a ratio of an element.
    wanted : float
        [-]
    formula : GearFormula
    columns : tuple of int
        By index of a mechanism in the formula: the column of its ratio in arrays.
    error : {"ln", "absolute"}

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
        """The columns whose ratios matter."""
        return [self.columns[index] for index in self.formula.ratios]

    @cached_property
    def _factors(self) -> list[Floats]:
        return [factors(one, self.formula.ratios) for one in self.formula[1:]]

    def ratios(self, points: Floats) -> Floats:
        """The ratio at points, (points, columns); not finite where the output stands [-]."""
        own = points[:, self.used]
        with np.errstate(all="ignore"):
            above, below = (at_corners(one, own, own)[..., 0] for one in self._factors)
            return np.asarray(above / below)

    def errors(self, points: Floats) -> Floats:
        """The error at points, (points, columns) [-]."""
        return self.apart(self.ratios(points))

    def apart(self, ratios: Floats) -> Floats:
        """How far ratios are from what is wanted [-]."""
        with np.errstate(all="ignore"):
            if self.error == "absolute":
                found = np.abs(ratios - self.wanted)
            else:
                quotient = ratios / self.wanted
                found = np.abs(np.log(np.where(quotient > 0, quotient, 0.0)))
        return np.where(np.isfinite(ratios), found, np.inf)

    def least(self, low: Floats, high: Floats) -> Floats:
        """The least error that regions may have, (regions, columns) of bounds [-].

        The quotient has its ends at corners, as long as the output can't stand within.
        """
        *ends, stands = self._ends(low, high)
        holds = (ends[0] <= self.wanted) & (self.wanted <= ends[1])
        nearest = np.minimum(self.apart(ends[0]), self.apart(ends[1]))
        return np.where(holds | stands, 0.0, nearest)

    def ends(self, low: Floats, high: Floats) -> tuple[float, float] | None:
        """The least and largest ratio in one region; None if the output may stand there [-]."""
        least, largest, stands = self._ends(low, high)
        return None if stands[0] else (float(least[0]), float(largest[0]))

    def _ends(self, low: Floats, high: Floats) -> tuple[Floats, Floats, Booleans]:
        """The least and largest ratios in regions, and where there are none: the output stands."""
        own = low[:, self.used], high[:, self.used]
        above, below = (at_corners(one, *own) for one in self._factors)
        with np.errstate(all="ignore"):
            corners = above / below
        keeps_sign = np.abs(np.sign(below).sum(axis=1)) == below.shape[1]
        return corners.min(axis=1), corners.max(axis=1), ~keeps_sign

    def within(self, points: Floats, column: int, most: float) -> tuple[Floats, Floats, Booleans]:
        """Between which ratios of one column the error is no more than `most`, if others stay.

        Returns
        -------
        low, high : ndarray, shape (points,)
            Where the third is true; the output may not stand between them.
        """
        own = points[:, self.used]
        place = self.used.index(column)
        at = own.copy()
        ends = []
        for value in (0.0, 1.0):
            at[:, place] = value
            ends.append([at_corners(one, at, at)[..., 0] for one in self._factors])
        (above, below), (above_1, below_1) = ends
        slope, slope_below = above_1 - above, below_1 - below
        with np.errstate(all="ignore"):
            found = [
                (limit * below - above) / (slope - limit * slope_below)
                for limit in self._limits(most)
            ]
            pole = -below / slope_below
        low, high = np.minimum(*found), np.maximum(*found)
        is_sure = np.isfinite(low) & np.isfinite(high) & ~((low <= pole) & (pole <= high))
        return low, high, is_sure

    def _limits(self, most: float) -> tuple[float, float]:
        if self.error == "absolute":
            return self.wanted - most, self.wanted + most
        return self.wanted * math.exp(-most), self.wanted * math.exp(most)


def largest_errors(targets: Sequence[TeethTarget], points: Floats) -> Floats:
    """The largest error of all targets at points, (points, columns) [-]."""
    found: Floats = np.max([target.errors(points) for target in targets], axis=0, initial=0.0)
    return found


def least_errors(targets: Sequence[TeethTarget], low: Floats, high: Floats) -> Floats:
    """What the largest error of all targets is at least, of regions, (regions, columns) [-]."""
    found: Floats = np.max([one.least(low, high) for one in targets], axis=0, initial=0.0)
    return found
