"""Clutch dump of a case: the links that form each mass, and further numbers."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from vstatics.core.model.carried import as_type

if TYPE_CHECKING:
    from vstatics.core.model.fields import TransmissionFields

MASSES = ("J1", "J2", "J3", "J4", "J5")
NEEDED = ("J1", "J2", "J5")
"""Masses that at least one link must form."""
NUMBERS = ("M_C0", "omega1", "M_phi", "E")
"""Keys of `dump` whose values must be numbers above 0."""


class ClutchDump(NamedTuple):
    """Clutch dump of a case: the links that form each mass, and numbers at some of the links.

    Parameters
    ----------
    J1, J2, J3, J4, J5 : sequence of int
        Links of the engine, the driven disc, the transmission, the wheels, the vehicle.
    M_C0 : float
        Torque at which the clutch breaks away, on the first link of J2. [N*m]
    omega1 : float
        Speed of the first link of J1 before the dump. [rad/s]
    M_phi : float
        Torque at which the tyres lose their grip, on the first link of J4, or of J5 if J4 is
        empty; infinite for tyres that always grip. [N*m]
    E : float, optional
        Compliance from J2 to J5, reduced to the link `to`. By default calculated from the elastic
        components. [rad/(N*m)]
    to : int, optional
        Link to which all values are reduced, and on which torques are reported. By default the
        first link of J2.

    Examples
    --------
    >>> ClutchDump([1], [2], [], [4], [5], M_C0=182, omega1=607).link
    2
    """

    J1: Sequence[int]
    J2: Sequence[int]
    J3: Sequence[int]
    J4: Sequence[int]
    J5: Sequence[int]
    M_C0: float
    omega1: float
    M_phi: float = math.inf
    E: float | None = None
    to: int | None = None

    @classmethod
    def of(cls, case: TransmissionFields) -> ClutchDump | None:
        """Return the clutch dump of a case, if any."""
        return as_type(case.dump, cls)

    @property
    def masses(self) -> Mapping[str, Sequence[int]]:
        """Links that form each mass, by the name of the mass."""
        return {name: getattr(self, name) for name in MASSES}

    @property
    def link(self) -> int:
        """Link to which all values are reduced."""
        return self.J2[0] if self.to is None else self.to

    def completed(self) -> ClutchDump:
        """Return the clutch dump with links as tuples and numbers as floats."""
        changed: dict[str, Any] = {name: tuple(links) for name, links in self.masses.items()}
        numbers = {name: getattr(self, name) for name in NUMBERS}
        changed |= {name: None if x is None else float(x) for name, x in numbers.items()}
        return self._replace(**changed)


def dump_record(case: TransmissionFields) -> dict[str, Any] | None:
    """Return the clutch dump of a case, if any, by keys; infinite values are left out."""
    dump = ClutchDump.of(case)
    if dump is None:
        return None
    return {name: value for name, value in dump._asdict().items() if value != math.inf}
