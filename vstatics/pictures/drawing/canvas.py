"""Canvas: lines, areas and texts of a picture in their order, without a file format.

`svg` writes a canvas as SVG, `figures` as a figure of matplotlib for PNG and PDF.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

from vstatics.core.numerics.arrays import Floats
from vstatics.pictures.drawing.style import SIZE, Style

Point = tuple[float, float]
"""Point of a picture. [pt]"""
Look = dict[str, Any]
"""Properties of a line, area or text as keyword arguments of matplotlib."""


class MarkGroup(NamedTuple):
    """Group of related parts in SVG: ``<g class="link" data-name="sun">``."""

    kind: str
    """Class of the group."""
    data: tuple[tuple[str, str], ...] = ()
    """Attributes ``data-...``."""

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
    """Additional data of a line, area or text for SVG."""

    title: str = ""
    """Text that appears under the pointer, and is the alternative text."""
    kind: str = ""
    """Class of the path or text."""
    data: Mapping[str, str] = {}
    """Attributes ``data-...`` of the path or text if it has a class, otherwise of its group."""
    groups: tuple[MarkGroup, ...] = ()
    """Groups, the outermost first; a group is at the place of its first part."""


class CanvasPlace(NamedTuple):
    """Scale, and offset in points, from the coordinates of a part to the canvas."""

    part: float = 1.0
    left: float = 0.0
    low: float = 0.0

    def of(self, x: float, y: float) -> Point:
        """Return the place of a point on the canvas.

        >>> CanvasPlace(0.5, 10.0, 20.0).of(2.0, 4.0)
        (11.0, 22.0)
        """
        return self.left + self.part * x, self.low + self.part * y

    def within(self, outer: CanvasPlace) -> CanvasPlace:
        """Return the place of a part whose coordinates are placed in another place.

        >>> CanvasPlace(2.0, 1.0, 0.0).within(CanvasPlace(0.5, 10.0, 20.0))
        CanvasPlace(part=1.0, left=10.5, low=20.0)
        """
        return CanvasPlace(outer.part * self.part, *outer.of(self.left, self.low))


class Outline(NamedTuple):
    """Path of straight lines and Bézier curves."""

    points: Sequence[Point] | Floats
    steps: str
    """Letter of SVG for each point: M, L, Q for two points, C for three points, z."""

    @classmethod
    def polygon(cls, corners: Sequence[Point]) -> Outline:
        """Return a closed path through corners."""
        return cls([*corners, corners[0]], f"M{'L' * (len(corners) - 1)}z")

    def flattened(self, pieces: int) -> list[Point]:
        """Return points along the path, with each curve in a number of straight pieces.

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
    """Return a point of a Bézier curve by repeated division of its sides (de Casteljau)."""
    while len(ends) > 1:
        ends = [(x + part * (x2 - x), y + part * (y2 - y)) for (x, y), (x2, y2) in pairwise(ends)]
    return ends[0]


class CanvasLine(NamedTuple):
    """Line through points, with gaps at NaN."""

    xs: Sequence[float] | Floats
    ys: Sequence[float] | Floats
    look: Look
    order: float = 2.0
    """Parts of higher order are drawn later, parts of equal order as they were added."""
    clip: tuple[Point, Point] | None = None
    """Corner and size of the rectangle within which the line is visible."""


class CanvasArea(NamedTuple):
    """Filled path."""

    outline: Outline
    look: Look
    order: float = 1.0


class CanvasText(NamedTuple):
    """Text at a point."""

    at: Point
    text: str
    look: Look
    size: float = SIZE
    is_bold: bool = False
    has_halo: bool = False
    """True for paper around the letters."""
    order: float = 3.0


class CanvasPart(NamedTuple):
    """Line, area or text of a canvas."""

    shape: CanvasLine | CanvasArea | CanvasText
    place: CanvasPlace
    mark: PartMark


class Canvas(NamedTuple):
    """Parts of a picture on a page."""

    size: Point
    """Width and height. [pt]"""
    style: Style
    parts: list[CanvasPart]
    data: dict[str, str]
    """Attributes ``data-...`` of the picture in SVG."""

    @property
    def texts(self) -> list[str]:
        """Texts in the order in which they were added."""
        return [part.shape.text for part in self.parts if isinstance(part.shape, CanvasText)]

    @property
    def ordered(self) -> list[CanvasPart]:
        """Parts in the order in which they are drawn; texts follow lines of equal order."""
        return sorted(
            self.parts, key=lambda part: (part.shape.order, isinstance(part.shape, CanvasText))
        )
