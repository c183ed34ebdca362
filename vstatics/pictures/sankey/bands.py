"""Where bands of a picture of power begin, run and end."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from vstatics.flow.circulation import Node
from vstatics.pictures.sankey.columns import Across, Cell, Columns, Key, key
from vstatics.pictures.sankey.graph import Band, Graph
from vstatics.pictures.sankey.rows import tops

Point = tuple[float, float]
"""From the left, and down from the top. [pt]"""


class Box(NamedTuple):
    """A node, with its text centred above it, and with its loss below."""

    cell: Cell
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
    cells: Columns
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


def place(graph: Graph, scale: float, cells: Columns, spaced: Across) -> Placed:
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
    placed: Placed, number: int, slot: Slot, passed: Sequence[Cell], top: float
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
