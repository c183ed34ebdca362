"""Sparse Gauss elimination of small linear systems that need not be regular.

It knows nothing of transmissions. Rows are sparse, and an entry is a number or an
array with one number per variant: all variants run through the same operations.
The first variant chooses the pivots; the others are watched, and those for which
the choice is not safe, or whose rank is another, are solved again, the first of these
choosing.

The size of an entry (see `entries`) tells whether it is zero; that decides rank and
consistency without any scale chosen from outside.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from vstatics.arrays import Booleans, Floats, Integers
from vstatics.entries import RIGHT, Entry, Number, Row, is_zero, quotient, subtract

PIVOT = 0.1
"""A pivot is at least this part of the largest entry in its row: so rows can't grow."""
PIVOT_WATCHED = 1e-3
"""The same for the variants that did not choose the pivot."""


class Solution(NamedTuple):
    """What a system determines, for each variant (last axis)."""

    values: Floats
    """(unknowns + sums, variants); NaN where there is no single value."""
    consistent: Booleans
    """(variants,): no equation contradicts the others."""
    missing: Integers
    """(variants,): unknowns less rank."""
    excess: Integers
    """(variants,): equations less rank."""


def solve(
    rows: Sequence[Row],
    unknowns: int,
    sums: Sequence[Mapping[int, float]] = (),
    variants: int = 1,
) -> Solution:
    """Solve a system; give every unknown, and every sum of unknowns, that is determined.

    Parameters
    ----------
    rows : sequence of Row
        Equations; entries are floats, or arrays of shape (variants,).
    unknowns : int
        Columns 0 to unknowns - 1.
    sums : sequence of mapping
        Column -> coefficient. A difference of two unknowns may be determined where
        neither of them is.
    variants : int
        Number of systems that are solved at once.

    Examples
    --------
    Two equations for x0 - x1 = 1 and x2 = 5; x0 and x1 are open, their difference is not.

    >>> rows = [{0: (1.0, 1.0), 1: (-1.0, 1.0), RIGHT: (1.0, 1.0)},
    ...         {2: (2.0, 2.0), RIGHT: (10.0, 10.0)}]
    >>> solution = solve(rows, 3, sums=[{0: 1.0, 1: -1.0}])
    >>> solution.values[:, 0]
    array([nan, nan,  5.,  1.])
    >>> int(solution.missing[0]), int(solution.excess[0])
    (1, 0)
    """
    values = np.empty((unknowns + len(sums), variants))
    consistent = np.empty(variants, dtype=np.bool_)
    missing = np.empty(variants, dtype=np.int64)
    excess = np.empty(variants, dtype=np.int64)
    todo = np.arange(variants)
    while todo.size:
        watch = _Watch(todo.size)
        with np.errstate(all="ignore"):  # variants that the pivots do not suit
            run = _Elimination([_part(row, todo, variants) for row in rows], watch)
            sound = run.consistent()
            found = run.values(unknowns, sums) if sound else [np.nan] * len(values)
        done = todo[watch.agree]
        if todo.size == 1:
            values[:, todo[0]] = found
        else:
            for number, value in enumerate(found):
                each = isinstance(value, np.ndarray)
                values[number, done] = value[watch.agree] if each else value
        consistent[done] = sound
        missing[done] = unknowns - len(run.pivots)
        excess[done] = len(run.left)
        todo = todo[~watch.agree]
    return Solution(values, consistent, missing, excess)


def dependencies(rows: Sequence[Row]) -> Iterator[tuple[list[int], bool]]:
    """Equations that say the same or contradict each other.

    For every equation in excess: the numbers of the rows whose weighted sum has no
    unknown left, and whether the right-hand sides agree. One variant only.
    """
    marked: list[Row] = [{**row, -2 - n: (1.0, 1.0)} for n, row in enumerate(rows)]
    for left in _Elimination(marked, _Watch(1)).left:
        yield sorted(-2 - column for column in left if column < RIGHT), RIGHT not in left


def _part(row: Row, chosen: Integers, variants: int) -> Row:
    """The row for the chosen variants only; plain floats when there is but one."""
    if chosen.size == variants > 1:
        return dict(row)

    def part(number: Number) -> Number:
        if not isinstance(number, np.ndarray):
            return number
        return float(number[chosen[0]]) if chosen.size == 1 else number[chosen]

    return {column: (part(value), part(size)) for column, (value, size) in row.items()}


