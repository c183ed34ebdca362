"""The inertia of planets: exact shares of motion that need no links of their own."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import NamedTuple

from vstatics.core.elements.element import DrawingFields, Element
from vstatics.core.elements.group import group_of
from vstatics.core.elements.kinds import Planetary
from vstatics.core.model.parts import HOUSING


class PlanetInertia(NamedTuple):
    """All planets of one name: half the inertia times a speed squared is their energy.

    Parameters
    ----------
    name : str
        The element's and the planet's: ``P1.planet``.
    inertia : float
        [kg*m^2]
    speed : mapping of int to float
        The speed, as a sum of those of links with these coefficients. [-]
    wheel : str
        The member whose speed and the carrier's give it; none of what turns with the carrier.
    by_wheel : float
        Coefficient of the speed of that member. [-]
    """

    name: str
    inertia: float
    speed: Mapping[int, float]
    wheel: str = ""
    by_wheel: float = 0.0


def planet_inertias(drawing: DrawingFields) -> Iterator[PlanetInertia]:
    """The motions of all planets that have masses: about their pins, and with their carrier.

    Of a checked drawing; so what is elastic has none. A planet whose axis is parallel to that of
    its set turns by its whole speed, one of a bevel set by that against its carrier.

    Examples
    --------
    >>> from vstatics.core.elements.element import PlanetMass
    >>> members, teeth = {"sun": 1, "ring": 2, "carrier": 3}, {"sun": 30, "ring": 75}
    >>> masses = {"planet": PlanetMass(1e-4, mass=0.5, radius=0.25)}
    >>> one = Element("P", "planetary", members, teeth, planets=4, planet_masses=masses)
    >>> for inertia in planet_inertias(DrawingFields(3, [one])):
    ...     print(inertia.name, inertia.inertia, dict(inertia.speed))
    P.planet 0.0004 {1: -1.3333333333333333, 3: 2.3333333333333335}
    P.planet 0.125 {3: 1.0}
    """
    for element in drawing.elements:
        carrier = element.link("carrier")
        for planet, one in element.planet_masses.items():
            name, count = f"{element.name}.{planet}", element.planets or 0
            if one.inertia:
                wheel, link, ratio = _by_wheel(element, planet)
                carried = 1 if isinstance(element.shape, Planetary) else 0
                spin = {link: ratio, carrier: carried - ratio}.items()
                speed = {link: float(part) for link, part in spin if link != HOUSING}
                yield PlanetInertia(name, count * one.inertia, speed, wheel, float(ratio))
            if one.mass and carrier != HOUSING:
                yield PlanetInertia(name, count * one.mass * one.radius**2, {carrier: 1.0})


def _by_wheel(element: Element, planet: str) -> tuple[str, int, Fraction]:
    """A wheel, its link, and a planet by it, both against the carrier (Willis)."""
    if not isinstance(element.shape, Planetary):
        first = element.shape.toothed[0]
        ratio = Fraction(element.teeth[first]) / Fraction(element.teeth[planet])
        return first, element.link(first), ratio
    group = group_of(element)
    train = next(train for train in group.trains if planet in train)
    wheel = group.wheels_of(train)[0]
    return wheel.member, wheel.link, train[planet] / group.relative(wheel, train)
