"""Motions by `scipy.integrate.solve_ivp`, with friction smoothed to ``capacity*tanh(slip/s)``.

The equations are those of `vstatics.simulation.simulate`, as an engineer would write them for one
case: constant matrices, their Jacobian, and BDF from break point to break point. The state consists
of independent speeds and the twists of springs.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from itertools import pairwise

import numpy as np
from scipy.integrate import solve_ivp
from scipy.linalg import null_space

from vstatics.core.numerics.arrays import Floats
from vstatics.simulation import Capacity, Formula, Motion, Points, Scenario
from vstatics.simulation.run import begun
from vstatics.simulation.system.matrices import MotionSystem

SMOOTHING = 1e-7
"""Slip at which three quarters of the capacity act. [rad/s]"""
INPUT_TORQUE, OUTPUT_DRAG, DRAG_SMOOTHING = 1500.0, 1200.0, 0.05
"""Torques on the first and last link of the case with mechanisms [N*m], smoothing [rad/s]."""


class Plant:
    """Constant matrices: the derivative of a state x is ``linear @ x + into @ torques``."""

    def __init__(self, system: MotionSystem, motion: Motion, *constraints: Floats) -> None:
        links = len(system.names)
        rigid = [*(mesh.row for mesh in system.meshes), *constraints, np.zeros(links)]
        self.free = null_space(np.array(rigid))
        """Matrix from independent speeds to speeds of links."""
        springs = system.springs
        forms = np.array([spring.row for spring in springs]).reshape(-1, links) @ self.free
        stiffness = np.array([spring.stiffness for spring in springs])
        self.damping = np.array([spring.viscous for spring in springs])
        self.speeds = self.free.shape[1]
        self.springs = np.hstack([self.damping[:, None] * forms, np.diag(stiffness)])
        """Rows from the state to the torques of springs."""
        inverse = np.linalg.inv(self.free.T @ system.mass @ self.free)
        self.into = np.vstack([inverse, np.zeros((len(springs), self.speeds))])
        self.linear = -self.into @ forms.T @ self.springs
        self.linear[self.speeds :, : self.speeds] = forms
        torques = np.array([motion.torques[0, motion.devices.index(one.name)] for one in springs])
        speeds = np.linalg.lstsq(self.free, motion.speeds[0], rcond=None)[0]
        self.start = np.concatenate([speeds, torques / stiffness])


class OpenLoop(Plant):
    """Scenario of capacities over time; the last spring can slip at its limit."""

    def __init__(self, scenario: Scenario, motion: Motion) -> None:
        system = begun(scenario, step=None, rtol=1e-9).system
        super().__init__(system, motion)
        controls = scenario.controls or {}
        laws = [control.law for control in controls.values() if isinstance(control, Capacity)]
        self.points = [law for law in laws if isinstance(law, Points)]
        self.formulas = [law for law in laws if isinstance(law, Formula)]
        self.elements = len(controls)
        self.duration = scenario.duration
        rows = [system.contacts[number - 1].row for number in controls]
        self.widths = np.full(len(rows), SMOOTHING)
        self.loads = np.zeros(len(self.start))
        if system.outside:
            rows.append(np.eye(len(system.names))[-1])
            self.widths = np.append(self.widths, DRAG_SMOOTHING)
            self.loads = self.into @ self.free[0] * INPUT_TORQUE
        self.slips = np.zeros((len(rows), len(self.start)))
        self.slips[:, : self.speeds] = rows @ self.free
        self.by_friction = self.into @ self.slips[:, : self.speeds].T
        self.limit, self.last = np.inf, np.zeros(len(self.start))
        if system.springs:
            limit = scenario.case.springs[-1].limit
            assert isinstance(limit, float)  # noqa: S101 - it is constant
            self.limit, self.last = limit, self.springs[-1]
            form = system.springs[-1].row @ self.free
            self.by_excess = self.into @ form
            self.by_excess[-1] = -1 / self.damping[-1]

    def capacities(self, begin: float, end: float) -> Callable[[float], Floats]:
        """Return capacities as a function of time between two break points."""
        if self.formulas:
            [law] = self.formulas
            return lambda time: np.array([law.function(time, 0.0, 0.0)])
        lines = [law.piece(law.piece_at((begin + end) / 2)) for law in self.points]
        lines += [(OUTPUT_DRAG, 0.0)] * (len(self.widths) - len(lines))
        constant, slope = np.array(lines).T
        return lambda time: constant + slope * time

    def derivative(self, capacities: Callable[[float], Floats], time: float, x: Floats) -> Floats:
        """Return the derivative of the state."""
        friction = capacities(time) * np.tanh(self.slips @ x / self.widths)
        rates: Floats = self.linear @ x + self.loads - self.by_friction @ friction
        torque = self.last @ x
        if abs(torque) > self.limit:
            rates += self.by_excess * (torque - np.copysign(self.limit, torque))
        return rates

    def jacobian(self, capacities: Callable[[float], Floats], time: float, x: Floats) -> Floats:
        """Return the Jacobian of `derivative`."""
        slopes = np.cosh(np.clip(self.slips @ x / self.widths, -300, 300)) ** -2 / self.widths
        steep = (capacities(time) * slopes)[:, None] * self.slips
        found: Floats = self.linear - self.by_friction @ steep
        if abs(self.last @ x) > self.limit:
            found += np.outer(self.by_excess, self.last)
        return found

    def lock_ups(self, tolerance: float) -> dict[int, float]:
        """Return the last time at which the slip of each element falls to 0 [s]."""
        stops = sorted({0.0, self.duration, *(time for law in self.points for time in law.x)})
        last: dict[int, float] = {}
        x = self.start
        for begin, end in pairwise(stops):
            law = self.capacities(begin, end)
            run = solve_ivp(
                partial(self.derivative, law),
                (begin, end),
                x,
                "BDF",
                jac=partial(self.jacobian, law),
                events=[Passage(row) for row in self.slips[: self.elements]],
                rtol=tolerance,
                atol=tolerance,
            )
            x = run.y[:, -1]
            last |= {n: float(t[-1]) for n, t in enumerate(run.t_events or []) if len(t)}
        return last


class Passage:
    """Event: the magnitude of a slip falls below twice the smoothing."""

    direction = -1.0

    def __init__(self, row: Floats) -> None:
        self.row = row

    def __call__(self, _time: float, x: Floats) -> float:
        """Return the distance above."""
        return float(abs(self.row @ x) - 2 * SMOOTHING)
