"""Sparse Gauss elimination of small linear systems that can be singular.

Each entry of an equation is a value with a bound of its rounding error (see `Entry`). From this
bound the elimination decides whether the entry is zero, without an external scale. Pivots are
chosen by sparsity if their magnitude allows, so that systems of equal structure are eliminated in
the same order.

The size of a value is the sum of the magnitudes from which it was calculated. The rounding error of
the value is at most a few units in the last place of its size (running error analysis: Wilkinson
1963). A difference therefore counts as zero if it is at most a unit in the last place of its size.
It must also be less than a millionth of its larger term, because sizes overestimate the error of
long calculations. `solve_with_certainty` also returns whether nonzero values keep enough digits.

Traced numbers represent many variants. The floats of the first variant decide whether a difference
is zero, and a guard checks the decision for every other variant. For numbers of fixed sign, the
guard compares the difference with its terms. For numbers of any sign, it compares the difference
with the size, which is calculated only for guards.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cache
from typing import Any

from vstatics.core.numerics.signed import (
    Either,
    Signed,
    guard_equal,
    guarded_sum,
    size_of,
    value_of,
)
from vstatics.core.numerics.tape import Untraceable
from vstatics.core.numerics.tolerances import (
    EPSILON,
    PIVOT,
    SIGNED_LEAST,
    SIGNED_PIVOT,
    SIGNED_SAME,
    TRACED_DIFFERENCE,
    TRACED_REAL,
    TRACED_SAME,
    UNCERTAIN,
    ZERO,
)
from vstatics.core.numerics.traced import (
    Number,
    Traced,
    absolute,
    difference,
    first,
    guard_same,
    is_exact,
    is_traced,
    of_any_sign,
    operand_of,
    plain,
)
from vstatics.core.start import NamedTuple

Entry = tuple[Number, Any]
"""Value, and the magnitude to which its rounding error is proportional.

