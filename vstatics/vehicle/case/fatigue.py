"""What a device bears of cycles of torque: its line of fatigue strength, by Woehler and Miner."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from vstatics.core.model.carried import as_type

if TYPE_CHECKING:
    from vstatics.core.model.fields import TransmissionFields


class Fatigue(NamedTuple):
    """The fatigue strength of a device under torque.

    Parameters
    ----------
    endurance : float
        Amplitude of stress that is borne for `cycles`. [Pa]
    exponent : float
        Of the line of fatigue strength: stress^exponent by cycles is constant. [-]
    cycles : float
        At the endurance. [-]
    diameter : float, optional
        Of a round shaft, whose section modulus is pi d^3/16. [m]
    section_modulus : float, optional
        In its place: torque by the largest stress. [m^3]
    asymmetry : float
        What of a mean stress counts as amplitude. [-]
    threshold : float
        From this part of the endurance on a cycle does damage. [-]
    sum : float
        Of damages at which it fails. [-]

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
        """Return the fatigue strengths of a case by the names of devices."""
        given = ((name, as_type(one, cls)) for name, one in case.fatigue.items())
        return {name: fatigue for name, fatigue in given if fatigue is not None}

    @property
    def modulus(self) -> float:
        """The section modulus, whichever of the two is given [m^3]."""
        if self.diameter is None:
            return self.section_modulus or math.nan
        return math.pi * self.diameter**3 / 16

    def completed(self) -> Fatigue:
        """A checked one with its numbers as floats."""
        changed = {name: float(one) for name, one in self._asdict().items() if one is not None}
        return self._replace(**changed)
