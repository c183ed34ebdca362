"""A gear as a graph of power: what its links, devices, ports and drag exchange."""

from __future__ import annotations

from typing import NamedTuple

from vstatics.flow.circulation import Node
from vstatics.model.transmission import HOUSING
from vstatics.numerics.traced import plain
from vstatics.statics.bodies import is_one_piece
from vstatics.statics.state import GearState


class Exchange(NamedTuple):
    """The power that a link gives to a member of a node; below 0 where it takes."""

    node: Node
    member: str
    """Nothing for ports and drag of links, which have one link only."""
    link: int
    power: float
    """NaN where it is not determined. [-]"""


def exchanges(state: GearState, *, lossy: bool) -> list[Exchange]:
    """Of devices, then of ports, then of drag."""
    return [
        Exchange(Node(one.kind, one.number, one.name), one.member, one.link, plain(one.power))
        for one in state.powers(lossy=lossy)
    ]


def links_of(state: GearState) -> dict[int, Node]:
    """The links that a case names itself: planets of drawn elements apart."""
    case = state.case
    return {link: Node("link", link, case.link_name(link)) for link in range(1, case.own_links + 1)}


def pieces_of(state: GearState) -> dict[Node, int]:
    """What turns as one piece: links, the engaged elements and devices that join them."""
    case, bodies = state.case, state.bodies
    piece = {node: bodies[link] for link, node in links_of(state).items()}
    for number in state.engaged:
        element = case.shift_elements[number - 1]
        if HOUSING not in (element.first, element.second):  # else it stands, and has no power
            piece[Node("element", number, element.name)] = bodies[element.first]
    for number, device in enumerate(case.own_devices, 1):
        links = [member.link for member in device.members]
        if HOUSING not in links and is_one_piece(device, state.speeds):
            piece[Node("mechanism", number, device.name)] = bodies[links[0]]
    return piece
