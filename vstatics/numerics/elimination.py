"""Sparse Gauss elimination of small linear systems that need not be regular.

It knows nothing of transmissions. Rows are sparse; the arithmetic of their entries
(see `entries`) tells whether an entry is zero, and that decides rank and consistency
without any scale chosen from outside. Pivots are chosen by the structure, as far as
their magnitude allows, so that variants of one structure take the same way.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

from vstatics.numerics.entries import (
    EXACTLY_ONE,
    FLOATS,
    RIGHT,
    TRACED,
    Arithmetic,
    Entry,
    Equation,
    Row,
    row_of,
)
from vstatics.numerics.signed import Signed
from vstatics.numerics.signed_entries import SIGNED
from vstatics.numerics.traced import Number, is_traced


class Solution(NamedTuple):
    """What a system determines."""

    values: list[Number]
    """Unknowns, then sums; NaN where there is no single value."""
    consistent: bool
    """No equation contradicts the others."""
    missing: int
    """Unknowns less rank."""
    excess: int
    """Equations less rank."""


def solve(
    equations: Sequence[Equation],
    unknowns: int,
    sums: Sequence[Mapping[int, Number]] = (),
    arithmetic: Arithmetic | None = None,
) -> Solution:
    """Solve a system; give every unknown, and every sum of unknowns, that is determined.

    Parameters
    ----------
    equations : sequence of Equation
        Numbers are floats, or traced.
    unknowns : int
        Columns 0 to unknowns - 1.
    sums : sequence of mapping
        Column -> coefficient. A difference of two unknowns may be determined where
        neither of them is.
    arithmetic : Arithmetic, optional
        As the numbers are, floats or traced, when not given.

    Examples
    --------
    Two equations for x0 - x1 = 1 and x2 = 5; x0 and x1 are open, their difference is not.

    >>> equations = [{0: 1.0, 1: -1.0, RIGHT: 1.0}, {2: 2.0, RIGHT: 10.0}]
    >>> solve(equations, 3, sums=[{0: 1.0, 1: -1.0}])
    Solution(values=[nan, nan, 5.0, 1.0], consistent=True, missing=1, excess=0)
    """
    arithmetic = arithmetic or arithmetic_of(equations)
    run = _Elimination([row_of(equation, arithmetic) for equation in equations], arithmetic)
    consistent = run.consistent()
    values: list[Number] = [math.nan] * (unknowns + len(sums))
    if consistent:
        values = run.values(unknowns, sums)
    return Solution(values, consistent, unknowns - len(run.pivots), len(run.left))


def arithmetic_of(equations: Iterable[Equation]) -> Arithmetic:
    """The arithmetic for some equations: that of the first number that is no float."""
    for equation in equations:
        for coefficient in equation.values():
            for term in coefficient if isinstance(coefficient, tuple) else (coefficient,):
                if is_traced(term):
                    return SIGNED if isinstance(term, Signed) else TRACED
    return FLOATS


def in_free_unknowns(equations: Sequence[Equation], unknowns: int) -> list[dict[int, float]]:
    """The solutions of homogeneous equations: each unknown by those that are left free.

    Examples
    --------
    >>> in_free_unknowns([{0: 1.0, 1: 2.5, 2: -3.5}], 3)
    [{1: -2.5, 2: 3.5}, {1: 1.0}, {2: 1.0}]
    """
    run = _Elimination([row_of(equation, FLOATS) for equation in equations], FLOATS)
    known = run.by_free_unknowns(unknowns)
    rows = [known[unknown] for unknown in range(unknowns)]
    return [{column: float(entry[0]) for column, entry in row.items()} for row in rows]  # type: ignore[arg-type] # no traced number


def dependencies(equations: Sequence[Equation]) -> Iterator[tuple[list[int], bool]]:
    """Equations that say the same or contradict each other.

    For every equation in excess: the numbers of those whose weighted sum has no
    unknown left, and whether the right-hand sides agree.
    """
    marked = [row_of({**one, -2 - number: 1.0}, FLOATS) for number, one in enumerate(equations)]
    for left in _Elimination(marked, FLOATS).left:
        yield sorted(-2 - column for column in left if column < RIGHT), RIGHT not in left


class _Elimination:
    """One elimination.

    `pivots` holds, in order, the column, the pivot and the rest of its row; `left`
    the rows in which no unknown is left.
    """

    def __init__(self, rows: Sequence[Row], arithmetic: Arithmetic) -> None:
        self.arithmetic = arithmetic
        self.pivots: list[tuple[int, Entry, Row]] = []
        self.left: list[Row] = []
        active: list[Row] = []
        for row in rows:
            entries = {column: e for column, e in row.items() if is_traced(e[0]) or e[0] != 0}
            self._sort_in(entries, active)
        while active:
            row, column = _choose(active, arithmetic)
            pivot = row.pop(column)
            self.pivots.append((column, pivot, row))
            others, active = active, []
            for other in others:
                if column in other:
                    self._subtract(other, arithmetic.quotient(other.pop(column), pivot), row)
                    self._sort_in(other, active)
                elif other is not row:
                    active.append(other)

    def _sort_in(self, row: Row, active: list[Row]) -> None:
        (active if max(row, default=RIGHT) >= 0 else self.left).append(row)

    def _subtract(self, row: Row, factor: Entry, other: Row) -> None:
        """Take ``factor * other`` from `row`, in place, without what becomes zero."""
        for column, term in other.items():
            entry = self.arithmetic.less(row.pop(column, NOTHING), factor, term)
            if is_traced(entry[0]) or entry[0] != 0:
                row[column] = entry

    def consistent(self) -> bool:
        """Whether no row says that zero is something else."""
        return not any(RIGHT in row for row in self.left)

    def by_free_unknowns(self, unknowns: int) -> dict[int, Row]:
        """Back substitution: each unknown as a sum of free ones and of the right-hand side."""
        pivots = {column for column, _, _ in self.pivots}
        known: dict[int, Row] = {
            column: {column: EXACTLY_ONE} for column in range(unknowns) if column not in pivots
        }
        for column, pivot, row in reversed(self.pivots):
            total: Row = {RIGHT: row[RIGHT]} if RIGHT in row else {}
            for other, factor in row.items():
                if other >= 0:
                    self._subtract(total, factor, known[other])
            known[column] = {c: self.arithmetic.quotient(e, pivot) for c, e in total.items()}
        return known

    def values(self, unknowns: int, sums: Sequence[Mapping[int, Number]]) -> list[Number]:
        """Each unknown and sum, NaN where it hangs on a free unknown."""
        known = self.by_free_unknowns(unknowns)
        wanted = [known[column] for column in range(unknowns)]
        for terms in sums:
            summed: Row = {}
            for column, coefficient in terms.items():
                self._subtract(summed, (-coefficient, 0.0), known[column])
            wanted.append(summed)
        return [_value(row) for row in wanted]


NOTHING: Entry = (0.0, 0.0)


def _value(row: Row) -> Number:
    """The value of what depends on no free unknown."""
    if max(row, default=RIGHT) >= 0:
        return math.nan
    return row.get(RIGHT, NOTHING)[0]


def _choose(active: Sequence[Row], arithmetic: Arithmetic) -> tuple[Row, int]:
    """The pivot that fills least (Markowitz) among those large enough in a shortest row."""
    lengths = [len(row) - (RIGHT in row) for row in active]
    shortest = min(lengths)
    candidates = [row for row, length in zip(active, lengths, strict=True) if length == shortest]
    if shortest == 1:
        return candidates[0], max(candidates[0])
    counts = Counter(column for row in active for column in row)
    places = sorted(
        (counts[column], number, place, column)
        for number, row in enumerate(candidates)
        for place, column in enumerate(row)
        if column >= 0
    )
    for _, number, _, column in places:
        row = candidates[number]
        pivot = row[column][0]
        others = (row[other][0] for other in row if other not in (column, RIGHT))
        if all(arithmetic.enough(pivot, other) for other in others):
            return row, column
    return candidates[0], max(candidates[0])  # only where an overflow left no number
