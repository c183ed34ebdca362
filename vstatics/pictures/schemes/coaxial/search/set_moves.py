"""Gear sets as the next step to the right, suns below the row of planets and rings above."""

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
    OrderStep,
    SectionState,
    fresh,
    links_of,
)
from vstatics.pictures.schemes.coaxial.train import CoaxialTrain

NONE, TAKEN, KEPT, NEW = range(4)
"""Connection of a carrier's arm to the next bar: no bar, a bar that ends, continues, or begins."""
_Plane = tuple[tuple[int, int], tuple[int, int]]
"""Links of the sun and the ring of a plane, and the bits of the two edges."""


class _Begun(NamedTuple):
    """Gear set of which the first planes are drawn."""

    state: SectionState
    cost: int
    seen: tuple[tuple[Bars, Bars], ...]


def _is_last(row: Bars, link: int) -> bool:
    return bool(row) and row[-1] >> 3 == link


def _end_of(row: Bars, carrier: int, joined: set[int]) -> list[int]:
    """Return the possible connections of a carrier's right arm to the nearest bar of a row."""
    if not _is_last(row, carrier):
        return [NONE, NEW]
    return [NONE] if row[-1] in joined else [NONE, KEPT]


class _NextSet(NamedTuple):
    """Gear set that can be the next to be drawn."""

    number: int
    carrier: int
    bit: int
    planes: Sequence[_Plane]
    is_turned: bool
    cost: int
    """Cost of gear sets that are passed over. [-]"""


class _LeftArm(NamedTuple):
    """Left arm of a carrier, where a gear set begins."""

    parts: int
    """Number of parts of the carrier before the gear set, at least 1."""
    joined: set[int]
    """Bars that are connected to the carrier, as numbers."""
    left: tuple[bool, bool]
    """True if the arm meets the nearest bar below, and above."""


def without_ended(
    train: CoaxialTrain, state: SectionState, carrier: int | None = None
) -> SectionState:
    """Remove the bars of links without remaining connections, except the bars of a carrier."""
    below, above, done = state
    masks, remaining = train.masks, ~done
    ended = {
        bar for bar in below + above if not masks[bar >> 3] & remaining and bar >> 3 != carrier
    }
    if not ended:
        return state
    links = [bar >> 3 for bar in ended]
    if len({*links}) < len(links):  # separate parts of a link must be connected first
        ended = {bar for bar in ended if links.count(bar >> 3) == 1}
    low = tuple([bar for bar in below if bar not in ended])
    return SectionState(low, tuple([bar for bar in above if bar not in ended]), done)


class SetMoves(NamedTuple):
    """Generator of the possible ways to draw the next gear set of a half-section."""

    train: CoaxialTrain
    crossing: int
    """Components that may cross bars (lines of links), as a bit mask; 0 for no component."""
    is_ordered: bool
    """True to keep the given order of gear sets."""

    def after(self, state: SectionState) -> Iterator[Move]:
        """Yield all gear sets that can follow a state, with the next state and the cost."""
        train = self.train
        for index, (planes_of_set, bit) in enumerate(
            zip(train.sets, train.carrier_bits, strict=True)
        ):
            if state.done & bit:
                continue
            passed = sum(not state.done & earlier for earlier in train.carrier_bits[:index])
            if self.is_ordered and passed:
                continue
            planes = list(zip(planes_of_set.wheels, train.wheel_bits[index], strict=True))
            ways = [planes] if len(planes) == 1 else [planes, planes[::-1]]
            for way in ways:
                is_turned, cost = way is not planes, EXCHANGE * passed
                yield from self._set(
                    state, _NextSet(index, planes_of_set.carrier, bit, way, is_turned, cost)
                )

    def _set(self, state: SectionState, gear_set: _NextSet) -> Iterator[Move]:
        """Yield a gear set with all possible connections of the carrier on the left and right."""
        below, above, _ = state
        carrier, bars = gear_set.carrier, below + above
        part, parts = fresh(carrier, bars), len({bar for bar in bars if bar >> 3 == carrier})
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
            begun = _Begun(SectionState(under, over, state.done), gear_set.cost, (start,))
            arm = _LeftArm(max(parts, 1), joined, (low != NONE, high != NONE))
            for at in self._meshed(begun, gear_set.planes, carrier):
                yield from self._left_behind(at, arm, gear_set)

    def _meshed(self, begun: _Begun, planes: Sequence[_Plane], carrier: int) -> Iterator[_Begun]:
        """Yield a gear set with further planes: suns meet the last bar below, rings the first."""
        if not planes:
            yield begun
            return
        (sun, ring), (sun_bit, ring_bit) = planes[0]
        (below, above, done), cost, seen = begun
        for low, extra in self._wheel(below, above, sun, sun_bit):
            for mirrored, more in self._wheel(above[::-1], low, ring, ring_bit):
                high = mirrored[::-1]
                now = SectionState(low, high, done | sun_bit | ring_bit)
                remaining = without_ended(self.train, now, carrier)
                step = _Begun(remaining, cost + extra + more, (*seen, (low, high)))
                yield from self._meshed(step, planes[1:], carrier)

    def _wheel(self, row: Bars, others: Bars, link: int, bit: int) -> Iterator[tuple[Bars, int]]:
        """Yield the bars of a row with a sun's or ring's bar next to the planets, and the cost."""
        if not link or _is_last(row, link):
            yield row, 0
            return
        part = fresh(link, row + others)
        if part is not None:
            yield (*row, part), FOLD * (link in links_of(row + others))
        if self.crossing & bit and link in links_of(row):
            yield row, CROSSING * next(n for n, b in enumerate(row[::-1]) if b >> 3 == link)

    def _left_behind(self, begun: _Begun, arm: _LeftArm, gear_set: _NextSet) -> Iterator[Move]:
        """Yield the steps of a gear set, with all connections of the carrier on the right."""
        (below, above, done), cost, seen = begun
        carrier, length = gear_set.carrier, SET * len(gear_set.planes)
        done |= gear_set.bit
        has_more = bool(self.train.masks[carrier] & ~done)
        bars = below + above
        part, is_there = fresh(carrier, bars), any(bar >> 3 == carrier for bar in bars)
        ends = [_end_of(row, carrier, arm.joined) for row in (below, above[::-1])]
        for low, high in product(*ends):
            carrier_bars = set(arm.joined)
            carrier_bars |= {below[-1]} if low == KEPT else set()
            carrier_bars |= {above[0]} if high == KEPT else set()
            if low == high == KEPT and below[-1] == above[0]:
                continue
            if not carrier_bars:
                if part is None or (not (low or high) and (has_more or is_there)):
                    continue
                carrier_bars = {part}
            main = min(carrier_bars)
            under, over = below, above
            if len(carrier_bars) > 1:
                under, over = (
                    tuple([main if b in carrier_bars else b for b in row]) for row in (below, above)
                )
            under += (main,) * (low == NEW)
            over = (main,) * (high == NEW) + over
            met = [b for b in under + over if b >> 3 == carrier]
            parts = {*met}
            is_needed = has_more or bool(parts - {main})
            if (is_needed and main not in parts) or (not is_needed and NEW in (low, high)):
                continue
            extra = FOLD * max(0, len(parts) - arm.parts) + TURN * max(0, len(met) - 1)
            step = OrderStep(
                "set",
                gear_set.number,
                (*seen, (under, over)),
                is_turned=gear_set.is_turned,
                left=arm.left,
                right=(low != NONE, high != NONE),
            )
            yield Move(SectionState(under, over, done), length, cost + extra, step)
