"""Recorded arithmetic for numbers whose sign can differ between variants.

`Signed` numbers replace `Traced` numbers if variants differ in sign. The tape (the list of recorded
operations) contains signed numbers, so a sum needs no decision. A comparison is a `Truth`. If the
program branches on it, it becomes a guard, which restricts the variants. If the results of both
branches are recorded, each variant chooses one. Guards of important sums require that terms do not
cancel, so that rounding stays small for any order of the pivots.
"""

from __future__ import annotations

import math

from vstatics.core.numerics.tape import HUGE, NEGATIONS, Operand, Plain, Tape, Untraceable, ordered
from vstatics.core.numerics.tolerances import SURE_BOUNDS


class Signed:
    """Number with any sign in each variant: a slot of the tape, multiplied by +1 or -1."""

    __slots__ = ("high", "low", "negated", "slot", "tape", "value")
    __hash__ = None  # type: ignore[assignment]

    def __init__(
        self, tape: Tape, slot: int, value: float, low: float = -math.inf, high: float = math.inf
    ) -> None:
        self.tape = tape
        self.slot = slot
        self.value = value
        """Value in the first variant."""
        self.low = low
        self.high = high
        self.negated = False

    @property
    def settled(self) -> int:
        """Sign common to all variants, +1 or -1; 0 if the sign can differ."""
        return 1 if self.low > 0 else -1 if self.high < 0 else 0

    @property
    def direction(self) -> Either:
        """Sign of the number, +1 or -1, in each variant."""
        if self.settled:
            return float(self.settled)
        slot = self.tape.note("copysign", Plain(1.0), self.slot)
        content = -self.value if self.negated else self.value
        direction = Signed(self.tape, slot, math.copysign(1.0, content), -1.0, 1.0)
        return -direction if self.negated else direction

    def __neg__(self) -> Signed:
        negative = Signed(self.tape, self.slot, -self.value, -self.high, -self.low)
        negative.negated = not self.negated
        return negative

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
        return _signed(self.tape, slot, a_negated != b_negated, value, *bounds)

    __rmul__ = __mul__

    def __truediv__(self, other: Either) -> Either:
        return _quotient(self.tape, self, other)

    def __rtruediv__(self, other: Either) -> Either:
        return _quotient(self.tape, other, self)

    def __add__(self, addend: Either) -> Either:
        """Return the sum; 0 if the terms certainly cancel."""
        if is_nothing(addend):
            return addend if addend != addend else self  # noqa: PLR0124 - NaN
        tape = self.tape
        (a, negated), (b, b_negated) = _operand(self), _operand(addend)
        if a == b and negated != b_negated:
            return 0.0
        low, high = (x + y for x, y in zip(bounds_of(self), bounds_of(addend), strict=True))
        value = self.value + value_of(addend)
        # Nonzero terms cancel only by coincidence, which makes the first variant a special case.
        # Terms that result from choices can be 0.
        if value == 0 and self.value != 0:
            raise Untraceable
        if negated == b_negated:
            return _signed(tape, tape.note("add", *ordered(a, b)), negated, value, low, high)
        first, second = ordered(a, b)
        turned = negated if first == a else b_negated
        return _signed(tape, tape.note("subtract", first, second), turned, value, low, high)

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
"""A float or a number of any sign, which have the same operators."""


class Truth:
    """Comparison whose result can differ between variants: left < right, or left <= right.

    Its conversion to a Python boolean has the value of the first variant, and records a guard that
    excludes variants with the other value.
    """

    __slots__ = ("left", "name", "right", "tape")

    def __init__(self, tape: Tape, name: str, left: Either, right: Either) -> None:
        self.tape = tape
        self.name = name
        self.left = left
        self.right = right

    def __bool__(self) -> bool:
        left, right = value_of(self.left), value_of(self.right)
        holds = left < right or (left == right and self.name == "less_equal")
        guard = self if holds else ~self
        self.tape.note(guard.name, *_ends(self.tape, guard.left, guard.right))
        return holds

    def __invert__(self) -> Truth:
        return Truth(self.tape, NEGATIONS[self.name], self.right, self.left)

    def __and__(self, right: Condition) -> Condition:
        if not isinstance(right, Truth):
            return self if right else False
        return least([self.margin, right.margin]) > 0

    __rand__ = __and__

    def __or__(self, right: Condition) -> Condition:
        if not isinstance(right, Truth):
            return True if right else self
        return -least([-self.margin, -right.margin]) > 0

    __ror__ = __or__

    @property
    def margin(self) -> Signed:
        """Number above 0 where the comparison is true, and below 0 where it is false."""
        if is_nothing(self.left) and isinstance(self.right, Signed):
            return self.right
        if is_nothing(self.right) and isinstance(self.left, Signed):
            return -self.left
        ends = upright(self.tape, self.right), upright(self.tape, self.left)
        value = value_of(self.right) - value_of(self.left)
        return Signed(self.tape, self.tape.note("subtract", *ends), value)


