"""Roads: rolling resistance over speed, and a radius that falls with the torque.

Vehicles roll out in closed form and by solve_ivp; r = r_0 - lambda M is of Tarasik, table 1.1.
"""

import math
from typing import Any

import numpy as np
import pytest
from numpy.polynomial import Polynomial
from scipy.integrate import solve_ivp, trapezoid
from scipy.optimize import brentq

from tests.simulation.control.written import faults, simulated
from vstatics import Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.constants import AIR, GRAVITY
from vstatics.simulation import Road, Scenario, Start, constant, simulate
from vstatics.simulation.scenario.rolling_radius import LoadedWheel


def wheels(inertia: float) -> Transmission:
    return Transmission(1, [], [], [], inertias={1: inertia}, link_names=["wheels"])


MASS, RADIUS = 1000.0, 0.5


def rolls(speed: float, duration: float, rolling: Any, **more: float) -> Any:
    """From a speed of the vehicle [m/s]."""
    start, road = Start(speeds={1: speed / RADIUS}), Road(MASS, RADIUS, rolling, **more)
    return simulate(Scenario(wheels(MASS * RADIUS**2), duration, start, torques=((1, road),)))


def test_resistance_that_grows_with_speed_in_closed_form() -> None:
    """dv/dt = -g (a + b v): at rest at ln(1 + b v0/a)/(g b)."""
    a, slope, start = 0.01, 0.0005, 20.0
    motion = rolls(start, 150.0, ((0.0, a), (40.0, a + 40 * slope)))
    [stop] = [one for one in motion.events if one.event == "locks"]
    rest = math.log(1 + slope * start / a) / (GRAVITY * slope)
    assert stop.time == pytest.approx(rest, rel=1e-7)


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
    times = motion.time[moving]
    exact: Any = {"rtol": 1e-9, "atol": 1e-10, "max_step": 0.1, "t_eval": times}
    found = solve_ivp(slows, (0, float(times[-1])), [way * 25.0], **exact)
    assert RADIUS * motion.speeds[moving, 0] == pytest.approx(found.y[0], abs=1e-5)
    assert abs(motion.energy.balance) < 1e-6 * abs(motion.energy.kinetic)


def test_at_rest_it_holds_by_its_first_point() -> None:
    """A slope of .011 does not move what .012 holds."""
    held = rolls(0.0, 10.0, ((0.0, 0.012), (5.0, 0.001)), slope=0.011)
    assert not held.speeds.any()
    assert rolls(0.0, 10.0, ((0.0, 0.01), (5.0, 0.001)), slope=0.011).speeds[-1, 0] < 0


TRUCK, FREE, BY_TORQUE, AREA, SLOPE = 9000.0, 0.48, 3e-6, 6.0, 0.02
POINTS = ((0.0, 0.012), (10.0, 0.02), (25.0, 0.024))
CASE = wheels(TRUCK * FREE**2)
ROAD = Road(TRUCK, FREE, POINTS, AREA, SLOPE, BY_TORQUE)


def force(velocity: float) -> float:
    """Of rolling, ascent and air in forward motion [N]."""
    speeds, parts = zip(*POINTS, strict=True)
    rolling = float(np.interp(velocity, speeds, parts))
    return TRUCK * GRAVITY * (rolling + SLOPE) + AIR * AREA / 2 * velocity**2


def radius(turning: float) -> float:
    """The root of r = r_0 - lambda M with M = X(w r) r, by bisection [m]."""

    def left(r: float) -> float:
        return FREE - BY_TORQUE * r * force(turning * r) - r

    return brentq(left, 0.1, FREE, xtol=1e-15, rtol=1e-14)


def test_torque_and_velocity_fulfil_the_law_of_the_table() -> None:
    assert ROAD.wheel is not None
    for turning in np.random.default_rng(1).uniform(0.01, 90.0, 60):
        r = radius(turning)
        # what the contact of dry friction brings is in the torque of the road again
        whole = ROAD.rolling_torque - ROAD.torque(turning)
        assert whole == pytest.approx(r * force(turning * r), rel=1e-11)
        assert ROAD.wheel.velocity(turning) == pytest.approx(turning * r, rel=1e-12)
        assert ROAD.turning(turning * r) == pytest.approx(turning, rel=1e-12)


@pytest.mark.parametrize("way", [-1.0, 1.0])
def test_speeds_of_loaded_wheels_are_cubics_of_the_vehicle_speed(way: float) -> None:
    """Forces of a + k v + c v^2 reduce the radius: w = v (1 + lambda (a + k v + c v^2))/r_0."""
    wheel = LoadedWheel(0.5, 1e-5, 200.0, ((0.0, 1000.0), (40.0, 1800.0)), 3.0)
    cubic = Polynomial([0, 1 + 1e-5 * (200 + 1000), 1e-5 * 20, 1e-5 * 3]) / 0.5
    v = np.array([3.0, 11.0, 39.0])
    assert wheel.turning(way * v) == pytest.approx(way * cubic(v), rel=1e-12)
    first, second = wheel.turning_slopes(way * v)
    assert first == pytest.approx(cubic.deriv()(v), rel=1e-12)
    assert second == pytest.approx(way * cubic.deriv(2)(v), rel=1e-12)