class _Watch:
    """Decides by the first variant, and notes which others would decide otherwise."""

    def __init__(self, variants: int) -> None:
        self.agree = np.ones(variants, dtype=np.bool_)

    def decides_zero(self, entry: Entry) -> bool:
        """Whether an entry is zero; for all variants alike."""
        zero = is_zero(*entry)
        if isinstance(zero, np.ndarray):
            self.agree &= zero == zero[0]
            return bool(zero[0])
        return bool(zero)

    def drops(self, entry: Entry) -> bool:
        """Whether an entry can be left out; one that can't may be zero in other variants."""
        zero = is_zero(*entry)
        if not isinstance(zero, np.ndarray):
            return bool(zero)
        if zero[0]:
            self.agree &= zero
        return bool(zero[0])

    def check_pivot(self, pivot: Entry, row: Row) -> None:
        """Note the variants for which this pivot is zero or small in its row."""
        if self.agree.size > 1:
            magnitude = np.abs(pivot[0])
            self.agree &= np.logical_not(is_zero(*pivot))
            for column, (value, _) in row.items():
                if column >= 0:
                    self.agree &= magnitude >= PIVOT_WATCHED * np.abs(value)
            self.agree[0] = True  # it chose


class _Elimination:
    """One elimination.

    `pivots` holds, in order, the column, the pivot and the rest of its row; `left`
    the rows in which no unknown is left.
    """

    def __init__(self, rows: list[Row], watch: _Watch) -> None:
        self.watch = watch
        self.pivots: list[tuple[int, Entry, Row]] = []
        self.left: list[Row] = []
        active: list[Row] = []
        for row in rows:
            entries = {column: e for column, e in row.items() if not watch.drops(e)}
            self._sort_in(entries, active)
        while active:
            row, column = _choose(active)
            pivot = row.pop(column)
            watch.check_pivot(pivot, row)
            self.pivots.append((column, pivot, row))
            others, active = active, []
            for other in others:
                if other is not row:
                    if column in other:
                        subtract(other, quotient(other.pop(column), pivot), row, watch.drops)
                    self._sort_in(other, active)

    def _sort_in(self, row: Row, active: list[Row]) -> None:
        (active if max(row, default=RIGHT) >= 0 else self.left).append(row)

    def consistent(self) -> bool:
        """Whether no row says that zero is something else."""
        return all(self.watch.decides_zero(row[RIGHT]) for row in self.left if RIGHT in row)

    def values(self, unknowns: int, sums: Sequence[Mapping[int, float]]) -> list[Number]:
        """Back substitution: each unknown and sum, NaN where it hangs on a free unknown."""
        pivots = {column for column, _, _ in self.pivots}
        known: dict[int, Row] = {
            column: {column: (1.0, 0.0)} for column in range(unknowns) if column not in pivots
        }
        for column, pivot, row in reversed(self.pivots):
            total: Row = {RIGHT: row[RIGHT]} if RIGHT in row else {}
            for other, factor in row.items():
                if other >= 0:
                    subtract(total, factor, known[other], self.watch.drops)
            known[column] = {c: quotient(entry, pivot) for c, entry in total.items()}
        wanted = [known[column] for column in range(unknowns)]
        for terms in sums:
            summed: Row = {}
            for column, coefficient in terms.items():
                subtract(summed, (-coefficient, 0.0), known[column], self.watch.drops)
            wanted.append(summed)
        return [self._value(row) for row in wanted]

    def _value(self, row: Row) -> Number:
        free = [not self.watch.decides_zero(entry) for column, entry in row.items() if column >= 0]
        if any(free):
            return float("nan")
        value, size = row.get(RIGHT, (0.0, 0.0))
        zero = is_zero(value, size)
        if isinstance(zero, np.ndarray):
            return np.where(zero, 0.0, value)
        return 0.0 if zero else value


def _choose(active: list[Row]) -> tuple[Row, int]:
    """The pivot that fills least (Markowitz) among those large enough in a shortest row."""
    shortest = len(active[0]) + 1
    candidates: list[Row] = []
    for row in active:
        length = len(row) - (RIGHT in row)
        if length == 1:
            return row, max(row)
        if length < shortest:
            shortest, candidates = length, []
        if length == shortest:
            candidates.append(row)
    counts = Counter(column for row in active for column in row)
    best: tuple[int, float] = (len(active) + 1, 0.0)
    choice = candidates[0], max(candidates[0])  # stands only if an overflow left no number
    for row in candidates:
        magnitudes = {column: _first(row[column][0]) for column in row if column >= 0}
        largest = max(magnitudes.values())
        for column, magnitude in magnitudes.items():
            rank = counts[column], -magnitude / largest
            if magnitude >= PIVOT * largest and rank < best:
                best, choice = rank, (row, column)
    return choice


def _first(number: Number) -> float:
    return abs(float(number[0])) if isinstance(number, np.ndarray) else abs(number)
