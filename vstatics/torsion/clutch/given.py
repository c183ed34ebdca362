"""Numbers of a clutch dump, and limits of torque and speed that follow from them.

Equation numbers are from I. S. Tsitovich, V. B. Algin, Vehicle dynamics (1981), 3.3.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from vstatics.core.errors import Problem

UNBOUNDED = ("J4", "J5", "M_phi")
"""Names of numbers that can be infinite."""
FROM_0 = ("J3", "J4")
"""Names of numbers that can be 0."""
SLIPPING = 0.8
"""Torque of a slipping clutch divided by its breakaway torque, (3.9). [-]"""


class Dump(NamedTuple):
    """Numbers of a clutch dump on a single shaft, in SI units or consistent relative units.

    Examples
    --------
    >>> given = Dump(54.3, 1.77, 1.79, 1.36, 58.3, 713e-6, 6101, 3760, 45)
    >>> round(given.slipping_torque, 1)
    4880.8
    """

    J1: float
    """Inertia of the engine and the driving parts of the clutch. [kg*m^2]"""
    J2: float
    """Inertia of the driven disc. [kg*m^2]"""
    J3: float
    """Inertia of the transmission. [kg*m^2]"""
    J4: float
    """Inertia of the wheels; infinite for clamped wheels. [kg*m^2]"""
    J5: float
    """Inertia of the vehicle; infinite for a vehicle at rest. [kg*m^2]"""
    E: float
    """Compliance between J3 and J4. [rad/(N*m)]"""
    M_C0: float
    """Torque at which the clutch breaks away. [N*m]"""
    M_phi: float
    """Torque at which the tyres lose grip; infinite for tyres that always grip. [N*m]"""
    omega1: float
    """Speed of the engine before the dump. [rad/s]"""

    @property
    def slipping_torque(self) -> float:
        """Torque of the slipping clutch, M_C in (3.9) [N*m]."""
        return SLIPPING * self.M_C0

    @property
    def boundary_speed(self) -> float:
        """Engine speed below which the clutch grabs at once, (3.14) [rad/s].

        At first the clutch accelerates only the disc J2, because of backlash.
        """
        return self.slipping_torque * math.sqrt(self.E / self.J2)

    @property
    def clutch_limit(self) -> float:
        """Torque of the spring at which a sticking clutch breaks away, M_cp1 [N*m]."""
        return self.M_C0 * ((self.J1 + self.J2 + self.J3) / self.J1)

    @property
    def grip_limit(self) -> float:
        """Torque of the spring at which the tyres break away, M_cp2 in (3.24) [N*m]."""
        return math.inf if math.isinf(self.J4) else self.M_phi * (1 + self.J4 / self.J5)

    @property
    def clamped(self) -> bool:
        """True if the wheels are at rest until the tyres slip."""
        return math.isinf(self.J4 + self.J5)


def dump_problems(given: Dump) -> Iterator[Problem]:
    """Yield a problem for each number out of range."""
    for name, value in given._asdict().items():
        must_be_finite, can_be_zero = name not in UNBOUNDED, name in FROM_0
        if not (value > 0 or (can_be_zero and value == 0)) or (
            must_be_finite and value == math.inf
        ):
            finite = "finite " * (must_be_finite and value == math.inf)
            least = "of 0 or more" if can_be_zero else "above 0"
            infinite = "" if must_be_finite else ", or infinite"
            yield Problem(
                "E504", f"read {value:g}, expected a {finite}number {least}{infinite}", (name,)
            )
