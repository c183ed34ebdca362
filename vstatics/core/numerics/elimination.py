"""Sparse Gauss elimination of small linear systems that need not be regular; their entries.

It knows nothing of transmissions. Rows are sparse; the arithmetic of their entries
(see `Entry`) tells whether an entry is zero, and that decides rank and consistency
without any scale chosen from outside. Pivots are chosen by the structure, as far as
their magnitude allows, so that variants of one structure take the same way.

The size is the sum of the magnitudes that a value was made from. Its rounding error is
at most a few units in the last place of its size (running error analysis: Wilkinson
1963). So a difference of no more than a unit in the last place of its size is zero, unless
a millionth of its larger term is left: sizes overrate the error of long calculations. What is
larger, and yet so small that few digits are left, is told by `solve_told`.

Whether a difference of traced numbers is zero is decided for the first variant as for floats.
For the others it is guarded: by parts of the terms, or, of any sign, by their own sizes, which
are calculated only where a guard asks for one.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

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
    return solve_told(equations, unknowns, sums, arithmetic)[0]


def solve_told(
    equations: Sequence[Equation],
    unknowns: int,
    sums: Sequence[Mapping[int, Number]] = (),
    arithmetic: Arithmetic | None = None,
) -> tuple[Solution, bool]:
    """What `solve` gives, and whether rounding leaves digits of each pivot and each value."""
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


def arithmetic_of(equations: Iterable[Equation]) -> Arithmetic:
    """The arithmetic for some equations: that of the first number that is no float."""
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
            entries = {column: e for column, e in row.items() if arithmetic.remains(e[0])}
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
        less, remains = self.arithmetic.less, self.arithmetic.remains
        for column, term in other.items():
            entry = less(row.pop(column, NOTHING), factor, term)
            if remains(entry[0]):
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

    def values(self, unknowns: int, sums: Sequence[Mapping[int, Number]]) -> list[Entry]:
        """Each unknown and sum, NaN where it hangs on a free unknown."""
        known = self.by_free_unknowns(unknowns)
        wanted = [known[column] for column in range(unknowns)]
        for terms in sums:
            summed: Row = {}
            for column, coefficient in terms.items():
                self._subtract(summed, (-coefficient, 0.0), known[column])
            wanted.append(summed)
        return [_value_of_sum(row) for row in wanted]


NOTHING: Entry = (0.0, 0.0)


def _value_of_sum(row: Row) -> Entry:
    """The value of what depends on no free unknown."""
    if max(row, default=RIGHT) >= 0:
        return math.nan, 0.0
    return row.get(RIGHT, NOTHING)


def _has_digits(entry: Entry) -> bool:
    """Whether rounding leaves digits of a number, by its size; of what does not exist, too."""
    value, size = _of_first_variant(entry)
    return not EPSILON * size > UNCERTAIN * abs(value)


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


Entry = tuple[Number, Any]
"""A value and its size, a float; of any sign see `SIGNED`."""
Row = dict[int, Entry]
"""Column -> entry of an equation."""
Coefficient = Number | tuple[Number, ...]
"""A number, or terms that have it as their sum."""
Equation = Mapping[int, Coefficient]
"""Column -> coefficient of the equation ``sum(a_j x_j) = b``; b stands in column `RIGHT`."""

RIGHT = -1
EXACTLY_ONE: Entry = (1.0, 0.0)
"""A factor that adds no rounding."""


class Arithmetic(NamedTuple):
    """What an elimination does with entries."""

    entry: Callable[[Number], Entry]
    """A given number as an entry."""
    quotient: Callable[[Entry, Entry], Entry]
    less: Callable[[Entry, Entry, Entry], Entry]
    """``less(a, b, c)`` is a - b * c; exactly 0 where that is only rounding."""
    enough: Callable[[Number, Number], bool]
    """Whether a number is large enough as pivot beside another one."""
    remains: Callable[[Number], bool]
    """Whether a number is not exactly 0 in all variants."""


def row_of(equation: Equation, arithmetic: Arithmetic) -> Row:
    """An equation as entries of a system.

    >>> row_of({0: 2.0, 1: (1.5, -1.0)}, FLOATS)
    {0: (2.0, 2.0), 1: (0.5, 2.5)}
    """
    return {
        column: _sum_of_terms(coefficient, arithmetic)
        if isinstance(coefficient, tuple)
        else arithmetic.entry(coefficient)
        for column, coefficient in equation.items()
    }


def _sum_of_terms(terms: Sequence[Number], arithmetic: Arithmetic) -> Entry:
    """The sum of terms; it may be zero where they cancel."""
    total = arithmetic.entry(terms[0])
    for term in terms[1:]:
        total = arithmetic.less(total, EXACTLY_ONE, arithmetic.entry(-term))
    return total


FloatEntry = tuple[float, float]
"""An entry of one variant."""


def _float_entry(number: float) -> FloatEntry:
    return float(number), abs(number)


def quotient_of_floats(entry: FloatEntry, pivot: FloatEntry) -> FloatEntry:
    """An entry by a pivot, of one variant."""
    value, size = entry
    divisor, its_size = pivot
    ratio = value / divisor
    return ratio, (size + abs(ratio) * its_size) / abs(divisor)


def less_of_floats(entry: FloatEntry, factor: FloatEntry, term: FloatEntry) -> FloatEntry:
    """What `Arithmetic.less` gives for one variant."""
    value, size = entry
    a, its_size = factor
    b, last_size = term
    product = a * b
    size += its_size * abs(b) + abs(a) * last_size
    left = value - product
    rounding = min(ZERO * size, TRACED_REAL * max(abs(value), abs(product)))
    return (0.0 if abs(left) <= rounding < math.inf else left), size


def large_enough(pivot: Number, other: Number) -> bool:
    """Whether a number can be the pivot of a row with another one."""
    return bool(absolute(pivot) >= PIVOT * absolute(other))


FLOATS = Arithmetic(_float_entry, quotient_of_floats, less_of_floats, large_enough, bool)  # type: ignore[arg-type]
"""For equations without a traced number, as `elimination` makes sure."""


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


TRACED = Arithmetic(_traced_entry, _traced_quotient, _traced_less, large_enough, _remains)


class LaterSize:
    """The size of an entry: in the first variant, and in all of them when it is asked for."""

    __slots__ = ("_made", "_make", "first")

    def __init__(self, first: float, make: Callable[[], Either]) -> None:
        self.first = first
        self._make = make
        self._made: Either | None = None

    def of_all(self) -> Either:
        """The size of each variant."""
        if self._made is None:
            self._made = self._make()
        return self._made


def _of_first_variant(entry: Entry) -> FloatEntry:
    """An entry as it is in the first variant."""
    number, size = entry
    if number.__class__ is size.__class__ is float:
        return entry  # type: ignore[return-value]
    return operand_of(number)[2], size.first if isinstance(size, LaterSize) else size


def _of_all_variants(entry: Entry) -> tuple[Either, Callable[[], Either]]:
    """The magnitude of an entry and its size in all variants."""
    number, size = entry
    later = size.of_all if isinstance(size, LaterSize) else lambda: size
    return size_of(of_any_sign(number)), later


def _signed_entry(number: Number) -> Entry:
    own = of_any_sign(number)
    return number, LaterSize(abs(value_of(own)), lambda: size_of(own))


def _signed_quotient(entry: Entry, pivot: Entry) -> Entry:
    ratio = entry[0] / pivot[0]

    def size() -> Either:
        (_, own), (divisor, its_size) = _of_all_variants(entry), _of_all_variants(pivot)
        return _sum_of_sizes(own(), size_of(of_any_sign(ratio)) * its_size()) / divisor

    return ratio, LaterSize(
        quotient_of_floats(_of_first_variant(entry), _of_first_variant(pivot))[1], size
    )


def _signed_less(entry: Entry, factor: Entry, term: Entry) -> Entry:
    """The sign of what is left decides nothing."""
    value, product = entry[0], factor[0] * term[0]
    left, first_size = less_of_floats(
        _of_first_variant(entry), _of_first_variant(factor), _of_first_variant(term)
    )

    def size_of_all() -> Either:
        (_, own), (a, its_size), (b, last_size) = (
            _of_all_variants(entry),
            _of_all_variants(factor),
            _of_all_variants(term),
        )
        return _sum_of_sizes(own(), _sum_of_sizes(its_size() * b, a * last_size()))

    size = LaterSize(first_size, size_of_all)
    if not (is_traced(value) or is_traced(product)):
        return left, size
    if not math.isfinite(left):
        raise Untraceable
    if value == 0 or product == 0:
        return value - product, size
    one, other = of_any_sign(value), -of_any_sign(product)
    larger = max(abs(value_of(one)), abs(value_of(other)))
    if left == 0:
        if abs(value_of(one) + value_of(other)) > SIGNED_SAME * larger:
            raise Untraceable
        guard_equal(one, -other, size.of_all() * ZERO, SIGNED_SAME)
        return 0.0, size
    part = abs(left) / larger
    if part <= 2 * TRACED_REAL:
        raise Untraceable
    most = TRACED_REAL if _is_given(one) and _is_given(other) else SIGNED_LEAST
    return guarded_sum(one, other, max(min(most, part / 16), 1.5 * TRACED_REAL)), size


def _is_given(number: Either) -> bool:
    """Whether a number has no rounding error: a plain one or an input."""
    return not isinstance(number, Signed) or number.slot < number.tape.inputs


def _sum_of_sizes(one: Either, other: Either) -> Either:
    return other if one == 0 else one if other == 0 else one + other


def _signed_enough(pivot: Number, other: Number) -> bool:
    """For ordinary ratios the structure alone decides, so that all such plans are alike."""
    return abs(value_of(of_any_sign(pivot))) >= SIGNED_PIVOT * abs(value_of(of_any_sign(other)))


SIGNED = Arithmetic(_signed_entry, _signed_quotient, _signed_less, _signed_enough, _remains)


def _exact(number: Any) -> Any:
    """A number as a fraction, of a float that of the decimals that it shows."""
    if is_exact(number):
        return number
    from fractions import Fraction  # they cost start-up time

    return Fraction(repr(float(plain(number))))


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
"""Fractions, without rounding: for few and small systems, as it is slow."""
