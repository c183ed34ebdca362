"""How fast the speeds of links change, and how fast that changes, along the motion."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.system.equations import Equations
from vstatics.simulation.tolerances import (
    CHANGE_STEP,
    LEAST_DURATION,
    LONGEST_CHANGE_STEP,
    NO_CHANGE,
)


class PieceMotion(NamedTuple):
    """The motion while the same things stick and slip."""

    equations: Equations
    begin: float
    """[s]"""
    end: float
    """[s]"""

    def accelerations(self, times: Floats, states: Floats) -> Floats:
        """Of links, shape (links, times) [rad/s^2]."""
        return self._accelerations(times, states)[0]

    def jerks(self, times: Floats, states: Floats) -> Floats:
        """Changes of these with time, shape (links, times) [rad/s^3]."""
        return self._along(times, states, self._accelerations)

    def _accelerations(self, times: Floats, states: Floats) -> tuple[Floats, Floats]:
        """And what they are the sums of, for their rounding."""
        equations, structure = self.equations, self.equations.structure
        _, torques = equations.acting_at(times, states)
        by_torque = structure.free @ structure.accelerations
        made, size = by_torque @ torques, np.abs(by_torque) @ np.abs(torques)
        light = structure.light.any(axis=1)
        if light.any():
            made[light] = self._along(times, states, self._speeds)[light]
            size[light] = np.abs(made[light])
        return made, size

    def _speeds(self, times: Floats, states: Floats) -> tuple[Floats, Floats]:
        speeds = self.equations.speeds_at(times, states)
        return speeds, np.abs(speeds)

    def _along(
        self, times: Floats, states: Floats, of: Callable[[Floats, Floats], tuple[Floats, Floats]]
    ) -> Floats:
        """The change along the motion of what follows from time and state.

        By its values a little later along the tangent, at the end of the piece a little earlier:
        straight equations have no error so, others that of the square of the step.
        """
        equations = self.equations
        duration = max(equations.system.scenario.duration, LEAST_DURATION)
        step = min(CHANGE_STEP * duration, LONGEST_CHANGE_STEP)
        late = (times > self.end - step) & (times >= self.begin + step)
        steps = np.where(late, -step, step)
        at = zip(times.tolist(), states.T, strict=True)
        changes = np.array([equations.derivative(*one) for one in at]).T
        (now, size), (half, _), (whole, _) = (
            of(times + part * steps, states + part * steps * changes) for part in (0.0, 0.5, 1.0)
        )
        risen = 4 * (half - now) - (whole - now)
        made: Floats = np.where(np.abs(risen) <= NO_CHANGE * size, 0.0, risen / steps)
        return made
