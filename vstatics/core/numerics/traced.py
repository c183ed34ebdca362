"""Arithmetic that is recorded for one variant and repeated on arrays for all variants.

A calculation with `Traced` numbers instead of floats follows the first variant, while a `Tape`
records every operation. If the program branches on a comparison, the tape contains a guard: the
condition that other variants must satisfy. A variant that passes all guards would perform exactly
the recorded operations, so the replay has the same results to the last bit.

A traced number is never 0. Its sign is equal in all variants. Only its magnitude is on the tape, so
signs cost no operation. Bounds of the magnitude decide most comparisons without a guard.

With plain numbers, the functions of this module are ordinary Python arithmetic.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Collection, Sequence
from functools import reduce
from typing import Any, TypeGuard

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
from vstatics.core.start import NamedTuple


class Magnitude(NamedTuple):
    """Magnitude of a traced number: tape operand, value in the first variant, and bounds."""

    operand: Operand
    value: float
    low: float
    high: float


class Traced:
    """Number in all variants: a common sign, +1 or -1, and a magnitude on the tape."""

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
        product = Magnitude(slot, a.value * b.value, a.low * b.low, a.high * b.high)
        return Traced(self.tape, self.sign * _sign(other), product)

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
"""A float or a number for all variants, which have the same operators."""


def is_traced(number: Number | Residual | Truth) -> TypeGuard[Traced | Signed]:
    """Return whether a number represents all variants (is recorded on a tape)."""
    return number.__class__ is Traced or number.__class__ is Signed


def is_exact(number: object) -> bool:
    """Return whether a number is a fraction, without rounding errors."""
    return number.__class__ is not float and not isinstance(number, _ROUNDED)


_ROUNDED = float, int, Traced, Signed
"""Types of numbers with rounding errors."""
_OF_VARIANTS = Traced, Signed, Residual
"""Types of numbers that represent all variants."""


def is_nothing_beside(number: Number, other: Number, part: float) -> bool:
    """Return whether a magnitude is at most `part` times another; a fraction must be exactly 0.

    >>> is_nothing_beside(1e-12, 1.0, 1e-9), is_nothing_beside(1e-6, 1.0, 1e-9)
    (True, False)
    """
    return number == 0 if is_exact(number) else bool(number <= part * other)


def may_lie(number: Number, low: float, high: float) -> bool:
    """Return whether the bounds of a number allow a value from `low` to `high` in some variant.

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


absolute: Callable[[Number], Number] = abs  # type: ignore[assignment] # abs has no type for a union
"""Magnitude of a number."""


def plain(number: Number | Residual) -> float:
    """Return a number of a single variant unchanged.

    Raises
    ------
    TypeError
        If the number is traced.
    """
    if isinstance(number, _OF_VARIANTS):
        raise TypeError("a traced number stands for many variants")
    return number


def first(number: Number) -> float:
    """Return the magnitude of a number in the first variant."""
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
    return not isinstance(number, Traced) and not absolute(number) > 0


def _quotient(tape: Tape, dividend: Number, divisor: Number) -> Number:
    if _is_nothing(dividend):
        return dividend
    if _is_nothing(divisor):
        raise Untraceable
    a, b = _magnitude(dividend), _magnitude(divisor)
    sign = _sign(dividend) * _sign(divisor)
    if b.operand == Plain(1.0):
        return dividend * divisor
    if a.operand == b.operand:
        return float(sign)
    slot = tape.note("divide", a.operand, b.operand)
    high = a.high / b.low if b.low > 0 else math.inf
    return Traced(tape, sign, Magnitude(slot, a.value / b.value, a.low / b.high, high))


def _total(tape: Tape, left: Number, right: Number) -> Number:
    """Return a sum. For a difference of magnitudes, a guard states which magnitude is larger."""
    for number, remaining in ((left, right), (right, left)):
        if _is_nothing(number):
            return number if number != number else remaining  # noqa: PLR0124 - NaN
    a, b = _magnitude(left), _magnitude(right)
    if _sign(left) == _sign(right):
        slot = tape.note("add", *ordered(a.operand, b.operand))
        magnitude = Magnitude(slot, a.value + b.value, a.low + b.low, a.high + b.high)
        return Traced(tape, _sign(left), magnitude)
    larger, smaller = (left, right) if a.value >= b.value else (right, left)
    return 0.0 if larger == -smaller else difference(larger, smaller)


def difference(larger: Number, smaller: Number, least: float = 0.0) -> Traced:
    """Return the sum of two numbers of opposite sign, at least one of which is traced.

    A guard requires that the sum exceeds `least` times the larger magnitude in every variant.
    """
    tape = _tape(larger, smaller)
    a, b = _magnitude(larger), _magnitude(smaller)
    low = a.low - b.high * SURE_MAGNITUDES
    if not low > least * a.high:  # also if the upper bound is infinite
        _compare(tape, "less", absolute(smaller), absolute(larger) * (1 - least))
        low = max(least * a.low / SURE_MAGNITUDES, 0.0)
    slot = tape.note("subtract", a.operand, b.operand)
    magnitude = Magnitude(slot, a.value - b.value, low, a.high - b.low / SURE_MAGNITUDES)
    return Traced(tape, _sign(larger), magnitude)


