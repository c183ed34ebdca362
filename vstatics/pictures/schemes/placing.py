"""From an arrangement to places: levels of tracks, gaps wide enough for the names of wires."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

from vstatics.pictures.schemes.board import Board
from vstatics.pictures.schemes.channels import (
    ABOVE,
    BELOW,
    Arrangement,
    PlacedRow,
    Track,
    number_of,
)
from vstatics.pictures.sheet.labels import Point

TRACK_PITCH = 17.0
"""From track to track. [pt]"""
TRACK_CLEARANCE = 22.0
"""From the row to the first track, and from the last one to the edge. [pt]"""
TRACK_END_GAP = 14.0
"""Between the ends of two tracks on one level. [pt]"""
PAD = 6.0
"""Beside the name of a wire. [pt]"""


@dataclass(frozen=True)
class Placement:
    """Where everything stands; y is 0 in the middle of the row [pt]."""

    arrangement: Arrangement
    row: PlacedRow
    levels: Mapping[Track, int]
    half: float
    """Half the height of the row."""
    labels: Mapping[int, Point]
    """Middle of the name of each wire that is named on its track."""
    from_left: Sequence[int] = ()
    to_right: Sequence[int] = ()

    def end_of(self, wire: int) -> Track:
        """The track by which a wire reaches an end: of two the one below, nearer to the axis."""
        sides = [side for side in (BELOW, ABOVE) if (wire, side) in self.row.spans]
        return wire, (*sides, self.arrangement.sides[wire])[0]

    def y(self, track: Track) -> float:
        """Of a track."""
        return track[1] * (self.half + TRACK_CLEARANCE + TRACK_PITCH * (self.levels[track] - 1))

    def edge(self, side: int) -> float:
        """Outer edge of a channel."""
        levels = [level for track, level in self.levels.items() if track[1] == side]
        return side * (self.half + TRACK_CLEARANCE + TRACK_PITCH * (max(levels, default=0)))

    def crossings(self) -> list[tuple[float, float, int, int]]:
        """Places where a tap crosses a track: x, y, the wire of the tap, that of the track."""
        return [
            (x, self.y(track), wire, track[0])
            for x, low, high, wire in self.verticals()
            for track, (left, right) in self.row.spans.items()
            if left < x < right and low < self.y(track) < high and wire != track[0]
        ]

    def joints(self) -> list[tuple[Point, int]]:
        """Where a wire branches."""
        places = []
        for track, (low, high) in self.row.spans.items():
            own = [tap for tap in self.row.taps if tap[1:3] == track and tap.reach != "none"]
            xs = dict.fromkeys(tap.x for tap in own if low < tap.x < high)
            places += [((x, self.y(track)), track[0]) for x in xs]
        return places

    def verticals(self) -> list[tuple[float, float, float, int]]:
        """Of each tap: x, both y, its wire."""
        lines = []
        for tap in self.row.taps:
            track = tap.wire, tap.side
            if tap.reach == "none":
                continue
            end = self.y(track)
            start = tap.y if tap.reach == "row" else self.edge(tap.side)
            lines.append((tap.x, min(start, end), max(start, end), tap.wire))
        return lines


def placed(
    board: Board, arrangement: Arrangement, half: float, names: Mapping[int, float]
) -> Placement:
    """Everything at its place, in a row of twice the height `half` [pt].

    `names` has the widths of the names that stand on the tracks of wires [pt].
    """
    extra: dict[int, float] = {}
    for _ in range(3 * len(names) + 3):
        row = board.row(arrangement, extra)
        bare = Placement(arrangement, row, _levels(row, arrangement), half, {})
        labels: dict[int, Point] = {}
        for wire, width in names.items():
            middle, y, lack, before = _room(bare, wire, width + 2 * PAD, board.gap)
            if lack > 0:
                extra[before] = extra.get(before, 0.0) + lack
                break
            labels[wire] = middle, y
        else:
            break
    return Placement(arrangement, row, bare.levels, half, labels, board.from_left, board.to_right)


def _levels(row: PlacedRow, arrangement: Arrangement) -> dict[Track, int]:
    """The lowest level of each track at which no other is in its way."""
    levels: dict[Track, int] = {}
    for side in (ABOVE, BELOW):
        tracks = sorted(
            (t for t in row.spans if t[1] == side), key=lambda t: arrangement.ranks[number_of(*t)]
        )
        for track in tracks:
            low, high = row.spans[track]
            under = [
                level
                for other, level in levels.items()
                if other[1] == side
                and row.spans[other][0] < high + TRACK_END_GAP
                and row.spans[other][1] > low - TRACK_END_GAP
            ]
            levels[track] = max(under, default=0) + 1
    return levels


def _room(bare: Placement, wire: int, width: float, gap: float) -> tuple[float, float, float, int]:
    """Where a name fits best: its x and y, how much room it lacks, and before which item.

    The name stands between two taps that touch or cross the track.
    """
    row = bare.row
    starts = sorted((left, item) for item, left in row.lefts.items())
    starts.append((row.width, -1))
    rooms: list[tuple[float, float, float, float, int]] = []
    for track, (low, high) in row.spans.items():
        if track[0] != wire:
            continue
        y = bare.y(track)
        stops = {x for x, down, up, _ in bare.verticals() if down <= y <= up and low < x < high}
        points = [low, *sorted(stops), high]
        for left, right in pairwise(points):
            before = next((item for start, item in starts if left < start - gap / 2 < right), None)
            if before is not None or right - left >= width:
                lack = max(width - (right - left), 0.0)
                rooms.append((lack, -(right - left), (left + right) / 2, y, before or 0))
    lack, _, middle, y, before = min(rooms)
    return middle, y, lack, before
