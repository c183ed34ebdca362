"""A vehicle that is pushed along by a rough road, and grip over slip: what formulas add."""

import math
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.simulation.control.written import simulated
from vstatics.core.numerics.arrays import Floats

CASE = """
links: [z, x, pitch, z2, z3, x2, x3, road1, road2]
masses: {{z: 5000, x: 5000, z2: 400, z3: 800, x2: 400, x3: 800, road1: 0, road2: 0}}
inertias: {{pitch: 7000}}
springs:
  front: {{twist: {{z: 1, pitch: 1.5, z2: -1}}, stiffness: 2e5, damping: 6e3, friction: {front}}}
  rear: {{twist: {{z: 1, pitch: -2.1, z3: -1}}, stiffness: 3e5, damping: 8e3, friction: {rear}}}
  tyre1: {{links: [z2, road1], stiffness: 9e5}}
  tyre2: {{links: [z3, road2], stiffness: 1.6e6}}
  along1: {{twist: {{x2: 1, x: -1, pitch: -.8}}, stiffness: 4e6, damping: 9e3}}
  along2: {{twist: {{x3: 1, x: -1, pitch: -.7}}, stiffness: 5e6, damping: 9e3}}
  drive: {{twist: {{x: 1, pitch: .9}}, stiffness: 2.5e5, damping: 4e3}}
gears: {{"1": []}}
"""
SCENARIO = """duration: 0.8
start: {speeds: {z: 0, x: 0, pitch: 0, z2: 0, z3: 0, x2: 0, x3: 0}}
speeds: {road1: "0.24*sin(12*t)", road2: "0.24*sin(9*t)"}
torques:
  x2: "-(28e3 - 9e5*twist('tyre1'))*0.24*sin(12*t)/(20 + speed('x')) + 9e5*twist('tyre1')*.015"
"""
ROWS = np.array(
    [  # of z, x, pitch, z2, z3, x2, x3
        [1, 0, 1.5, -1, 0, 0, 0],
        [1, 0, -2.1, 0, -1, 0, 0],
        [0, 0, 0, 1, 0, 0, 0],
        [0, 0, 0, 0, 1, 0, 0],
        [0, -1, -0.8, 0, 0, 1, 0],
        [0, -1, -0.7, 0, 0, 0, 1],
        [0, 1, 0.9, 0, 0, 0, 0],
    ]
)
HEAVY = np.array([5000, 5000, 7000, 400, 800, 400, 800])
STIFFNESS = np.array([2e5, 3e5, 9e5, 1.6e6, 4e6, 5e6, 2.5e5])
DAMPING = np.array([6e3, 8e3, 0, 0, 9e3, 9e3, 4e3])


def on_rough_road(leaves: tuple[float, float]) -> Floats:
    """(5.1) after .8 s, by an integrator; the friction of the leaves is smoothed."""

    def change(t: float, state: Floats) -> Floats:
        speeds, twists = state[:7], state[7:]
        slope = 0.24 * math.sin(12 * t)
        rates = ROWS @ speeds
        rates[2] -= slope
        rates[3] -= 0.24 * math.sin(9 * t)
        forces = STIFFNESS * twists + DAMPING * rates
        forces[:2] += np.array(leaves) * np.tanh(rates[:2] / 1e-5)
        load = -9e5 * twists[2]
        pushed = np.zeros(7)
        pushed[5] = -(load + 28e3) * slope / (20 + speeds[1]) - load * 0.015
        return np.concatenate([(pushed - ROWS.T @ forces) / HEAVY, rates])

    method = "LSODA" if any(leaves) else "DOP853"
    exact: Any = {"method": method, "rtol": 1e-10, "atol": 1e-12}
    made = solve_ivp(change, (0, 0.8), np.zeros(14), **exact)
    end: Floats = made.y[:7, -1]
    return end


@pytest.mark.parametrize(("leaves", "near"), [((0, 0), 1e-9), ((900, 1500), 2e-5)])
def test_a_rough_road_pushes_along(leaves: tuple[float, float], near: float) -> None:
    """(5.1): compliance along, friction of leaves, the push ``(Y + P) q'/(v + x')``."""
    motion = simulated(SCENARIO, CASE.format(front=leaves[0], rear=leaves[1]))
    assert motion.speeds[-1, :7] == pytest.approx(on_rough_road(leaves), abs=near)
    assert abs(motion.energy.balance) < 1e-6
    assert (sum(motion.energy.heat.values()) > 0) == any(leaves)


TAKING_OFF = """duration: 1
start: {speeds: {wheel: 20, car: 2}}
tables: {grip: [[0, 0], [.1, .8], [1, .6]]}
torques: {wheel: "900 - 300*t"}
limits: {tyre: "3000*grip(max(0, (speed('wheel')*.4 - speed('car'))/(speed('wheel')*.4)))"}
"""


def test_grip_follows_the_slip_of_the_wheel() -> None:
    """Table 1.1: ``X <= G phi(delta)``, ``delta = (w r - v)/(w r)``; once it slips."""
    motion = simulated(
        TAKING_OFF,
        "{masses: {car: 300}, inertias: {wheel: 5},"
        " springs: {tyre: {twist: {wheel: .4, car: -1}, stiffness: 2e5}}}",
    )

    def force(speeds: Floats) -> float:
        slip = (speeds[0] * 0.4 - speeds[1]) / (speeds[0] * 0.4)
        return float(3000 * np.interp(slip, [0, 0.1, 1], [0, 0.8, 0.6]))

    def change(t: float, speeds: Floats) -> list[float]:
        pushed = force(speeds)
        return [(900 - 300 * t - 0.4 * pushed) / 5, pushed / 300]

    gripped = next(event.time for event in motion.events if event.event == "slips")
    at = int(np.searchsorted(motion.time, gripped, side="right")) - 1
    by_name = [motion.links.index(name) for name in ("wheel", "car")]
    exact: Any = {"rtol": 1e-11, "atol": 1e-12, "max_step": 0.01}
    made = solve_ivp(change, (gripped, 1), motion.speeds[at, by_name], "DOP853", **exact)
    assert motion.speeds[-1, by_name] == pytest.approx(made.y[:, -1], abs=1e-8)
    assert abs(motion.energy.balance) < 1e-6
