"""Graph of a power flow: nodes joined by bands that run forward or return to the left."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple

from vstatics.core.flow.circulation import Edge, Loop, Node
from vstatics.core.flow.power_flow import PowerFlow
from vstatics.core.numerics.tolerances import NO_POWER

AT_LINKS = ("drag", "gear")
"""Kinds of losses drawn at a link: the drag on the link, and a loss of the whole gear."""

Run = tuple[Node, ...]
"""Nodes in series with equal power, without losses or branches in between."""


class Band(NamedTuple):
    """Band of power from a source node to a target node."""

    source: Node
    target: Node
    power: float
    """Power relative to the input power. [-]"""
    loop: int | None = None
    """Index of the loop of recirculating power that contains the band, if any."""
    back: bool = False
    """True for a returning band, which is drawn from right to left."""
    between: Run = ()
    """Nodes along a returning band, which transmit only the recirculating power of the loop."""

    @property
    def pairs(self) -> tuple[tuple[Node, Node], ...]:
        """Pairs of neighbouring nodes along the band."""
        return tuple(pairwise((self.source, *self.between, self.target)))


class EndPort(NamedTuple):
    """Link where power enters or leaves the gear, or the row in which the gear is drawn."""

    node: Node
    power: float
    """Power relative to the input power. [-]"""
    enters: bool
    cut: Band | None = None
    """Band that continues in another row from this port; None for a port of the gear."""


class Graph(NamedTuple):
    """Power flow of a gear as drawn: runs, bands, ports and losses."""

    runs: tuple[Run, ...]
    """Runs, which contain all nodes except the nodes along returning bands."""
    layers: tuple[int, ...]
    """Layer of each run: the column number, from 0 on the left."""
    place: Mapping[Node, int]
    """Index of the run that contains each node."""
    bands: tuple[Band, ...]
    ports: Mapping[Node, tuple[EndPort, ...]]
    """Ports of each link that has ports."""
    losses: Mapping[Node, float]
    """Loss of each node relative to the input power, including the drag of a link. [-]"""
    numbered: frozenset[int]
    """Indices of bands with a written power, which does not follow from nodes and loops."""

    def ends(self, band: Band) -> tuple[int, int]:
        """Return the indices of the runs at the source and target of a band."""
        return self.place[band.source], self.place[band.target]

    def is_within(self, band: Band) -> bool:
        """Return whether both ends of a band are in a common run."""
        return not band.back and self.place[band.source] == self.place[band.target]

    def through(self, node: Node) -> float:
        """Return the drawn power through a node, relative to the input power [-]."""
        ports_here = self.ports.get(node, ())
        entering = [band.power for band in self.bands if band.target == node]
        entering += [port.power for port in ports_here if port.enters]
        leaving = [band.power for band in self.bands if band.source == node]
        leaving += [port.power for port in ports_here if not port.enters]
        on_way = math.fsum(band.power for band in self.bands if node in band.between)
        lost = self.losses.get(node, 0.0)
        return on_way + max(math.fsum(entering), math.fsum(leaving) + lost)


def graph(side: PowerFlow) -> Graph:
    """Return the graph of the power flow of a gear.

    A run is to the right of all runs from which it receives power, and outputs are in the last
    layer. Bands of a loop run from left to right unless they would close a cycle; then they return
    to the left.

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
    edges = [edge for edge in side.forward if edge.target.kind not in AT_LINKS]
    ports = _ports(edges)
    edges = [edge for edge in edges if "port" not in (edge.source.kind, edge.target.kind)]
    known = dict.fromkeys([*ports, *(node for edge in edges for node in edge[:2])])
    pieces = [
        (number, piece) for number, loop in enumerate(side.loops) for piece in _cut(loop, known)
    ]
    pairs = [(edge.source, edge.target) for edge in edges]
    bands = [Band(*edge) for edge in edges]
    for number, piece in pieces:  # a piece that does not close a cycle is drawn from left to right
        power = side.loops[number].power
        if piece[0] in _reachable(piece[-1], pairs):
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
    by_link: dict[Node, tuple[EndPort, ...]] = {}
    for source, target, power in edges:
        for port, link in ((source, target), (target, source)):
            if port.kind == "port":
                by_link[link] = *by_link.get(link, ()), EndPort(port, power, port is source)
    return by_link


