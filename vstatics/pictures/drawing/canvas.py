"""Canvas: lines, areas and texts of a picture in their order, without a file format.

`svg` writes a canvas as SVG, `figures` as a figure of matplotlib for PNG and PDF.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

from vstatics.core.numerics.arrays import Floats
from vstatics.pictures.drawing.style import Style

Point = tuple[float, float]
"""Horizontal and vertical coordinate of a point of a picture. [pt]"""
Look = dict[str, Any]
"""Properties of a line, area or text as keyword arguments of matplotlib."""


class MarkGroup(NamedTuple):
    """Group of related lines, areas and texts in SVG: ``<g class="link" data-name="sun">``."""

    kind: str
    """CSS class of the SVG group."""
    data: tuple[tuple[str, str], ...]
    """Attributes ``data-...`` of the SVG group, as pairs of name and value."""

    @property
    def attributes(self) -> dict[str, str]:
        """Attributes of the SVG element."""
        return {"class": self.kind, **as_attributes(dict(self.data))}


def as_attributes(data: Mapping[str, str]) -> dict[str, str]:
    """Return attributes ``data-...`` of SVG; an underscore in a name becomes a hyphen.

    >>> as_attributes({"left_out": "[]"})
    {'data-left-out': '[]'}
    """
    return {f"data-{key.replace('_', '-')}": value for key, value in data.items()}


class PartMark(NamedTuple):
    """SVG data of a line, area or text: tooltip, class, attributes and enclosing groups."""

    title: str = ""
    """Tooltip and alternative text."""
    kind: str = ""
    """CSS class of the SVG path or text."""
    data: Mapping[str, str] = {}
    """Attributes ``data-...`` of an SVG path or text with a class, otherwise of the SVG group."""
    groups: tuple[MarkGroup, ...] = ()
    """Enclosing SVG groups, the outermost first. A group is drawn together with its first member.
    """


class CanvasPlace(NamedTuple):
    """Transformation from local coordinates to the canvas: a scale, and an offset in points."""

    part: float = 1.0
    left: float = 0.0
    low: float = 0.0

    def of(self, x: float, y: float) -> Point:
        """Return the coordinates on the canvas of a point in local coordinates.

        >>> CanvasPlace(0.5, 10.0, 20.0).of(2.0, 4.0)
        (11.0, 22.0)
        """
        return self.left + self.part * x, self.low + self.part * y

    def within(self, outer: CanvasPlace) -> CanvasPlace:
        """Combine the transformation with a subsequent transformation `outer`.

        >>> CanvasPlace(2.0, 1.0, 0.0).within(CanvasPlace(0.5, 10.0, 20.0))
        CanvasPlace(part=1.0, left=10.5, low=20.0)
        """
        return CanvasPlace(outer.part * self.part, *outer.of(self.left, self.low))


class Outline(NamedTuple):
    """Path of straight lines and Bézier curves."""

    points: Sequence[Point] | Floats
    steps: str
    """SVG path letter of each step: M, L, Q (two points), C (three points), z (no point)."""

    @classmethod
    def polygon(cls, corners: Sequence[Point]) -> Outline:
        """Return a closed path of straight lines through corners."""
        return cls([*corners, corners[0]], f"M{'L' * (len(corners) - 1)}z")

    def flattened(self, pieces: int) -> list[Point]:
        """Return points along the path, with each curve replaced by a number of straight lines.

        >>> Outline([(0.0, 0.0), (1.0, 2.0), (2.0, 0.0)], "MQQ").flattened(2)
        [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)]
        """
        points: list[Point] = []
        at = 0
        while at < len(self.steps):
            degree = {"Q": 2, "C": 3}.get(self.steps[at], 1)
            ends = [*points[-1:], *self.points[at : at + degree]]
            parts = [step / pieces for step in range(1, pieces + 1)] if degree > 1 else [1.0]
            points += [_on_curve(ends, part) for part in parts]
            at += degree
        return points


def _on_curve(ends: Sequence[Point], part: float) -> Point:
    """Return the point at a parameter from 0 to 1 of a Bézier curve (algorithm of de Casteljau)."""
    while len(ends) > 1:
        ends = [(x + part * (x2 - x), y + part * (y2 - y)) for (x, y), (x2, y2) in pairwise(ends)]
    return ends[0]


class CanvasLine(NamedTuple):
    """Line through points. A point with NaN coordinates is a gap."""

    xs: Sequence[float] | Floats
    ys: Sequence[float] | Floats
    look: Look
    order: float
    """Drawing order: higher orders are drawn later, equal orders in the order of addition."""
    clip: tuple[Point, Point] | None = None
    """Corner and size of the rectangle within which the line is visible."""


class CanvasArea(NamedTuple):
    """Filled path."""

    outline: Outline
    look: Look
    order: float


class CanvasText(NamedTuple):
    """Text at a point."""

    at: Point
    text: str
    look: Look
    size: float
    is_bold: bool
    has_halo: bool
    """True to draw a border in the colour of the paper around the letters."""
    order: float


class CanvasPart(NamedTuple):
    """Line, area or text of a canvas, with the transformation and SVG data."""

    shape: CanvasLine | CanvasArea | CanvasText
    place: CanvasPlace
    mark: PartMark


class Canvas(NamedTuple):
    """Picture on a page: lines, areas and texts."""

    size: Point
    """Width and height. [pt]"""
    style: Style
    parts: list[CanvasPart]
    data: dict[str, str]
    """Attributes ``data-...`` of the picture in SVG."""

    @property
    def texts(self) -> list[str]:
        """Texts of the picture in the order of insertion."""
        return [part.shape.text for part in self.parts if isinstance(part.shape, CanvasText)]

    @property
    def ordered(self) -> list[CanvasPart]:
        """Lines, areas and texts by ascending `order`; at equal `order`, texts are last."""
        return sorted(
            self.parts, key=lambda part: (part.shape.order, isinstance(part.shape, CanvasText))
        )
