"""Arithmetic for variants whose numbers have any sign: their bounds, guards of their sums.

A `Signed` number takes the place of a `Traced` one in plans for variants that do not go
alike. The tape has the number with its sign, so a sum decides nothing. What a sign would
decide is a `Truth`: a guard where the calculation goes one way, or a choice for each
variant where both ways are written down. Sums that matter are watched: so much of their
terms must be left that rounding stays small, whatever the order of the pivots.
"""

from __future__ import annotations

import math

from vstatics.core.numerics.tape import HUGE, NEGATIONS, Operand, Plain, Tape, Untraceable, ordered
from vstatics.core.numerics.tolerances import SURE_BOUNDS


class Signed:
    """A number per variant, of any sign: what stands in a slot, times +1 or -1."""

    __slots__ = ("high", "low", "negated", "slot", "tape", "value")
    __hash__ = None  # type: ignore[assignment]

    def __init__(
        self, tape: Tape, slot: int, value: float, low: float = -math.inf, high: float = math.inf
    ) -> None:
        self.tape = tape
        self.slot = slot
        self.value = value
        """In the first variant."""
        self.low = low
        self.high = high
        self.negated = False

    @property
    def settled(self) -> int:
        """+1 or -1 if all variants have this sign, else 0."""
        return 1 if self.low > 0 else -1 if self.high < 0 else 0

    @property
    def direction(self) -> Either:
        """+1 or -1 for each variant."""
        if self.settled:
            return float(self.settled)
        slot = self.tape.note("copysign", Plain(1.0), self.slot)
        content = -self.value if self.negated else self.value
        made = Signed(self.tape, slot, math.copysign(1.0, content), -1.0, 1.0)
        return -made if self.negated else made

    def __neg__(self) -> Signed:
        other = Signed(self.tape, self.slot, -self.value, -self.high, -self.low)
        other.negated = not self.negated
        return other

    def __abs__(self) -> Signed:
        if self.settled:
            return self if self.settled > 0 else -self
        slot = self.tape.note("absolute", self.slot, self.slot)
        return Signed(self.tape, slot, abs(self.value), 0.0, max(-self.low, self.high))

    def __mul__(self, other: Either) -> Either:
        if is_nothing(other):
            return other
        if not isinstance(other, Signed) and abs(other) == 1:
            return self if other > 0 else -self
        (a, a_negated), (b, b_negated) = _operand(self), _operand(other)
        slot = self.tape.note("multiply", *ordered(a, b))
        bounds = bounds_of_product(bounds_of(self), bounds_of(other))
        value = self.value * value_of(other)
        return _made(self.tape, slot, a_negated != b_negated, value, *bounds)

    __rmul__ = __mul__

    def __truediv__(self, other: Either) -> Either:
        return _quotient(self.tape, self, other)

    def __rtruediv__(self, other: Either) -> Either:
        return _quotient(self.tape, other, self)

    def __add__(self, other: Either) -> Either:
        """A sum; of numbers that cancel for certain, 0."""
        if is_nothing(other):
            return other if other != other else self  # noqa: PLR0124 - NaN
        tape = self.tape
        (a, negated), (b, b_negated) = _operand(self), _operand(other)
        if a == b and negated != b_negated:
            return 0.0
        low, high = (x + y for x, y in zip(bounds_of(self), bounds_of(other), strict=True))
        value = self.value + value_of(other)
        if value == 0 and self.value != 0:  # a choice may be 0; what happens to cancel is special
            raise Untraceable
        if negated == b_negated:
            return _made(tape, tape.note("add", *ordered(a, b)), negated, value, low, high)
        first, second = ordered(a, b)
        turned = negated if first == a else b_negated
        return _made(tape, tape.note("subtract", first, second), turned, value, low, high)

    __radd__ = __add__

    def __sub__(self, other: Either) -> Either:
        return self + -other

    def __rsub__(self, other: Either) -> Either:
        return -self + other

    def __lt__(self, other: Either) -> Condition:
        return _compared(self.tape, "less", self, other)

    def __gt__(self, other: Either) -> Condition:
        return _compared(self.tape, "less", other, self)

    def __le__(self, other: Either) -> Condition:
        return _compared(self.tape, "less_equal", self, other)

    def __ge__(self, other: Either) -> Condition:
        return _compared(self.tape, "less_equal", other, self)

    def __eq__(self, other: object) -> bool:
        return _equal(self, other)

    def __ne__(self, other: object) -> bool:
        return not _equal(self, other)


