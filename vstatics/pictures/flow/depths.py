"""How deep runs, bands and ports stand in a picture of power."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import accumulate
from typing import NamedTuple

from vstatics.pictures.drawing.labels import Span, spread
from vstatics.pictures.flow.columns import SPACE, FlowCell, Key, NodeColumns
from vstatics.pictures.flow.graph import EndPort, Graph
from vstatics.pictures.flow.order import Near, mean, neighbours, ordered

RUN_SWEEPS = 12
"""Times that runs are moved towards their neighbours."""

_Columns = Sequence[Mapping[Key, FlowCell]]


class Depths(NamedTuple):
    """How deep everything is, from the top of the picture [pt]."""

    middles: Mapping[Key, float]
    """Of cells."""
    starts: Mapping[int, float]
    """Of each band between runs, at its source."""
    ends: Mapping[int, float]
    """At its target."""
    ports: Mapping[EndPort, float]


def depths(graph: Graph, scale: float, cells: NodeColumns, back: Sequence[int]) -> Depths:
    """Few bands cross, neighbours are near to one another.

    Parameters
    ----------
    back : sequence of int
        Bands that go back, in the order of their rows.
    """
    by_key = {(layer, one.number): one for layer, own in enumerate(cells.cells) for one in own}
    columns = [{own: by_key[own] for own in order} for order in ordered(graph, cells)]
    stacks = _stacked(graph, scale, cells, columns, back)
    shifts = neighbours(graph, cells, stacks.starts, stacks.ends)
    places = {own: 60.0 * row for column in columns for row, own in enumerate(column)}
    heights = [
        (
            {own: one.lower for own, one in column.items()},
            [one.above + one.thick + one.below + SPACE for one in column.values()],
        )
        for column in columns
    ]
    for sweep in range(RUN_SWEEPS):
        sides = shifts if sweep >= RUN_SWEEPS / 2 else shifts[sweep % 2 : sweep % 2 + 1]
        for lowered, sizes in heights if sweep % 2 == 0 else reversed(heights):
            wanted = [
                mean([pair for side in sides for pair in side.get(own, ())], places, own) + lower
                for own, lower in lowered.items()
            ]
            found = spread(_rising(wanted), sizes)
            for (own, lower), place in zip(lowered.items(), found, strict=True):
                places[own] = place - lower
    _straighten(columns, places, shifts)
    highest = min(places[own] - _over(one) for own, one in by_key.items())
    middles = {own: middle - highest for own, middle in places.items()}
    run = {number: middles[layer, number] for number, layer in enumerate(graph.layers)}
    return Depths(
        middles,
        {n: run[graph.ends(graph.bands[n])[0]] + by for n, by in stacks.starts.items()},
        {n: run[graph.ends(graph.bands[n])[1]] + by for n, by in stacks.ends.items()},
        {
            port: run[graph.place[link]] + stacks.ports[port]
            for link, own in graph.ports.items()
            for port in own
        },
    )


def _stacked(
    graph: Graph, scale: float, cells: NodeColumns, columns: _Columns, back: Sequence[int]
) -> Depths:
    """The same from the middle of each run.

    At a run bands stand in the order of where they lead, below its ports; what goes back
    is lowest, that which goes farther above the others.
    """
    ranks = {own: rank for column in columns for rank, own in enumerate(column)}
    numbers = [n for n, band in enumerate(graph.bands) if not graph.is_within(band)]
    ports: dict[EndPort, float] = {}
    sides: tuple[dict[int, float], dict[int, float]] = {}, {}
    for cell in (one for column in columns for one in column.values() if one.number >= 0):
        for end, places in enumerate(sides):
            deep = -cell.thick / 2
            for port in graph.ports.get(cell.run[-1 if end == 0 else 0], ()):
                if port.enters == bool(end):
                    ports[port] = deep + port.power * scale / 2
                    deep += port.power * scale
            order = []
            for n in (n for n in numbers if graph.ends(graph.bands[n])[end] == cell.number):
                way = cells.ways.get(n)
                rank = math.inf if way is None else ranks[way[-2 if end else 1]]
                order.append((rank, -back.index(n) if way is None else 0, n))
            for *_, n in sorted(order):
                thick = graph.bands[n].power * scale
                places[n] = deep + thick / 2
                deep += thick
    return Depths({}, *sides, ports)


def _rising(wanted: Sequence[float]) -> list[float]:
    """Places near to those wanted that keep the order of the column."""
    lower = reversed([*accumulate(reversed(wanted), min)])
    return [(high + low) / 2 for high, low in zip(accumulate(wanted, max), lower, strict=True)]


def _straighten(columns: _Columns, places: dict[Key, float], shifts: tuple[Near, Near]) -> None:
    """Make bands between cells in series level, as far as their columns have room for it."""
    for series in _series(columns, shifts):
        level: dict[Key, float] = {}
        low, high, deeper = -math.inf, math.inf, 0.0
        for own in series:
            deeper += shifts[0][own][0][2] if level else 0.0
            least, most = (end - deeper for end in _room(columns[own[0]], own, places))
            if level and max(low, least) > min(high, most):
                _set_level(level, places, low, high)
                level, low, high, deeper = {}, -math.inf, math.inf, 0.0
                least, most = _room(columns[own[0]], own, places)
            level[own] = deeper
            low, high = max(low, least), min(high, most)
        _set_level(level, places, low, high)


def _set_level(
    level: Mapping[Key, float], places: dict[Key, float], low: float, high: float
) -> None:
    wanted = sum(places[own] - deeper for own, deeper in level.items()) / len(level)
    for own, deeper in level.items():
        places[own] = min(max(wanted, low), high) + deeper


def _series(columns: _Columns, shifts: tuple[Near, Near]) -> Iterator[list[Key]]:
    """Cells each of which is the only neighbour of the next, from left to right."""
    before, after = (
        {own: {one for one, *_ in ends} for own, ends in side.items()} for side in shifts
    )
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


def _room(column: Mapping[Key, FlowCell], own: Key, places: Mapping[Key, float]) -> Span:
    """Between which depths a cell may stand."""
    order = list(column)
    rank, cell = order.index(own), column[own]
    above, below = order[max(rank - 1, 0) : rank], order[rank + 1 : rank + 2]
    low = [places[one] + _under(column[one]) + SPACE / 2 + _over(cell) for one in above]
    high = [places[one] - _over(column[one]) - SPACE / 2 - _under(cell) for one in below]
    return max(low, default=-math.inf), min(high, default=math.inf)


def _over(cell: FlowCell) -> float:
    """How far a cell reaches above its middle."""
    return cell.thick / 2 + cell.above


def _under(cell: FlowCell) -> float:
    return cell.thick / 2 + cell.below
