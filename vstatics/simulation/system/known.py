"""What the parts of the equations of motion ask of them: places in the state, and what acts."""

from __future__ import annotations

from typing import Protocol

from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.system.matrices import MotionSystem, PortLayout
from vstatics.simulation.system.ports import Ports
from vstatics.simulation.system.structure import MotionStructure

DISTANCES = (1.0, 16.0, 256.0)
"""Times after which a motion is looked at to see what leaves 0, by the look-ahead of equations."""


class KnownMotion(Protocol):
    """What holds between two events, as far as its parts ask."""

    system: MotionSystem
    layout: PortLayout
    structure: MotionStructure
    ports: Ports
    motions: int
    twists: slice
    values: slice
    works: slice
    slipped: slice
    light: int
    within: float

    def speeds(self, time: float, state: Floats) -> Floats:
        """Of links [rad/s]."""

    def acting(self, time: float, state: Floats) -> tuple[Floats, Floats]:
        """Rates and torques of ports in a state [rad/s, N*m]."""

    def derivative(self, time: float, state: Floats) -> Floats:
        """Change of a state with time."""

    def moved(self, time: float, state: Floats, length: float) -> Floats:
        """State after a short time [s]."""
