"""Nodes of a picture of power in columns: how wide these are, and how deep each node stands."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from vstatics.flow.circulation import Node
from vstatics.pictures.flow_graph import Graph
from vstatics.pictures.flow_texts import FlowTexts
from vstatics.pictures.labels import height, width

BODY = 12.0
"""Width of a node. [pt]"""
BAR = 3.0
"""Width of a link. [pt]"""
SPACE = 16.0
"""Between columns of texts, and between nodes of one column. [pt]"""
CLEAR = 5.0
"""Between a band that turns and whatever it passes. [pt]"""
ARM = 8.0
"""Length of a loss, besides half its width. [pt]"""

Key = tuple[int, Node | int]
"""Layer, and the node or the index of the band that passes."""


class FlowCell(NamedTuple):
    """What stands in a column: a node with its texts, or a band that passes."""

    node: Node | None
    band: int
    """Index of the band that passes; -1 of a node."""
    text: str = ""
    lost: str = ""
    thick: float = 0.0
    """[pt]"""
    loss: float = 0.0
    """Width of what is lost. [pt]"""

    @property
    def above(self) -> float:
        """Height of the text above [pt]."""
        return height(self.text) + 2 if self.text else 0.0

    @property
    def below(self) -> float:
        """Height of what hangs below [pt]."""
        return ARM + self.loss / 2 + height(self.lost) + 1 if self.lost else 0.0

    @property
    def lower(self) -> float:
        """How far the middle of all is below the middle of the node [pt]."""
        return (self.below - self.above) / 2

    @property
    def body(self) -> float:
        """Width of the node [pt]."""
        if self.node is None:
            return 0.0
        return BAR if self.node.kind == "link" else max(BODY, self.loss)

    @property
    def wide(self) -> float:
        """Width with the texts [pt]."""
        return max(self.body, *(width(text) if text else 0.0 for text in (self.text, self.lost)))


class NodeColumns(NamedTuple):
    """All cells, and the ways of bands through them."""

    cells: list[list[FlowCell]]
    """By layer."""
    ways: Mapping[int, list[FlowCell]]
    """Of each band that does not go back: from its source to its target."""


def cell(graph: Graph, node: Node, power: float, scale: float, texts: FlowTexts) -> FlowCell:
    """A node and its texts; losses of a node on the way back are none."""
    lost = graph.losses.get(node, 0.0) if node in graph.layers else 0.0
    below = texts.power(lost) if lost else ""
    return FlowCell(node, -1, texts.node(node, power), below, power * scale, lost * scale)


def columns(graph: Graph, scale: float, texts: FlowTexts) -> NodeColumns:
    """Nodes by layer, and a cell wherever a band passes a layer."""
    nodes = {node: cell(graph, node, graph.through(node), scale, texts) for node in graph.layers}
    cells: list[list[FlowCell]] = [[] for _ in range(1 + max(graph.layers.values(), default=-1))]
    for node, layer in graph.layers.items():
        cells[layer].append(nodes[node])
    ways = {}
    for number, band in enumerate(graph.bands):
        if not band.back:
            between = range(graph.layers[band.source] + 1, graph.layers[band.target])
            passing = FlowCell(None, number, thick=band.power * scale)
            for layer in between:
                cells[layer].append(passing)
            ways[number] = [nodes[band.source], *[passing] * len(between), nodes[band.target]]
    return NodeColumns(cells, ways)


class Across(NamedTuple):
    """Places from left to right [pt]."""

    middles: Sequence[float]
    """Of each column."""
    texts: Sequence[float]
    """Of texts on bands, after each column."""
    leaving: Mapping[int, float]
    """Where a band that goes back turns first."""
    arriving: Mapping[int, float]
    """Where it turns last."""
    width: float


def across(
    graph: Graph,
    cells: NodeColumns,
    on_bands: Mapping[int, str],
    needed: Mapping[int, float],
    scale: float,
) -> Across:
    """Places of columns, with room for texts on bands and for bands that turn.

    Parameters
    ----------
    graph : Graph
    cells : NodeColumns
    on_bands : mapping
        Texts on bands.
    needed : mapping
        Room that each band needs on its way back, by which columns grow; bands that turn
        nearer to their columns first. [pt]
    scale : float
    """
    layers, bands = graph.layers, graph.bands
    wide = [max(one.wide for one in column) for column in cells.cells]
    texts = [SPACE] * len(wide)
    for number, words in on_bands.items():
        at = layers[bands[number].source]
        texts[at] = max(texts[at], width(words) + 2 * CLEAR)
    for number, room in needed.items():
        first, last = layers[bands[number].target], layers[bands[number].source]
        taken = sum(wide[first : last + 1]) + sum(texts[first:last])
        for place in range(first, last + 1):
            wide[place] += max(room - taken, 0.0) / (last - first + 1)
    middles, behind, x = [], [], 0.0
    leaving: dict[int, float] = {}
    arriving: dict[int, float] = {}
    for place, own in enumerate(wide):
        for number in reversed([n for n in needed if layers[bands[n].target] == place]):
            arriving[number] = x + bands[number].power * scale / 2 + CLEAR
            x = 2 * arriving[number] - x
        middles.append(x + own / 2)
        x += own
        for number in (n for n in needed if layers[bands[n].source] == place):
            leaving[number] = x + bands[number].power * scale / 2 + CLEAR
            x = 2 * leaving[number] - x
        behind.append(x + texts[place] / 2)
        x += texts[place]
    return Across(middles, behind, leaving, arriving, x - texts[-1])


def key(layer: int, one: FlowCell) -> Key:
    """What tells a cell from all others."""
    return layer, one.node or one.band
