"""What is to be arranged along the axes, and what may be chosen."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import permutations
from typing import NamedTuple

from vstatics.pictures.schemes.axes.recognition import ParallelAxes
from vstatics.pictures.schemes.axes.rows import SIGNS, AxisRows
from vstatics.pictures.schemes.axes.stations import Station
from vstatics.pictures.schemes.scheme import SchemePort

GAP = 6.0
"""Between two stations of a row. [pt]"""
BELL = 9.0
"""From the middle of an internal wheel's teeth to its web. [pt]"""
BESIDE_SET = 6.0
"""From hollow shafts to a set. [pt]"""


class StationOrder(NamedTuple):
    """An order of the stations, and what else may be chosen."""

    groups: tuple[tuple[int, ...], ...]
    """Stations that keep together, from left to right."""
    ways: tuple[int, ...]
    """By station: the way in which a set is drawn, the order of packs in a drum, ..."""
    drums: frozenset[int] = frozenset()
    """Links that run over sets and signs."""
    rightward: frozenset[int] = frozenset()
    """Links whose ports are at the right end of their rows."""

    @property
    def order(self) -> list[int]:
        """All stations from left to right."""
        return [index for group in self.groups for index in group]


@dataclass(frozen=True)
class AxesBoard:
    """What is to be arranged."""

    axes: ParallelAxes
    rows: AxisRows
    stations: Sequence[Station]
    ports: Sequence[SchemePort]
    gap: float = GAP
    """Between two stations of a row. [pt]"""

    @cached_property
    def axis_of(self) -> Mapping[int, int]:
        """The axis of each link."""
        return {link: number for number, own in enumerate(self.axes.axes) for link in own}

    @cached_property
    def radii(self) -> Mapping[int, tuple[float, float, float]]:
        """Of the wheels of each pair, by its station."""
        return {
            index: self.rows.radii(one.joint, (one.axes[0], one.axes[1]))
            for index, one in enumerate(self.stations)
            if one.joint is not None
        }

    @cached_property
    def apart(self) -> Mapping[tuple[int, int], bool]:
        """Of any two stations: whether they have no row in common."""
        rows = [frozenset(own) for own in self.occupied]
        count = range(len(rows))
        return {(one, other): not rows[one] & rows[other] for one in count for other in count}

    @cached_property
    def halves(self) -> Sequence[float]:
        """Of the widths of the stations [pt]."""
        return [one.half for one in self.stations]

    @cached_property
    def occupied(self) -> Sequence[Sequence[int]]:
        """Of each station the rows in which nothing else may stand above or below it."""
        return [self._occupied(index, one) for index, one in enumerate(self.stations)]

    @cached_property
    def station_of(self) -> Mapping[int, Station]:
        """The station of each device."""
        return {device: one for one in self.stations for device in one.devices}

    @cached_property
    def cages(self) -> frozenset[int]:
        """Links that are cases of differentials, within which the other two turn."""
        return frozenset(one.links[2] for one in self.stations if one.kind == "differential")

    @cached_property
    def idle(self) -> Mapping[int, int]:
        """Links that turn on a shaft until a clutch joins them to it, and this shaft."""
        ends = {port.link for port in self.ports}
        found: dict[int, int] = {}
        for link in sorted(self.wheels - ends):
            own = [one for one in self.stations if link in one.links and one.kind != "pair"]
            others = [other for one in own for other in one.links if other != link]
            shifted = all(one.is_shifted for one in own)
            if own and shifted and len(set(others)) == 1 and self._long(others[0], link):
                found[link] = others[0]
        return found

    def _long(self, shaft: int, link: int) -> bool:
        """Whether a shaft has more on it than a link that may turn on it."""
        counts = [sum(one in own.links for own in self.stations) for one in (shaft, link)]
        return (counts[0], link) > (counts[1], shaft)

    @cached_property
    def rim(self) -> frozenset[int]:
        """Axes that power leaves, other than that of the input."""
        ends = {port.link for port in self.ports if port.role == "output"} | self.cages
        return frozenset(self.axis_of[link] for link in ends) - {0}

    @cached_property
    def entry(self) -> frozenset[int]:
        """The links of the input."""
        return frozenset(port.link for port in self.ports if port.role == "input")

    @cached_property
    def wheels(self) -> frozenset[int]:
        """Links with wheels of pairs."""
        own = (one for one in self.stations if one.kind == "pair")
        return frozenset(link for one in own for link in one.links)

    @cached_property
    def may_be_drums(self) -> frozenset[int]:
        """Links of rows with sets, and those without wheels."""
        rows = {axis for axis in range(len(self.axes.axes)) if self.set_halves[axis]}
        own = self.axis_of.items()
        sides = {link for one in self.stations if one.kind == "differential" for link in one.links}
        found = (n for n, axis in own if axis in rows or n not in self.wheels)
        return frozenset(found) - sides

    @cached_property
    def set_halves(self) -> Mapping[int, float]:
        """By axis, half the height of its sets; 0 without any [pt]."""
        halves = dict.fromkeys(range(len(self.axes.axes)), 0.0)
        for one in self.stations:
            for glyph in one.glyphs:
                halves[one.axes[0]] = max(halves[one.axes[0]], glyph.half)
        return halves

    @cached_property
    def bands(self) -> Mapping[int, float]:
        """By axis, the height of what stands between shafts and drums [pt]."""
        return {axis: _band(self, axis) for axis in range(len(self.axes.axes))}

    def _occupied(self, index: int, station: Station) -> list[int]:
        rows = self.rows
        if station.joint is None:
            return [*station.axes]
        found = rows.between(station.axes)
        first, _, second = self.radii[index]
        for axis, radius in zip(station.axes, (first, second), strict=True):
            for other in rows.order:
                distance = abs(rows.heights[axis] - rows.heights[other])
                towards = rows.sides[other] * (rows.heights[axis] - rows.heights[other]) > 0
                if other not in found and radius > distance - self._room(other, towards):
                    found.append(other)
        return found

    def _room(self, axis: int, is_above: bool) -> float:  # noqa: FBT001
        """From an axis to where wheels of others may be, on the side of its links or under it."""
        reach = [one.reach[is_above] for one in self.stations if axis in one.axes]
        return max([SIGNS if is_above else 18.0, *map(abs, reach)])

    def bell(self, index: int, way: int) -> tuple[int, float]:
        """The place in its pair of an internal wheel, and how far its web is beside its teeth.

        The web passes the pinion within it; 0 where there is none [pt].
        """
        one = self.stations[index]
        if one.joint is None or one.joint.kind != "internal_pair":
            return -1, 0.0
        first, between, second = self.radii[index]
        place = int(second > first)
        ends = [self.rows.heights[axis] for axis in one.axes]
        is_within = abs(abs(first - second) - abs(ends[0] - ends[1])) < 1e-6 and not between
        return (place, -BELL if way else BELL) if is_within else (-1, 0.0)

    @cached_property
    def road_wheels(self) -> Mapping[int, int]:
        """Links at whose ends road wheels stand, and the station of the differential of each.

        A side of a differential is followed along its springs to a link by which power leaves,
        or to one that a spring, its tyre, joins to that.
        """
        found: dict[int, int] = {}
        for index, one in enumerate(self.stations):
            if one.kind == "differential":
                ends = [self._road_wheel(side) for side in one.links[:2]]
                found |= dict.fromkeys(ends, index) if 0 not in ends else {}
        return found

    def _road_wheel(self, side: int) -> int:
        """From one side of a differential; 0 where there is none."""
        leaving = {port.link for port in self.ports if port.role != "input"}
        couplings = [one for one in self.stations if one.kind == "coupling"]
        springs = [{*one.links} for one in couplings if not one.is_shifted]
        before, at = 0, side
        while at not in leaving:
            ahead = [*set().union(*(own for own in springs if at in own)) - {at, before}]
            if leaving & {*ahead}:
                return at
            if len(ahead) != 1 or ahead[0] == side:
                return 0
            before, at = at, ahead[0]
        return at

    def ways(self, index: int) -> int:
        """In how many ways a station may be drawn."""
        one = self.stations[index]
        if one.kind == "set":
            return len(one.glyphs)
        if one.kind == "drum":
            return len(list(permutations(one.devices)))
        return 2 if one.kind == "differential" or self.bell(index, 0)[1] else 1


def _band(board: AxesBoard, axis: int) -> float:
    """Height of what stands between shafts and drums [pt]."""
    half = board.set_halves[axis]
    if half:
        return 2 * half + BESIDE_SET + 16.0
    wheels = [
        radius
        for index, one in enumerate(board.stations)
        if axis in one.axes and one.joint
        for end, radius in zip(one.axes, board.radii[index][::2], strict=True)
        if end == axis
    ]
    return max([SIGNS - 8.0, *(radius + 8.0 for radius in wheels)])
