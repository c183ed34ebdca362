"""Sets as the next thing to the right: suns below the row of planets, rings above it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product
from typing import NamedTuple

from vstatics.pictures.schemes.coaxial.search.state import (
    CROSSING,
    EXCHANGE,
    FOLD,
    SET,
    TURN,
    Bars,
    Move,
    SectionState,
    SweepStep,
    fresh,
    in_two_parts,
    links_of,
)
from vstatics.pictures.schemes.coaxial.train import CoaxialTrain

NONE, TAKEN, KEPT, NEW = range(4)
"""How a carrier is joined to the bar beside it, which ends there, goes on, or begins."""
_Plane = tuple[tuple[int, int], tuple[int, int]]
"""Sun and ring, and their bits."""


class _Begun(NamedTuple):
    """A set as far as it is drawn."""

    state: SectionState
    cost: int
    seen: tuple[tuple[Bars, Bars], ...]


def _is_last(row: Bars, link: int) -> bool:
    return bool(row) and row[-1] >> 3 == link


def _end_of(row: Bars, carrier: int, joined: set[int]) -> list[int]:
    """How a carrier may be joined on its right: not, to a bar that is there, to a new one."""
    if not _is_last(row, carrier):
        return [NONE, NEW]
    return [NONE] if row[-1] in joined else [NONE, KEPT]


class _LeftArm(NamedTuple):
    """How a set begins."""

    before: SectionState
    carrier: int
    bit: int
    joined: set[int]
    """Bars to which the carrier is joined."""
    left: tuple[bool, bool]
    """Whether it is, below and above."""


class SetMoves(NamedTuple):
    """All ways to draw the next set of a train."""

    train: CoaxialTrain
    crossing: int
    """The bits of what may cross bars."""
    is_ordered: bool
    """Whether sets stand as they are given."""

    def after(self, state: SectionState) -> Iterator[Move]:
        """All of a state."""
        train = self.train
        for index, (one, bit) in enumerate(zip(train.sets, train.carrier_bits, strict=True)):
            if state.done & bit:
                continue
            passed = sum(not state.done & other for other in train.carrier_bits[:index])
            if self.is_ordered and passed:
                continue
            planes = list(zip(one.wheels, train.wheel_bits[index], strict=True))
            ways = [planes] if len(planes) == 1 else [planes, planes[::-1]]
            for is_turned, way in enumerate(ways):
                for move in self._set(state, one.carrier, bit, way):
                    step = move.step._replace(number=index, is_turned=bool(is_turned))
                    cost = move.cost + EXCHANGE * passed
                    yield move._replace(length=SET * len(way), cost=cost, step=step)

    def _set(
        self, state: SectionState, carrier: int, bit: int, planes: Sequence[_Plane]
    ) -> Iterator[Move]:
        """A set, its carrier joined to the left and to the right in all ways."""
        below, above, _ = state
        bars = below + above
        part = fresh(carrier, bars)
        is_low, is_high = _is_last(below, carrier), _is_last(above[::-1], carrier)
        new = [NEW] * (part is not None)
        ways = product(
            *([NONE, *([TAKEN, KEPT] if is_there else new)] for is_there in (is_low, is_high))
        )
        for low, high in ways:
            joined = {below[-1]} if low in (TAKEN, KEPT) else set()
            if high in (TAKEN, KEPT):
                joined |= {above[0]}
            if low == high == NEW or (is_low and is_high and low and high and len(joined) < 2):
                continue
            under, over = below, above
            if part is not None and NEW in (low, high):
                joined |= {part}
                under, over = ((*below, part), above) if low == NEW else (below, (part, *above))
            start = under, over
            if low == TAKEN:
                under = under[:-1]
            if high == TAKEN:
                over = over[1:]
            begun = _Begun(SectionState(under, over, state.done), 0, (start,))
            for at in self._meshed(begun, planes, carrier):
                left = low != NONE, high != NONE
                yield from self._left_behind(at, _LeftArm(state, carrier, bit, joined, left))

    def _meshed(self, begun: _Begun, planes: Sequence[_Plane], carrier: int) -> Iterator[_Begun]:
        """Plane by plane: the sun is the last bar below, the ring the first above."""
        if not planes:
            yield begun
            return
        (sun, ring), (sun_bit, ring_bit) = planes[0]
        (below, above, done), cost, seen = begun
        for low, extra in self._wheel(below, above, sun, sun_bit):
            for mirrored, more in self._wheel(above[::-1], low, ring, ring_bit):
                high = mirrored[::-1]
                now = SectionState(low, high, done | sun_bit | ring_bit)
                rest = self._without_ended(now, carrier)
                step = _Begun(rest, cost + extra + more, (*seen, (low, high)))
                yield from self._meshed(step, planes[1:], carrier)

    def _wheel(self, row: Bars, others: Bars, link: int, bit: int) -> Iterator[tuple[Bars, int]]:
        """The bars with that of a wheel as the last, and what this costs."""
        if not link or _is_last(row, link):
            yield row, 0
            return
        part = fresh(link, row + others)
        if part is not None:
            yield (*row, part), FOLD * (link in links_of(row + others))
        if self.crossing & bit and link in links_of(row):
            yield row, CROSSING * next(n for n, b in enumerate(row[::-1]) if b >> 3 == link)

    def _without_ended(self, state: SectionState, carrier: int) -> SectionState:
        """Wheels end at their planes where nothing else joins them."""
        below, above, done = state
        bars = below + above
        masks = self.train.masks
        ended = {bar >> 3 for bar in bars if not masks[bar >> 3] & ~done} - {carrier}
        if not ended:
            return state
        ended -= in_two_parts(bars)
        low, high = (tuple(bar for bar in row if bar >> 3 not in ended) for row in (below, above))
        return SectionState(low, high, done)

    def _left_behind(self, begun: _Begun, arm: _LeftArm) -> Iterator[Move]:
        """What is to the right of a set, its carrier joined there in all ways."""
        before, carrier, bit, joined, left = arm
        (below, above, done), cost, seen = begun
        done |= bit
        has_more = bool(self.train.masks[carrier] & ~done)
        ends = [_end_of(row, carrier, joined) for row in (below, above[::-1])]
        for low, high in product(*ends):
            own = set(joined)
            own |= {below[-1]} if low == KEPT else set()
            own |= {above[0]} if high == KEPT else set()
            if low == high == KEPT and below[-1] == above[0]:
                continue
            if not own:
                part = fresh(carrier, below + above)
                if part is None or (
                    not (low or high) and (has_more or carrier in links_of(below + above))
                ):
                    continue
                own = {part}
            main = min(own)
            under, over = (tuple(main if b in own else b for b in row) for row in (below, above))
            under += (main,) * (low == NEW)
            over = (main,) * (high == NEW) + over
            bars = [b for b in under + over if b >> 3 == carrier]
            parts = len(set(bars))
            is_needed = has_more or bool({*bars} - {main})
            if (is_needed and main not in bars) or (not is_needed and NEW in (low, high)):
                continue
            had = {b for b in before.below + before.above if b >> 3 == carrier}
            extra = FOLD * max(0, parts - max(len(had), 1)) + TURN * max(0, len(bars) - 1)
            right = low != NONE, high != NONE
            step = SweepStep("set", 0, (*seen, (under, over)), left=left, right=right)
            yield Move(SectionState(under, over, done), 0, cost + extra, step)
