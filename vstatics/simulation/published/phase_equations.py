"""Equations (12) to (15) of the published method for a phase of a clutch.

The state contains the speeds w_in and w_out of input and output [rad/s], their angles [rad], the
work of external torques [J] and the heat of the clutch [J]. The equations are in `tarasik`.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.published.two_masses import TwoMasses
from vstatics.simulation.scenario.laws import Points, Road
from vstatics.simulation.system.curves import capacity_at
from vstatics.simulation.system.matrices import MotionSystem


class ClutchPhase(NamedTuple):
    """Phase of a run, in which a clutch slips or sticks, or no clutch joins input and output."""

    masses: TwoMasses
    clutch: int | None
    locked: bool
    direction: float = 0.0
    """Sign of w_f, the slip reduced to the input, while the clutch slips."""


class PublishedEquations:
    """Equations of motion (12) to (15) of the published method for a phase."""

    def __init__(
        self, system: MotionSystem, ends: tuple[int, int], phase: ClutchPhase, end: float
    ) -> None:
        self.phase, self.masses = phase, phase.masses
        self.last = math.nextafter(end, -math.inf)
        """Instant just before `end`, where torques and the capacity can jump. [s]"""
        self.contact = None if phase.clutch is None else system.contacts[phase.clutch]
        self.laws = [(ends.index(outside.link), outside.law) for outside in system.outside]

    def torques(self, time: float, state: Floats) -> tuple[float, float]:
        """Return the external torques M_in at the input and M_out against the output [N*m]."""
        torques, time = [0.0, 0.0], min(time, self.last)
        for end, law in self.laws:
            speed, angle = state[end], state[2 + end]
            match law:
                case Points():
                    seen = {"time": time, "speed": speed, "angle": angle}
                    torques[end] += law.at(seen[law.over])
                case Road():
                    torques[end] += float(law.torque(speed))
                case _:
                    torques[end] += law.function(time, speed, angle)
        return torques[0], -torques[1]

    def w_f(self, state: Floats) -> float:
        """Return the slip w_f, reduced to the input, by equation (13) [rad/s]."""
        return float(state[0] - self.masses.ratio * state[1])

    def friction(self, time: float, state: Floats) -> float:
        """Return M_f, the capacity of the clutch reduced to the input [N*m]."""
        if self.contact is None:
            return 0.0
        slip = self.masses.slip * self.w_f(state)
        return min(
            abs(self.masses.slip) * capacity_at(self.contact, min(time, self.last), slip), 1e300
        )

    def accelerations(self, time: float, state: Floats) -> tuple[float, float]:
        """Return the accelerations of input and output by equation (12) [rad/s^2]."""
        masses, (m_in, m_out) = self.masses, self.torques(time, state)
        u, eta = masses.ratio, masses.efficiency
        j_in, j_out = masses.input_inertia(state[0], state[1]), masses.output_inertia
        if self.phase.locked:
            dw_in = (m_in - m_out / (u * eta)) / (j_in + j_out / u**2)
            return dw_in, (m_in * u * eta - m_out) / (j_in * u**2 + j_out)
        friction = self.phase.direction * self.friction(time, state)
        return (m_in - friction) / j_in, (friction * u * eta - m_out) / j_out

    def rates(self, time: float, state: Floats) -> list[float]:
        """Return the time derivative of a state."""
        m_in, m_out = self.torques(time, state)
        dw_in, dw_out = self.accelerations(time, state)
        heat = 0.0
        if self.contact is not None and not self.phase.locked:
            heat = self.friction(time, state) * abs(self.w_f(state))
        work = m_in * state[0] - m_out * state[1]
        return [dw_in, dw_out, state[0], state[1], work, heat]

    def slip(self, _time: float, state: Floats) -> float:
        """Return w_f times its sign during the phase; it reaches 0 when the slip ends [rad/s]."""
        return self.phase.direction * self.w_f(state)

    def passed(self, time: float, state: Floats) -> float:
        """Return the torque transmitted by a locked clutch, reduced to the input [N*m]."""
        _, m_out = self.torques(time, state)
        _, dw_out = self.accelerations(time, state)
        m_through = m_out + self.masses.output_inertia * dw_out
        return m_through / (self.masses.ratio * self.masses.efficiency)

    def margin(self, time: float, state: Floats) -> float:
        """Return M_f minus the magnitude of the transmitted torque, by equation (15) [N*m]."""
        return self.friction(time, state) - abs(self.passed(time, state))

    def torque(self, time: float, state: Floats) -> float:
        """Return the torque on the clutch from its first link [N*m]."""
        if self.contact is None:
            return 0.0
        if self.phase.locked:
            return self.passed(time, state) / self.masses.slip
        return self.phase.direction * self.friction(time, state) / self.masses.slip
