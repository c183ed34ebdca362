"""What is to be arranged, where an arrangement puts it along the row, and what it costs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import inf
from typing import NamedTuple

from vstatics.pictures.schemes.channels import (
    ABOVE,
    BELOW,
    Arrangement,
    Item,
    PlacedRow,
    PlacedTap,
    Reach,
    Sided,
    number_of,
    taps_of,
)

ITEM_GAP = 16.0
"""Between items, where nothing else is told. [pt]"""
CROSSING, TRACK = 300.0, 40.0
"""What a crossing costs, and one track more, in points of length of wire."""

_TrackTap = tuple[int, float, Reach]
"""The number of a track, x from the left end of the item or of the row, reach."""


class _ItemShape(NamedTuple):
    """An item in one variant, with known sides: what the search needs of it."""

    width: float
    taps: Sequence[_TrackTap]


class Laid(NamedTuple):
    """Where everything is along the row, as plain as the search needs it."""

    lefts: Mapping[int, float]
    taps: Sequence[_TrackTap]
    low: Sequence[float]
    """Left ends of tracks by number; infinite where there is none."""
    high: Sequence[float]
    width: float


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
    gap: float = ITEM_GAP

    def row(self, arrangement: Arrangement, extra: Mapping[int, float] | None = None) -> PlacedRow:
        """The places of items and taps; `extra` widens the gap before an item."""
        laid = self.laid(arrangement, extra)
        reaches = self._reaches(arrangement) if self._has_slots else {}
        widths: dict[int, float] = {}
        taps: list[PlacedTap] = []
        for place, index in enumerate(arrangement.order):
            if index in laid.lefts:
                own, widths[index] = taps_of(self.items[index], arrangement, index, place, reaches)
                left = laid.lefts[index]
                for wire, side, at, reach, label, depth in own:
                    taps.append(PlacedTap(index, wire, side, left + at, reach, label, depth))
        spans = {
            (wire, side): (laid.low[number], laid.high[number])
            for wire in self.wires
            for side in (ABOVE, BELOW)
            if laid.low[number := number_of(wire, side)] < inf
        }
        return PlacedRow(laid.lefts, widths, taps, spans, laid.width)

    def laid(self, arrangement: Arrangement, extra: Mapping[int, float] | None = None) -> Laid:
        """The same for the search, which makes very many."""
        shapes = self._shapes_in(arrangement)
        low, high = [inf] * (2 * self._wire_end), [-inf] * (2 * self._wire_end)
        lefts: dict[int, float] = {}
        taps: list[_TrackTap] = []
        x, gap = 0.0, self.gap
        for index in arrangement.order:
            x += gap + extra.get(index, 0.0) if extra else gap
            shape = shapes[index]
            lefts[index] = x
            for track, at, reach in shape[1]:
                place = x + at
                taps.append((track, place, reach))
                if place < low[track]:  # noqa: PLR1730 - a third faster
                    low[track] = place
                if place > high[track]:  # noqa: PLR1730
                    high[track] = place
            x += shape[0]
        x += gap + extra.get(-1, 0.0) if extra else gap
        self._reach_out(low, high, arrangement, x)
        return Laid(lefts, taps, low, high, x)

    def _reach_out(
        self,
        low: list[float],
        high: list[float],
        arrangement: Arrangement,
        end: float,
    ) -> None:
        """Draw tracks out to the ends of the picture."""
        for wires, x in ((self.from_left, 0.0), (self.to_right, end)):
            for wire in wires:
                track = 2 * wire  # of two the one below
                if low[track] == inf and (low[track + 1] < inf or arrangement.sides[wire] == ABOVE):
                    track += 1
                low[track], high[track] = min(low[track], x), max(high[track], x)

    def _shapes_in(self, arrangement: Arrangement) -> list[_ItemShape]:
        """The items as they are in an arrangement."""
        known, variants = self._shapes, arrangement.variants
        if not self._has_slots and not self._has_free:
            return [own[variant] for own, variant in zip(known, variants, strict=True)]
        reaches = self._reaches(arrangement) if self._has_slots else {}
        places = {index: place for place, index in enumerate(arrangement.order)}
        shapes = []
        for index, item in enumerate(self.items):
            if not item.slot and not item.is_free:
                shapes.append(known[index][variants[index]])
                continue
            around = arrangement, index, places[index], reaches
            if item.slot:
                shapes.append(_shape_of(*taps_of(item, *around)))
                continue
            taps = item.variants[variants[index]]
            key = index, variants[index], *(arrangement.sides[tap[0]] for tap in taps)
            if key not in self._free_shapes:
                self._free_shapes[key] = _shape_of(*taps_of(item, *around))
            shapes.append(self._free_shapes[key])
        return shapes

    @cached_property
    def _free_shapes(self) -> dict[tuple[int, ...], _ItemShape]:
        """Items without slots by index, variant and the sides of their wires."""
        return {}

    @cached_property
    def _shapes(self) -> list[list[_ItemShape]]:
        """By item, each of its variants, as far as its sides are known."""
        return [
            [
                _shape_of([tap for tap in taps if tap.side], width)
                for taps, width in zip(item.variants, item.widths, strict=True)
            ]
            for item in self.items
        ]

    @cached_property
    def _wire_end(self) -> int:
        return max(self.wires, default=0) + 1

    @cached_property
    def _has_slots(self) -> bool:
        """Whether the reach of wires matters, as taps are sorted into slots by it."""
        return any(item.slot for item in self.items)

    @cached_property
    def _has_free(self) -> bool:
        """Whether the sides of wires matter."""
        return any(item.is_free for item in self.items)

    def _reaches(self, arrangement: Arrangement) -> dict[int, tuple[int, int]]:
        """The first and the last place in the row at which a wire meets an item."""
        reaches: dict[int, tuple[int, int]] = dict.fromkeys(self.from_left, (-1, -1))
        for place, index in enumerate(arrangement.order):
            for tap in self.items[index].variants[arrangement.variants[index]]:
                if tap.reach != "none":
                    first = reaches.get(tap.wire, (place, place))[0]
                    reaches[tap.wire] = first, place
        for wire in self.to_right:
            first = reaches.get(wire, (len(arrangement.order), 0))[0]
            reaches[wire] = first, len(arrangement.order)
        return reaches

    def cost(self, arrangement: Arrangement, limit: float = inf) -> float:
        """Crossings, length of wire, tracks; infinite where it is above a limit."""
        laid, ranks = self.laid(arrangement), arrangement.ranks
        value = 2 * laid.width
        sides: _Spans = ([], [])
        for track, low in enumerate(laid.low):
            if low < inf:
                high = laid.high[track]
                value += high - low + TRACK
                sides[track & 1].append((ranks[track], low, high))
        most = (limit - value) / CROSSING
        if most < 0:
            return inf
        count = _crossings(laid, ranks, sides, most)
        return value + CROSSING * count if count <= most else inf

    def crossings(self, arrangement: Arrangement) -> int:
        """How often taps pass tracks of other wires."""
        laid, ranks = self.laid(arrangement), arrangement.ranks
        spans = list(zip(ranks, laid.low, laid.high, strict=True))
        return _crossings(laid, ranks, (spans[::2], spans[1::2]))


_Spans = tuple[list[tuple[int, float, float]], list[tuple[int, float, float]]]
"""Rank, left and right end of the tracks below, and of those above."""


def _crossings(laid: Laid, ranks: Sequence[int], sides: _Spans, most: float = inf) -> int:
    """How often taps pass tracks of other wires; beyond `most` it is not counted on."""
    count = 0
    inward = [sorted(tracks) for tracks in sides]
    outward = [tracks[::-1] for tracks in inward]
    for track, x, reach in laid.taps:
        own, side = ranks[track], track & 1
        if reach == "row":
            for rank, low, high in inward[side]:
                if rank >= own:
                    break
                count += low < x < high
        else:
            for rank, low, high in outward[side]:
                if rank <= own:
                    break
                count += low < x < high
        if count > most:
            break
    return count


def _shape_of(taps: Sequence[Sided], width: float) -> _ItemShape:
    own = [(number_of(wire, side), x, reach) for wire, side, x, reach, *_ in taps]
    return _ItemShape(width, [tap for tap in own if tap[2] != "none"])
