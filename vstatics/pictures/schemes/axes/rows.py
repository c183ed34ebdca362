"""Axes as rows of a diagram: order, distances, and radii of the gears between them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import permutations
from typing import NamedTuple

from vstatics.pictures.schemes.axes.recognition import FAR, AxisJoint, ParallelAxes
from vstatics.pictures.schemes.axes.stations import Station

DISTANCE = 66.0
"""Smallest distance between neighbouring axes without gear sets. [pt]"""
CLEARANCE = 16.0
"""Distance from the components on an axis to the next axis. [pt]"""
LEAST_RADIUS = 8.0
"""Smallest radius of a gear. [pt]"""
SIGNS = 40.0
"""Height above an axis of symbols with names. [pt]"""
MOST_PERMUTED = 7
"""Largest number of axes for which all orders are tried."""


class AxisRows(NamedTuple):
    """Order and heights of the axes."""

    order: Sequence[int]
    """Indices of the axes from top to bottom, without axes of idlers between two other axes."""
    heights: Mapping[int, float]
    """Height of each axis. [pt]"""
    sides: Mapping[int, int]
    """Side of each axis on which links are drawn: 1 above, -1 below."""

    def between(self, axes: Sequence[int]) -> list[int]:
        """Return two axes and all axes drawn between them."""
        low, high = sorted(self.heights[axis] for axis in axes)
        inside = [axis for axis in self.order if low <= self.heights[axis] <= high]
        return [*inside, *(axis for axis in axes if axis not in inside)]

    def radii(self, joint: AxisJoint, ends: tuple[int, int]) -> tuple[float, float, float]:
        """Return the radii of the first gear, of an idler, and of the second gear [pt]."""
        distance = abs(self.heights[ends[0]] - self.heights[ends[1]])
        rows = self.between(ends)
        if len(rows) > 2:
            distance = 0.8 * DISTANCE
        first, second = joint.sizes
        if joint.kind == "internal_pair" and len(rows) == 2:
            small = distance / max(max(first, second) / min(first, second) - 1.0, 1.0)
            large = distance + small
            return (small, 0.0, large) if first < second else (large, 0.0, small)
        if joint.kind in FAR:
            distance *= 0.55
        unit = distance / (first + second + 2 * joint.idler)
        least = LEAST_RADIUS
        first_radius = min(max(first * unit, least), distance - least - 2 * joint.idler * unit)
        between = joint.idler * unit
        return first_radius, between, distance - first_radius - 2 * between


def axis_rows(axes: ParallelAxes, stations: Sequence[Station], letters: float = 1.0) -> AxisRows:
    """Return the rows of axes, in an order in which few gear pairs skip a row.

    The input is at the top, or in the middle of countershafts. Components are drawn above their
    axis, but below the lowest axis. Rows are farther apart for larger letters.
    """
    count = len(axes.axes)
    idlers = dict(_idlers(count, stations))
    order = _order(count, stations, idlers)
    place = {axis: number for number, axis in enumerate(order)}
    between = [{place[first], place[second]} for first, second in idlers.values()]
    if any(max(places) - min(places) > 1 or between.count(places) > 1 for places in between):
        idlers, order = {}, _order(count, stations, {})
    upright = {axis for station in stations if station.layout for axis in station.axes}
    is_last = {order[-1]} - upright if len(order) > 1 else set()
    sides = {axis: -1 if axis in is_last else 1 for axis in order}
    rooms = [_room(axis, stations) for axis in order[1:] if sides[axis] == 1]
    distance = max([DISTANCE * max(0.85 * letters, 1.0), *(room + CLEARANCE for room in rooms)])
    heights = {axis: -place * distance for place, axis in enumerate(order)}
    for axis, (first, second) in idlers.items():
        heights[axis] = (heights[first] + heights[second]) / 2
        sides[axis] = 1
    return AxisRows(order, heights, sides)


def _order(
    count: int, stations: Sequence[Station], idlers: Mapping[int, tuple[int, int]]
) -> tuple[int, ...]:
    ends = [
        station.axes
        for station in stations
        if station.kind == "pair" and idlers.keys().isdisjoint(station.axes)
    ]
    ends += idlers.values()
    rows = [axis for axis in range(count) if axis not in idlers]
    orders = permutations(rows) if len(rows) <= MOST_PERMUTED else [tuple(rows)]
    return min(orders, key=lambda order: _cost(order, ends))


def _room(axis: int, stations: Sequence[Station]) -> float:
    here = [station for station in stations if axis in station.axes]
    half = max((glyph.half for station in here for glyph in station.glyphs), default=0.0)
    return max([2 * half + SIGNS, *(station.reach[1] for station in here)])


def _idlers(count: int, stations: Sequence[Station]) -> list[tuple[int, tuple[int, int]]]:
    """Return axes that only reverse rotation (idlers), each with the two neighbouring axes."""
    idlers: list[tuple[int, tuple[int, int]]] = []
    for axis in range(1, count):
        stations_here = [station for station in stations if axis in station.axes]
        others = {other for station in stations_here for other in station.axes} - {axis}
        if [station.kind for station in stations_here] == ["pair", "pair"] and len(others) == 2:
            links = {link for station in stations_here for link in station.links}
            if len(links) == 3:
                first, second = sorted(others)
                idlers.append((axis, (first, second)))
    used = [neighbour for _, pair in idlers for neighbour in pair]
    return [idler for idler in idlers if idler[0] not in used]


def _cost(order: Sequence[int], ends: Sequence[Sequence[int]]) -> tuple[int, list[int]]:
    """Return the number of skipped rows, and the order itself, which decides ties."""
    place = {axis: number for number, axis in enumerate(order)}
    return sum(abs(place[first] - place[second]) - 1 for first, second in ends), list(order)
