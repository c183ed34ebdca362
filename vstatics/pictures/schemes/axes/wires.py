"""The lines of links: level ones along the axes, upright ones to what stands on them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from itertools import pairwise
from typing import NamedTuple

from vstatics.pictures.drawing.labels import Point, Segment
from vstatics.pictures.schemes.axes.contacts import AxisContact
from vstatics.pictures.schemes.axes.places import AxesPlaces
from vstatics.pictures.schemes.axes.stations import Station

STACK = 27.0
"""From sign to sign that join the same links. [pt]"""
TOO_NEAR = 2.5
"""Upright lines that are nearer look like one. [pt]"""
EPSILON = 0.01
"""Lines that are nearer touch. [pt]"""


class LinkLines(NamedTuple):
    """The lines of a link."""

    level: Segment
    """Along its axis."""
    upright: list[tuple[int, list[Point]]]
    """Devices, and the line to each from the one along the axis."""


class WireCrossing(NamedTuple):
    """Where the lines of two links meet."""

    at: Point
    upright: int
    """The link of the upright line."""
    level: int


def link_lines(found: AxesPlaces) -> dict[int, LinkLines]:
    """All lines of each link, by its number."""
    lines: dict[int, LinkLines] = {}
    for link, span in found.spans.items():
        y = found.y(found.axis_of(link), span.height)
        lines[link] = LinkLines(((span.left, y), (span.right, y)), [])
    for contact in found.contacts:
        path = path_of(found, contact)
        if path:
            lines[contact.link].upright.append((contact.device, path))
    return lines


def path_of(found: AxesPlaces, contact: AxisContact) -> list[Point]:
    """From the line along an axis to the device; none where that stands on it."""
    axis, span = found.axis_of(contact.link), found.spans[contact.link]
    height, x = span.height, contact.x
    if contact.kind == "wheel":
        ends = [(x, contact.end)]
    elif contact.kind == "set":
        middle = found.sign_height(axis) + contact.end
        ends = [(x, middle)]
        if contact.way_round:
            ends.append((x + contact.way_round, middle))
    elif contact.kind == "port":
        ends = [(x, found.port_height(contact.link))]
    elif contact.kind == "sign":
        ends = [(x, sign_height(found, contact.device))]
    else:
        return []
    if abs(ends[0][1] - height) < EPSILON and len(ends) == 1:
        return []
    return [(x, found.y(axis, height)), *((at, found.y(axis, one)) for at, one in ends)]


def branches(found: AxesPlaces, link: int, lines: LinkLines) -> Iterator[tuple[int, Point]]:
    """Where a link branches, and the device to which: not at wheels on its shaft."""
    (left, level), (right, _) = lines.level
    wheeled = {
        one.device
        for one in found.contacts
        if one.link == link and one.kind in ("wheel", "bar") and found.spans[link].level >= 0
    }
    paths = [(device, path) for device, path in lines.upright if device not in wheeled]
    for place, (device, path) in enumerate(paths):
        (x, _), (end_x, end) = path[0], path[-1]
        if left + EPSILON < x < right - EPSILON:
            yield device, (x, level)
        for number, (_, other) in enumerate(paths):
            low, high = sorted((other[0][1], other[-1][1]))
            if number != place and other[0][0] == end_x and low + EPSILON < end < high - EPSILON:
                yield device, (end_x, end)


def sign_height(found: AxesPlaces, device: int) -> float:
    """Of the middle of a sign over its axis [pt]; 0 where it joins two shafts end to end."""
    station = found.board.station_of[device]
    (axis, *_) = station.axes
    levels = [found.spans[link].level for link in station.links]
    if station.kind == "brake":
        return _brake_height(found, station, device)
    place = list(station.devices).index(device) if station.kind == "coupling" else 0
    if station.has_two_sides and levels == [0, 0] and len(station.devices) == 1:
        return 0.0
    return found.sign_height(axis) + STACK * place


def _brake_height(found: AxesPlaces, station: Station, device: int) -> float:
    """Of the lower end of a brake [pt]: that of a drum is outside of all drums over it."""
    (axis,), (link,) = station.axes, station.links
    if found.spans[link].level >= 0:
        return found.sign_height(axis)
    x = next(one.x for one in found.contacts if one.device == device)
    return max(
        span.height
        for other, span in found.spans.items()
        if span.level < 0
        and found.axis_of(other) == axis
        and span.left - station.half < x < span.right + station.half
    )


def wheel_crossings(found: AxesPlaces, lines: Mapping[int, LinkLines]) -> int:
    """How often the free half of a wheel passes a link of another axis: rings are that large."""
    count = 0
    for number, station in enumerate(found.board.stations):
        if station.kind != "pair":
            continue
        bell, off = found.board.bell(number, found.chosen.ways[number])
        for place, radius in enumerate(found.board.radii[number][::2]):
            axis = station.axes[place]
            x = found.xs[number] + off * (bell == place)
            low, high = sorted((found.y(axis, 0.0), found.y(axis, -radius)))
            for link, own in lines.items():
                (left, y), (right, _) = own.level
                is_other = link not in station.links and found.axis_of(link) != axis
                count += is_other and left < x < right and low < y < high
    return count


def crossings(lines: Mapping[int, LinkLines]) -> list[WireCrossing]:
    """Where the lines of one link pass those of another one."""
    return list(dict.fromkeys(_crossings(lines)))


def _crossings(lines: Mapping[int, LinkLines]) -> Iterator[WireCrossing]:
    levels: list[tuple[float, float, float, int]] = []
    uprights: list[tuple[float, float, float, int]] = []
    for link, own in lines.items():
        for (x, y), (x2, y2) in _pieces(own):
            if y == y2:
                levels.append((min(x, x2) + EPSILON, max(x, x2) - EPSILON, y, link))
            else:
                uprights.append((x, min(y, y2) + EPSILON, max(y, y2) - EPSILON, link))
    for x, low, high, link in uprights:
        for left, right, y, other in levels:
            if left < x < right and low < y < high and other != link:
                yield WireCrossing((x, y), link, other)


def overlaps(lines: Mapping[int, LinkLines]) -> int:
    """How often upright lines of two links run over each other."""
    pieces = [
        (x, *sorted((first, last)), link)
        for link, own in lines.items()
        for (x, first), (_, last) in _pieces(own)
        if first != last
    ]
    pieces.sort()
    count = 0
    for place, (x, low, high, link) in enumerate(pieces):
        for other in pieces[place + 1 :]:
            if other[0] - x > TOO_NEAR:
                break
            count += other[3] != link and other[1] < high - EPSILON and other[2] > low + EPSILON
    return count


def _pieces(own: LinkLines) -> Iterable[Segment]:
    yield own.level
    for _, path in own.upright:
        yield from pairwise(path)
