"""Planetary gear sets of a scheme, including mechanisms that can be planetary gear sets."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from vstatics.core.elements.element import Element
from vstatics.core.elements.group import PlanetGroup, group_of
from vstatics.core.elements.kinds import Planetary
from vstatics.core.model.parts import Mechanism
from vstatics.core.model.transmission import Transmission
from vstatics.pictures.drawing.style import Style
from vstatics.pictures.drawing.words import wheel
from vstatics.pictures.schemes.scheme import Device, Scheme
from vstatics.pictures.schemes.sets import HalfSection, section_of
from vstatics.pictures.schemes.titles import teeth_of


def sections_of(scheme: Scheme, case: Transmission, style: Style) -> dict[int, HalfSection]:
    """Return half-sections of planetary gear sets and of suitable mechanisms, by index."""
    sections = {}
    for index, device in enumerate(scheme.devices):
        element = device.element
        names: dict[str, str] = {}
        if element is not None and isinstance(element.shape, Planetary):
            group = group_of(element)
            if style.wheels:
                teeth = teeth_of(element).items()
                names = {member: wheel(member, count, style) for member, count in teeth}
        elif element is None and ("carrier" in device.members or can_be_set(device)):
            group = bare_group(case.mechanisms[device.numbers[0]])
        else:
            continue
        sections[index] = replace(section_of(group), names=names)
    return sections


def can_be_set(device: Device) -> bool:
    """Return whether a component can be a planetary gear set with a rotating carrier."""
    return device.kind == "mechanism" and "third" in device.members


def as_sets(devices: Sequence[Device], mechanisms: Sequence[Mechanism]) -> list[Device]:
    """Return the components, with mechanisms replaced by sets of sun, ring and carrier.

    A negative basic ratio gives a simple set, a positive ratio a set with meshing planets. If its
    magnitude is below 1, the first link is the ring.

    >>> devices = [Device("D1", "mechanism", {"first": 1, "second": 2, "third": 3}, (0,))]
    >>> as_sets(devices, [Mechanism(1, 2, 3, -2.5)])[0].members
    {'sun': 1, 'ring': 2, 'carrier': 3}
    """
    sets = [*devices]
    for index, device in enumerate(devices):
        if can_be_set(device):
            group = bare_group(mechanisms[device.numbers[0]])
            members = {wheel.member: wheel.link for wheel in group.wheels}
            sets[index] = device._replace(members={**members, "carrier": group.carrier})
    return sets


def bare_group(mechanism: Mechanism) -> PlanetGroup:
    """Return the gears and planets for a mechanism drawn as a set, with arbitrary tooth numbers.

    >>> [wheel.link for wheel in bare_group(Mechanism(1, 2, 3, -0.4)).wheels]
    [2, 1]
    """
    first, second, carrier = mechanism.links
    sun, ring = (first, second) if abs(mechanism.ratio) >= 1 else (second, first)
    members = {"sun": sun, "ring": ring, "carrier": carrier}
    kind = "planetary" if mechanism.ratio < 0 else "double_planet"
    return group_of(Element("", kind, members, {"sun": 1, "ring": 3}))
