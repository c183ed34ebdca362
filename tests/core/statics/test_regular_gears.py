"""Usual gears: nothing that `diagnosis` looks for at length is found in them."""

from __future__ import annotations

import pytest
from hypothesis import given

from tests.core.statics.differential import train
from tests.core.statics.test_status import FAULTY
from tests.shipped import shipped_results
from tests.strategies import transmissions
from vstatics import Gear, Mechanism, Transmission, solve
from vstatics.core.statics import diagnosis
from vstatics.core.statics.diagnosis import is_uncertain, regular_gears


@pytest.mark.slow
@given(transmissions())
def test_of_a_usual_gear_nothing_else_is_said(case: Transmission) -> None:
    results = solve(case)
    for number, is_usual in enumerate(regular_gears(results)):
        if is_usual:
            assert not list(diagnosis._of_irregular_gear(results, number, case.gears[number], ()))


@pytest.mark.parametrize("name", FAULTY)
def test_a_gear_at_fault_is_not_usual(name: str) -> None:
    case, number = FAULTY[name]
    assert not list(regular_gears(solve(case)))[number - 1]


def test_all_gears_of_the_published_example_are_usual() -> None:
    assert all(regular_gears(shipped_results("mzkt7922.dat")))


def test_a_torque_that_statics_leaves_open_is_not_usual() -> None:
    """Two brakes hold the ring, which share its torque in an unknown way."""
    brakes = [(2, 0), (2, 0)]
    assert list(regular_gears(solve(train(brakes, Gear([1, 2]))))) == [False]
    assert list(regular_gears(solve(train(brakes, Gear([1]))))) == [True]


def test_speeds_and_torques_of_a_pair_check_one_another() -> None:
    """Without losses the output torque is the ratio; with a given torque nothing follows."""
    pair = Transmission(2, [], [Mechanism(1, 2, 0, -2.5)], [Gear()])
    assert solve(pair).gear(1).output_speed == pytest.approx(-0.4)
    assert not is_uncertain(Gear(), -0.4, -2.5)
    assert is_uncertain(Gear(), -0.4, -2.6)
    assert not is_uncertain(Gear(torques={1: 0.5}), -0.4, -2.6)