Either = float | Signed
"""A float, or a number of any sign: the operators are the same for both."""


class Truth:
    """What holds in some variants: that a number is less than another, or no more than it.

    As a condition of Python it is a guard, for variants that go the way of the first.
    """

    __slots__ = ("name", "one", "other", "tape")

    def __init__(self, tape: Tape, name: str, one: Either, other: Either) -> None:
        self.tape = tape
        self.name = name
        self.one = one
        self.other = other

    def __bool__(self) -> bool:
        one, other = value_of(self.one), value_of(self.other)
        holds = one < other or (one == other and self.name == "less_equal")
        told = self if holds else ~self
        self.tape.note(told.name, *_ends(self.tape, told.one, told.other))
        return holds

    def __invert__(self) -> Truth:
        return Truth(self.tape, NEGATIONS[self.name], self.other, self.one)

    def __and__(self, other: Condition) -> Condition:
        if not isinstance(other, Truth):
            return self if other else False
        return least([self.margin, other.margin]) > 0

    __rand__ = __and__

    def __or__(self, other: Condition) -> Condition:
        if not isinstance(other, Truth):
            return True if other else self
        return -least([-self.margin, -other.margin]) > 0

    __ror__ = __or__

    @property
    def margin(self) -> Signed:
        """A number above 0 where it holds, below 0 where it does not."""
        if is_nothing(self.one) and isinstance(self.other, Signed):
            return self.other
        if is_nothing(self.other) and isinstance(self.one, Signed):
            return -self.one
        ends = upright(self.tape, self.other), upright(self.tape, self.one)
        value = value_of(self.other) - value_of(self.one)
        return Signed(self.tape, self.tape.note("subtract", *ends), value)


Condition = bool | Truth
"""Something that holds, or does not; or in some variants only."""


def _ends(tape: Tape, one: Either, other: Either) -> tuple[Operand, Operand]:
    """The operands of a comparison; both turned where that spares a step."""
    numbers = [number for number in (one, other) if isinstance(number, Signed)]
    if all(number.negated for number in numbers):
        return upright(tape, -other), upright(tape, -one)
    return upright(tape, one), upright(tape, other)


def value_of(number: Either) -> float:
    """The number in the first variant."""
    return number.value if isinstance(number, Signed) else number


def bounds_of(number: Either) -> Interval:
    """The bounds of a number in all variants."""
    return (number.low, number.high) if isinstance(number, Signed) else (number, number)


def upright(tape: Tape, number: Either) -> Operand:
    """The operand that is the number with its sign."""
    if not isinstance(number, Signed):
        return Plain(float(number))
    return tape.note("multiply", number.slot, Plain(-1.0)) if number.negated else number.slot


def least(numbers: list[Signed]) -> Signed:
    """The least of some numbers, in each variant."""
    first, *others = numbers
    for other in others:
        tape = first.tape
        one, two = sorted((upright(tape, first), upright(tape, other)), key=str)
        slot = tape.note("minimum", one, two)
        value, low = min(first.value, other.value), min(first.low, other.low)
        first = Signed(tape, slot, value, low, min(first.high, other.high))
    return first


def is_nothing(number: Either) -> bool:
    """Whether it is a plain 0 or NaN, with which there is nothing to calculate."""
    return not isinstance(number, Signed) and not abs(number) > 0


def _operand(number: Either) -> tuple[Operand, bool]:
    """What stands on the tape, and whether it has the other sign there."""
    if isinstance(number, Signed):
        return number.slot, number.negated
    return Plain(float(abs(number))), number < 0


def _made(  # noqa: PLR0913, PLR0917
    tape: Tape,
    slot: int,
    negated: bool,  # noqa: FBT001
    value: float,
    low: float,
    high: float,
) -> Signed:
    if value != 0 and not 1 / HUGE < abs(value) < HUGE:
        raise Untraceable
    made = Signed(tape, slot, value, low, high)
    made.negated = negated
    return made


