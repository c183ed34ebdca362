"""Parts that rotate as a block, and the conventional power split in such parts.

If a clutch locks up a gear set, its teeth do not move. Friction then permits a whole range of tooth
torques, from which the calculation takes a value by convention.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Iterable, Iterator, Sequence

from vstatics.core.flow.circulation import Edge, Node
from vstatics.core.flow.graph_cycles import edges_on_cycles
from vstatics.core.model.transmission import HOUSING
from vstatics.core.statics.bodies import is_one_piece, turns_as_one
from vstatics.core.statics.state import GearState


def links_of(state: GearState) -> dict[int, Node]:
    """Return the node of each link, without planets."""
    case = state.case
    return {link: Node("link", link, case.link_name(link)) for link in range(1, case.own_links + 1)}


def pieces_of(state: GearState) -> dict[Node, int]:
    """Return the body of each link and of each device that rotates as a block."""
    bodies = state.bodies
    pieces = {node: bodies[link] for link, node in links_of(state).items()}
    return pieces | {node: bodies[links[0]] for node, links in _in_pieces(state)}


def _in_pieces(state: GearState) -> Iterator[tuple[Node, Sequence[int]]]:
    """Yield each device that rotates as a block, with its links."""
    case = state.case
    for number in state.engaged:
        element = case.shift_elements[number - 1]
        if HOUSING not in element.links:  # a brake is at rest and transmits no power
            yield Node("element", number, element.name), element.links
    for number, device in enumerate(case.own_devices, 1):
        links = [member.link for member in device.members]
        if HOUSING not in links and is_one_piece(device, state.speeds):
            yield Node("mechanism", number, device.name), links
    for number, spring in enumerate(case.springs, 1):
        if turns_as_one(spring, state.speeds):
            yield Node("spring", number, spring.name), list(spring.form)


def divided_by_convention(
    state: GearState, bearing: Container[Node], flows: Iterable[Sequence[Edge]]
) -> set[Node]:
    """Return the devices and links of a gear whose power is set by convention.

    If parts that rotate as a block form a cycle, statics does not determine the power split between
    its two paths. The result contains the devices on cycles, mechanisms with three or more links in
    a block, and links that receive power from such devices and give power to such devices. A clutch
    that transmits all power is not included.

    Parameters
    ----------
    state : GearState
    bearing : container of Node
        Nodes that carry power.
    flows : iterable of sequence of Edge
        Edges of the power flow without and with losses.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> clutches = [ShiftElement(1, 2, "start"), ShiftElement(2, 4, "direct")]
    >>> case = Transmission(4, clutches, [Mechanism(2, 3, 4, -2.0, name="set")], [Gear([1, 2])])
    >>> state = solve(case).gear(1)
    >>> sorted(map(str, divided_by_convention(state, pieces_of(state), [])))
    ['direct', 'set']
    """
    nodes = links_of(state)
    pairs = ((device, nodes[link]) for device, links in _in_pieces(state) for link in links)
    members = [pair for pair in dict.fromkeys(pairs) if pair[0] in bearing]
    count = Counter(device for device, _ in members if device.kind == "mechanism")
    of_three = {pair for pair in members if count[pair[0]] > 2}
    divided = edges_on_cycles(members) | of_three
    divided_nodes = {device for device, _ in divided}
    for edges in flows:
        getting = {target for source, target, _ in edges if (source, target) in divided}
        giving = {source for source, target, _ in edges if (target, source) in divided}
        divided_nodes |= getting & giving
    return divided_nodes
