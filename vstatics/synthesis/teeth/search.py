"""Search for the best tooth numbers of several gear sets together, by branch and bound.

The table of each gear set is a tree of halves. A region consists of a node from each tree, so it
contains all tooth numbers with ratios in these nodes. Its corners give a lower bound of its errors.
Regions that cannot be better than the best solutions are discarded. Other regions are halved until
few choices are left, or until all gear sets but one are chosen, and the last is solved for.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats, Integers, counted, portions
from vstatics.synthesis.ratios.problem import Advance, untold
from vstatics.synthesis.teeth.table import TeethTable
from vstatics.synthesis.teeth.targets import TeethTarget, largest_errors, least_errors
from vstatics.synthesis.tolerances import LARGEST_ERROR_WEIGHT, ROUNDED_ERROR

MOST_TEETH_SOLUTIONS = 20
"""Largest number of solutions that are kept."""
TOGETHER, AT_FIRST = 1 << 14, 1 << 8
"""Number of regions that are halved together, and the smaller number until solutions are found."""
FEW_CHOICES = 32
"""Largest number of choices in a region for which all are tried."""
CHOICES_AT_ONCE = 200_000
"""Number of choices that are tried together."""
MOST_REGIONS = 30_000_000
"""Number of regions after which the search ends with the bound proven until then."""


class BestTeeth(NamedTuple):
    """Result of a search for the best tooth numbers."""

    errors: Floats
    """Errors in ascending order, shape (found,)."""
    places: Integers
    """Index of the group of rows with equal ratios in each table, shape (found, gear sets)."""
    bound: float
    """Lower bound of the errors of all other choices; infinite if no other choice exists. [-]"""


def best_teeth(
    tables: Sequence[TeethTable],
    targets: Sequence[TeethTarget],
    *,
    most: float = math.inf,
    advance: Advance = untold,
) -> BestTeeth:
    """Return the choices of tooth numbers with the smallest errors, as groups in the tables.

    The result has enough choices for `MOST_TEETH_SOLUTIONS` solutions with different tooth numbers.

    Parameters
    ----------
    tables : sequence of TeethTable
        Table of each gear set; the columns in the formulas of targets are the ratios of all tables
        in order.
    targets : sequence of TeethTarget
        Wanted ratios.
    most : float
        Largest useful error. [-]
    advance : callable
        Function that is called with the number of further finished regions.
    """
    search = _Halving(tables, targets, most)
    start: Integers = np.zeros((1, len(tables)), np.int64)
    waiting: list[tuple[Floats, Integers]] = (
        [(search.least(start), start)] if all(len(table.ratios) for table in tables) else []
    )
    done = 0
    while waiting and search.most > ROUNDED_ERROR and done < MOST_REGIONS:
        least, regions = waiting.pop()
        hopeful = least < search.most
        least, regions = least[hopeful], regions[hopeful]
        together = TOGETHER if search.is_full else AT_FIRST
        if len(regions) > together:
            waiting.append((least[together:], regions[together:]))
            regions = regions[:together]
        if len(regions):
            waiting += search.halved(regions)
            done += len(regions)
            advance(len(regions))
    left = [float(least.min()) for least, _ in waiting if len(least)]
    bound = min([search.most if search.is_full else math.inf, *left])
    return BestTeeth(search.errors, search.places, bound)


def different_teeth(tables: Sequence[TeethTable], places: Integers) -> Floats:
    """Return, for each choice of groups, the number of solutions with different tooth numbers."""
    pairs = zip(tables, places.T, strict=True)
    return np.asarray(
        np.prod([table.different[rows].astype(float) for table, rows in pairs], axis=0)
    )


class _Halving:
    """Branch-and-bound search with the best known solutions."""

    def __init__(
        self,
        tables: Sequence[TeethTable],
        targets: Sequence[TeethTarget],
        most: float,
    ) -> None:
        self.tables = tables
        self.targets = targets
        self.most = most
        self.is_full = False
        self.errors = np.zeros(0)
        self.places: Integers = np.zeros((0, len(tables)), np.int64)
        widths = [table.ratios.shape[1] for table in tables]
        self.columns = [sum(widths[:number]) for number in range(len(widths))]
        self.sizes = [np.log(table.high / table.low) for table in tables]
        self.widest = [np.abs(size).max(axis=1, initial=0.0) for size in self.sizes]

    def ends(self, regions: Integers) -> tuple[Floats, Floats]:
        """Return the smallest and largest ratios in regions, shape (regions, columns) [-]."""
        pairs = list(zip(self.tables, regions.T, strict=True))
        low = np.concatenate([table.low[nodes] for table, nodes in pairs], axis=1)
        return low, np.concatenate([table.high[nodes] for table, nodes in pairs], axis=1)

    def least(self, regions: Integers) -> Floats:
        """Return a lower bound of the error in regions, shape (regions,) [-]."""
        return least_errors(self.targets, *self.ends(regions))

    def halved(self, regions: Integers) -> Iterator[tuple[Floats, Integers]]:
        """Yield the useful halves of regions, best first; in small regions, try every choice."""
        nodes = [table.nodes[node, :2] for table, node in zip(self.tables, regions.T, strict=True)]
        starts, ends = np.stack(nodes, axis=1).transpose(2, 0, 1)
        sizes = ends - starts
        few = sizes.astype(np.float64).prod(axis=1) <= FEW_CHOICES
        self._try(starts[few], sizes[few])
        regions, starts, sizes = regions[~few], starts[~few], sizes[~few]
        if self.is_full:
            for number, table in enumerate(self.tables):
                if table.ratios.shape[1] == 1:
                    alone = (np.delete(sizes, number, axis=1) == 1).all(axis=1)
                    self._solve(number, regions[alone], starts[alone], sizes[alone])
                    regions, starts, sizes = regions[~alone], starts[~alone], sizes[~alone]
        if len(regions):
            both = self._children(regions, sizes)
            low, high = self.ends(both)
            least = least_errors(self.targets, low, high)
            hopeful = least < self.most
            both, least = both[hopeful], least[hopeful]
            order = least
            if not self.is_full:
                order = least + LARGEST_ERROR_WEIGHT * np.minimum(
                    largest_errors(self.targets, ((low + high) / 2)[hopeful]), 1e3
                )
            by_least = np.argsort(order, kind="stable")
            yield least[by_least], both[by_least]

    def _children(self, regions: Integers, sizes: Integers) -> Integers:
        """Return both halves of each region, split in the gear set with the widest ratios."""
        widths = np.stack(
            [widest[nodes] for widest, nodes in zip(self.widest, regions.T, strict=True)], axis=1
        )
        element = np.where(sizes > 1, widths, -1.0).argmax(axis=1)
        children = []
        for half in (2, 3):
            halves = regions.copy()
            for number, table in enumerate(self.tables):
                chosen = element == number
                halves[chosen, number] = table.nodes[regions[chosen, number], half]
            children.append(halves)
        return np.concatenate(children)

    def _solve(self, number: int, regions: Integers, starts: Integers, sizes: Integers) -> None:
        """Try the tooth numbers of the only undecided gear set that have errors below the limit."""
        if not len(regions):
            return
        table, column = self.tables[number], self.columns[number]
        points, _ = self.ends(regions)
        low, high = np.full(len(regions), -np.inf), np.full(len(regions), np.inf)
        for target in self.targets:
            if column in target.used:
                ends = target.within(points, column, self.most)
                low = np.maximum(low, np.where(ends[2], ends[0], -np.inf))
                high = np.minimum(high, np.where(ends[2], ends[1], np.inf))
        amounts = np.abs(table.ratios[:, 0])
        if table.ratios[0, 0] < 0:
            low, high = -high, -low
        first = np.searchsorted(amounts, low - ROUNDED_ERROR * np.abs(low), "left")
        end = np.searchsorted(amounts, high + ROUNDED_ERROR * np.abs(high), "right")
        first = np.maximum(first, starts[:, number])
        count = np.minimum(end, starts[:, number] + sizes[:, number]) - first
        starts, sizes = starts.copy(), sizes.copy()
        starts[:, number], sizes[:, number] = first, np.maximum(count, 0)
        self._try(starts, sizes)

    def _try(self, starts: Integers, sizes: Integers) -> None:
        """Try all choices in regions, each given by a range of groups (start, size) in each table.

        The shape of `starts` and `sizes` is (regions, tables).
        """
        counts = sizes.prod(axis=1)
        for piece in portions(counts, CHOICES_AT_ONCE):
            of_region, number = counted(counts[piece])
            places = np.empty((len(number), len(self.tables)), np.int64)
            for element in range(len(self.tables)):
                number, place = np.divmod(number, sizes[piece][of_region, element])
                places[:, element] = starts[piece][of_region, element] + place
            self._merge_into_best(places)

    def _merge_into_best(self, places: Integers) -> None:
        pairs = zip(self.tables, places.T, strict=True)
        points = np.concatenate([table.ratios[rows] for table, rows in pairs], axis=1)
        errors = largest_errors(self.targets, points)
        better = errors < self.most if self.is_full else errors <= self.most
        better &= np.isfinite(errors)
        if not better.any():
            return
        errors = np.concatenate([self.errors, errors[better]])
        places = np.concatenate([self.places, places[better]])
        order = np.argsort(errors, kind="stable")
        errors, places = errors[order], places[order]
        different = np.cumsum(different_teeth(self.tables, places))
        enough = int(np.searchsorted(different, MOST_TEETH_SOLUTIONS)) + 1
        self.errors, self.places = errors[:enough], places[:enough]
        if enough <= len(errors):
            self.is_full, self.most = True, float(errors[enough - 1])
