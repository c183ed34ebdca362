"""What turns as one piece, and whose power in it is divided by a convention.

Where a clutch holds a set as one piece the teeth do not move. Friction leaves a range of
torques that they may carry, of which the calculation takes one.
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
    """The links that a case names itself: planets of drawn elements apart."""
    case = state.case
    return {link: Node("link", link, case.link_name(link)) for link in range(1, case.own_links + 1)}


def pieces_of(state: GearState) -> dict[Node, int]:
    """What turns as one piece: links, the engaged elements, devices and springs between them."""
    bodies = state.bodies
    pieces = {node: bodies[link] for link, node in links_of(state).items()}
    return pieces | {node: bodies[links[0]] for node, links in _in_pieces(state)}


def _in_pieces(state: GearState) -> Iterator[tuple[Node, Sequence[int]]]:
    """Each device that turns as one piece, with its links."""
    case = state.case
    for number in state.engaged:
        element = case.shift_elements[number - 1]
        if HOUSING not in element.links:  # else it stands, and has no power
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
    """Devices and links of a gear whose power a convention decides.

    In what turns as one piece these are: the devices on a cycle, since of two ways statics
    does not say which bears how much; a mechanism that nothing but its speeds
    makes one piece; and the links that get power from such devices and give it to such. A
    clutch that all power of a part has to pass is none of them.

    Parameters
    ----------
    state : GearState
    bearing : container of Node
        Whatever has power.
    flows : iterable of sequence of Edge
        The powers, without and with losses.

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
    pairs = ((device, nodes[one]) for device, links in _in_pieces(state) for one in links)
    members = [one for one in dict.fromkeys(pairs) if one[0] in bearing]
    count = Counter(device for device, _ in members if device.kind == "mechanism")
    of_three = {one for one in members if count[one[0]] > 2}
    divided = edges_on_cycles(members) | of_three
    found = {device for device, _ in divided}
    for edges in flows:
        getting = {target for source, target, _ in edges if (source, target) in divided}
        giving = {source for source, target, _ in edges if (target, source) in divided}
        found |= getting & giving
    return found
