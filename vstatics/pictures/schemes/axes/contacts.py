"""Contacts: the points where the lines of links meet stations (components on the axes)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from vstatics.core.groups import grouped
from vstatics.pictures.schemes.axes.board import AxesBoard, StationOrder
from vstatics.pictures.schemes.axes.stations import CAGE, WHEEL, Station
from vstatics.pictures.schemes.gear_glyphs import ABOVE, Glyph, Tap

STUB = 12.0
"""Distance from the last station of an axis to the input or output of a link. [pt]"""
ROAD_RADIUS, ROAD_WHEEL = 21.0, 13.0
"""Radius of a road wheel, and distance from the wheel centre to a neighbouring gear. [pt]"""
EDGE = 3.0
"""Distance from a gear set to a passing line. [pt]"""


class AxisContact(NamedTuple):
    """Point where the line of a link meets a station."""

    link: int
    x: float
    device: int
    """Index of the component in `Scheme.devices`; -1 for an input or output."""
    kind: str
    """Kind of contact: ``wheel`` (gear), ``sign`` (symbol), ``set`` (gear set), ``port`` (input or
    output), ``bar`` (symbol on the line of the link), or ``road`` (road wheel).
    """
    end: float = 0.0
    """Radius of the gear, or distance of the contact from the middle of the gear set. [pt]"""
    way_round: float = 0.0
    """Distance along the axis from `x` to the member, for a line around the gear set. [pt]"""


def contacts(board: AxesBoard, chosen: StationOrder, xs: Sequence[float]) -> Iterator[AxisContact]:
    """Yield the contacts of all stations. Stations between a left and a right link come last."""
    first: list[AxisContact] = []
    for index, station in enumerate(board.stations):
        first += _fixed(board, chosen, index, station, xs[index])
    yield from first
    middle = grouped((contact.link, contact.x) for contact in first)
    sided = [n for n, station in enumerate(board.stations) if station.has_two_sides]
    for index in sided:
        for link in board.stations[index].links:
            middle.setdefault(link, []).append(xs[index])
    for port in board.ports:
        side = 1e4 if port.link in chosen.rightward else -1e4
        middle.setdefault(port.link, []).append(side)
    for index in sided:
        station = board.stations[index]
        left, right = _sides(station.links, xs[index], middle)
        for device in station.devices:
            yield AxisContact(left, xs[index] - station.half, device, "sign")
            yield AxisContact(right, xs[index] + station.half, device, "sign")


def _sides(
    links: Sequence[int], x: float, middle: Mapping[int, Sequence[float]]
) -> tuple[int, int]:
    """Return the left and right link of a station, from contacts at other positions."""
    first, second = links
    turns = []
    for link in links:
        positions = [position for position in middle[link] if position != x]
        ways = sum(1 if position > x else -1 for position in positions) / max(len(positions), 1)
        distance = sum(min(max(position, -500.0), 500.0) - x for position in positions)
        turns.append(ways + 1e-9 * distance)
    # The link that is clearly on one side decides; the other link takes the opposite side.
    turn = max(-turns[0], turns[1], key=abs)
    return (second, first) if turn < 0 else (first, second)


def _fixed(
    board: AxesBoard, chosen: StationOrder, index: int, station: Station, x: float
) -> Iterator[AxisContact]:
    """Yield contacts of a station with positions that do not depend on the sides of the links."""
    device = station.devices[0]
    if station.joint is not None:
        yield from _of_pair(station, board.radii[index], x, board.webs(index, chosen.ways[index]))
    elif station.kind == "brake":
        yield AxisContact(station.links[0], x, device, "sign")
    elif station.kind == "box" and not station.has_two_sides:
        for place, link in enumerate(station.links):
            at = x + station.half * (2 * place + 1 - len(station.links)) / len(station.links)
            yield AxisContact(link, at, device, "sign")
    elif station.kind in ("differential", "section"):
        yield from _of_ends(station, chosen.ways[index], x)
    elif station.kind == "set":
        glyph = station.glyphs[chosen.ways[index]]
        met = (tap for tap in glyph.taps if tap.wire)
        yield from (_of_set(tap, x, glyph, device, chosen.drums) for tap in met)


def _of_pair(
    station: Station, radii: tuple[float, float, float], x: float, webs: tuple[float, float]
) -> Iterator[AxisContact]:
    device = station.devices[0]
    for link, radius, off in zip(station.links, radii[::2], webs, strict=True):
        at = x + off
        yield AxisContact(link, at - WHEEL, device, "bar")
        yield AxisContact(link, at, device, "wheel", radius)
        yield AxisContact(link, at + WHEEL, device, "bar")
    if station.joint is not None and station.joint.frame:
        yield AxisContact(station.joint.frame, x - station.half, device, "sign")


def _of_ends(station: Station, way: int, x: float) -> Iterator[AxisContact]:
    """Yield the contacts of the shafts on both sides of a differential or a half-section."""
    if station.layout is not None:
        devices = station.layout.coaxial.scheme.devices
        for link, at in zip(station.links, (x - station.half, x + station.half), strict=True):
            connected = (index for index in station.devices if link in devices[index].links)
            yield from (AxisContact(link, at, index, "bar") for index in connected)
        return
    *sides, cage = station.links
    left, right = sides[:: -1 if way else 1]
    for link, at in ((left, -CAGE), (right, CAGE), (cage, -CAGE), (cage, CAGE)):
        yield AxisContact(link, x + at, station.devices[0], "bar")


def port_contacts(
    board: AxesBoard, chosen: StationOrder, contacts: Sequence[AxisContact]
) -> Iterator[AxisContact]:
    """Yield the contacts at the ends of axes: inputs, outputs and road wheels."""
    ends = {port.link: port.link in chosen.rightward for port in board.ports}
    for link, differential in board.road_wheels.items():
        cage = board.stations[differential].devices[0]
        middles = [contact.x for contact in contacts if contact.device == cage]
        link_xs = [contact.x for contact in contacts if contact.link == link]
        ends.setdefault(link, min(link_xs) > min(middles) + CAGE)
    ports = {port.link for port in board.ports}
    for link, is_right in ends.items():
        row, way = board.axis_of[link], 1 if is_right else -1
        xs = (way * contact.x for contact in contacts if board.axis_of[contact.link] == row)
        end = max(xs, default=0.0) + STUB
        if link in board.road_wheels:
            for x in sorted(_in_the_way(board, contacts, row, way)):
                end = x + ROAD_WHEEL if abs(end - x) < ROAD_WHEEL else end
        yield AxisContact(link, way * end, -1, "port" if link in ports else "road")


def _in_the_way(
    board: AxesBoard, contacts: Sequence[AxisContact], row: int, way: int
) -> Iterator[float]:
    """Yield the positions of gears of other axes that a road wheel would touch."""
    heights = board.rows.heights
    for contact in contacts:
        distance = abs(heights[board.axis_of[contact.link]] - heights[row])
        if contact.kind == "wheel" and distance and distance - contact.end < ROAD_RADIUS + 3.0:
            yield way * contact.x


def _of_set(tap: Tap, x: float, glyph: Glyph, device: int, drums: frozenset[int]) -> AxisContact:
    """Return the contact of a gear set member.

    The line of a link on the far side leads around the edge of the gear set.
    """
    at, half = x - glyph.width / 2 + tap.x, glyph.width / 2 + EDGE
    if (tap.side == ABOVE) == (tap.wire in drums):
        return AxisContact(tap.wire, at, device, "set", tap.y)
    edge = x + half if at >= x else x - half
    return AxisContact(tap.wire, edge, device, "set", tap.y, at - edge)
