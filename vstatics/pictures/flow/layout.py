"""Layout of a power flow: positions of nodes, bands and texts."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple

from vstatics.pictures.drawing.canvas import Point
from vstatics.pictures.drawing.labels import height, width
from vstatics.pictures.flow.back import BackRow, back_rows, placed_rows
from vstatics.pictures.flow.columns import Across, NodeColumns, across, columns
from vstatics.pictures.flow.depths import Depths, depths
from vstatics.pictures.flow.graph import Graph
from vstatics.pictures.flow.places import Box, FlowLayout, Line, Note, Stub
from vstatics.pictures.flow.texts import FlowTexts

STRAIGHT = 0.5
"""Difference in depth between two columns below which a band is horizontal. [pt]"""


class _Placed(NamedTuple):
    """Positions of runs (nodes in series), and of bands that pass through columns."""

    graph: Graph
    scale: float
    """Width of a band that transmits the input power. [pt]"""
    cells: NodeColumns
    deep: Depths
    courses: Mapping[int, Sequence[float]]
    """Depths along each forward band: at the source, in each column passed, at the target. [pt]"""
    spaced: Across
    boxes: Sequence[Box]
    """Rectangle of each run."""

    def ends(self, number: int) -> tuple[Point, Point]:
        """Return the points where a band leaves the source and reaches the target."""
        source, target = (self.boxes[run] for run in self.graph.ends(self.graph.bands[number]))
        return (source.right, self.deep.starts[number]), (target.left, self.deep.ends[number])


def layout(graph: Graph, scale: float, texts: FlowTexts) -> FlowLayout:
    """Return the layout of a gear. A band that transmits the input power is `scale` [pt] wide.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> from vstatics.core.flow.power import flows
    >>> from vstatics.pictures.flow.graph import graph
    >>> from vstatics.pictures.drawing.style import Style
    >>> pair = Mechanism(1, 2, 0, -4.0, 0.98, name="pair")
    >>> [gear] = flows(solve(Transmission(2, [], [pair], [Gear()])))
    >>> placing = layout(graph(gear.lossy), 100.0, FlowTexts(gear, gear.lossy, Style()))
    >>> cells = [box.cell for box in sorted(placing.boxes, key=lambda box: box.left)]
    >>> [(str(cell.run[0]), round(cell.thick), round(cell.loss)) for cell in cells]
    [('1', 100, 0), ('pair', 100, 2), ('2', 98, 0)]
    """
    rows = back_rows(graph, scale, texts)
    placed = _placed(graph, scale, columns(graph, scale, texts), rows)
    lines = [*_forward(placed), *_within(placed)]
    boxes = list(placed.boxes)
    low = max([*(box.bottom + box.cell.below for box in boxes), *map(_deepest, lines)])
    notes = [  # powers above bands that pass through a column
        Note(
            placed.spaced.middle(layer),
            placed.deep.middles[layer, cell.number]
            - cell.thick / 2
            - cell.above
            + height(cell.text) / 2,
            cell.text,
            graph.bands[~cell.number],
        )
        for layer, column in enumerate(placed.cells.cells)
        for cell in column
        if cell.number < 0 and cell.text
    ]
    ends = {row.number: placed.ends(row.number) for row in rows}
    for line, row_boxes, texts_of_row in placed_rows(rows, placed.spaced, ends, low):
        lines.append(line)
        boxes += row_boxes
        notes += texts_of_row
    low = max([low, *map(_deepest, lines), *(note.bottom for note in notes)])
    wide = max([placed.spaced.width, *(note.x + width(note.text) / 2 for note in notes)])
    stubs = [
        Stub(
            link,
            port,
            port.power * scale,
            boxes[graph.place[link]].left if port.enters else boxes[graph.place[link]].right,
            placed.deep.ports[port],
        )
        for link, row_boxes in graph.ports.items()
        for port in row_boxes
    ]
    return FlowLayout(wide, low, graph, tuple(boxes), tuple(lines), tuple(stubs), tuple(notes))


def _deepest(line: Line) -> float:
    return max(y for _, y in line.points) + line.width / 2


def _placed(graph: Graph, scale: float, cells: NodeColumns, rows: Sequence[BackRow]) -> _Placed:
    """Return positions of runs and bands, with columns wide enough for returning bands."""
    deep = depths(graph, scale, cells, [row.number for row in rows])
    courses = {
        number: [deep.starts[number], *(deep.middles[key] for key in way[1:-1]), deep.ends[number]]
        for number, way in cells.ways.items()
    }
    needed = {row.number: row.needed for row in rows}
    spaced = across(graph, cells, courses, needed, scale)
    boxes = {
        cell.number: Box(
            cell, spaced.middle(layer), deep.middles[layer, cell.number] - cell.thick / 2
        )
        for layer, column in enumerate(cells.cells)
        for cell in column
    }
    by_run = [boxes[number] for number in range(len(graph.runs))]
    return _Placed(graph, scale, cells, deep, courses, spaced, by_run)


def _forward(placed: _Placed) -> Iterator[Line]:
    """Yield the line of each forward band, horizontal within columns and curved between them."""
    for number, course in placed.courses.items():
        start, end = placed.ends(number)
        points = [start]
        for (layer, _), (deep, other) in zip(
            placed.cells.ways[number], pairwise(course), strict=False
        ):
            left, right = placed.spaced.gaps[layer]
            if abs(deep - other) > STRAIGHT:
                points += [(left, deep), (right, other)]
        band = placed.graph.bands[number]
        yield Line(band, band.power * placed.scale, (*points, end))


def _within(placed: _Placed) -> Iterator[Line]:
    deep: dict[Hashable, float] = {}
    for band in placed.graph.bands:
        if placed.graph.is_within(band):
            box = placed.boxes[placed.graph.place[band.source]]
            sides = {node: (left, right) for node, left, right in box.signs()}
            thick = band.power * placed.scale
            top = deep.get(band.pairs[0], box.top)
            deep[band.pairs[0]] = top + thick
            y = top + thick / 2
            yield Line(band, thick, ((sides[band.source][1], y), (sides[band.target][0], y)))
