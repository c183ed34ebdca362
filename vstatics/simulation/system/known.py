"""Interface of the equations of motion for modules that calculate some of their terms."""

from __future__ import annotations

from typing import Protocol

from vstatics.core.numerics.arrays import Floats
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
    twists: slice
    values: slice
    works: slice
    slipped: slice
    light: int
    within: float

    def speeds(self, time: float, state: Floats) -> Floats:
        """Return the speeds of links [rad/s]."""

    def acting(self, time: float, state: Floats) -> tuple[Floats, Floats]:
        """Return the rates and torques of ports in a state [rad/s, N*m]."""

    def derivative(self, time: float, state: Floats) -> Floats:
        """Return the derivative of a state with respect to time."""

    def moved(self, time: float, state: Floats, length: float) -> Floats:
        """Return the state after a short time `length` [s]."""
