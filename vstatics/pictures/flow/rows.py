"""Division of a power flow wider than the page into rows, cut where few bands cross."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from vstatics.core.flow.circulation import Node
from vstatics.pictures.drawing.labels import Span
from vstatics.pictures.drawing.pages import divided
from vstatics.pictures.flow.columns import PORT_ARROW, SPACE
from vstatics.pictures.flow.graph import EndPort, Graph
from vstatics.pictures.flow.places import FlowLayout

ELSEWHERE = Node("port", -1, "…")
"""Node that represents the other end of a band that continues in another row."""
COST_OF_CROSSING = 0.4
"""Cost of each cut band after the first, relative to the cost of a row. [-]"""
COST_OF_RAGGED = 0.1
"""Cost of very different widths of rows, relative to the cost of a row. [-]"""
NARROWER = 0.93
"""Factor by which the target width of rows is reduced after a row became too wide. [-]"""
TRIES_OF_ROWS = 6
"""Largest number of reductions of the target width."""


def rows(drawn: Graph, room: float, lay_out: Callable[[Graph], FlowLayout]) -> list[FlowLayout]:
    """Return the layout of each row of a graph, none wider than `room` [pt] if possible.

    Recirculating power is never cut.
    """
    whole = lay_out(drawn)
    layouts, wanted = [whole], room
    cuts = _cuts(drawn)
    for _ in range(TRIES_OF_ROWS if whole.width > room and cuts else 0):
        ends = _ends(_columns(whole), cuts, wanted)
        layouts = [lay_out(part) for part in parts(drawn, ends)]
        if max(row_layout.width for row_layout in layouts) <= room:
            break
        wanted *= NARROWER
    return layouts


def parts(drawn: Graph, ends: Sequence[int]) -> list[Graph]:
    """Return the parts of a graph cut after given layers. The last part ends with the last layer.

    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> from vstatics.core.flow.power import flows
    >>> from vstatics.pictures.flow.graph import graph
    >>> pairs = [Mechanism(1, 2, 0, -2.0, 0.9, name="one"), Mechanism(2, 3, 0, 4.0, name="other")]
    >>> [gear] = flows(solve(Transmission(3, [], pairs, [Gear()], output=3)))
    >>> [len(part.runs) for part in parts(graph(gear.lossy), [0, 2])]
    [1, 2]
    """
    row_of = {
        node: sum(drawn.layers[place] > end for end in ends) for node, place in drawn.place.items()
    }
    cut = [band for band in drawn.bands if row_of[band.source] != row_of[band.target]]
    stubs = [
        (at, EndPort(ELSEWHERE, band.power, enters, band))
        for band in cut
        for at, enters in ((band.source, False), (band.target, True))
    ]
    return [
        _part(drawn, {node for node, row in row_of.items() if row == row_number}, stubs)
        for row_number in range(len(ends))
    ]


def _cuts(drawn: Graph) -> dict[int, int]:
    """Return the number of bands to cut after each layer that is not within a loop."""
    by_layer = {}
    for layer in range(max(drawn.layers)):
        behind = [place > layer for place in drawn.layers]
        crossing = [
            band
            for band in drawn.bands
            if behind[drawn.place[band.source]] != behind[drawn.place[band.target]]
        ]
        if not any(band.back or band.loop is not None for band in crossing):
            by_layer[layer] = len(crossing)
    return by_layer


def _columns(whole: FlowLayout) -> list[Span]:
    run_boxes = [box for box in whole.boxes if box.cell.number >= 0]
    sides: list[Span] = []
    for layer in range(1 + max(whole.graph.layers)):
        boxes = [box for box in run_boxes if whole.graph.layers[box.cell.number] == layer]
        before = sides[-1][1] if sides else 0.0  # a layer without runs contains only passing bands
        left = min((box.middle - box.cell.wide / 2 for box in boxes), default=before)
        right = max((box.middle + box.cell.wide / 2 for box in boxes), default=before)
        sides.append((left, right))
    return sides


def _ends(columns: Sequence[Span], cuts: Mapping[int, int], room: float) -> list[int]:
    """Return the last layer of each row, for few rows, few cut bands and similar widths."""

    def cost(start: int, end: int) -> float:
        wide = columns[end - 1][1] - columns[start][0] + 2 * (PORT_ARROW + SPACE) * (start > 0)
        over = max(wide / room - 1, 0.0)  # a row of a single indivisible part can be wider
        crossing = COST_OF_CROSSING * (cuts.get(end - 1, 1) - 1)
        return 1 + 1000 * over + COST_OF_RAGGED * (wide / room) ** 2 + crossing

    ends = [*(last + 1 for last in cuts), len(columns)]
    return [row.stop - 1 for row in divided(ends, cost)]


def _part(drawn: Graph, nodes: set[Node], stubs: Sequence[tuple[Node, EndPort]]) -> Graph:
    """Return the part of a graph with the given nodes, with ports where bands are cut."""
    places = [place for place, run in enumerate(drawn.runs) if run[0] in nodes]
    first = min(drawn.layers[place] for place in places)
    numbers = [n for n, band in enumerate(drawn.bands) if {band.source, band.target} <= nodes]
    ports = {node: nodes_and_ways for node, nodes_and_ways in drawn.ports.items() if node in nodes}
    for node, port in stubs:
        if node in nodes:
            ports[node] = *ports.get(node, ()), port
    nodes_and_ways = nodes.union(*(drawn.bands[number].between for number in numbers))
    runs = tuple(drawn.runs[place] for place in places)
    return Graph(
        runs,
        tuple(drawn.layers[place] - first for place in places),
        {node: number for number, run in enumerate(runs) for node in run},
        tuple(drawn.bands[number] for number in numbers),
        ports,
        {node: lost for node, lost in drawn.losses.items() if node in nodes_and_ways},
        frozenset(at for at, number in enumerate(numbers) if number in drawn.numbered),
    )
