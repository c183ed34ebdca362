"""What a vehicle can: closed forms, and an integrator of its own."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.commands import json_answer, json_file, vstatics
from tests.vehicle.operation.cycles import cycled
from vstatics import Gear, Mechanism, ShiftElement, Transmission, load
from vstatics.core.model.parts import OfLoad
from vstatics.core.numerics.constants import AIR, GRAVITY
from vstatics.vehicle.case.vehicle import Vehicle
from vstatics.vehicle.operation.traction import performance

CLUTCHES = [ShiftElement(1, 2), ShiftElement(1, 3)]
PAIRS = [Mechanism(2, 4, 0, 3.5, 0.97), Mechanism(3, 4, 0, 1.5, 0.98)]


def box(vehicle: Vehicle, **more: Any) -> Transmission:
    gears = [Gear([1], name="low"), Gear([2], name="high")]
    return Transmission(4, CLUTCHES, PAIRS, gears, vehicle=vehicle, **more)


def one_gear(vehicle: Vehicle, **more: Any) -> Transmission:
    return Transmission(2, [], [Mechanism(1, 2, 0, 4.0)], [Gear()], vehicle=vehicle, **more)


def test_coastdown_terms_of_a_road_are_rolling_points_and_air() -> None:
    """R = A + B v + C v^2 (Davis): the time is a logarithm with the roots of F - R.

    https://github.com/openrails/openrails/pull/203, and A, B, C of road loads by EPA.
    """
    a, b, c, force, m = 120.0, 4.0, 0.45, 3200.0, 1000.0
    rolling = [(0.0, a / m / GRAVITY), (100.0, (a + 100 * b) / m / GRAVITY)]
    car = Vehicle(m, 0.25, rolling, 2 * c / AIR, 2.0, engine=[(0.0, 100.0), (2000.0, 100.0)])
    case = one_gear(car)
    fast, slow = sorted(np.roots([c, b, a - force]), reverse=True)
    v = 100 / 3.6
    time = m / c / (fast - slow) * math.log((v - slow) / (fast - v) * fast / -slow)
    answer = performance(case)
    assert answer.time_to_100 == pytest.approx(time, rel=1e-12)
    limited = one_gear(car._replace(engine=[(0.0, 100.0), (9000.0, 100.0)]))
    assert performance(limited).top_speed == pytest.approx(3.6 * min(fast, 9000 / 8 * 0.25))
    driven = cycled(case, "0,20\n10,20")
    assert driven.energy.wheels == pytest.approx((a + 20 * b + 400 * c) * 200, rel=1e-12)


@pytest.mark.parametrize(("rise", "at"), [(0.2, 0.0), (3.0, 12.5)])
def test_the_steepest_slope_is_where_force_outgrows_rolling_most(rise: float, at: float) -> None:
    """The engine ends at 400/4/2*0.25 = 12.5 m/s; its force rises linearly from 3200 N."""
    car = Vehicle(1000, 0.25, [(0.0, 0.01), (12.5, 0.05)], 0.0, 2.0)
    case = one_gear(car._replace(engine=[(0.0, 100.0), (400.0, 100.0 * (1 + rise / 10))]))
    force = 3200 * (1 + rise / 10 * at / 12.5) - 9810 * (0.01 + 0.04 * at / 12.5)
    assert performance(case).gears["1"].slope == pytest.approx(force / 9810, rel=1e-12)


def test_top_speed_is_where_force_is_resistance() -> None:
    """F falls from 4000 N to 0 over the engine, R = 500 N: at 7/8 of its speed."""
    car = Vehicle(1000, 0.5, 500 / (1000 * GRAVITY), 0.0, 1.0, engine=[(0.0, 500.0), (400.0, 0.0)])
    made = performance(one_gear(car))
    assert made.top_speed == pytest.approx(3.6 * 7 / 8 * 100 * 0.5, rel=1e-9)


def test_a_box_is_as_fast_as_its_forward_gears() -> None:
    """A reversing unit with the faster half of its gears backward, of names that tell it."""
    car = Vehicle(1000, 0.5, engine=[(0.0, 500.0), (400.0, 500.0)])
    ratios = {"RL": -8.0, "RM": -4.0, "RH": -2.0, "FL": 10.0, "FH": 5.0}
    case = Transmission(
        1 + len(ratios),
        [],
        [Mechanism(1, n, 0, ratio) for n, ratio in enumerate(ratios.values(), 2)],
        [Gear([], name=name, output=n) for n, name in enumerate(ratios, 2)],
        vehicle=car,
    )
    made = performance(case)
    assert made.top_speed == pytest.approx(3.6 * 400 / 5 * 0.5)
    assert made.gears["RH"].top_speed == pytest.approx(3.6 * 400 / 2 * 0.5)
    assert made.gears["FL"].slope == 1  # 500 N*m * 10/0.5 m are more than the weight


def test_slip_in_rpm_takes_speed_and_no_force() -> None:
    """The engine is 200 rad/s faster than its gear, and ends at 600 rad/s."""
    car = Vehicle(1000, 0.25, 0.0, 0.0, 2.0, engine=[(0.0, 100.0), (600.0, 100.0)])
    gear = Gear(slip={1: OfLoad(200 * 30 / math.pi, 1000)})
    case = Transmission(3, [ShiftElement(1, 2)], [Mechanism(2, 3, 0, 4.0)], [gear], vehicle=car)
    answer = performance(case)
    assert answer.top_speed == pytest.approx(3.6 * 400 / 4 / 2 * 0.25)
    assert answer.gears["1"].slope == pytest.approx(3200 / 1000 / GRAVITY)
    case = case.replace(vehicle=car._replace(engine=[(0.0, 100.0), (2000.0, 100.0)]))
    assert performance(case).time_to_100 == pytest.approx(100 / 3.6 * 1000 / 3200)


def test_the_best_gear_accelerates_as_an_integrator_finds_it() -> None:
    """Euler's rule by midpoints with the same engine, two gears, below and above its points."""
    points = [(100.0, 100.0), (300.0, 160.0), (600.0, 120.0)]
    car = Vehicle(1200, 0.3, 0.012, 0.65, 4.1, engine=points)
    made = performance(box(car, inertias={1: 0.15}))

    def acceleration(v: float) -> float:
        best = -math.inf
        for ratio, eta in ((3.5, 0.97), (1.5, 0.98)):
            k = ratio * 4.1 / 0.3
            if v * k <= 600:
                torque = np.interp(max(v * k, 100.0), *np.array(points).T)
                force = float(torque) * ratio * eta * 4.1 / 0.3
                rest = 1200 * GRAVITY * 0.012 + AIR * 0.65 / 2 * v**2
                best = max(best, (force - rest) / (1200 + 0.15 * k**2))
        return best

    steps = 40_000
    h = 100 / 3.6 / steps
    time = sum(h / acceleration((n + 0.5) * h) for n in range(steps))
    assert made.time_to_100 == pytest.approx(time, rel=1e-5)  # it steps over where a gear ends


