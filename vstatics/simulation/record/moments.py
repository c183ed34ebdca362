"""State of a run at several times, with accelerations and jerks of links."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.system.equations import Equations
from vstatics.simulation.system.matrices import MotionSystem
from vstatics.simulation.tolerances import (
    CHANGE_STEP,
    LEAST_DURATION,
    LONGEST_CHANGE_STEP,
    NO_CHANGE,
)


class Moments(NamedTuple):
    """State of a run at several times between two events. The last axis of arrays is time."""

    equations: Equations
    begin: float
    """Time of the first event. [s]"""
    end: float
    """Time of the second event. [s]"""
    times: Floats
    """Several times between the events. [s]"""
    states: Floats
    """State vectors of the equations."""
    speeds: Floats
    """Speeds of links. [rad/s]"""
    slips: Floats
    """Slip speeds of shift elements. [rad/s]"""
    torques: Floats
    """Torques of components. [N*m]"""
    ports: Floats
    """Torques of ports (see `PortLayout`). [N*m]"""

    @property
    def system(self) -> MotionSystem:
        """System of the scenario."""
        return self.equations.system

    def accelerations(self) -> Floats:
        """Return the accelerations of links [rad/s^2]."""
        return self._accelerations(self.times, self.states)[0]

    def jerks(self) -> Floats:
        """Return the jerks of links [rad/s^3]."""
        return self._along(self.times, self.states, self._accelerations)

    def _accelerations(self, times: Floats, states: Floats) -> tuple[Floats, Floats]:
        """Return the accelerations [rad/s^2], and for each the scale of its rounding error.

        The scale is the sum of the magnitudes of all terms.
        """
        equations, structure = self.equations, self.equations.structure
        _, torques = equations.acting_at(times, states)
        by_torque = structure.free @ structure.accelerations
        accelerations, magnitudes = by_torque @ torques, np.abs(by_torque) @ np.abs(torques)
        light = structure.light.any(axis=1)
        if light.any():
            accelerations[light] = self._along(times, states, self._speeds)[light]
            magnitudes[light] = np.abs(accelerations[light])
        return accelerations, magnitudes

    def _speeds(self, times: Floats, states: Floats) -> tuple[Floats, Floats]:
        speeds = self.equations.speeds_at(times, states)
        return speeds, np.abs(speeds)

    def _along(
        self,
        times: Floats,
        states: Floats,
        function: Callable[[Floats, Floats], tuple[Floats, Floats]],
    ) -> Floats:
        """Return the time derivative, along the motion, of a function of time and state.

        The derivative is a one-sided difference of second order along the tangent of the motion:
        forward, or backward near `end`.
        """
        equations = self.equations
        duration = max(equations.system.scenario.duration, LEAST_DURATION)
        step = min(CHANGE_STEP * duration, LONGEST_CHANGE_STEP)
        late = (times > self.end - step) & (times >= self.begin + step)
        steps = np.where(late, -step, step)
        at = zip(times.tolist(), states.T, strict=True)
        changes = np.array([equations.derivative(*moment) for moment in at]).T
        (now, magnitudes), (half, _), (whole, _) = (
            function(times + part * steps, states + part * steps * changes)
            for part in (0.0, 0.5, 1.0)
        )
        risen = 4 * (half - now) - (whole - now)
        return np.where(np.abs(risen) <= NO_CHANGE * magnitudes, 0.0, risen / steps)
