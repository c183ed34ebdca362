"""What is joined about one axis: sets, couplings of two links, couplings with the housing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

AXIS, HOUSING_VERTEX = -1, 0
"""Vertices beside the links, whose numbers are from 1."""


class Planes(NamedTuple):
    """A set: its carrier, and the sun and the ring of each of its planes, 0 where there is none."""

    carrier: int
    wheels: Sequence[tuple[int, int]]


class TrainEdge(NamedTuple):
    """Two vertices that are joined, and the bit that says whether this is drawn already."""

    bit: int
    one: int
    other: int


@dataclass(frozen=True)
class CoaxialTrain:
    """A graph of links, housing and axis.

    Parameters
    ----------
    sets : sequence of Planes
    pairs : sequence of pairs of int
        Clutches, shafts, springs.
    tops : sequence of int
        Links that go to the housing, or out through it: brakes, supports, wheels of other axes.
    start : int
        The link that comes along the axis from the left.
    end : int
        That which goes along the axis to the right; 0 for none.

    Examples
    --------
    >>> train = CoaxialTrain([Planes(3, [(1, 2)])], [], [2], 1, 3)
    >>> len(train.edges)
    4
    """

    sets: Sequence[Planes]
    pairs: Sequence[tuple[int, int]]
    tops: Sequence[int]
    start: int
    end: int

    def __hash__(self) -> int:
        """Return a hash of the content: equal trains have the same layout."""
        return hash(repr(self))

    @cached_property
    def wheel_bits(self) -> list[list[tuple[int, int]]]:
        """By set and plane, the bits of sun and ring; 0 where there is none."""
        bits: list[list[tuple[int, int]]] = []
        number = 0
        for one in self.sets:
            bits.append([])
            for sun, ring in one.wheels:
                bits[-1].append((bool(sun) << number, bool(ring) << (number + 1)))
                number += 2
        return bits

    @property
    def _first_bit(self) -> int:
        return 2 * sum(len(one.wheels) for one in self.sets)

    @cached_property
    def carrier_bits(self) -> list[int]:
        """By set."""
        return [1 << (self._first_bit + n) for n in range(len(self.sets))]

    @cached_property
    def pair_bits(self) -> list[int]:
        """By pair."""
        first = self._first_bit + len(self.sets)
        return [1 << (first + n) for n in range(len(self.pairs))]

    @cached_property
    def couplings(self) -> dict[tuple[int, int], list[tuple[int, int]]]:
        """By two links, in both orders, the pairs that join them, and their bits."""
        found: dict[tuple[int, int], list[tuple[int, int]]] = {}
        for index, ((one, other), bit) in enumerate(zip(self.pairs, self.pair_bits, strict=True)):
            for ends in {(one, other), (other, one)}:
                found.setdefault(ends, []).append((index, bit))
        return found

    @cached_property
    def top_bits(self) -> list[int]:
        """By top."""
        first = self._first_bit + len(self.sets) + len(self.pairs)
        return [1 << (first + n) for n in range(len(self.tops))]

    @cached_property
    def end_bit(self) -> int:
        """Of the end of the axis: what is never drawn before all else is."""
        return 1 << (self._first_bit + len(self.sets) + len(self.pairs) + len(self.tops))

    @cached_property
    def all_bits(self) -> int:
        """Of all that is to be drawn, the end of the axis left out."""
        wheels = [bit for own in self.wheel_bits for both in own for bit in both]
        return sum([*wheels, *self.carrier_bits, *self.pair_bits, *self.top_bits])

    @cached_property
    def masks(self) -> dict[int, int]:
        """By link, the bits of all that joins it."""
        found: dict[int, int] = {}
        for edge in self.edges:
            for link in (edge.one, edge.other):
                found[link] = found.get(link, 0) | edge.bit
        for one, bit in zip(self.sets, self.carrier_bits, strict=True):
            found[one.carrier] = found.get(one.carrier, 0) | bit
        return found | {self.start: found.get(self.start, 0)}

    @cached_property
    def edges(self) -> list[TrainEdge]:
        """Carriers with their wheels, couplings, the end at the axis."""
        found = [
            TrainEdge(bit, one.carrier, wheel)
            for one, bits in zip(self.sets, self.wheel_bits, strict=True)
            for wheels, own in zip(one.wheels, bits, strict=True)
            for wheel, bit in zip(wheels, own, strict=True)
            if wheel
        ]
        found += [TrainEdge(b, *p) for b, p in zip(self.pair_bits, self.pairs, strict=True)]
        found += [
            TrainEdge(b, link, HOUSING_VERTEX)
            for b, link in zip(self.top_bits, self.tops, strict=True)
        ]
        return [*found, TrainEdge(self.end_bit, self.end, AXIS)] if self.end else found
