"""A gear with ideal mechanisms: with drag and without, what carries nothing."""

import pytest

from tests.core.statics.differential import train
from vstatics import Gear, Mechanism, Transmission, solve
from vstatics.core.statics.ideal import is_nothing, mechanism_torques

PAIR = Transmission(2, [], [Mechanism(1, 2, 0, 4, 0.95)], [Gear(), Gear(drag={2: 0.1})])
"""A gear pair of ratio 4; its output drags in the second gear."""


def test_drag_takes_from_the_torques_that_decide_the_signs_only() -> None:
    """Equilibrium of link 2: 4 without losses, of which drag takes .1."""
    ideal = solve(PAIR).gear(2).ideal
    assert ideal.torques.on_first_link == pytest.approx([1, 4])
    assert ideal.torques_with_drag.on_first_link == pytest.approx([1, 4 - 0.1])
    undragged = solve(PAIR).gear(1).ideal
    assert undragged.torques_with_drag is undragged.torques


def test_a_set_that_hangs_on_the_input_carries_nothing() -> None:
    """The clutch takes the input torque to the output; nothing reacts on the set."""
    ideal = solve(train([(1, 4)], Gear([1]), links=4, output=4)).gear(1).ideal
    assert mechanism_torques(ideal, ideal.variant.columns, ideal.torques) == [0]
    assert not is_nothing(ideal, ideal.variant.columns, ideal.torques, 1)


def test_a_stage_of_a_large_ratio_is_measured_by_its_own_links() -> None:
    """Stages of 1e6 one after another: the torque on the first is 1, the output takes 1e12."""
    stages = [Mechanism(1, 2, 0, 1e6), Mechanism(2, 3, 0, 1e6)]
    ideal = solve(Transmission(3, [], stages, [Gear()])).gear(1).ideal
    expected = [1, 1e6]  # each stage takes what the one before it gives
    assert mechanism_torques(ideal, ideal.variant.columns, ideal.torques) == pytest.approx(expected)
