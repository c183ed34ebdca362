"""The levers of a case: a point for each link of a set, at its true distance (lever analogy).

In a set of planets all speeds against the carrier are proportional to one another. So a lever
with the carrier at 0 and each wheel at its relative speed has the speeds of all its links on
one straight line, and the torques on it are in balance as forces (Benford and Leising 1981).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import combinations
from typing import NamedTuple

from vstatics.core.elements.drawing import parts_of
from vstatics.core.elements.group import group_of
from vstatics.core.elements.kinds import Planetary
from vstatics.core.elements.lower import DrawnPart
from vstatics.core.model.springs import ends
from vstatics.core.model.transmission import HOUSING, Transmission
from vstatics.pictures.drawing.labels import Span

Source = tuple[int, str, float]
"""Index of a device, its member, and by what its torque is multiplied."""


class LeverNode(NamedTuple):
    """A point of a lever."""

    member: str
    """What the link is in the element, or nothing."""
    link: int
    """0 is the housing."""
    position: float
    """Along the lever: the carrier, or third link, at 0, the second link at 1. [-]"""
    sources: tuple[Source, ...] = ()
    """What the torque on it adds up from."""


class Lever(NamedTuple):
    """A mechanism, or planets that mesh with one another and their wheels; or a shaft alone."""

    name: str
    nodes: tuple[LeverNode, ...]
    """In the order of their positions."""
    devices: tuple[int, ...] = ()
    """Indices of the devices that it shows; of a shaft none."""
    ratio: float | None = None
    """Of a pair of wheels in the housing, which is no lever but a plain sign; NaN where it varies,
    of a variator or converter. [-]"""
    shaft: tuple[int, ...] = ()
    """Links that springs join to that of a shaft."""

    @property
    def ends(self) -> Span:
        """The positions of the first and the last node [-]."""
        return self.nodes[0].position, self.nodes[-1].position

    def is_shown(self, node: int) -> bool:
        """Whether a picture has a node; the housing that bears a pair of wheels is left out."""
        return self.ratio is None or self.nodes[node].link != HOUSING


def levers(case: Transmission, *, merged: bool = False) -> list[Lever]:
    """The levers of a case, in the order of its elements and mechanisms.

    Planets that mesh with one another make one lever with all their wheels, so a
    Ravigneaux set is a lever of four links. A link that is held for good has none.

    Parameters
    ----------
    merged : bool
        Two sets with two common links are one lever, too.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism
    >>> [lever] = levers(Transmission(3, [], [Mechanism(1, 2, 3, ratio=-2.5)], [Gear()]))
    >>> [(node.link, node.position) for node in lever.nodes]
    [(1, -2.5), (3, 0.0), (2, 1.0)]
    """
    found = [lever for lever in _all(case) if len(_turning(lever)) > 1]
    return _merged(found) if merged else found


def held_for_good(case: Transmission) -> set[int]:
    """Links that a mechanism joins to the housing alone."""
    return {link for one in map(_turning, _all(case)) for link in one if len(one) == 1}


def _all(case: Transmission) -> Iterator[Lever]:
    for device, part in enumerate(parts_of(case)):
        yield from _of_part(device, part)


def _turning(lever: Lever) -> list[int]:
    return [node.link for node in lever.nodes if node.link != HOUSING]


def _of_part(device: int, part: DrawnPart) -> Iterator[Lever]:
    element = part.element
    if element is None or not isinstance(element.shape, Planetary):
        for lowered in part.lowered:
            given = lowered.members if element is not None else ("", "", "")
            mechanism = lowered.mechanism
            position = -1.0 if mechanism.kind else mechanism.ratio
            places = zip(given, mechanism.links, (position, 1.0, 0.0), strict=True)
            nodes = [LeverNode(*place) for place in places]
            is_pair = mechanism.third == HOUSING and not mechanism.is_set
            lever = _sorted(part.name, nodes, device, lowered.members)
            ratio = math.nan if mechanism.kind else mechanism.ratio
            yield lever._replace(ratio=ratio) if is_pair else lever
        return
    group = group_of(element)
    trains = [train for train in group.trains if len(group.wheels_of(train)) > 1]
    for count, train in enumerate(trains, 1):
        wheels = group.wheels_of(train)
        unit = group.relative(wheels[-1], train)
        nodes = [
            LeverNode(wheel.member, wheel.link, float(group.relative(wheel, train) / unit))
            for wheel in wheels
        ]
        name = part.name if len(trains) == 1 else f"{part.name}, {count}"
        members = [*(wheel.member for wheel in wheels), "carrier" if len(trains) == 1 else ""]
        yield _sorted(name, [*nodes, LeverNode("carrier", group.carrier, 0.0)], device, members)


def _sorted(name: str, nodes: list[LeverNode], device: int, members: Sequence[str]) -> Lever:
    """A lever whose nodes know their torques: what has no member of its own balances the rest."""
    others = tuple((device, member, -1.0) for member in members if member)
    told = [
        node._replace(sources=((device, member, 1.0),) if member else others)
        for node, member in zip(nodes, members, strict=True)
    ]
    return Lever(name, tuple(sorted(told, key=lambda node: node.position)), (device,))


def _merged(drawn: list[Lever]) -> list[Lever]:
    """Pairs of levers with two common links become one, again and again."""
    for one, other in combinations([lever for lever in drawn if lever.ratio is None], 2):
        common = {node.link for node in one.nodes} & {node.link for node in other.nodes}
        if len(common) == 2 and (joined := _joined(one, other, sorted(common))):
            rest = [joined if lever is one else lever for lever in drawn if lever is not other]
            return _merged(rest)
    return drawn


def _joined(one: Lever, other: Lever, common: Sequence[int]) -> Lever | None:
    """Two levers on one line: the points of the second go where the common links are."""
    ours, theirs = (
        [node.position for link in common for node in lever.nodes if node.link == link]
        for lever in (one, other)
    )
    if len({*ours}) < 2 or len({*theirs}) < 2 or len(ours) + len(theirs) > 4:
        return None
    (a, b), (c, d) = ours, theirs
    nodes = {node.link: node for node in one.nodes}
    for node in other.nodes:
        place = a + (node.position - c) * (b - a) / (d - c)
        if node.link in nodes:
            known = nodes[node.link]
            nodes[node.link] = known._replace(member="", sources=known.sources + node.sources)
        else:
            nodes[node.link] = node._replace(position=place)
    name, devices = f"{one.name} + {other.name}", one.devices + other.devices
    return Lever(name, tuple(sorted(nodes.values(), key=lambda node: node.position)), devices)


def shafts(case: Transmission, drawn: Sequence[Lever]) -> list[Lever]:
    """Links on no lever that something is done to, by an element or from outside, or is between.

    Those that springs join to one another are one shaft, called by the first of these.
    """
    on_levers = {node.link for lever in drawn for node in lever.nodes} | {HOUSING}
    bodies = {link: {link} for link in range(1, case.own_links + 1) if link not in on_levers}
    for first, second in filter(None, (ends(spring.twist) for spring in case.springs)):
        if first in bodies and second in bodies:
            both = bodies[first] | bodies[second]
            bodies |= dict.fromkeys(both, both)
    touched = _touched(case)
    forms = [set(spring.form) for spring in case.springs]
    found: list[Lever] = []
    for link, body in bodies.items():
        named = sorted(body & touched.keys(), key=touched.__getitem__)
        is_between = sum(bool(form & body and form - body) for form in forms) > 1
        if link == min(body) and (named or is_between):
            node = LeverNode("", (named or [link])[0], 0.0)
            found.append(Lever("", (node,), shaft=tuple(sorted(body))))
    return found


def _touched(case: Transmission) -> dict[int, int]:
    """Links that something is done to; inputs, then outputs, then others."""
    found: dict[int, int] = {}
    for gear in case.gears:
        found[case.gear_input(gear)] = 0
        found.setdefault(case.gear_output(gear), 1)
    for gear in case.gears:
        for link in (*gear.speeds, *gear.torques):
            found.setdefault(link, 2)
    for element in case.shift_elements:
        for link in element.links:
            found.setdefault(link, 3)
    return found
