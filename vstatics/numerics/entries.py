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
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import NamedTuple

from vstatics.numerics.signed import Signed, value_of
from vstatics.numerics.tape import Untraceable
from vstatics.numerics.tolerances import (
    LEAST,
    PIVOT,
    REAL,
    SIGNED_LEAST,
    SIGNED_PIVOT,
    SIGNED_SAME,
    ZERO,
)
from vstatics.numerics.traced import (
    Number,
    Traced,
    absolute,
    difference,
    first,
    guard_same,
    is_traced,
    of_any_sign,
    plain,
)
from vstatics.numerics.watched import guard_equal, watched

Entry = tuple[Number, float]
"""A value and its size."""
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


def arithmetic_of(equations: Iterable[Equation]) -> Arithmetic:
    """The arithmetic for some equations: traced, if one of their numbers is."""
    for equation in equations:
        for coefficient in equation.values():
            terms = coefficient if isinstance(coefficient, tuple) else (coefficient,)
            for term in terms:
                if is_traced(term):
                    return SIGNED if isinstance(term, Signed) else TRACED
    return FLOATS


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


_FloatEntry = tuple[float, float]


def _entry(number: float) -> _FloatEntry:
    return float(number), abs(number)


def _quotient(entry: _FloatEntry, pivot: _FloatEntry) -> _FloatEntry:
    value, size = entry
    divisor, its_size = pivot
    ratio = value / divisor
    return ratio, (size + abs(ratio) * its_size) / abs(divisor)


def _less(entry: _FloatEntry, factor: _FloatEntry, term: _FloatEntry) -> _FloatEntry:
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


FLOATS = Arithmetic(_entry, _quotient, _less, large_enough)  # type: ignore[arg-type]
"""For equations without a traced number, as `arithmetic_of` makes sure."""


def _traced_entry(number: Number) -> Entry:
    return (number, UNKNOWN) if isinstance(number, Traced) else _entry(plain(number))


def _traced_quotient(entry: Entry, pivot: Entry) -> Entry:
    if is_traced(entry[0]) or is_traced(pivot[0]):
        return entry[0] / pivot[0], UNKNOWN
    return _quotient(entry, pivot)  # type: ignore[arg-type]


def _traced_less(entry: Entry, factor: Entry, term: Entry) -> Entry:
    untraced = not any(map(is_traced, (entry[0], factor[0], term[0])))
    if untraced and not math.isnan(entry[1] + factor[1] + term[1]):
        return _less(entry, factor, term)  # type: ignore[arg-type]
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


def _first(entry: Entry) -> _FloatEntry:
    """An entry as it is in the first variant, whose sizes signed numbers carry."""
    return value_of(of_any_sign(entry[0])), entry[1]


def _signed_entry(number: Number) -> Entry:
    return number, abs(value_of(of_any_sign(number)))


def _signed_quotient(entry: Entry, pivot: Entry) -> Entry:
    return entry[0] / pivot[0], _quotient(_first(entry), _first(pivot))[1]


def _signed_less(entry: Entry, factor: Entry, term: Entry) -> Entry:
    """As for the first variant; the sign of what is left decides nothing."""
    value, product = entry[0], factor[0] * term[0]
    left, size = _less(_first(entry), _first(factor), _first(term))
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
        # sizes of others may be larger
        guard_equal(one, -other, min(1.5 * ZERO * size / larger, SIGNED_SAME))
        return 0.0, size
    part = abs(left) / larger
    if part <= 2 * REAL:
        raise Untraceable
    return watched(one, other, max(min(SIGNED_LEAST, part / 16), 1.5 * REAL)), size


def _signed_enough(pivot: Number, other: Number) -> bool:
    """For ordinary ratios the structure alone decides, so that all such plans are alike."""
    return abs(value_of(of_any_sign(pivot))) >= SIGNED_PIVOT * abs(value_of(of_any_sign(other)))


SIGNED = Arithmetic(_signed_entry, _signed_quotient, _signed_less, _signed_enough)
