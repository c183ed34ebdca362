"""The order of runs and of passing bands in the columns of a picture of power."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import combinations, pairwise

from vstatics.pictures.drawing.groups import grouped
from vstatics.pictures.drawing.tolerances import SAME_CROSSINGS
from vstatics.pictures.flow.columns import Key, NodeColumns
from vstatics.pictures.flow.graph import Graph

COLUMN_ROUNDS = 4
"""Times that all columns are put in order."""

Near = Mapping[Key, Sequence[tuple[Key, float, float]]]
"""Neighbours of a cell, the power that they exchange with it, and how much deeper than them
it stands when the band between is level. [pt]"""


def ordered(graph: Graph, cells: NodeColumns) -> list[list[Key]]:
    """The columns in an order with few crossings; neighbours are exchanged as long as it helps."""
    near = neighbours(graph, cells, {}, {})
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


def neighbours(
    graph: Graph, cells: NodeColumns, starts: Mapping[int, float], ends: Mapping[int, float]
) -> tuple[Near, Near]:
    """Cells before each along bands, and those after it.

    Parameters
    ----------
    starts, ends : mapping of int to float
        How much deeper than the middle of its run each band is at its ends; else it is in it. [pt]
    """
    steps = []
    for number, way in cells.ways.items():
        power, last = graph.bands[number].power, len(way) - 2
        for place, (one, other) in enumerate(pairwise(way)):
            start = 0.0 if place else starts.get(number, 0.0)
            shift = start - (ends.get(number, 0.0) if place == last else 0.0)
            steps.append((one, other, power, shift))
    before = grouped((other, (one, power, shift)) for one, other, power, shift in steps)
    return before, grouped((one, (other, power, -shift)) for one, other, power, shift in steps)


def mean(near: Sequence[tuple[Key, float, float]], places: Mapping[Key, float], own: Key) -> float:
    """Where bands to neighbours are level, by their power; without any its own place."""
    weight = sum(power for _, power, _ in near)
    level = sum((places[one] + shift) * power for one, power, shift in near)
    return level / weight if weight else places[own]


def _settle(columns: list[list[Key]], near: tuple[Near, Near], turn: int) -> None:
    """Put every column in the order of its neighbours, before it or after it by turns."""
    side = near[turn % 2]
    for place in range(len(columns)) if turn % 2 == 0 else reversed(range(len(columns))):
        ranks = {own: float(rank) for column in columns for rank, own in enumerate(column)}
        means = {own: mean(side.get(own, ()), ranks, own) for own in columns[place]}
        columns[place].sort(key=means.__getitem__)


def _exchanged(
    columns: list[list[Key]], after: Near, graph: Graph
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


def _crossings(columns: Sequence[Sequence[Key]], after: Near, graph: Graph) -> float:
    """Of each two bands that cross the product of powers; what goes back crosses all below."""
    ranks = {own: rank for column in columns for rank, own in enumerate(column)}
    total = 0.0
    for column in columns:
        bands = [
            (ranks[own], ranks[other], power)
            for own in column
            for other, power, _ in after.get(own, ())
        ]
        for (start, end, power), (first, last, another) in combinations(bands, 2):
            if (start - first) * (end - last) < 0:
                total += power * another
        for band in graph.bands:
            ends = graph.ends(band) if band.back else ()
            for rank in (ranks[own] for own in column if own[1] in ends):
                total += band.power * sum(power for start, _, power in bands if start > rank)
    return total
