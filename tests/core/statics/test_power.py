"""Power: torque times speed, at ports and devices."""

import math

import numpy as np
import pytest

from vstatics import Gear, Load, Mechanism, ShiftElement, Spring, Transmission, solve
from vstatics.core.model.laws import MapLaw
from vstatics.core.model.parts import RAD_PER_RPM
from vstatics.core.numerics.traced import plain
from vstatics.core.statics.power import LinkPower, power


def total(powers: list[LinkPower], *kinds: str) -> float:
    return sum(plain(one.power) for one in powers if one.kind in kinds)


def test_the_loss_of_a_gear_is_power_that_its_input_gives() -> None:
    """300 W of the 3 kW at 100 rad/s and 30 N*m."""
    loss = MapLaw([0, 50], [[0, 300, 300], [200, 300, 300]], "W")
    load, pair = Load(100 / RAD_PER_RPM, 30), Mechanism(1, 2, 0, 4)
    powers = solve(Transmission(2, [], [pair], [Gear(loss=loss)], load=load)).gear(1).powers()
    assert total(powers, "gear") == pytest.approx(0.1)
    assert total(powers, "port") == pytest.approx(-0.1)


def test_each_spring_passes_the_power_of_its_own_torque() -> None:
    """Before a pair of ratio 4 the torque is 1 at the speed 1, behind it 4 at 1/4; each to 1."""
    springs = [Spring({1: 1, 2: -1}, 9e4, name="in"), Spring({3: 1, 4: -1}, 9e4, name="out")]
    pair, brake = Mechanism(2, 3, 0, 4), ShiftElement(1, 4)
    case = Transmission(4, [brake], [pair], [Gear()], springs=springs)
    powers = [one for one in solve(case).gear(1).powers() if one.kind == "spring"]
    found = [(one.name, one.link, plain(one.power)) for one in powers]
    assert found == [("in", 1, 1), ("in", 2, -1), ("out", 3, 1), ("out", 4, -1)]


def test_nothing_times_what_does_not_exist_is_nothing() -> None:
    assert power(0.0, math.nan) == power(math.nan, 0.0) == 0
    assert np.isnan(plain(power(1.0, math.nan)))
    assert power(2.0, -0.5) == -1
