"""What is placed in the picture `flow`: nodes, bands, ports and texts."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from vstatics.core.flow.circulation import Node
from vstatics.pictures.drawing.labels import Point, height
from vstatics.pictures.flow.columns import NODE_GAP, FlowCell, signs
from vstatics.pictures.flow.graph import Band, EndPort, Graph


class Box(NamedTuple):
    """A run of nodes, with its text centred above, and with its loss below."""

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

    def signs(self) -> Iterator[tuple[Node, float, float]]:
        """Each node with its left and right side [pt]."""
        x = self.left
        for node, wide in zip(self.cell.run, signs(self.cell.run, self.cell.loss), strict=True):
            yield node, x, x + wide
            x += wide + NODE_GAP


class Line(NamedTuple):
    """The middle of a band."""

    band: Band
    width: float
    """Power times scale. [pt]"""
    points: tuple[Point, ...]
    """Corners of what goes back; else ends of what is level, with curves between these."""


class Stub(NamedTuple):
    """A port: where it touches its link."""

    link: Node
    port: EndPort
    width: float
    """[pt]"""
    x: float
    y: float


class Note(NamedTuple):
    """A text of a band or a loop, by its middle."""

    x: float
    y: float
    text: str
    band: Band

    @property
    def loop(self) -> bool:
        """Whether it is told of power that goes round."""
        return self.band.loop is not None

    @property
    def bottom(self) -> float:
        """[pt]."""
        return self.y + height(self.text) / 2


class FlowLayout(NamedTuple):
    """The picture of a gear."""

    width: float
    """[pt]"""
    height: float
    """[pt]"""
    graph: Graph
    boxes: tuple[Box, ...]
    lines: tuple[Line, ...]
    stubs: tuple[Stub, ...]
    notes: tuple[Note, ...]
