"""Planets around an axis with their teeth, and what may be doubtful about these.

The words of this package: a key stands for what has teeth, a doubt is about a key.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

from vstatics.core.elements.element import CentralWheel, Element
from vstatics.core.elements.group import PlanetGroup

Key = str | int
"""What has teeth: a rim or a wheel by its name, a central wheel of a group by its position."""

Teeth = Mapping[Key, int]


class Doubt(NamedTuple):
    """What is doubtful about an element: of which wheel, or of the number of planets."""

    id: str
    message: str
    about: Key | None
    has_cure: bool = True
    """Whether other teeth may be right."""


@dataclass(frozen=True)
class AxisLayout:
    """Planets around an axis: an element, and its group with these or other teeth."""

    element: Element
    group: PlanetGroup

    def teeth(self, rim: str) -> Fraction | None:
        """Teeth of a rim, None where nothing tells them."""
        return self.group.planets[self.group.planet_of[rim]][rim]

    def around(self, rim: str) -> list[CentralWheel]:
        """The central wheels that mesh with a rim."""
        return [wheel for wheel in self.group.wheels if wheel.rim == rim]

    def label(self, body: CentralWheel | str) -> str:
        """How messages call a wheel or a rim."""
        if isinstance(body, str):
            return f"rim `{body}`" if self.element.rims else body
        if self.element.rims:
            return f"{'ring' if body.internal else 'sun'} `{body.member}`"
        return body.member

    def key(self, wheel: CentralWheel) -> Key:
        """What stands for a wheel in doubts."""
        return list(self.group.wheels).index(wheel)

    def span(self, wheel: CentralWheel) -> Fraction | None:
        """Twice the distance of wheel and planet, in modules."""
        teeth = self.teeth(wheel.rim)
        if teeth is None:
            return None
        return wheel.teeth - teeth if wheel.internal else wheel.teeth + teeth

    def axis(self, rim: str) -> tuple[Fraction, CentralWheel] | None:
        """Twice the distance of a rim from the axis, in modules, by which wheel.

        A rim that meshes with planets only has the module of the planet's other rims.
        """
        alike = [rim, *self.group.planets[self.group.planet_of[rim]]]
        for wheel in (wheel for one in alike for wheel in self.around(one)):
            span = self.span(wheel)
            if span is not None:
                return span, wheel
        return None


def with_teeth(group: PlanetGroup, teeth: Teeth) -> PlanetGroup:
    """A group with other teeth."""
    wheels = [wheel._replace(teeth=teeth[place]) for place, wheel in enumerate(group.wheels)]
    planets = {
        planet: {rim: Fraction(teeth[rim]) if rim in teeth else None for rim in rims}
        for planet, rims in group.planets.items()
    }
    return PlanetGroup(group.carrier, wheels, planets, group.meshes)


def ratio_pairs(group: PlanetGroup) -> Iterator[tuple[CentralWheel, CentralWheel]]:
    """The wheels whose ratios matter: each of a train with the last one."""
    for train in group.trains:
        *others, last = group.wheels_of(train)
        yield from ((other, last) for other in others)