Condition = bool | Truth
"""Boolean, or a comparison whose value can differ between variants."""


def renamed(comparison: Condition, name: str) -> Condition:
    """Return a comparison under another name, whose guard is waived or relaxed for decimals.

    >>> renamed(1.0 < 2.0, "apart")
    True
    """
    if not isinstance(comparison, Truth):
        return comparison
    return Truth(comparison.tape, name, comparison.left, comparison.right)


def _ends(tape: Tape, left: Either, right: Either) -> tuple[Operand, Operand]:
    numbers = [number for number in (left, right) if isinstance(number, Signed)]
    if all(number.negated for number in numbers):
        return upright(tape, -right), upright(tape, -left)
    return upright(tape, left), upright(tape, right)


def value_of(number: Either) -> float:
    """Return the value of a number in the first variant."""
    return number.value if isinstance(number, Signed) else number


def bounds_of(number: Either) -> Interval:
    """Return the bounds of a number in all variants."""
    return (number.low, number.high) if isinstance(number, Signed) else (number, number)


def upright(tape: Tape, number: Either) -> Operand:
    """Return the signed operand of a number, recording a negation if needed."""
    if not isinstance(number, Signed):
        return Plain(float(number))
    return tape.note("multiply", number.slot, Plain(-1.0)) if number.negated else number.slot


def least(numbers: list[Signed]) -> Signed:
    """Return the minimum of several numbers in each variant."""
    first, *others = numbers
    for other in others:
        tape = first.tape
        lower, upper = sorted((upright(tape, first), upright(tape, other)), key=str)
        slot = tape.note("minimum", lower, upper)
        value, low = min(first.value, other.value), min(first.low, other.low)
        first = Signed(tape, slot, value, low, min(first.high, other.high))
    return first


def is_nothing(number: Either) -> bool:
    """Return whether a number is a plain 0 or NaN, which makes an operation unnecessary."""
    return not isinstance(number, Signed) and not abs(number) > 0


def _operand(number: Either) -> tuple[Operand, bool]:
    """Return the tape operand of a number, and whether its sign is reversed."""
    if isinstance(number, Signed):
        return number.slot, number.negated
    return Plain(float(abs(number))), number < 0


def _signed(  # noqa: PLR0913, PLR0917
    tape: Tape,
    slot: int,
    negated: bool,  # noqa: FBT001
    value: float,
    low: float,
    high: float,
) -> Signed:
    if value != 0 and not 1 / HUGE < abs(value) < HUGE:
        raise Untraceable
    number = Signed(tape, slot, value, low, high)
    number.negated = negated
    return number


def _quotient(tape: Tape, dividend: Either, divisor: Either) -> Either:
    if is_nothing(dividend):
        return dividend
    if value_of(divisor) == 0 or is_nothing(divisor):
        raise Untraceable
    if not isinstance(divisor, Signed) and abs(divisor) == 1:
        return dividend if divisor > 0 else -dividend
    (a, a_negated), (b, b_negated) = _operand(dividend), _operand(divisor)
    if a == b:
        return -1.0 if a_negated != b_negated else 1.0
    slot = tape.note("divide", a, b)
    bounds = bounds_of_quotient(bounds_of(dividend), bounds_of(divisor))
    value = value_of(dividend) / value_of(divisor)
    return _signed(tape, slot, a_negated != b_negated, value, *bounds)


def _compared(tape: Tape, name: str, left: Either, right: Either) -> Condition:
    """Return a comparison; a boolean if the bounds of the numbers decide it for all variants."""
    if is_nan(left) or is_nan(right):
        return False
    below = is_below(bounds_of(left), bounds_of(right))
    if below is not None:
        return below
    if _operand(left) == _operand(right):
        return name == "less_equal"
    return Truth(tape, name, left, right)


