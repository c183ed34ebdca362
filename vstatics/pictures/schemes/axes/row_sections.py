"""Half-sections of several gear sets on one axis of a gearbox with several axes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import replace
from math import inf

from vstatics.pictures.schemes.axes.recognition import ParallelAxes, is_bare_differential
from vstatics.pictures.schemes.coaxial.fitting import arranged
from vstatics.pictures.schemes.coaxial.half_section import CoaxialLayout
from vstatics.pictures.schemes.coaxial.section import coaxial_scheme
from vstatics.pictures.schemes.scheme import Scheme, SchemePort
from vstatics.pictures.schemes.sets import HalfSection

FEWEST_SETS = 2
"""Smallest number of gear sets in a half-section on an axis."""


def row_sections(
    scheme: Scheme,
    axes: ParallelAxes,
    sections: Mapping[int, HalfSection],
    *,
    is_ordered: bool = False,
) -> Iterator[CoaxialLayout]:
    """Yield the part of each axis with several gear sets between two links, without positions.

    Parameters
    ----------
    sections : mapping of int to HalfSection
        Half-sections of gear sets, and of mechanisms that can be gear sets, by index in the scheme.
    """
    for number in range(len(axes.axes)):
        inside, ends = _between_ends(scheme, axes, number, sections)
        sets = [index for index in sorted(inside) if index in sections]
        divides = any(is_bare_differential(scheme.devices[index]) for index in inside)
        if len(ends) != 2 or len(sets) < FEWEST_SETS or divides:
            continue
        ports = [SchemePort(ends[0], "before"), SchemePort(ends[1], "behind")]
        left_out = {*range(len(scheme.devices))} - inside
        part = replace(scheme, ports=ports)
        coaxial = coaxial_scheme(part, {index: sections[index] for index in sets}, left_out)
        if coaxial is not None and coaxial.train.end:
            yield arranged(coaxial, (port.link for port in scheme.ports), is_ordered=is_ordered)


def _between_ends(
    scheme: Scheme, axes: ParallelAxes, number: int, sections: Mapping[int, HalfSection]
) -> tuple[AbstractSet[int], Sequence[int]]:
    """Return the components of an axis between the end links, and the end links.

    Chains of shafts and dampers outside are left out. The end link nearer to the input is first.
    """
    joints = {joint.device for joint in axes.joints}
    inside = {
        index
        for index, device in enumerate(scheme.devices)
        if index not in joints and device.links and device.links <= axes.axes[number]
    }
    ends: dict[int, float] = {}
    for joint in axes.joints:
        for link, far_link in zip(joint.links, joint.links[::-1], strict=True):
            for end in {link, joint.frame} if axes.of(link) == number else ():
                ends[end] = min(ends.get(end, inf), axes.of(far_link))
    for port in scheme.ports:
        ends.setdefault(port.link, -1.0 if port.role == "input" else inf)
    ends = {link: order for link, order in ends.items() if link in axes.axes[number]}
    while True:
        step = next(_outermost(scheme, inside, ends, sections), None)
        if step is None:
            return inside, sorted(ends, key=lambda link: ends[link])
        link, index = step
        inside -= {index}
        (further,) = scheme.devices[index].links - {link}
        ends[further] = min(ends.pop(link), ends.get(further, inf))


def _outermost(
    scheme: Scheme,
    inside: AbstractSet[int],
    ends: Mapping[int, float],
    sections: Mapping[int, HalfSection],
) -> Iterator[tuple[int, int]]:
    """Yield each end link at a single shift element or shaft, and the index of this component."""
    for link in ends:
        connected = [index for index in inside if link in scheme.devices[index].links]
        if (
            len(connected) == 1
            and connected[0] not in sections
            and len(scheme.devices[connected[0]].links) == 2
        ):
            yield link, connected[0]
