"""Vertical order of runs (nodes in series) and passing bands in the columns of a power flow."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import combinations, pairwise

from vstatics.core.groups import grouped
from vstatics.pictures.drawing.tolerances import SAME_CROSSINGS
from vstatics.pictures.flow.columns import Key, NodeColumns
from vstatics.pictures.flow.graph import Graph

COLUMN_ROUNDS = 4
"""Number of times that all columns are sorted, from each of two initial orders."""

Near = Mapping[Key, Sequence[tuple[Key, float, float]]]
"""Neighbours of each cell, each with the exchanged power [-] and a depth difference [pt].

The band between cell and neighbour is horizontal if the cell is lower by this difference.
"""


def ordered(graph: Graph, cells: NodeColumns) -> list[list[Key]]:
    """Return the cells of each column in an order with few crossing bands."""
    near = neighbours(graph, cells, {}, {})
    columns = [
        [(layer, cell.number) for cell in column_cells]
        for layer, column_cells in enumerate(cells.cells)
    ]
    looped = {end for band in graph.bands if band.loop is not None for end in graph.ends(band)}
    orders = [list(column) for column in columns]
    lower = [
        sorted(column, key=lambda column_cells: column_cells[1] in looped) for column in orders
    ]
    best, least = lower, math.inf
    for turn, start in enumerate([lower, orders] * COLUMN_ROUNDS):
        candidate, crossings = _exchanged(start, near[1], graph)
        if crossings < least * SAME_CROSSINGS:
            best, least = candidate, crossings
        _settle(start, near, turn // 2)
    return best


def neighbours(
    graph: Graph, cells: NodeColumns, starts: Mapping[int, float], ends: Mapping[int, float]
) -> tuple[Near, Near]:
    """Return the neighbours of each cell to the left, and to the right.

    Parameters
    ----------
    starts, ends : mapping of int to float
        Depth of each band at its ends, relative to the middle of the run, by default 0. [pt]
    """
    steps = []
    for number, way in cells.ways.items():
        power, last = graph.bands[number].power, len(way) - 2
        for place, (source, target) in enumerate(pairwise(way)):
            start = 0.0 if place else starts.get(number, 0.0)
            shift = start - (ends.get(number, 0.0) if place == last else 0.0)
            steps.append((source, target, power, shift))
    before = grouped((target, (source, power, shift)) for source, target, power, shift in steps)
    return before, grouped(
        (source, (target, power, -shift)) for source, target, power, shift in steps
    )


def mean(near: Sequence[tuple[Key, float, float]], places: Mapping[Key, float], cell: Key) -> float:
    """Return the mean, weighted by power, of the depths at which each band of a cell is horizontal.

    A cell without neighbours keeps its depth.
    """
    weight = sum(power for _, power, _ in near)
    level = sum((places[key] + shift) * power for key, power, shift in near)
    return level / weight if weight else places[cell]


def _settle(columns: list[list[Key]], near: tuple[Near, Near], turn: int) -> None:
    """Sort each column by the mean position of the neighbours on the left, or on the right."""
    side = near[turn % 2]
    for place in range(len(columns)) if turn % 2 == 0 else reversed(range(len(columns))):
        ranks = {key: float(rank) for column in columns for rank, key in enumerate(column)}
        means = {key: mean(side.get(key, ()), ranks, key) for key in columns[place]}
        columns[place].sort(key=means.__getitem__)


def _exchanged(
    columns: list[list[Key]], after: Near, graph: Graph
) -> tuple[list[list[Key]], float]:
    """Swap neighbouring cells while crossings decrease; return the columns and the crossings."""
    places = [
        (number, rank) for number, column_ in enumerate(columns) for rank in range(len(column_) - 1)
    ]
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


def _crossings(columns: Sequence[Sequence[Key]], after: Near, graph: Graph) -> float:
    """Return the sum, over all crossings of bands, of the product of both powers.

    A returning band crosses all bands below its ends.
    """
    ranks = {key: rank for column in columns for rank, key in enumerate(column)}
    total = 0.0
    for column in columns:
        bands = [
            (ranks[key], ranks[target], power)
            for key in column
            for target, power, _ in after.get(key, ())
        ]
        for (start, end, power), (first, last, another) in combinations(bands, 2):
            if (start - first) * (end - last) < 0:
                total += power * another
        for band in graph.bands:
            ends = graph.ends(band) if band.back else ()
            for rank in (ranks[key] for key in column if key[1] in ends):
                total += band.power * sum(power for start, _, power in bands if start > rank)
    return total
