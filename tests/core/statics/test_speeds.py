"""Speeds of a gear: what conditions determine, what they contradict; numbers by Willis."""

import numpy as np
import pytest

from tests.core.statics.differential import texts, train
from tests.rejects import rejects
from vstatics import CaseError, Gear, Mechanism, ShiftElement, Transmission, solve
from vstatics.core.model.parts import SpeedOf
from vstatics.core.statics.speeds import is_tie


def test_given_speeds_may_contradict_each_other() -> None:
    """Ring held: the carrier turns at 1/(1 - u) = 1/3, not at 1/2."""
    contradiction = solve(train([(2, 0)], Gear([1], speeds={3: 0.5})))
    assert contradiction.failed
    assert "A, the input speed and the given speed of link 3 contradict" in texts(contradiction)[0]
    agreement = solve(train([(2, 0), (3, 4)], Gear([1, 2], speeds={3: 1 / 3}), links=4, output=4))
    assert not agreement.failed
    assert agreement.ratio == pytest.approx(3)


def test_a_speed_given_on_the_output_determines_speeds_but_no_torques() -> None:
    """(1 - w3)/(w2 - w3) = u with w3 = 1/4 gives w2 = -1/8."""
    results = solve(train([(2, 0)], Gear(speeds={3: 0.25})))
    assert results.speeds[0] == pytest.approx([1, -0.125, 0.25])
    assert np.isnan(results.torques).all()
    assert "give the speed of the reacting link instead" in texts(results)[0]
    held = solve(train([(2, 0)], Gear(speeds={2: -0.125})))
    assert held.speeds[0] == pytest.approx([1, -0.125, 0.25])
    assert held.output_torque == pytest.approx(3)  # of the set: 1 - u
    assert held.holding_torques[0, 1] == pytest.approx(2)  # of the ring: -u


def test_a_huge_ratio_does_not_hide_a_direct_gear() -> None:
    case = Transmission(3, [ShiftElement(1, 2)], [Mechanism(1, 2, 3, 1e308)], [Gear([1])])
    speeds = solve(case).speeds[0]
    assert not (speeds == 0).any()  # all links turn as one; what overflows is not told


def test_motion_against_the_carrier_is_none_where_it_is_a_tie() -> None:
    speeds = solve(train([(1, 2)], Gear([1]))).gear(1).ideal.speeds
    assert speeds.relative_speeds == [0]
    assert is_tie(1e-16, 1.0, 1.0)
    assert not is_tie(1e-6, 1.0, 1.0)


def four_wheels(speeds: dict[int, float | SpeedOf]) -> Transmission:
    """A centre differential between two axles: links engine, front, rear, FL, FR, RL, RR."""
    halves = [(2, 3, 1), (4, 5, 2), (6, 7, 3)]
    mechanisms = [Mechanism(*links, ratio=-1.0) for links in halves]
    return Transmission(7, [], mechanisms, [Gear(speeds=speeds)], output=4)


def test_speeds_that_follow_one_another_in_a_circle_leave_one_open() -> None:
    results = solve(four_wheels({5: SpeedOf(4), 6: SpeedOf(7, 2.0), 7: SpeedOf(6, 0.5)}))
    said = "the given speed of link 6 and the given speed of link 7 impose the same"
    assert said in str(texts(results))
    assert np.isnan(results.speeds[0, 5])


def test_a_speed_of_no_other_link_is_refused() -> None:
    refused: list[tuple[dict[int, float | SpeedOf], str]] = [
        ({5: SpeedOf(5)}, "the speed of link 5 is a multiple of itself"),
        ({5: SpeedOf(9)}, "read 9, expected a link number from 1 to 7"),
        ({5: SpeedOf(0)}, "read 0 (the housing), expected a link number from 1 to 7"),
        ({5: SpeedOf(4, 0.0)}, "read a factor of 0, expected a finite factor other than 0"),
        ({1: SpeedOf(4)}, "link 1 is the input, whose speed is 1"),
    ]
    for speeds, said in refused:
        with rejects(CaseError, said):
            four_wheels(speeds)