def _cut(loop: Loop, known: Iterable[Node]) -> Iterator[Sequence[Node]]:
    """Yield the pieces into which the `known` nodes, which transmit further power, cut a loop."""
    others = set(known)
    places = [place for place, node in enumerate(loop.nodes) if node in others] or [0]
    twice = loop.nodes * 2
    for start, end in zip(places, [*places[1:], places[0] + len(loop.nodes)], strict=True):
        yield twice[start : end + 1]


def _reachable(start: Node, pairs: Sequence[tuple[Node, Node]]) -> set[Node]:
    reached, ahead = {start}, [start]
    while ahead:
        node = ahead.pop()
        fresh = {target for source, target in pairs if source == node} - reached
        reached |= fresh
        ahead += fresh
    return reached


def _runs(nodes: Iterable[Node], drawn: Graph) -> Iterator[Run]:
    pairs = {(band.source, band.target) for band in drawn.bands}
    leaving, arriving = (Counter(pair[end] for pair in pairs) for end in (0, 1))
    least = NO_POWER * max((band.power for band in drawn.bands), default=0.0)
    behind: dict[Node, Node] = {}
    for source, target in ((band.source, band.target) for band in drawn.bands if not band.back):
        branch = leaving[source] > 1 or arriving[target] > 1
        branch |= any(not port.enters for port in drawn.ports.get(source, ()))
        branch |= any(port.enters for port in drawn.ports.get(target, ()))
        alike = abs(drawn.through(source) - drawn.through(target)) <= least
        if alike and not branch and not {source, target} & drawn.losses.keys():
            behind[source] = target
    for node in nodes:
        if node not in behind.values():
            run = [node]
            while run[-1] in behind:
                run.append(behind[run[-1]])
            yield tuple(run)


def _numbered(drawn: Graph) -> Iterator[int]:
    """Yield the indices of bands whose power must be written.

    They lead from a run with several exits to a run with several entries. Bands next to a loop are
    left out: their power is the power of the node minus the power of the loop.
    """
    forth = [(n, b) for n, b in enumerate(drawn.bands) if not drawn.is_within(b)]
    sources = [drawn.ends(band)[0] for _, band in forth]
    targets = [drawn.ends(band)[1] for _, band in forth]
    for node, ports_of_node in drawn.ports.items():
        sources += [drawn.place[node] for port in ports_of_node if not port.enters]
        targets += [drawn.place[node] for port in ports_of_node if port.enters]
    next_to_loops = {pair for band in drawn.bands if band.loop is not None for pair in band.pairs}
    for number, band in forth:
        source, target = drawn.ends(band)
        branches = sources.count(source) > 1 and targets.count(target) > 1
        if band.loop is None and branches and band.pairs[0] not in next_to_loops:
            yield number


def _layers(drawn: Graph) -> tuple[int, ...]:
    """Return the layer of each run, to the right of its sources. Outputs are in the last layer."""
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
    for node, ports_of_node in drawn.ports.items():
        if drawn.place[node] not in givers and not all(port.enters for port in ports_of_node):
            layers[drawn.place[node]] = last
    return tuple(layers)


def _losses(side: PowerFlow) -> dict[Node, float]:
    """Return the losses above rounding noise, by node. Losses of `AT_LINKS` belong to the link."""
    least = NO_POWER * max((edge.power for edge in side.edges), default=0.0)
    by_node = side.losses.items()
    losses = {n: loss for n, loss in by_node if loss > least and n.kind not in AT_LINKS}
    for edge in side.forward:
        if edge.target.kind in AT_LINKS:
            losses[edge.source] = losses.get(edge.source, 0.0) + edge.power
    return losses
