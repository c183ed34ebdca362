"""Numbers of any sign: what a plan gives for each variant is what its numbers alone give."""

import operator
from collections.abc import Callable, Sequence

import numpy as np
import pytest

from tests.core.numerics.programs import rows_for
from vstatics.core.numerics.elimination import RIGHT, solve
from vstatics.core.numerics.plans import plan_of_any_sign, prepared
from vstatics.core.numerics.signed import Condition
from vstatics.core.numerics.tape import Residual
from vstatics.core.numerics.traced import Number, absolute, chosen, counted, opposite, sign, where

VALUES = np.random.default_rng(5).uniform(-3, 3, (3, 400))
Calculation = Callable[[Sequence[Number]], list[Number | Residual | Condition]]


def replayed(function: Calculation, values: np.ndarray = VALUES) -> tuple[np.ndarray, np.ndarray]:
    """Results of the plan of the first variant, and who passed its guards."""
    inputs = prepared(values)
    plan = plan_of_any_sign(function, inputs, 0, again=False)
    rows = rows_for(len(function(values[:, 0].tolist())), values.shape[1])
    with np.errstate(all="ignore"):
        passed = plan.suits(inputs) & plan.run(inputs, rows)
    return np.array(rows.arrays), passed


def choices(abc: Sequence[Number]) -> list[Number | Residual | Condition]:
    a, b, c = abc
    both, one = (a > b) & (c > 0), (a > b) | opposite(c > 0)
    return [chosen(both, a, -b), chosen(one, 1.0, c), where(both, a * b), both]


def test_what_any_sign_has_is_calculated_for_all_variants() -> None:
    """Arithmetic, quotients of a number and itself, magnitudes, signs, choices."""
    functions: tuple[Calculation, ...] = (
        lambda abc: [-(abc[0] - abc[1]) * 2, 1 / (abc[0] * -abc[2]), abc[0] - (3 - abc[1])],
        lambda abc: [abc[0] / abc[0], abc[0] / -abc[0], -abc[1] / abc[1], -abc[2] / -abc[2]],
        lambda abc: [absolute(abc[0] - abc[1]), sign(-abc[2]), sign(abc[0]) * abc[1]],
        lambda abc: [sign(abc[0] / 9), absolute(abc[1] / 9), absolute(-abc[1] / 9)],
        choices,
    )
    for function in functions:
        found, passed = replayed(function)
        assert passed.all()
        for variant, column in enumerate(VALUES.T.tolist()):
            expected = np.array(function(column), dtype=float)
            assert found[:, variant] == pytest.approx(expected, rel=1e-15, nan_ok=True)


def test_a_condition_of_python_is_a_guard() -> None:
    values = VALUES.round() + 0.5  # some are equal
    above, equal = operator.gt, operator.eq
    choices: list[Calculation] = [
        lambda abc: [abc[0] if above(*abc[:2]) else abc[2]],
        lambda abc: [abc[0] if equal(*abc[:2]) else abc[2]],
    ]
    for holds, choice in zip((above, equal), choices, strict=True):
        _, passed = replayed(choice, values)
        same = holds(*values[:2]) == holds(*values[:2, 0])
        assert (passed == same).all()
        assert 0 < same.mean() < 1


def test_variants_in_which_as_many_hold_pass() -> None:
    found, passed = replayed(lambda abc: [counted([number > 0 for number in abc])])
    above = (VALUES > 0).sum(axis=0)
    assert (passed == (above == above[0])).all()
    assert (found[0, passed] == above[0]).all()


def test_a_sum_that_nearly_cancels_does_not_pass() -> None:
    """X = 1/(a - b) by elimination; where a is nearly b rounding would be large."""
    values = np.array([[2.0, -1.0, 2.0, 2.0], [-1.0, 2.0, 2.0 - 1e-7, 1.0]])

    def pivot(ab: Sequence[Number]) -> list[Number | Residual | Condition]:
        a, b = ab
        equations = [{0: 1.0, 1: a, RIGHT: 1.0}, {0: 1.0, 1: b, RIGHT: 0.0}]
        return [*solve(equations, 2).values]

    found, passed = replayed(pivot, values)
    assert passed.tolist() == [True, True, False, True]
    expected = 1 / (values[0] - values[1])
    assert found[1, passed] == pytest.approx(expected[passed], rel=1e-15)
