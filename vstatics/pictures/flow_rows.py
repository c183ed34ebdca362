"""The order of nodes in the columns of a picture of power, and how deep each stands."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import combinations, pairwise

from vstatics.pictures.flow_columns import SPACE, FlowCell, Key, NodeColumns, key
from vstatics.pictures.flow_graph import Graph
from vstatics.pictures.labels import spread

SWEEPS = 12
"""Times that nodes are moved towards their neighbours."""
ROUNDS = 4
"""Times that all columns are put in order."""
BETTER = 1 - 1e-9
"""An order must be so much better than another."""

_Near = Mapping[Key, Sequence[tuple[Key, float]]]
"""Neighbours of a cell, with the power that they exchange with it."""


def tops(graph: Graph, cells: NodeColumns) -> dict[Key, float]:
    """How deep each cell stands: few bands cross, neighbours are near to one another.

    Returns
    -------
    dict
        From the top of the picture to the top of the band or node. [pt]
    """
    near = _neighbours(graph, cells)
    keyed = [{key(layer, one): one for one in own} for layer, own in enumerate(cells.cells)]
    columns = _ordered(keyed, near, graph)
    places = {own: 60.0 * row for column in columns for row, own in enumerate(column)}
    for sweep in range(SWEEPS):
        sides = near if sweep >= SWEEPS / 2 else near[sweep % 2 : sweep % 2 + 1]
        for column in columns if sweep % 2 == 0 else reversed(columns):
            wanted = [
                _mean([pair for side in sides for pair in side.get(own, ())], places, own)
                + one.lower
                for own, one in column.items()
            ]
            sizes = [one.above + one.thick + one.below + SPACE for one in column.values()]
            found = spread(_rising(wanted), sizes)
            for (own, one), place in zip(column.items(), found, strict=True):
                places[own] = place - one.lower
    deep = {own: places[own] - one.thick / 2 for column in columns for own, one in column.items()}
    highest = min(deep[own] - one.above for column in columns for own, one in column.items())
    return {own: top - highest for own, top in deep.items()}


def _neighbours(graph: Graph, cells: NodeColumns) -> tuple[_Near, _Near]:
    """Cells before each along bands, and those after it."""
    before: dict[Key, list[tuple[Key, float]]] = {}
    after: dict[Key, list[tuple[Key, float]]] = {}
    for number, way in cells.ways.items():
        band = graph.bands[number]
        keys = [key(layer, one) for layer, one in enumerate(way, graph.layers[band.source])]
        for one, other in pairwise(keys):
            before.setdefault(other, []).append((one, band.power))
            after.setdefault(one, []).append((other, band.power))
    return before, after


def _mean(near: Sequence[tuple[Key, float]], places: Mapping[Key, float], own: Key) -> float:
    """The place of neighbours, by their power; without any its own."""
    weight = sum(power for _, power in near)
    return sum(places[one] * power for one, power in near) / weight if weight else places[own]


def _rising(wanted: Sequence[float]) -> list[float]:
    """Places near to those wanted that keep the order of the column."""
    upper = [max(wanted[: place + 1]) for place in range(len(wanted))]
    lower = [min(wanted[place:]) for place in range(len(wanted))]
    return [(high + low) / 2 for high, low in zip(upper, lower, strict=True)]


def _ordered(
    columns: list[dict[Key, FlowCell]], near: tuple[_Near, _Near], graph: Graph
) -> list[dict[Key, FlowCell]]:
    """The columns in an order with few crossings; neighbours are exchanged as long as it helps."""
    looped = {node for band in graph.bands if band.loop is not None for node in band.pairs[0]}
    orders = [list(column) for column in columns]
    lower = [sorted(column, key=lambda own: own[1] in looped) for column in orders]
    best, least = orders, math.inf
    for turn, start in enumerate([orders, lower] * ROUNDS):
        found, crossings = _exchanged(start, near[1], graph)
        if crossings < least * BETTER:
            best, least = found, crossings
        _settle(start, near, turn // 2)
    return [
        {own: column[own] for own in order} for order, column in zip(best, columns, strict=True)
    ]


def _settle(columns: list[list[Key]], near: tuple[_Near, _Near], turn: int) -> None:
    """Put every column in the order of its neighbours, before it or after it by turns."""
    side = near[turn % 2]
    for place in range(len(columns)) if turn % 2 == 0 else reversed(range(len(columns))):
        ranks = {own: float(rank) for column in columns for rank, own in enumerate(column)}
        means = {own: _mean(side.get(own, ()), ranks, own) for own in columns[place]}
        columns[place].sort(key=means.__getitem__)


def _exchanged(
    columns: list[list[Key]], after: _Near, graph: Graph
) -> tuple[list[list[Key]], float]:
    """The same with neighbours exchanged wherever this saves crossings, and these."""
    places = [(number, rank) for number, one in enumerate(columns) for rank in range(len(one) - 1)]
    least, before = _crossings(columns, after, graph), math.inf
    while least < before * BETTER:
        before = least
        for number, rank in places:
            column = columns[number]
            swapped = [*column[:rank], column[rank + 1], column[rank], *column[rank + 2 :]]
            tried = [*columns[:number], swapped, *columns[number + 1 :]]
            crossings = _crossings(tried, after, graph)
            if crossings < least * BETTER:
                columns, least = tried, crossings
    return [list(column) for column in columns], least


def _crossings(columns: Sequence[Sequence[Key]], after: _Near, graph: Graph) -> float:
    """Of each two bands that cross the product of powers; what goes back crosses all below."""
    ranks = {own: rank for column in columns for rank, own in enumerate(column)}
    total = 0.0
    for column in columns:
        bands = [
            (ranks[own], ranks[other], power)
            for own in column
            for other, power in after.get(own, ())
        ]
        for (start, end, power), (first, last, another) in combinations(bands, 2):
            if (start - first) * (end - last) < 0:
                total += power * another
        for band in graph.bands:
            ends = (band.source, band.target) if band.back else ()
            for rank in (ranks[own] for own in column if own[1] in ends):
                total += band.power * sum(power for start, _, power in bands if start > rank)
    return total
