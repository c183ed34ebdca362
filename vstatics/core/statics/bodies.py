"""Bodies of a gear: groups of links that rotate together.

Links are joined by engaged shift elements, by shafts, and by mechanisms that are locked up.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from vstatics.core.model.fields import Bodies, join
from vstatics.core.model.parts import OwnDevice
from vstatics.core.model.springs import Spring
from vstatics.core.model.transmission import HOUSING, Gear, Mechanism, Transmission
from vstatics.core.numerics.tolerances import TIE, UNCERTAIN
from vstatics.core.numerics.traced import Number, absolute
from vstatics.core.statics.matrix import column
from vstatics.core.statics.speeds import is_tie


def turning_as_one(case: Transmission, gear: Gear, speeds: Sequence[Number]) -> Bodies:
    """Return the bodies of a gear, detected from the speeds of the links.

    Engaged shift elements join their links. Components and springs join links that rotate at equal
    speeds. A link that is held to the housing stays a separate body.
    """
    bodies = list(range(case.links + 1))
    joined: list[tuple[int, ...]] = [element.links for element in case.elements_at(gear.joining)]
    joined += [tuple(spring.form) for spring in case.springs if turns_as_one(spring, speeds)]
    joined += [_links(device) for device in case.own_devices if is_one_piece(device, speeds)]
    for links in joined:
        if HOUSING not in links:
            join(bodies, *links)
    return bodies


def is_one_piece(device: OwnDevice, speeds: Sequence[Number]) -> bool:
    """Return whether all links of a component rotate at equal speeds."""
    with_housing = [0.0, *speeds]
    return _are_equal([with_housing[link] for link in _links(device)])


def turns_as_one(spring: Spring, speeds: Sequence[Number]) -> bool:
    """Return whether the links of a spring rotate at equal speeds, so that the twist is constant.

    >>> between_three = Spring({1: 1, 2: -0.5, 3: -0.5}, stiffness=1)
    >>> turns_as_one(between_three, [2.0, 2.0, 2.0]), turns_as_one(between_three, [2.0, 3.0, 1.0])
    (True, False)
    """
    if spring.is_damper:
        return False
    parts = list(spring.form.values())
    if abs(sum(parts)) > TIE * max(map(abs, parts)):
        return False
    return _are_equal([speeds[link - 1] for link in spring.form])


def _are_equal(speeds: Sequence[Number]) -> bool:
    first, *others = speeds
    size = absolute(first)
    return all(is_tie(absolute(first - other), size, absolute(other)) for other in others)


def _links(device: OwnDevice) -> tuple[int, ...]:
    return tuple(member.link for member in device.members)


def held_as_one(case: Transmission, gear: Gear) -> set[int]:
    """Return the indices of mechanisms that are locked up whatever the losses are.

    A mechanism is locked up if two of its links belong to one body, for example through an engaged
    shift element. Two mechanisms of different ratios between the same three bodies are locked up,
    too. Other causes are not searched for.
    """
    bodies = case.bodies(gear)
    held: set[int] = set()
    while free := [index for index in range(len(case.mechanisms)) if index not in held]:
        locked_up = _locked_up(case, free, bodies)
        held |= locked_up
        if len(locked_up) in (0, len(free)):
            break
        for index in locked_up:
            join(bodies, *case.mechanisms[index].links)
    return held


def _locked_up(case: Transmission, mechanisms: Iterable[int], bodies: Sequence[int]) -> set[int]:
    locked_up: set[int] = set()
    apart: dict[frozenset[int], list[int]] = {}
    """Indices of mechanisms, by the three different bodies that a mechanism connects."""
    for index in mechanisms:
        mechanism = case.mechanisms[index]
        if mechanism.kind:  # the ratio of a variator or converter depends on the gear
            continue
        ends = bodies[mechanism.first], bodies[mechanism.second], bodies[mechanism.third]
        bodies_joined = frozenset(ends)
        if len(bodies_joined) == 3:
            apart.setdefault(bodies_joined, []).append(index)
        # with ratio 1 and first and second link joined, the third link can still turn
        elif ends[0] != ends[1] or mechanism.ratio != 1:
            locked_up.add(index)
    for bodies_joined, (first, *others) in apart.items():
        a, b, _ = sorted(bodies_joined)
        for other in others:
            ours, theirs = (_torques_by_body(case.mechanisms[n], bodies) for n in (first, other))
            left, right = ours[a] * theirs[b], ours[b] * theirs[a]
            if abs(left - right) > UNCERTAIN * (abs(left) + abs(right)):
                locked_up |= {first, other}
    return locked_up


def _torques_by_body(mechanism: Mechanism, bodies: Sequence[int]) -> dict[int, float]:
    """Return the torques of a mechanism on its three bodies, by body."""
    torques = zip(mechanism.links, column(mechanism.ratio), strict=True)
    return {bodies[link]: torque for link, torque in torques}
