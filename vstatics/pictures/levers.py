"""Mechanisms as levers: a link for each point, its speed linear along the lever.

In a set of planets all speeds against the carrier are proportional to one another. So
a lever with the carrier at 0 and each wheel at its relative speed has the speeds of all
its links on one straight line (lever analogy, Benford and Leising 1981).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from vstatics.elements.group import group_of
from vstatics.elements.kinds import Planetary
from vstatics.elements.lower import DrawnPart, parts_of
from vstatics.model.transmission import HOUSING, Mechanism, Transmission


class Node(NamedTuple):
    """A point of a lever."""

    member: str
    """What the link is in the element, or nothing."""
    link: int
    """0 is the housing."""
    position: float
    """Along the lever: the carrier, or third link, at 0, the second link at 1. [-]"""


class Lever(NamedTuple):
    """A mechanism, or planets that mesh with one another and their wheels."""

    name: str
    nodes: tuple[Node, ...]
    """In the order of their positions."""

    @property
    def ends(self) -> tuple[float, float]:
        """The positions of the first and the last node [-]."""
        return self.nodes[0].position, self.nodes[-1].position


def levers(case: Transmission) -> list[Lever]:
    """The levers of a case, in the order of its elements and mechanisms.

    Planets that mesh with one another make one lever with all their wheels, so a
    Ravigneaux set is a lever of four links. A link that is held for good has none.

    Examples
    --------
    >>> from vstatics import Gear
    >>> [lever] = levers(Transmission(3, [], [Mechanism(1, 2, 3, ratio=-2.5)], [Gear()]))
    >>> [(node.link, node.position) for node in lever.nodes]
    [(1, -2.5), (3, 0.0), (2, 1.0)]
    """
    found = [lever for part in parts_of(case) for lever in _of_part(part)]
    return [lever for lever in found if sum(node.link != HOUSING for node in lever.nodes) > 1]


def _of_part(part: DrawnPart) -> Iterator[Lever]:
    element = part.element
    if element is None or not isinstance(element.shape, Planetary):
        for lowered in part.lowered:
            members = lowered.members if element is not None else ("", "", "")
            yield _of_mechanism(lowered.mechanism, members)
        return
    group = group_of(element)
    trains = [train for train in group.trains if len(group.wheels_of(train)) > 1]
    for count, train in enumerate(trains, 1):
        wheels = group.wheels_of(train)
        unit = group.relative(wheels[-1], train)
        nodes = [
            Node(wheel.member, wheel.link, float(group.relative(wheel, train) / unit))
            for wheel in wheels
        ]
        name = part.name if len(trains) == 1 else f"{part.name}, {count}"
        yield _sorted(name, [*nodes, Node("carrier", group.carrier, 0.0)])


def _of_mechanism(mechanism: Mechanism, members: tuple[str, str, str]) -> Lever:
    """Positions u, 1 and 0: then w_first - w_third = u (w_second - w_third)."""
    places = zip(members, mechanism.links, (mechanism.ratio, 1.0, 0.0), strict=True)
    return _sorted(mechanism.name, [Node(*place) for place in places])


def _sorted(name: str, nodes: list[Node]) -> Lever:
    return Lever(name, tuple(sorted(nodes, key=lambda node: node.position)))
