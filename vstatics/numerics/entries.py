"""Entries of linear systems: a value, and the size that tells its rounding error.

The size is the sum of the magnitudes that a value was made from. Its rounding error is
at most a few units in the last place of its size (running error analysis: Wilkinson
1963). So a difference that is small against its size is zero, unless a millionth of its
larger term is left: sizes overrate the error of long calculations.

Traced numbers need no size: a guard sees to it that what is zero, or is not, for the
first variant is so for all.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

from vstatics.numerics.tape import Untraceable
from vstatics.numerics.tolerances import LEAST, PIVOT, REAL, ZERO
from vstatics.numerics.traced import (
    Number,
    Traced,
    absolute,
    difference,
    first,
    guard_same,
    is_traced,
    plain,
)

Entry = tuple[Number, Any]
"""A value and its size, a float; of any sign see `signed_entries`."""
Row = dict[int, Entry]
"""Column -> entry of an equation."""
Coefficient = Number | tuple[Number, ...]
"""A number, or terms that have it as their sum."""
Equation = Mapping[int, Coefficient]
"""Column -> coefficient of the equation ``sum(a_j x_j) = b``; b stands in column `RIGHT`."""

RIGHT = -1
UNKNOWN = math.nan
"""The size of what was calculated from traced numbers."""
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


def row_of(equation: Equation, arithmetic: Arithmetic) -> Row:
    """An equation as entries of a system.

    >>> row_of({0: 2.0, 1: (1.5, -1.0)}, FLOATS)
    {0: (2.0, 2.0), 1: (0.5, 2.5)}
    """
    return {
        column: _total(coefficient, arithmetic)
        if isinstance(coefficient, tuple)
        else arithmetic.entry(coefficient)
        for column, coefficient in equation.items()
    }


def _total(terms: Sequence[Number], arithmetic: Arithmetic) -> Entry:
    """The sum of terms; it may be zero where they cancel."""
    total = arithmetic.entry(terms[0])
    for term in terms[1:]:
        total = arithmetic.less(total, EXACTLY_ONE, arithmetic.entry(-term))
    return total


FloatEntry = tuple[float, float]
"""An entry of one variant."""


def _entry(number: float) -> FloatEntry:
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
    rounding = min(ZERO * size, REAL * max(abs(value), abs(product)))
    return (0.0 if abs(left) <= rounding < math.inf else left), size


def large_enough(pivot: Number, other: Number) -> bool:
    """Whether a number can be the pivot of a row with another one."""
    return bool(absolute(pivot) >= PIVOT * absolute(other))


FLOATS = Arithmetic(_entry, quotient_of_floats, less_of_floats, large_enough)  # type: ignore[arg-type]
"""For equations without a traced number, as `elimination` makes sure."""


def _traced_entry(number: Number) -> Entry:
    return (number, UNKNOWN) if isinstance(number, Traced) else _entry(plain(number))


def _traced_quotient(entry: Entry, pivot: Entry) -> Entry:
    if is_traced(entry[0]) or is_traced(pivot[0]):
        return entry[0] / pivot[0], UNKNOWN
    return quotient_of_floats(entry, pivot)  # type: ignore[arg-type]


def _traced_less(entry: Entry, factor: Entry, term: Entry) -> Entry:
    untraced = not any(map(is_traced, (entry[0], factor[0], term[0])))
    if untraced and not math.isnan(entry[1] + factor[1] + term[1]):
        return less_of_floats(entry, factor, term)  # type: ignore[arg-type]
    value, product = entry[0], factor[0] * term[0]
    if not all(is_traced(one) or math.isfinite(plain(one)) for one in (value, product)):
        raise Untraceable
    if value == 0 or product == 0 or (value > 0) != (product > 0):
        return value - product, UNKNOWN
    larger, smaller = (value, -product) if first(value) >= first(product) else (-product, value)
    part = 1 - first(smaller) / first(larger)
    if part <= ZERO:
        if not untraced:
            guard_same(absolute(smaller), absolute(larger), ZERO)
        return 0.0, UNKNOWN
    if part <= 2 * REAL:
        raise Untraceable
    least = max(min(LEAST, part / 16), 1.5 * REAL)
    return value - product if untraced else difference(larger, smaller, least), UNKNOWN


TRACED = Arithmetic(_traced_entry, _traced_quotient, _traced_less, large_enough)