def _tape(first_number: Number, second_number: Number) -> Tape:
    traced = first_number if isinstance(first_number, Traced) else second_number
    assert isinstance(traced, Traced)  # noqa: S101
    return traced.tape


def guard_same(number: Number, reference: Number, part: float) -> None:
    """Require that two positive numbers, of which one is traced, differ by `part` at most."""
    tape = _tape(number, reference)
    if _magnitude(number).operand != _magnitude(reference).operand:
        _compare(tape, "less_equal", number, reference * (1 + part))
        _compare(tape, "less_equal", reference * (1 - part), number)


def _compare(tape: Tape, name: str, left: Number, right: Number) -> bool:
    """Return a comparison, decided by signs or bounds, or by the first variant with a guard."""
    if _is_nothing(left) or _is_nothing(right) or math.inf in (first(left), first(right)):
        return _stand_in(left) < _stand_in(right)
    if _sign(left) != _sign(right):
        return _sign(left) < 0
    a, b = _magnitude(left), _magnitude(right)
    if _sign(left) < 0:
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
    """Return a float that can replace a number in comparisons with 0, infinity or NaN."""
    return float(number.sign if isinstance(number, Traced) else plain(number))


def _equal(tape: Tape, left: Number, right: Any) -> bool:
    if _is_nothing(right) or first(right) == math.inf or _sign(left) != _sign(right):
        return False
    a, b = _magnitude(left), _magnitude(right)
    if a.operand == b.operand:
        return True
    if a.high * SURE_MAGNITUDES < b.low or b.high * SURE_MAGNITUDES < a.low:
        return False
    tape.note("equal" if a.value == b.value else "not_equal", a.operand, b.operand)
    return a.value == b.value


def operand_of(number: Number) -> tuple[Operand, int, float]:
    """Return the tape operand, sign, and value in the first variant of a number."""
    if isinstance(number, Signed):
        return number.slot, -1 if number.negated else 1, number.value
    if isinstance(number, Traced):
        return number.magnitude.operand, number.sign, number.sign * number.magnitude.value
    sign, size = _sign(number), abs(float(number))
    return Plain(size), sign, sign * size


def sign(number: Number) -> Number:
    """Return the sign of a number (+1, -1, 0 or NaN), for numbers of any sign in each variant.

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
    """Return whether a number is a plain NaN."""
    return not isinstance(number, _OF_VARIANTS) and math.isnan(number)


def of_any_sign(number: Number) -> float | Signed:
    """Return a number unchanged if it is plain or of any sign.

    Raises
    ------
    Untraceable
        If the number is traced with a fixed sign, which a plan of any sign cannot use.
    """
    if isinstance(number, Traced):
        raise Untraceable
    return number


def chosen(condition: Condition, yes: Number, no: Number) -> Number:
    """Return `yes` if a condition is true, else `no`, in each variant.

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
    """Return a number where a condition is true, otherwise NaN; the result ends a calculation.

    >>> where(False, 2.5)
    nan
    """
    if not isinstance(condition, Truth):
        return number if condition else math.nan
    tape = condition.tape
    ways = upright(tape, condition.margin), upright(tape, of_any_sign(number)), Plain(math.nan)
    return Residual(tape, tape.note("choose", *ways), math.nan)


def opposite(condition: Condition) -> Condition:
    """Return the negation of a condition."""
    return ~condition if isinstance(condition, Truth) else not condition


def counted(conditions: Collection[Condition]) -> int:
    """Return the number of true conditions. A guard excludes variants with another number.

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
    """Return the sum of terms that should cancel, added from left to right.

    >>> residual([1.0, 0.5, -1.5])
    0.0
    """
    if all(term.__class__ is float for term in terms):
        return reduce(operator.add, terms, 0.0)
    exact: Any = [term for term in terms if is_exact(term)]
    if exact:  # large terms are fractions, which cancel without rounding
        return sum(exact) + sum(term for term in terms if not is_exact(term))  # type: ignore[no-any-return]
    plain, value = 0.0, 0.0
    total: Operand | None = None
    tape: Tape | None = None
    for term in terms:
        operand, sign, value_of_term = operand_of(term)
        value += value_of_term
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
    """Require that a number is from `low` to `high` in every variant.

    Raises
    ------
    Untraceable
        If the number is outside the bounds in the first variant.
    """
    if isinstance(number, Traced | Signed):
        held = bool(low <= number <= high)
    else:
        held = low <= number.value <= high
        number.tape.note("less_equal", Plain(low), number.slot)
        number.tape.note("less_equal", number.slot, Plain(high))
    if not held:
        raise Untraceable
