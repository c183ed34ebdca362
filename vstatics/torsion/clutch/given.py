"""What is given of a clutch that is dumped, and the limits that follow at once."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from vstatics.core.errors import Problem

UNBOUNDED = ("J4", "J5", "M_phi")
"""What may be infinite."""
FROM_0 = ("J3", "J4")
"""What may be 0."""
SLIPPING = 0.8
"""Torque of a clutch that slips by that at which it breaks away, (3.9). [-]"""


class Dump(NamedTuple):
    """A clutch that is dumped, on one shaft; in SI or in any one system of relative units.

    Examples
    --------
    >>> held = Dump(54.3, 1.77, 1.79, 1.36, 58.3, 713e-6, 6101, 3760, 45)
    >>> round(held.slipping_torque, 1)
    4880.8
    """

    J1: float
    """Engine and driving parts of the clutch. [kg*m^2]"""
    J2: float
    """Driven disc. [kg*m^2]"""
    J3: float
    """Transmission. [kg*m^2]"""
    J4: float
    """Wheels; infinite where they are clamped. [kg*m^2]"""
    J5: float
    """Vehicle; infinite where it is held. [kg*m^2]"""
    E: float
    """Compliance between J3 and J4. [rad/(N*m)]"""
    M_C0: float
    """Torque at which the clutch breaks away. [N*m]"""
    M_phi: float
    """Torque at which the tyres lose their grip; infinite where they don't. [N*m]"""
    omega1: float
    """Speed of the engine before. [rad/s]"""

    @property
    def slipping_torque(self) -> float:
        """Of the clutch, M_C in (3.9) [N*m]."""
        return SLIPPING * self.M_C0

    @property
    def boundary_speed(self) -> float:
        """Speed of the engine from which on the clutch does not grab, (3.14) [rad/s].

        Because of free play the disc alone is accelerated.
        """
        return self.slipping_torque * math.sqrt(self.E / self.J2)

    @property
    def clutch_limit(self) -> float:
        """Torque of the spring at which a stuck clutch breaks away, M_cp1 [N*m]."""
        return self.M_C0 * ((self.J1 + self.J2 + self.J3) / self.J1)

    @property
    def grip_limit(self) -> float:
        """Torque of the spring at which the wheels break away, M_cp2 in (3.24) [N*m]."""
        return math.inf if math.isinf(self.J4) else self.M_phi * (1 + self.J4 / self.J5)

    @property
    def clamped(self) -> bool:
        """Whether the wheels stand still as long as the tyres grip."""
        return math.isinf(self.J4 + self.J5)


def dump_problems(given: Dump) -> Iterator[Problem]:
    """Numbers that cannot be."""
    for name, value in given._asdict().items():
        bounded, from_0 = name not in UNBOUNDED, name in FROM_0
        if not (value > 0 or (from_0 and value == 0)) or (bounded and value == math.inf):
            finite = "finite " * (bounded and value == math.inf)
            least = "of 0 or more" if from_0 else "above 0"
            infinite = "" if bounded else ", or infinite"
            yield Problem(
                "E504", f"read {value:g}, expected a {finite}number {least}{infinite}", (name,)
            )
