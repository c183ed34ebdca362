"""The search for ratios of mechanisms: starts all over the bounds, and where they lead."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from vstatics.errors import CaseError, Problem
from vstatics.numerics.arrays import Floats, Integers
from vstatics.synthesis.fit_problem import FitProblem
from vstatics.synthesis.least_squares import Minima, minimize
from vstatics.synthesis.ratio_arrays import RatioArrays, ratio_arrays

STARTS = 128
SAMPLES, MOST_SAMPLES = 2048, 2**16
"""Ratios that are tried at a time, and at most, for starts at which all gears turn as wanted."""
ANCHORED = (0.1, 0.01)
"""Weights of the case's own ratios, one after the other, where the wanted ones leave a choice;
at last they are let go."""
MET = 1e-20
"""Sums of squares below this are all the same: nothing is left but rounding."""
SAME_SOLUTION = 1e-5
"""Solutions whose ratios differ by less than this part are one."""
DEPENDENT = 1e-9
"""Directions in which the ratios change by less than this part, of the most, are free."""
NARROWEST = 1e-3
"""Where bounds have 0 between them, a ratio is no smaller than this part of the larger one."""


class Search(NamedTuple):
    """What the search works on: logarithms of the sizes of ratios that are varied."""

    problem: FitProblem
    arrays: RatioArrays
    """Of the gears that are fitted."""
    varied: Sequence[int]
    targets: Floats
    roots: Floats
    """Of the weights."""

    @classmethod
    def of(cls, problem: FitProblem) -> Search:
        """The search for what is asked."""
        fitted = problem.fitted
        formulas = [problem.formulas[index] for index in fitted]
        mechanisms = len(problem.own.case.mechanisms)
        targets = np.array([problem.targets[index] for index in fitted])
        roots = np.sqrt([problem.weights.get(index, 1.0) for index in fitted])
        return cls(problem, ratio_arrays(formulas, mechanisms), problem.varied, targets, roots)

    def solutions(self) -> tuple[list[Floats], list[int]]:
        """Ratios of all mechanisms in each solution, and which of them are free.

        Raises
        ------
        CaseError
            If no start is found.
        """
        signs, starts = self._starts()
        own = np.log(np.abs(self.problem.anchor[self.varied]))
        free = self._free(signs, starts)
        for weight in (*ANCHORED, 0.0) if free else (0.0,):
            minima = self._minima(signs, starts, weight, own)
            kept = self._distinct(signs, minima, own)
            signs, starts = signs[kept], minima.unknowns[kept]
        return list(self._full(signs, starts)), free

    def one_step(self) -> None:
        """What a step of all starts costs, for an estimate of the time."""
        sizes = np.zeros((STARTS, len(self.varied)))
        self._residuals(self._full(np.ones_like(sizes), sizes))

    def _full(self, signs: Floats, sizes: Floats) -> Floats:
        """Ratios of all mechanisms, from the logarithms of the varied ones."""
        ratios = np.tile(self.problem.anchor, (len(sizes), 1))
        ratios[:, self.varied] = signs * np.exp(sizes)
        return ratios

    def _minima(self, signs: Floats, starts: Floats, weight: float, own: Floats) -> Minima:
        """The minima to which starts lead, with a weight of the case's own ratios."""
        low, high = (np.array(one)[self.varied] for one in self.problem.bounds)
        nearest, farthest = np.log(sizes_within(low, high, signs))

        def residuals(sizes: Floats, which: Integers) -> tuple[Floats, Floats]:
            full = self._full(signs[which], sizes)
            return self._anchored(*self._residuals(full), weight, sizes - own)

        return minimize(residuals, starts, nearest, farthest)

    def _residuals(self, full: Floats) -> tuple[Floats, Floats]:
        """Weighted deviations with their derivatives; NaN where a gear turns the other way."""
        quotients = self.arrays.ratios(full) / self.targets
        values = np.log(np.where(quotients > 0, quotients, np.nan)) * self.roots
        slopes = self.arrays.sensitivities(full)[:, :, self.varied]
        return values, slopes * self.roots[:, np.newaxis]

    def _anchored(
        self, values: Floats, slopes: Floats, weight: float, off: Floats
    ) -> tuple[Floats, Floats]:
        """The same, and how far the logarithms are off the case's own."""
        if not weight:
            return values, slopes
        count = off.shape[1]
        held = np.broadcast_to(weight * np.eye(count), (len(off), count, count))
        return (
            np.concatenate([values, weight * off], axis=1),
            np.concatenate([slopes, held], axis=1),
        )

    def _starts(self) -> tuple[Floats, Floats]:
        """Signs and logarithms of ratios at which all gears turn as wanted.

        Raises
        ------
        CaseError
            If there are none among those tried.
        """
        random = np.random.default_rng(14)
        low, high = (np.array(one)[self.varied] for one in self.problem.bounds[:2])
        signs_found, sizes_found, turning = [], [], np.zeros(len(self.targets))
        count = tried = 0
        while count < STARTS and tried < MOST_SAMPLES and (count == 0 or tried < 4 * SAMPLES):
            shape = (SAMPLES, len(self.varied))
            signs = np.where(random.random(shape) * (high - low) < np.maximum(high, 0), 1.0, -1.0)
            signs = np.where(low >= 0, 1.0, np.where(high <= 0, -1.0, signs))
            nearest, farthest = np.log(sizes_within(low, high, signs))
            sizes = nearest + random.random(shape) * (farthest - nearest)
            if not tried:
                own = self.problem.anchor[self.varied]
                signs[0], sizes[0] = np.sign(own), np.log(np.abs(own))
            with np.errstate(all="ignore"):
                quotients = self.arrays.ratios(self._full(signs, sizes)) / self.targets
                right = (quotients > 0) & np.isfinite(quotients)
            turning += right.sum(axis=0)
            good = right.all(axis=1)
            signs_found.append(signs[good])
            sizes_found.append(sizes[good])
            tried += SAMPLES
            count += int(good.sum())
        if not count:
            raise CaseError([self._no_start(turning, tried)])
        return self._chosen(np.concatenate(signs_found), np.concatenate(sizes_found))

    def _no_start(self, turning: Floats, tried: int) -> Problem:
        names = [self.problem.own.case.gears[index].name for index in self.problem.fitted]
        seldom = min(range(len(names)), key=lambda place: turning[place])
        message = (
            f"of {tried} sets of ratios within the bounds none lets all gears turn as wanted, and "
            f"{turning[seldom]:.0f} let gear {names[seldom]}: expected other signs or wider bounds"
        )
        return Problem(message, ("ratios",))

    def _chosen(self, signs: Floats, sizes: Floats) -> tuple[Floats, Floats]:
        """The first start, which may be the case's own ratios, half good ones, and half any."""
        values, _ = self._residuals(self._full(signs, sizes))
        best = np.argsort(np.square(values).sum(axis=1), kind="stable")[: STARTS // 2]
        chosen = list(dict.fromkeys([0, *best.tolist(), *range(len(sizes))]))[:STARTS]
        return signs[chosen], sizes[chosen]

    def _free(self, signs: Floats, starts: Floats) -> list[int]:
        """The indices of mechanisms that the wanted ratios leave a choice."""
        slopes = self._residuals(self._full(signs, starts))[1]
        _, parts, rows = np.linalg.svd(slopes)
        ranks = (parts > DEPENDENT * parts[:, :1]).sum(axis=1)
        where = int(np.argmax(ranks))
        loose = np.abs(rows[where, ranks[where] :]).max(axis=0, initial=0.0)
        return [index for index, one in zip(self.varied, loose, strict=True) if one > DEPENDENT]

    def _distinct(self, signs: Floats, minima: Minima, own: Floats) -> list[int]:
        """The starts that came to minima that differ: the best first, of equals the nearest."""
        settled = minima.settled & np.isfinite(minima.squares)
        if not settled.any():
            settled = np.isfinite(minima.squares)
        squares = np.where(minima.squares < MET, 0.0, minima.squares)
        turned = (signs != np.sign(self.problem.anchor[self.varied])).sum(axis=1)
        order = np.lexsort((np.square(minima.unknowns - own).sum(axis=1), turned, squares))
        kept: list[int] = []
        for one in order[settled[order]].tolist():
            away = np.abs(minima.unknowns[kept] - minima.unknowns[one]).max(axis=1)
            if (away[(signs[kept] == signs[one]).all(axis=1)] >= SAME_SOLUTION).all():
                kept.append(one)
        return kept


def sizes_within(low: Floats, high: Floats, signs: Floats) -> tuple[Floats, Floats]:
    """The least and the largest size of ratios of some signs within bounds."""
    least = np.where(signs > 0, np.maximum(low, 0), np.maximum(-high, 0))
    most = np.where(signs > 0, high, -low)
    return np.where(least > 0, least, NARROWEST * most), most
