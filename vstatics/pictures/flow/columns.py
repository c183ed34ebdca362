"""Columns of a power flow: widths, gaps and horizontal positions of nodes and bands."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple

from vstatics.pictures.drawing.labels import Span, height, width
from vstatics.pictures.flow.graph import Graph, Run
from vstatics.pictures.flow.texts import FlowTexts

BODY = 12.0
"""Width of the rectangle of a component. [pt]"""
LINK_WIDTH = 3.0
"""Width of the bar of a link. [pt]"""
NODE_GAP = 6.0
"""Distance between neighbouring nodes of a run. [pt]"""
PORT_ARROW = 11.0
"""Length of the arrow at the input or output. [pt]"""
SPACE = 16.0
"""Distance between the texts of neighbouring columns, and between cells of a column. [pt]"""
BAND_CLEARANCE = 8.0
"""Distance between a returning band and neighbouring nodes, bands and texts. [pt]"""
LOSS_LENGTH = 8.0
"""Length of the band of a loss below the node, in addition to half the band width. [pt]"""
BEND = 2.4
"""Smallest squared horizontal length of a band's curve, relative to width times rise. [-]"""

Key = tuple[int, int]
"""Layer (column from the left) and `FlowCell.number` of a cell."""


def signs(run: Run, loss: float = 0.0) -> list[float]:
    """Return the width of each node of a run [pt]; the band of a loss has the width `loss` [pt]."""
    return [LINK_WIDTH if node.kind == "link" else max(BODY, loss) for node in run]


def length(run: Run, loss: float = 0.0) -> float:
    """Return the length of a run of nodes [pt]; the band of a loss has the width `loss` [pt]."""
    return sum(signs(run, loss)) + NODE_GAP * max(len(run) - 1, 0)


class FlowCell(NamedTuple):
    """Cell of a column: a run of nodes with the texts, or a band that passes through the column."""

    number: int
    """Index of the run, or bitwise complement of the index of a passing band."""
    run: Run = ()
    text: str = ""
    lost: str = ""
    thick: float = 0.0
    """Thickness of the run or band. [pt]"""
    loss: float = 0.0
    """Width of the band of the loss, which leaves downwards. [pt]"""
    ends: float = 0.0
    """Length of a port's arrow, reserved on both sides. [pt]"""

    @property
    def above(self) -> float:
        """Height of the text above the nodes [pt]."""
        return height(self.text) + 2 if self.text else 0.0

    @property
    def below(self) -> float:
        """Height of the loss and the text below the nodes [pt]."""
        return LOSS_LENGTH + self.loss / 2 + height(self.lost) + 1 if self.lost else 0.0

    @property
    def lower(self) -> float:
        """Distance from the middle of the node down to the middle of the cell [pt]."""
        return (self.below - self.above) / 2

    @property
    def body(self) -> float:
        """Width of the nodes [pt]."""
        return length(self.run, self.loss)

    @property
    def wide(self) -> float:
        """Width of the cell with texts and ports [pt]."""
        texts = (width(text) if text else 0.0 for text in (self.text, self.lost))
        return max(self.body + 2 * self.ends, *texts)


class NodeColumns(NamedTuple):
    """Cells of all columns, and the sequence of cells along each band."""

    cells: list[list[FlowCell]]
    """Cells of each layer, from the left."""
    ways: Mapping[int, list[Key]]
    """Cells from source to target along each forward band, by index of the band."""