def is_nan(number: Either) -> bool:
    """Return whether a number is a plain NaN."""
    return not isinstance(number, Signed) and math.isnan(number)


def _equal(number: Signed, other: object) -> bool:
    """Return whether two numbers are equal, recorded as a guard unless it is certain."""
    if not isinstance(other, Signed):
        plain = float(other)  # type: ignore[arg-type]
        if is_nothing(plain) or abs(plain) == math.inf or not number.low <= plain <= number.high:
            return False
        ends: tuple[Operand, Operand] = number.slot, Plain(-plain if number.negated else plain)
    elif number.slot == other.slot:
        return number.negated == other.negated
    elif number.high < other.low or other.high < number.low:
        return False
    else:
        ends = upright(number.tape, number), upright(number.tape, other)
    same = number.value == value_of(other)  # type: ignore[arg-type]
    number.tape.note("equal" if same else "not_equal", *ends)
    return same


def size_of(number: Either) -> Either:
    """Return the magnitude of a number; unlike `abs`, with a type for both kinds of numbers."""
    return abs(number)  # type: ignore[return-value]


Interval = tuple[float, float]
"""Smallest and largest value of a number."""

OPEN = -math.inf, math.inf
"""Interval without bounds."""


def bounds_of_product(first: Interval, second: Interval) -> Interval:
    """Return the bounds of the product of two numbers.

    >>> bounds_of_product((-2.0, 3.0), (1.0, 4.0))
    (-8.0, 12.0)
    """
    return _around([a * b for a in first for b in second])


def bounds_of_quotient(dividend: Interval, divisor: Interval) -> Interval:
    """Return the bounds of the quotient of two numbers; infinite if the divisor can be 0.

    >>> bounds_of_quotient((-2.0, 3.0), (1.0, 4.0)), bounds_of_quotient((1.0, 2.0), (-1.0, 1.0))
    ((-2.0, 3.0), (-inf, inf))
    """
    if divisor[0] > 0 or divisor[1] < 0:
        return _around([a / b for a in dividend for b in divisor])
    return OPEN


def _around(ends: list[float]) -> Interval:
    return OPEN if any(map(math.isnan, ends)) else (min(ends), max(ends))


def is_below(left: Interval, right: Interval) -> bool | None:
    """Return whether a number is certainly less than a second number.

    The result is None if the intervals overlap.

    >>> is_below((-2.0, -1.0), (0.0, 0.0)), is_below((1.0, 3.0), (2.0, 4.0))
    (True, None)
    """
    if _lies_below(left, right):
        return True
    return False if _lies_below(right, left) else None


def _lies_below(left: Interval, right: Interval) -> bool:
    """Return whether `left` is below `right`, with a margin unless a limit is 0 or infinite."""
    end, start = left[1], right[0]
    if start == math.inf or end == -math.inf or (0 in (end, start) and end < start):
        return True
    return end + SURE_BOUNDS * abs(end) < start - SURE_BOUNDS * abs(start)


def guarded_sum(first: Either, second: Either, part: float) -> Either:
    """Return a sum whose magnitude must exceed `part` times the magnitude of a term (a guard)."""
    total = first + second
    if not isinstance(total, Signed):
        return total
    ends = [max(map(abs, bounds_of(number))) for number in (first, second)]
    left = max(total.low, -total.high)
    if not left > part * max(ends):
        is_clear = size_of(_cheapest(first, second)) * part < size_of(total)
        if not renamed(is_clear, "apart"):
            raise Untraceable
    return total


def guard_equal(number: Either, reference: Either, rounding: Either, part: float) -> None:
    """Require that two numbers differ by at most `rounding` and `part` times the magnitude."""
    if (
        isinstance(number, Signed)
        and isinstance(reference, Signed)
        and number.slot == reference.slot
    ):
        return
    tape = number.tape if isinstance(number, Signed) else reference.tape  # type: ignore[union-attr]
    deviation = tape.note("subtract", upright(tape, number), upright(tape, reference))
    deviation = tape.note("absolute", deviation, deviation)
    for most in (rounding, size_of(_cheapest(number, reference)) * part):
        tape.note("less_equal", deviation, upright(tape, most))


def _cheapest(first: Either, second: Either) -> Either:
    """Return the number whose magnitude needs fewer recorded operations."""
    return first if _cost(first) <= _cost(second) else second


def _cost(number: Either) -> int:
    return 0 if not isinstance(number, Signed) else 1 if number.settled else 2
