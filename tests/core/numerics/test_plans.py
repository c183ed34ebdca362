"""Plans: every variant gets the numbers that it would get alone, whoever calculates them.

Expected numbers come from the small functions themselves, called with floats.
"""

import math
from collections.abc import Callable, Sequence
from functools import partial

import numpy as np
import pytest
from hypothesis import given, settings

from tests.chance import count
from tests.core.numerics.programs import Program, programs, rows_for, run, same_bits, variants
from vstatics.core.numerics import plans
from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.memory import Rows
from vstatics.core.numerics.plans import (
    FEW_VARIANTS,
    OFTEN,
    SAMPLED,
    SPREAD,
    TRIALS,
    Plans,
    prepared,
)
from vstatics.core.numerics.traced import Number, absolute, is_traced, plain

Function = Callable[[Sequence[Number]], list[Number]]


class Counted:
    """A function that counts how often it is called: for a plan, or for a variant alone."""

    def __init__(self, function: Function) -> None:
        self.function = function
        self.traced = 0
        self.alone = 0

    def __call__(self, numbers: Sequence[Number]) -> list[Number]:
        """The function itself."""
        self.traced += is_traced(numbers[0])
        self.alone += not is_traced(numbers[0])
        return self.function(numbers)


def check(
    own: Plans, function: Function, values: Floats | list[list[float]], rows: Rows | None = None
) -> None:
    """Run the plans; every variant must get what the function gives it, to the last bit."""
    given = np.array(values, dtype=float)
    wanted = [function(column) for column in given.T.tolist()]
    rows = rows or rows_for(len(wanted[0]) if wanted else 1, given.shape[1])
    with np.errstate(all="ignore"):  # as `solve` does
        own.run(prepared(given), rows)
    found = np.array([row.tolist() for row in rows.arrays]).T.tolist()
    for variant, (one, other) in enumerate(zip(found, wanted, strict=True)):
        for number, expected in zip(one, other, strict=True):
            told = given[:, variant], one, other
            assert same_bits(number + 0.0, plain(expected) + 0.0), told


def branches(numbers: Sequence[Number]) -> list[Number]:
    """Three branches, and a result that is the same in each of them."""
    (x,) = numbers
    if x < 1:
        return [x * 3, 1.0, 7.0]
    return [1 / x, 2.0, 7.0] if x < 4 else [x - 1, x, 7.0]


def test_variants_of_another_branch_get_their_own_plan() -> None:
    counted = Counted(branches)
    own = Plans(counted)
    for _ in range(3):
        check(own, branches, [np.linspace(1.5, 3.5, 50).tolist()])
    assert (len(own.plans), counted.traced, counted.alone) == (1, 1, 0)
    own, values = Plans(counted), [np.linspace(0.1, 8, 61).tolist()]
    check(own, branches, values)
    assert [plan.signed for plan in own.plans] == [False, True, True]
    check(own, branches, values)  # by plans of any sign only, which serve more
    check(own, branches, [values[0][::-1]])
    assert (len(own.plans), counted.alone) == (4, 0)
    for _ in range(SAMPLED):  # a plan of one sign serves again when variants go alike
        check(own, branches, [np.linspace(0.1, 0.9, 61).tolist()])
    assert (own.plans[0].signed, own.plans[0].served) == (False, 61)


def test_variants_of_any_sign_share_a_plan() -> None:
    counted = Counted(lambda numbers: [numbers[0] * numbers[1], absolute(numbers[0])])
    own = Plans(counted)
    signs = np.array([[1, 1, -1, -1], [1, -1, 1, -1]]).repeat(8, axis=1)
    check(own, counted.function, signs * np.linspace(1, 2, 32))
    assert (len(own.plans), counted.alone) == (1, 0)


def test_few_variants_are_not_worth_a_plan_unless_they_come_often() -> None:
    counted = Counted(branches)
    check(Plans(counted), branches, [np.linspace(1.5, 3.5, FEW_VARIANTS).tolist()])
    assert (counted.traced, counted.alone) == (0, FEW_VARIANTS)
    counted = Counted(branches)
    own = Plans(counted)
    for number in range(40):
        check(own, branches, [[2.0 + number / 1000]])
    assert len(own.plans) == 1
    assert counted.alone == OFTEN


def test_a_few_variants_among_others_get_a_plan_when_they_come_again() -> None:
    counted = Counted(branches)
    own = Plans(counted)
    for first in np.linspace(0.6, 0.7, 30):
        check(own, branches, [[*np.linspace(1.5, 3.5, 50), *np.linspace(first, 0.9, FEW_VARIANTS)]])
    assert (counted.traced, counted.alone) == (2, FEW_VARIANTS)


def test_a_single_variant_has_the_numbers_of_the_function_with_and_without_a_plan() -> None:
    counted = Counted(branches)
    own = Plans(counted)
    for x in (*np.linspace(1.5, 3.5, 40).tolist(), 0.5, 5.0, 2.0):
        assert list(own.run_one([x], 3)) == branches([x])
    assert counted.traced + counted.alone < 12  # plans served the others


def special(numbers: Sequence[Number]) -> list[Number]:
    """No plan can be made where the first number is above 1e101."""
    return [numbers[0] / 3, numbers[0] * numbers[1]]


