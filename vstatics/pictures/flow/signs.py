"""Drawing of the nodes, bands and ports of a power flow."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

from vstatics.pictures.drawing.canvas import Look, Outline, Point
from vstatics.pictures.drawing.line_styles import mixed
from vstatics.pictures.drawing.pen import Pen
from vstatics.pictures.drawing.style import SIZE, Style
from vstatics.pictures.flow.columns import LOSS_LENGTH, PORT_ARROW
from vstatics.pictures.flow.graph import Graph
from vstatics.pictures.flow.places import Box, FlowLayout, Line, Stub
from vstatics.pictures.flow.titles import FlowTitles

LEAST_BAND_WIDTH = 0.6
"""Smallest width at which a band is drawn. [pt]"""
TURN_RADIUS = 6.0
"""Radius of the inner side of a turn. [pt]"""
BAND_COVER = 0.75
"""Opacity of a band of recirculating power drawn over other bands and nodes. [-]"""
CURVE_PIECES = 6
"""Number of straight lines that replace the curve of a thin band."""
HATCH = "////"
"""Hatching of power that is divided by convention, and of possible artefacts of the model."""
MILD_HATCH = "...."
"""Hatching of power that is divided by the ratio except for a small part due to friction."""


class FlowView(NamedTuple):
    """Tool that draws the power flow of a gear, with the upper left corner at (`left`, `top`)."""

    pen: Pen
    left: float
    """Left edge in the figure. [pt]"""
    top: float
    """Upper edge in the figure. [pt]"""
    titles: FlowTitles

    def draw(self, layout: FlowLayout) -> None:
        """Draw the bands, nodes, ports and texts of a layout."""
        style = self.pen.style
        for line in layout.lines:
            self._line(line)
        for stub in layout.stubs:
            self._port(stub)
        self._dots([stub for stub in layout.stubs if stub.port.cut is not None])
        for box in layout.boxes:
            if box.cell.lost:
                self._loss(box)
            self._signs(box, layout.graph)
        for note in layout.notes:
            colour = style.circulating if note.loop else style.ink
            at = self._at((note.x, note.y))
            self.pen.text(*at, note.text, ha="center", va="center", color=colour)

    def _at(self, place: Point) -> Point:
        return self.left + place[0], self.top - place[1]

    def _line(self, line: Line) -> None:
        pen, style, band = self.pen, self.pen.style, line.band
        points = [*map(self._at, line.points)]
        is_hatched = self.titles.is_divided(band) or self.titles.is_doubtful(band)
        path = _rounded(points, line.width) if band.back else _curves(points)
        said, wide = self.titles.band(band), max(line.width, LEAST_BAND_WIDTH)
        pale, colour, alpha = loop_colour(style), style.circulating, BAND_COVER
        if band.loop is None:
            pale, colour, alpha = style.power, style.power, 1.0
        if is_hatched:
            pen.area(*_outline(path, wide), title=said, **hatched_look(pale, style))
        else:
            look: Look = {"edgecolor": colour, "facecolor": "none", "alpha": alpha}
            pen.fill(path, width=wide, title=said, joinstyle="round", **look)
        for (x, start), (_, end) in (points[1:3], points[3:5]) if band.back else ():
            y, size = (start + end) / 2, min(max(line.width / 4, 2.0), 5.0)
            tip = math.copysign(size, end - start)  # the arrow shows the direction of circulation
            shape = (x - size, y - tip), (x + size, y - tip), (x, y + tip)
            pen.area(*shape, color=style.circulating)

    def _port(self, stub: Stub) -> None:
        """Draw an input port as an arrow before the link, an output port after the link."""
        x, y = self._at((stub.x, stub.y))
        half = max(stub.width, LEAST_BAND_WIDTH) / 2
        notch = min(half, PORT_ARROW - 4)
        start, tail, tip = (x - PORT_ARROW, notch, 0.0) if stub.port.enters else (x, 0.0, notch)
        end = start + PORT_ARROW
        shape = [(start + tail, y), (start, y + half), (end - tip, y + half), (end, y)]
        shape += [(end - tip, y - half), (start, y - half)]
        said = self.titles.port(stub.link, stub.port)
        self.pen.area(*shape, color=self.pen.style.power, title=said)

    def _dots(self, stubs: Sequence[Stub]) -> None:
        """Draw dots where bands are cut, once for neighbouring bands."""
        dotted: list[Point] = []
        for stub in stubs:
            way, ha = (-1, "right") if stub.port.enters else (1, "left")
            x, y = self._at((stub.x + way * (PORT_ARROW + 2), stub.y))
            if not any(abs(x - left) < 2 * SIZE and abs(y - low) < SIZE for left, low in dotted):
                dotted.append((x, y))
                self.pen.text(x, y, "…", ha=ha, va="center_baseline")

    def _loss(self, box: Box) -> None:
        middle, low = self._at((box.middle, box.bottom))
        tip, lost = low - LOSS_LENGTH - box.cell.loss / 2, self.pen.style.lost
        half = max(box.cell.loss, LEAST_BAND_WIDTH) / 2
        head = half + 2.5
        side = [(middle + half, low), (middle + half, tip + head), (middle + head, tip + head)]
        other = [(2 * middle - x, y) for x, y in reversed(side)]
        self.pen.area(*side, (middle, tip), *other, color=lost)
        self.pen.text(middle, tip - 1, box.cell.lost, ha="center", va="top", color=lost)

    def _signs(self, box: Box, graph: Graph) -> None:
        """Draw the nodes of a run, with names above: bars for links, rectangles for components."""
        cell, style, signs = box.cell, self.pen.style, list(box.signs())
        for (before, _, left), (after, right, _) in pairwise(signs) if cell.number < 0 else ():
            if not self.titles.divided.isdisjoint([(before, after), (after, before)]):
                look = hatched_look(loop_colour(style), style)
                self.pen.area(*self._corners(left, right, box), **look)
        for node, left, right in signs:
            divided = self.titles.is_open(node)
            hatch = MILD_HATCH if self.titles.is_mild(node) else HATCH
            face = style.ink if node.kind == "link" and not divided else style.paper
            powers = graph.through(node), graph.losses.get(node, 0.0)
            said = self.titles.node(node, *powers)
            look = {"facecolor": face, "edgecolor": style.ink, "joinstyle": "round", "zorder": 3}
            look["hatch"] = hatch if divided else None
            self.pen.area(*self._corners(left, right, box), width=0.9, title=said, **look)
        x, y = self._at((box.middle, box.top))
        self.pen.text(x, y + 2, cell.text, ha="center", va="bottom")

    def _corners(self, left: float, right: float, box: Box) -> Iterator[Point]:
        places = (left, box.bottom), (left, box.top), (right, box.top), (right, box.bottom)
        return map(self._at, places)


def _curves(points: Sequence[Point]) -> Outline:
    """Return a smooth curve through points, horizontal at each point."""
    places, steps = [points[0]], "M"
    for (left, start), (right, end) in pairwise(points):
        if start == end:
            places.append((right, end))
            steps += "L"
        else:
            middle = (left + right) / 2
            places += [(middle, start), (middle, end), (right, end)]
            steps += "CCC"
    return Outline(places, steps)


def _rounded(points: Sequence[Point], wide: float) -> Outline:
    """Return a path with corners rounded as far as the distances permit."""
    places, steps = [points[0]], "M"
    last = len(points) - 1
    room = [  # two neighbouring corners share the distance between them
        math.dist(*pair) / (1 if place in (0, last - 1) else 2)
        for place, pair in enumerate(pairwise(points))
    ]
    for place in range(1, last):
        corner = points[place]
        rounding = min(wide / 2 + TURN_RADIUS, room[place - 1], room[place])
        start, end = (_towards(corner, points[place + step], rounding) for step in (-1, 1))
        places += [start, corner, end]
        steps += "LQQ"
    return Outline([*places, points[-1]], f"{steps}L")


def _towards(place: Point, other: Point, way: float) -> Point:
    part = way / (math.dist(place, other) or 1.0)
    return place[0] + (other[0] - place[0]) * part, place[1] + (other[1] - place[1]) * part


def loop_colour(style: Style) -> str:
    """Return the opaque colour that equals a transparent band of recirculating power."""
    return mixed(style.circulating, style.paper, BAND_COVER)


def hatched_look(colour: str, style: Style) -> Look:
    """Return the style of areas of power divided by convention, or of possible model artefacts."""
    return {"facecolor": colour, "edgecolor": style.paper, "hatch": HATCH}


def _outline(path: Outline, wide: float) -> list[Point]:
    """Return the outline of a band of a width [pt] along a centre line, as straight lines."""
    points = path.flattened(round(CURVE_PIECES + wide / 4))
    sides: tuple[list[Point], list[Point]] = [], []
    for place, (x, y) in enumerate(points):
        before, after = points[max(place - 1, 0)], points[min(place + 1, len(points) - 1)]
        long = math.dist(before, after) or 1.0
        across, up = (after[0] - before[0]) / long, (after[1] - before[1]) / long
        for way, side in zip((wide / 2, -wide / 2), sides, strict=True):
            side.append((round(x - way * up, 1), round(y + way * across, 1)))
    return [*sides[0], *reversed(sides[1])]
