"""Where everything stands in an order of the stations: places, spans and levels of links."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import inf
from typing import NamedTuple

from vstatics.pictures.drawing.labels import width
from vstatics.pictures.drawing.style import SIZE
from vstatics.pictures.schemes.axes.board import BESIDE_SET, AxesBoard, StationOrder
from vstatics.pictures.schemes.axes.contacts import AxisContact, contacts, port_contacts

LEVEL = 4.5
"""From a shaft to the hollow one around it. [pt]"""
SIGN_HEIGHT = 13.0
"""From the hollow shafts to the middle of a sign beside them. [pt]"""
DRUM = 7.0
"""From drum to drum. [pt]"""
PORT = 14.0
"""From a port of a hollow shaft to that of the one around it. [pt]"""
HUB = 2.0
"""From a wheel that turns on a shaft to the end of this. [pt]"""
OVERLAP = 0.1
"""Spans that have less in common are one behind the other. [pt]"""


class LinkSpan(NamedTuple):
    """From where to where a link reaches, and how far from its axis [pt]."""

    left: float
    right: float
    height: float
    level: int


class AxesPlaces(NamedTuple):
    """Everything at its place."""

    board: AxesBoard
    chosen: StationOrder
    xs: Sequence[float]
    """Of the middle of each station. [pt]"""
    contacts: Sequence[AxisContact]
    spans: Mapping[int, LinkSpan]
    bases: Mapping[int, float]
    """Of each axis: how far its hollow shafts reach. [pt]"""
    letters: float = 1.0
    """Size of letters over what it is where the picture is not made smaller."""

    def wide(self, text: str, *, size: float = SIZE, bold: bool = False) -> float:
        """The width of a text [pt]."""
        return self.letters * width(text, size, bold=bold)

    def sign_height(self, axis: int) -> float:
        """Of the middle of signs beside shafts [pt]."""
        half = self.board.set_halves[axis]
        return self.bases[axis] + (half + BESIDE_SET if half else SIGN_HEIGHT)

    def port_height(self, link: int) -> float:
        """Over its axis, of the arrow of a port: those of hollow shafts stand apart [pt]."""
        span = self.spans[link]
        if span.level <= 0:
            return span.height
        return self.bases[self.axis_of(link)] + PORT * span.level - 2.0

    def road_end(self, link: int) -> float:
        """Where the road wheel of a link stands [pt]."""
        kinds = ("port", "road")
        return next(one.x for one in self.contacts if one.link == link and one.kind in kinds)

    def axis_of(self, link: int) -> int:
        """The axis of a link."""
        return self.board.axis_of[link]

    def y(self, axis: int, height: float) -> float:
        """Of a height over an axis, toward its side."""
        return self.board.rows.heights[axis] + self.board.rows.sides[axis] * height


def places(board: AxesBoard, chosen: StationOrder) -> AxesPlaces:
    """Where everything stands in an order."""
    xs = _xs(board, chosen.order)
    met = list(contacts(board, chosen, xs))
    met += port_contacts(board, chosen, met)
    ends: dict[int, tuple[float, float]] = {}
    for one in met:
        low, high = ends.get(one.link, (one.x, one.x))
        ends[one.link] = min(low, one.x), max(high, one.x)
    for wheel, shaft in board.idle.items():
        low, high = ends[shaft]
        ends[shaft] = min(low, ends[wheel][0] - HUB), max(high, ends[wheel][1] + HUB)
    spans, bases = {}, {}
    for axis, links in enumerate(board.axes.axes):
        own = [link for link in links if link in ends]
        own.sort(key=lambda link: (link in board.cages, ends[link][0] - ends[link][1], link))
        under, over = _levels(own, ends, chosen.drums)
        bases[axis] = LEVEL * max(under.values(), default=0)
        top = bases[axis] + board.bands[axis]
        for link in own:
            level = under.get(link, over.get(link, 0))
            height = top + DRUM * level if link in over else LEVEL * level
            spans[link] = LinkSpan(*ends[link], height, -1 - level if link in over else level)
    return AxesPlaces(board, chosen, xs, met, spans, bases)


def _levels(
    links: Sequence[int], ends: Mapping[int, tuple[float, float]], drums: frozenset[int]
) -> tuple[dict[int, int], dict[int, int]]:
    """How many shafts are within each, how many drums; long shafts are within short ones."""
    under: dict[int, int] = {}
    over: dict[int, int] = {}
    for link in links:
        if link not in drums:
            under[link] = _next(link, under, ends)
    for link in reversed(links):
        if link in drums:
            over[link] = _next(link, over, ends)
    return under, over


def _next(link: int, levels: dict[int, int], ends: Mapping[int, tuple[float, float]]) -> int:
    left, right = ends[link]
    met = [
        level
        for other, level in levels.items()
        if ends[other][0] < right - OVERLAP and ends[other][1] > left + OVERLAP
    ]
    return max(met, default=-1) + 1


def _xs(board: AxesBoard, order: Sequence[int]) -> list[float]:
    """From the left as close as may be; what stands before all pairs of its row, near these."""
    edges: dict[int, float] = {}
    shared: set[int] = set()
    xs, halves, gap = [0.0] * len(order), board.halves, board.gap
    first: list[int] = []  # what is alone in its row, before all that other rows have part in
    for index in order:
        rows, half = board.occupied[index], halves[index]
        start = 0.0
        for row in rows:
            if edges.get(row, 0.0) > start:
                start = edges[row]
        xs[index] = start + half
        if len(rows) == 1 and rows[0] not in shared:
            first.append(index)
        elif len(rows) > 1:
            shared.update(rows)
        for row in rows:
            edges[row] = start + 2 * half + gap
    starts: dict[int, float] = {}
    for index in reversed(order) if first else ():
        rows, half = board.occupied[index], halves[index]
        if index in first and rows[0] in starts:
            xs[index] = max(xs[index], starts[rows[0]] - gap - half)
        for row in rows:
            starts[row] = min(starts.get(row, inf), xs[index] - half)
    return xs
