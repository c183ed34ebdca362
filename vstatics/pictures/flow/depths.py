"""Vertical positions of runs (nodes in series), bands and ports, as depths below the top."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import accumulate, chain, pairwise
from typing import NamedTuple

from vstatics.pictures.drawing.labels import Span, spread
from vstatics.pictures.flow.columns import SPACE, FlowCell, Key, NodeColumns
from vstatics.pictures.flow.graph import EndPort, Graph
from vstatics.pictures.flow.order import Near, mean, neighbours, ordered

RUN_SWEEPS = 12
"""Number of passes that move the cells of all columns towards their neighbours."""

_Columns = Sequence[Mapping[Key, FlowCell]]


class Depths(NamedTuple):
    """Depths below the top of the picture [pt]."""

    middles: Mapping[Key, float]
    """Depth of the middle of each cell, by layer and number."""
    starts: Mapping[int, float]
    """Depth where each band leaves its source, by index of the band. Bands within a run are absent.
    """
    ends: Mapping[int, float]
    """Depth where each band reaches its target, by index of the band."""
    ports: Mapping[EndPort, float]
    """Depth of each input or output port."""


def depths(graph: Graph, scale: float, cells: NodeColumns, back: Sequence[int]) -> Depths:
    """Return depths of runs, bands and ports, chosen for few crossings and short bands.

    Parameters
    ----------
    back : sequence of int
        Indices of returning bands in the order of their rows, from the top.
    """
    by_key = {(layer, cell.number): cell for layer, key in enumerate(cells.cells) for cell in key}
    columns = [{key: by_key[key] for key in order} for order in ordered(graph, cells)]
    stacks = _stacked(graph, scale, cells, columns, back)
    shifts = neighbours(graph, cells, stacks.starts, stacks.ends)
    places = {key: 60.0 * row for column in columns for row, key in enumerate(column)}
    for sweep in range(RUN_SWEEPS):
        sides = shifts if sweep >= RUN_SWEEPS / 2 else shifts[sweep % 2 : sweep % 2 + 1]
        for column in columns if sweep % 2 == 0 else reversed(columns):
            wanted = [
                mean([pair for side in sides for pair in side.get(key, ())], places, key)
                + cell.lower
                for key, cell in column.items()
            ]
            sizes = [cell.above + cell.thick + cell.below + SPACE for cell in column.values()]
            spread_places = spread(_rising(wanted), sizes)
            for (key, cell), place in zip(column.items(), spread_places, strict=True):
                places[key] = place - cell.lower
    _straighten(columns, places, shifts)
    highest = min(places[key] - _over(cell) for key, cell in by_key.items())
    middles = {key: middle - highest for key, middle in places.items()}
    run = {number: middles[layer, number] for number, layer in enumerate(graph.layers)}
    return Depths(
        middles,
        {n: run[graph.ends(graph.bands[n])[0]] + by for n, by in stacks.starts.items()},
        {n: run[graph.ends(graph.bands[n])[1]] + by for n, by in stacks.ends.items()},
        {
            port: run[graph.place[link]] + stacks.ports[port]
            for link, key in graph.ports.items()
            for port in key
        },
    )


def _stacked(
    graph: Graph, scale: float, cells: NodeColumns, columns: _Columns, back: Sequence[int]
) -> Depths:
    """Return the depths of bands and ports relative to the middle of the run.

    From top to bottom, a run has its ports, its forward bands in the order of their targets, and
    its returning bands, the longest first.
    """
    ranks = {key: rank for column in columns for rank, key in enumerate(column)}
    numbers = [n for n, band in enumerate(graph.bands) if not graph.is_within(band)]
    ports: dict[EndPort, float] = {}
    sides: tuple[dict[int, float], dict[int, float]] = {}, {}
    for cell in (cell_ for column in columns for cell_ in column.values() if cell_.number >= 0):
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
    """Return increasing depths of the cells of a column, close to the wanted depths."""
    lower = reversed([*accumulate(reversed(wanted), min)])
    return [(high + low) / 2 for high, low in zip(accumulate(wanted, max), lower, strict=True)]


def _straighten(columns: _Columns, places: dict[Key, float], shifts: tuple[Near, Near]) -> None:
    """Make bands between cells in series horizontal where the columns have room."""
    for series in _series(columns, shifts):
        level: dict[Key, float] = {}
        low, high, deeper = -math.inf, math.inf, 0.0
        for key in series:
            deeper += shifts[0][key][0][2] if level else 0.0
            least, most = (end - deeper for end in _room(columns[key[0]], key, places))
            if level and max(low, least) > min(high, most):
                _set_level(level, places, low, high)
                level, low, high, deeper = {}, -math.inf, math.inf, 0.0
                least, most = _room(columns[key[0]], key, places)
            level[key] = deeper
            low, high = max(low, least), min(high, most)
        _set_level(level, places, low, high)


def _set_level(
    level: Mapping[Key, float], places: dict[Key, float], low: float, high: float
) -> None:
    wanted = sum(places[key] - deeper for key, deeper in level.items()) / len(level)
    for key, deeper in level.items():
        places[key] = min(max(wanted, low), high) + deeper


def _series(columns: _Columns, shifts: tuple[Near, Near]) -> Iterator[list[Key]]:
    """Yield chains of cells joined by single bands, from left to right."""
    before, after = (
        {key: {other_key for other_key, *_ in ends} for key, ends in side.items()}
        for side in shifts
    )
    following = {
        key: end
        for key, ends in after.items()
        for end in ends
        if len(ends) == len(before[end]) == 1
    }
    for key in chain.from_iterable(columns):
        if key not in following.values():
            series = [key]
            while series[-1] in following:
                series.append(following[series[-1]])
            yield series


def _room(column: Mapping[Key, FlowCell], key: Key, places: Mapping[Key, float]) -> Span:
    """Return the depths that are free for a cell between the neighbours in the column."""
    low, high = -math.inf, math.inf
    for above, below in pairwise(column):
        gap = _under(column[above]) + SPACE / 2 + _over(column[below])
        if below == key:
            low = places[above] + gap
        elif above == key:
            high = places[below] - gap
    return low, high


def _over(cell: FlowCell) -> float:
    return cell.thick / 2 + cell.above


def _under(cell: FlowCell) -> float:
    return cell.thick / 2 + cell.below
