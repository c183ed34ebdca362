"""Fatigue strength of a component under stress cycles, and of a member under tooth contacts.

Both strengths are given by an S-N curve (Woehler), and damages are added by Miner's rule.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Literal, NamedTuple

from vstatics.core.model.carried import as_type
from vstatics.core.model.parts import with_floats

if TYPE_CHECKING:
    from vstatics.core.model.fields import TransmissionFields


class Fatigue(NamedTuple):
    """Fatigue strength of a component under torque.

    Parameters
    ----------
    endurance : float
        Stress amplitude endured for `cycles`. [Pa]
    exponent : float
        Exponent m of the S-N curve: stress^m * cycles is constant. [-]
    cycles : float
        Number of cycles to failure at the stress amplitude `endurance`. [-]
    diameter : float, optional
        Diameter d of a solid shaft, whose section modulus is pi d^3/16. [m]
    section_modulus : float, optional
        Section modulus: torque divided by the largest stress; instead of `diameter`. [m^3]
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
        """Return the strengths of a case under stress, by name of the component."""
        others = TorqueStrength.of(case)
        strengths = {name: given for name, given in case.fatigue.items() if name not in others}
        given = ((name, as_type(strength, cls)) for name, strength in strengths.items())
        return {name: fatigue for name, fatigue in given if fatigue is not None}

    @property
    def modulus(self) -> float:
        """Section modulus, as given or calculated from the diameter [m^3]."""
        if self.diameter is None:
            return self.section_modulus or math.nan
        return math.pi * self.diameter**3 / 16

    def completed(self) -> Fatigue:
        """Return the strength with all numbers as floats."""
        return with_floats(self)


Flanks = Literal["apart", "together"]
"""Damage by torques of both signs: `apart` for each flank (pitting), `together` (root bending)."""


class TorqueStrength(NamedTuple):
    """Fatigue strength of a member under torque, for example of the flanks or roots of teeth.

    Parameters
    ----------
    torque : float
        Torque endured for `cycles`. [N*m]
    exponent : float
        Exponent m of the S-N curve: torque^m * contacts is constant. [-]
    cycles : float
        Number of contacts to failure at `torque`. [-]
    contacts : float, optional
        Contacts of a tooth in each turn. By default the number of planets, if the gear set gives
        it, for suns and rings, otherwise 1. [-]
    flanks : {"together", "apart"}
        With "together", torques of both signs damage the same point of a tooth. With "apart", only
        the sign that causes more damage counts.
    threshold : float
        Torque, relative to `torque`, below which a contact does no damage. [-]
    sum : float
        Sum of damages at which the member fails. [-]
    torque_of : str, optional
        Member whose torque is used for a planet, which has no torque of its own.
    on : str, optional
        Member that has the strength; by default the member whose name the strength has.

    Examples
    --------
    >>> TorqueStrength(900.0, 6.6, 3e6).flanks
    'together'
    """

    torque: float
    exponent: float
    cycles: float
    contacts: float | None = None
    flanks: Flanks = "together"
    threshold: float = 0.0
    sum: float = 1.0
    torque_of: str | None = None
    on: str | None = None

    @classmethod
    def of(cls, case: TransmissionFields) -> dict[str, TorqueStrength]:
        """Return the torque strengths of a case, by name of the member or by another name."""
        return {name: given for name, given in case.fatigue.items() if isinstance(given, cls)}

    def completed(self) -> TorqueStrength:
        """Return the strength with all numbers as floats."""
        return with_floats(self)
