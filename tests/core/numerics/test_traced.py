"""Traced numbers on a tape: their signs and bounds, operations that are noted, guards of comparisons."""

import math
import operator
from collections.abc import Callable
from itertools import product

import pytest

from vstatics.core.numerics import tape as tapes
from vstatics.core.numerics.tape import GUARDS, HUGE, Plain, Residual, Tape, Untraceable
from vstatics.core.numerics.traced import (
    Magnitude,
    Number,
    Traced,
    guard_same,
    guard_within,
    may_lie,
    plain,
    residual,
)

Bounds = tuple[float, float]


def traced(*values: float, bounds: Bounds | None = None) -> list[Traced]:
    """Traced numbers on one tape, with the same bounds for their magnitudes, or wide ones."""
    tape = Tape(len(values))
    return [
        Traced(
            tape,
            1 if value > 0 else -1,
            Magnitude(slot, abs(value), *(bounds or (abs(value) / 50, abs(value) * 50))),
        )
        for slot, value in enumerate(values)
    ]


def noted(number: Traced | Residual) -> list[tuple[str, object, object]]:
    return [operation[:3] for operation in number.tape.operations]


def names(number: Traced | Residual) -> list[str]:
    return [name for name, _, _ in noted(number)]


def guards(number: Traced | Residual) -> list[str]:
    return [name for name in names(number) if name in GUARDS]


def on_tape(number: Number | Residual) -> Traced:
    assert isinstance(number, Traced)
    return number


def test_the_same_operation_is_noted_once() -> None:
    a, b = traced(2.0, 3.0)
    products = [on_tape(one) for one in (a * b, b * a, -a * b, b * -a)]
    sums = [on_tape(one) for one in (a + b, b + a, -(-a - b))]
    assert [one.sign for one in products] == [1, 1, -1, -1]
    assert noted(a) == [("multiply", 0, 1), ("add", 0, 1)]
    assert len({one.magnitude for one in products}) == len({one.magnitude for one in sums}) == 1
    assert a * 2.0 == 2.0 * a
    assert a + 2.0 == 2.0 + a
    assert noted(a)[2:] == [("multiply", 0, Plain(2.0)), ("add", 0, Plain(2.0))]
    assert a / b != b / a


def test_a_tape_has_an_end() -> None:
    tape = Tape(1)
    for place in range(tapes.MOST_OPERATIONS):
        tape.note("add", 0, Plain(float(place)))
    tape.note("add", 0, Plain(1.0))
    with pytest.raises(Untraceable):
        tape.note("add", 0, Plain(-1.0))


def test_signs_zeros_and_ones_cost_no_operation() -> None:
    for value in (2.5, -2.5):
        (a,) = traced(value)
        assert (a < 0) == (value < 0)
        for zero in (a * 0.0, 0.0 * a, 0.0 / a, a - a):
            assert (zero.__class__, zero) == (float, 0)
        alike = (a + 0.0, 0.0 + a, a - 0.0, a * 1.0, 1.0 * a, a / 1.0, (-1.0 * a) / -1.0, a * 1)
        turned = (-a, 0.0 - a, -1.0 * a, a / -1.0, a * -1)
        for same, others in ((1, alike), (-1, turned)):
            for one in map(on_tape, others):
                assert (one.sign, one.magnitude) == (same * a.sign, a.magnitude)
        assert (abs(a).sign, abs(a).magnitude) == (1, a.magnitude)
        assert (a / a, a / -a) == (1.0, -1.0)
        assert not noted(a)


def test_nan_and_infinity_are_compared_without_an_operation() -> None:
    nan = math.nan
    compared = (operator.lt, operator.le, operator.gt, operator.ge, operator.eq)
    for a in traced(2.0, -2.0):
        for number in (a + nan, nan + a, a - nan, nan - a, a * nan, nan / a):
            assert math.isnan(plain(number))
        assert not any(compare(a, nan) or compare(nan, a) for compare in compared)
        assert -math.inf < a < math.inf
        assert -math.inf <= a <= math.inf
        assert a not in (math.inf, -math.inf)
        assert not noted(a)


