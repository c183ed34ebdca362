"""Traced numbers: what they note on their tape, and that a tape run again is the calculation."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Sequence

import numpy as np
import pytest
from hypothesis import given, settings

from tests.numerics.programs import Program, programs, rows_for, run, run_plan, same_bits, variants
from vstatics.numerics import elimination
from vstatics.numerics.arrays import Floats
from vstatics.numerics.entries import RIGHT
from vstatics.numerics.tape import GUARDS, LONGEST, Plain, Tape, Untraceable
from vstatics.numerics.traced import (
    HUGE,
    Magnitude,
    Number,
    Rest,
    Traced,
    difference,
    guard_same,
    guard_within,
    rest,
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


def noted(number: Traced | Rest) -> list[tuple[str, object, object]]:
    """The operations on the tape of a number."""
    return [tuple(operation) for operation in number.tape.operations]  # type: ignore[misc]


def names(number: Traced | Rest) -> list[str]:
    return [name for name, _, _ in noted(number)]


def guards(number: Traced | Rest) -> list[str]:
    return [name for name in names(number) if name in GUARDS]


def test_signs_cost_no_operation() -> None:
    (a,) = traced(-2.5)
    assert (-a).sign == 1
    assert abs(a).sign == 1
    assert abs(-a).magnitude is a.magnitude
    assert a < 0 < -a
    assert not noted(a)


@pytest.mark.parametrize("value", [2.5, -2.5])
def test_zeros_and_ones_cost_no_operation(value: float) -> None:
    (a,) = traced(value)
    for zero in (a * 0.0, 0.0 * a, 0.0 / a, a - a):
        assert zero.__class__ is float
        assert zero == 0
    for itself in (a + 0.0, 0.0 + a, a - 0.0, a * 1.0, 1.0 * a, a / 1.0, (-1.0 * a) / -1.0, a * 1):
        assert (itself.sign, itself.magnitude) == (a.sign, a.magnitude)
    for other in (0.0 - a, -1.0 * a, a / -1.0, a * -1):
        assert (other.sign, other.magnitude) == (-a.sign, a.magnitude)
    assert a / a == 1.0
    assert a / -a == -1.0
    assert not noted(a)


def test_with_nan_there_is_nothing_to_calculate() -> None:
    (a,) = traced(2.0)
    for number in (
        a + math.nan,
        math.nan + a,
        a - math.nan,
        math.nan - a,
        a * math.nan,
        math.nan / a,
    ):
        assert math.isnan(number)
    compared = (operator.lt, operator.le, operator.gt, operator.ge, operator.eq)
    assert not any(compare(a, math.nan) or compare(math.nan, a) for compare in compared)
    assert not noted(a)


def test_all_variants_lie_between_the_infinities() -> None:
    for a in traced(2.0, -2.0):
        assert -math.inf < a < math.inf
        assert -math.inf <= a <= math.inf
        assert a not in (math.inf, -math.inf)
        assert not noted(a)


def test_the_same_operation_is_noted_once() -> None:
    a, b = traced(2.0, 3.0)
    products = [a * b, b * a, -a * b, b * -a]
    sums = [a + b, b + a, -(-a - b)]
    assert [one.sign for one in products] == [1, 1, -1, -1]
    assert noted(a) == [("multiply", 0, 1), ("add", 0, 1)]
    assert len({one.magnitude for one in products}) == len({one.magnitude for one in sums}) == 1
    assert a * 2.0 == 2.0 * a
    assert a + 2.0 == 2.0 + a
    assert noted(a)[2:] == [("multiply", 0, Plain(2.0)), ("add", 0, Plain(2.0))]
    assert a / b != b / a


def test_a_plain_number_is_no_slot() -> None:
    a, b, c = traced(5.0, 7.0, 2.0)
    by_slot = [a * c, a + c, a - c, a / c, c / a]
    by_number = [a * 2.0, a + 2.0, a - 2.0, a / 2.0, 2.0 / a]
    slots = {one.magnitude.operand for one in (*by_slot, *by_number)}
    assert len(slots) == len(by_slot) + len(by_number)
    assert ("multiply", 0, Plain(2.0)) in noted(b)
    assert ("multiply", 0, 2) in noted(b)


def test_the_number_1_is_not_slot_1() -> None:
    """Slot 1 holds 5: a bug once took it for the number 1, and the quotient for the dividend."""

    def quotients(numbers: Sequence[Number]) -> list[Number]:
        one, five = numbers
        return [one / five, 1.0 / five, one - five, 1.0 - five, one < five, five > 2.0]

    values = np.array([[1.0, 2.0], [5.0, 7.0]])
    rows = rows_for(6, 2)
    assert run_plan(quotients, values, rows).all()
    for variant in range(2):
        expected = quotients(values[:, variant].tolist())
        assert [row[variant] for row in rows.arrays] == expected


@pytest.mark.parametrize("swapped", [False, True])
def test_bounds_settle_a_comparison_without_a_guard(swapped: bool) -> None:
    (a,) = traced(2.0, bounds=(1.5, 3.0))
    small, large = (1.0, 4.0) if not swapped else (-4.0, -1.0)
    a = -a if swapped else a
    assert small < a < large
    assert small <= a <= large
    assert not any((a < small, a > large, a <= small, a >= large))
    assert a not in (small, large)
    assert -small > -a > -large
    assert not noted(a)


COMPARISONS: list[tuple[Callable[[Number, Number], bool], str, str]] = [
    (operator.lt, "less", "less_equal"),
    (operator.le, "less_equal", "less"),
    (operator.eq, "equal", "not_equal"),
]


@pytest.mark.parametrize(("compare", "held", "denied"), COMPARISONS)
def test_what_bounds_do_not_settle_leaves_a_guard(
    compare: Callable[[Number, Number], bool], held: str, denied: str
) -> None:
    for value, its_value in ((2.0, 3.0), (3.0, 2.0), (2.0, 2.0)):
        for sign in (1, -1):
            a, b = traced(value, its_value)
            outcome = compare(a * sign, b * sign)
            assert outcome == compare(value * sign, its_value * sign)
            assert guards(a) == [held if outcome else denied]
            (a,) = traced(value)
            assert compare(a * sign, its_value * sign) == outcome
            assert guards(a) == [held if outcome else denied]


def test_bounds_settle_nothing_within_their_own_rounding() -> None:
    (a,) = traced(2.0, bounds=(1.0, 3.0))
    assert a < 3.0 + 1e-12
    assert a > 1.0 - 1e-12
    assert guards(a) == ["less", "less"]


def test_signs_settle_a_comparison() -> None:
    a, b = traced(2.0, -3.0)
    assert b < a
    assert b <= 1.0
    assert a >= 1.0
    assert a != b
    assert guards(a) == ["less_equal"]  # 1 <= a; the others need none


def test_sums_of_one_sign_need_no_guard() -> None:
    a, b = traced(2.0, 3.0)
    for total, sign in ((a + b, 1), (-a - b, -1), (a - -b, 1), (-a + -3.0, -1)):
        assert total.sign == sign
    assert not guards(a)


def test_a_difference_is_guarded_to_keep_its_sign() -> None:
    a, b = traced(2.0, 3.0)
    below = a - b
    assert below.sign == -1
    assert noted(a) == [("not_equal", 1, 0), ("less", 0, 1), ("subtract", 1, 0)]
    again = b - a
    assert again.sign == 1
    assert again.magnitude.operand == below.magnitude.operand


def test_a_difference_within_bounds_needs_no_guard() -> None:
    (a,) = traced(2.0, bounds=(1.5, 3.0))
    left = a - 1.0
    assert names(a) == ["subtract"]
    assert left.magnitude.low == pytest.approx(0.5)
    assert left.magnitude.high == pytest.approx(2.0)


def test_equal_numbers_leave_zero_for_the_variants_in_which_they_are_equal() -> None:
    a, b = traced(2.0, 2.0)
    assert a - b == 0.0
    assert noted(a) == [("equal", 0, 1)]


def test_a_difference_leaves_a_part_of_the_larger_number() -> None:
    a, b = traced(4.0, 2.0)
    left = difference(a, -b, least=0.25)
    assert left.magnitude.low == pytest.approx(0.25 * a.magnitude.low)
    assert names(a) == ["multiply", "less", "subtract"]  # b < .75 a
    assert noted(a)[0] == ("multiply", 0, Plain(0.75))


def test_a_difference_is_guarded_also_where_no_bound_is_known() -> None:
    # 1/(a - b) may be as large as it likes: it is compared with c all the same
    a, b, c = traced(2.0, 1.0, 0.5)
    inverse = 1.0 / (a - b)
    assert inverse.magnitude.high == math.inf
    before = len(guards(a))
    left = inverse - c
    assert left.sign == 1
    assert "less" in guards(a)[before:]


def test_numbers_are_the_same_within_a_part_or_the_tape_is_of_no_use() -> None:
    a, b = traced(2.0, 2.0 + 1e-12)
    guard_same(a, b, 1e-9)
    assert guards(a) == ["less_equal", "less_equal"]
    guard_same(a, a, 1e-9)
    assert len(guards(a)) == 2


@pytest.mark.parametrize("value", [HUGE * 1.01, 0.99 / HUGE, math.inf, math.nan, 5e-324, 1e308])
def test_a_huge_or_tiny_first_variant_stands_for_no_other(value: float) -> None:
    with pytest.raises(Untraceable):
        traced(value)


def test_results_may_become_huge_only_in_other_variants() -> None:
    (a,) = traced(1e60)
    with pytest.raises(Untraceable):
        a * a
    with pytest.raises(Untraceable):
        1e-60 / a
    with pytest.raises(Untraceable):
        a + math.inf


def test_a_number_by_zero_stands_for_no_other() -> None:
    (a,) = traced(2.0)
    for nothing in (0.0, math.nan):
        with pytest.raises(Untraceable):
            a / nothing


def test_a_tape_has_an_end() -> None:
    tape = Tape(1)
    for place in range(LONGEST):
        tape.note("add", 0, Plain(float(place)))
    tape.note("add", 0, Plain(1.0))
    with pytest.raises(Untraceable):
        tape.note("add", 0, Plain(-1.0))


def test_a_rest_is_added_up_from_left_to_right() -> None:
    a, b = traced(2.0, 3.0)
    left = rest([0.0, -a, 0.5, 0.0, b, -1.5])
    assert isinstance(left, Rest)
    assert left.value == 0.0
    assert noted(a) == [
        ("subtract", Plain(0.0), 0),
        ("add", 2, Plain(0.5)),
        ("add", 3, 1),
        ("subtract", 4, Plain(1.5)),
    ]
    with pytest.raises(Untraceable):
        left - 1.0


def test_a_rest_of_plain_numbers_is_one() -> None:
    assert rest([]) == 0.0
    assert rest([0.1, 0.2, -0.3]) == 0.1 + 0.2 - 0.3
    (a,) = traced(2.0)
    assert math.isnan(rest([a, math.nan, a]))
    assert math.isnan(rest([math.nan, a]))


def test_what_lies_outside_in_the_first_variant_stands_for_no_other() -> None:
    a, b = traced(2.0, 3.0)
    guard_within(a, 1.0, 2.5)
    guard_within(rest([b, -a]), 0.5, 1.0)
    assert guards(a) == ["less_equal"] * 4
    for low, high in ((2.5, 3.0), (1.0, 1.5)):
        with pytest.raises(Untraceable):
            guard_within(a, low, high)
        with pytest.raises(Untraceable):
            guard_within(rest([a]), low, high)


def test_entries_that_nearly_cancel_stand_for_no_other_variant() -> None:
    """x0 + x1 = 1, a x0 + x1 = 2: too little of ``a - 1`` is left where a is 1 + 1e-13."""
    for excess, fits in ((0.5, True), (1e-13, False)):
        (a,) = traced(1 + excess)
        rows = [{0: a, 1: 1.0, RIGHT: 2.0}, {0: 1.0, 1: 1.0, RIGHT: 1.0}]
        if fits:
            found = elimination.solve(rows, 2)
            assert found.consistent
            assert found.missing == 0
            assert found.values[0].magnitude.value == pytest.approx(2)
        else:
            with pytest.raises(Untraceable):
                elimination.solve(rows, 2)


@settings(max_examples=80)
@given(programs(), variants())
def test_a_program_run_again_is_the_program(program: Program, values: Floats) -> None:
    """For every variant that passes the guards, to the last bit; the first always passes."""
    rows = rows_for(len(program), values.shape[1])
    try:
        passed = run_plan(lambda numbers: run(program, numbers), values, rows)
    except Untraceable:
        return
    assert passed[0]
    for variant in np.flatnonzero(passed).tolist():
        expected = run(program, values[:, variant].tolist())
        found = [float(row[variant]) for row in rows.arrays]
        assert all(map(same_value, found, expected)), (variant, found, expected)


def same_value(found: float, expected: float) -> bool:
    """To the last bit; a calculation with floats may lead to -0, which is 0 here."""
    return same_bits(found + 0.0, expected + 0.0)
