"""Efficiency over a duty cycle."""

from __future__ import annotations

import pytest

from tests.summary.capacities import LOW, case
from vstatics import solve
from vstatics.summary.duty import Duty, cycle


def test_shares_of_energy_give_a_weighted_mean() -> None:
    made = cycle(solve(case()), Duty("energy", {"low": 1, "direct": 3, "N": 0}))
    assert [(one.gear, one.energy) for one in made.stages] == [("low", 0.25), ("direct", 0.75)]
    assert made.efficiency == pytest.approx(0.25 * LOW + 0.75)


def test_shares_may_have_a_sum_that_no_number_holds() -> None:
    made = cycle(solve(case()), Duty("energy", {"low": 1e308, "direct": 1e308}))
    assert [one.energy for one in made.stages] == [0.5, 0.5]
    assert made.efficiency == pytest.approx((LOW + 1) / 2)


def test_shares_of_time_are_weighted_by_the_input_power() -> None:
    """200 N*m at 1000 and at 2000 rpm: of equal times direct has twice the energy."""
    results = solve(case())
    made = cycle(results, Duty("time", {"low": 10, "direct": 10}))
    assert [one.energy for one in made.stages] == pytest.approx([1 / 3, 2 / 3])
    assert made.efficiency == pytest.approx((LOW + 2) / 3)
    made = cycle(results, Duty("time", {"creep": 2, "low": 1}))
    assert made.efficiency == pytest.approx(LOW)
