"""Obstacles for letters: symbols, gears, boxes and lines, each with the cost of covering it."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

from vstatics.pictures.drawing.canvas import Point
from vstatics.pictures.schemes.axes.contacts import ROAD_RADIUS
from vstatics.pictures.schemes.axes.places import AxesPlaces
from vstatics.pictures.schemes.axes.recognition import CROSSED, FAR
from vstatics.pictures.schemes.axes.stations import CAGE, WHEEL, Station
from vstatics.pictures.schemes.axes.wires import link_lines, sign_height
from vstatics.pictures.schemes.coaxial.half_section import CoaxialLayout
from vstatics.pictures.schemes.coaxial.rooms import ends_of, rooms_of

BRAKE_HEIGHT, BOX, SIGN = 19.0, 8.0, 9.0
"""Height of a brake, and half heights of a box and of a symbol. [pt]"""
GROUND = 5.0
"""Height of the hatching of the housing. [pt]"""
CONE = 3.5
"""Slant of the teeth of bevel gears. [pt]"""
CONE_RIM = 9.0
"""Depth of the cone of a crown gear. [pt]"""
HALF_LINE = 1.2
"""Half the width of a line with margins. [pt]"""
ON_SIGN, ON_LINE, IN_SET = 300.0, 150.0, 20.0
"""Costs of a name on a symbol, on a line, and inside a gear set. [pt of distance]"""


class Rectangle(NamedTuple):
    """Rectangle with horizontal and vertical sides [pt]."""

    left: float
    low: float
    right: float
    high: float


class Obstacle(NamedTuple):
    """Area that letters should not cover, with the cost of an overlap."""

    box: Rectangle
    cost: float = ON_SIGN
    device: int = -1
    """Index of the component in `Scheme.devices`; -1 for a line."""


def about(first: Point, second: Point, half: float = HALF_LINE) -> Rectangle:
    """Return the rectangle around a line between two points, with a margin."""
    (x, y), (x2, y2) = first, second
    return Rectangle(min(x, x2) - half, min(y, y2) - half, max(x, x2) + half, max(y, y2) + half)


def obstacles(placing: AxesPlaces) -> Iterator[Obstacle]:
    """Yield the obstacles of links and stations."""
    for number, station in enumerate(placing.board.stations):
        if station.joint is not None:
            yield from _of_pair(placing, number, station)
        elif station.kind == "set":
            yield from _of_set(placing, number, station)
        elif station.layout is not None:
            yield from _of_section(
                station, station.layout, placing.xs[number], placing.y(station.axes[0], 0.0)
            )
        else:
            for device in station.devices:
                box = _box_of(placing, number, station, sign_height(placing, device))
                yield Obstacle(box, device=device)
    for link in placing.board.road_wheels:
        x, y = placing.road_end(link), placing.y(placing.axis_of(link), 0.0)
        yield Obstacle(about((x, y - ROAD_RADIUS), (x, y + ROAD_RADIUS), 5.5))
    for link, lines in link_lines(placing).items():
        span, axis = placing.spans[link], placing.axis_of(link)
        levels = {span.height, -span.height} if span.level > 0 else {span.height}
        for height in levels:
            y = placing.y(axis, height)
            yield Obstacle(about((span.left, y), (span.right, y)), ON_LINE)
        for _, path in lines.upright:
            yield from (Obstacle(about(*piece), ON_LINE) for piece in pairwise(path))


def _of_pair(placing: AxesPlaces, number: int, station: Station) -> Iterator[Obstacle]:
    """Yield the obstacles of the webs and teeth of a gear pair, and of an idler or a chain."""
    x, radii = placing.xs[number], placing.board.radii[number]
    middles = [placing.y(end, 0.0) for end in station.axes]
    webs = placing.board.webs(number, placing.chosen.ways[number])
    kind = station.joint.kind if station.joint is not None else ""
    for y, radius, off in zip(middles, radii[::2], webs, strict=True):
        web = x + off
        yield Obstacle(about((web, y - radius), (web, y + radius)), ON_LINE)
        for rim in (y - radius, y + radius):
            ends = (min(x - WHEEL, web), rim), (max(x + WHEEL, web), rim)
            yield Obstacle(
                about(*ends, CONE_RIM if kind in CROSSED else 3.5 if off else 2.5),
                device=station.devices[0],
            )
    yield Obstacle(
        about((x, middles[0]), (x, middles[1]), 3.5 if kind in FAR else HALF_LINE), ON_LINE
    )
    if radii[1]:
        low = min(middles)
        radius = radii[0] if low == middles[0] else radii[2]
        idler = low + radius, low + radius + 2 * radii[1]
        yield Obstacle(about((x - WHEEL - 2, idler[0]), (x + WHEEL + 2, idler[1]), 2.0))


def _of_set(placing: AxesPlaces, number: int, station: Station) -> Iterator[Obstacle]:
    """Yield the lines and supports of a gear set as obstacles, and the interior at a lower cost."""
    glyph = station.glyphs[placing.chosen.ways[number]]
    at = placing.in_set(number, glyph)
    yield Obstacle(
        about(at(0, -glyph.half), at(glyph.width, glyph.half)), IN_SET, station.devices[0]
    )
    for stroke in glyph.strokes:
        yield from (Obstacle(about(at(*a), at(*b))) for a, b in pairwise(stroke.points))
    for tap in glyph.taps:
        if not tap.wire:
            end = tap.side * (glyph.half + 5)
            yield Obstacle(about(at(tap.x, tap.y), at(tap.x, end)))
            wall = tap.side * (glyph.half + 5 + GROUND)
            yield Obstacle(about(at(tap.x - 9, end), at(tap.x + 9, wall)))


def _of_section(station: Station, layout: CoaxialLayout, x: float, y: float) -> Iterator[Obstacle]:
    """Yield an obstacle for a half-section above the axis, and for each symbol below the axis."""
    low, high = x - station.half, x + station.half
    yield Obstacle(Rectangle(low, y - HALF_LINE, high, y + station.reach[1]))
    origin = low - ends_of(layout)[0]
    for up, at in zip(layout.uprights, layout.places.at, strict=True):
        start = origin + at
        for room in rooms_of(layout, up):
            if room.low < layout.places.axis:
                under, over = (y + by - layout.places.axis for by in (room.low, room.high))
                yield Obstacle(Rectangle(start + room.left, under, start + room.right, over))


def _box_of(placing: AxesPlaces, number: int, station: Station, middle: float) -> Rectangle:
    x, axis, low, high = placing.xs[number], station.axes[0], middle - SIGN, middle + SIGN
    if station.kind == "differential":
        low, high = -CAGE, CAGE
    elif station.kind == "brake":
        low, high = middle, middle + BRAKE_HEIGHT + GROUND
    start, end = x - station.half, x + station.half
    return about((start, placing.y(axis, low)), (end, placing.y(axis, high)), 1.0)
