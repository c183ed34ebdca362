"""Lines of links: horizontal lines along the axes, vertical lines to the components."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from itertools import pairwise
from typing import NamedTuple

from vstatics.pictures.drawing.canvas import Point
from vstatics.pictures.drawing.labels import Segment
from vstatics.pictures.schemes.axes.contacts import AxisContact
from vstatics.pictures.schemes.axes.places import AxesPlaces
from vstatics.pictures.schemes.axes.stations import Station

STACK = 27.0
"""Vertical distance between symbols that connect the same two links. [pt]"""
TOO_NEAR = 2.5
"""Distance below which two vertical lines look like a single line. [pt]"""
EPSILON = 0.01
"""Distance below which lines count as touching. [pt]"""


class LinkLines(NamedTuple):
    """Lines of a link in the diagram."""

    level: Segment
    """Horizontal line along the axis."""
    upright: list[tuple[int, list[Point]]]
    """Indices of components, each with the path from the horizontal line to the component."""


class WireCrossing(NamedTuple):
    """Crossing of the lines of two links."""

    at: Point
    upright: int
    """Number of the link of the vertical line."""
    level: int
    """Number of the link of the horizontal line."""


def link_lines(placing: AxesPlaces) -> dict[int, LinkLines]:
    """Return the lines of each link."""
    lines: dict[int, LinkLines] = {}
    for link, span in placing.spans.items():
        y = placing.y(placing.axis_of(link), span.height)
        lines[link] = LinkLines(((span.left, y), (span.right, y)), [])
    for contact in placing.contacts:
        path = path_of(placing, contact)
        if path:
            lines[contact.link].upright.append((contact.device, path))
    return lines


def path_of(placing: AxesPlaces, contact: AxisContact) -> list[Point]:
    """Return the path from the line of a link to a component; empty for a component on the line."""
    axis, span = placing.axis_of(contact.link), placing.spans[contact.link]
    height, x = span.height, contact.x
    if contact.kind == "wheel":
        ends = [(x, contact.end)]
    elif contact.kind == "set":
        middle = placing.sign_height(axis) + contact.end
        ends = [(x, middle)]
        if contact.way_round:
            ends.append((x + contact.way_round, middle))
    elif contact.kind == "port":
        ends = [(x, placing.port_height(contact.link))]
    elif contact.kind == "sign":
        ends = [(x, sign_height(placing, contact.device))]
    else:
        return []
    if abs(ends[0][1] - height) < EPSILON and len(ends) == 1:
        return []
    return [
        (x, placing.y(axis, height)),
        *((at, placing.y(axis, end_height)) for at, end_height in ends),
    ]


def branches(placing: AxesPlaces, link: int, lines: LinkLines) -> Iterator[tuple[int, Point]]:
    """Yield the points where the line of a link branches to a component other than a gear."""
    wheeled = {
        contact.device
        for contact in placing.contacts
        if contact.link == link
        and contact.kind in ("wheel", "bar")
        and placing.spans[link].level >= 0
    }
    paths = [(device, path) for device, path in lines.upright if device not in wheeled]
    pieces = [lines.level, *(piece for _, path in paths for piece in pairwise(path))]
    for device, path in paths:
        for at in (path[0], path[-1]):
            if any(_is_inside(at, piece) for piece in pieces):
                yield device, at


def _is_inside(at: Point, line: Segment) -> bool:
    """Return True if a point is on a horizontal or vertical line, but not at an end."""
    (x, y), (x2, y2) = line
    low, high = sorted(line)
    is_on = at[0] == x == x2 or at[1] == y == y2
    return is_on and EPSILON < sum(at) - sum(low) < sum(high) - sum(low) - EPSILON


def sign_height(placing: AxesPlaces, device: int) -> float:
    """Return the height of the middle of a symbol above the axis [pt].

    The height is 0 for a symbol between the ends of two shafts.
    """
    station = placing.board.station_of[device]
    (axis, *_) = station.axes
    levels = [placing.spans[link].level for link in station.links]
    if station.kind == "brake":
        return _brake_height(placing, station, device)
    if station.has_two_sides and levels == [0, 0] and len(station.devices) == 1:
        return 0.0
    return placing.sign_height(axis) + STACK * list(station.devices).index(device)


def _brake_height(placing: AxesPlaces, station: Station, device: int) -> float:
    """Return the height of the lower end of a brake [pt]. Brakes on a drum end above all drums."""
    (axis,), (link,) = station.axes, station.links
    if placing.spans[link].level >= 0:
        return placing.sign_height(axis)
    x = next(contact.x for contact in placing.contacts if contact.device == device)
    return max(
        span.height
        for drum, span in placing.spans.items()
        if span.level < 0
        and placing.axis_of(drum) == axis
        and span.left - station.half < x < span.right + station.half
    )


def wheel_crossings(placing: AxesPlaces, lines: Mapping[int, LinkLines]) -> int:
    """Return the number of crossings of gears with links on other axes.

    Only internal gears are large enough for such crossings.
    """
    count = 0
    for number, station in enumerate(placing.board.stations):
        if station.kind != "pair":
            continue
        webs = placing.board.webs(number, placing.chosen.ways[number])
        for axis, radius, off in zip(
            station.axes, placing.board.radii[number][::2], webs, strict=True
        ):
            x = placing.xs[number] + off
            low, high = sorted((placing.y(axis, 0.0), placing.y(axis, -radius)))
            for link, wires in lines.items():
                (left, y), (right, _) = wires.level
                is_other = link not in station.links and placing.axis_of(link) != axis
                count += is_other and left < x < right and low < y < high
    return count


def crossings(lines: Mapping[int, LinkLines]) -> list[WireCrossing]:
    """Return the points where lines of two links cross."""
    levels: list[tuple[float, float, float, int]] = []
    uprights: list[tuple[float, float, float, int]] = []
    for link, wires in lines.items():
        for (x, y), (x2, y2) in _pieces(wires):
            if y == y2:
                levels.append((min(x, x2) + EPSILON, max(x, x2) - EPSILON, y, link))
            else:
                uprights.append((x, min(y, y2) + EPSILON, max(y, y2) - EPSILON, link))
    met = (
        WireCrossing((x, y), link, crossed)
        for x, low, high, link in uprights
        for left, right, y, crossed in levels
        if left < x < right and low < y < high and crossed != link
    )
    return list(dict.fromkeys(met))


def overlaps(lines: Mapping[int, LinkLines]) -> int:
    """Return the number of overlaps of vertical lines of different links."""
    pieces = [
        (x, *sorted((first, last)), link)
        for link, wires in lines.items()
        for (x, first), (_, last) in _pieces(wires)
        if first != last
    ]
    pieces.sort()
    count = 0
    for place, (x, low, high, link) in enumerate(pieces):
        for piece in pieces[place + 1 :]:
            if piece[0] - x > TOO_NEAR:
                break
            count += piece[3] != link and piece[1] < high - EPSILON and piece[2] > low + EPSILON
    return count


def _pieces(lines: LinkLines) -> Iterable[Segment]:
    yield lines.level
    for _, path in lines.upright:
        yield from pairwise(path)
