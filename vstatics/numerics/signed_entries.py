"""Entries of linear systems for variants of any sign: zero is decided by the size of each.

Whether a difference is zero is decided for the first variant as for floats, and guarded for
the others by their own sizes. These are calculated only where a guard asks for one.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from vstatics.numerics.entries import (
    Arithmetic,
    Entry,
    FloatEntry,
    less_of_floats,
    quotient_of_floats,
)
from vstatics.numerics.signed import Either, Signed, size_of, value_of
from vstatics.numerics.tape import Untraceable
from vstatics.numerics.tolerances import REAL, SIGNED_LEAST, SIGNED_PIVOT, SIGNED_SAME, ZERO
from vstatics.numerics.traced import Number, is_traced, of_any_sign
from vstatics.numerics.watched import guard_equal, watched


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


def _first(entry: Entry) -> FloatEntry:
    """An entry as it is in the first variant."""
    number, size = entry
    return value_of(of_any_sign(number)), size.first if isinstance(size, LaterSize) else size


def _of_all(entry: Entry) -> tuple[Either, Callable[[], Either]]:
    """The magnitude of an entry and its size in all variants."""
    number, size = entry
    later = size.of_all if isinstance(size, LaterSize) else lambda: size
    return size_of(of_any_sign(number)), later


def _entry(number: Number) -> Entry:
    own = of_any_sign(number)
    return number, LaterSize(abs(value_of(own)), lambda: size_of(own))


def _quotient(entry: Entry, pivot: Entry) -> Entry:
    ratio = entry[0] / pivot[0]

    def size() -> Either:
        (_, own), (divisor, its_size) = _of_all(entry), _of_all(pivot)
        return _sum(own(), size_of(of_any_sign(ratio)) * its_size()) / divisor

    return ratio, LaterSize(quotient_of_floats(_first(entry), _first(pivot))[1], size)


def _less(entry: Entry, factor: Entry, term: Entry) -> Entry:
    """The sign of what is left decides nothing."""
    value, product = entry[0], factor[0] * term[0]
    left, first_size = less_of_floats(_first(entry), _first(factor), _first(term))

    def size_of_all() -> Either:
        (_, own), (a, its_size), (b, last_size) = _of_all(entry), _of_all(factor), _of_all(term)
        return _sum(own(), _sum(its_size() * b, a * last_size()))

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
    if part <= 2 * REAL:
        raise Untraceable
    most = REAL if _is_given(one) and _is_given(other) else SIGNED_LEAST
    return watched(one, other, max(min(most, part / 16), 1.5 * REAL)), size


def _is_given(number: Either) -> bool:
    """Whether a number has no rounding error: a plain one or an input."""
    return not isinstance(number, Signed) or number.slot < number.tape.inputs


def _sum(one: Either, other: Either) -> Either:
    return other if one == 0 else one if other == 0 else one + other


def _enough(pivot: Number, other: Number) -> bool:
    """For ordinary ratios the structure alone decides, so that all such plans are alike."""
    return abs(value_of(of_any_sign(pivot))) >= SIGNED_PIVOT * abs(value_of(of_any_sign(other)))


SIGNED = Arithmetic(_entry, _quotient, _less, _enough)
