"""Levers of a case: each link of a gear set is a point at a true distance (lever analogy).

In a planetary gear set, the speeds of all gears relative to the carrier are proportional to each
other. The carrier is placed at 0, and each gear at a distance proportional to its relative speed.
The speeds are then on a straight line, and torques balance like forces (Benford and Leising 1981).
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
from vstatics.core.groups import grouped
from vstatics.core.model.fields import join
from vstatics.core.model.springs import ends
from vstatics.core.model.transmission import HOUSING, Transmission
from vstatics.pictures.drawing.labels import Span

Source = tuple[int, str, float]
"""Share of a component in the torque on a point: index of the component, member, factor."""


class LeverNode(NamedTuple):
    """Point of a lever."""

    member: str
    """Member of the gear set, such as ``sun``; empty if there is none."""
    link: int
    """Number of the link; 0 is the housing."""
    position: float
    """Position along the lever, relative: the carrier or third link at 0, the second link at 1. [-]
    """
    sources: tuple[Source, ...] = ()
    """Shares of components in the torque on the point."""


class Lever(NamedTuple):
    """Lever of a mechanism, or of a set of planets with the central gears; or a single shaft."""

    name: str
    nodes: tuple[LeverNode, ...]
    """Points from the lowest to the highest position."""
    devices: tuple[int, ...] = ()
    """Indices of the components that the lever shows; empty for a shaft."""
    ratio: float | None = None
    """Ratio of a gear pair whose carrier is the housing, drawn as a box. [-]

    The value is NaN for a variator or converter.
    """
    shaft: tuple[int, ...] = ()
    """Numbers of links that springs connect, drawn as a single shaft; empty for a lever."""

    @property
    def ends(self) -> Span:
        """Positions of the first and the last point [-]."""
        return self.nodes[0].position, self.nodes[-1].position

    def is_shown(self, node: int) -> bool:
        """Return whether a point is drawn. The housing of a gear pair is not."""
        return self.ratio is None or self.nodes[node].link != HOUSING


def levers(case: Transmission, *, merged: bool = False) -> list[Lever]:
    """Return the levers of a case, in the order of gear sets and mechanisms.

    Meshing planets and all their central gears form one lever, so a Ravigneaux set is a lever with
    four points. A mechanism that only holds a link at rest has no lever.

    Parameters
    ----------
    merged : bool
        True to merge two gear sets with two common links into one lever.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism
    >>> [lever] = levers(Transmission(3, [], [Mechanism(1, 2, 3, ratio=-2.5)], [Gear()]))
    >>> [(node.link, node.position) for node in lever.nodes]
    [(1, -2.5), (3, 0.0), (2, 1.0)]
    """
    drawn = [lever for lever in _all(case) if len(_turning(lever)) > 1]
    return _merged(drawn) if merged else drawn


def held_for_good(case: Transmission) -> set[int]:
    """Return the links that a mechanism permanently connects to the housing."""
    return {link for links in map(_turning, _all(case)) for link in links if len(links) == 1}


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
    """Return a lever with sorted points. A point without a member has the opposite total torque."""
    others = tuple((device, member, -1.0) for member in members if member)
    with_sources = [
        node._replace(sources=((device, member, 1.0),) if member else others)
        for node, member in zip(nodes, members, strict=True)
    ]
    return Lever(name, tuple(sorted(with_sources, key=lambda node: node.position)), (device,))


def _merged(drawn: list[Lever]) -> list[Lever]:
    """Merge levers with two common links, pair by pair, until no pair is left."""
    for first, second in combinations([lever for lever in drawn if lever.ratio is None], 2):
        common = {node.link for node in first.nodes} & {node.link for node in second.nodes}
        if len(common) == 2 and (joined := _joined(first, second, sorted(common))):
            remaining = [
                joined if lever is first else lever for lever in drawn if lever is not second
            ]
            return _merged(remaining)
    return drawn


def _joined(first: Lever, second: Lever, common: Sequence[int]) -> Lever | None:
    """Return two levers merged into a single lever, scaled so that the common links coincide."""
    ours, theirs = (
        [node.position for link in common for node in lever.nodes if node.link == link]
        for lever in (first, second)
    )
    if len({*ours}) < 2 or len({*theirs}) < 2 or len(ours) + len(theirs) > 4:
        return None
    (a, b), (c, d) = ours, theirs
    nodes = {node.link: node for node in first.nodes}
    for node in second.nodes:
        place = a + (node.position - c) * (b - a) / (d - c)
        if node.link in nodes:
            known = nodes[node.link]
            nodes[node.link] = known._replace(member="", sources=known.sources + node.sources)
        else:
            nodes[node.link] = node._replace(position=place)
    name, devices = f"{first.name} + {second.name}", first.devices + second.devices
    return Lever(name, tuple(sorted(nodes.values(), key=lambda node: node.position)), devices)


def shafts(case: Transmission, drawn: Sequence[Lever]) -> list[Lever]:
    """Return shafts for links that are not on a lever, but are loaded or connect components.

    Links connected by springs form a shaft, named after the first loaded link.
    """
    on_levers = {node.link for lever in drawn for node in lever.nodes} | {HOUSING}
    bodies = list(range(case.own_links + 1))
    for both in filter(None, (ends(spring.twist) for spring in case.springs)):
        if on_levers.isdisjoint(both):
            join(bodies, *both)
    touched = _touched(case)
    forms = [set(spring.form) for spring in case.springs]
    free = ((body, link) for link, body in enumerate(bodies) if link not in on_levers)
    levers_of_shafts: list[Lever] = []
    for shaft in grouped(free).values():
        named = sorted(touched.keys() & shaft, key=touched.__getitem__)
        is_between = sum(bool(form & {*shaft} and form - {*shaft}) for form in forms) > 1
        if named or is_between:
            node = LeverNode("", (named or shaft)[0], 0.0)
            levers_of_shafts.append(Lever("", (node,), shaft=tuple(shaft)))
    return levers_of_shafts


def _touched(case: Transmission) -> dict[int, int]:
    """Return a rank for each loaded link: 0 input, 1 output, 2 given value, 3 shift element."""
    order: dict[int, int] = {}
    for gear in case.gears:
        order[case.gear_input(gear)] = 0
        order.setdefault(case.gear_output(gear), 1)
    for gear in case.gears:
        for link in (*gear.speeds, *gear.torques):
            order.setdefault(link, 2)
    for element in case.shift_elements:
        for link in element.links:
            order.setdefault(link, 3)
    return order
