"""What every device exchanges with its links: torque times speed, seen from the housing."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from vstatics.elements.lower import DrawnPart, parts_of
from vstatics.flow.circulation import Node
from vstatics.model.transmission import HOUSING, Gear, Transmission
from vstatics.numerics.arrays import Floats
from vstatics.statics import drag
from vstatics.statics.drag import Drag
from vstatics.statics.losses import power
from vstatics.statics.matrix import external_torques, held_links
from vstatics.statics.results import Results
from vstatics.statics.speeds import is_tie
from vstatics.tables.drawn import by_element
from vstatics.tables.members import Members, member_torques


class Exchange(NamedTuple):
    """The power that a link gives to a member of a node; below 0 where it takes."""

    node: Node
    member: str
    """Nothing for ports and drag of links, which have one link only."""
    link: int
    power: float
    """NaN where it is not determined. [-]"""


class Torques(NamedTuple):
    """The torques of a gear, relative to the input torque."""

    elements: Sequence[float]
    """On the first link of each shift element. [-]"""
    parts: Sequence[Mapping[str, float]]
    """By mechanism or drawn element: those that links give to its members. [-]"""
    output: float
    """[-]"""
    holding: Sequence[float]
    """By link. [-]"""
    losses: Sequence[float]
    """By mechanism or drawn element; nothing without losses. [-]"""


class Train(NamedTuple):
    """A gear in motion."""

    case: Transmission
    gear: Gear
    """With the freewheels that hold among the engaged elements."""
    parts: Sequence[DrawnPart]
    speeds: Sequence[float]
    """By link. [-]"""
    slips: Sequence[float]
    """By shift element. [-]"""

    @property
    def direction(self) -> int:
        """-1 when coasting: then powers of the results are against the real ones."""
        return -1 if self.case.coast else 1

    def power(self, link: int, torque: float) -> float:
        """Of a torque on a link [-], in its real direction; the housing takes none."""
        if link == HOUSING:
            return 0.0
        return self.direction * float(power(torque, self.speeds[link - 1]))

    def is_one_piece(self, part: DrawnPart) -> bool:
        """Whether all members turn alike, so that nothing in it moves."""
        links = part.members.values()
        first, *others = (self.speeds[link - 1] if link else 0.0 for link in links)
        return all(is_tie(abs(first - one), abs(first), abs(one)) for one in others)

    @property
    def drag(self) -> Drag:
        """Of links and open elements."""
        return drag.acting(self.case, self.gear, self.speeds, self.slips)


def trains(results: Results) -> list[Train]:
    """Every gear of one case."""
    made, settled = parts_of(results.case), results.settled
    return [
        Train(settled, *gear)
        for gear in zip(
            settled.gears,
            [made] * len(settled.gears),
            results.speeds.tolist(),
            results.slip_speeds.tolist(),
            strict=True,
        )
    ]


def ideal_torques(results: Results) -> list[Torques]:
    """The torques of every gear without losses."""
    parts, holding = (
        member_torques(results, parts_of(results.case), lossy=False),
        results.holding_torques,
    )
    return _by_gear(results, results.torques, parts, holding, [()] * len(holding))


def lossy_torques(results: Results) -> list[Torques]:
    """The torques of every gear with losses."""
    made, holding = parts_of(results.case), results.lossy_holding_torques
    losses = by_element(made, results.losses, all_of=False).tolist()
    parts = member_torques(results, made, lossy=True)
    return _by_gear(results, results.lossy_torques, parts, holding, losses)


def _by_gear(
    results: Results,
    torques: Floats,
    parts: Sequence[Members],
    holding: Floats,
    losses: Sequence[Sequence[float]],
) -> list[Torques]:
    return [
        Torques(
            row[: len(results.case.shift_elements)],
            [{name: float(values[number]) for name, values in part.items()} for part in parts],
            row[-1],
            holding[number].tolist(),
            losses[number],
        )
        for number, row in enumerate(torques.tolist())
    ]


def of_devices(train: Train, torques: Torques, dragging: Drag) -> Iterator[Exchange]:
    """Of each member of engaged or dragging shift elements, and of mechanisms."""
    for number, element in enumerate(train.case.shift_elements, 1):
        torque = torques.elements[number - 1]
        if number not in train.gear.engaged:
            if number - 1 not in dragging.elements:
                continue
            torque = dragging.elements[number - 1]
        node = Node("element", number, element.name)
        for member, link, given in (
            ("first", element.first, torque),
            ("second", element.second, -torque),
        ):
            yield Exchange(node, member, link, train.power(link, given))
    for number, (part, members) in enumerate(zip(train.parts, torques.parts, strict=True), 1):
        node = Node("mechanism", number, part.name)
        for member, link in part.members.items():
            yield Exchange(node, member, link, train.power(link, members[member]))


def of_ports(train: Train, torques: Torques) -> Iterator[Exchange]:
    """Of each link on which an external torque acts; power that enters is below 0."""
    case, gear = train.case, train.gear
    entry, output = case.gear_input(gear), case.gear_output(gear)
    external = external_torques(case, gear)
    for link in held_links(case, gear):
        external[link] = external.get(link, 0.0) + torques.holding[link - 1]
    for link, torque in external.items():
        name = "input" if link == entry else case.link_name(link)
        yield Exchange(Node("port", link, name), "", link, -train.power(link, torque))
    yield Exchange(Node("port", output, "output"), "", output, train.power(output, torques.output))


def of_drag(train: Train, dragging: Drag) -> Iterator[Exchange]:
    """Of each link that is braked by its own drag."""
    for link, torque in dragging.links.items():
        node = Node("drag", link, train.case.link_name(link))
        yield Exchange(node, "", link, -train.power(link, torque))


def links_of(train: Train) -> dict[int, Node]:
    """The links that a case names itself: planets of drawn elements apart."""
    count = train.case.own_links
    return {link: Node("link", link, train.case.link_name(link)) for link in range(1, count + 1)}


def pieces_of(train: Train) -> dict[Node, int]:
    """What turns as one piece: links, the engaged elements and mechanisms that join them."""
    links = links_of(train)
    piece = {node: link for link, node in links.items()}
    elements = train.case.shift_elements
    joined: list[tuple[Node, Sequence[int]]] = [
        (Node("element", number, elements[number - 1].name), elements[number - 1][:2])
        for number in train.gear.engaged
    ]
    joined += [
        (Node("mechanism", number, part.name), tuple(part.members.values()))
        for number, part in enumerate(train.parts, 1)
        if train.is_one_piece(part)
    ]
    for node, ends in joined:
        if HOUSING in ends:
            continue  # it stands, and has no power
        own = {piece[links[link]] for link in ends}
        piece[node] = min(own)
        for other, number in piece.items():
            if number in own:
                piece[other] = min(own)
    return piece
