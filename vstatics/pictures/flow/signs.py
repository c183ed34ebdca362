"""How the nodes, bands and ports of the picture `flow` are drawn."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

from matplotlib.colors import to_hex, to_rgb
from matplotlib.patches import PathPatch, Polygon
from matplotlib.path import Path

from vstatics.flow.circulation import Node
from vstatics.pictures.flow.columns import LOSS_LENGTH, PORT
from vstatics.pictures.flow.places import Box, FlowLayout, Line, Stub
from vstatics.pictures.flow.titles import FlowTitles
from vstatics.pictures.sheet.labels import Paper, Point
from vstatics.pictures.sheet.line_styles import Look
from vstatics.pictures.sheet.style import Style
from vstatics.pictures.sheet.svg import told

VISIBLE = 0.6
"""Width of a band of hardly any power. [pt]"""
ROUND = 6.0
"""Radius of the inner side of a turn. [pt]"""
PALE = 0.75
"""How much of a band that goes round covers what it crosses."""
CURVE_PIECES = 6
"""Straight pieces of a curve of a thin band."""
HATCH = "////"
"""Of what a convention divides, and of what may not be in the metal."""


class FlowPen(NamedTuple):
    """Draws a gear with its upper left corner at a place."""

    paper: Paper
    left: float
    """[pt]"""
    top: float
    """[pt]"""
    titles: FlowTitles
    style: Style

    def draw(self, layout: FlowLayout) -> None:
        """All of a gear."""
        for line in layout.lines:
            self._line(line)
        for stub in layout.stubs:
            self._port(stub)
        for box in layout.boxes:
            self._loss(box)
            self._signs(box, layout)
        for note in layout.notes:
            x, y = self._at((note.x, note.y))
            colour = self.style.circulating if note.loop else self.style.ink
            how = {"ha": "center", "va": "center", "color": colour}
            self.paper.write(x, y, note.text, **how)

    def _at(self, place: Point) -> Point:
        return self.left + place[0], self.top - place[1]

    def _line(self, line: Line) -> None:
        points = [self._at(point) for point in line.points]
        path = _rounded(points, line.width) if line.band.back else _curves(points)
        loop = line.band.loop is not None
        colour = self.style.circulating if loop else self.style.power
        wide = max(line.width, VISIBLE)
        how: dict[str, Any] = {"edgecolor": colour, "facecolor": "none", "joinstyle": "round"}
        how |= {"capstyle": "butt", "alpha": PALE if loop else 1.0}
        how["gid"] = told(self.titles.band(line.band))
        if self.titles.is_divided(line.band) or self.titles.is_doubtful(line.band):
            look = hatched_look(loop_colour(self.style) if loop else colour, self.style)
            self.paper.add(Polygon(_outline(path, wide), gid=how["gid"], **look))
        else:
            self.paper.add(PathPatch(path, linewidth=wide, **how))
        if line.band.back:
            for start, end in (points[1:3], points[3:5]):
                self._arrow(start, end, min(max(line.width / 4, 2.0), 5.0))

    def _arrow(self, start: Point, end: Point, size: float) -> None:
        """Which way something goes round, halfway between a place and that above or below it."""
        x, y = start[0], (start[1] + end[1]) / 2
        tip = math.copysign(size, end[1] - start[1])
        shape = [(x - size, y - tip), (x + size, y - tip), (x, y + tip)]
        self.paper.add(Polygon(shape, color=self.style.circulating, linewidth=0))

    def _port(self, stub: Stub) -> None:
        """A port: the tail of an arrow before its link, or the head of one behind it."""
        x, y = self._at((stub.x, stub.y))
        half = max(stub.width, VISIBLE) / 2
        notch = min(half, PORT - 4)
        if stub.port.enters:
            shape = [(x - PORT, y + half), (x, y + half), (x, y - half), (x - PORT, y - half)]
            shape.append((x - PORT + notch, y))
        else:
            shape = [(x, y + half), (x + PORT - notch, y + half), (x + PORT, y)]
            shape += [(x + PORT - notch, y - half), (x, y - half)]
        title = told(self.titles.port(stub.link, stub.port))
        self.paper.add(Polygon(shape, color=self.style.power, linewidth=0, gid=title))

    def _loss(self, box: Box) -> None:
        if not box.cell.lost:
            return
        middle, low = self._at((box.middle, box.bottom))
        tip = low - LOSS_LENGTH - box.cell.loss / 2
        half = max(box.cell.loss, VISIBLE) / 2
        head = half + 2.5
        shaft = [(middle + half, low), (middle + half, tip + head)]
        outline = [*shaft, (middle + head, tip + head), (middle, tip)]
        outline += [(2 * middle - x, y) for x, y in reversed(outline[:-1])]
        self.paper.add(Polygon(outline, color=self.style.lost, linewidth=0))
        how = {"ha": "center", "va": "top", "color": self.style.lost}
        self.paper.write(middle, tip - 1, box.cell.lost, **how)

    def _signs(self, box: Box, layout: FlowLayout) -> None:
        """The nodes of a run: bars for links, boxes for devices; their names above."""
        cell = box.cell
        signs = list(box.signs())
        for (one, _, left), (other, right, _) in pairwise(signs) if cell.number < 0 else ():
            if not self.titles.divided.isdisjoint([(one, other), (other, one)]):
                look = hatched_look(loop_colour(self.style), self.style)
                self.paper.add(Polygon(self._corners(left, right, box), **look))
        for node, left, right in signs:
            self._sign(node, self._corners(left, right, box), layout)
        x, y = self._at((box.middle, box.top))
        self.paper.write(x, y + 2, cell.text, ha="center", va="bottom", color=self.style.ink)

    def _corners(self, left: float, right: float, box: Box) -> list[Point]:
        places = (left, box.bottom), (left, box.top), (right, box.top), (right, box.bottom)
        return [self._at(place) for place in places]

    def _sign(self, node: Node, shape: Sequence[Point], layout: FlowLayout) -> None:
        style, graph = self.style, layout.graph
        divided = node in self.titles.texts.flow.by_convention
        face = style.ink if node.kind == "link" and not divided else style.paper
        title = self.titles.node(node, graph.through(node), graph.losses.get(node, 0.0))
        how: dict[str, Any] = {"facecolor": face, "edgecolor": style.ink, "linewidth": 0.9}
        how |= {"joinstyle": "round", "hatch": HATCH if divided else None}
        self.paper.add(Polygon(shape, zorder=3, gid=told(title), **how))


def _curves(points: Sequence[Point]) -> Path:
    """Through points, level at each."""
    places, codes = [points[0]], [Path.MOVETO]
    for (left, start), (right, end) in pairwise(points):
        if start == end:
            places.append((right, end))
            codes.append(Path.LINETO)
        else:
            middle = (left + right) / 2
            places += [(middle, start), (middle, end), (right, end)]
            codes += [Path.CURVE4] * 3
    return Path(places, codes)


def _rounded(points: Sequence[Point], wide: float) -> Path:
    """From corner to corner, each as round as there is room."""
    places, codes = [points[0]], [Path.MOVETO]
    last = len(points) - 1
    room = [  # two corners share what is between them
        math.dist(*pair) / (1 if place in (0, last - 1) else 2)
        for place, pair in enumerate(pairwise(points))
    ]
    for place in range(1, last):
        corner = points[place]
        rounding = min(wide / 2 + ROUND, room[place - 1], room[place])
        start, end = (_towards(corner, points[place + step], rounding) for step in (-1, 1))
        places += [start, corner, end]
        codes += [Path.LINETO, Path.CURVE3, Path.CURVE3]
    return Path([*places, points[-1]], [*codes, Path.LINETO])


def _towards(place: Point, other: Point, way: float) -> Point:
    part = way / (math.dist(place, other) or 1.0)
    return place[0] + (other[0] - place[0]) * part, place[1] + (other[1] - place[1]) * part


def loop_colour(style: Style) -> str:
    """Of power that goes round, on paper: as pale as its bands, which show what they cross."""
    own, under = to_rgb(style.circulating), to_rgb(style.paper)
    red, green, blue = (PALE * a + (1 - PALE) * b for a, b in zip(own, under, strict=True))
    return to_hex((red, green, blue))


def hatched_look(colour: str, style: Style) -> Look:
    """Of an area that is divided by convention, or may not be in the metal."""
    return {"facecolor": colour, "edgecolor": style.paper, "linewidth": 0, "hatch": HATCH}


def _flat(path: Path, pieces: int) -> Iterator[Point]:
    """A path in straight pieces, so many of a curve."""
    curves: Any = path.iter_bezier()
    for curve, code in curves:
        if code != Path.MOVETO:
            steps = 1 if code == Path.LINETO else pieces
            for step in range(1, steps + 1):
                x, y = curve(step / steps)
                yield float(x), float(y)
        else:
            x, y = curve(0)
            yield float(x), float(y)


def _outline(path: Path, wide: float) -> list[Point]:
    """The edge of a band by its middle."""
    points = list(_flat(path, round(CURVE_PIECES + wide / 4)))
    sides: tuple[list[Point], list[Point]] = [], []
    for place, (x, y) in enumerate(points):
        before, after = points[max(place - 1, 0)], points[min(place + 1, len(points) - 1)]
        long = math.dist(before, after) or 1.0
        across, up = (after[0] - before[0]) / long, (after[1] - before[1]) / long
        for way, side in zip((wide / 2, -wide / 2), sides, strict=True):
            side.append((round(x - way * up, 1), round(y + way * across, 1)))
    return [*sides[0], *reversed(sides[1])]
