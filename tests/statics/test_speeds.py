"""Speeds of a gear: what conditions determine, what they contradict; numbers by Willis."""

from __future__ import annotations

import numpy as np
import pytest

from tests.statics.differential import texts, train
from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
from vstatics.statics.speeds import is_tie


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


def test_a_planetary_set_turns_as_willis_says() -> None:
    """(w_1 - w_3)/(w_2 - w_3) = -2 with each link held in turn: 1/3, -1/2, 2/3 of the input."""
    ring, carrier = train([(2, 0)], Gear([1])), train([(3, 0)], Gear([1]), output=2)
    sun = train([(1, 0)], Gear([1], input=2))
    assert solve(ring).speeds[0] == pytest.approx([1, 0, 1 / 3])
    assert solve(carrier).speeds[0] == pytest.approx([1, -1 / 2, 0])
    assert solve(sun).speeds[0] == pytest.approx([0, 1, 2 / 3])


def test_motion_against_the_carrier_is_none_where_it_is_a_tie() -> None:
    speeds = solve(train([(1, 2)], Gear([1]))).gear(1).ideal.speeds
    assert speeds.relative_speeds == [0]
    assert is_tie(1e-16, 1.0, 1.0)
    assert not is_tie(1e-6, 1.0, 1.0)
