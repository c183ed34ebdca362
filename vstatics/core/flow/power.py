"""Power flow of every gear through links, shift elements, mechanisms and springs.

The power flow of a gear is a directed graph. Its nodes are links, shift elements that carry torque
or drag, mechanisms or drawn gear sets, springs, ports where power enters or leaves, and the drag of
links. Its edges are the powers that nodes exchange. The housing has no power, so it is not a node.
"""

from __future__ import annotations

import math
from collections import defaultdict
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
    """Power that a link gives to a member of a node; negative if the link receives power."""

    node: Node
    member: str
    """Name of the member; empty for ports and drag of links."""
    link: int
    power: float
    """Power; NaN if indeterminate. [-]"""


@refusing()
def flows(results: Results) -> list[GearFlow]:
    """Return the power flow of every gear.

    Parameters
    ----------
    results : Results
        Results of a single case, not of arrays of variants.

    Returns
    -------
    list of GearFlow
        Power flow of each gear, relative to the power at the input link. [-]

    Raises
    ------
    ValueError
        For arrays of variants.

    Examples
    --------
    The input drives the sun, and the ring backward by a gear pair; the carrier is the output. Twice
    the input power passes the sun, and half of it returns.

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
    """Return the power flow of a gear with losses or, if that does not exist, without losses.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, -4.0, 0.98)], [Gear()])
    >>> round(shown_flow(solve(case).gear(1)).lost, 9)
    0.02
    """
    is_ok = all(status.has_power for status in state.statuses)
    return _flow(state, lossy=is_ok) if is_ok or state.calculable else None


def _of_gear(state: GearState, by_unit: dict[str, float]) -> GearFlow:
    status = next((candidate for candidate in state.statuses if not candidate.has_power), OK)
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
    """Yield nodes whose power is a convention, in the order of the flow."""
    if not sides:
        return
    nodes = sides[0].throughput
    bearing = {node for node in nodes if any(side.throughput[node] != 0 for side in sides)}
    divided = divided_by_convention(state, bearing, [side.edges for side in sides])
    unknown = {node for side in sides for node in side.unknown}
    yield from (node for node in nodes if node in divided & bearing - unknown)


def _flow(state: GearState, *, lossy: bool) -> PowerFlow:
    exchanges = _without_noise(
        [
            Exchange(Node(p.kind, p.number, p.name), p.member, p.link, plain(p.power))
            for p in state.powers(lossy=lossy)
        ]
    )
    links = links_of(state)
    powers = _by_link(exchanges, links)
    edges = tuple(
        Edge(link, node, power) if power > 0 else Edge(node, link, -power)
        for (node, link), power in powers.items()
        if abs(power) > 0
    )
    order = [*links.values(), *dict.fromkeys(exchange.node for exchange in exchanges)]
    pieces = pieces_of(state)
    within: list[Edge] = []
    outside: list[Edge] = []
    for edge in edges:
        source, target = pieces.get(edge.source), pieces.get(edge.target)
        (within if source is not None and source == target else outside).append(edge)
    at_rest = cancel(within, order)
    forward, loops = cancel([*outside, *at_rest.edges], order)
    at_ports = [exchange.power for exchange in exchanges if exchange.node.kind == "port"]
    return PowerFlow(
        edges,
        forward,
        tuple(
            MemberPower(e.node, e.member, state.case.link_name(e.link), e.power)
            for e in exchanges
            if e.member
        ),
        _throughput(powers, order),
        _losses(state, exchanges) if lossy else {},
        -sum(power for power in at_ports if not power > 0) + 0.0,
        sum(power for power in at_ports if not power < 0) + 0.0,
        tuple(loop._replace(shared=shared(state.case, loop)) for loop in loops),
        at_rest.loops,
        tuple(_without_noise(list(tooth_powers(state, lossy=lossy)))),
    )


_Powered = TypeVar("_Powered", Exchange, ToothPower)


def _without_noise(powers: Sequence[_Powered]) -> list[_Powered]:
    """Return powers, with 0 for rounding errors."""
    known = (abs(item.power) for item in powers if not math.isnan(item.power))
    noise = NO_POWER * max(known, default=0.0)
    return [item._replace(power=0.0) if abs(item.power) <= noise else item for item in powers]


def _by_link(
    exchanged: Sequence[Exchange], links: Mapping[int, Node]
) -> dict[tuple[Node, Node], float]:
    """Return the power that each node receives from each link [-], by node and link."""
    powers = defaultdict[tuple[Node, Node], float](float)
    for exchange in exchanged:
        if exchange.link != HOUSING:
            powers[exchange.node, links[exchange.link]] += exchange.power
    return powers


def _throughput(
    powers: Mapping[tuple[Node, Node], float], nodes: Sequence[Node]
) -> dict[Node, float]:
    """Return the power that enters each node [-]; for a port, the magnitude of its power."""
    entering = dict.fromkeys(nodes, 0.0)
    for (node, link), power in powers.items():
        if not power < 0 or node.kind == "port":
            entering[node] += abs(power)
        if not power > 0:
            entering[link] -= power
    return entering


def _losses(state: GearState, exchanged: Sequence[Exchange]) -> dict[Node, float]:
    losses = defaultdict[Node, float](float)
    for number, device in enumerate(state.case.own_devices, 1):
        lost = sum(plain(state.mechanism_losses[index]) for index in device.mechanisms)
        loss = lost * state.ideal.direction + 0.0
        losses[Node("mechanism", number, device.name)] = loss
    for exchange in exchanged:
        number = exchange.node.number
        dissipates = exchange.node.kind == "element" and (
            number - 1 in state.drag.elements or number in state.gear.slipping
        )
        if dissipates or exchange.node.kind in ("drag", "gear"):
            losses[exchange.node] += exchange.power
    return losses
