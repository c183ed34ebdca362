"""What is left of sums that should cancel, as results; guards that numbers lie within bounds."""

from __future__ import annotations

import math
from collections.abc import Sequence

from vstatics.numerics.signed import Signed
from vstatics.numerics.tape import Operand, Plain, Rest, Tape, Untraceable
from vstatics.numerics.traced import Number, Traced, is_traced, told


def rest(terms: Sequence[Number]) -> Number | Rest:
    """The sum of terms that should cancel, from left to right.

    >>> rest([1.0, 0.5, -1.5])
    0.0
    """
    plain, value = 0.0, 0.0
    total: Operand | None = None
    tape: Tape | None = None
    for term in terms:
        operand, sign, own = told(term)
        value += own
        if is_traced(term):
            tape = term.tape
        if tape is None or math.isnan(value):
            plain = value
        elif total is None and plain == 0 and sign > 0:
            total = operand
        elif operand != Plain(0.0):
            before = Plain(plain) if total is None else total
            total = tape.note("add" if sign > 0 else "subtract", before, operand)
    if tape is None or not isinstance(total, int) or math.isnan(value):
        return plain
    return Rest(tape, total, value)


def guard_within(number: Traced | Signed | Rest, low: float, high: float) -> None:
    """Guard that a number lies between bounds.

    Raises
    ------
    Untraceable
        If it does not in the first variant.
    """
    if isinstance(number, Traced | Signed):
        held = bool(low <= number <= high)
    else:
        held = low <= number.value <= high
        number.tape.note("less_equal", Plain(low), number.slot)
        number.tape.note("less_equal", number.slot, Plain(high))
    if not held:
        raise Untraceable
