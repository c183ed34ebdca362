"""The order of nodes in the columns of a picture of power, and how deep each stands."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations, pairwise

from vstatics.pictures.flow_columns import SPACE, FlowCell, Key, NodeColumns
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


def middles(graph: Graph, cells: NodeColumns) -> dict[Key, float]:
    """How deep each cell stands: few bands cross, neighbours are near to one another.

    Returns
    -------
    dict
        From the top of the picture to the middle of the band or node. [pt]
    """
    near = _neighbours(graph, cells)
    keyed = [{(layer, one.number): one for one in own} for layer, own in enumerate(cells.cells)]
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
    _straighten(columns, places, near)
    highest = min(
        places[own] - one.thick / 2 - one.above for column in columns for own, one in column.items()
    )
    return {own: middle - highest for own, middle in places.items()}


def _straighten(
    columns: Sequence[Mapping[Key, FlowCell]], places: dict[Key, float], near: tuple[_Near, _Near]
) -> None:
    """Put cells in series at one depth, as far as their columns have room for it."""
    for series in _series(columns, near):
        level: list[Key] = []
        low, high = -math.inf, math.inf
        for own in [*series, None]:
            least, most = (0.0, 0.0) if own is None else _room(columns[own[0]], own, places)
            if own is None or max(low, least) > min(high, most):
                wanted = sum(places[one] for one in level) / (len(level) or 1)
                places.update(dict.fromkeys(level, min(max(wanted, low), high)))
                level, low, high = [], -math.inf, math.inf
            if own is not None:
                level.append(own)
                low, high = max(low, least), min(high, most)


def _series(
    columns: Sequence[Mapping[Key, FlowCell]], near: tuple[_Near, _Near]
) -> Iterator[list[Key]]:
    """Cells each of which is the only neighbour of the next, from left to right."""
    before, after = ({own: {one for one, _ in ends} for own, ends in side.items()} for side in near)
    following = {
        own: next(iter(ends))
        for own, ends in after.items()
        if len(ends) == 1 and len(before[next(iter(ends))]) == 1
    }
    for own in (one for column in columns for one in column if one not in following.values()):
        series = [own]
        while series[-1] in following:
            series.append(following[series[-1]])
        yield series


def _room(
    column: Mapping[Key, FlowCell], own: Key, places: Mapping[Key, float]
) -> tuple[float, float]:
    """Between which depths a cell may stand."""
    order = list(column)
    rank, cell = order.index(own), column[own]
    above, below = order[max(rank - 1, 0) : rank], order[rank + 1 : rank + 2]
    low = [places[one] + _under(column[one]) + SPACE + _over(cell) for one in above]
    high = [places[one] - _over(column[one]) - SPACE - _under(cell) for one in below]
    return max(low, default=-math.inf), min(high, default=math.inf)


def _over(cell: FlowCell) -> float:
    """How far a cell reaches above its middle."""
    return cell.thick / 2 + cell.above


def _under(cell: FlowCell) -> float:
    return cell.thick / 2 + cell.below


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


def _rising(wanted: Sequence[float]) -> list[float]:
    """Places near to those wanted that keep the order of the column."""
    upper = [max(wanted[: place + 1]) for place in range(len(wanted))]
    lower = [min(wanted[place:]) for place in range(len(wanted))]
    return [(high + low) / 2 for high, low in zip(upper, lower, strict=True)]


def _ordered(
    columns: list[dict[Key, FlowCell]], near: tuple[_Near, _Near], graph: Graph
) -> list[dict[Key, FlowCell]]:
    """The columns in an order with few crossings; neighbours are exchanged as long as it helps."""
    looped = {end for band in graph.bands if band.loop is not None for end in graph.ends(band)}
    orders = [list(column) for column in columns]
    lower = [sorted(column, key=lambda own: own[1] in looped) for column in orders]
    best, least = lower, math.inf
    for turn, start in enumerate([lower, orders] * ROUNDS):
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
            ends = graph.ends(band) if band.back else ()
            for rank in (ranks[own] for own in column if own[1] in ends):
                total += band.power * sum(power for start, _, power in bands if start > rank)
    return total
