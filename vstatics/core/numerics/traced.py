"""Arithmetic written down once, to be run again on arrays; choices and residuals of numbers.

A calculation with `Traced` numbers in place of floats goes as it does with the floats
of one variant, the first; a `Tape` notes every operation. Where the calculation
decides something by a comparison the tape notes a guard. For the variants that pass
all guards the operations on the tape are those that the calculation itself would make,
so the results agree to the last bit.

A traced number is never 0. It is a positive magnitude on the tape with a known sign,
so signs cost no operation, and it has bounds for its magnitude, which settle most
comparisons without a guard.

For plain numbers each of these is what Python has for it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Sequence
from typing import Any, NamedTuple, TypeGuard

from vstatics.core.numerics.signed import Condition, Signed, Truth, bounds_of, upright, value_of
from vstatics.core.numerics.tape import (
    HUGE,
    NEGATIONS,
    Operand,
    Plain,
    Residual,
    Tape,
    Untraceable,
    ordered,
)
from vstatics.core.numerics.tolerances import SURE_MAGNITUDES


class Magnitude(NamedTuple):
    """Where a magnitude stands, its value in the first variant, its bounds in all."""

    operand: Operand
    value: float
    low: float
    high: float


class Traced:
    """A number per variant: a sign, +1 or -1 for all of them, and a magnitude."""

    __slots__ = ("magnitude", "sign", "tape")
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, tape: Tape, sign: int, magnitude: Magnitude) -> None:
        if not 1 / HUGE < magnitude.value < HUGE:
            raise Untraceable
        self.tape = tape
        self.sign = sign
        self.magnitude = magnitude

    def __neg__(self) -> Traced:
        return Traced(self.tape, -self.sign, self.magnitude)

    def __abs__(self) -> Traced:
        return Traced(self.tape, 1, self.magnitude)

    def __mul__(self, other: Number) -> Number:
        if _is_nothing(other):
            return other
        if not is_traced(other) and abs(other) == 1:
            return self if other > 0 else -self
        a, b = self.magnitude, _magnitude(other)
        slot = self.tape.note("multiply", *ordered(a.operand, b.operand))
        made = Magnitude(slot, a.value * b.value, a.low * b.low, a.high * b.high)
        return Traced(self.tape, self.sign * _sign(other), made)

    __rmul__ = __mul__

    def __truediv__(self, other: Number) -> Number:
        return _quotient(self.tape, self, other)

    def __rtruediv__(self, other: Number) -> Number:
        return _quotient(self.tape, other, self)

    def __add__(self, other: Number) -> Number:
        return _total(self.tape, self, other)

    __radd__ = __add__

    def __sub__(self, other: Number) -> Number:
        return _total(self.tape, self, -other)

    def __rsub__(self, other: Number) -> Number:
        return _total(self.tape, other, -self)

    def __lt__(self, other: Number) -> bool:
        return _compare(self.tape, "less", self, other)

    def __gt__(self, other: Number) -> bool:
        return _compare(self.tape, "less", other, self)

    def __le__(self, other: Number) -> bool:
        return _compare(self.tape, "less_equal", self, other)

    def __ge__(self, other: Number) -> bool:
        return _compare(self.tape, "less_equal", other, self)

    def __eq__(self, other: object) -> bool:
        return _equal(self.tape, self, other)

    def __ne__(self, other: object) -> bool:
        return not _equal(self.tape, self, other)


Number = float | Traced | Signed
"""A float, or a number that stands for all variants: the operators are the same."""


def is_traced(number: Number | Residual | Truth) -> TypeGuard[Traced | Signed]:
    """Whether it stands for all variants."""
    return number.__class__ is Traced or number.__class__ is Signed


def is_exact(number: object) -> bool:
    """Whether it is a fraction, of one variant: what is 0 then is exactly 0."""
    return number.__class__ is not float and not isinstance(number, _ROUNDED)


_ROUNDED = float, int, Traced, Signed


def is_nothing_beside(number: Number, other: Number, part: float) -> bool:
    """Whether a magnitude is no more than a part of another one; of fractions: whether it is 0.

    >>> is_nothing_beside(1e-12, 1.0, 1e-9), is_nothing_beside(1e-6, 1.0, 1e-9)
    (True, False)
    """
    return number == 0 if is_exact(number) else bool(number <= part * other)


def may_lie(number: Number, low: float, high: float) -> bool:
    """Whether a number lies between two others, in one of the variants as far as bounds tell.

    >>> may_lie(0.5, 0.0, 1.0), may_lie(0.5, 0.0, 0.25)
    (True, False)
    """
    if isinstance(number, Signed):
        least, most = bounds_of(number)
    elif isinstance(number, Traced):
        ends = number.sign * number.magnitude.low, number.sign * number.magnitude.high
        least, most = min(ends), max(ends)
    else:
        least = most = number
    return least < high and most > low


absolute: Callable[[Number], Number] = abs  # type: ignore[assignment] # on a union it has none
"""Magnitude of a number."""


def plain(number: Number | Residual) -> float:
    """A number of a single variant, which is not traced.

    Raises
    ------
    TypeError
        If it is.
    """
    if isinstance(number, Traced | Signed | Residual):
        raise TypeError("a traced number stands for many variants")
    return number


def first(number: Number) -> float:
    """The magnitude in the first variant."""
    return _magnitude(number).value


def _magnitude(number: Number) -> Magnitude:
    if isinstance(number, Traced):
        return number.magnitude
    size = abs(float(plain(number)))
    return Magnitude(Plain(size), size, size, size)


def _sign(number: Number) -> int:
    if isinstance(number, Traced):
        return number.sign
    return 1 if plain(number) >= 0 else -1


def _is_nothing(number: Number) -> bool:
    """Whether it is a plain 0 or NaN, with which there is nothing to calculate."""
    return not isinstance(number, Traced) and not absolute(number) > 0


def _quotient(tape: Tape, one: Number, other: Number) -> Number:
    if _is_nothing(one):
        return one
    if _is_nothing(other):
        raise Untraceable
    a, b = _magnitude(one), _magnitude(other)
    sign = _sign(one) * _sign(other)
    if b.operand == Plain(1.0):
        return one * other
    if a.operand == b.operand:
        return float(sign)
    slot = tape.note("divide", a.operand, b.operand)
    high = a.high / b.low if b.low > 0 else math.inf
    return Traced(tape, sign, Magnitude(slot, a.value / b.value, a.low / b.high, high))


def _total(tape: Tape, one: Number, other: Number) -> Number:
    """A sum; where magnitudes are subtracted the larger one is guarded to be larger."""
    for number, left in ((one, other), (other, one)):
        if _is_nothing(number):
            return number if number != number else left  # noqa: PLR0124 - NaN
    a, b = _magnitude(one), _magnitude(other)
    if _sign(one) == _sign(other):
        slot = tape.note("add", *ordered(a.operand, b.operand))
        made = Magnitude(slot, a.value + b.value, a.low + b.low, a.high + b.high)
        return Traced(tape, _sign(one), made)
    larger, smaller = (one, other) if a.value >= b.value else (other, one)
    return 0.0 if larger == -smaller else difference(larger, smaller)


def difference(larger: Number, smaller: Number, least: float = 0.0) -> Traced:
    """The sum of numbers of unlike sign, that leaves more than the part `least` of the larger.

    At least one of them is traced. Guards see to it for all variants.
    """
    tape = _tape(larger, smaller)
    a, b = _magnitude(larger), _magnitude(smaller)
    left = a.low - b.high * SURE_MAGNITUDES
    if not left > least * a.high:  # also where there is no upper bound
        _compare(tape, "less", absolute(smaller), absolute(larger) * (1 - least))
        left = max(least * a.low / SURE_MAGNITUDES, 0.0)
    slot = tape.note("subtract", a.operand, b.operand)
    made = Magnitude(slot, a.value - b.value, left, a.high - b.low / SURE_MAGNITUDES)
    return Traced(tape, _sign(larger), made)


def _tape(one: Number, other: Number) -> Tape:
    """The tape of two numbers, one of which is traced."""
    traced = one if isinstance(one, Traced) else other
    assert isinstance(traced, Traced)  # noqa: S101
    return traced.tape


def guard_same(one: Number, other: Number, part: float) -> None:
    """Guard that two numbers above 0, one of them traced, differ by no more than a part."""
    tape = _tape(one, other)
    if _magnitude(one).operand != _magnitude(other).operand:
        _compare(tape, "less_equal", one, other * (1 + part))
        _compare(tape, "less_equal", other * (1 - part), one)


def _compare(tape: Tape, name: str, one: Number, other: Number) -> bool:
    """Decide a comparison by sign, by bounds, or by the first variant with a guard."""
    if _is_nothing(one) or _is_nothing(other) or math.inf in (first(one), first(other)):
        return _stand_in(one) < _stand_in(other)
    if _sign(one) != _sign(other):
        return _sign(one) < 0
    a, b = _magnitude(one), _magnitude(other)
    if _sign(one) < 0:
        a, b = b, a
    if a.high * SURE_MAGNITUDES < b.low:
        return True
    if a.low > b.high * SURE_MAGNITUDES:
        return False
    if a.value < b.value or (a.value == b.value and name == "less_equal"):
        tape.note(name, a.operand, b.operand)
        return True
    tape.note(NEGATIONS[name], b.operand, a.operand)
    return False


def _stand_in(number: Number) -> float:
    """A number to compare with 0, infinity or NaN, for all variants alike."""
    return float(number.sign if isinstance(number, Traced) else plain(number))


def _equal(tape: Tape, one: Number, other: Any) -> bool:
    """Whether two numbers are the same."""
    if _is_nothing(other) or first(other) == math.inf or _sign(one) != _sign(other):
        return False
    a, b = _magnitude(one), _magnitude(other)
    if a.operand == b.operand:
        return True
    if a.high * SURE_MAGNITUDES < b.low or b.high * SURE_MAGNITUDES < a.low:
        return False
    tape.note("equal" if a.value == b.value else "not_equal", a.operand, b.operand)
    return a.value == b.value


def operand_of(number: Number) -> tuple[Operand, int, float]:
    """What of a number stands on the tape, its sign there, its value in the first variant."""
    if isinstance(number, Signed):
        return number.slot, -1 if number.negated else 1, number.value
    return _magnitude(number).operand, _sign(number), _sign(number) * first(number)


def sign(number: Number) -> Number:
    """+1, -1 or 0, or NaN; of numbers of any sign one for each variant.

    >>> [sign(number) for number in (-2.5, 0.0, 3.0)]
    [-1.0, 0.0, 1.0]
    """
    if isinstance(number, Signed):
        return number.direction
    if number > 0:
        return 1.0
    if number < 0:
        return -1.0
    return 0.0 if number == 0 else math.nan


def is_nan(number: Number) -> bool:
    """Whether there is no number."""
    return not isinstance(number, Traced | Signed) and math.isnan(number)


def of_any_sign(number: Number) -> float | Signed:
    """A number that is not traced with a sign.

    Raises
    ------
    Untraceable
        If it is: a plan of any sign knows none.
    """
    if isinstance(number, Traced):
        raise Untraceable
    return number


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


def where(condition: Condition, number: Number) -> Number | Residual:
    """A number where something holds, else NaN: a result, with which nothing is done.

    >>> where(False, 2.5)
    nan
    """
    if not isinstance(condition, Truth):
        return number if condition else math.nan
    tape = condition.tape
    ways = upright(tape, condition.margin), upright(tape, of_any_sign(number)), Plain(math.nan)
    return Residual(tape, tape.note("choose", *ways), math.nan)


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


def residual(terms: Sequence[Number]) -> Number | Residual:
    """The sum of terms that should cancel, from left to right.

    >>> residual([1.0, 0.5, -1.5])
    0.0
    """
    exact: Any = [term for term in terms if is_exact(term)]
    if exact:  # the large ones; they cancel without rounding
        return sum(exact) + sum(term for term in terms if not is_exact(term))  # type: ignore[no-any-return]
    plain, value = 0.0, 0.0
    total: Operand | None = None
    tape: Tape | None = None
    for term in terms:
        operand, sign, own = operand_of(term)
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
    return Residual(tape, total, value)


def guard_within(number: Traced | Signed | Residual, low: float, high: float) -> None:
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
