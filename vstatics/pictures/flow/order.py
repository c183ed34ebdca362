"""The order of runs and of passing bands in the columns of a picture of power."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import combinations, pairwise

from vstatics.pictures.flow.columns import Key, NodeColumns
from vstatics.pictures.flow.graph import Graph
from vstatics.pictures.sheet.tolerances import SAME_CROSSINGS

COLUMN_ROUNDS = 4
"""Times that all columns are put in order."""

_Near = Mapping[Key, Sequence[tuple[Key, float]]]
"""Neighbours of a cell, with the power that they exchange with it."""


def ordered(graph: Graph, cells: NodeColumns) -> list[list[Key]]:
    """The columns in an order with few crossings; neighbours are exchanged as long as it helps."""
    near = _neighbours(graph, cells)
    columns = [[(layer, one.number) for one in own] for layer, own in enumerate(cells.cells)]
    looped = {end for band in graph.bands if band.loop is not None for end in graph.ends(band)}
    orders = [list(column) for column in columns]
    lower = [sorted(column, key=lambda own: own[1] in looped) for column in orders]
    best, least = lower, math.inf
    for turn, start in enumerate([lower, orders] * COLUMN_ROUNDS):
        found, crossings = _exchanged(start, near[1], graph)
        if crossings < least * SAME_CROSSINGS:
            best, least = found, crossings
        _settle(start, near, turn // 2)
    return best


def _neighbours(graph: Graph, cells: NodeColumns) -> tuple[_Near, _Near]:
    """Cells before each along bands, and those after it."""
    before: dict[Key, list[tuple[Key, float]]] = {}
    after: dict[Key, list[tuple[Key, float]]] = {}
    for number, way in cells.ways.items():
        band = graph.bands[number]
        for one, other in pairwise(way):
            before.setdefault(other, []).append((one, band.power))
            after.setdefault(one, []).append((other, band.power))
    return before, after


def _mean(near: Sequence[tuple[Key, float]], places: Mapping[Key, float], own: Key) -> float:
    """The place of neighbours, by their power; without any its own."""
    weight = sum(power for _, power in near)
    return sum(places[one] * power for one, power in near) / weight if weight else places[own]


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
    while least < before * SAME_CROSSINGS:
        before = least
        for number, rank in places:
            column = columns[number]
            swapped = [*column[:rank], column[rank + 1], column[rank], *column[rank + 2 :]]
            tried = [*columns[:number], swapped, *columns[number + 1 :]]
            crossings = _crossings(tried, after, graph)
            if crossings < least * SAME_CROSSINGS:
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
            ends = graph.ends(band) if band.back else ()
            for rank in (ranks[own] for own in column if own[1] in ends):
                total += band.power * sum(power for start, _, power in bands if start > rank)
    return total