def columns(graph: Graph, scale: float, texts: FlowTexts) -> NodeColumns:
    """Return the cells of each layer: the runs, and the bands that pass through."""
    cells: list[list[FlowCell]] = [[] for _ in range(1 + max(graph.layers, default=-1))]
    for number, (run, layer) in enumerate(zip(graph.runs, graph.layers, strict=True)):
        cells[layer].append(_cell(graph, number, run, scale, texts))
    ways = {}
    for number, band in enumerate(graph.bands):
        if not band.back and not graph.is_within(band):
            source, target = graph.ends(band)
            between = range(graph.layers[source] + 1, graph.layers[target])
            for place in between:
                is_named = number in graph.numbered and place == between[len(between) // 2]
                text = texts.power(band.power) if is_named else ""
                cells[place].append(FlowCell(~number, text=text, thick=band.power * scale))
            first, last = (graph.layers[source], source), (graph.layers[target], target)
            ways[number] = [first, *((place, ~number) for place in between), last]
    return NodeColumns(cells, ways)


def _cell(graph: Graph, number: int, run: Run, scale: float, texts: FlowTexts) -> FlowCell:
    through = max(graph.through(node) for node in run)
    ports = [port for node in run for port in graph.ports.get(node, ())]
    lost = graph.losses.get(run[0], 0.0)
    return FlowCell(
        number,
        run,
        texts.run(run, through, length(run), ports),
        texts.power(lost) if lost else "",
        through * scale,
        lost * scale,
        PORT_ARROW if ports else 0.0,
    )


class Across(NamedTuple):
    """Horizontal positions of columns and bands [pt]."""

    columns: Sequence[Span]
    """Left and right side of each column."""
    gaps: Sequence[Span]
    """Start and end of the curved part of bands after each column."""
    leaving: Mapping[int, float]
    """Position where each returning band turns after the source, by index of the band."""
    arriving: Mapping[int, float]
    """Position where each returning band turns before the target, by index of the band."""

    @property
    def width(self) -> float:
        """Total width, with the turns of returning bands on the right."""
        return max([self.columns[-1][1], *(x + BAND_CLEARANCE for x in self.leaving.values())])

    def middle(self, layer: int) -> float:
        """Return the middle of the column of a layer."""
        return sum(self.columns[layer]) / 2


def across(
    graph: Graph,
    cells: NodeColumns,
    courses: Mapping[int, Sequence[float]],
    needed: Mapping[int, float],
    scale: float,
) -> Across:
    """Return the positions of columns, with room for curves and turns of bands.

    Bands are horizontal within columns and where other bands turn, so no band crosses texts.

    Parameters
    ----------
    graph : Graph
    cells : NodeColumns
    courses : mapping
        Depths along each forward band: at its source, in each layer that it passes, at its target.
        [pt]
    needed : mapping
        Length that each returning band needs for its nodes; columns are widened for it. Bands that
        turn closest to their columns come first. [pt]
    scale : float
    """
    bands = graph.bands
    wide = [max(cell.wide for cell in column) for column in cells.cells]
    gaps = [SPACE] * len(wide)
    for number, course in courses.items():
        for (layer, _), (deep, other) in zip(cells.ways[number], pairwise(course), strict=False):
            rise, thick = abs(deep - other), bands[number].power * scale
            gaps[layer] = max(gaps[layer], rise / 2, math.sqrt(BEND * thick * rise))
    ends = {n: [graph.layers[run] for run in graph.ends(bands[n])] for n in needed}
    for number, (last, first) in ends.items():
        taken = sum(wide[first : last + 1]) + sum(gaps[first:last])
        for place in range(first, last + 1):
            wide[place] += max(needed[number] - taken, 0.0) / (last - first + 1)
    sides, curves, x = [], [], 0.0
    leaving: dict[int, float] = {}
    arriving: dict[int, float] = {}
    for place, column_width in enumerate(wide):
        for number in reversed([n for n, (_, first) in ends.items() if first == place]):
            arriving[number] = x + bands[number].power * scale / 2 + BAND_CLEARANCE
            x = 2 * arriving[number] - x
        sides.append((x, x + column_width))
        x += column_width
        for number in (n for n, (last, _) in ends.items() if last == place):
            leaving[number] = x + bands[number].power * scale / 2 + BAND_CLEARANCE
            x = 2 * leaving[number] - x
        curves.append((x, x + gaps[place]))
        x += gaps[place]
    return Across(sides, curves, leaving, arriving)
