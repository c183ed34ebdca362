"""Recirculating power: directed cycles in a graph of powers, removed one by one.

A flow on a graph can be decomposed into paths from sources to sinks, and cycles (Ahuja, Magnanti
and Orlin, Network Flows, 1993, theorem 3.5). Power in cycles is not transmitted. The decomposition
is not always unique. Here the shortest cycle is removed first. Of equally long cycles, the cycle
with the most power is removed first.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from typing import Literal, NamedTuple

from vstatics.core.groups import grouped
from vstatics.core.numerics.tolerances import CYCLE
from vstatics.core.tables.answer import json_keys
from vstatics.core.texts import translated

NodeKind = Literal["port", "link", "element", "mechanism", "spring", "drag", "gear"]
"""Kind of a node. `element` is a shift element, `mechanism` can also be a drawn gear set."""


class Node(NamedTuple):
    """Node of the power graph: a link, a device, a port or drag."""

    kind: NodeKind
    number: int
    """Number (from 1) among nodes of the same kind; for ports and drag, the number of the link."""
    name: str

    def __str__(self) -> str:
        """Return the name."""
        return self.name


@json_keys(from_="source", to="target", power="power")
class Edge(NamedTuple):
    """Power (above 0) that the first node gives to the second."""

    source: Node
    target: Node
    power: float
    """Power relative to the power at the input link. [-]"""


class CommonLinks(NamedTuple):
    """Two mechanisms that could share planets, and their common links."""

    first: str
    second: str
    links: tuple[str, ...]
    """Names of the common links, at least two."""


@json_keys("power", "nodes", "note")
class Loop(NamedTuple):
    """Cycle of power: the nodes in the direction of power, each once."""

    nodes: tuple[Node, ...]
    power: float
    """Recirculating power. [-]"""
    shared: tuple[CommonLinks, ...] = ()
    """Mechanisms with common links, if the loop can be an artefact of the model; else empty."""

    @property
    def note(self) -> str:
        """Note that the loop can be an artefact of the model; empty for a real loop."""
        return self.told(partial(translated, language="en"))

    def told(self, text: Callable[..., str]) -> str:
        """Return the note in another language; `text` translates texts."""
        reasons = [
            text(
                "{first} and {second} share {links}",
                first=common.first,
                second=common.second,
                links=text(
                    "{names} and {last}", names=", ".join(common.links[:-1]), last=common.links[-1]
                ),
            )
            for common in self.shared
        ]
        doubt = "may be an artefact of the model: {why}"
        return text(doubt, why=", ".join(reasons)) if reasons else ""


class Cancelled(NamedTuple):
    """Power graph without cycles, and the cycles that were removed."""

    edges: tuple[Edge, ...]
    loops: tuple[Loop, ...]


def cancel(edges: Sequence[Edge], order: Sequence[Node] = ()) -> Cancelled:
    """Remove directed cycles in turn, by subtracting the smallest power on the cycle.

    Parameters
    ----------
    edges : sequence of Edge
        Edges, at most one from a node to another node.
    order : sequence of Node
        Order of nodes, for reproducible results. A loop begins with its first node in this order.
        Of cycles with equal length and power, the cycle with the earlier node is removed first.
        Default: the order in `edges`.

    Examples
    --------
    >>> a, b, c, d = (
    ...     Node("link", number, name) for number, name in enumerate("abcd", 1)
    ... )
    >>> given = [Edge(a, b, 1.0), Edge(b, c, 1.5), Edge(c, b, 0.5), Edge(c, d, 1.0)]
    >>> rest, [loop] = cancel(given)
    >>> [str(node) for node in loop.nodes], loop.power
    (['b', 'c'], 0.5)
    >>> [(str(edge.source), str(edge.target), edge.power) for edge in rest]
    [('a', 'b', 1.0), ('b', 'c', 1.0), ('c', 'd', 1.0)]
    """
    powers = {(edge.source, edge.target): edge.power for edge in edges}
    least = CYCLE * max(powers.values(), default=0.0)
    ends = (node for edge in edges for node in edge[:2])
    nodes = list(dict.fromkeys([*order, *ends]))
    loops = []
    while loop := _shortest_cycle(powers, nodes):
        for pair in zip(loop.nodes, [*loop.nodes[1:], loop.nodes[0]], strict=True):
            powers[pair] -= loop.power
            if powers[pair] <= least:
                del powers[pair]
        if loop.power > least:
            loops.append(loop)
    return Cancelled(tuple(Edge(*pair, power) for pair, power in powers.items()), tuple(loops))


def _shortest_cycle(
    powers: Mapping[tuple[Node, Node], float], nodes: Sequence[Node]
) -> Loop | None:
    """Return the shortest cycle; of several, the cycle with the most power."""
    following = grouped(
        (source, (target, power)) for (source, target), power in _without_ends(powers).items()
    )
    best: Loop | None = None
    for node in (node for node in nodes if node in following):
        cycle = _shortest_cycle_through(node, following)
        if cycle is not None and (best is None or _is_before(cycle, best)):
            best = cycle
    return best


def _without_ends(
    powers: Mapping[tuple[Node, Node], float],
) -> Mapping[tuple[Node, Node], float]:
    """Return the edges that are not dead ends, which cannot be on a cycle."""
    while True:
        sources = {source for source, _ in powers}
        targets = {target for _, target in powers}
        inner = {pair: p for pair, p in powers.items() if pair[0] in targets and pair[1] in sources}
        if len(inner) == len(powers):
            return inner
        powers = inner


def _is_before(cycle: Loop, earlier: Loop) -> bool:
    if len(cycle.nodes) != len(earlier.nodes):
        return len(cycle.nodes) < len(earlier.nodes)
    return cycle.power > earlier.power * (1 + CYCLE)


def _shortest_cycle_through(
    start: Node, following: Mapping[Node, Iterable[tuple[Node, float]]]
) -> Loop | None:
    """Return the shortest cycle through a node; of several, the cycle with the most power."""
    layer = {start: Loop((start,), math.inf)}
    seen = {start}
    while layer:
        ahead: dict[Node, Loop] = {}
        for node, way in layer.items():
            for target, power in following.get(node, ()):
                longer = Loop((*way.nodes, target), min(way.power, power))
                if target not in seen or target == start:
                    known = ahead.get(target)
                    if known is None or _is_before(longer, known):
                        ahead[target] = longer
        if start in ahead:
            closed = ahead[start]
            return Loop(closed.nodes[:-1], closed.power)
        seen.update(ahead)
        layer = ahead
    return None
