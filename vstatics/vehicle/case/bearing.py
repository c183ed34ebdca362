"""Rolling bearings of a case, with their loads and dynamic load ratings."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from vstatics.core.model.carried import as_type
from vstatics.core.model.parts import with_floats

if TYPE_CHECKING:
    from vstatics.core.model.fields import TransmissionFields

ROLLER_EXPONENT = 10 / 3
"""Life exponent of roller bearings (ISO 281). [-]"""


class Bearing(NamedTuple):
    """Rolling bearing, whose load is proportional to a torque.

    Parameters
    ----------
    on : str or pair of str
        Link, member or planet whose speed the bearing has; or two links, whose relative
        speed it has.
    load_per_torque : float
        Load divided by the torque. [1/m]
    dynamic : float
        Dynamic load rating: the load that 90 % of bearings endure for 1e6 revolutions. [N]
    torque_of : str, optional
        Link or member whose torque loads the bearing; by default `on`.
    exponent : float
        Life exponent: 3 for ball bearings, 10/3 for roller bearings. [-]

    Examples
    --------
    >>> Bearing("sun", 12.0, 24000.0).torque_owner
    'sun'
    """

    on: str | tuple[str, str]
    load_per_torque: float
    dynamic: float
    torque_of: str | None = None
    exponent: float = ROLLER_EXPONENT

    @classmethod
    def of(cls, case: TransmissionFields) -> dict[str, Bearing]:
        """Return the bearings of a case by name."""
        given = ((name, as_type(bearing, cls)) for name, bearing in case.bearings.items())
        return {name: bearing for name, bearing in given if bearing is not None}

    @property
    def torque_owner(self) -> str | None:
        """Name of the link or member whose torque loads the bearing, None if not given."""
        return self.torque_of or (self.on if isinstance(self.on, str) else None)

    def completed(self) -> Bearing:
        """Return the bearing with all numbers as floats."""
        return with_floats(self)
