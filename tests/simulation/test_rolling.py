"""Rolling resistance over speed: vehicles that roll out, in closed form and by solve_ivp."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.commands import vstatics
from vstatics import Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.constants import AIR, GRAVITY
from vstatics.simulation.run import simulate
from vstatics.simulation.scenario.laws import Road
from vstatics.simulation.scenario.parts import Scenario, Start

MASS, RADIUS = 1000.0, 0.5
CASE = Transmission(1, [], [], [], inertias={1: MASS * RADIUS**2}, link_names=["wheels"])


def rolls(speed: float, duration: float, rolling: Any, **more: float) -> Any:
    """From a speed of the vehicle [m/s]."""
    road = Road(MASS, RADIUS, rolling, **more)
    return simulate(
        Scenario(CASE, duration, Start(speeds={1: speed / RADIUS}), torques=((1, road),))
    )


def test_resistance_that_grows_with_speed_in_closed_form() -> None:
    """dv/dt = -g (a + b v): v = (v0 + a/b) exp(-g b t) - a/b, at rest at ln(1 + b v0/a)/(g b)."""
    a, slope, start = 0.01, 0.0005, 20.0
    motion = rolls(start, 150.0, ((0.0, a), (40.0, a + 40 * slope)))
    rest = math.log(1 + slope * start / a) / (GRAVITY * slope)
    [stop] = [one for one in motion.events if one.event == "locks"]
    assert stop.time == pytest.approx(rest, rel=1e-7)
    at = motion.time <= rest
    expected = (start + a / slope) * np.exp(-GRAVITY * slope * motion.time[at]) - a / slope
    assert RADIUS * motion.speeds[at, 0] == pytest.approx(expected, abs=1e-6)


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_points_with_corners_and_air(way: float) -> None:
    """Forward and backward; a coefficient that falls first, constant beyond the last point."""
    points = ((2.0, 0.02), (8.0, 0.012), (15.0, 0.03))
    motion = rolls(way * 25.0, 60.0, points, drag_area=0.8)
    speeds, parts = zip(*points, strict=True)

    def slows(_: float, v: Floats) -> list[float]:
        rolling = GRAVITY * float(np.interp(abs(v[0]), speeds, parts))
        return [-math.copysign(rolling, v[0]) - AIR * 0.8 / 2 / MASS * v[0] * abs(v[0])]

    moving = motion.time < 50
    end = float(motion.time[moving][-1])
    found = solve_ivp(
        slows,
        (0, end),
        [way * 25.0],
        rtol=1e-9,
        atol=1e-10,
        max_step=0.1,
        t_eval=motion.time[moving],
    )
    assert RADIUS * motion.speeds[moving, 0] == pytest.approx(found.y[0], abs=1e-5)
    assert abs(motion.energy.balance) < 1e-6 * abs(motion.energy.kinetic)


def test_points_that_do_not_change_are_the_number() -> None:
    by_points = rolls(20.0, 100.0, ((0.0, 0.02), (30.0, 0.02)))
    by_number = rolls(20.0, 100.0, 0.02)
    assert by_points.events == by_number.events
    assert by_points.energy.heat == pytest.approx(by_number.energy.heat)


def test_at_rest_it_holds_by_its_first_point() -> None:
    """A slope of .011 does not move what .012 holds."""
    held = rolls(0.0, 10.0, ((0.0, 0.012), (5.0, 0.001)), slope=0.011)
    assert not held.speeds.any()
    assert rolls(0.0, 10.0, ((0.0, 0.01), (5.0, 0.001)), slope=0.011).speeds[-1, 0] < 0


SCENARIO = """\
case: {inertias: {wheels: 250}}
duration: 5
start: {speeds: {wheels: 20}}
torques: {wheels: {road: {mass: 1 t, radius: 500 mm, rolling: %s}}}
"""


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize(
    ("rolling", "message"),
    [
        ("{over: speed, points: [[0, .01], [72 km/h, .02]]}", ""),
        ("{over: speed, points: [[3, .01], [3, .02]]}", "read 3 after 3, expected ascending spe"),
        ("{over: speed, points: [[-1, .01], [3, .02]]}", "read -1, expected a speed of 0 or more"),
        ("{over: speed, points: [[0, -.01], [3, .02]]}", "expected a coefficient of 0 or more"),
        ("{over: speed, points: []}", "read no point, expected at least one"),
        ("{over: time, points: [[0, .01]]}", "read 'time', expected `speed`"),
        ("{points: [[0, .01]]}", "`over` is missing"),
        ("{over: speed, points: [[0, .01, 3]]}", "speed, coefficient"),
        ("{over: speed, points: [[1 kg, .01]]}", "a velocity"),
        ("much", "expected a number"),
    ],
)
def test_a_scenario_has_it(
    rolling: str,
    message: str,
) -> None:
    Path("case.yaml").write_text("inertias: {wheels: 250}\n", encoding="utf-8")
    text = SCENARIO.replace("{inertias: {wheels: 250}}", "case.yaml", 1) % rolling
    Path("run.yaml").write_text(text, encoding="utf-8")
    found = vstatics("simulate", "run.yaml")
    assert message in found.err
    assert (found.status == 0) == (not message)
    assert not message or found.err.startswith("run.yaml:4:")
