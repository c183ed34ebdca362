"""Conversion of gear sets to the three-link mechanisms of the solver.

A group of planets has two possible conversions. *Reduced*: each central gear and a reference gear
form a mechanism. This is the smallest number of mechanisms. *At the meshes*: planets become links,
and each mesh is a mechanism (central gear, planet, carrier). Without losses both are equivalent.
Reduced mechanisms do not show through which meshes the power flows. If more than two central gears
share planets, only the mechanisms at the meshes therefore give the right losses.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from fractions import Fraction
from itertools import chain, pairwise, repeat
from typing import NamedTuple

from vstatics.core.elements.element import CentralWheel, DrawingFields, Element
from vstatics.core.elements.group import PlanetGroup, group_of
from vstatics.core.elements.kinds import Planetary, Simple
from vstatics.core.elements.mesh_losses import MeshLosses, mesh_losses
from vstatics.core.model.parts import Mechanism


class Lowered(NamedTuple):
    """Mechanism derived from a gear set."""

    mechanism: Mechanism
    members: tuple[str, str, str]
    """Members or planets on the first, second and third link of the mechanism; empty if absent."""

    def ratio_range(self, element: Element) -> tuple[float, float]:
        """Return the open interval of ratios that are possible with any tooth numbers [-].

        The kind of gear set determines the sign. A ring is larger than a sun that meshes with the
        same planets.
        """
        least, most = 0.0, math.inf
        if isinstance(element.shape, Planetary):
            wheels = {wheel.member: wheel for wheel in group_of(element).wheels}
            first, second = (wheels.get(member) for member in self.members[:2])
            if first and second and first.rim == second.rim and first.internal != second.internal:
                least, most = (1.0, math.inf) if second.internal else (0.0, 1.0)
        return (least, most) if self.mechanism.ratio > 0 else (-most, -least)


class DrawnPart(NamedTuple):
    """Gear set with its derived mechanisms, or a mechanism that the case defines itself."""

    name: str
    element: Element | None
    lowered: tuple[Lowered, ...]
    planet_links: Mapping[str, int]
    """Link number of each planet that is a link, including planets with unknown teeth."""

    @property
    def members(self) -> dict[str, int]:
        """Link number of each member of the gear set, without planets."""
        links: dict[str, int] = {}
        for mechanism, members in self.lowered:
            for member, link in zip(members, mechanism.links, strict=True):
                if member and member not in self.planet_links:
                    links.setdefault(member, link)
        if self.element is None or not isinstance(self.element.shape, Planetary):
            return links
        wheels = (wheel.member for wheel in group_of(self.element).wheels)
        return {member: links[member] for member in (*wheels, "carrier") if member in links}


def parts(drawing: DrawingFields) -> list[DrawnPart]:
    """Return the gear sets and mechanisms of a drawing. Planets get the largest link numbers."""
    drawn = []
    last = drawing.links
    for element in drawing.elements:
        part = part_of(element, drawing, last)
        last += len(part.planet_links)
        drawn.append(part)
    for mechanism in drawing.mechanisms:
        members = ("first", "second", "third" if mechanism.third else "")
        drawn.append(DrawnPart(mechanism.name, None, (Lowered(mechanism, members),), {}))
    return drawn


def at_meshes(element: Element, group: PlanetGroup, drawing: DrawingFields) -> bool:
    """Return whether the losses of a group of planets are calculated at each mesh."""
    if element.efficiency is not None:
        return False
    if drawing.losses is None:
        return group.is_shared
    return drawing.losses == "meshes"


def part_of(element: Element, drawing: DrawingFields, last: int) -> DrawnPart:
    """Return a gear set with its mechanisms. Links of planets get the numbers after `last`."""
    per_mesh = mesh_losses(drawing.mesh_efficiency, element.mesh_efficiency)
    if isinstance(element.shape, Simple):
        return DrawnPart(element.name, element, (_simple(element, element.shape, per_mesh),), {})
    group = group_of(element)
    if not at_meshes(element, group, drawing):
        return DrawnPart(element.name, element, tuple(_reduced(element, group, per_mesh)), {})
    links = {planet: last + number for number, planet in enumerate(group.planets, 1)}
    return DrawnPart(element.name, element, tuple(_meshes(element, group, links, per_mesh)), links)


def _simple(element: Element, kind: Simple, per_mesh: MeshLosses) -> Lowered:
    first, second, third = (*kind.members, "", "")[:3]
    efficiency = element.efficiency
    if efficiency is None:
        teeth = [element.teeth.get(name) for name in kind.toothed]
        pairs = zip(kind.meshes, chain(pairwise(teeth), repeat((None, None))), strict=False)
        efficiency = math.prod(per_mesh.efficiency(mesh, *two) for mesh, two in pairs)
    between = [element.teeth[name] for name in kind.toothed[1:-1] if name in element.teeth]
    mechanism = Mechanism(
        element.link(first),
        element.link(second),
        element.link(third),
        ratio=float(simple_ratio(element, kind)),
        efficiency=efficiency,
        back_efficiency=element.back_efficiency,
        planet_ratio=-between[0] / element.teeth[kind.toothed[0]] if between else None,
        name=element.name,
        stiffness=element.stiffness,
        damping=element.damping,
    )
    return Lowered(mechanism, (first, second, third))


def simple_ratio(element: Element, kind: Simple) -> Fraction:
    """Return ``w_first/w_second`` with the third link held, from tooth numbers or diameters.

    >>> from vstatics.core.elements.kinds import KINDS
    >>> pair = Element("G", "gear_pair", {"first": 1, "second": 2}, {"first": 20, "second": 41})
    >>> simple_ratio(pair, KINDS["gear_pair"])
    Fraction(-41, 20)
    """
    if not kind.toothed or kind.toothed[0] not in element.teeth:
        return Fraction(kind.sign)
    first, last = kind.toothed[0], kind.toothed[-1]
    return kind.sign * Fraction(element.teeth[last]) / Fraction(element.teeth[first])


def reduced_pairs(group: PlanetGroup) -> Iterator[tuple[CentralWheel, CentralWheel]]:
    """Yield each central gear with the reference gear of its train, for reduced mechanisms."""
    for train in group.trains:
        wheels = group.wheels_of(train)
        if len(wheels) < 2:
            continue
        reference = wheels[-1]
        if len(wheels) > 2:
            reference = next((wheel for wheel in wheels if wheel.internal), reference)
        yield from ((wheel, reference) for wheel in wheels if wheel is not reference)


def _reduced(element: Element, group: PlanetGroup, per_mesh: MeshLosses) -> Iterator[Lowered]:
    pairs = [*reduced_pairs(group)]
    for wheel, reference in pairs:
        single = len(pairs) == len(group.trains) == 1
        name = "" if single else f".{wheel.member}-{reference.member}"
        ratio = group.ratio(wheel, reference)
        between = group.path(group.planet_of[wheel.rim], group.planet_of[reference.rim])
        efficiency = math.prod(
            [
                _efficiency_of_wheel(wheel, group, per_mesh),
                *(_efficiency_of_planets(group, *two, per_mesh) for two in between),
                _efficiency_of_wheel(reference, group, per_mesh),
            ]
        )
        mechanism = Mechanism(
            wheel.link,
            reference.link,
            group.carrier,
            ratio=float(ratio),
            efficiency=element.efficiency or efficiency,
            back_efficiency=element.back_efficiency,
            planet_ratio=_to_planet(group, wheel, ratio),
            name=element.name + name,
            stiffness=element.stiffness,
            damping=element.damping,
        )
        yield Lowered(mechanism, (wheel.member, reference.member, "carrier"))


def _to_planet(group: PlanetGroup, wheel: CentralWheel, ratio: Fraction) -> float | None:
    """Return the speed ratio of a central gear to the planet [-]; None if teeth are unknown.

    The ratio is also None for a single planet between a sun and a ring. The solver then derives it
    from the basic ratio, which a sweep can vary.
    """
    if not group.is_known(group.planet_of[wheel.rim]):
        return None
    mesh_ratio = group.mesh_ratio(wheel)
    is_plain = len(group.planet_of) == 1 and mesh_ratio == (1 + ratio) / 2
    return None if is_plain else float(mesh_ratio)


def _meshes(
    element: Element, group: PlanetGroup, links: Mapping[str, int], per_mesh: MeshLosses
) -> Iterator[Lowered]:
    """Yield a mechanism for each mesh, with planets as links."""

    def mesh(first: str, link: int, planet: str, ratio: Fraction, efficiency: float) -> Lowered:
        is_known = all(group.is_known(member) for member in (first, planet) if member in links)
        mechanism = Mechanism(
            link,
            links[planet],
            group.carrier,
            ratio=float(ratio),
            efficiency=efficiency,
            planet_ratio=float(ratio) if is_known else None,
            name=f"{element.name}.{first}-{planet}",
        )
        return Lowered(mechanism, (first, planet, "carrier"))

    for wheel in group.wheels:
        planet, ratio = group.planet_of[wheel.rim], group.mesh_ratio(wheel)
        yield mesh(
            wheel.member, wheel.link, planet, ratio, _efficiency_of_wheel(wheel, group, per_mesh)
        )
    for rim, partner in group.meshes:
        first, second = group.planet_of[rim], group.planet_of[partner]
        ratio = -group.teeth(partner) / group.teeth(rim)
        yield mesh(
            first,
            links[first],
            second,
            ratio,
            _efficiency_of_planets(group, rim, partner, per_mesh),
        )


def _efficiency_of_wheel(wheel: CentralWheel, group: PlanetGroup, per_mesh: MeshLosses) -> float:
    mesh = "internal" if wheel.internal else "external"
    return per_mesh.efficiency(mesh, _teeth(group, wheel.rim), wheel.teeth)


def _efficiency_of_planets(
    group: PlanetGroup, rim: str, partner: str, per_mesh: MeshLosses
) -> float:
    return per_mesh.efficiency("external", _teeth(group, rim), _teeth(group, partner))


def _teeth(group: PlanetGroup, rim: str) -> float | None:
    """Return the teeth of a rim; None if unknown."""
    teeth = group.planets[group.planet_of[rim]][rim]
    return None if teeth is None else float(teeth)
