"""What differs between variants of any sign: one number or another, by what holds.

For plain numbers each of these is what Python has for it.
"""

from __future__ import annotations

import math
from collections.abc import Collection

from vstatics.numerics.signed import (
    Condition,
    Signed,
    Truth,
    bounds_of,
    upright,
    value_of,
)
from vstatics.numerics.tape import Plain, Rest, Untraceable
from vstatics.numerics.traced import Number, of_any_sign


def chosen(condition: Condition, yes: Number, no: Number) -> Number:
    """One number where something holds, another one where it does not.

    >>> chosen(2.0 > 1.0, 0.5, 0.25)
    0.5
    """
    if not isinstance(condition, Truth):
        return yes if condition else no
    yes, no = of_any_sign(yes), of_any_sign(no)
    if yes is no or not (isinstance(yes, Signed) or isinstance(no, Signed) or yes != no):
        return yes
    tape = condition.tape
    ways = [upright(tape, condition.margin), upright(tape, yes), upright(tape, no)]
    value = value_of(yes if condition.margin.value > 0 else no)
    (low, high), (other_low, other_high) = bounds_of(yes), bounds_of(no)
    slot = tape.note("choose", *ways)
    return Signed(tape, slot, value, min(low, other_low), max(high, other_high))


def where(condition: Condition, number: Number) -> Number | Rest:
    """A number where something holds, else NaN: a result, with which nothing is done.

    >>> where(False, 2.5)
    nan
    """
    if not isinstance(condition, Truth):
        return number if condition else math.nan
    tape = condition.tape
    ways = upright(tape, condition.margin), upright(tape, of_any_sign(number)), Plain(math.nan)
    return Rest(tape, tape.note("choose", *ways), math.nan)


def opposite(condition: Condition) -> Condition:
    """Whether it does not hold."""
    return ~condition if isinstance(condition, Truth) else not condition


def counted(conditions: Collection[Condition]) -> int:
    """How many hold; variants in which it is another number do not pass the guard.

    >>> counted([True, False, True])
    2
    """
    total: Number = 0.0
    for condition in conditions:
        total = total + chosen(condition, 2.0, 1.0)
    count = value_of(of_any_sign(total))
    if total != count:
        raise Untraceable
    return int(count) - len(conditions)
