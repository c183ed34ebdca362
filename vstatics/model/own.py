"""What a case itself calls a device: a mechanism, or a drawn element that became several.

The solver knows three-link mechanisms, and planets as links. Results are given for what
the case names: here stands how the one follows from the other.
"""

from __future__ import annotations

from typing import NamedTuple


class Member(NamedTuple):
    """A member of a device: its link, and what the torque on it adds up from."""

    name: str
    link: int
    places: tuple[tuple[int, int], ...]
    """Index of a mechanism, and which of its links this is: 0 first, 1 second, 2 third."""


class WheelOfPlanet(NamedTuple):
    """A wheel that turns a train of planets."""

    link: int
    mechanism: int
    """Index of one that it belongs to: there it is seen whether wheel and carrier are one piece."""
    ratio: float
    """Speed of the wheel by that of the train, both against the carrier. [-]"""


class Planet(NamedTuple):
    """A planet, and what its speed against its carrier follows from."""

    name: str
    mechanism: int = -1
    """Index of the mechanism whose ratio it follows; -1: of none."""
    ratio: float = 0.0
    """That of the mechanism by the teeth; with another, as in a sweep, the wheels do not count."""
    wheels: tuple[WheelOfPlanet, ...] = ()
    """None: the mechanism has the planet's ratio."""
    carrier: int = 0
    speed: float = 1.0
    """By that of its train; NaN if its teeth are not known. [-]"""


class OwnDevice(NamedTuple):
    """A mechanism or a drawn element, as the case names it."""

    name: str
    mechanisms: tuple[int, ...]
    """Indices of those that it became."""
    members: tuple[Member, ...]
    planets: tuple[Planet, ...]
    meshes: tuple[bool, ...] = ()
    """Where its mechanisms are meshes with planets as links: whether the teeth of the first
    wheel of each are known, so that its torque is."""

    @property
    def meshes_by_index(self) -> list[tuple[int, bool]]:
        """Index of each mesh among the mechanisms, and whether its torque is known."""
        return list(zip(self.mechanisms, self.meshes, strict=False))
