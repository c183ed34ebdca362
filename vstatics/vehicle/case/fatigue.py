"""Fatigue strength of a component under torque cycles: S-N curve (Woehler) and Miner's rule."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from vstatics.core.model.carried import as_type

if TYPE_CHECKING:
    from vstatics.core.model.fields import TransmissionFields


class Fatigue(NamedTuple):
    """Fatigue strength of a component under torque.

    Parameters
    ----------
    endurance : float
        Stress amplitude that is endured for `cycles`. [Pa]
    exponent : float
        Exponent m of the S-N curve: stress^m * cycles is constant. [-]
    cycles : float
        Number of cycles to failure with the stress amplitude `endurance`. [-]
    diameter : float, optional
        Diameter of a round shaft, whose section modulus is pi d^3/16. [m]
    section_modulus : float, optional
        Torque divided by the largest stress, instead of the diameter. [m^3]
    asymmetry : float
        Fraction of the mean stress that is added to the amplitude. [-]
    threshold : float
        Stress, relative to the endurance, below which a cycle does no damage. [-]
    sum : float
        Sum of damages at which the component fails. [-]

    Examples
    --------
    >>> round(Fatigue(100e6, 3, 4e6, diameter=0.042).modulus, 9)  # m^3
    1.4547e-05
    """

    endurance: float
    exponent: float
    cycles: float
    diameter: float | None = None
    section_modulus: float | None = None
    asymmetry: float = 0.0
    threshold: float = 0.6
    sum: float = 1.0

    @classmethod
    def of(cls, case: TransmissionFields) -> dict[str, Fatigue]:
        """Return the fatigue strengths of a case by component name."""
        given = ((name, as_type(strength, cls)) for name, strength in case.fatigue.items())
        return {name: fatigue for name, fatigue in given if fatigue is not None}

    @property
    def modulus(self) -> float:
        """Section modulus, given directly or by the diameter [m^3]."""
        if self.diameter is None:
            return self.section_modulus or math.nan
        return math.pi * self.diameter**3 / 16

    def completed(self) -> Fatigue:
        """Return the strength with all numbers as floats."""
        changed = {
            name: float(value) for name, value in self._asdict().items() if value is not None
        }
        return self._replace(**changed)
