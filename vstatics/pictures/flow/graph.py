"""The graph of a picture of power: runs of nodes from left to right, bands, and what goes back."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple

from vstatics.core.flow.circulation import Edge, Loop, Node
from vstatics.core.flow.power_flow import PowerFlow
from vstatics.core.numerics.tolerances import NO_POWER

Run = tuple[Node, ...]
"""Nodes in series, through which the same power goes: no loss, no branch between them."""


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
    between: Run = ()
    """Nodes on the way back, through which nothing else goes."""

    @property
    def pairs(self) -> tuple[tuple[Node, Node], ...]:
        """Neighbours along the band."""
        return tuple(pairwise((self.source, *self.between, self.target)))


class EndPort(NamedTuple):
    """Where power enters or leaves at a link."""

    node: Node
    power: float
    """[-]"""
    enters: bool
    cut: Band | None = None
    """The band that comes from another row here, or goes on in one."""


class Graph(NamedTuple):
    """What is drawn of a gear."""

    runs: tuple[Run, ...]
    """All nodes but those on the way back."""
    layers: tuple[int, ...]
    """Of each run, from 0 at the left."""
    place: Mapping[Node, int]
    """The index of a node's run."""
    bands: tuple[Band, ...]
    ports: Mapping[Node, tuple[EndPort, ...]]
    """Of links that have some."""
    losses: Mapping[Node, float]
    """What each node loses, with the drag of a link. [-]"""
    numbered: frozenset[int]
    """Indices of the bands whose power the numbers of nodes and loops do not tell."""

    def ends(self, band: Band) -> tuple[int, int]:
        """The runs that a band joins, by their indices."""
        return self.place[band.source], self.place[band.target]

    def is_within(self, band: Band) -> bool:
        """Whether a band runs inside one run."""
        return not band.back and self.place[band.source] == self.place[band.target]

    def through(self, node: Node) -> float:
        """Power that is drawn through a node [-]."""
        own = self.ports.get(node, ())
        entering = [band.power for band in self.bands if band.target == node]
        entering += [port.power for port in own if port.enters]
        leaving = [band.power for band in self.bands if band.source == node]
        leaving += [port.power for port in own if not port.enters]
        on_way = math.fsum(band.power for band in self.bands if node in band.between)
        lost = self.losses.get(node, 0.0)
        return on_way + max(math.fsum(entering), math.fsum(leaving) + lost)


def graph(side: PowerFlow) -> Graph:
    """The graph of a gear.

    A port is a part of its link. A run stands right of the last that it gets power from;
    ports by which power leaves stand in the last layer. Parts of a loop that can run from
    left to right do so, the rest goes back.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> from vstatics.core.flow.power import flows
    >>> mechanisms = [Mechanism(1, 2, 3, -2.0, name="set"), Mechanism(1, 2, 0, -4.0, name="pair")]
    >>> [gear] = flows(solve(Transmission(3, [], mechanisms, [Gear()])))
    >>> drawn = graph(gear.ideal)
    >>> [(layer, *map(str, run)) for run, layer in zip(drawn.runs, drawn.layers)]
    [(0, '1', 'set'), (1, '3')]
    >>> [" > ".join(map(str, (band.source, *band.between))) for band in drawn.bands if band.back]
    ['set > 2 > pair']
    """
    edges = [edge for edge in side.forward if edge.target.kind != "drag"]
    ports = _ports(edges)
    edges = [edge for edge in edges if "port" not in (edge.source.kind, edge.target.kind)]
    known = dict.fromkeys([*ports, *(node for edge in edges for node in edge[:2])])
    pieces = [
        (number, piece) for number, loop in enumerate(side.loops) for piece in _cut(loop, known)
    ]
    pairs = [(edge.source, edge.target) for edge in edges]
    bands = [Band(*edge) for edge in edges]
    for number, piece in pieces:  # what closes no cycle runs from left to right
        power = side.loops[number].power
        if piece[0] in _behind(piece[-1], pairs):
            ends = piece[0], piece[-1]
            bands.append(Band(*ends, power, number, back=True, between=tuple(piece[1:-1])))
        else:
            pairs += pairwise(piece)
            bands += [Band(*pair, power, number) for pair in pairwise(piece)]
    nodes = dict.fromkeys(
        [*known, *(node for band in bands for node in (band.source, band.target))]
    )
    drawn = Graph((), (), {}, tuple(bands), ports, _losses(side), frozenset())
    runs = tuple(_runs(nodes, drawn))
    place = {node: index for index, run in enumerate(runs) for node in run}
    drawn = drawn._replace(runs=runs, place=place)
    drawn = drawn._replace(numbered=frozenset(_numbered(drawn)))
    return drawn._replace(layers=_layers(drawn))


