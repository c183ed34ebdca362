"""Points of operation: what varies in rad/s and N*m, beside each point as a case of its own."""

import math
from typing import Any

import numpy as np
import pytest

from tests.chance import count, seeded, with_slow
from tests.core.statics.batches import ARRAYS, alike
from tests.trains import random_train
from vstatics import Gear, Load, Mechanism, Results, Transmission, solve
from vstatics.core.model.parts import OfLoad
from vstatics.core.numerics.arrays import Floats
from vstatics.core.readers import from_dict
from vstatics.core.writers.named import mapping

IN_UNITS = (
    *("speeds_rpm", "torques_Nm", "losses_kW", "input_power_kW", "output_power_kW"),
    *("drag_losses_kW", "lossy_holding_torques_Nm"),
)
Vary = dict[str, Floats]


def varied(seed: int, case: Transmission, points: int) -> Vary:
    """Numbers of all kinds; loads change their sign, some numbers are 0."""
    rng = np.random.default_rng(seed)
    link = case.link_name(seeded(seed).randint(1, case.links))
    turns = rng.choice([-1, 1], points)
    vary = {
        "load.speed": turns * rng.uniform(50, 400, points),
        "load.torque": turns * rng.choice([1, 0, 1], points) * rng.uniform(20, 200, points),
        f"drag.{link}": rng.uniform(0, 3, points) * rng.choice([0, 1, 1], points),
        "D1.efficiency": rng.uniform(0.9, 1, points),
        "D1.back_efficiency": rng.uniform(0.8, 1, points),
    }
    if seed % 2:
        vary["D1.ratio"] = case.mechanisms[0].ratio * rng.uniform(0.9, 1.1, points)
    if case.shift_elements:
        vary[f"{case.shift_elements[0].name}.drag"] = rng.uniform(0, 3, points)
    for gear in case.gears:
        for one in gear.torques:
            path = f"gears.{gear.name}.torques.{case.link_name(one)}"
            vary[path] = rng.uniform(-50, 50, points)
        for one, speed in gear.speeds.items():
            if isinstance(speed, float):
                path = f"gears.{gear.name}.speeds.{case.link_name(one)}"
                vary[path] = rng.uniform(-100, 400, points)
    return vary


def at(case: Transmission, vary: Vary, point: int) -> Transmission:
    here = {path: float(numbers[point]) for path, numbers in vary.items()}
    gears = []
    for gear in case.gears:
        own: dict[str, Any] = {
            name: dict(getattr(gear, name)) for name in ("speeds", "torques", "drag", "open_drag")
        }
        for path, number in here.items():
            words = path.split(".")
            if words[0] == "gears" and words[1] == gear.name:
                unit = 30 / math.pi if words[2] == "speeds" else 1
                own[words[2]][case.link_number(words[3])] = OfLoad(number * unit, 1.0)
            elif words[0] == "drag":
                own["drag"][case.link_number(words[1])] = OfLoad(number, 1.0)
            elif words[1] == "drag":
                own["open_drag"][1] = OfLoad(number, 1.0)
        gears.append(gear._replace(**own))
    first, *others = case.mechanisms
    first = first._replace(
        ratio=here.get("D1.ratio", first.ratio),
        efficiency=here["D1.efficiency"],
        back_efficiency=here["D1.back_efficiency"],
    )
    load = Load(here["load.speed"] * 30 / math.pi, here["load.torque"])
    return case.replace(load=load, gears=gears, mechanisms=[first, *others])


def assert_same(together: Results, point: int, alone: Results) -> None:
    wrong = [n for n in ARRAYS if not alike(getattr(together, n)[point], getattr(alone, n))]
    assert not wrong
    for name in IN_UNITS:
        numbers, expected = getattr(together, name)[point], getattr(alone, name)
        size = max(1.0, float(np.abs(np.nan_to_num(expected)).max(initial=0)))
        np.testing.assert_allclose(numbers, expected, rtol=1e-11, atol=1e-11 * size)


@pytest.mark.parametrize("seed", with_slow(range(12), range(12, 12 + count(6, 200))))
def test_points_together_are_what_they_are_alone(seed: int) -> None:
    case = random_train(seeded(seed)).replace(load=Load(1500, 100))
    points = 8 if seed < 12 else 60
    vary = varied(seed, case, points)
    together = solve(case, vary=vary)
    for point in range(points):
        assert_same(together, point, solve(at(case, vary, point)))


def test_what_is_given_in_newton_metres_stays_while_the_load_varies() -> None:
    """A drag T_d at the input leaves eta = 1 - T_d/T; a bare number is a part of each load."""
    torque = np.linspace(50, 300, 60)
    pair = Mechanism(1, 2, 0, -2.5)
    for drag, expected in ((OfLoad(2.0, 1.0), 1 - 2 / torque), (0.02, np.full(60, 0.98))):
        case = Transmission(2, [], [pair], [Gear(drag={1: drag})], load=Load(1000, 100))
        found = solve(case, vary={"load.torque": torque})
        np.testing.assert_allclose(found.efficiency[:, 0], expected, rtol=1e-13)
        np.testing.assert_allclose(found.torques_Nm[:, 0, -1], -2.5 * torque, rtol=1e-13)


@pytest.mark.parametrize("by_gear", [False, True])
def test_a_power_that_is_given_stays_at_every_speed(by_gear: bool) -> None:
    """As in a case that tells each speed beside it: T = P/w, with a drag that does not change."""
    power, text = 100.0, {"links": ["a", "b"], "drag": {"b": "7 N*m"}}
    text |= {"mechanisms": {"P": {"first": "a", "second": "b", "ratio": 3, "efficiency": 0.98}}}

    def told(speed: float) -> Transmission:
        own = {"speed": f"{speed!r} rpm", "power": f"{power} kW"}
        gear = {"load": {"speed": own.pop("speed")}} if by_gear else {}
        common = {"speed": "2000 rpm"} | own
        return from_dict({**text, "gears": {"1": gear}, "load": common})

    speeds = np.array([500.0, -1000.0, 4000.0])
    for path in ["gears.1.load.speed"] + ["load.speed"] * (not by_gear):
        varied = solve(told(2000.0), vary={path: speeds * math.pi / 30})
        np.testing.assert_allclose(varied.input_power_kW[:, 0], power, rtol=1e-12)
        for row, speed in enumerate(speeds.tolist()):
            alone = solve(told(speed))
            assert varied.output_torque_Nm[row] == pytest.approx(alone.output_torque_Nm)
    given = solve(told(2000.0), vary={"gears.1.load.torque": np.array([50.0])})
    assert given.input_power_kW[0] == pytest.approx(50 * 2000 * math.pi / 30e3)
    read = told(1234.5)
    assert from_dict(mapping(read)) == read
