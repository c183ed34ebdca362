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