def test_without_loss_of_radius_it_is_the_plain_road() -> None:
    plain, nearly = ROAD._replace(by_torque=0.0), ROAD._replace(by_torque=1e-18)
    turning = np.linspace(-80.0, 80.0, 161)
    growth = plain.rolling_growth
    assert growth is not None
    expected = plain.torque(turning) + [growth.at(float(one)) for one in turning]
    assert nearly.torque(turning) == pytest.approx(expected, rel=1e-9, abs=1e-9)
    assert nearly.rolling_torque == pytest.approx(plain.rolling_torque, rel=1e-9)


def test_a_truck_that_is_driven_moves_as_an_integrator_says() -> None:
    """From 5 m/s by 4 kN*m: the speed of the wheels, and that of the truck on them."""
    start, torque = ROAD.turning(5.0), 4000.0
    laws = ((1, ROAD), (1, constant(torque)))
    asked = [(f"vehicle_{name}", "wheels") for name in ("speed", "acceleration", "jerk")]
    motion = simulate(Scenario(CASE, 40.0, Start(speeds={1: start}), torques=laws), columns=asked)

    def speeds_up(_: float, w: Floats) -> list[float]:
        r = radius(float(w[0]))
        return [(torque - r * force(w[0] * r)) / CASE.inertias[1]]

    exact: Any = {"rtol": 1e-10, "atol": 1e-10, "t_eval": motion.time}
    expected = solve_ivp(speeds_up, (0, 40), [start], **exact).y[0]
    assert motion.speeds[:, 0] == pytest.approx(expected, rel=1e-6)
    v = np.array([w * radius(w) for w in expected])
    assert motion.asked["vehicle_speed"]["wheels"] == pytest.approx(v, rel=1e-6)
    slopes = np.gradient(v, motion.time)[5:-5]
    told = motion.asked["vehicle_acceleration"]["wheels"]
    assert told[5:-5] == pytest.approx(slopes, rel=2e-2, abs=2e-3)
    # the jerk jumps at the points of the rolling resistance; the radius contributes 3 % of it
    jerk = motion.asked["vehicle_jerk"]["wheels"]
    assert trapezoid(jerk, motion.time) == pytest.approx(told[-1] - told[0], rel=5e-3)


def scenario(road: str) -> tuple[str, str]:
    start = "duration: 2\nstart: {speeds: {wheels: 20 km/h}}\n"
    return f"{start}torques: {{wheels: [500, {{road: {road}}}]}}\n", "inertias: {wheels: 2100}\n"


def test_a_road_of_a_file_gives_the_wheels_the_speed_of_the_vehicle() -> None:
    """``r = 0.48 - 3e-6 r 9000 g 0.015`` at 20 km/h."""
    for road, radius in (
        ("radius: {free: .48, by_torque: 3e-6}, rolling: .015",
         0.48 / (1 + 3e-6 * 9000 * GRAVITY * 0.015)),
        ("radius: 500 mm, rolling: {over: speed, points: [[0, .01], [72 km/h, .02]]}", 0.5),
    ):  # fmt: skip
        motion = simulated(*scenario(f"{{mass: 9 t, {road}}}"))
        assert motion.speeds[0, 0] == pytest.approx(20 / 3.6 / radius, rel=1e-9)


FAULTS = [
    ("rolling: {over: speed, points: [[3, .01], [3, .02]]}", "read 3 after 3, expected ascending"),
    ("rolling: {over: speed, points: [[-1, .01]]}", "read -1, expected a speed of 0 or more"),
    ("rolling: {over: speed, points: [[0, -.01]]}", "expected a coefficient of 0 or more"),
    ("rolling: {over: speed, points: []}", "read no point, expected at least one"),
    ("rolling: {over: time, points: [[0, .01]]}", "read 'time', expected `speed`"),
    ("rolling: {points: [[0, .01]]}", "`over` is missing"),
    ("rolling: {over: speed, points: [[0, .01, 3]]}", "speed, coefficient"),
    ("rolling: {over: speed, points: [[1 kg, .01]]}", "a velocity"),
    ("rolling: much", "expected a number"),
    ("radius: {free: .48, by_torque: -1}", "by_torque: read -1"),
    ("radius: {free: 0, by_torque: 1e-6}", "radius: read 0"),
    ("radius: {by_torque: 1e-6}", "`free` is missing"),
    ("radius: {free: .48, by_torque: .1}", "expected a smaller number"),
    ("radius: -.3", "radius: read -0.3"),
]


def test_a_road_that_cannot_be_is_reported_at_its_place() -> None:
    for road, expected in FAULTS:
        other = "" if "radius" in road else ", radius: .5"
        [fault, *_] = faults(*scenario(f"{{mass: 9000, {road}{other}, slope: -.05}}"))
        assert fault.startswith("4:")
        assert expected in fault