def _quotient(tape: Tape, one: Either, other: Either) -> Either:
    if is_nothing(one):
        return one
    if value_of(other) == 0 or is_nothing(other):
        raise Untraceable
    if not isinstance(other, Signed) and abs(other) == 1:
        return one if other > 0 else -one
    (a, a_negated), (b, b_negated) = _operand(one), _operand(other)
    if a == b:
        return -1.0 if a_negated != b_negated else 1.0
    slot = tape.note("divide", a, b)
    bounds = bounds_of_quotient(bounds_of(one), bounds_of(other))
    value = value_of(one) / value_of(other)
    return _made(tape, slot, a_negated != b_negated, value, *bounds)


def _compared(tape: Tape, name: str, one: Either, other: Either) -> Condition:
    """A comparison that bounds settle, or that differs between variants."""
    if is_nan(one) or is_nan(other):
        return False
    below = is_below(bounds_of(one), bounds_of(other))
    if below is not None:
        return below
    if _operand(one) == _operand(other):
        return name == "less_equal"
    return Truth(tape, name, one, other)


def is_nan(number: Either) -> bool:
    """Whether there is no number."""
    return not isinstance(number, Signed) and math.isnan(number)


def _equal(one: Signed, other: object) -> bool:
    """Whether two numbers are the same; a signed one is not 0 but by chance, or as a choice."""
    if not isinstance(other, Signed):
        plain = float(other)  # type: ignore[arg-type]
        if is_nothing(plain) or abs(plain) == math.inf or not one.low <= plain <= one.high:
            return False
        ends: tuple[Operand, Operand] = one.slot, Plain(-plain if one.negated else plain)
    elif one.slot == other.slot:
        return one.negated == other.negated
    elif one.high < other.low or other.high < one.low:
        return False
    else:
        ends = upright(one.tape, one), upright(one.tape, other)
    same = one.value == value_of(other)  # type: ignore[arg-type]
    one.tape.note("equal" if same else "not_equal", *ends)
    return same


def size_of(number: Either) -> Either:
    """The magnitude of a number; `abs`, whose type is lost on a union."""
    return abs(number)  # type: ignore[return-value]


Interval = tuple[float, float]
"""The least and the largest number."""

OPEN = -math.inf, math.inf


def bounds_of_product(one: Interval, other: Interval) -> Interval:
    """Bounds of the product of two numbers.

    >>> bounds_of_product((-2.0, 3.0), (1.0, 4.0))
    (-8.0, 12.0)
    """
    return _around([a * b for a in one for b in other])


def bounds_of_quotient(one: Interval, other: Interval) -> Interval:
    """Bounds of the quotient of two numbers; none where the divisor may be 0.

    >>> bounds_of_quotient((-2.0, 3.0), (1.0, 4.0)), bounds_of_quotient((1.0, 2.0), (-1.0, 1.0))
    ((-2.0, 3.0), (-inf, inf))
    """
    if other[0] > 0 or other[1] < 0:
        return _around([a / b for a in one for b in other])
    return OPEN


def _around(ends: list[float]) -> Interval:
    return OPEN if any(map(math.isnan, ends)) else (min(ends), max(ends))


def is_below(one: Interval, other: Interval) -> bool | None:
    """Whether a number is less than another one; None where bounds do not tell.

    >>> is_below((-2.0, -1.0), (0.0, 0.0)), is_below((1.0, 3.0), (2.0, 4.0))
    (True, None)
    """
    if _lies_below(one, other):
        return True
    return False if _lies_below(other, one) else None


def _lies_below(one: Interval, other: Interval) -> bool:
    """With some room between them, but for an end that is 0 or infinite."""
    end, start = one[1], other[0]
    if start == math.inf or end == -math.inf or (0 in (end, start) and end < start):
        return True
    return end + SURE_BOUNDS * abs(end) < start - SURE_BOUNDS * abs(start)


def guarded_sum(one: Either, other: Either, part: float) -> Either:
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
