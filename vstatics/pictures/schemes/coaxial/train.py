"""Train: graph of the components on one axis, and their connections to links and housing."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import count, islice
from typing import NamedTuple

from vstatics.core.groups import grouped

AXIS, HOUSING_VERTEX = -1, 0
"""Vertices of the axis and of the housing. The vertices of links are the link numbers, from 1."""


class Planes(NamedTuple):
    """Links of a gear set: the carrier, and sun and ring of each plane (0 if missing)."""

    carrier: int
    wheels: Sequence[tuple[int, int]]


class TrainEdge(NamedTuple):
    """Edge between two vertices. The bit identifies the edge in sums of bits."""

    bit: int
    first: int
    second: int


@dataclass(frozen=True)
class CoaxialTrain:
    """Graph of links, housing and axis, with components as edges.

    Parameters
    ----------
    sets : sequence of Planes
    pairs : sequence of pairs of int
        Links of each clutch, shaft or spring.
    tops : sequence of int
        Links connected to or through the housing: by brakes, supports, gears of other axes.
    start : int
        Link that enters along the axis from the left.
    end : int
        Link that leaves along the axis to the right; 0 if there is none.

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
        """Return a hash of the content, because equal trains have equal layouts."""
        return hash(repr(self))

    @cached_property
    def _bits(self) -> list[list[int]]:
        """Bits of gears (also of missing gears), carriers, pairs, tops and the output end."""
        bits = (1 << number for number in count())
        gears = 2 * sum(len(planes.wheels) for planes in self.sets)
        sizes = gears, len(self.sets), len(self.pairs), len(self.tops), 1
        return [[*islice(bits, size)] for size in sizes]

    @cached_property
    def wheel_bits(self) -> list[list[tuple[int, int]]]:
        """Bits of the edges of sun and ring, by gear set and plane; 0 where missing."""
        bits = iter(self._bits[0])
        return [
            [(bool(sun) * next(bits), bool(ring) * next(bits)) for sun, ring in planes.wheels]
            for planes in self.sets
        ]

    @cached_property
    def carrier_bits(self) -> list[int]:
        """Bit of the carrier of each gear set."""
        return self._bits[1]

    @cached_property
    def pair_bits(self) -> list[int]:
        """Bit of each clutch, shaft or spring in `pairs`."""
        return self._bits[2]

    @cached_property
    def couplings(self) -> dict[tuple[int, int], list[tuple[int, int]]]:
        """Indices and bits of the `pairs` between two links, by both orders of the links."""
        pairs = enumerate(zip(self.pairs, self.pair_bits, strict=True))
        return grouped(
            (ends, (index, bit)) for index, (pair, bit) in pairs for ends in {pair, pair[::-1]}
        )

    @cached_property
    def top_bits(self) -> list[int]:
        """Bit of each connection to the housing in `tops`."""
        return self._bits[3]

    @cached_property
    def tops_of(self) -> dict[int, list[tuple[int, int]]]:
        """Indices and bits of the connections to the housing of each link."""
        tops = enumerate(zip(self.tops, self.top_bits, strict=True))
        return grouped((link, (index, bit)) for index, (link, bit) in tops)

    @cached_property
    def end_bit(self) -> int:
        """Bit of the output end of the axis, which is drawn after everything else."""
        return self._bits[4][0]

    @cached_property
    def all_bits(self) -> int:
        """Sum of the bits of all edges, without the output end of the axis."""
        wheels = [bit for of_set in self.wheel_bits for both in of_set for bit in both]
        return sum([*wheels, *self.carrier_bits, *self.pair_bits, *self.top_bits])

    @cached_property
    def masks(self) -> dict[int, int]:
        """Sum of the bits of all connections of each link."""
        masks = defaultdict[int, int](int, {self.start: 0})
        for edge in self.edges:
            for link in (edge.first, edge.second):
                masks[link] |= edge.bit
        for planes, bit in zip(self.sets, self.carrier_bits, strict=True):
            masks[planes.carrier] |= bit
        return dict(masks)

    @cached_property
    def edges(self) -> list[TrainEdge]:
        """Edges from carriers to gears, between two links, and from the output link to the axis."""
        edges = [
            TrainEdge(bit, planes.carrier, wheel)
            for planes, bits in zip(self.sets, self.wheel_bits, strict=True)
            for wheels, plane_bits in zip(planes.wheels, bits, strict=True)
            for wheel, bit in zip(wheels, plane_bits, strict=True)
            if wheel
        ]
        edges += [TrainEdge(b, *p) for b, p in zip(self.pair_bits, self.pairs, strict=True)]
        edges += [
            TrainEdge(b, link, HOUSING_VERTEX)
            for b, link in zip(self.top_bits, self.tops, strict=True)
        ]
        return [*edges, TrainEdge(self.end_bit, self.end, AXIS)] if self.end else edges
