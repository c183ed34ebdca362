"""A row of items and the wires between them, in a channel above the row and one below.

A wire is a horizontal track in a channel, with a tap from each item that it joins. Two
wires cross where a tap passes the track of another. This module knows nothing of
transmissions.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, NamedTuple

ABOVE, BELOW = 1, -1

Reach = Literal["row", "edge", "pass", "none"]
"""From where a tap comes to its track: from the row, from the outer edge of the channel, or
through the whole channel, joining the track if the wire has one there; or it has no track."""

GAP = 16.0
"""Between items, where nothing else is told. [pt]"""
CROSSING, TRACK = 300.0, 40.0
"""What a crossing costs, and one track more, in points of length of wire."""

Track = tuple[int, int]
"""A wire, and the side of the row on which it runs."""


class Tap(NamedTuple):
    """Where a wire meets an item."""

    wire: int
    side: int
    """ABOVE, BELOW, or 0: that of the wire."""
    x: float
    """From the left end of the item. [pt]"""
    reach: Reach = "row"
    label: str = ""
    """What the item calls it."""
    depth: float = 0.0
    """How far from the middle of the row, toward its side, it leaves the item. [pt]"""


@dataclass(frozen=True)
class Item:
    """Something in the row.

    Parameters
    ----------
    key : int
    widths : sequence of float
        Of each variant. [pt]
    variants : sequence of sequence of Tap
        The ways in which wires may meet it.
    rank : int, optional
        Items with a rank stay in its order.
    slot : float
        If not 0, taps are put into slots of this width, sorted as crosses least. [pt]
    bridge : int, optional
        It is there only if this wire runs on both sides and no other item joins its tracks.
    """

    key: int
    widths: Sequence[float]
    variants: Sequence[Sequence[Tap]]
    rank: int | None = None
    slot: float = 0.0
    bridge: int | None = None


@dataclass(frozen=True)
class Arrangement:
    """An arrangement: the order of items, their variants, sides of wires, order of tracks."""

    order: tuple[int, ...]
    variants: tuple[int, ...]
    sides: Mapping[int, int]
    ranks: Mapping[Track, int]
    """From the row outward; tracks of one side only are compared."""


class PlacedTap(NamedTuple):
    """A tap at its place in the row."""

    item: int
    wire: int
    side: int
    x: float
    reach: Reach
    label: str
    depth: float

    @property
    def y(self) -> float:
        """Where it leaves the item."""
        return self.side * self.depth


@dataclass(frozen=True)
class PlacedRow:
    """An arrangement with places along the row [pt]."""

    lefts: Mapping[int, float]
    """Left ends of the items that are there, by their index."""
    widths: Mapping[int, float]
    taps: Sequence[PlacedTap]
    spans: Mapping[Track, tuple[float, float]]
    width: float


_Joints = tuple[set[int], set[int], set[int], set[int]]
"""Wires that an item joins above, below and on both sides at one place; those on a free side."""


def _joints_of(taps: Sequence[Tap]) -> _Joints:
    above: set[int] = set()
    below: set[int] = set()
    joined: set[int] = set()
    free: set[int] = set()
    first: dict[tuple[int, float], int] = {}
    for wire, side, x, reach, _, _ in taps:
        if reach == "none":
            continue
        (free if not side else above if side == ABOVE else below).add(wire)
        if first.setdefault((wire, x), side) != side:
            joined.add(wire)
    return above, below, joined, free


@dataclass(frozen=True)
class Board:
    """What is to be arranged.

    Parameters
    ----------
    items : sequence of Item
    wires : sequence of int
    from_left, to_right : sequence of int
        Wires that come from the left end of the picture, or go to the right one.
    gap : float
        Between items. [pt]
    """

    items: Sequence[Item]
    wires: Sequence[int]
    from_left: Sequence[int] = ()
    to_right: Sequence[int] = ()
    gap: float = GAP

    def row(self, arrangement: Arrangement, extra: Mapping[int, float] | None = None) -> PlacedRow:
        """The places of items and taps; `extra` widens the gap before an item."""
        lefts: dict[int, float] = {}
        widths: dict[int, float] = {}
        taps: list[PlacedTap] = []
        x = 0.0
        missing = self._bridges(arrangement)
        reaches = self._reaches(arrangement) if self._has_slots else {}
        for place, index in enumerate(arrangement.order):
            item = self.items[index]
            if item.bridge is not None and item.bridge not in missing:
                continue
            variant = arrangement.variants[index]
            x += self.gap + (extra.get(index, 0.0) if extra else 0.0)
            own, width = _taps(item, variant, arrangement, place, reaches)
            lefts[index], widths[index] = x, width
            for wire, side, at, reach, label, depth in own:
                taps.append(PlacedTap(index, wire, side, x + at, reach, label, depth))
            x += width
        x += self.gap + (extra.get(-1, 0.0) if extra else 0.0)
        return PlacedRow(lefts, widths, taps, self._spans(taps, arrangement, x), x)

    def _bridges(self, arrangement: Arrangement) -> set[int]:
        """Wires whose tracks on both sides are joined by no item."""
        above: set[int] = set()
        below: set[int] = set()
        joined: set[int] = set()
        for index, variants in self._joints:
            own = variants[arrangement.variants[index]]
            above |= own[0]
            below |= own[1]
            joined |= own[2]
            for wire in own[3]:
                (above if arrangement.sides[wire] == ABOVE else below).add(wire)
        return (above & below) - joined

    @cached_property
    def _joints(self) -> list[tuple[int, list[_Joints]]]:
        """By item, what each of its variants joins; bridges join nothing by themselves."""
        return [
            (index, [_joints_of(taps) for taps in item.variants])
            for index, item in enumerate(self.items)
            if item.bridge is None
        ]

    @cached_property
    def _has_slots(self) -> bool:
        """Whether the reach of wires matters, as taps are sorted into slots by it."""
        return any(item.slot for item in self.items)

    def _reaches(self, arrangement: Arrangement) -> dict[int, tuple[int, int]]:
        """The first and the last place in the row at which a wire meets an item."""
        reaches: dict[int, tuple[int, int]] = dict.fromkeys(self.from_left, (-1, -1))
        for place, index in enumerate(arrangement.order):
            item = self.items[index]
            if item.bridge is None:
                for tap in item.variants[arrangement.variants[index]]:
                    if tap.reach == "none":
                        continue
                    first = reaches.get(tap.wire, (place, place))[0]
                    reaches[tap.wire] = first, place
        for wire in self.to_right:
            first = reaches.get(wire, (len(arrangement.order), 0))[0]
            reaches[wire] = first, len(arrangement.order)
        return reaches

    def _spans(
        self, taps: Sequence[PlacedTap], arrangement: Arrangement, end: float
    ) -> dict[Track, tuple[float, float]]:
        spans: dict[Track, tuple[float, float]] = {}
        for _, wire, side, x, reach, _, _ in taps:
            if reach in {"row", "edge"}:
                low, high = spans.get((wire, side), (x, x))
                spans[wire, side] = min(low, x), max(high, x)
        for _, wire, side, x, reach, _, _ in taps:
            if reach == "pass" and (wire, side) in spans:
                low, high = spans[wire, side]
                spans[wire, side] = min(low, x), max(high, x)
        for wires, x in ((self.from_left, 0.0), (self.to_right, end)):
            for wire in wires:
                track = end_track(spans, wire, arrangement.sides[wire])
                low, high = spans.get(track, (x, x))
                spans[track] = min(low, x), max(high, x)
        return spans

    def cost(self, arrangement: Arrangement) -> float:
        """Crossings, length of wire, tracks."""
        row = self.row(arrangement)
        length = sum(high - low for low, high in row.spans.values())
        return (
            CROSSING * crossings(row, arrangement) + length + TRACK * len(row.spans) + 2 * row.width
        )


def end_track(spans: Mapping[Track, tuple[float, float]], wire: int, side: int) -> Track:
    """The track that reaches an end: of two the one below, which is nearer to the axis."""
    if (wire, BELOW) in spans:
        return wire, BELOW
    return (wire, ABOVE) if (wire, ABOVE) in spans else (wire, side)


def crossings(row: PlacedRow, arrangement: Arrangement) -> int:
    """How often taps pass tracks of other wires."""
    count = 0
    ranks = arrangement.ranks
    by_side: dict[int, list[tuple[int, int, float, float]]] = {ABOVE: [], BELOW: []}
    for track, (low, high) in row.spans.items():
        by_side[track[1]].append((track[0], ranks[track], low, high))
    for _, wire, side, x, reach, _, _ in row.taps:
        own = ranks[wire, side]
        for other, rank, low, high in by_side[side]:
            if low < x < high and other != wire:
                if reach == "row":
                    count += rank < own
                elif reach == "edge":
                    count += rank > own
                else:
                    count += reach == "pass"
    return count


Sided = tuple[int, int, float, Reach, str, float]
"""A tap whose side is known: plain, as the search makes very many."""


def _taps(
    item: Item,
    variant: int,
    arrangement: Arrangement,
    place: int,
    reaches: Mapping[int, tuple[int, int]],
) -> tuple[Sequence[Sided], float]:
    """The taps of an item with their sides, and its width."""
    sides, ranks = arrangement.sides, arrangement.ranks
    own: list[Sided] = [
        (wire, side or sides[wire], x, reach, label, depth)
        for wire, side, x, reach, label, depth in item.variants[variant]
    ]
    if not item.slot:
        return own, item.widths[variant]

    def key(tap: Sided) -> tuple[int, int]:
        first, last = reaches.get(tap[0], (place, place))
        if first < place:
            return (1, 0) if last > place else (0, ranks[tap[0], tap[1]])
        return (2, -ranks[tap[0], tap[1]]) if last > place else (1, 0)

    by_side = [sorted((tap for tap in own if tap[1] == side), key=key) for side in (ABOVE, BELOW)]
    slot = item.slot
    width = max(slot * max(map(len, by_side)), item.widths[variant])
    placed: list[Sided] = [
        (wire, side, width / 2 + slot * (number - (len(taps) - 1) / 2), reach, label, depth)
        for taps in by_side
        for number, (wire, side, _, reach, label, depth) in enumerate(taps)
    ]
    return placed, width