def test_special_cases_are_calculated_alone() -> None:
    """Among others, in front of them, and all by themselves: a few trials only."""
    for places, most_traced in (([0, 17], 2), (slice(100), 400), (slice(None), TRIALS)):
        counted = Counted(special)
        values = np.stack([np.linspace(1, 2, 400), np.linspace(3, 4, 400)])
        values[0, places] = 1e102
        check(Plans(counted), special, values)
        assert counted.traced <= most_traced
        assert 0 <= counted.alone - (values[0] > 2).sum() <= TRIALS


def test_bounds_of_a_plan_of_one_sign_do_not_reach_far() -> None:
    counted = Counted(lambda numbers: [numbers[0] + 1])
    own = Plans(counted)
    check(own, counted.function, 10.0 ** np.linspace(-9, 9, 181)[None, :])
    assert [plan.signed for plan in own.plans] == [False, True]
    ((bounds,), _) = (plan.ranges for plan in own.plans)
    assert bounds.high <= SPREAD**2 * bounds.low * (1 + 1e-12)


def test_numbers_that_wander_do_not_need_a_plan_each() -> None:
    counted = Counted(lambda numbers: [numbers[0] + numbers[1], numbers[0] * 3])
    own = Plans(counted)
    for step in range(200):  # from 1 to about 7 by one percent each
        values = 1.01**step * np.linspace(1, 1.001, 20)
        check(own, counted.function, [values.tolist(), values.tolist()])
    assert len(own.plans) <= 8
    assert counted.alone == 0


def test_a_long_plan_serves_again_after_other_numbers() -> None:
    """Numbers of each of the two sizes have a plan, so two calculations are traced."""
    counted = Counted(lambda numbers: [sum((numbers[0] * n for n in range(2, 99)), numbers[0])])
    own = Plans(counted)
    for size in (1.0, 1e6) * 3:
        check(own, counted.function, size * np.linspace([1], [2], 20).T)
    assert counted.traced == 2


def test_there_is_an_end_to_plans(monkeypatch: pytest.MonkeyPatch) -> None:
    assert plans.MOST_PLANS > 3
    monkeypatch.setattr(plans, "MOST_PLANS", 3)

    def steps(numbers: Sequence[Number]) -> list[Number]:
        return [numbers[0] * sum(bool(numbers[0] > step) for step in range(12))]

    counted = Counted(steps)
    own = Plans(counted)
    values = [np.repeat(np.arange(0.5, 12), 10).tolist()]
    check(own, steps, values)
    check(own, steps, values)
    # the plan of one sign serves too few to be run again beside those of any sign
    assert (len(own.plans), len(own.of_single), counted.traced) == (3, 3, 6)
    assert counted.alone < 90 + 100 - 3


def test_memory_used_again_holds_the_second_outcome() -> None:
    first = np.linspace(1.5, 3.5, 30)
    for second in (
        np.linspace(0.1, 0.9, 30),  # another constant
        np.linspace(4.5, 8, 30),  # no constant any more
        np.linspace(0.1, 8, 30),  # some of each
        np.linspace(2, 8, 30),  # constant for the first ones only
        np.array([2.0] * 26 + [0.5, 5.0, 6.0, 0.25]),  # constant but for a few, calculated alone
    ):
        for order in ([first, second, first], [second, first, second]):
            own, rows = Plans(branches), rows_for(3, 30)
            for values in order:
                check(own, branches, values[None, :], rows)
            for row, value in rows.holds.items():
                assert (rows.arrays[row] == value).all()


def test_constants_are_nan_or_of_the_type_of_their_row() -> None:
    def function(numbers: Sequence[Number]) -> list[Number]:
        is_small = bool(numbers[0] < 2)
        return [math.nan if is_small else 5.0, is_small, 3 if is_small else 4]

    own = Plans(function)
    rows = Rows([np.empty(10), np.empty(10, np.bool_), np.empty(10, np.int16)])
    for low in (1.0, 1.0, 3.0, 1.0, 3.0, 3.0):
        check(own, function, np.linspace(low, low + 0.5, 10)[None, :], rows)
    assert rows.holds == {0: 5.0, 1: False, 2: 4}


def test_more_variants_than_run_together() -> None:
    """So many that they run in several parts, the last of them a short one."""
    count = 2 * 8192 + 5
    values = np.random.default_rng(1).uniform(0.1, 8, count)
    rows = rows_for(3, count)
    Plans(branches).run(prepared(values[None, :]), rows)
    cases = [values < 1, values < 4]
    assert np.array_equal(rows.arrays[0], np.select(cases, [values * 3, 1 / values], values - 1))
    assert np.array_equal(rows.arrays[1], np.select(cases, [1.0, 2.0], values))


def test_a_function_that_fails_fails_for_all() -> None:
    def fails(_: Sequence[Number]) -> list[Number]:
        raise KeyError("nothing")

    with pytest.raises(KeyError, match="nothing"):
        Plans(fails).run(prepared(np.ones((1, 9))), rows_for(1, 9))


@settings(max_examples=count(20, 150))
@given(programs(), variants(most=20), variants(most=20))
def test_programs_give_every_variant_its_own_numbers(
    program: Program, values: Floats, others: Floats
) -> None:
    """Whatever came before: other variants, and the same in another order."""
    function = partial(run, program)
    own = Plans(function)
    for given_values in (values, others, values[:, ::-1], others[:, :1]):
        check(own, function, given_values)
