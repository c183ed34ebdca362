"""Positions of stations (components on the axes), contacts and links for an order."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from math import inf
from typing import NamedTuple

from vstatics.pictures.drawing.canvas import Point
from vstatics.pictures.drawing.labels import width
from vstatics.pictures.drawing.style import SIZE
from vstatics.pictures.schemes.axes.board import BESIDE_SET, AxesBoard, StationOrder
from vstatics.pictures.schemes.axes.contacts import AxisContact, contacts, port_contacts
from vstatics.pictures.schemes.gear_glyphs import Glyph

LEVEL = 4.5
"""Distance from the line of a shaft to the line of the surrounding hollow shaft. [pt]"""
SIGN_HEIGHT = 13.0
"""Distance from the outermost hollow shaft to the middle of a symbol. [pt]"""
DRUM = 7.0
"""Distance between nested drums. [pt]"""
PORT_PITCH = 14.0
"""Distance between the arrows of nested hollow shafts. [pt]"""
HUB = 2.0
"""Length by which a shaft extends beyond a gear that rotates freely on the shaft. [pt]"""
SPAN_OVERLAP = 0.1
"""Overlap up to which two spans count as separate. [pt]"""


class LinkSpan(NamedTuple):
    """Extent of a link along the axis, with the distance from the axis [pt]."""

    left: float
    right: float
    height: float
    level: int


class AxesPlaces(NamedTuple):
    """Positions of axes, stations and links of a diagram."""

    board: AxesBoard
    chosen: StationOrder
    xs: Sequence[float]
    """Horizontal position of the middle of each station. [pt]"""
    contacts: Sequence[AxisContact]
    spans: Mapping[int, LinkSpan]
    bases: Mapping[int, float]
    """Height of the outermost hollow shaft of each axis. [pt]"""
    letters: float = 1.0
    """Ratio of the size of letters to lengths; above 1 in a reduced picture. [-]"""

    def wide(self, text: str, *, size: float = SIZE, bold: bool = False) -> float:
        """Return the width of a text [pt]."""
        return self.letters * width(text, size, bold=bold)

    def sign_height(self, axis: int) -> float:
        """Return the height above an axis of the middle of symbols next to shafts [pt]."""
        half = self.board.set_halves[axis]
        return self.bases[axis] + (half + BESIDE_SET if half else SIGN_HEIGHT)

    def port_height(self, link: int) -> float:
        """Return the height of the arrow of a link above the axis; nested shafts differ [pt]."""
        span = self.spans[link]
        if span.level <= 0:  # the line of a drum at the input begins at the axis
            return span.height * (link not in self.board.entry)
        return self.bases[self.axis_of(link)] + PORT_PITCH * span.level - 2.0

    def end_of(self, link: int) -> tuple[float, float, int]:
        """Return the start of the arrow of a link [pt], and the direction: 1 right, -1 left."""
        span = self.spans[link]
        x, way = (span.right, 1) if link in self.chosen.rightward else (span.left, -1)
        return x, self.y(self.axis_of(link), self.port_height(link)), way

    def road_end(self, link: int) -> float:
        """Return the horizontal position of the road wheel of a link [pt]."""
        kinds = ("port", "road")
        return next(
            contact.x for contact in self.contacts if contact.link == link and contact.kind in kinds
        )

    def axis_of(self, link: int) -> int:
        """Return the index of the axis of a link."""
        return self.board.axis_of[link]

    def y(self, axis: int, height: float) -> float:
        """Return the vertical position of a point at a height on the drawn side of an axis [pt]."""
        return self.board.rows.heights[axis] + self.board.rows.sides[axis] * height

    def in_set(self, number: int, glyph: Glyph) -> Callable[[float, float], Point]:
        """Return the conversion of distances in the symbol of a gear set to points [pt]."""
        axis = self.board.stations[number].axes[0]
        left, middle = self.xs[number] - glyph.width / 2, self.sign_height(axis)
        return lambda x, y: (left + x, self.y(axis, middle + y))


def places(board: AxesBoard, chosen: StationOrder) -> AxesPlaces:
    """Return the positions of axes, stations and links for an order of the stations."""
    xs = _xs(board, chosen.order)
    meetings = list(contacts(board, chosen, xs))
    meetings += port_contacts(board, chosen, meetings)
    ends: dict[int, tuple[float, float]] = {}
    for contact in meetings:
        low, high = ends.get(contact.link, (contact.x, contact.x))
        ends[contact.link] = min(low, contact.x), max(high, contact.x)
    for wheel, shaft in board.idle.items():
        low, high = ends[shaft]
        ends[shaft] = min(low, ends[wheel][0] - HUB), max(high, ends[wheel][1] + HUB)
    spans, bases = {}, {}
    for axis, links in enumerate(board.axes.axes):
        axis_links = [link for link in links if link in ends]
        axis_links.sort(key=lambda link: (link in board.cages, ends[link][0] - ends[link][1], link))
        under = _levels([link for link in axis_links if link not in chosen.drums], ends)
        over = _levels([link for link in axis_links[::-1] if link in chosen.drums], ends)
        bases[axis] = LEVEL * max(under.values(), default=0)
        top = bases[axis] + board.bands[axis]
        for link in axis_links:
            level = under.get(link, over.get(link, 0))
            height = top + DRUM * level if link in over else LEVEL * level
            spans[link] = LinkSpan(*ends[link], height, -1 - level if link in over else level)
    return AxesPlaces(board, chosen, xs, meetings, spans, bases)


def _levels(links: Iterable[int], ends: Mapping[int, tuple[float, float]]) -> dict[int, int]:
    """Return the nesting level of each shaft or drum, 0 for the innermost.

    Of overlapping shafts, the longer one is inside.
    """
    levels: dict[int, int] = {}
    for link in links:
        left, right = ends[link]
        taken = [
            level
            for placed, level in levels.items()
            if ends[placed][0] < right - SPAN_OVERLAP and ends[placed][1] > left + SPAN_OVERLAP
        ]
        levels[link] = max(taken, default=-1) + 1
    return levels


def _xs(board: AxesBoard, order: Sequence[int]) -> list[float]:
    """Return the horizontal position of each station, as far left as possible.

    Stations in front of the first gear pair of an axis then move right, next to that pair.
    """
    edges: dict[int, float] = {}
    shared: set[int] = set()
    xs, gap = [0.0] * len(order), board.gap
    first: list[int] = []  # stations on one axis only, before any station that several axes share
    for index in order:
        rows, half = board.occupied[index], board.stations[index].half
        start = 0.0
        for row in rows:
            if edges.get(row, 0.0) > start:
                start = edges[row]
        xs[index] = start + half
        if len(rows) > 1:
            shared |= rows
        elif rows.isdisjoint(shared):
            first.append(index)
        for row in rows:
            edges[row] = start + 2 * half + gap
    starts: dict[int, float] = {}
    for index in reversed(order) if first else ():
        rows, half = board.occupied[index], board.stations[index].half
        for row in rows & starts.keys() if index in first else ():
            xs[index] = max(xs[index], starts[row] - gap - half)
        for row in rows:
            starts[row] = min(starts.get(row, inf), xs[index] - half)
    return xs
