"""Input and choices of the search for an order of stations (components on the axes)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from vstatics.pictures.schemes.axes.recognition import ParallelAxes
from vstatics.pictures.schemes.axes.rows import SIGNS, AxisRows
from vstatics.pictures.schemes.axes.stations import Station
from vstatics.pictures.schemes.scheme import SchemePort

STATION_GAP = 6.0
"""Distance between neighbouring stations (components) of an axis. [pt]"""
BELL = 9.0
"""Distance from the middle of internal teeth to the web that carries the internal gear. [pt]"""
BESIDE_SET = 6.0
"""Distance from hollow shafts to a gear set. [pt]"""


class StationOrder(NamedTuple):
    """Order of the stations along the axes, and the other choices of the search."""

    groups: tuple[tuple[int, ...], ...]
    """Groups of stations that stay together, from left to right, as indices of stations."""
    ways: tuple[int, ...]
    """Variant of each station: how a gear set or a pair of gears is drawn."""
    drums: frozenset[int] = frozenset()
    """Numbers of links that are drawn as drums around gear sets and symbols."""
    rightward: frozenset[int] = frozenset()
    """Numbers of links whose input or output is at the right end of an axis."""

    @property
    def order(self) -> list[int]:
        """Indices of the stations from left to right."""
        return [index for group in self.groups for index in group]


@dataclass(frozen=True)
class AxesBoard:
    """Axes, stations (components on the axes) and ports that the search arranges."""

    axes: ParallelAxes
    rows: AxisRows
    stations: Sequence[Station]
    ports: Sequence[SchemePort]
    gap: float = STATION_GAP
    """Distance between neighbouring stations of an axis. [pt]"""

    @cached_property
    def axis_of(self) -> Mapping[int, int]:
        """Index of the axis of each link."""
        return {
            link: number for number, axis_links in enumerate(self.axes.axes) for link in axis_links
        }

    @cached_property
    def radii(self) -> Mapping[int, tuple[float, float, float]]:
        """Radii of first gear, idler and second gear by the gear pair's station [pt]."""
        return {
            index: self.rows.radii(station.joint, (station.axes[0], station.axes[1]))
            for index, station in enumerate(self.stations)
            if station.joint is not None
        }

    @cached_property
    def occupied(self) -> Sequence[frozenset[int]]:
        """Indices of the axes that each station occupies over the full height."""
        return [
            frozenset(self._occupied(index, station)) for index, station in enumerate(self.stations)
        ]

    @cached_property
    def station_of(self) -> Mapping[int, Station]:
        """Station of each component."""
        return {device: station for station in self.stations for device in station.devices}

    @cached_property
    def cages(self) -> frozenset[int]:
        """Links that are cases of differentials."""
        return frozenset(
            station.links[2] for station in self.stations if station.kind == "differential"
        )

    @cached_property
    def idle(self) -> Mapping[int, int]:
        """Shaft on which the link of each loose gear rotates freely until a clutch engages."""
        ends = {port.link for port in self.ports}
        shafts: dict[int, int] = {}
        for link in sorted(self.wheels - ends):
            couplings = [
                station
                for station in self.stations
                if link in station.links and station.kind != "pair"
            ]
            partners = {partner for coupling in couplings for partner in coupling.links} - {link}
            if len(partners) == 1 and all(coupling.is_shifted for coupling in couplings):
                (shaft,) = partners
                # Of two coupled links, the one with more stations is the shaft.
                counts = [sum(end in s.links for s in self.stations) for end in (shaft, link)]
                if (counts[0], link) > (counts[1], shaft):
                    shafts[link] = shaft
        return shafts

    @cached_property
    def rim(self) -> frozenset[int]:
        """Indices of axes with an output or a differential, except the axis of the input."""
        ends = {port.link for port in self.ports if port.role == "output"} | self.cages
        return frozenset(self.axis_of[link] for link in ends) - {0}

    @cached_property
    def entry(self) -> frozenset[int]:
        """Numbers of links that are inputs."""
        return frozenset(port.link for port in self.ports if port.role == "input")

    @cached_property
    def wheels(self) -> frozenset[int]:
        """Numbers of links that carry a gear of a gear pair."""
        pairs = (station for station in self.stations if station.kind == "pair")
        return frozenset(link for pair in pairs for link in pair.links)

    @cached_property
    def may_be_drums(self) -> frozenset[int]:
        """Links that can be drawn as drums: on axes with gear sets, or without gears."""
        sides = (item.links for item in self.stations if item.kind == "differential")
        links = (
            link
            for link, axis in self.axis_of.items()
            if self.set_halves[axis] or link not in self.wheels
        )
        return frozenset(links).difference(*sides)

    @cached_property
    def set_halves(self) -> Mapping[int, float]:
        """Half the height of the highest gear set of each axis, 0 without gear sets [pt]."""
        halves = dict.fromkeys(range(len(self.axes.axes)), 0.0)
        for station in self.stations:
            for glyph in station.glyphs:
                halves[station.axes[0]] = max(halves[station.axes[0]], glyph.half)
        return halves

    @cached_property
    def bands(self) -> Mapping[int, float]:
        """Height of the space between the shafts and the drums of each axis [pt]."""
        return {axis: _band(self, axis) for axis in range(len(self.axes.axes))}

    def _occupied(self, index: int, station: Station) -> list[int]:
        rows = self.rows
        if station.joint is None:
            return [*station.axes]
        occupied = rows.between(station.axes)
        first, _, second = self.radii[index]
        for axis, radius in zip(station.axes, (first, second), strict=True):
            for row in rows.order:
                if row in occupied:
                    continue
                distance = abs(rows.heights[axis] - rows.heights[row])
                is_above = rows.sides[row] * (rows.heights[axis] - rows.heights[row]) > 0
                reach = [abs(other.reach[is_above]) for other in self.stations if row in other.axes]
                room = max([SIGNS if is_above else 18.0, *reach])
                if radius > distance - room:
                    occupied.append(row)
        return occupied

    def webs(self, index: int, way: int) -> tuple[float, float]:
        """Return the offsets of the webs of both gears of a pair from the middle of the teeth [pt].

        The offset lets the web of an internal gear pass the pinion inside; other offsets are 0.
        """
        station = self.stations[index]
        if station.joint is None or station.joint.kind != "internal_pair":
            return 0.0, 0.0
        first, between, second = self.radii[index]
        ends = [self.rows.heights[axis] for axis in station.axes]
        is_within = abs(abs(first - second) - abs(ends[0] - ends[1])) < 1e-6 and not between
        offset = is_within * (-BELL if way else BELL)
        return (0.0, offset) if second > first else (offset, 0.0)

    @cached_property
    def road_wheels(self) -> Mapping[int, int]:
        """Index of the differential's station, for each link that ends in a road wheel.

        A shaft of a differential that is an output is itself the road wheel. Otherwise springs are
        followed from the shaft, and the road wheel is the last link before the output.
        """
        differentials: dict[int, int] = {}
        for index, station in enumerate(self.stations):
            if station.kind == "differential":
                ends = [self._road_wheel(side) for side in station.links[:2]]
                differentials |= dict.fromkeys(ends, index) if 0 not in ends else {}
        return differentials

    def _road_wheel(self, side: int) -> int:
        leaving = {port.link for port in self.ports if port.role != "input"}
        couplings = [station for station in self.stations if station.kind == "coupling"]
        springs = [{*coupling.links} for coupling in couplings if not coupling.is_shifted]
        before, at = 0, side
        while at not in leaving:
            ahead = [*set().union(*(spring for spring in springs if at in spring)) - {at, before}]
            if leaving & {*ahead}:
                return at
            if len(ahead) != 1 or ahead[0] == side:
                return 0
            before, at = at, ahead[0]
        return at

    def ways(self, index: int) -> int:
        """Return the number of variants in which a station can be drawn."""
        station = self.stations[index]
        if station.kind == "set":
            return len(station.glyphs)
        return 2 if station.kind == "differential" or any(self.webs(index, 0)) else 1


def _band(board: AxesBoard, axis: int) -> float:
    half = board.set_halves[axis]
    if half:
        return 2 * half + BESIDE_SET + 16.0
    wheels = [
        radius
        for index, station in enumerate(board.stations)
        if axis in station.axes and station.joint
        for end, radius in zip(station.axes, board.radii[index][::2], strict=True)
        if end == axis
    ]
    return max([SIGNS - 8.0, *(radius + 8.0 for radius in wheels)])