The magnitude is a float, or a `LaterSize` if it depends on signs that are not known yet.
"""
Row = dict[int, Entry]
"""Entries of an equation by column."""
Coefficient = Number | tuple[Number, ...]
"""Coefficient of an equation: a number, or the terms of a sum."""
Equation = Mapping[int, Coefficient]
"""Coefficients of ``sum(a_j x_j) = b`` by column; b has the column `RIGHT`."""
RIGHT = -1
"""Column of the right-hand side."""
NOTHING: Entry = (0.0, 0.0)
EXACTLY_ONE: Entry = (1.0, 0.0)
"""Entry of the value 1 without rounding error."""


class Solution(NamedTuple):
    """Solution of a system, with NaN for values that the system does not determine."""

    values: list[Number]
    """Values of the unknowns, then of the requested sums; NaN if not unique."""
    consistent: bool
    """True if the equations are consistent."""
    missing: int
    """Number of missing equations: number of unknowns minus rank."""
    excess: int
    """Number of redundant or contradictory equations: number of equations minus rank."""


def solve(
    equations: Sequence[Equation],
    unknowns: int,
    sums: Sequence[Mapping[int, Number]] = (),
    arithmetic: Arithmetic | None = None,
) -> Solution:
    """Solve a system for all unknowns and sums of unknowns that have a unique value.

    Parameters
    ----------
    equations : sequence of Equation
        Equations with floats or traced numbers.
    unknowns : int
        Number of unknowns, columns 0 to unknowns - 1.
    sums : sequence of mapping
        Sums to be calculated, as coefficients by column. A difference of two unknowns can be unique
        even if neither unknown is.
    arithmetic : Arithmetic, optional
        Arithmetic of the entries. Default: the arithmetic for the type of the numbers.

    Examples
    --------
    Two equations give x0 - x1 = 1 and x2 = 5; x0 and x1 are indeterminate, their difference is not.

    >>> equations = [{0: 1.0, 1: -1.0, RIGHT: 1.0}, {2: 2.0, RIGHT: 10.0}]
    >>> solve(equations, 3, sums=[{0: 1.0, 1: -1.0}])
    Solution(values=[nan, nan, 5.0, 1.0], consistent=True, missing=1, excess=0)
    """
    return solve_with_certainty(equations, unknowns, sums, arithmetic)[0]


def solve_with_certainty(
    equations: Sequence[Equation],
    unknowns: int,
    sums: Sequence[Mapping[int, Number]] = (),
    arithmetic: Arithmetic | None = None,
) -> tuple[Solution, bool]:
    """Solve a system, and return whether all pivots and values have enough correct digits."""
    arithmetic = arithmetic or arithmetic_of(equations)
    run = _Elimination([row_of(equation, arithmetic) for equation in equations], arithmetic)
    consistent = run.consistent()
    values: list[Number] = [math.nan] * (unknowns + len(sums))
    decisive = [pivot for _, pivot, _ in run.pivots]
    decisive += [row[RIGHT] for row in run.left if RIGHT in row]
    if consistent:
        entries = run.values(unknowns, sums)
        values = [value for value, _ in entries]
        decisive += entries
    solution = Solution(values, consistent, unknowns - len(run.pivots), len(run.left))
    return solution, arithmetic is EXACT or all(map(_has_digits, decisive))


def _has_digits(entry: Entry) -> bool:
    """Return whether a number has enough correct digits, or is NaN because it does not exist."""
    value, size = entry
    if not value.__class__ is size.__class__ is float:
        value, size = _of_first_variant(entry)
    return not EPSILON * size > UNCERTAIN * abs(value)


def arithmetic_of(equations: Iterable[Equation]) -> Arithmetic:
    """Return the arithmetic that the type of the numbers in equations requires."""
    for equation in equations:
        for coefficient in equation.values():
            for term in coefficient if isinstance(coefficient, tuple) else (coefficient,):
                if term.__class__ is float or term.__class__ is int:
                    continue
                if is_traced(term):
                    return SIGNED if isinstance(term, Signed) else TRACED
                if is_exact(term):
                    return EXACT
    return FLOATS


def in_free_unknowns(equations: Sequence[Equation], unknowns: int) -> list[dict[int, float]]:
    """Return each unknown of homogeneous equations as a linear combination of free unknowns.

    Examples
    --------
    >>> in_free_unknowns([{0: 1.0, 1: 2.5, 2: -3.5}], 3)
    [{1: -2.5, 2: 3.5}, {1: 1.0}, {2: 1.0}]
    """
    run = _Elimination([row_of(equation, FLOATS) for equation in equations], FLOATS)
    known = run.by_free_unknowns(unknowns)
    rows = [known[unknown] for unknown in range(unknowns)]
    return [{column: float(entry[0]) for column, entry in row.items()} for row in rows]  # type: ignore[arg-type] # floats only


def dependencies(equations: Sequence[Equation]) -> Iterator[tuple[list[int], bool]]:
    """Find redundant and contradictory equations.

    For each redundant equation, yield the indices of equations whose weighted sum contains no
    unknown, and whether the sum of their right-hand sides is 0.
    """
    marked = [
        row_of({**equation, -2 - number: 1.0}, FLOATS) for number, equation in enumerate(equations)
    ]
    for left in _Elimination(marked, FLOATS).left:
        yield sorted(-2 - column for column in left if column < RIGHT), RIGHT not in left


class _Elimination:
    """Elimination of a system.

    `pivots` contains the column, the pivot entry and the other entries of each pivot row, in the
    order of elimination. `left` contains the remaining rows, which have no unknowns.
    """

    def __init__(self, rows: Sequence[Row], arithmetic: Arithmetic) -> None:
        self.arithmetic = arithmetic
        self.pivots: list[tuple[int, Entry, Row]] = []
        self.left: list[Row] = []
        active: list[Row] = []
        remains = arithmetic.remains
        for row in rows:
            entries = {column: e for column, e in row.items() if remains(e[0])}
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
        less, remains = self.arithmetic.less, self.arithmetic.remains
        for column, term in other.items():
            entry = less(row.pop(column, NOTHING), factor, term)
            if remains(entry[0]):
                row[column] = entry

    def consistent(self) -> bool:
        """Return whether all rows without unknowns have the right-hand side 0."""
        return not any(RIGHT in row for row in self.left)

    def by_free_unknowns(self, unknowns: int) -> dict[int, Row]:
        """Return each unknown as a linear combination of free unknowns and a constant.

        The constant is under the column `RIGHT`.
        """
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

    def values(self, unknowns: int, sums: Sequence[Mapping[int, Number]]) -> list[Entry]:
        """Return each unknown and each sum; NaN if it depends on a free unknown."""
        known = self.by_free_unknowns(unknowns)
        totals = [known[column] for column in range(unknowns)]
        for terms in sums:
            summed: Row = {}
            for column, coefficient in terms.items():
                self._subtract(summed, (-coefficient, 0.0), known[column])
            totals.append(summed)
        return [
            (math.nan, 0.0) if max(row, default=RIGHT) >= 0 else row.get(RIGHT, NOTHING)
            for row in totals
        ]


def _choose(active: Sequence[Row], arithmetic: Arithmetic) -> tuple[Row, int]:
    """Return the row and column of the next pivot.

    Candidates are sufficiently large entries of the shortest rows. The candidate with the least
    fill-in is chosen (Markowitz).
    """
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
    return candidates[0], max(candidates[0])  # only reached if an overflow left no number


def row_of(equation: Equation, arithmetic: Arithmetic) -> Row:
    """Return the entries of an equation.

    >>> row_of({0: 2.0, 1: (1.5, -1.0)}, FLOATS)
    {0: (2.0, 2.0), 1: (0.5, 2.5)}
    """
    entry = arithmetic.entry
    return {
        column: _sum_of_terms(coefficient, arithmetic)
        if isinstance(coefficient, tuple)
        else entry(coefficient)
        for column, coefficient in equation.items()
    }


def _sum_of_terms(terms: Sequence[Number], arithmetic: Arithmetic) -> Entry:
    total = arithmetic.entry(terms[0])
    for term in terms[1:]:
        total = arithmetic.less(total, EXACTLY_ONE, arithmetic.entry(-term))
    return total


class Arithmetic(NamedTuple):
    """Operations of an elimination on entries."""

    entry: Callable[[Number], Entry]
    """Function that returns the entry of a number."""
    quotient: Callable[[Entry, Entry], Entry]
    less: Callable[[Entry, Entry, Entry], Entry]
    """Function that returns a - b * c from (a, b, c); exactly 0 if only rounding errors remain."""
    enough: Callable[[Number, Number], bool]
    """Function that returns whether a number can be the pivot of a row with a second number."""
    remains: Callable[[Number], bool]
    """Function that returns whether a number is nonzero in some variant."""


FloatEntry = tuple[float, float]
"""Value and size of an entry for a single variant."""


def _float_entry(number: float) -> FloatEntry:
    return float(number), abs(number)


def quotient_of_floats(entry: FloatEntry, pivot: FloatEntry) -> FloatEntry:
    """Return an entry divided by a pivot."""
    value, size = entry
    divisor, pivot_size = pivot
    ratio = value / divisor
    return ratio, (size + abs(ratio) * pivot_size) / abs(divisor)


def less_of_floats(entry: FloatEntry, factor: FloatEntry, term: FloatEntry) -> FloatEntry:
    """Return a - b * c from (a, b, c), for `Arithmetic.less`."""
    value, size = entry
    a, factor_size = factor
    b, term_size = term
    product = a * b
    size += factor_size * abs(b) + abs(a) * term_size
    left = value - product
    if abs(left) > ZERO * size:  # this is the usual case
        return left, size
    rounding = min(ZERO * size, TRACED_REAL * max(abs(value), abs(product)))
    return (0.0 if abs(left) <= rounding < math.inf else left), size


def large_enough(pivot: Number, other: Number) -> bool:
    """Return whether a number can be the pivot of a row with a second number."""
    return bool(absolute(pivot) >= PIVOT * absolute(other))


FLOATS = Arithmetic(_float_entry, quotient_of_floats, less_of_floats, large_enough, bool)  # type: ignore[arg-type]
"""Arithmetic of floats, for equations without traced numbers."""


def _remains(number: Number) -> bool:
    return is_traced(number) or number != 0


def _traced_entry(number: Number) -> Entry:
    return (number, first(number)) if isinstance(number, Traced) else _float_entry(plain(number))


def _traced_quotient(entry: Entry, pivot: Entry) -> Entry:
    ratio = entry[0] / pivot[0]
    return ratio, quotient_of_floats(_of_first_variant(entry), _of_first_variant(pivot))[1]


def _traced_less(entry: Entry, factor: Entry, term: Entry) -> Entry:
    value, product = entry[0], factor[0] * term[0]
    left, size = less_of_floats(*map(_of_first_variant, (entry, factor, term)))
    if not (is_traced(value) or is_traced(product)):
        return left, size
    if not math.isfinite(left):
        raise Untraceable
    if value == 0 or product == 0 or (value > 0) != (product > 0):
        return value - product, size
    larger, smaller = (value, -product) if first(value) >= first(product) else (-product, value)
    part = 1 - first(smaller) / first(larger)
    if left == 0:
        most = min(ZERO * size / first(larger), TRACED_SAME)
        if part > most:
            raise Untraceable
        guard_same(absolute(smaller), absolute(larger), most)
        return 0.0, size
    if part <= 2 * TRACED_REAL:
        raise Untraceable
    least = max(min(TRACED_DIFFERENCE, part / 16), 1.5 * TRACED_REAL)
    return difference(larger, smaller, least), size


def _of_first_variant(entry: Entry) -> FloatEntry:
    number, size = entry
    if number.__class__ is size.__class__ is float:
        return entry  # type: ignore[return-value]
    return operand_of(number)[2], size.first if isinstance(size, LaterSize) else size


TRACED = Arithmetic(_traced_entry, _traced_quotient, _traced_less, large_enough, _remains)
"""Arithmetic of traced numbers of fixed sign, with sizes of the first variant."""


class LaterSize(NamedTuple):
    """Size of an entry in the first variant, and a function for the size in all variants."""

    first: float
    of_all: Callable[[], Either]


def _signed_entry(number: Number) -> Entry:
    signed = of_any_sign(number)
    return number, LaterSize(abs(value_of(signed)), cache(lambda: size_of(signed)))


def _signed_quotient(entry: Entry, pivot: Entry) -> Entry:
    ratio = entry[0] / pivot[0]

    @cache
    def size() -> Either:
        (_, entry_size), (divisor, pivot_size) = _of_all_variants(entry), _of_all_variants(pivot)
        return _sum_of_sizes(entry_size(), size_of(of_any_sign(ratio)) * pivot_size()) / divisor

    return ratio, LaterSize(
        quotient_of_floats(_of_first_variant(entry), _of_first_variant(pivot))[1], size
    )


def _signed_less(entry: Entry, factor: Entry, term: Entry) -> Entry:
    """Return a - b * c from (a, b, c); any sign of the difference is allowed."""
    value, product = entry[0], factor[0] * term[0]
    left, first_size = less_of_floats(
        _of_first_variant(entry), _of_first_variant(factor), _of_first_variant(term)
    )

    @cache
    def size_of_all() -> Either:
        (_, entry_size), (a, factor_size), (b, term_size) = (
            _of_all_variants(entry),
            _of_all_variants(factor),
            _of_all_variants(term),
        )
        return _sum_of_sizes(entry_size(), _sum_of_sizes(factor_size() * b, a * term_size()))

    size = LaterSize(first_size, size_of_all)
    if not (is_traced(value) or is_traced(product)):
        return left, size
    if not math.isfinite(left):
        raise Untraceable
    if value == 0 or product == 0:
        return value - product, size
    minuend, negated_product = of_any_sign(value), -of_any_sign(product)
    larger = max(abs(value_of(minuend)), abs(value_of(negated_product)))
    if left == 0:
        if abs(value_of(minuend) + value_of(negated_product)) > SIGNED_SAME * larger:
            raise Untraceable
        guard_equal(minuend, -negated_product, size.of_all() * ZERO, SIGNED_SAME)
        return 0.0, size
    part = abs(left) / larger
    if part <= 2 * TRACED_REAL:
        raise Untraceable
    most = TRACED_REAL if _is_given(minuend) and _is_given(negated_product) else SIGNED_LEAST
    return guarded_sum(minuend, negated_product, max(min(most, part / 16), 1.5 * TRACED_REAL)), size


def _of_all_variants(entry: Entry) -> tuple[Either, Callable[[], Either]]:
    """Return the magnitude of an entry in all variants, and a function for the size."""
    number, size = entry
    later = size.of_all if isinstance(size, LaterSize) else lambda: size
    return size_of(of_any_sign(number)), later


def _sum_of_sizes(a: Either, b: Either) -> Either:
    return b if a == 0 else a if b == 0 else a + b


def _is_given(number: Either) -> bool:
    """Return whether a number is a constant or an input, and so has no rounding error."""
    return not isinstance(number, Signed) or number.slot < number.tape.inputs


def _signed_enough(pivot: Number, other: Number) -> bool:
    """Return whether a number can be the pivot of a row with a second number.

    The limit is low, so that with ordinary ratios only the structure determines the order of
    pivots, which is then equal in all plans.
    """
    return abs(value_of(of_any_sign(pivot))) >= SIGNED_PIVOT * abs(value_of(of_any_sign(other)))


SIGNED = Arithmetic(_signed_entry, _signed_quotient, _signed_less, _signed_enough, _remains)
"""Arithmetic of numbers of any sign; sizes are instances of `LaterSize`."""


def _exact(number: Any) -> Any:
    """Return a number as a fraction; a float as the fraction of its shortest decimal form."""
    if is_exact(number):
        return number
    from fractions import Fraction  # the import costs start-up time

    if (value := plain(number)) in (0, 1, -1):
        return Fraction(int(value))
    return Fraction(repr(float(value)))


def _exact_quotient(entry: Entry, pivot: Entry) -> Entry:
    return _exact(entry[0]) / _exact(pivot[0]), 0.0


def _exact_less(entry: Entry, factor: Entry, term: Entry) -> Entry:
    return _exact(entry[0]) - _exact(factor[0]) * _exact(term[0]), 0.0


EXACT = Arithmetic(
    entry=lambda number: (_exact(number), 0.0),
    quotient=_exact_quotient,
    less=_exact_less,
    enough=lambda pivot, other: True,  # noqa: ARG005
    remains=bool,
)
"""Arithmetic of fractions, without rounding but slow; for few, small systems."""
