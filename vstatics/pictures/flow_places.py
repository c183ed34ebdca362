"""Where the nodes, bands and texts of the picture `flow` stand."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from vstatics.flow.circulation import Node
from vstatics.pictures.flow_columns import (
    SPACE,
    Across,
    FlowCell,
    Key,
    NodeColumns,
    across,
    cell,
    columns,
    key,
)
from vstatics.pictures.flow_graph import Band, Graph
from vstatics.pictures.flow_rows import tops
from vstatics.pictures.flow_texts import FlowTexts
from vstatics.pictures.labels import Point, height, spread, width

UNDER = 3.0
"""Between a band and its text, and between texts. [pt]"""
HARDLY = 4.0
"""A band below this width hardly shows beside another. [pt]"""


class Box(NamedTuple):
    """A node, with its text centred above it, and with its loss below."""

    cell: FlowCell
    middle: float
    """From the left. [pt]"""
    top: float
    """Down from the top. [pt]"""

    @property
    def left(self) -> float:
        """[pt]."""
        return self.middle - self.cell.body / 2

    @property
    def right(self) -> float:
        """[pt]."""
        return self.middle + self.cell.body / 2

    @property
    def bottom(self) -> float:
        """[pt]."""
        return self.top + self.cell.thick


class Line(NamedTuple):
    """The middle of a band."""

    band: Band
    width: float
    """Power times scale. [pt]"""
    points: tuple[Point, ...]
    """Corners of what goes back; else where it is level, with curves between."""


class Slot(NamedTuple):
    """Depths of the ends of a band [pt]."""

    start: float
    end: float


class Placed(NamedTuple):
    """Nodes and what passes, in their places."""

    graph: Graph
    scale: float
    """Width of a band of power 1. [pt]"""
    cells: NodeColumns
    spaced: Across
    middles: Mapping[Key, float]
    """How deep the middle of each cell is. [pt]"""
    boxes: Mapping[Node, Box]

    def next_to(self, number: int, step: int) -> float:
        """How deep a band is after its source, or for a step of -1 before its target."""
        way = self.cells.ways.get(number)
        if way is None:
            return math.inf
        band = self.graph.bands[number]
        layer = self.graph.layers[band.source if step > 0 else band.target]
        return self.middles[key(layer + step, way[1 if step > 0 else -2])]


class Note(NamedTuple):
    """A text on a band or a loop, by its middle."""

    x: float
    y: float
    text: str
    loop: bool


class FlowLayout(NamedTuple):
    """The picture of a gear."""

    width: float
    """[pt]"""
    height: float
    """[pt]"""
    boxes: tuple[Box, ...]
    lines: tuple[Line, ...]
    notes: tuple[Note, ...]


def layout(graph: Graph, scale: float, texts: FlowTexts) -> FlowLayout:
    """Places of all that is drawn of a gear; a band of power 1 has the width `scale` [pt].

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> from vstatics.flow.power import flows
    >>> from vstatics.pictures.flow_graph import graph
    >>> from vstatics.pictures.style import Style
    >>> pair = Mechanism(1, 2, 0, -4.0, 0.98, name="pair")
    >>> [gear] = flows(solve(Transmission(2, [], [pair], [Gear()])))
    >>> placing = layout(graph(gear.lossy), 100.0, FlowTexts(gear, gear.lossy, Style()))
    >>> [(str(one.cell.node), round(one.cell.thick), round(one.cell.loss)) for one in placing.boxes]
    [('input', 100, 0), ('1', 100, 0), ('pair', 100, 2), ('2', 98, 0), ('output', 98, 0)]
    """
    cells = columns(graph, scale, texts)
    on_bands = _band_texts(graph, scale, texts)
    on_way = {
        number: [cell(graph, node, band.power, scale, texts) for node in band.between]
        for number, band in _returns(graph)
    }
    needed = {number: sum(one.wide + SPACE for one in found) for number, found in on_way.items()}
    placed = place(graph, scale, cells, across(graph, cells, on_bands, needed, scale))
    ends = slots(placed)
    lines = [
        Line(graph.bands[number], graph.bands[number].power * scale, points)
        for number, points in forward(placed, ends)
    ]
    notes = _on_bands(placed, on_bands, lines)
    boxes = list(placed.boxes.values())
    low = max(box.bottom + box.cell.below for box in boxes)
    low = max([low, *(y + line.width / 2 for line in lines for _, y in line.points)])
    named: set[int] = set()
    for number, passed in on_way.items():
        top = low + SPACE / 2 + max((one.above for one in passed), default=0.0)
        row, line = back(placed, number, ends[number], passed, top)
        boxes += row
        lines.append(line)
        low = max(y for _, y in line.points) + line.width / 2
        if line.band.loop is not None and line.band.loop not in named:
            named.add(line.band.loop)
            text = texts.loop(line.band.loop)
            middle = (placed.spaced.leaving[number] + placed.spaced.arriving[number]) / 2
            low += height(text) + UNDER
            x = max(middle, width(text) / 2)
            notes.append(Note(x, low - height(text) / 2, text, loop=True))
    rights = [note.x + width(note.text) / 2 for note in notes]
    wide = max([placed.spaced.width, *rights])
    return FlowLayout(wide, low, tuple(boxes), tuple(lines), tuple(notes))


def _returns(graph: Graph) -> list[tuple[int, Band]]:
    """Bands that go back, those that go back least first."""
    back = [(number, band) for number, band in enumerate(graph.bands) if band.back]
    layers = graph.layers
    return sorted(back, key=lambda item: layers[item[1].source] - layers[item[1].target])


def _band_texts(graph: Graph, scale: float, texts: FlowTexts) -> dict[int, str]:
    """Powers of bands which the texts of nodes and loops do not say.

    What hardly shows beside a loop, and covers losses of its mechanisms, is left out.
    """
    beside = {pair for band in graph.bands if band.loop is not None for pair in band.pairs}
    sources = [band.source for band in graph.bands]
    targets = [band.target for band in graph.bands]
    return {
        number: texts.power(band.power)
        for number, band in enumerate(graph.bands)
        if band.loop is None
        and sources.count(band.source) > 1
        and targets.count(band.target) > 1
        and not (band.pairs[0] in beside and band.power * scale < HARDLY)
    }


def _on_bands(placed: Placed, on_bands: Mapping[int, str], lines: Sequence[Line]) -> list[Note]:
    """Powers on bands, behind the column of their source."""
    notes = []
    bands, layers = placed.graph.bands, placed.graph.layers
    by_band = {line.band: line for line in lines}
    for layer, x in enumerate(placed.spaced.texts):
        own = [number for number in on_bands if layers[bands[number].source] == layer]
        wanted = []
        for number in own:
            (left, start), (right, end), *_ = by_band[bands[number]].points
            wanted.append(start + (end - start) * _smooth((x - left) / (right - left)))
        places = spread(wanted, [height(on_bands[number]) + UNDER for number in own])
        notes += [Note(x, y, on_bands[n], loop=False) for n, y in zip(own, places, strict=True)]
    return notes


def _smooth(part: float) -> float:
    """How far a curve between two level places has come, about; both from 0 to 1."""
    return part * part * (3 - 2 * part)


def place(graph: Graph, scale: float, cells: NodeColumns, spaced: Across) -> Placed:
    """Nodes in their places."""
    boxes: dict[Node, Box] = {}
    middles: dict[Key, float] = {}
    deep = tops(graph, cells)
    for layer, column in enumerate(cells.cells):
        for one in column:
            top = deep[key(layer, one)]
            middles[key(layer, one)] = top + one.thick / 2
            if one.node is not None:
                boxes[one.node] = Box(one, spaced.middles[layer], top)
    return Placed(graph, scale, cells, spaced, middles, boxes)


def slots(placed: Placed) -> dict[int, Slot]:
    """Where each band leaves its source and reaches its target.

    At a node bands stand in the order of where they lead; what goes back is lowest.
    """
    bands = placed.graph.bands

    def stacked(box: Box, own: list[int], step: int) -> Iterator[tuple[int, float]]:
        deep = box.top
        for number in sorted(own, key=lambda one: (placed.next_to(one, step), one)):
            thick = bands[number].power * placed.scale
            yield number, deep + thick / 2
            deep += thick

    starts: dict[int, float] = {}
    ends: dict[int, float] = {}
    for node, box in placed.boxes.items():
        starts.update(stacked(box, [n for n, band in enumerate(bands) if band.source == node], 1))
        ends.update(stacked(box, [n for n, band in enumerate(bands) if band.target == node], -1))
    return {number: Slot(starts[number], ends[number]) for number in range(len(bands))}


def forward(placed: Placed, slots: Mapping[int, Slot]) -> Iterator[tuple[int, tuple[Point, ...]]]:
    """Each band that runs from left to right."""
    for number, way in placed.cells.ways.items():
        band = placed.graph.bands[number]
        first = placed.graph.layers[band.source]
        passed = [
            (placed.spaced.middles[layer], placed.middles[key(layer, one)])
            for layer, one in enumerate(way[1:-1], first + 1)
        ]
        start = (placed.boxes[band.source].right, slots[number].start)
        yield number, (start, *passed, (placed.boxes[band.target].left, slots[number].end))


def back(
    placed: Placed, number: int, slot: Slot, passed: Sequence[FlowCell], top: float
) -> tuple[list[Box], Line]:
    """A band that goes back in a row below a depth, and the nodes on its way."""
    band = placed.graph.bands[number]
    thick = band.power * placed.scale
    right, left = placed.spaced.leaving[number], placed.spaced.arriving[number]
    step = (right - left - sum(one.wide for one in passed)) / (len(passed) + 1)
    row, x = [], right
    for one in passed:
        row.append(Box(one, x - step - one.wide / 2, top))
        x -= step + one.wide
    deep = top + thick / 2
    start, end = placed.boxes[band.source].right, placed.boxes[band.target].left
    turns = ((right, slot.start), (right, deep), (left, deep), (left, slot.end))
    return row, Line(band, thick, ((start, slot.start), *turns, (end, slot.end)))
