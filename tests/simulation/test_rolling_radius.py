"""The radius that falls with the torque of the road, r = r_0 - lambda M (Tarasik, table 1.1)."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from tests.commands import vstatics
from vstatics import Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.constants import AIR, GRAVITY
from vstatics.simulation.run import simulate
from vstatics.simulation.scenario.laws import Road, constant
from vstatics.simulation.scenario.parts import Scenario, Start

MASS, FREE, BY_TORQUE, AREA, SLOPE = 9000.0, 0.48, 3e-6, 6.0, 0.02
POINTS = ((0.0, 0.012), (10.0, 0.02), (25.0, 0.024))
INERTIA = MASS * FREE**2
CASE = Transmission(1, [], [], [], inertias={1: INERTIA}, link_names=["wheels"])
ROAD = Road(MASS, FREE, POINTS, AREA, SLOPE, BY_TORQUE)


def force(velocity: float) -> float:
    """Of rolling, ascent and air in forward motion [N]."""
    speeds, parts = zip(*POINTS, strict=True)
    rolling = float(np.interp(velocity, speeds, parts))
    return MASS * GRAVITY * (rolling + SLOPE) + AIR * AREA / 2 * velocity**2


def radius(turning: float) -> float:
    """The root of r = r_0 - lambda M with M = X(w r) r, by bisection [m]."""
    return brentq(
        lambda r: FREE - BY_TORQUE * r * force(turning * r) - r, 0.1, FREE, xtol=1e-15, rtol=1e-14
    )


def test_torque_and_velocity_fulfil_the_law_of_the_table() -> None:
    assert ROAD.wheel is not None
    for turning in np.random.default_rng(1).uniform(0.01, 90.0, 60):
        r = radius(turning)
        # what the contact of dry friction brings is in the torque of the road again
        whole = ROAD.rolling_torque - ROAD.torque(turning)
        assert whole == pytest.approx(r * force(turning * r), rel=1e-11)
        assert ROAD.wheel.velocity(turning) == pytest.approx(turning * r, rel=1e-12)
        assert ROAD.turning(turning * r) == pytest.approx(turning, rel=1e-12)


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
    scenario = Scenario(
        CASE, 40.0, Start(speeds={1: start}), torques=((1, ROAD), (1, constant(torque)))
    )
    motion = simulate(
        scenario, columns=[("vehicle_speed", "wheels"), ("vehicle_acceleration", "wheels")]
    )

    def speeds_up(_: float, w: Floats) -> list[float]:
        r = radius(float(w[0]))
        return [(torque - r * force(w[0] * r)) / INERTIA]

    found = solve_ivp(speeds_up, (0, 40), [start], rtol=1e-10, atol=1e-10, t_eval=motion.time)
    expected = found.y[0]
    assert motion.speeds[:, 0] == pytest.approx(expected, rel=1e-6)
    v = np.array([w * radius(w) for w in expected])
    assert motion.asked["vehicle_speed"]["wheels"] == pytest.approx(v, rel=1e-6)
    slopes = np.gradient(v, motion.time)[5:-5]
    told = motion.asked["vehicle_acceleration"]["wheels"][5:-5]
    assert told == pytest.approx(slopes, rel=2e-2, abs=2e-3)


def write(folder: Path, road: str) -> None:
    (folder / "box.yaml").write_text(
        "links: [wheels]\ninput: wheels\noutput: wheels\ninertias: {wheels: 2100}\ngears: {}\n"
    )
    (folder / "s.yaml").write_text(
        "case: box.yaml\nduration: 2\nstart: {speeds: {wheels: 20 km/h}}\n"
        f"torques: {{wheels: [500, {{road: {road}}}]}}\n"
    )


def test_from_a_file(folder: Path) -> None:
    write(folder, "{mass: 9000, radius: {free: .48, by_torque: 3e-6}, rolling: .015}")
    said = vstatics("simulate", "s.yaml", "--out", "vehicle_speed", "-f", "csv")
    assert said.status == 0, said.err
    head, first, *_ = (line.split(",") for line in said.out.splitlines())
    [column] = [n for n, one in enumerate(head) if one.startswith("vehicle_speed")]
    assert float(first[column]) == pytest.approx(20 / 3.6, rel=1e-9)


@pytest.mark.parametrize(
    ("radius_key", "what"),
    [
        ("{free: .48, by_torque: -1}", "by_torque: read -1"),
        ("{free: 0, by_torque: 1e-6}", "radius: read 0"),
        ("{free: .48, by_force: 1e-6}", "unknown key `by_force`"),
        ("{by_torque: 1e-6}", "`free` is missing"),
        ("{free: .48, by_torque: .1}", "expected a smaller number"),
        ("-.3", "radius: read -0.3"),
    ],
)
def test_a_radius_that_cannot_be_is_told_at_its_place(
    folder: Path, radius_key: str, what: str
) -> None:
    write(folder, f"{{mass: 9000, radius: {radius_key}, slope: -.05}}")
    said = vstatics("simulate", "s.yaml")
    assert said.status == 1
    assert said.err.startswith("s.yaml:4:")
    assert what in said.err
