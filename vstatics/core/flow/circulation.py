"""Power that circulates: directed cycles of a graph of power, cancelled one by one.

A flow on a graph can be taken apart into paths from where it enters to where it leaves,
and cycles (Ahuja, Magnanti and Orlin, Network Flows, 1993, theorem 3.5). What goes
around in the cycles is no part of what is transmitted. Which cycles they are need not
be unique; here the shortest is taken first, of several the one with the most power.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial
from typing import Literal, NamedTuple

from vstatics.core.numerics.tolerances import CYCLE
from vstatics.core.tables.answer import told
from vstatics.core.texts import translated

NodeKind = Literal["port", "link", "element", "mechanism", "spring", "drag"]
"""An element is a shift element; a mechanism may be a drawn element."""


class Node(NamedTuple):
    """Something that power goes through, comes from or goes to."""

    kind: NodeKind
    number: int
    """Of its kind, from 1; of a port and of drag that of the link."""
    name: str

    def __str__(self) -> str:
        """The name alone."""
        return self.name


@told(from_="source", to="target", power="power")
class Edge(NamedTuple):
    """Power from one node to another, above 0."""

    source: Node
    target: Node
    power: float
    """Relative to the power at the input link. [-]"""


class CommonLinks(NamedTuple):
    """Two mechanisms that may be one set with shared planets, by what they have in common."""

    first: str
    second: str
    links: tuple[str, ...]
    """Two at least."""


@told("power", "nodes", "note")
class Loop(NamedTuple):
    """Nodes in the order in which power goes around, each once, and how much."""

    nodes: tuple[Node, ...]
    power: float
    """[-]"""
    shared: tuple[CommonLinks, ...] = ()
    """Where the loop may not be in the metal: the mechanisms that it runs through."""

    @property
    def note(self) -> str:
        """The same in words; nothing of a loop that is real."""
        return self.told(partial(translated, language="en"))

    def told(self, text: Callable[..., str]) -> str:
        """The note in a language, by what gives its texts."""
        said = [
            text(
                "{first} and {second} share {links}",
                first=one.first,
                second=one.second,
                links=text(
                    "{names} and {last}", names=", ".join(one.links[:-1]), last=one.links[-1]
                ),
            )
            for one in self.shared
        ]
        return text("may not be in the metal: {why}", why=", ".join(said)) if said else ""


class Cancelled(NamedTuple):
    """A graph of power without cycles, and the cycles that it had."""

    edges: tuple[Edge, ...]
    loops: tuple[Loop, ...]


def cancel(edges: Sequence[Edge], order: Sequence[Node] = ()) -> Cancelled:
    """Take directed cycles away, one after another, each by its least power.

    Parameters
    ----------
    edges : sequence of Edge
        One at most from one node to another.
    order : sequence of Node
        A loop begins with the first of its nodes in this order, and of cycles alike in
        length and power that of the earlier node goes first. Else the order of `edges`.

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
    while loop := _first(powers, nodes):
        for pair in zip(loop.nodes, [*loop.nodes[1:], loop.nodes[0]], strict=True):
            powers[pair] -= loop.power
            if powers[pair] <= least:
                del powers[pair]
        if loop.power > least:
            loops.append(loop)
    return Cancelled(tuple(Edge(*pair, power) for pair, power in powers.items()), tuple(loops))


def _first(powers: Mapping[tuple[Node, Node], float], nodes: Sequence[Node]) -> Loop | None:
    """The shortest cycle; of several that with the most power, then the first."""
    following: dict[Node, list[tuple[Node, float]]] = {}
    for (source, target), power in _without_ends(powers).items():
        following.setdefault(source, []).append((target, power))
    best: Loop | None = None
    for node in (node for node in nodes if node in following):
        found = _through(node, following)
        if found is not None and (best is None or _is_before(found, best)):
            best = found
    return best


def _without_ends(
    powers: Mapping[tuple[Node, Node], float],
) -> Mapping[tuple[Node, Node], float]:
    """The edges without those that no cycle can have: nothing comes before or after them."""
    while True:
        sources = {source for source, _ in powers}
        targets = {target for _, target in powers}
        kept = {pair: p for pair, p in powers.items() if pair[0] in targets and pair[1] in sources}
        if len(kept) == len(powers):
            return kept
        powers = kept


def _is_before(one: Loop, other: Loop) -> bool:
    """Whether a cycle is to be cancelled before another that was found earlier."""
    if len(one.nodes) != len(other.nodes):
        return len(one.nodes) < len(other.nodes)
    return one.power > other.power * (1 + CYCLE)


def _through(start: Node, following: Mapping[Node, Iterable[tuple[Node, float]]]) -> Loop | None:
    """The shortest cycle through a node, of several that with the most power."""
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
