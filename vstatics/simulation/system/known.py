"""State vector of the equations of motion, for modules that calculate some of their terms."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.system.matrices import MotionSystem
from vstatics.simulation.system.ports import Ports, States
from vstatics.simulation.system.structure import MotionStructure
from vstatics.simulation.tolerances import AHEAD

DISTANCES = (1.0, 16.0, 256.0)
"""Times ahead, as multiples of `within`, at which a number that is 0 now is evaluated."""


class KnownMotion(ABC):
    """Order of the state vector, ports and dampers between two events.

    `Equations` is the only complete subclass. Its docstring describes the parameters.
    """

    by_torque: Floats
    """Combinations of balances along motions without inertia that depend on speeds, as columns."""
    by_slope: Floats
    """Combinations of these balances that do not depend on speeds, as columns."""
    changes: Any

    def __init__(
        self,
        system: MotionSystem,
        structure: MotionStructure,
        states: States,
        time: float,
        rounding: float,
    ) -> None:
        layout = self.layout = system.layout
        self.system, self.structure, self.states = system, structure, states
        self.time = time
        """Time of the first event. [s]"""
        self.ports = Ports(system, states, time, rounding)
        self.motions = structure.free.shape[1]
        self.springs = len(system.springs)
        self.twists = slice(self.motions, self.motions + self.springs)
        self.angles = slice(self.twists.stop, self.twists.stop + len(layout.angles))
        self.values = slice(self.angles.stop, self.angles.stop + len(layout.values))
        self.works = slice(self.values.stop, self.values.stop + layout.ports)
        self.damped = slice(self.works.stop, self.works.stop + self.springs)
        self.slipped = slice(self.damped.stop, self.damped.stop + self.springs)
        self.meshed = slice(self.slipped.stop, self.slipped.stop + len(system.meshes))
        self.size = self.meshed.stop
        self.viscous = np.array([spring.viscous for spring in system.springs])
        slips = ~self.ports.bends
        self.acting_dampers = np.where(slips, self.viscous, self.ports.by_rate[layout.spring_ports])
        """Damping coefficients of springs, including slipping springs. [N*m*s/rad]"""
        self.creeps = slips & (self.viscous > 0)
        self.limited = slips & (self.viscous == 0)
        self.angle_rows = np.array([structure.free[link] for link in layout.angles])
        self.light = structure.light.shape[1]
        self.within = AHEAD * system.scenario.span

    @abstractmethod
    def speeds_at(self, times: Floats, states: Floats) -> Floats:
        """Return the speeds of links at several times, shape (links, times) [rad/s]."""

    @abstractmethod
    def torques_with(self, times: Floats, states: Floats, rates: Floats, shares: Floats) -> Floats:
        """Return the torques of ports at several times, for given shares of jumps [N*m]."""

    @abstractmethod
    def seen_with(
        self, times: Floats, states: Floats, rates: Floats, torques: Floats, shares: Floats
    ) -> Floats:
        """Return all quantities that formulas can read, for given shares of jumps."""

    @abstractmethod
    def share(self, time: float, state: Floats, rates: Floats) -> Floats:
        """Return the shares of jumps along which the motion slides, shape (shares,)."""

    @abstractmethod
    def speeds(self, time: float, state: Floats) -> Floats:
        """Return the speeds of links [rad/s]."""

    @abstractmethod
    def acting(self, time: float, state: Floats) -> tuple[Floats, Floats]:
        """Return the rates and torques of ports in a state [rad/s, N*m]."""

    @abstractmethod
    def derivative(self, time: float, state: Floats) -> Floats:
        """Return the derivative of a state with respect to time."""

    @abstractmethod
    def moved(self, time: float, state: Floats, length: float) -> Floats:
        """Return the state after a short time `length` [s]."""
