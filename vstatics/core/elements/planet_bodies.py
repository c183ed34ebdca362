"""Planets as bodies with inertia, and the inertias on links that replace them.

A mechanism of links a and b and carrier h obeys ``w_a - w_h = K (w_b - w_h)``. The speed of its
planet is ``w_q = c w_h + alpha (w_a - w_h)`` with c = 1. A bevel planet has c = 0, because its
speed is relative to the carrier. The kinetic energy of the planet therefore equals the energy of
three inertias on the links a, b and h. Source: Tarasik, Puzanova, Kurstak, 2018; the formulas were
derived again.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple

from vstatics.core.elements.drawing import drawing_of
from vstatics.core.elements.kinds import Planetary
from vstatics.core.elements.planet_inertia import PlanetInertia, planet_inertias
from vstatics.core.model.parts import HOUSING, Mechanism
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.motions import Form


class Body(NamedTuple):
    """Body with inertia: a link, or all equal planets of a gear set."""

    name: str
    form: Form
    """Coefficients of the link speeds, by index; the weighted sum is the speed of the body. [-]"""
    inertia: float
    """Moment of inertia. [kg*m^2]"""


Shares = Mapping[int, float]
"""Inertias on links that replace a planet, by index of the link. They can be negative. [kg*m^2]"""


def planet_bodies(case: Transmission) -> Iterator[tuple[Body, Shares]]:
    """Yield bodies for planets: one for the spin inertia, one for the mass on the carrier.

    Each body comes with the inertias on links that replace it. With these, the torques of
    mechanisms follow from the equations of motion of the links alone.
    """
    drawing = drawing_of(case)
    for motion in planet_inertias(drawing) if drawing else ():
        if len(motion.speed) == 1 and 1.0 in motion.speed.values():  # rotates with the carrier
            shares: Mapping[int, float] = motion.speed
        elif motion.name in case.link_names:  # the planet is a link itself
            link = case.link_names.index(motion.name) + 1
            motion = motion._replace(speed={link: 1.0})  # noqa: PLW2901
            shares = motion.speed
        else:
            shares = _shares(case, motion)
        form = {link - 1: part for link, part in motion.speed.items()}
        by_link = {link - 1: motion.inertia * part for link, part in shares.items() if link}
        yield Body(motion.name, form, motion.inertia), by_link


def _shares(case: Transmission, motion: PlanetInertia) -> dict[int, float]:
    """Return inertias on links, divided by the inertia of the planet that they replace [-]."""
    drawing = drawing_of(case)
    assert drawing is not None  # noqa: S101 - it has planets
    name = motion.name.rpartition(".")[0]
    element = next(element for element in drawing.elements if element.name == name)
    index = next(device.mechanisms[0] for device in case.own_devices if device.name == name)
    mechanism = case.mechanisms[index]
    carried = 1.0 if isinstance(element.shape, Planetary) else 0.0
    alpha = _by_first(mechanism, motion.speed, carried)
    ratio = mechanism.ratio
    of_second = ratio**2 * alpha * (carried - alpha) / (ratio - 1)
    of_first = carried * alpha - of_second / ratio
    shares = dict.fromkeys(mechanism.links, 0.0)
    for link, share in zip(
        mechanism.links, (of_first, of_second, carried**2 - of_first - of_second), strict=True
    ):
        shares[link] += share
    return shares


def _by_first(mechanism: Mechanism, speed: Mapping[int, float], carried: float) -> float:
    """Return ``alpha`` of the module docstring; `carried` is the coefficient c [-]."""
    if mechanism.first in speed and mechanism.first != HOUSING:
        return speed[mechanism.first]
    if mechanism.second in speed and mechanism.second != HOUSING:
        return speed[mechanism.second] / mechanism.ratio
    return carried - speed.get(mechanism.third, 0.0)
