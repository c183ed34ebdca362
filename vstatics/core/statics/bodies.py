"""Links that turn as one piece: joined by engaged elements, shafts, mechanisms that can't turn."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from vstatics.core.model.bodies import Bodies, join
from vstatics.core.model.parts import OwnDevice
from vstatics.core.model.springs import Spring
from vstatics.core.model.transmission import HOUSING, Gear, Mechanism, Transmission
from vstatics.core.numerics.tolerances import TIE, UNCERTAIN
from vstatics.core.numerics.traced import Number, absolute
from vstatics.core.statics.matrix import row_of, value
from vstatics.core.statics.speeds import is_tie


def turning_as_one(case: Transmission, gear: Gear, speeds: Sequence[Number]) -> Bodies:
    """The bodies of a gear by its speeds.

    Engaged elements join links, and devices and springs in which nothing moves; what stands
    joins none.
    """
    bodies = list(range(case.links + 1))
    joined: list[tuple[int, ...]] = [case.shift_elements[number - 1][:2] for number in gear.engaged]
    joined += [tuple(one.form) for one in case.springs if turns_as_one(one, speeds)]
    joined += [_links(device) for device in case.own_devices if is_one_piece(device, speeds)]
    for links in joined:
        if HOUSING not in links:
            join(bodies, *links)
    return bodies


def is_one_piece(device: OwnDevice, speeds: Sequence[Number]) -> bool:
    """Whether all members of a device turn alike, so that nothing in it moves."""
    with_housing = [0.0, *speeds]
    first, *others = (with_housing[link] for link in _links(device))
    size = absolute(first)
    return all(is_tie(absolute(first - other), size, absolute(other)) for other in others)


def turns_as_one(spring: Spring, speeds: Sequence[Number]) -> bool:
    """Whether all links of a spring turn alike, and would not twist it at any speed.

    >>> between_three = Spring({1: 1, 2: -0.5, 3: -0.5}, stiffness=1)
    >>> turns_as_one(between_three, [2.0, 2.0, 2.0]), turns_as_one(between_three, [2.0, 3.0, 1.0])
    (True, False)
    """
    if spring.is_damper:
        return False
    first, *others = (speeds[link - 1] for link in spring.form)
    parts = list(spring.form.values())
    if abs(sum(parts)) > TIE * max(map(abs, parts)):
        return False
    size = absolute(first)
    return all(is_tie(absolute(first - other), size, absolute(other)) for other in others)


def _links(device: OwnDevice) -> tuple[int, ...]:
    return tuple(member.link for member in device.members)


def held_as_one(case: Transmission, gear: Gear) -> set[int]:
    """Indices of mechanisms that turn as one piece whatever their losses, as far as plain to see.

    An engaged element makes two links one body. Where two links of a mechanism are one,
    so is the third; and two mechanisms of different ratios that join the same three
    bodies leave them one.
    """
    bodies = case.bodies(gear)
    held: set[int] = set()
    while free := [index for index in range(len(case.mechanisms)) if index not in held]:
        found = _held(case, free, bodies)
        if not found:
            break
        for index in found:
            join(bodies, *case.mechanisms[index].links)
        held.update(found)
    return held


def _held(case: Transmission, mechanisms: Iterable[int], bodies: Sequence[int]) -> set[int]:
    """Those of some mechanisms whose links are one body."""
    found: set[int] = set()
    apart: dict[frozenset[int], list[int]] = {}
    """Mechanisms by the three bodies that they join."""
    for index in mechanisms:
        one = case.mechanisms[index]
        if one.kind:  # its ratio is the gear's
            continue
        own = bodies[one.first], bodies[one.second], bodies[one.third]
        joined = frozenset(own)
        if len(joined) == 3:
            apart.setdefault(joined, []).append(index)
        elif own[0] != own[1] or one.ratio != 1:  # with ratio 1 the third link is loose
            found.add(index)
    for first, *others in apart.values():
        for other in others:
            ours, theirs = (_torques(case.mechanisms[n], bodies) for n in (first, other))
            left, right = ours[0] * theirs[1], ours[1] * theirs[0]
            if abs(left - right) > UNCERTAIN * (abs(left) + abs(right)):
                found |= {first, other}
    return found


def _torques(mechanism: Mechanism, bodies: Sequence[int]) -> list[float]:
    """The torques of a mechanism on the three bodies that it joins, in the order of these."""
    joined = (bodies[link] for link in mechanism.links)
    torques = map(value, row_of(mechanism, mechanism.ratio))
    return [torque for _, torque in sorted(zip(joined, torques, strict=True))]