def _ports(edges: Iterable[Edge]) -> dict[Node, tuple[EndPort, ...]]:
    """Ports by their links."""
    found: dict[Node, tuple[EndPort, ...]] = {}
    for source, target, power in edges:
        for port, link in ((source, target), (target, source)):
            if port.kind == "port":
                found[link] = *found.get(link, ()), EndPort(port, power, port is source)
    return found


def _cut(loop: Loop, known: Iterable[Node]) -> Iterator[Sequence[Node]]:
    """A loop as ways from each of its nodes that transmit something to the next."""
    others = set(known)
    places = [place for place, node in enumerate(loop.nodes) if node in others] or [0]
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


def _runs(nodes: Iterable[Node], drawn: Graph) -> Iterator[Run]:
    """Nodes in series together, in the order of the first of each run."""
    pairs = {(band.source, band.target) for band in drawn.bands}
    leaving, arriving = (Counter(pair[end] for pair in pairs) for end in (0, 1))
    least = NO_POWER * max((band.power for band in drawn.bands), default=0.0)
    behind: dict[Node, Node] = {}
    for one, other in ((band.source, band.target) for band in drawn.bands if not band.back):
        branch = leaving[one] > 1 or arriving[other] > 1
        branch |= any(not port.enters for port in drawn.ports.get(one, ()))
        branch |= any(port.enters for port in drawn.ports.get(other, ()))
        alike = abs(drawn.through(one) - drawn.through(other)) <= least
        if alike and not branch and not {one, other} & drawn.losses.keys():
            behind[one] = other
    for node in nodes:
        if node not in behind.values():
            run = [node]
            while run[-1] in behind:
                run.append(behind[run[-1]])
            yield tuple(run)


def _numbered(drawn: Graph) -> Iterator[int]:
    """Bands where power branches at both ends.

    What runs beside a loop is what the node has less the loop.
    """
    forth = [(n, b) for n, b in enumerate(drawn.bands) if not drawn.is_within(b)]
    sources = [drawn.ends(band)[0] for _, band in forth]
    targets = [drawn.ends(band)[1] for _, band in forth]
    for node, own in drawn.ports.items():
        sources += [drawn.place[node] for port in own if not port.enters]
        targets += [drawn.place[node] for port in own if port.enters]
    beside = {pair for band in drawn.bands if band.loop is not None for pair in band.pairs}
    for number, band in forth:
        source, target = drawn.ends(band)
        branches = sources.count(source) > 1 and targets.count(target) > 1
        if band.loop is None and branches and band.pairs[0] not in beside:
            yield number


def _layers(drawn: Graph) -> tuple[int, ...]:
    """The longest way to each run in a graph without cycles; a band with a number is longer."""
    layers = [0] * len(drawn.runs)
    ways = [
        (*drawn.ends(band), 2 if number in drawn.numbered else 1)
        for number, band in enumerate(drawn.bands)
        if not band.back and not drawn.is_within(band)
    ]
    changed = True
    while changed:
        changed = False
        for source, target, step in ways:
            if layers[target] < layers[source] + step:
                layers[target] = layers[source] + step
                changed = True
    last = max(layers, default=0)
    givers = {source for source, *_ in ways}
    for node, own in drawn.ports.items():
        if drawn.place[node] not in givers and not all(port.enters for port in own):
            layers[drawn.place[node]] = last
    return tuple(layers)


def _losses(side: PowerFlow) -> dict[Node, float]:
    """Losses above rounding; the drag of a link leaves at the link itself."""
    least = NO_POWER * max((edge.power for edge in side.edges), default=0.0)
    by_node = side.losses.items()
    losses = {node: loss for node, loss in by_node if loss > least and node.kind != "drag"}
    for edge in side.forward:
        if edge.target.kind == "drag":
            losses[edge.source] = losses.get(edge.source, 0.0) + edge.power
    return losses
