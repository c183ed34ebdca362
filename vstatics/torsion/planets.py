"""The planets of drawn sets as bodies: their spin and their orbit, by the speeds of links.

Source: Tarasik, Puzanova, Kurstak, 2018, as checked: a planet's speed is ``w_q = w_h + alpha
(w_a - w_h)`` with ``w_a - w_h = K (w_b - w_h)``, so that its energy goes exactly to three links.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from vstatics.elements.drawing import drawing_of
from vstatics.elements.element import PlanetMass
from vstatics.model.own import Planet
from vstatics.model.parts import HOUSING, Mechanism
from vstatics.model.transmission import Transmission
from vstatics.numerics.motions import Form
from vstatics.torsion.body import Body

Shares = Mapping[int, float]
"""Index of a link -> its share of an inertia. [kg*m^2]"""


def planet_bodies(case: Transmission) -> Iterator[tuple[Body, Shares]]:
    """The planets that have a mass or an inertia: their spin, then their orbit with the carrier.

    Each with the inertias that stand for it on the links; one of these may be below 0.
    """
    drawing = drawing_of(case)
    elements = {one.name: one for one in drawing.elements} if drawing else {}
    for device in case.own_devices if elements else ():
        element = elements.get(device.name)
        if element is None or not element.planet_masses:
            continue
        count = element.planets or 1
        for planet in device.planets:
            mass = element.planet_masses.get(planet.name.removeprefix(f"{device.name}."))
            if mass is not None:
                yield from _bodies(case, planet, mass, count, element.link("carrier"))


def _bodies(
    case: Transmission, planet: Planet, mass: PlanetMass, count: int, carrier: int
) -> Iterator[tuple[Body, Shares]]:
    spin, orbit = count * mass.inertia, count * mass.mass * mass.radius**2
    if spin:
        form, shares = _spin(case, planet, carrier)
        by_link = {link - 1: spin * part for link, part in shares.items() if link != HOUSING}
        yield Body(planet.name, _turning(form), spin), by_link
    if orbit:
        around = _turning({carrier: 1.0})
        yield Body(planet.name, around, orbit), dict.fromkeys(around, orbit)


def _spin(
    case: Transmission, planet: Planet, carrier: int
) -> tuple[dict[int, float], dict[int, float]]:
    """A planet's speed by those of links, and the shares of links in its inertia."""
    if planet.name in case.link_names:
        link = case.link_names.index(planet.name) + 1
        return {link: 1.0}, {link: 1.0}
    if planet.wheels:
        wheel = planet.wheels[0]
        mechanism, alpha, carried = case.mechanisms[wheel.mechanism], 0.0, 1.0
        alpha = planet.speed / wheel.ratio
        first = wheel.link
    else:  # of a bevel set: its axis is across that of the set, about which it only orbits
        mechanism, carried = case.mechanisms[planet.mechanism], 0.0
        alpha, first = 1 / (mechanism.planet_ratio or 1.0), mechanism.first
    form: dict[int, float] = {carrier: carried - alpha}
    form[first] = form.get(first, 0.0) + alpha
    return form, _shares(mechanism, first, alpha, carried)


def _shares(mechanism: Mechanism, first: int, alpha: float, carried: float) -> dict[int, float]:
    """The links' shares: ``J_a + J_b + J_h``, so that the energy is the same at all speeds."""
    ratio, second = mechanism.ratio, mechanism.second
    if first != mechanism.first:
        ratio, second = 1 / ratio, mechanism.first
    of_second = ratio**2 * alpha * (carried - alpha) / (ratio - 1)
    of_first = carried * alpha - of_second / ratio
    shares = {first: of_first, second: of_second}
    third = mechanism.third
    shares[third] = shares.get(third, 0.0) + carried**2 - of_first - of_second
    return shares


def _turning(form: Mapping[int, float]) -> Form:
    """A form by indices of links, without the housing."""
    return {link - 1: part for link, part in form.items() if link != HOUSING}
