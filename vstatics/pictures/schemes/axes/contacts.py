"""Where links meet what stands on their axes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import permutations
from typing import NamedTuple

from vstatics.pictures.schemes.axes.board import AxesBoard, StationOrder
from vstatics.pictures.schemes.axes.stations import CAGE, PACK_PITCH, WHEEL, Station, taps_of
from vstatics.pictures.schemes.glyphs import ABOVE, Glyph, Tap

STUB = 12.0
"""From the last station of a row to the port of a link. [pt]"""
ROAD_RADIUS, ROAD_WHEEL = 21.0, 13.0
"""Of a road wheel; from its middle to that of a wheel of another axis beside it. [pt]"""
EDGE = 3.0
"""From a set to a line that passes beside it. [pt]"""


class AxisContact(NamedTuple):
    """Where a link meets what stands on its axis."""

    link: int
    x: float
    device: int
    """By its place in `Scheme.devices`; -1 of a port."""
    kind: str
    """``wheel``, ``sign``, ``set``, ``bar`` where it is on the link itself, ``port``, ``road`` at a
    road wheel."""
    end: float = 0.0
    """Radius of a wheel; how far from the middle of a set. [pt]"""
    way_round: float = 0.0
    """From the place on a set past its edge, where the link runs on its other side. [pt]"""


def contacts(board: AxesBoard, chosen: StationOrder, xs: Sequence[float]) -> Iterator[AxisContact]:
    """Of all stations; of what has two sides, after all others."""
    first: list[AxisContact] = []
    for index, one in enumerate(board.stations):
        first += _fixed(board, chosen, index, one, xs[index])
    yield from first
    middle: dict[int, list[float]] = {}
    for contact in first:
        middle.setdefault(contact.link, []).append(contact.x)
    sided = [n for n, one in enumerate(board.stations) if one.has_two_sides]
    for index in sided:
        for link in board.stations[index].links:
            middle.setdefault(link, []).append(xs[index])
    for port in board.ports:
        side = 1e4 if port.link in chosen.rightward else -1e4
        middle.setdefault(port.link, []).append(side)
    for index in sided:
        one = board.stations[index]
        left, right = _sides(one.links, xs[index], middle)
        for device in one.devices:
            yield AxisContact(left, xs[index] - one.half, device, "sign")
            yield AxisContact(right, xs[index] + one.half, device, "sign")


def _sides(
    links: Sequence[int], x: float, middle: Mapping[int, Sequence[float]]
) -> tuple[int, int]:
    """Which link comes from the left: one that is there alone, or that is more there."""
    first, second = links
    turn = []
    for link in (first, second):
        others = [one for one in middle[link] if one != x]
        lefts = sum(one < x for one in others)
        ways = 0.0 if not others else (len(others) - 2 * lefts) / len(others)
        turn.append(ways + 1e-6 * sum(min(max(one, -500.0), 500.0) - x for one in others) / 1e3)
    if abs(turn[1]) > abs(turn[0]):  # the second has its place, the first takes the other one
        return (first, second) if turn[1] > 0 else (second, first)
    return (second, first) if turn[0] > 0 else (first, second)


def _fixed(
    board: AxesBoard, chosen: StationOrder, index: int, one: Station, x: float
) -> Iterator[AxisContact]:
    """Contacts whose places do not depend on where the links come from."""
    device = one.devices[0]
    if one.joint is not None:
        yield from _of_pair(one, board.radii[index], x, board.bell(index, chosen.ways[index]))
    elif one.kind == "brake":
        yield AxisContact(one.links[0], x, device, "sign")
    elif one.kind == "box" and not one.has_two_sides:
        for place, link in enumerate(one.links):
            at = x + one.half * (2 * place + 1 - len(one.links)) / len(one.links)
            yield AxisContact(link, at, device, "sign")
    elif one.kind == "drum":
        yield from _of_drum(one, chosen.ways[index], x)
    elif one.kind in ("differential", "section"):
        yield from _of_ends(one, chosen.ways[index], x)
    elif one.kind == "set":
        glyph = one.glyphs[chosen.ways[index]]
        yield from (_of_set(tap, x, glyph, device, chosen.drums) for tap in taps_of(glyph))


def _of_pair(
    one: Station, radii: tuple[float, float, float], x: float, bell: tuple[int, float]
) -> Iterator[AxisContact]:
    """Of both wheels, and of the casing that bears them."""
    device = one.devices[0]
    for place, (link, radius) in enumerate(zip(one.links, radii[::2], strict=True)):
        at = x + (bell[1] if place == bell[0] else 0.0)
        yield AxisContact(link, at - WHEEL, device, "bar")
        yield AxisContact(link, at, device, "wheel", radius)
        yield AxisContact(link, at + WHEEL, device, "bar")
    if one.joint is not None and one.joint.frame:
        yield AxisContact(one.joint.frame, x - one.half, device, "sign")


def _of_ends(one: Station, way: int, x: float) -> Iterator[AxisContact]:
    """Of what has shafts on both sides: a differential, a half-section."""
    if one.layout is not None:
        devices = one.layout.own.scheme.devices
        for link, at in zip(one.links, (x - one.half, x + one.half), strict=True):
            own = (index for index in one.devices if link in devices[index].links)
            yield from (AxisContact(link, at, index, "bar") for index in own)
        return
    *sides, cage = one.links
    left, right = sides[:: -1 if way else 1]
    for link, at in ((left, -CAGE), (right, CAGE), (cage, -CAGE), (cage, CAGE)):
        yield AxisContact(link, x + at, one.devices[0], "bar")


def _of_drum(one: Station, way: int, x: float) -> Iterator[AxisContact]:
    """Of the wall of a drum, and of the shafts under its packs."""
    order = list(permutations(range(len(one.devices))))[way]
    for place, number in enumerate(order):
        yield AxisContact(one.links[0], x - one.half, one.devices[number], "sign")
        at = x + PACK_PITCH * (place - (len(order) - 1) / 2)
        yield AxisContact(one.links[1 + number], at, one.devices[number], "sign")


def port_contacts(
    board: AxesBoard, chosen: StationOrder, contacts: Sequence[AxisContact]
) -> Iterator[AxisContact]:
    """The ends of links that leave their rows."""
    ends = {port.link: port.link in chosen.rightward for port in board.ports}
    for link, differential in board.road_wheels.items():
        cage = board.stations[differential].devices[0]
        middles = [one.x for one in contacts if one.device == cage]
        own = [one.x for one in contacts if one.link == link]
        ends.setdefault(link, min(own) > min(middles) + CAGE)
    ports = {port.link for port in board.ports}
    for link, is_right in ends.items():
        row, way = board.axis_of[link], 1 if is_right else -1
        xs = [way * one.x for one in contacts if board.axis_of[one.link] == row] or [0.0]
        end = max(xs) + STUB
        for x in (
            sorted(_in_the_way(board, contacts, row, way)) if link in board.road_wheels else ()
        ):
            end = x + ROAD_WHEEL if abs(end - x) < ROAD_WHEEL else end
        yield AxisContact(link, way * end, -1, "port" if link in ports else "road")


def _in_the_way(
    board: AxesBoard, contacts: Sequence[AxisContact], row: int, way: int
) -> Iterator[float]:
    """Where wheels of other rows reach to a road wheel of one."""
    heights = board.rows.heights
    for one in contacts:
        distance = abs(heights[board.axis_of[one.link]] - heights[row])
        if one.kind == "wheel" and distance and distance - one.end < ROAD_RADIUS + 3.0:
            yield way * one.x


def _of_set(tap: Tap, x: float, glyph: Glyph, device: int, drums: frozenset[int]) -> AxisContact:
    """Of a member; past the edge of the set where its link runs on the other side."""
    at, half = x - glyph.width / 2 + tap.x, glyph.width / 2 + EDGE
    end = tap.side * tap.depth
    if (tap.side == ABOVE) == (tap.wire in drums):
        return AxisContact(tap.wire, at, device, "set", end)
    edge = x + half if at >= x else x - half
    return AxisContact(tap.wire, edge, device, "set", end, at - edge)
