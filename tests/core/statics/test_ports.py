"""Ports: speed, torque and power where power enters and leaves, and what is lost between."""

import math

import pytest
from hypothesis import given, settings

from tests.chance import count
from tests.trains import regular_trains
from vstatics import Gear, Mechanism, Transmission, solve
from vstatics.core.model.parts import SpeedOf
from vstatics.core.statics.ports import ports

SET = Mechanism(1, 2, 3, ratio=-2.0, efficiency=0.96)


def test_the_wheels_of_a_car_on_a_curve() -> None:
    """An axle differential of efficiency 1: each wheel has half of the torque, 1/2.

    With FR = 1.1 FL and their mean 1, FL = 2/2.1; power is torque times speed.
    """
    axle = Mechanism(2, 3, 1, ratio=-1.0)
    case = Transmission(3, [], [axle], [Gear(speeds={3: SpeedOf(2, 1.1)})], outputs=[2, 3])
    results = solve(case)
    found = ports(results.gear(1))
    ways = [(one.link, one.is_output, one.way) for one in found.ports]
    assert ways == [(1, False, "in"), (2, True, "out"), (3, True, "out")]
    left = 2 / 2.1
    assert results.with_numbers_only.gears[0].speeds == pytest.approx({3: 1.1 * left})
    assert [one.speed for one in found.ports] == pytest.approx([1, left, 1.1 * left])
    assert [one.torque for one in found.ports] == pytest.approx([1, 0.5, 0.5])
    assert [one.power for one in found.ports] == pytest.approx([1, 0.5 * left, 0.55 * left])


def test_a_brake_has_no_power_and_a_motor_adds_its_own() -> None:
    """The ring stands: carrier at 1/3; a torque of .5 on it from outside drives, 1/6."""
    gear = Gear(speeds={2: 0.0}, torques={3: 0.5})
    case = Transmission(4, [], [SET, Mechanism(3, 4, 0, 1.0)], [gear])
    by_link = {one.link: one for one in ports(solve(case).gear(1)).ports}
    assert [*by_link] == [1, 4, 2, 3]
    assert (by_link[2].way, by_link[2].power) == ("", 0)
    assert (by_link[3].way, by_link[3].torque) == ("in", 0.5)
    assert by_link[3].power == pytest.approx(1 / 6)
    # with losses: the sun gives -u eta = 1.92 to the ring, 2.92 to the carrier
    assert by_link[4].torque == pytest.approx(2.92 + 0.5)
    # torques that statics leaves open have no power
    found = ports(solve(Transmission(3, [], [SET], [Gear()])).gear(1))
    assert math.isnan(found.ports[1].power)
    assert found.ports[1].way == ""


@settings(max_examples=count(10, 75))
@given(regular_trains())
def test_what_enters_less_what_leaves_is_lost(case: Transmission) -> None:
    results = solve(case)
    for number in range(1, len(case.gears) + 1):
        state = results.gear(number)
        found = ports(state)
        powers = [one.power for one in found.ports]
        if not state.consistent or any(map(math.isnan, powers)):
            continue
        sides = {"in": 1, "out": -1, "": 0}
        net = math.fsum(sides[one.way] * one.power for one in found.ports)
        assert net == pytest.approx(found.meshes + found.drag, abs=1e-9 * max(1, *powers))
