"""Inertia of planets, and the coefficients of link speeds that determine their speeds."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import NamedTuple

from vstatics.core.elements.element import DrawingFields, Element
from vstatics.core.elements.group import group_of
from vstatics.core.elements.kinds import Planetary
from vstatics.core.model.parts import HOUSING


class PlanetInertia(NamedTuple):
    """Inertia and speed of equal planets, whose kinetic energy is ``inertia * speed**2/2``.

    Parameters
    ----------
    name : str
        Gear set and planet, such as ``P1.planet``.
    inertia : float
        Inertia of all planets together. [kg*m^2]
    speed : mapping of int to float
        Coefficients of the link speeds; the weighted sum is the speed of the planets. [-]
    wheel : str
        Central gear that determines the speed together with the carrier; empty if the planets
        rotate with the carrier.
    by_wheel : float
        Coefficient of the speed of `wheel`. [-]
    """

    name: str
    inertia: float
    speed: Mapping[int, float]
    wheel: str = ""
    by_wheel: float = 0.0


def planet_inertias(drawing: DrawingFields) -> Iterator[PlanetInertia]:
    """Yield planet inertias: spin about the pin, then mass of the planets about the carrier axis.

    The drawing must have passed the checks, which exclude planet masses in elastic gear sets. The
    speed of a bevel planet is relative to the carrier, the speed of any other planet absolute.

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
        for planet, mass in element.planet_masses.items():
            name, count = f"{element.name}.{planet}", element.planets or 0
            if mass.inertia:
                wheel, link, ratio = _by_wheel(element, planet)
                carried = 1 if isinstance(element.shape, Planetary) else 0
                spin = {link: ratio, carrier: carried - ratio}.items()
                speed = {link: float(part) for link, part in spin if link != HOUSING}
                yield PlanetInertia(name, count * mass.inertia, speed, wheel, float(ratio))
            if mass.mass and carrier != HOUSING:
                yield PlanetInertia(name, count * mass.mass * mass.radius**2, {carrier: 1.0})


def _by_wheel(element: Element, planet: str) -> tuple[str, int, Fraction]:
    """Return a central gear, its link, and planet speed divided by gear speed (carrier held)."""
    if not isinstance(element.shape, Planetary):
        first = element.shape.toothed[0]
        ratio = Fraction(element.teeth[first]) / Fraction(element.teeth[planet])
        return first, element.link(first), ratio
    group = group_of(element)
    train = next(train for train in group.trains if planet in train)
    wheel = group.wheels_of(train)[0]
    return wheel.member, wheel.link, train[planet] / group.relative(wheel, train)
