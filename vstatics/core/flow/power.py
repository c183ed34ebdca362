"""Where the power goes in every gear: through links, shift elements, mechanisms and springs.

The power of a gear is a directed graph. Its nodes are links, shift elements that are
engaged (or drag), mechanisms or drawn elements, springs, ports by which power enters and
leaves, and the drag of links; its edges are what they exchange. The housing has no power.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple, TypeVar

from vstatics.core.arguments import refusing
from vstatics.core.flow.circulation import Edge, Node, cancel
from vstatics.core.flow.one_piece import divided_by_convention, links_of, pieces_of
from vstatics.core.flow.power_flow import GearFlow, MemberPower, PowerFlow
from vstatics.core.flow.shared_planets import shared
from vstatics.core.flow.teeth import ToothPower, tooth_powers
from vstatics.core.model.transmission import HOUSING
from vstatics.core.numerics.tolerances import NO_POWER
from vstatics.core.numerics.traced import plain
from vstatics.core.statics.physical import gear_scales
from vstatics.core.statics.results import Results, expect_one_case
from vstatics.core.statics.state import GearState
from vstatics.core.statics.status import OK
from vstatics.core.tables.ports import port_table


class Exchange(NamedTuple):
    """The power that a link gives to a member of a node; below 0 where it takes."""

    node: Node
    member: str
    """Nothing for ports and drag of links, which have one link only."""
    link: int
    power: float
    """NaN where it is not determined. [-]"""


@refusing()
def flows(results: Results) -> list[GearFlow]:
    """The power of every gear.

    Parameters
    ----------
    results : Results
        Of one case, not of arrays of variants.

    Returns
    -------
    list of GearFlow
        By gear; powers relative to that at the input link. [-]

    Raises
    ------
    ValueError
        For arrays of variants.

    Examples
    --------
    Input at the sun, output at the carrier; the input drives the ring backward by a gear
    pair. Twice the power that enters goes through the sun, half of it comes back.

    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> mechanisms = [Mechanism(1, 2, 3, -2.0, name="set"), Mechanism(1, 2, 0, -4.0, name="pair")]
    >>> [gear] = flows(solve(Transmission(3, [], mechanisms, [Gear()])))
    >>> {str(node): round(power, 9) for node, power in gear.ideal.throughput.items()}
    {'1': 2.0, '2': 1.0, '3': 1.0, 'set': 2.0, 'pair': 1.0, 'input': 1.0, 'output': 1.0}
    >>> [(" ".join(map(str, loop.nodes)), round(loop.power, 9)) for loop in gear.ideal.loops]
    [('1 set 2 pair', 1.0)]
    """
    expect_one_case(results, "flows")
    return [
        _of_gear(results.gear_at(index), by_unit)
        for index, by_unit in enumerate(gear_scales(results.case))
    ]


def shown_flow(state: GearState) -> PowerFlow | None:
    """The power of a gear with losses, where it exists, else without; None where it has none.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, -4.0, 0.98)], [Gear()])
    >>> round(shown_flow(solve(case).gear(1)).lost, 9)
    0.02
    """
    is_ok = all(one.has_power for one in state.statuses)
    return _flow(state, lossy=is_ok) if is_ok or state.calculable else None


def _of_gear(state: GearState, by_unit: dict[str, float]) -> GearFlow:
    status = next((one for one in state.statuses if not one.has_power), OK)
    ideal = _flow(state, lossy=False) if state.calculable else None
    lossy = _flow(state, lossy=True) if status is OK else None
    sides = [side for side in (ideal, lossy) if side is not None]
    return GearFlow(
        state.gear.name,
        ideal,
        lossy,
        port_table(state, by_unit),
        status,
        tuple(_by_convention(state, sides)),
    )


def _by_convention(state: GearState, sides: Sequence[PowerFlow]) -> Iterator[Node]:
    """In the order of the flow, of nodes that have power."""
    if not sides:
        return
    nodes = sides[0].throughput
    bearing = {node for node in nodes if any(side.throughput[node] != 0 for side in sides)}
    found = divided_by_convention(state, bearing, [side.edges for side in sides])
    unknown = {node for side in sides for node in side.unknown}
    yield from (node for node in nodes if node in found & bearing - unknown)


def _flow(state: GearState, *, lossy: bool) -> PowerFlow:
    """The power of a gear without or with losses."""
    everything = _without_noise(
        [
            Exchange(Node(one.kind, one.number, one.name), one.member, one.link, plain(one.power))
            for one in state.powers(lossy=lossy)
        ]
    )
    links = links_of(state)
    powers = _by_link(everything, links)
    edges = tuple(
        Edge(link, node, power) if power > 0 else Edge(node, link, -power)
        for (node, link), power in powers.items()
        if abs(power) > 0
    )
    order = [*links.values(), *dict.fromkeys(one.node for one in everything)]
    pieces = pieces_of(state)
    within: list[Edge] = []
    outside: list[Edge] = []
    for edge in edges:
        one, other = pieces.get(edge.source), pieces.get(edge.target)
        (within if one is not None and one == other else outside).append(edge)
    at_rest = cancel(within, order)
    forward, loops = cancel([*outside, *at_rest.edges], order)
    at_ports = [one.power for one in everything if one.node.kind == "port"]
    return PowerFlow(
        edges,
        forward,
        tuple(
            MemberPower(one.node, one.member, state.case.link_name(one.link), one.power)
            for one in everything
            if one.member
        ),
        _throughput(powers, order),
        _losses(state, everything) if lossy else {},
        -sum(power for power in at_ports if not power > 0) + 0.0,
        sum(power for power in at_ports if not power < 0) + 0.0,
        tuple(loop._replace(shared=shared(state.case, loop)) for loop in loops),
        at_rest.loops,
        tuple(_without_noise(list(tooth_powers(state, lossy=lossy)))),
    )


_Powered = TypeVar("_Powered", Exchange, ToothPower)


def _without_noise(found: Sequence[_Powered]) -> list[_Powered]:
    """Powers that are nothing but rounding made 0."""
    known = (abs(one.power) for one in found if not math.isnan(one.power))
    noise = NO_POWER * max(known, default=0.0)
    return [one._replace(power=0.0) if abs(one.power) <= noise else one for one in found]


def _by_link(
    exchanged: Sequence[Exchange], links: Mapping[int, Node]
) -> dict[tuple[Node, Node], float]:
    """What each node gets from each link, the housing apart, by node and link."""
    powers: dict[tuple[Node, Node], float] = {}
    for one in exchanged:
        if one.link != HOUSING:
            pair = one.node, links[one.link]
            powers[pair] = powers.get(pair, 0.0) + one.power
    return powers


def _throughput(
    powers: Mapping[tuple[Node, Node], float], nodes: Sequence[Node]
) -> dict[Node, float]:
    """What enters each node; a port passes what it exchanges."""
    entering = dict.fromkeys(nodes, 0.0)
    for (node, link), power in powers.items():
        if not power < 0 or node.kind == "port":
            entering[node] += abs(power)
        if not power > 0:
            entering[link] -= power
    return entering


def _losses(state: GearState, exchanged: Sequence[Exchange]) -> dict[Node, float]:
    """Of each mechanism or drawn element, open shift element and link."""
    losses: dict[Node, float] = {}
    for number, device in enumerate(state.case.own_devices, 1):
        lost = sum(plain(state.mechanism_losses[index]) for index in device.mechanisms)
        loss = lost * state.ideal.direction + 0.0
        losses[Node("mechanism", number, device.name)] = loss
    for one in exchanged:
        drags = one.node.kind == "element" and one.node.number - 1 in state.drag.elements
        if drags or one.node.kind == "drag":
            losses[one.node] = losses.get(one.node, 0.0) + one.power
    return losses
