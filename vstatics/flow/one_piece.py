"""What turns as one piece, and whose power in it is divided by a convention.

Where a clutch holds a set as one piece the teeth do not move. Friction leaves a range of
torques that they may carry, of which the calculation takes one.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Iterable, Iterator, Mapping, Sequence

from vstatics.flow.circulation import Edge, Node
from vstatics.flow.exchange import links_of
from vstatics.model.transmission import HOUSING
from vstatics.statics.bodies import is_one_piece
from vstatics.statics.state import GearState

_Leg = tuple[Node, Node]
"""A device, and a link on which it has members."""


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


def divided_by_convention(
    state: GearState, bearing: Container[Node], flows: Iterable[Sequence[Edge]]
) -> set[Node]:
    """Mechanisms, shift elements and links of a gear whose power a convention decides.

    In what turns as one piece these are: the devices on a closed path, since of two ways
    statics does not say which bears how much; a mechanism that nothing but its speeds
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
    legs = [leg for leg in dict.fromkeys(_legs(state)) if leg[0] in bearing]
    count = Counter(device for device, _ in legs if device.kind == "mechanism")
    open_legs = {leg for leg in legs if count[leg[0]] > 2}
    divided = _on_closed_paths(legs) | open_legs
    found = {device for device, _ in divided}
    for edges in flows:
        getting = {target for source, target, _ in edges if (source, target) in divided}
        giving = {source for source, target, _ in edges if (target, source) in divided}
        found |= getting & giving
    return found


def _legs(state: GearState) -> Iterator[_Leg]:
    """The devices that turn as one piece, by link."""
    case, links = state.case, links_of(state)
    for node in pieces_of(state):
        if node.kind == "element":
            for link in case.shift_elements[node.number - 1][:2]:
                yield node, links[link]
        elif node.kind == "mechanism":
            for member in case.own_devices[node.number - 1].members:
                yield node, links[member.link]


def _on_closed_paths(legs: Sequence[_Leg]) -> set[_Leg]:
    """Those without which their ends would still be joined: of a tree and a leg that closes it."""
    up: dict[Node, _Leg | None] = {}
    depth: dict[Node, int] = {}
    near: dict[Node, list[_Leg]] = {}
    for leg in legs:
        for node in leg:
            near.setdefault(node, []).append(leg)
    closed: set[_Leg] = set()
    for root in near:
        if root not in up:
            up[root], depth[root] = None, 0
            _grow(root, near, up, depth)
    for leg in legs:
        one, other = leg
        if leg in (up[one], up[other]):
            continue
        closed.add(leg)
        while one != other:
            if depth[one] < depth[other]:
                one, other = other, one
            step = up[one]
            assert step is not None  # noqa: S101 - for mypy: the deeper of two has one above
            closed.add(step)
            one = step[1] if step[0] == one else step[0]
    return closed


def _grow(
    root: Node,
    near: Mapping[Node, Sequence[_Leg]],
    up: dict[Node, _Leg | None],
    depth: dict[Node, int],
) -> None:
    """Make a tree of all that a node is joined with, the nearest first."""
    ahead = [root]
    for node in ahead:
        for leg in near[node]:
            other = leg[1] if leg[0] == node else leg[0]
            if other not in up:
                up[other], depth[other] = leg, depth[node] + 1
                ahead.append(other)
