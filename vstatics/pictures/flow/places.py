"""Positioned parts of a power flow: nodes, bands, ports and texts."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from vstatics.core.flow.circulation import Node
from vstatics.pictures.drawing.canvas import Point
from vstatics.pictures.drawing.labels import height
from vstatics.pictures.flow.columns import NODE_GAP, FlowCell, signs
from vstatics.pictures.flow.graph import Band, EndPort, Graph


class Box(NamedTuple):
    """Rectangle of a run of nodes. The text is centred above it, and the loss is below it."""

    cell: FlowCell
    middle: float
    """Distance of the middle from the left end of the layout. [pt]"""
    top: float
    """Distance of the upper edge from the top of the layout. [pt]"""

    @property
    def left(self) -> float:
        """Left edge of the rectangle [pt]."""
        return self.middle - self.cell.body / 2

    @property
    def right(self) -> float:
        """Right edge of the rectangle [pt]."""
        return self.middle + self.cell.body / 2

    @property
    def bottom(self) -> float:
        """Lower edge of the rectangle [pt]."""
        return self.top + self.cell.thick

    def signs(self) -> Iterator[tuple[Node, float, float]]:
        """Yield each node with the positions of the left and right side [pt]."""
        x = self.left
        for node, wide in zip(self.cell.run, signs(self.cell.run, self.cell.loss), strict=True):
            yield node, x, x + wide
            x += wide + NODE_GAP


class Line(NamedTuple):
    """Centre line of a band."""

    band: Band
    width: float
    """Width of the band, proportional to the power. [pt]"""
    points: tuple[Point, ...]
    """Corners of a returning band, or the ends of the horizontal parts of a forward band."""


class Stub(NamedTuple):
    """Port of the power flow, with the contact point at the link."""

    link: Node
    port: EndPort
    width: float
    """Width of the port. [pt]"""
    x: float
    y: float


class Note(NamedTuple):
    """Text of a band or loop, with the position of the centre."""

    x: float
    y: float
    text: str
    band: Band

    @property
    def loop(self) -> bool:
        """True for the text of recirculating power."""
        return self.band.loop is not None

    @property
    def bottom(self) -> float:
        """Lower edge of the text [pt]."""
        return self.y + height(self.text) / 2


class FlowLayout(NamedTuple):
    """Layout of the power flow of a gear."""

    width: float
    """Width of the layout. [pt]"""
    height: float
    """Height of the layout. [pt]"""
    graph: Graph
    boxes: tuple[Box, ...]
    lines: tuple[Line, ...]
    stubs: tuple[Stub, ...]
    notes: tuple[Note, ...]
