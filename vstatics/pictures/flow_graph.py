"""The graph of a picture of power: layers from left to right, bands, and what goes back."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple

from vstatics.flow.circulation import Edge, Loop, Node
from vstatics.flow.power_flow import PowerFlow
from vstatics.numerics.tolerances import NOISE


class Band(NamedTuple):
    """Power from one node to another."""

    source: Node
    target: Node
    power: float
    """[-]"""
    loop: int | None = None
    """Index of the loop that it is part of; None of what is transmitted."""
    back: bool = False
    """Whether it runs from right to left."""
    between: tuple[Node, ...] = ()
    """Nodes on the way back, through which nothing else goes."""

    @property
    def pairs(self) -> tuple[tuple[Node, Node], ...]:
        """Neighbours along the band."""
        return tuple(pairwise((self.source, *self.between, self.target)))


class Graph(NamedTuple):
    """What is drawn of a gear."""

    layers: Mapping[Node, int]
    """Of each node but those on the way back, from 0 at the left."""
    bands: tuple[Band, ...]
    losses: Mapping[Node, float]
    """What each node loses, with the drag of a link. [-]"""

    def entering(self, node: Node) -> float:
        """Power of all bands to a node [-]."""
        return math.fsum(band.power for band in self.bands if band.target == node)

    def leaving(self, node: Node) -> float:
        """Power of all bands from a node [-], without its losses."""
        return math.fsum(band.power for band in self.bands if band.source == node)

    def through(self, node: Node) -> float:
        """Power that is drawn through a node [-]."""
        on_way = math.fsum(band.power for band in self.bands if node in band.between)
        lost = self.losses.get(node, 0.0)
        return on_way + max(self.entering(node), self.leaving(node) + lost)


def graph(side: PowerFlow) -> Graph:
    """The graph of a gear.

    A node stands one layer right of the last that it gets power from; ports by which
    power leaves stand in the last layer. Parts of a loop that can run from left to
    right do so, the rest goes back.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> from vstatics.flow.power import flows
    >>> mechanisms = [Mechanism(1, 2, 3, -2.0, name="set"), Mechanism(1, 2, 0, -4.0, name="pair")]
    >>> [gear] = flows(solve(Transmission(3, [], mechanisms, [Gear()])))
    >>> drawn = graph(gear.ideal)
    >>> {str(node): layer for node, layer in drawn.layers.items()}
    {'input': 0, '1': 1, 'set': 2, '3': 3, 'output': 4}
    >>> [" > ".join(map(str, (band.source, *band.between))) for band in drawn.bands if band.back]
    ['set > 2 > pair']
    """
    edges = [edge for edge in side.forward if edge.target.kind != "drag"]
    pieces = [
        (number, piece) for number, loop in enumerate(side.loops) for piece in _cut(loop, edges)
    ]
    pairs = [(edge.source, edge.target) for edge in edges]
    back = []
    for _, piece in pieces:  # what closes no cycle runs from left to right
        back.append(piece[0] in _behind(piece[-1], pairs))
        pairs += [] if back[-1] else pairwise(piece)
    bands = [Band(*edge) for edge in edges]
    for (number, piece), returns in zip(pieces, back, strict=True):
        power = side.loops[number].power
        if returns:
            bands.append(
                Band(piece[0], piece[-1], power, number, back=True, between=tuple(piece[1:-1]))
            )
        else:
            bands += [Band(*pair, power, number) for pair in pairwise(piece)]
    ends = [node for band in bands for node in (band.source, band.target)]
    return Graph(_layers(dict.fromkeys(ends), pairs), tuple(bands), _losses(side))


def _cut(loop: Loop, edges: Iterable[Edge]) -> Iterator[Sequence[Node]]:
    """A loop as ways from each of its nodes that transmit something to the next."""
    known = {node for edge in edges for node in edge[:2]}
    places = [place for place, node in enumerate(loop.nodes) if node in known] or [0]
    twice = loop.nodes * 2
    for start, end in zip(places, [*places[1:], places[0] + len(loop.nodes)], strict=True):
        yield twice[start : end + 1]


def _behind(start: Node, pairs: Sequence[tuple[Node, Node]]) -> set[Node]:
    """All nodes to which a way leads from one, and this itself."""
    found, ahead = {start}, [start]
    while ahead:
        node = ahead.pop()
        fresh = {target for source, target in pairs if source == node} - found
        found |= fresh
        ahead += fresh
    return found


def _layers(nodes: Iterable[Node], pairs: Sequence[tuple[Node, Node]]) -> dict[Node, int]:
    """The longest way to each node in a graph without cycles."""
    layers = dict.fromkeys(nodes, 0)
    changed = True
    while changed:
        changed = False
        for source, target in pairs:
            if layers[target] <= layers[source]:
                layers[target] = layers[source] + 1
                changed = True
    last = max(layers.values(), default=0)
    givers = {source for source, _ in pairs}
    exits = (node for node in layers if node.kind == "port" and node not in givers)
    layers.update(dict.fromkeys(exits, last))
    return dict(sorted(layers.items(), key=lambda item: item[1]))


def _losses(side: PowerFlow) -> dict[Node, float]:
    """Losses above rounding; the drag of a link leaves at the link itself."""
    least = NOISE * max((edge.power for edge in side.edges), default=0.0)
    by_node = side.losses.items()
    losses = {node: loss for node, loss in by_node if loss > least and node.kind != "drag"}
    for edge in side.forward:
        if edge.target.kind == "drag":
            losses[edge.source] = losses.get(edge.source, 0.0) + edge.power
    return losses