def test_bounds_and_signs_settle_a_comparison_without_a_guard() -> None:
    (one,) = traced(2.0, bounds=(1.5, 3.0))
    for a, small, large in ((one, 1.0, 4.0), (-one, -4.0, -1.0)):
        assert small < a < large
        assert small <= a <= large
        assert not any((a < small, a > large, a <= small, a >= large))
        assert a not in (small, large)
        assert -small > -a > -large
        assert -a != a
        assert not noted(a)
    for sign in (1, -1):
        spans = ((1.5, 0.0), (1.6, 0.0), (2.9, 9.0), (3.0, 9.0))
        found = [may_lie(sign * one, *sorted((sign * a, sign * b))) for a, b in spans]
        assert found == [False, True, True, False]


def test_bounds_settle_nothing_within_their_own_rounding() -> None:
    (a,) = traced(2.0, bounds=(1.0, 3.0))
    assert a < 3.0 + 1e-12
    assert a > 1.0 - 1e-12
    assert guards(a) == ["less", "less"]


def test_what_bounds_do_not_settle_leaves_a_guard() -> None:
    comparisons: tuple[tuple[Callable[[Number, Number], bool], str, str], ...] = (
        (operator.lt, "less", "less_equal"),
        (operator.le, "less_equal", "less"),
        (operator.eq, "equal", "not_equal"),
    )
    pairs = (2.0, 3.0), (3.0, 2.0), (2.0, 2.0)
    for (compare, held, denied), values, sign in product(comparisons, pairs, (1, -1)):
        outcome = compare(values[0] * sign, values[1] * sign)
        a, b = traced(*values)
        (c,) = traced(values[0])
        for left, right in ((a, b * sign), (c, values[1] * sign)):
            assert compare(left * sign, right) == outcome, (held, values, sign)
            assert guards(left) == [held if outcome else denied], (held, values, sign)


def test_a_difference_is_guarded_also_where_no_bound_is_known() -> None:
    # 1/(a - b) may be as large as it likes: it is compared with c all the same
    a, b, c = traced(2.0, 1.0, 0.5)
    inverse = on_tape(1.0 / (a - b))
    assert inverse.magnitude.high == math.inf
    before = len(guards(a))
    assert on_tape(inverse - c).sign == 1
    assert "less" in guards(a)[before:]


def test_numbers_are_the_same_within_a_part_or_the_tape_is_of_no_use() -> None:
    a, b = traced(2.0, 2.0 + 1e-12)
    guard_same(a, b, 1e-9)
    assert guards(a) == ["less_equal", "less_equal"]
    guard_same(a, a, 1e-9)
    assert len(guards(a)) == 2


def test_a_huge_or_tiny_first_variant_stands_for_no_other() -> None:
    for value in (HUGE * 1.01, 0.99 / HUGE, math.inf, math.nan, 5e-324, 1e308):
        with pytest.raises(Untraceable):
            traced(value)
    (a,) = traced(1e60)
    many, mul, div = operator.add, operator.mul, operator.truediv
    for operation, *numbers in ((mul, a, a), (div, 1e-60, a), (many, a, math.inf), (div, a, 0.0)):
        with pytest.raises(Untraceable):
            operation(*numbers)
    with pytest.raises(Untraceable):
        a / math.nan


def left_over(*numbers: Number) -> Residual:
    made = residual(numbers)
    assert isinstance(made, Residual)
    return made


def test_a_rest_is_added_up_from_left_to_right() -> None:
    a, b = traced(2.0, 3.0)
    left = left_over(0.0, -a, 0.5, 0.0, b, -1.5)
    assert left.value == 0.0
    assert names(a) == ["subtract", "add", "add", "subtract"]
    with pytest.raises(Untraceable):
        left - 1.0
    assert residual([]) == 0.0
    assert residual([0.1, 0.2, -0.3]) == 0.1 + 0.2 - 0.3
    for number in (residual([a, math.nan, a]), residual([math.nan, a])):
        assert math.isnan(plain(number))


def test_what_lies_outside_in_the_first_variant_stands_for_no_other() -> None:
    a, b = traced(2.0, 3.0)
    guard_within(a, 1.0, 2.5)
    guard_within(left_over(b, -a), 0.5, 1.0)
    assert guards(a) == ["less_equal"] * 4
    for low, high in ((2.5, 3.0), (1.0, 1.5)):
        for number in (a, left_over(a)):
            with pytest.raises(Untraceable):
                guard_within(number, low, high)
