"""Sums of signed numbers that are watched: how much of their terms is left."""

from __future__ import annotations

from vstatics.numerics.signed import Either, Signed, bounds_of, size_of, upright
from vstatics.numerics.tape import Untraceable


def watched(one: Either, other: Either, part: float) -> Either:
    """The sum of two numbers, of which more than a part of the terms is left in all variants."""
    total = one + other
    if not isinstance(total, Signed):
        return total
    ends = [max(map(abs, bounds_of(number))) for number in (one, other)]
    left = max(total.low, -total.high)
    if not (left > part * max(ends) or size_of(_cheapest(one, other)) * part < size_of(total)):
        raise Untraceable
    return total


def guard_equal(one: Either, other: Either, rounding: Either, part: float) -> None:
    """Guard that two numbers, one of them signed, differ by rounding, and by a part at most."""
    if isinstance(one, Signed) and isinstance(other, Signed) and one.slot == other.slot:
        return
    tape = one.tape if isinstance(one, Signed) else other.tape  # type: ignore[union-attr]
    left = tape.note("subtract", upright(tape, one), upright(tape, other))
    left = tape.note("absolute", left, left)
    for most in (rounding, size_of(_cheapest(one, other)) * part):
        tape.note("less_equal", left, upright(tape, most))


def _cheapest(one: Either, other: Either) -> Either:
    """The number whose magnitude needs fewer steps."""
    return one if _cost(one) <= _cost(other) else other


def _cost(number: Either) -> int:
    """How many steps its magnitude needs."""
    return 0 if not isinstance(number, Signed) else 1 if number.settled else 2
