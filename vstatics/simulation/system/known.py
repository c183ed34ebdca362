"""Interface of the equations of motion for modules that calculate some of their terms."""

from __future__ import annotations

from typing import Any, Protocol

from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.simulation.system.matrices import MotionSystem, PortLayout
from vstatics.simulation.system.ports import Ports, States
from vstatics.simulation.system.structure import MotionStructure

DISTANCES = (1.0, 16.0, 256.0)
"""Times ahead, as multiples of `within`, at which a number that is 0 now is evaluated."""


class KnownMotion(Protocol):
    """Equations of motion between two events; `Equations` has further attributes."""

    system: MotionSystem
    layout: PortLayout
    structure: MotionStructure
    ports: Ports
    states: States
    motions: int
    springs: int
    size: int
    twists: slice
    angles: slice
    values: slice
    works: slice
    slipped: slice
    light: int
    by_torque: Floats
    by_slope: Floats
    angle_rows: Floats
    viscous: Floats
    creeps: Booleans
    limited: Booleans
    within: float
    changes: Any

    def speeds_at(self, times: Floats, states: Floats) -> Floats:
        """Return the speeds of links at several times, shape (links, times) [rad/s]."""

    def torques_with(self, times: Floats, states: Floats, rates: Floats, shares: Floats) -> Floats:
        """Return the torques of ports at several times, for given shares of jumps [N*m]."""

    def seen_with(
        self, times: Floats, states: Floats, rates: Floats, torques: Floats, shares: Floats
    ) -> Floats:
        """Return all quantities that formulas can read, for given shares of jumps."""

    def share(self, time: float, state: Floats, rates: Floats) -> Floats:
        """Return the shares of jumps along which the motion slides, shape (shares,)."""

    def speeds(self, time: float, state: Floats) -> Floats:
        """Return the speeds of links [rad/s]."""

    def acting(self, time: float, state: Floats) -> tuple[Floats, Floats]:
        """Return the rates and torques of ports in a state [rad/s, N*m]."""

    def derivative(self, time: float, state: Floats) -> Floats:
        """Return the derivative of a state with respect to time."""

    def moved(self, time: float, state: Floats, length: float) -> Floats:
        """Return the state after a short time `length` [s]."""
