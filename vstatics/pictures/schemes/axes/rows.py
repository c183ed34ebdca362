"""The rows in which the axes stand: their order, their distances, the radii of their wheels."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import permutations
from typing import NamedTuple

from vstatics.pictures.schemes.axes.recognition import FAR, AxisJoint, ParallelAxes
from vstatics.pictures.schemes.axes.stations import Station

DISTANCE = 66.0
"""Between rows without sets, at least. [pt]"""
CLEARANCE = 16.0
"""From what stands on an axis to the next axis. [pt]"""
LEAST_RADIUS = 8.0
"""Of a wheel. [pt]"""
SIGNS = 40.0
"""Height over an axis of signs with names. [pt]"""
MOST_PERMUTED = 7
"""Up to so many rows all orders are tried."""


class AxisRows(NamedTuple):
    """Where the axes lie."""

    order: Sequence[int]
    """Axes from top to bottom, without those of idlers between two rows."""
    heights: Mapping[int, float]
    """Of each axis. [pt]"""
    sides: Mapping[int, int]
    """On which side of each axis its links are drawn: 1 above, -1 below."""

    def between(self, axes: Sequence[int]) -> list[int]:
        """The axes from one to another one, both included."""
        low, high = sorted(self.heights[one] for one in axes)
        inside = [one for one in self.order if low <= self.heights[one] <= high]
        return [*inside, *(one for one in axes if one not in inside)]

    def radii(self, joint: AxisJoint, ends: tuple[int, int]) -> tuple[float, float, float]:
        """Of the first wheel, of that between, and of the second one [pt]."""
        distance = abs(self.heights[ends[0]] - self.heights[ends[1]])
        rows = self.between(ends)
        if len(rows) > 2:
            distance = 0.8 * DISTANCE
        first, second = joint.sizes
        if joint.kind == "internal_pair" and len(rows) == 2:
            small = distance / max(max(first, second) / min(first, second) - 1.0, 1.0)
            radii = (small, distance + small)
            return (*radii[:1], 0.0, *radii[1:]) if first < second else (radii[1], 0.0, radii[0])
        if joint.kind in FAR:
            distance *= 0.55
        unit = distance / (first + second + 2 * joint.idler)
        least = LEAST_RADIUS
        one = min(max(first * unit, least), distance - least - 2 * joint.idler * unit)
        between = joint.idler * unit
        return one, between, distance - one - 2 * between


def axis_rows(axes: ParallelAxes, stations: Sequence[Station], letters: float = 1.0) -> AxisRows:
    """Rows by breadth from the axis of the input, so that few pairs pass a row between.

    The input is at the top, or in the middle of countershafts; what stands on one axis is drawn
    above it, below that at the bottom. Rows are farther apart for larger letters.
    """
    count = len(axes.axes)
    idlers = dict(_idlers(count, stations))
    order = _order(count, stations, idlers)
    place = {axis: number for number, axis in enumerate(order)}
    between = [{place[first], place[second]} for first, second in idlers.values()]
    if any(max(own) - min(own) > 1 or between.count(own) > 1 for own in between):
        idlers, order = {}, _order(count, stations, {})
    upright = {axis for one in stations if one.layout for axis in one.axes}
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
    """Axes from top to bottom, without those of idlers."""
    ends = [tuple(one.axes) for one in stations if one.kind == "pair"]
    ends = [pair for pair in ends if not set(pair) & idlers.keys()] + list(idlers.values())
    rows = [axis for axis in range(count) if axis not in idlers]
    return min(_orders(rows), key=lambda one: _cost(one, ends))


def _room(axis: int, stations: Sequence[Station]) -> float:
    """Height of what stands above an axis [pt]."""
    halves = [glyph.half for one in stations if axis in one.axes for glyph in one.glyphs]
    sets = 2 * max(halves) + SIGNS if halves else SIGNS
    return max([sets, *(one.reach[1] for one in stations if axis in one.axes)])


def _idlers(count: int, stations: Sequence[Station]) -> list[tuple[int, tuple[int, int]]]:
    """Axes that do nothing but turn a direction round, and the two axes beside each."""
    found: list[tuple[int, tuple[int, int]]] = []
    for axis in range(1, count):
        own = [one for one in stations if axis in one.axes]
        others = {other for one in own for other in one.axes} - {axis}
        if [one.kind for one in own] == ["pair", "pair"] and len(others) == 2:
            links = {link for one in own for link in one.links}
            if len(links) == 3:
                first, second = sorted(others)
                found.append((axis, (first, second)))
    used = [other for _, pair in found for other in pair]
    return [one for one in found if one[0] not in used]


def _orders(rows: Sequence[int]) -> list[tuple[int, ...]]:
    return list(permutations(rows)) if len(rows) <= MOST_PERMUTED else [tuple(rows)]


def _cost(order: Sequence[int], ends: Sequence[Sequence[int]]) -> tuple[int, list[int]]:
    """Rows that pairs pass, then how far the order is from that by breadth."""
    place = {axis: number for number, axis in enumerate(order)}
    return sum(abs(place[one] - place[other]) - 1 for one, other in ends), list(order)
