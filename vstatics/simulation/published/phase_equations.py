"""Equations (12) to (15) of the published method in one phase of a clutch."""

from __future__ import annotations

import math
from typing import NamedTuple

from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.published.two_masses import TwoMasses
from vstatics.simulation.scenario.formula import Formula
from vstatics.simulation.scenario.laws import Points, Road
from vstatics.simulation.system.curves import capacity_at
from vstatics.simulation.system.matrices import MotionSystem


class ClutchPhase(NamedTuple):
    """What the clutch does."""

    masses: TwoMasses
    clutch: int | None
    locked: bool
    direction: float = 0.0
    """The sign of w_f while it slips."""


class PublishedEquations:
    """(12) in one phase; a state is speeds and angles of both ends, work, heat."""

    def __init__(
        self, system: MotionSystem, ends: tuple[int, int], phase: ClutchPhase, end: float
    ) -> None:
        self.phase, self.masses = phase, phase.masses
        self.last = math.nextafter(end, -math.inf)
        """Before the laws may jump. [s]"""
        self.contact = None if phase.clutch is None else system.contacts[phase.clutch]
        self.laws = [(ends.index(one.link), one.law) for one in system.outside]

    def torques(self, time: float, state: Floats) -> tuple[float, float]:
        """M_in and M_out."""
        found, time = [0.0, 0.0], min(time, self.last)
        for end, law in self.laws:
            found[end] += _torque(law, time, state[end], state[2 + end])
        return found[0], -found[1]

    def friction(self, time: float, state: Floats) -> float:
        """M_f: the capacity of the clutch, reduced to the input."""
        if self.contact is None:
            return 0.0
        slip = self.masses.slip * (state[0] - self.masses.ratio * state[1])
        return min(
            abs(self.masses.slip) * capacity_at(self.contact, min(time, self.last), slip), 1e300
        )

    def accelerations(self, time: float, state: Floats) -> tuple[float, float]:
        """(12)."""
        masses, (m_in, m_out) = self.masses, self.torques(time, state)
        u, eta = masses.ratio, masses.efficiency
        j_in, j_out = masses.input_inertia(state[0], state[1]), masses.output_inertia
        if self.phase.locked:
            of_in = (m_in - m_out / (u * eta)) / (j_in + j_out / u**2)
            return of_in, (m_in * u * eta - m_out) / (j_in * u**2 + j_out)
        friction = self.phase.direction * self.friction(time, state)
        return (m_in - friction) / j_in, (friction * u * eta - m_out) / j_out

    def rates(self, time: float, state: Floats) -> list[float]:
        """The derivative of a state."""
        m_in, m_out = self.torques(time, state)
        of_in, of_out = self.accelerations(time, state)
        heat = 0.0
        if self.contact is not None and not self.phase.locked:
            heat = self.friction(time, state) * abs(state[0] - self.masses.ratio * state[1])
        work = m_in * state[0] - m_out * state[1]
        return [of_in, of_out, state[0], state[1], work, heat]

    def slip(self, _time: float, state: Floats) -> float:
        """w_f, (13), by the sign that it has."""
        return float(self.phase.direction * (state[0] - self.masses.ratio * state[1]))

    def passed(self, time: float, state: Floats) -> float:
        """The torque that a locked clutch passes, at the input."""
        _, m_out = self.torques(time, state)
        _, of_out = self.accelerations(time, state)
        through = m_out + self.masses.output_inertia * of_out
        return through / (self.masses.ratio * self.masses.efficiency)

    def margin(self, time: float, state: Floats) -> float:
        """What is left of M_f, (15)."""
        return self.friction(time, state) - abs(self.passed(time, state))

    def torque(self, time: float, state: Floats) -> float:
        """Of the clutch itself, given to it by its first link."""
        if self.contact is None:
            return 0.0
        if self.phase.locked:
            return self.passed(time, state) / self.masses.slip
        return self.phase.direction * self.friction(time, state) / self.masses.slip


def _torque(law: Points | Formula | Road, time: float, speed: float, angle: float) -> float:
    match law:
        case Points():
            return law.at({"time": time, "speed": speed, "angle": angle}[law.over])
        case Road():
            return float(law.torque(speed))
    return law.function(time, speed, angle)
