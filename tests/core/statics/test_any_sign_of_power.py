"""Loads of all four quadrants: power enters where the signs of speed and torque say it."""

import math
from itertools import product

import numpy as np
import pytest

from tests.chance import examples, generator, ranges_with_slow
from tests.core.statics.test_drag import checked, much_drag
from tests.core.statics.test_freewheels import turned_round, with_freewheels
from vstatics import Gear, Load, Mechanism, Transmission, solve
from vstatics.core.readers import loads

PAIR = Mechanism(1, 2, 0, -2.5, 0.96)


def pair(load: Load, coast: bool | None = None) -> Transmission:
    return Transmission(2, [], [PAIR], [Gear(drag={2: 0.01})], load=load, coast=coast)


def test_coast_turns_the_torque_whatever_its_sign() -> None:
    """True: against the speed, false: along it, left out: as it is."""
    for speed, torque in product((2000.0, -2000.0), (300.0, -300.0)):
        size = math.copysign(300.0, speed)
        for coast, same in ((True, -size), (False, size), (None, torque)):
            told = solve(pair(Load(speed, torque), coast=coast))
            own = solve(pair(Load(speed, same)))
            for name in ("lossy_torques_Nm", "losses_kW", "efficiency", "speeds_rpm"):
                np.testing.assert_array_equal(getattr(told, name), getattr(own, name))


def test_a_gear_may_coast_by_itself() -> None:
    gears = [Gear(), Gear(coast=True), Gear(coast=False), Gear(load=Load(torque=-100.0))]
    case = Transmission(2, [], [PAIR], gears, load=Load(2000.0, 300.0), coast=None)
    assert [case.coasts(gear) for gear in case.gears] == [False, True, False, True]
    drive, brake = -2.5 * 0.96, -2.5 / 0.96
    expected = [300 * drive, -300 * brake, 300 * drive, -100 * brake]
    np.testing.assert_allclose(solve(case).lossy_output_torque_Nm, expected)
    driven = case.with_coast(True)
    assert all(map(driven.coasts, driven.gears))
    assert solve(case, coast=False).lossy_output_torque_Nm[1] == pytest.approx(300 * drive)


@ranges_with_slow(5, 25, 400)
def test_all_quadrants_with_drag_are_those_of_exact_fractions(seeds: range) -> None:
    """The load's signs alone tell it here; the oracle, which tries all signs, is told by a flag."""
    for base in (much_drag(20_000 + seed) for seed in seeds):
        for speed, torque in product((1500.0, -1500.0), (80.0, -80.0)):
            told = base.replace(coast=speed * torque < 0)
            checked(told)
            by_load = solve(base.replace(load=Load(speed, torque), coast=None))
            by_flag = solve(told)
            for name in ("lossy_torques", "efficiency", "drag_losses", "locked", "dragged"):
                found, expected = getattr(by_load, name), getattr(by_flag, name)
                np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-12)


@examples(6, 20, 200)
def test_freewheels_go_by_physical_signs(examples: int) -> None:
    """Turned the other way with the links of each freewheel swapped a train is the same."""
    for made in map(with_freewheels, range(examples)):
        bare = [gear._replace(load=None, coast=None, input_turns="") for gear in made.gears]
        case = made.replace(gears=bare, coast=None)
        for torque in (80.0, -80.0):
            one = solve(case.replace(load=Load(1500.0, torque)))
            two = solve(turned_round(case).replace(load=Load(-1500.0, -torque)))
            np.testing.assert_array_equal(one.holds, two.holds)
            np.testing.assert_allclose(one.speeds, two.speeds, rtol=1e-9, atol=1e-12)
            np.testing.assert_allclose(one.efficiency, two.efficiency, rtol=1e-9)


CONVERTER = """links: [engine, output]
load: {speed: 200 rad/s, torque: 100 N*m}
mechanisms:
  TC: {kind: converter, first: engine, second: output, speed_ratio: 0.5, points: [[0, 2], [1, 1]]}
drag: {output: 4 N*m}
"""


def test_a_converter_of_any_speed_ratio_has_its_torque_and_efficiency_in_a_batch() -> None:
    """The output torque is K T minus the drag. Without power at the output, the efficiency is 0."""
    ratio = np.round(generator(275).uniform(-1, 1, 200), 3)
    ratio[:4] = [0.86, -0.86, 0, 1]
    results = solve(loads(CONVERTER), vary={"TC.speed_ratio": ratio})
    torque = 100 * (2 - np.clip(ratio, 0, 1)) - 4 * np.sign(ratio)
    np.testing.assert_allclose(results.lossy_output_torque_Nm[:, 0], torque, rtol=1e-13)
    efficiency = torque * np.maximum(ratio, 0) / 100
    np.testing.assert_allclose(results.efficiency[:, 0], efficiency, rtol=1e-13)
