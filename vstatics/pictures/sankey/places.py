"""Where the nodes, bands and texts of a picture of power stand."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from vstatics.pictures.labels import height, spread, width
from vstatics.pictures.sankey.bands import Box, Line, Placed, back, forward, place, slots
from vstatics.pictures.sankey.columns import SPACE, Words, across, cell, columns
from vstatics.pictures.sankey.graph import Band, Graph

UNDER = 3.0
"""Between a band and its text, and between texts. [pt]"""
HARDLY = 4.0
"""A band below this width hardly shows beside another. [pt]"""


class Note(NamedTuple):
    """A text on a band or a loop, by its middle."""

    x: float
    y: float
    text: str
    loop: bool


class Layout(NamedTuple):
    """The picture of a gear."""

    width: float
    """[pt]"""
    height: float
    """[pt]"""
    boxes: tuple[Box, ...]
    lines: tuple[Line, ...]
    notes: tuple[Note, ...]


def layout(graph: Graph, scale: float, words: Words) -> Layout:
    """Places of all that is drawn of a gear.

    Parameters
    ----------
    graph : Graph
    scale : float
        Width of a band of power 1. [pt]
    words : Words

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> from vstatics.flow.power import flows
    >>> from vstatics.pictures.sankey.graph import graph
    >>> pair = Mechanism(1, 2, 0, -4.0, 0.98, name="pair")
    >>> [gear] = flows(solve(Transmission(2, [], [pair], [Gear()])))
    >>> made = layout(graph(gear.lossy), 100.0, Words(lambda node, power: str(node), str, str))
    >>> [(str(one.cell.node), round(one.cell.thick), round(one.cell.loss)) for one in made.boxes]
    [('input', 100, 0), ('1', 100, 0), ('pair', 100, 2), ('2', 98, 0), ('output', 98, 0)]
    """
    cells = columns(graph, scale, words)
    told = _told(graph, scale, words)
    on_way = {
        number: [cell(graph, node, band.power, scale, words) for node in band.between]
        for number, band in _returns(graph)
    }
    needed = {number: sum(one.wide + SPACE for one in found) for number, found in on_way.items()}
    placed = place(graph, scale, cells, across(graph, cells, told, needed, scale))
    ends = slots(placed)
    lines = [
        Line(graph.bands[number], graph.bands[number].power * scale, points)
        for number, points in forward(placed, ends)
    ]
    notes = _on_bands(placed, told, lines)
    boxes = list(placed.boxes.values())
    low = max(box.bottom + box.cell.below for box in boxes)
    low = max([low, *(y + line.width / 2 for line in lines for _, y in line.points)])
    named: set[int | None] = set()
    for number, passed in on_way.items():
        top = low + SPACE / 2 + max((one.above for one in passed), default=0.0)
        row, line = back(placed, number, ends[number], passed, top)
        boxes += row
        lines.append(line)
        low = max(y for _, y in line.points) + line.width / 2
        if line.band.loop not in named:
            named.add(line.band.loop)
            text = words.loop(line.band.power)
            middle = (placed.spaced.leaving[number] + placed.spaced.arriving[number]) / 2
            low += height(text) + UNDER
            x = max(middle, width(text) / 2)
            notes.append(Note(x, low - height(text) / 2, text, loop=True))
    rights = [note.x + width(note.text) / 2 for note in notes]
    wide = max([placed.spaced.width, *rights])
    return Layout(wide, low, tuple(boxes), tuple(lines), tuple(notes))


def _returns(graph: Graph) -> list[tuple[int, Band]]:
    """Bands that go back, those that go back least first."""
    back = [(number, band) for number, band in enumerate(graph.bands) if band.back]
    layers = graph.layers
    return sorted(back, key=lambda item: layers[item[1].source] - layers[item[1].target])


def _told(graph: Graph, scale: float, words: Words) -> dict[int, str]:
    """Powers of bands which the texts of nodes and loops do not tell.

    What hardly shows beside a loop, and covers losses of its mechanisms, is not told.
    """
    beside = {pair for band in graph.bands if band.loop is not None for pair in band.pairs}
    sources = [band.source for band in graph.bands]
    targets = [band.target for band in graph.bands]
    return {
        number: words.power(band.power)
        for number, band in enumerate(graph.bands)
        if band.loop is None
        and sources.count(band.source) > 1
        and targets.count(band.target) > 1
        and not (band.pairs[0] in beside and band.power * scale < HARDLY)
    }


def _on_bands(placed: Placed, told: Mapping[int, str], lines: Sequence[Line]) -> list[Note]:
    """Powers on bands, behind the column of their source."""
    notes = []
    bands, layers = placed.graph.bands, placed.graph.layers
    by_band = {line.band: line for line in lines}
    for layer, x in enumerate(placed.spaced.texts):
        own = [number for number in told if layers[bands[number].source] == layer]
        wanted = []
        for number in own:
            (left, start), (right, end), *_ = by_band[bands[number]].points
            wanted.append(start + (end - start) * _smooth((x - left) / (right - left)))
        places = spread(wanted, [height(told[number]) + UNDER for number in own])
        notes += [Note(x, y, told[n], loop=False) for n, y in zip(own, places, strict=True)]
    return notes


def _smooth(part: float) -> float:
    """How far a curve between two level places has come, about; both from 0 to 1."""
    return part * part * (3 - 2 * part)