@pytest.mark.parametrize("torque", [100.0, 120.0, 130.0, 1000.0])
def test_no_slope_is_steeper_than_a_wall(torque: float) -> None:
    """1000 kg take 9810 N up a wall and 98.1 N of rolling; the force is 80 times the torque.

    The engine ends at 400/4 .05 m/s = 18 km/h, so 100 km/h takes no time.
    """
    made = performance(one_gear(Vehicle(1000, 0.05, 0.01, engine=[(0.0, torque), (400.0, torque)])))
    expected = min((80 * torque - 98.1) / 9810, 1.0)
    assert made.gears["1"].slope == pytest.approx(expected, rel=1e-12)
    assert math.isnan(made.time_to_100)
    assert made.top_speed == pytest.approx(3.6 * 100 * 0.05)


def test_summary_tells_the_vehicle(tmp_path: Path) -> None:
    file = tmp_path / "car.yaml"
    file.write_text(
        "links: 2\nmechanisms: {pair: {first: 1, second: 2, ratio: 4}}\ngears: {low: []}\n"
        "vehicle: {mass: 1 t, radius: 50 cm, engine: [[0, 125], [400 rad/s, 125 N*m]],\n"
        "  rolling: {over: speed, points: [[0, 0], [180 km/h, 0]]}}\n"
    )
    told = json_answer("summary", file)["vehicle"]
    assert told["top_speed"] == pytest.approx(180)
    assert told["time_to_100"] == pytest.approx(100 / 3.6)
    assert told["gears"]["low"]["slope"] == pytest.approx(1000 / (1000 * GRAVITY))
    assert vstatics("convert", file, tmp_path / "back.json").status == 0
    assert Vehicle.needed(load(tmp_path / "back.json")) == Vehicle.needed(load(file))
    assert json_file(tmp_path / "back.json")["vehicle"]["radius"] == 0.5
