"""A clutch that is dumped, as a case tells it: which links are what, and what is given besides."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from vstatics.core.model.carried import as_type

if TYPE_CHECKING:
    from vstatics.core.model.fields import TransmissionFields

MASSES = ("J1", "J2", "J3", "J4", "J5")
NEEDED = ("J1", "J2", "J5")
"""Those that have a link at least."""
NUMBERS = ("M_C0", "omega1", "M_phi", "E")
"""What else is above 0."""


class ClutchDump(NamedTuple):
    """The links that make up the masses of a clutch dump; numbers are those of the links.

    Parameters
    ----------
    J1, J2, J3, J4, J5 : sequence of int
        Links of the engine, the driven disc, the transmission, the wheels, the vehicle.
    M_C0 : float
        Torque at which the clutch breaks away, on the first link of J2. [N*m]
    omega1 : float
        Speed of the first link of J1 before. [rad/s]
    M_phi : float
        Torque at which the tyres lose their grip, on the first link of J4, or of J5 where J4
        has none; infinite where they don't. [N*m]
    E : float, optional
        Compliance from J2 to J5, on the link `to`; from the elastic devices when not given.
        [rad/(N*m)]
    to : int, optional
        Link to which all is reduced, on which the torques are told; the first of J2 when not
        given.

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
        """Return the clutch dump of a case, if there is one."""
        return as_type(case.dump, cls)

    @property
    def masses(self) -> Mapping[str, Sequence[int]]:
        """The links of each mass."""
        return {name: getattr(self, name) for name in MASSES}

    @property
    def link(self) -> int:
        """To which all is reduced."""
        return self.J2[0] if self.to is None else self.to

    def completed(self) -> ClutchDump:
        """A checked one with its numbers as floats."""
        changed: dict[str, Any] = {name: tuple(links) for name, links in self.masses.items()}
        numbers = {name: getattr(self, name) for name in NUMBERS}
        changed |= {name: None if one is None else float(one) for name, one in numbers.items()}
        return self._replace(**changed)


def dump_record(case: TransmissionFields) -> dict[str, Any] | None:
    """A clutch dump by the keys of a case; that something is infinite is not written."""
    dump = ClutchDump.of(case)
    if dump is None:
        return None
    return {name: one for name, one in dump._asdict().items() if one != math.inf}
