"""A closed-loop upshift by `scipy.integrate.solve_ivp`: the scenario `8hp70-upshift`, by hand.

The run knows from `simulate` when each step of the sequence begins. Meshes have no losses.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from itertools import pairwise

import numpy as np
from scipy.integrate import solve_ivp

from benchmarks.smoothed import Plant
from vstatics.core.numerics.arrays import Floats
from vstatics.simulation import Motion, Scenario
from vstatics.simulation.run import begun

STICKING = ("lock-up", "B", "E")
SMOOTHING = 1e-6
"""Slip at which three quarters of the capacity act. [rad/s]"""
STATES = 6
"""States of the control: ramp, aim, e, grip, release, cut."""
INERTIA_PHASE = 4
"""Step that sets the slip to be followed, which falls to 0 in 0.35 s."""
STEPS: tuple[dict[str, float], ...] = (
    {"base": 0, "rise": 0, "hold": 1500, "closed": 0, "fall": 0, "less": 0},
    {"base": 30, "hold": 150},
    {"rise": 1500},
    {"hold": 0, "rise": 300},
    {"rise": 0, "closed": 1, "less": 150},
    {"fall": 60},
    {"closed": 0, "less": 0},
    {"base": 900},
)
"""Numbers that each step of the sequence sets."""
SPEEDS = np.array([80.0, 200.0, 450.0, 680.0, 720.0])
ENGINE = 0.4 * np.array([150.0, 220, 200, 100, -80]) + 0.6 * np.array([380.0, 420, 400, 300, 0])


class ClosedLoop(Plant):
    """Driveline with engine map, road and controlled clutches."""

    def __init__(self, scenario: Scenario, motion: Motion) -> None:
        system, names = begun(scenario, step=None, rtol=1e-9).system, scenario.case.link_names
        rows = {contact.name: contact.row for contact in system.contacts}
        sides = np.zeros(len(names))
        sides[names.index("left side")], sides[names.index("right side")] = 1.0, -1.0
        super().__init__(system, motion, *(rows[name] for name in STICKING), sides)
        self.slips = np.array([rows["A"], rows["C"]]) @ self.free
        self.engine, self.vehicle = (self.free[names.index(one)] for one in ("engine", "vehicle"))
        self.start = np.concatenate([self.start, [0.0, 0.0, 0.0, 0.0, 1500.0, 0.0]])
        steps = [one.time for one in motion.events if one.event == "step"]
        self.times = [0.0, *steps, scenario.duration]

    def derivative(self, given: Mapping[str, float], _time: float, state: Floats) -> Floats:
        """Return the derivative of the state with the numbers of a step."""
        x, (ramp, aim, e, grip, release, cut) = state[:-STATES], state[-STATES:]
        speeds = x[: self.speeds]
        slips = self.slips @ speeds
        friction = np.array([release, max(grip, 0.0)]) * np.tanh(slips / SMOOTHING)
        driven = np.interp(self.engine @ speeds, SPEEDS, ENGINE) - cut
        v = 0.33 * self.vehicle @ speeds
        road = -0.33 * (1900 * 9.81 * 0.012 * np.sign(v) + 0.6 * 0.7 * v * abs(v))
        torques = self.engine * driven + self.vehicle * road - self.slips.T @ friction
        off = given["closed"] * (abs(slips[1]) - aim)
        control = [
            given["rise"],
            -given["fall"] if aim > 0 else 0.0,
            12.0 * off,
            (given["base"] + ramp + given["closed"] * e + 0.6 * off - grip) / 0.03,
            (given["hold"] - release) / 0.03,
            (given["less"] - cut) / 0.02,
        ]
        return np.concatenate([self.linear @ x + self.into @ torques, control])

    def jacobian(self, given: Mapping[str, float], time: float, state: Floats) -> Floats:
        """Return the Jacobian by differences; that of SciPy overflows where nothing changes."""
        now, step = self.derivative(given, time, state), 1e-3 * SMOOTHING
        shifted = state + step * np.eye(len(state))
        return np.array([self.derivative(given, time, one) - now for one in shifted]).T / step

    def last_speeds(self, tolerance: float) -> Floats:
        """Return the speeds of the links at the end, step by step."""
        state, given = self.start, dict(STEPS[0])
        for number, (begin, end) in enumerate(pairwise(self.times)):
            given |= STEPS[number]
            if number == INERTIA_PHASE:
                aim = abs(self.slips[1] @ state[: self.speeds])
                state[-STATES + 1], given["fall"] = aim, aim / 0.35
            run = solve_ivp(
                partial(self.derivative, given),
                (begin, end),
                state,
                "BDF",
                jac=partial(self.jacobian, given),
                rtol=tolerance,
                atol=tolerance,
            )
            state = run.y[:, -1]
        return np.asarray(self.free @ state[: self.speeds])
