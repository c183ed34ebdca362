"""Wheel whose rolling radius decreases with its torque: Tarasik, table 1.1, r = r_0 - lambda M.

M is the torque that rolling, ascent and air drag need at a constant vehicle speed v. With their
force X(v), M = X r, so r = r_0/(1 + lambda X), and the wheel turns with w = v/r = v (1 + lambda
X(v))/r_0. The radius depends on the magnitude of v alone.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.tolerances import LAST_BIT

MOST_NEWTON_ITERATIONS = 60
"""Largest number of Newton steps; usually fewer than ten suffice."""


class LoadedWheel(NamedTuple):
    """Wheel on a road, with a rolling radius that decreases with the torque.

    Parameters
    ----------
    free : float
        Radius without torque. [m]
    by_torque : float
        Decrease lambda of the radius per unit of torque. [m/(N*m)]
    steady : float
        Force of the ascent, independent of the speed. [N]
    rolling : sequence of (float, float)
        Points (vehicle speed [m/s], force of rolling resistance [N]) with ascending speeds,
        interpolated linearly, constant outside.
    air : float
        Air drag divided by the square of the speed. [N*s^2/m^2]

    Examples
    --------
    At 1 kN a wheel of 0.5 m rolls with 0.5/(1 + 1e-4*1000) m.

    >>> wheel = LoadedWheel(0.5, 1e-4, 0.0, ((0.0, 1000.0),), 0.0)
    >>> wheel.velocity(np.array([-11.0, 11.0])).round(12).tolist()
    [-5.0, 5.0]
    >>> float(wheel.torque(-11.0).round(9))
    454.545454545
    """

    free: float
    by_torque: float
    steady: float
    rolling: tuple[tuple[float, float], ...]
    air: float

    @property
    def is_single(self) -> bool:
        """True if wheel speed rises with vehicle speed everywhere, so the inverse is unique."""
        speeds, _ = zip(*self.rolling, strict=True)
        corners = np.array([0.0, *speeds, np.inf])
        above = np.nextafter(corners[:-1], np.inf)
        least = above  # speed of the smallest slope in each piece
        if self.air:
            least = np.clip(-self._rise(above) / (3 * self.air), above, corners[1:])
        inside = np.concatenate([above, least, np.nextafter(corners[1:-1], 0.0)])
        return bool(np.all(self.turning_slopes(inside)[0] > 0))

    def rolls(self, velocity: Any) -> Floats:
        """Return the force of rolling resistance [N] at vehicle speeds of any sign."""
        speeds, forces = zip(*self.rolling, strict=True)
        force: Floats = np.interp(np.abs(velocity), speeds, forces)
        return force

    def load(self, velocity: Any) -> Floats:
        """Return free radius divided by rolling radius, 1 + `by_torque` times resistance [-]."""
        speed = np.abs(velocity)
        force = self.rolls(speed) + self.steady + self.air * speed**2
        ratio: Floats = 1.0 + self.by_torque * force
        return ratio

    def turning(self, velocity: Any) -> Floats:
        """Convert vehicle speeds [m/s] to wheel speeds [rad/s]."""
        speed: Floats = velocity * self.load(velocity) / self.free
        return speed

    def turning_slopes(self, velocity: Any) -> tuple[Floats, Floats]:
        """Return the first [1/m] and second [s/m^2] derivatives of `turning`."""
        speed = np.abs(velocity)
        rise = self._rise(speed)
        first = self.load(speed) + self.by_torque * speed * (rise + 2 * self.air * speed)
        second = self.by_torque * np.sign(velocity) * (2 * rise + 6 * self.air * speed)
        return first / self.free, second / self.free

    def velocity(self, turning: Any) -> Floats:
        """Convert wheel speeds [rad/s] to vehicle speeds [m/s], by Newton's method."""
        wanted = np.abs(np.asarray(turning, dtype=float))
        corners = np.array([0.0, *(speed for speed, _ in self.rolling if speed > 0), np.inf])
        reached = np.append(self.turning(corners[:-1]), np.inf)
        piece = np.searchsorted(reached, wanted, side="right") - 1
        low, high = corners[piece], corners[piece + 1]
        speed = low
        for _ in range(MOST_NEWTON_ITERATIONS):
            inside = np.nextafter(speed, high)  # at a corner, take the slope above it
            slope, _ = self.turning_slopes(inside)
            before = speed
            speed = np.clip(speed + (wanted - self.turning(speed)) / slope, low, high)
            if np.all(np.abs(speed - before) <= LAST_BIT * speed):
                break
        velocity: Floats = np.copysign(speed, turning)
        return velocity

    def torque(self, turning: Any) -> Floats:
        """Return the external torque [N*m] of all road resistances at wheel speeds [rad/s]."""
        velocity = self.velocity(turning)
        forces = self.steady + np.sign(velocity) * (self.rolls(velocity) + self.air * velocity**2)
        torque: Floats = -self.free / self.load(velocity) * forces
        return torque

    def _rise(self, speed: Floats) -> Floats:
        """Return the derivative of the rolling resistance with respect to speed [N*s/m]."""
        speeds, forces = (np.array(column) for column in zip(*self.rolling, strict=True))
        slopes = np.concatenate([[0.0], np.diff(forces) / np.diff(speeds), [0.0]])
        rise: Floats = slopes[np.searchsorted(speeds, speed, side="right")]
        return rise
