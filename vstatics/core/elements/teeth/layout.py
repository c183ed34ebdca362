"""Layout of planets around an axis with their teeth, and the class of warnings about teeth."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

from vstatics.core.elements.element import CentralWheel, Element
from vstatics.core.elements.group import PlanetGroup

Key = str | int
"""Key of a toothed gear: its name, or the index of a central gear in the planet group."""

Teeth = Mapping[Key, int]
"""Number of teeth by key."""


class Doubt(NamedTuple):
    """Warning or note about a toothed gear, or about the number of planets."""

    id: str
    message: str
    about: Key | None
    has_cure: bool = True
    """True if other tooth numbers can remove the cause."""


@dataclass(frozen=True)
class AxisLayout:
    """Planets around an axis: the gear set, and its planet group, possibly with other teeth."""

    element: Element
    group: PlanetGroup

    def teeth(self, rim: str) -> Fraction | None:
        """Return the number of teeth of one toothed gear (rim) of a planet, or None if unknown."""
        return self.group.planets[self.group.planet_of[rim]][rim]

    def around(self, rim: str) -> list[CentralWheel]:
        """Return the central gears in mesh with a rim."""
        return [wheel for wheel in self.group.wheels if wheel.rim == rim]

    def label(self, body: CentralWheel | str) -> str:
        """Return the name of a gear or a rim for messages."""
        if isinstance(body, str):
            return f"rim `{body}`" if self.element.rims else body
        if self.element.rims:
            return f"{'ring' if body.internal else 'sun'} `{body.member}`"
        return body.member

    def key(self, wheel: CentralWheel) -> Key:
        """Return the key of a central gear."""
        return list(self.group.wheels).index(wheel)

    def span(self, wheel: CentralWheel) -> Fraction | None:
        """Return twice the centre distance of a central gear and its planet [modules]."""
        teeth = self.teeth(wheel.rim)
        if teeth is None:
            return None
        return wheel.teeth - teeth if wheel.internal else wheel.teeth + teeth

    def axis(self, rim: str) -> tuple[Fraction, CentralWheel] | None:
        """Return twice the distance of a planet from the axis [modules], and a meshing gear.

        If the rim meshes only with planets, another rim of the planet determines the distance.
        """
        alike = [rim, *self.group.planets[self.group.planet_of[rim]]]
        for wheel in (wheel for coaxial in alike for wheel in self.around(coaxial)):
            span = self.span(wheel)
            if span is not None:
                return span, wheel
        return None


def with_teeth(group: PlanetGroup, teeth: Teeth) -> PlanetGroup:
    """Return the group with other teeth of central gears and rims."""
    wheels = [wheel._replace(teeth=teeth[place]) for place, wheel in enumerate(group.wheels)]
    planets = {
        planet: {rim: Fraction(teeth[rim]) if rim in teeth else None for rim in rims}
        for planet, rims in group.planets.items()
    }
    return PlanetGroup(group.carrier, wheels, planets, group.meshes)


def ratio_pairs(group: PlanetGroup) -> Iterator[tuple[CentralWheel, CentralWheel]]:
    """Yield the pairs of central gears that have ratios: each gear with the last of its train."""
    for train in group.trains:
        *others, last = group.wheels_of(train)
        yield from ((other, last) for other in others)
