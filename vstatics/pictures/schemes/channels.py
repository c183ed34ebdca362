"""A row of items and the wires between them, in a channel above the row and one below.

A wire is a horizontal track in a channel, with a tap from each item that it joins. Two
wires cross where a tap passes the track of another. Nothing here knows of transmissions.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, NamedTuple

from vstatics.pictures.sheet.labels import Span

ABOVE, BELOW = 1, -1

Reach = Literal["row", "edge", "none"]
"""From where a tap comes to its track: from the row, from the outer edge of the channel; or it has
no track."""

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
    slot : float
        If not 0, taps are put into slots of this width, sorted as crosses least. [pt]
    """

    key: int
    widths: Sequence[float]
    variants: Sequence[Sequence[Tap]]
    slot: float = 0.0

    @cached_property
    def is_free(self) -> bool:
        """Whether a tap is on the side of its wire."""
        return any(not tap.side for taps in self.variants for tap in taps)


class Arrangement(NamedTuple):
    """An arrangement: the order of items, their variants, sides of wires, order of tracks."""

    order: Sequence[int]
    variants: Sequence[int]
    sides: Sequence[int]
    """By wire."""
    ranks: Sequence[int]
    """By `number_of` a track, from the row outward; tracks of one side only are compared."""


def number_of(wire: int, side: int) -> int:
    """The number of a track; that of the other side of the wire is next to it."""
    return 2 * wire + (side == ABOVE)


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
    spans: Mapping[Track, Span]
    width: float


Sided = tuple[int, int, float, Reach, str, float]
"""A tap whose side is known: plain, as the search makes very many."""


def taps_of(
    item: Item,
    arrangement: Arrangement,
    index: int,
    place: int,
    reaches: Mapping[int, tuple[int, int]],
) -> tuple[Sequence[Sided], float]:
    """The taps of an item with their sides, and its width."""
    sides, ranks, variant = arrangement.sides, arrangement.ranks, arrangement.variants[index]
    own: list[Sided] = [
        (wire, side or sides[wire], x, reach, label, depth)
        for wire, side, x, reach, label, depth in item.variants[variant]
    ]
    if not item.slot:
        return own, item.widths[variant]

    def key(tap: Sided) -> tuple[int, int]:
        first, last = reaches.get(tap[0], (place, place))
        rank = ranks[number_of(tap[0], tap[1])]
        if first < place:
            return (1, 0) if last > place else (0, rank)
        return (2, -rank) if last > place else (1, 0)

    by_side = [sorted((tap for tap in own if tap[1] == side), key=key) for side in (ABOVE, BELOW)]
    slot = item.slot
    width = max(slot * max(map(len, by_side)), item.widths[variant])
    placed: list[Sided] = [
        (wire, side, width / 2 + slot * (number - (len(taps) - 1) / 2), reach, label, depth)
        for taps in by_side
        for number, (wire, side, _, reach, label, depth) in enumerate(taps)
    ]
    return placed, width
