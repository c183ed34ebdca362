"""Which links turn about which axis, and what joins two axes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from collections.abc import Set as AbstractSet
from typing import NamedTuple

from vstatics.core.model.transmission import Transmission
from vstatics.pictures.drawing.tolerances import SAME_RADIUS
from vstatics.pictures.schemes.scheme import Device, Scheme

MESHED = frozenset({"gear_pair", "internal_pair", "idler"})
"""Pairs of axes that are parallel, by teeth."""
FAR = frozenset({"chain", "belt"})
"""The same, without teeth that mesh."""
CROSSED = frozenset({"bevel_pair", "worm"})
"""Axes that cross are drawn as parallel ones, with slanted teeth."""

FREE_IDLER = 0.6
"""Size of a wheel between two that is not told, over the first one."""


class AxisJoint(NamedTuple):
    """What joins two axes: a pair of wheels, a chain, a bevel pinion."""

    device: int
    """By its place in `Scheme.devices`."""
    kind: str
    first: int
    """Link of its first wheel."""
    second: int
    sizes: tuple[float, float]
    """Of both wheels, in any unit: teeth, diameters."""
    idler: float = 0.0
    """Of the wheel between them, in the same unit; 0 where there is none."""
    frame: int = 0
    """A link that bears its wheels, as an axle casing; 0 for the housing."""

    @property
    def links(self) -> tuple[int, int]:
        """Of its two wheels."""
        return self.first, self.second


class ParallelAxes(NamedTuple):
    """The axes of a box, that of its input first, and what joins them."""

    axes: Sequence[AbstractSet[int]]
    """The links of each."""
    joints: Sequence[AxisJoint]

    def of(self, link: int) -> int:
        """The axis of a link, from 0."""
        return next(number for number, axis in enumerate(self.axes) if link in axis)


def parallel_axes(scheme: Scheme, case: Transmission) -> ParallelAxes | None:
    """The axes of a case; None where there is but one.

    Links are of one axis if a shift element, a shaft, a coaxial set or a spring of two links
    joins them; a pair of wheels, a chain, a bevel pinion joins two axes. A mechanism with the
    housing as third link and a ratio below 0 is a pair.

    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission
    >>> from vstatics.pictures.schemes.scheme import scheme_of
    >>> pairs = [Mechanism(1, 2, 0, -1.2), Mechanism(2, 3, 0, -2)]
    >>> case = Transmission(4, [ShiftElement(3, 4)], pairs, [Gear([1])])
    >>> [sorted(axis) for axis in parallel_axes(scheme_of(case), case).axes]
    [[1], [2], [3, 4]]
    """
    joints, bodies = [], {link: link for link in range(1, len(scheme.links) + 1)}
    cages = {one.members["third"] for one in scheme.devices if is_bare_differential(one)}
    for index, device in enumerate(scheme.devices):
        joint, groups = joint_of(index, device, case, cages)
        joints += [joint] if joint else []
        for first, *others in groups:
            for other in others:
                _join(bodies, first, other)
    joints = [one for one in joints if bodies[one.first] != bodies[one.second]]
    entry = next(port.link for port in scheme.ports if port.role == "input")
    found = list(_from(bodies[entry], joints, bodies))
    found += [body for body in dict.fromkeys(bodies.values()) if body not in found]
    if not joints:
        return None
    axes = [frozenset(link for link, own in bodies.items() if own == body) for body in found]
    return ParallelAxes(axes, joints)


def _join(bodies: dict[int, int], first: int, other: int) -> None:
    old, new = bodies[other], bodies[first]
    for link, body in bodies.items():
        if body == old:
            bodies[link] = new


def _from(start: int, joints: Sequence[AxisJoint], bodies: dict[int, int]) -> Iterator[int]:
    """Bodies by breadth from one."""
    found = [start]
    for body in found:
        yield body
        for joint in joints:
            ends = [bodies[joint.first], bodies[joint.second]]
            if body in ends:
                found += [end for end in ends if end not in found]


def is_bare_differential(device: Device) -> bool:
    """Whether it is a mechanism that divides a torque by halves.

    >>> members = {"first": 1, "second": 2, "third": 3}
    >>> is_bare_differential(Device("axle", "mechanism", members, (0,), ratio=-1.0))
    True
    """
    return device.kind == "mechanism" and device.ratio == -1 and "third" in device.members


def joint_of(
    index: int, device: Device, case: Transmission, cages: AbstractSet[int]
) -> tuple[AxisJoint | None, list[list[int]]]:
    """A device as what joins two axes, if it does; links that it has on one axis.

    A mechanism with a ratio above 1 that drives one of the `cages`, the cases of differentials,
    is their final drive: it has one wheel more, as its links turn in one direction.
    """
    links = [link for link in device.members.values() if link]
    if device.kind == "spring" and not device.is_coupling:
        return _of_spring(index, device, case)
    kind = device.kind
    if kind == "mechanism" and len(device.members) == 2 and device.ratio < 0:
        kind = "gear_pair"
    if kind == "mechanism" and device.members.get("second") in cages and len(links) == 2:
        return AxisJoint(index, "idler", links[0], links[1], (1.0, device.ratio), FREE_IDLER), []
    if kind not in MESHED | FAR | CROSSED or len(set(links)) < 2:
        return None, [links]
    sizes, between = (abs(1.0), abs(device.ratio)), 0.0
    if device.element is not None:
        teeth = device.element.teeth
        first, *idler, second = (float(teeth[one]) for one in device.element.shape.toothed)
        sizes, between = (first, second), sum(idler)
    return AxisJoint(index, kind, links[0], links[1], sizes, between), []


def _of_spring(
    index: int, device: Device, case: Transmission
) -> tuple[AxisJoint | None, list[list[int]]]:
    """A spring in a bevel drive: what turns with its casing is of one axis, its pinion not."""
    form = {link: part for link, part in case.springs[device.numbers[0]].form.items() if link}
    first, *others = sorted({abs(part) for part in form.values()}, reverse=True)
    sides = [
        [link for link, part in form.items() if abs(abs(part) - size) < SAME_RADIUS]
        for size in (first, *others)
    ]
    if len(sides) != 2 or len(sides[1]) > 1 or len(sides[0]) > 2:
        return None, [list(form)]
    wheel, *frame = sorted(sides[0], key=lambda link: -form[link])
    (pinion,) = sides[1]
    sizes = abs(form[pinion]), abs(form[wheel])
    joint = AxisJoint(index, "bevel_pair", pinion, wheel, sizes, frame=sum(frame))
    return joint, [sides[0]]
