"""Planetary sets where only mechanisms are given: what a stick diagram takes them for."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from vstatics.elements.element import CentralWheel
from vstatics.elements.group import PlanetGroup
from vstatics.model.parts import Mechanism
from vstatics.pictures.schemes.glyphs import Glyph
from vstatics.pictures.schemes.scheme import Device
from vstatics.pictures.schemes.sets import set_glyphs


def can_be_set(device: Device) -> bool:
    """Whether it may be a planetary set: a mechanism with a carrier that is not the housing."""
    return device.kind == "mechanism" and "third" in device.members


def as_sets(
    devices: Sequence[Device], mechanisms: Sequence[Mechanism]
) -> tuple[list[Device], Mapping[int, list[Glyph]]]:
    """Devices with their mechanisms as sets of sun, ring and carrier; how those can be drawn.

    Below 0 a ratio is that of a simple set, above 0 one of meshed planets; where its size is
    below 1 the first link has the ring.

    >>> devices = [Device("D1", "mechanism", {"first": 1, "second": 2, "third": 3}, (0,))]
    >>> as_sets(devices, [Mechanism(1, 2, 3, -2.5)])[0][0].members
    {'sun': 1, 'ring': 2, 'carrier': 3}
    """
    sets, glyphs = [*devices], {}
    for index, device in enumerate(devices):
        if can_be_set(device):
            group = bare_group(mechanisms[device.numbers[0]])
            glyphs[index] = set_glyphs(group)
            members = {wheel.member: wheel.link for wheel in group.wheels}
            sets[index] = device._replace(members={**members, "carrier": group.carrier})
    return sets, glyphs


def bare_group(mechanism: Mechanism) -> PlanetGroup:
    """Wheels and planets of a set, with teeth that stand for any.

    >>> [wheel.link for wheel in bare_group(Mechanism(1, 2, 3, -0.4)).wheels]
    [2, 1]
    """
    first, second, carrier = mechanism.links
    sun, ring = (first, second) if abs(mechanism.ratio) >= 1 else (second, first)
    is_simple = mechanism.ratio < 0
    rims = ("planet",) if is_simple else ("inner", "outer")
    wheels = [
        CentralWheel("sun", sun, 1, internal=False, rim=rims[0]),
        CentralWheel("ring", ring, 1, internal=True, rim=rims[-1]),
    ]
    meshes = [] if is_simple else [("inner", "outer")]
    return PlanetGroup(carrier, wheels, {rim: {rim: None} for rim in rims}, meshes)
