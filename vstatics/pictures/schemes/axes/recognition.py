"""Assignment of links to axes, and the joints (gear pairs, chains) between axes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from collections.abc import Set as AbstractSet
from typing import NamedTuple

from vstatics.core.model.fields import Bodies, join
from vstatics.core.model.transmission import Transmission
from vstatics.pictures.drawing.tolerances import SAME_RADIUS
from vstatics.pictures.schemes.scheme import Device, Scheme

MESHED = frozenset({"gear_pair", "internal_pair", "idler"})
"""Kinds of components that connect parallel axes by teeth."""
FAR = frozenset({"chain", "belt"})
"""Kinds of components that connect parallel axes without meshing teeth."""
CROSSED = frozenset({"bevel_pair", "worm"})
"""Kinds of components that connect crossing axes; drawn as parallel axes with slanted teeth."""

FREE_IDLER = 0.6
"""Size of an idler of unknown size, relative to the size of the first gear. [-]"""


class AxisJoint(NamedTuple):
    """Joint between two axes: a gear pair, chain, belt, bevel pair or worm."""

    device: int
    """Index of the component in `Scheme.devices`."""
    kind: str
    first: int
    """Number of the link of the first gear."""
    second: int
    """Number of the link of the second gear."""
    sizes: tuple[float, float]
    """Sizes of both gears in a common unit, such as tooth numbers or diameters."""
    idler: float = 0.0
    """Size of the idler in the unit of `sizes`; 0 without an idler."""
    frame: int = 0
    """Number of the link that supports the gears, such as an axle casing; 0 for the housing."""

    @property
    def links(self) -> tuple[int, int]:
        """Numbers of the links of both gears."""
        return self.first, self.second


class ParallelAxes(NamedTuple):
    """Axes of a gearbox, beginning with the axis of the input, and the joints between the axes."""

    axes: Sequence[AbstractSet[int]]
    """Numbers of the links of each axis."""
    joints: Sequence[AxisJoint]

    def of(self, link: int) -> int:
        """Return the index of the axis of a link, from 0."""
        return next(number for number, axis in enumerate(self.axes) if link in axis)


def parallel_axes(scheme: Scheme, case: Transmission) -> ParallelAxes | None:
    """Return the axes of a case, if there are several.

    Shift elements, shafts, coaxial gear sets and springs of two links connect links of one axis.
    Gear pairs, chains and bevel pinions connect two axes. A mechanism with the housing as third
    link and a ratio below 0 counts as a gear pair.

    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission
    >>> from vstatics.pictures.schemes.scheme import scheme_of
    >>> pairs = [Mechanism(1, 2, 0, -1.2), Mechanism(2, 3, 0, -2)]
    >>> case = Transmission(4, [ShiftElement(3, 4)], pairs, [Gear([1])])
    >>> [sorted(axis) for axis in parallel_axes(scheme_of(case), case).axes]
    [[1], [2], [3, 4]]

    A mechanism with a ratio above 0 has an idler if it drives the case of a differential (final
    drive), or if another component connects the same axes.

    >>> pairs = [Mechanism(1, 2, 0, -1.2), Mechanism(1, 3, 0, 2.9)]
    >>> case = Transmission(4, [ShiftElement(2, 4), ShiftElement(3, 4)], pairs, [Gear([2])])
    >>> [sorted(axis) for axis in parallel_axes(scheme_of(case), case).axes]
    [[1], [2, 3, 4]]
    """
    joints, bodies = [], list(range(len(scheme.links) + 1))
    cages = {device.members["third"] for device in scheme.devices if is_bare_differential(device)}
    alike: list[tuple[int, Device]] = []
    for index, device in enumerate(scheme.devices):
        joint, groups = joint_of(index, device, case)
        joints += [joint] if joint else []
        if groups and device.kind == "mechanism" and len(device.members) == 2 == len(groups[0]):
            alike.append((index, device))
            continue
        for links in groups:
            join(bodies, *links)
    for index, device in alike:
        first, second = device.members.values()
        ends = {bodies[first], bodies[second]}
        between = ({bodies[joint.first], bodies[joint.second]} for joint in joints)
        if second in cages or ends in between:
            sizes = 1.0, device.ratio
            joints.append(AxisJoint(index, "idler", first, second, sizes, FREE_IDLER))
        else:
            join(bodies, first, second)
    joints = [joint for joint in joints if bodies[joint.first] != bodies[joint.second]]
    entry = next(port.link for port in scheme.ports if port.role == "input")
    order = list(_from(bodies[entry], joints, bodies))
    order += [body for body in dict.fromkeys(bodies[1:]) if body not in order]
    if not joints:
        return None
    axes = [
        frozenset(link for link, link_body in enumerate(bodies) if link_body == body)
        for body in order
    ]
    return ParallelAxes(axes, joints)


def _from(start: int, joints: Sequence[AxisJoint], bodies: Bodies) -> Iterator[int]:
    """Yield the groups of connected links in breadth-first order from a start."""
    reached = [start]
    for body in reached:
        yield body
        for joint in joints:
            ends = [bodies[joint.first], bodies[joint.second]]
            if body in ends:
                reached += [end for end in ends if end not in reached]


def is_bare_differential(device: Device) -> bool:
    """Return True for a differential given as a mechanism, which halves a torque.

    >>> members = {"first": 1, "second": 2, "third": 3}
    >>> is_bare_differential(Device("axle", "mechanism", members, (0,), ratio=-1.0))
    True
    """
    return device.kind == "mechanism" and device.ratio == -1 and "third" in device.members


def joint_of(
    index: int, device: Device, case: Transmission
) -> tuple[AxisJoint | None, list[list[int]]]:
    """Return the joint of a component between two axes, if any, and groups of coaxial links."""
    links = [link for link in device.members.values() if link]
    if device.kind == "spring" and not device.is_coupling:
        return _of_spring(index, device, case)
    kind = device.kind
    if kind == "mechanism" and len(device.members) == 2 and device.ratio < 0:
        kind = "gear_pair"
    if kind not in MESHED | FAR | CROSSED or len(set(links)) < 2:
        return None, [links]
    sizes, between = (1.0, abs(device.ratio)), 0.0
    if device.element is not None:
        teeth = device.element.teeth
        first, *idler, second = (float(teeth[gear]) for gear in device.element.shape.toothed)
        sizes, between = (first, second), sum(idler)
    return AxisJoint(index, kind, links[0], links[1], sizes, between), []


def _of_spring(
    index: int, device: Device, case: Transmission
) -> tuple[AxisJoint | None, list[list[int]]]:
    """Return the joint of a bevel drive that is given as a spring, and the links by axis.

    The crown gear and the casing share an axis; the pinion has its own axis.
    """
    form = {link: part for link, part in case.springs[device.numbers[0]].form.items() if link}
    first, *smaller = sorted({abs(part) for part in form.values()}, reverse=True)
    sides = [
        [link for link, part in form.items() if abs(abs(part) - size) < SAME_RADIUS]
        for size in (first, *smaller)
    ]
    if len(sides) != 2 or len(sides[1]) > 1 or len(sides[0]) > 2:
        return None, [list(form)]
    wheel, *frame = sorted(sides[0], key=lambda link: -form[link])
    (pinion,) = sides[1]
    sizes = abs(form[pinion]), abs(form[wheel])
    joint = AxisJoint(index, "bevel_pair", pinion, wheel, sizes, frame=sum(frame))
    return joint, [sides[0]]
