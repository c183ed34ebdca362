"""A gear as a graph of power: what its links, devices, ports and drag exchange."""

from __future__ import annotations

from typing import NamedTuple

from vstatics.flow.circulation import Node
from vstatics.numerics.traced import plain
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
