"""Runs of nodes in columns: how wide these are, and how much room is between them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple

from vstatics.pictures.drawing.labels import Span, height, width
from vstatics.pictures.flow.graph import Graph, Run
from vstatics.pictures.flow.texts import FlowTexts

BODY = 12.0
"""Width of a device. [pt]"""
LINK_WIDTH = 3.0
"""Width of a link. [pt]"""
NODE_GAP = 6.0
"""Between the nodes of a run. [pt]"""
PORT = 11.0
"""Length of the arrow of a port. [pt]"""
SPACE = 16.0
"""Between columns of texts, and between nodes of one column. [pt]"""
BAND_CLEARANCE = 8.0
"""Between a band that turns and whatever it passes. [pt]"""
LOSS_LENGTH = 8.0
"""Length of a loss, besides half its width. [pt]"""
BEND = 2.4
"""A curve has no kink if its length squared is so many times its width and rise."""

Key = tuple[int, int]
"""Layer, and the index of the run; of a band that passes the complement of its index."""


def signs(run: Run, loss: float = 0.0) -> list[float]:
    """Width of each node of a run that loses so much of its thickness [pt]."""
    return [LINK_WIDTH if one.kind == "link" else max(BODY, loss) for one in run]


def length(run: Run, loss: float = 0.0) -> float:
    """Of a run [pt]."""
    return sum(signs(run, loss)) + NODE_GAP * max(len(run) - 1, 0)


class FlowCell(NamedTuple):
    """What stands in a column: a run with its texts, or a band that passes."""

    number: int
    """Index of the run; the complement of that of a band that passes."""
    run: Run = ()
    text: str = ""
    lost: str = ""
    thick: float = 0.0
    """[pt]"""
    loss: float = 0.0
    """Width of what is lost. [pt]"""
    ends: float = 0.0
    """Width of an arrow of a port, at either side. [pt]"""

    @property
    def above(self) -> float:
        """Height of the text above [pt]."""
        return height(self.text) + 2 if self.text else 0.0

    @property
    def below(self) -> float:
        """Height of what hangs below [pt]."""
        return LOSS_LENGTH + self.loss / 2 + height(self.lost) + 1 if self.lost else 0.0

    @property
    def lower(self) -> float:
        """How far the middle of all is below the middle of the node [pt]."""
        return (self.below - self.above) / 2

    @property
    def body(self) -> float:
        """Width of the nodes [pt]."""
        return length(self.run, self.loss)

    @property
    def wide(self) -> float:
        """Width with the texts and ports [pt]."""
        texts = (width(text) if text else 0.0 for text in (self.text, self.lost))
        return max(self.body + 2 * self.ends, *texts)


class NodeColumns(NamedTuple):
    """All cells, and the ways of bands through them."""

    cells: list[list[FlowCell]]
    """By layer."""
    ways: Mapping[int, list[Key]]
    """Of each band between runs that does not go back: from its source to its target."""


def columns(graph: Graph, scale: float, texts: FlowTexts) -> NodeColumns:
    """Runs by layer, and a cell wherever a band passes a layer."""
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
        PORT if ports else 0.0,
    )


def on_way_back(run: Run, power: float, scale: float, texts: FlowTexts) -> FlowCell:
    """Nodes through which nothing but a loop goes, from left to right."""
    return FlowCell(
        -1, run[::-1], texts.run(run, power, length(run), back=True), thick=power * scale
    )


class Across(NamedTuple):
    """Places from left to right [pt]."""

    columns: Sequence[Span]
    """Left and right side of each."""
    gaps: Sequence[Span]
    """Where bands have curves, behind each column."""
    leaving: Mapping[int, float]
    """Where a band that goes back turns first."""
    arriving: Mapping[int, float]
    """Where it turns last."""

    @property
    def width(self) -> float:
        """With what turns at the right."""
        return max([self.columns[-1][1], *(x + BAND_CLEARANCE for x in self.leaving.values())])

    def middle(self, layer: int) -> float:
        """Of a column."""
        return sum(self.columns[layer]) / 2


def across(
    graph: Graph,
    cells: NodeColumns,
    courses: Mapping[int, Sequence[float]],
    needed: Mapping[int, float],
    scale: float,
) -> Across:
    """Places of columns, with room for the curves of bands and for bands that turn.

    Within a column, and where others turn, bands are level; so no text there stands on one.

    Parameters
    ----------
    graph : Graph
    cells : NodeColumns
    courses : mapping
        How deep each band is at its source, where it passes a layer, and at its target. [pt]
    needed : mapping
        Room that each band needs on its way back, by which columns grow; bands that turn
        nearer to their columns first. [pt]
    scale : float
    """
    bands = graph.bands
    wide = [max(one.wide for one in column) for column in cells.cells]
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
    for place, own in enumerate(wide):
        for number in reversed([n for n, (_, first) in ends.items() if first == place]):
            arriving[number] = x + bands[number].power * scale / 2 + BAND_CLEARANCE
            x = 2 * arriving[number] - x
        sides.append((x, x + own))
        x += own
        for number in (n for n, (last, _) in ends.items() if last == place):
            leaving[number] = x + bands[number].power * scale / 2 + BAND_CLEARANCE
            x = 2 * leaving[number] - x
        curves.append((x, x + gaps[place]))
        x += gaps[place]
    return Across(sides, curves, leaving, arriving)
