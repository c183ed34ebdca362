"""What letters keep clear of: signs, wheels, boxes, the lines of links, each by what it costs."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

from vstatics.pictures.drawing.labels import Point
from vstatics.pictures.schemes.axes.contacts import ROAD_RADIUS
from vstatics.pictures.schemes.axes.places import AxesPlaces
from vstatics.pictures.schemes.axes.recognition import CROSSED, FAR
from vstatics.pictures.schemes.axes.stations import CAGE, PACK_PITCH, WHEEL, Station
from vstatics.pictures.schemes.axes.wires import link_lines, sign_height
from vstatics.pictures.schemes.coaxial.half_section import CoaxialLayout
from vstatics.pictures.schemes.coaxial.rooms import ends_of, rooms_of

BRAKE, ROOF, BOX, SIGN = 19.0, 22.0, 8.0, 9.0
"""Heights: of a brake and of a drum over the middle of signs, half of a box, of a sign. [pt]"""
GROUND = 5.0
"""Height of the hatching of the housing. [pt]"""
CONE = 3.5
"""How much teeth of bevel wheels are slanted. [pt]"""
CONE_RIM = 9.0
"""How deep the cone of a large one is drawn. [pt]"""
HALF_LINE = 1.2
"""Half of what a line takes, with what is clear beside it. [pt]"""
ON_SIGN, ON_LINE, IN_SET = 300.0, 150.0, 20.0
"""What a name costs that covers one, in points by which it may stand away instead."""


class Rectangle(NamedTuple):
    """By its corners [pt]."""

    left: float
    low: float
    right: float
    high: float


class Obstacle(NamedTuple):
    """What letters should not cover."""

    box: Rectangle
    cost: float = ON_SIGN
    device: int = -1
    """Whose it is, by its place in `Scheme.devices`; -1 of lines."""


def about(one: Point, other: Point, half: float = HALF_LINE) -> Rectangle:
    """The box about a line."""
    (x, y), (x2, y2) = one, other
    return Rectangle(min(x, x2) - half, min(y, y2) - half, max(x, x2) + half, max(y, y2) + half)


def obstacles(found: AxesPlaces) -> Iterator[Obstacle]:
    """All that is drawn of links and of what stands on the axes."""
    for number, one in enumerate(found.board.stations):
        if one.joint is not None:
            yield from _of_pair(found, number, one)
        elif one.kind == "set":
            yield from _of_set(found, number, one)
        elif one.layout is not None:
            yield from _of_section(one, one.layout, found.xs[number], found.y(one.axes[0], 0.0))
        else:
            for device in one.devices:
                box = _box_of(found, number, one, sign_height(found, device))
                yield Obstacle(box, device=device)
    for link in found.board.road_wheels:
        x, y = found.road_end(link), found.y(found.axis_of(link), 0.0)
        yield Obstacle(about((x, y - ROAD_RADIUS), (x, y + ROAD_RADIUS), 5.5))
    for link, lines in link_lines(found).items():
        span, axis = found.spans[link], found.axis_of(link)
        levels = {span.height, -span.height} if span.level > 0 else {span.height}
        for height in levels:
            y = found.y(axis, height)
            yield Obstacle(about((span.left, y), (span.right, y)), ON_LINE)
        for _, path in lines.upright:
            yield from (Obstacle(about(*piece), ON_LINE) for piece in pairwise(path))


def _of_pair(found: AxesPlaces, number: int, one: Station) -> Iterator[Obstacle]:
    """Webs and rims, and what is between the wheels."""
    x, radii = found.xs[number], found.board.radii[number]
    middles = [found.y(own, 0.0) for own in one.axes]
    bell, off = found.board.bell(number, found.chosen.ways[number])
    is_far = one.joint is not None and one.joint.kind in FAR
    is_crossed = one.joint is not None and one.joint.kind in CROSSED
    for place, (y, radius) in enumerate(zip(middles, radii[::2], strict=True)):
        web = x + (off if place == bell else 0.0)
        yield Obstacle(about((web, y - radius), (web, y + radius)), ON_LINE)
        for rim in (y - radius, y + radius):
            ends = (min(x - WHEEL, web), rim), (max(x + WHEEL, web), rim)
            yield Obstacle(
                about(*ends, CONE_RIM if is_crossed else 3.5 if off else 2.5),
                device=one.devices[0],
            )
    yield Obstacle(about((x, middles[0]), (x, middles[1]), 3.5 if is_far else HALF_LINE), ON_LINE)
    if radii[1]:
        low = min(middles)
        radius = radii[0] if low == middles[0] else radii[2]
        idler = low + radius, low + radius + 2 * radii[1]
        yield Obstacle(about((x - WHEEL - 2, idler[0]), (x + WHEEL + 2, idler[1]), 2.0))


def _of_set(found: AxesPlaces, number: int, one: Station) -> Iterator[Obstacle]:
    """Its lines, what holds a member, and, dear to a lesser degree, what is between them."""
    axis, glyph = one.axes[0], one.glyphs[found.chosen.ways[number]]
    left, middle = found.xs[number] - glyph.width / 2, found.sign_height(axis)

    def at(x: float, y: float) -> Point:
        return left + x, found.y(axis, middle + y)

    yield Obstacle(about(at(0, -glyph.half), at(glyph.width, glyph.half)), IN_SET, one.devices[0])
    for stroke in glyph.strokes:
        yield from (Obstacle(about(at(*a), at(*b))) for a, b in pairwise(stroke.points))
    for tap in glyph.taps:
        if tap.reach == "none":
            end = tap.side * (glyph.half + 5)
            yield Obstacle(about(at(tap.x, tap.side * tap.depth), at(tap.x, end)))
            wall = tap.side * (glyph.half + 5 + GROUND)
            yield Obstacle(about(at(tap.x - 9, end), at(tap.x + 9, wall)))


def _of_section(one: Station, layout: CoaxialLayout, x: float, y: float) -> Iterator[Obstacle]:
    """All over its axis, and the names under it."""
    low, high = x - one.half, x + one.half
    yield Obstacle(Rectangle(low, y - HALF_LINE, high, y + one.reach[1]))
    for up, at in zip(layout.uprights, layout.places.at, strict=True):
        start = low + at - ends_of(layout)[0]
        for room in rooms_of(layout, up):
            if room.low < layout.places.axis:
                under, over = (y + by - layout.places.axis for by in (room.low, room.high))
                yield Obstacle(Rectangle(start + room.left, under, start + room.right, over))


def _box_of(found: AxesPlaces, number: int, one: Station, middle: float) -> Rectangle:
    x, axis, low, high = found.xs[number], one.axes[0], middle - SIGN, middle + SIGN
    if one.kind == "differential":
        low, high = -CAGE, CAGE
    elif one.kind == "brake":
        low, high = middle, middle + BRAKE + GROUND
    elif one.kind == "drum":
        low, high = middle, middle + ROOF
    half = PACK_PITCH * len(one.devices) / 2 + 2 if one.kind == "drum" else one.half
    return about((x - half, found.y(axis, low)), (x + half, found.y(axis, high)), 1.0)
