"""The next thing to the right in a half-section: a coupling, a wall of a link, a set.

A state is the bars at one place along the axis, from it outward: those below the row of planets
and those above. A bar is eight times its link, and the number of the part of the link that it
belongs to: parts that are not joined yet must be, further right.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product
from typing import NamedTuple

from vstatics.pictures.schemes.coaxial.train import CoaxialTrain

Bars = tuple[int, ...]
SET, PAIR, TOP, WALL = 3, 2, 1, 1
"""Lengths along the axis, for the cost of bars."""
FOLD, TURN, CROSSING, EXCHANGE = 8, 2, 400, 10
"""What cost a wall of a link, a further bar of it, a crossing, two sets in another order."""
NONE, TAKEN, KEPT, NEW = range(4)
"""How a carrier is joined to the bar beside it, which ends there, goes on, or begins."""


class SectionState(NamedTuple):
    """The bars at one place along the axis, and what is drawn to the left of it."""

    below: Bars
    above: Bars
    done: int


class SweepStep(NamedTuple):
    """Something that stands at a place along the axis."""

    kind: str
    """``top``, ``pair``, ``wall`` or ``set``."""
    number: int
    """Of the top, the pair or the set; the link of a wall."""
    bars: Sequence[tuple[Bars, Bars]]
    """Bars there; of a set at its left arm, at its planes, at its right arm."""
    place: int = -1
    """Of two neighbours that are joined the lower one's, from the axis; -1 for the nearest."""
    is_turned: bool = False
    """A set whose planes are drawn from right to left."""
    left: tuple[bool, bool] = (False, False)
    """Whether the arm of a carrier is joined to the last bar below, to the first above."""
    right: tuple[bool, bool] = (False, False)


class Move(NamedTuple):
    """A step, what comes behind it, and its cost but for the bars."""

    state: SectionState
    length: int
    cost: int
    step: SweepStep


def links_of(bars: Bars) -> set[int]:
    """The links that have bars."""
    return {bar >> 3 for bar in bars}


def fresh(link: int, bars: Bars) -> int | None:
    """A new part of a link; None if it has two already."""
    own = {bar for bar in bars if bar >> 3 == link}
    if len(own) > 1:
        return None
    return 8 * link + (8 * link in own)


class Moves(NamedTuple):
    """All next steps of a train."""

    train: CoaxialTrain
    crosses: bool = False
    """Whether steps may cross bars."""
    is_ordered: bool = False
    """Whether sets stand as they are given."""

    def after(self, state: SectionState) -> Iterator[Move]:
        """All of a state."""
        yield from self._tops(state)
        yield from self._pairs(state)
        yield from self._walls(state)
        yield from self._sets(state)

    def _tops(self, state: SectionState) -> Iterator[Move]:
        """Links that begin at the housing; those that end there come by themselves."""
        below, above, done = state
        bars = below + above
        for index, (link, bit) in enumerate(zip(self.train.tops, self.train.top_bits, strict=True)):
            if done & bit:
                continue
            ways: list[tuple[Bars, Bars, int]] = []
            if link not in links_of(bars):
                ways.append((below, (*above, 8 * link), 0))
                ways += [((*below, 8 * link), above, 0)] * (not above)
            elif self.crosses:
                last = max(place for place, bar in enumerate(bars) if bar >> 3 == link)
                over = sum(bar >> 3 != link for bar in bars[last + 1 :])
                ways.append((below, above, CROSSING * over))
            for low, high, cost in ways:
                step = SweepStep("top", index, [(low, high)])
                yield Move(SectionState(low, high, done | bit), TOP, cost, step)

    def _pairs(self, state: SectionState) -> Iterator[Move]:
        """Couplings of which one link begins, or begins anew, beside the other."""
        below, above, done = state
        bars = below + above
        alive = links_of(bars)
        for index, (pair, bit) in enumerate(
            zip(self.train.pairs, self.train.pair_bits, strict=True)
        ):
            if done & bit:
                continue
            ways: list[tuple[Bars, Bars, int]] = []
            for one, other in (pair, pair[::-1]):
                part = fresh(other, bars)
                if one in alive and part is not None:
                    again = FOLD * (other in alive)
                    for low, high, cost in _beside(below, above, one, part, wraps=not again):
                        ways.append((low, high, cost + again))
            if self.crosses and alive.issuperset(pair):
                first, second = ([n for n, b in enumerate(bars) if b >> 3 == x] for x in pair)
                over = min(abs(a - b) - 1 for a in first for b in second)
                ways.append((below, above, CROSSING * max(over, 0)))
            for low, high, cost in ways:
                step = SweepStep("pair", index, [(low, high)])
                yield Move(SectionState(low, high, done | bit), PAIR, cost, step)

    def _walls(self, state: SectionState) -> Iterator[Move]:
        """Links that pass the row of planets."""
        below, above, done = state
        bars = below + above
        ways = []
        if below and bars.count(below[-1]) == 1:
            ways.append((below, (below[-1], *above), below[-1], len(below) - 1))
        if above and bars.count(above[0]) == 1:
            ways.append(((*below, above[0]), above, above[0], len(below)))
        for low, high, bar, place in ways:
            step = SweepStep("wall", bar >> 3, [(low, high)], place)
            yield Move(SectionState(low, high, done), WALL, FOLD, step)

    def _sets(self, state: SectionState) -> Iterator[Move]:
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
                yield from self._left_behind(at, state, carrier, bit, joined, left)

    def _meshed(self, begun: _Begun, planes: Sequence[_Plane], carrier: int) -> Iterator[_Begun]:
        """Plane by plane: the sun is the last bar below, the ring the first above."""
        if not planes:
            yield begun
            return
        (sun, ring), (sun_bit, ring_bit) = planes[0]
        (below, above, done), cost, seen = begun
        for low, extra in self._wheel(below, above, sun):
            for mirrored, more in self._wheel(above[::-1], low, ring):
                high = mirrored[::-1]
                now = SectionState(low, high, done | sun_bit | ring_bit)
                rest = self._without_ended(now, carrier)
                step = _Begun(rest, cost + extra + more, (*seen, (low, high)))
                yield from self._meshed(step, planes[1:], carrier)

    def _wheel(self, row: Bars, others: Bars, link: int) -> Iterator[tuple[Bars, int]]:
        """The bars with that of a wheel as the last, and what this costs."""
        if not link or _is_last(row, link):
            yield row, 0
            return
        part = fresh(link, row + others)
        if part is not None:
            yield (*row, part), FOLD * (link in links_of(row + others))
        if self.crosses and link in links_of(row):
            yield row, CROSSING * next(n for n, b in enumerate(row[::-1]) if b >> 3 == link)

    def _without_ended(self, state: SectionState, carrier: int) -> SectionState:
        """Wheels end at their planes where nothing else joins them."""
        below, above, done = state
        bars = below + above
        ended = {
            bar
            for bar in bars
            if bar >> 3 != carrier
            and not self.train.masks[bar >> 3] & ~done
            and fresh(bar >> 3, bars) is not None
        }
        low, high = (tuple(bar for bar in row if bar not in ended) for row in (below, above))
        return SectionState(low, high, done)

    def _left_behind(  # noqa: PLR0913, PLR0917 - where the set began, and how its carrier did
        self,
        begun: _Begun,
        before: SectionState,
        carrier: int,
        bit: int,
        joined: set[int],
        left: tuple[bool, bool],
    ) -> Iterator[Move]:
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


def _beside(
    below: Bars, above: Bars, link: int, part: int, *, wraps: bool
) -> Iterator[tuple[Bars, Bars, int]]:
    """All places of a new bar next to those of a link, or between two bars of it."""
    for row, is_low in ((below, True), (above, False)):
        for at, bar in enumerate(row):
            if bar >> 3 != link:
                continue
            ways = [((*row[:at], part, *row[at:]), 0), ((*row[: at + 1], part, *row[at + 1 :]), 0)]
            if wraps:
                ways.append(((*row[:at], bar, part, bar, *row[at + 1 :]), FOLD))
            for changed, cost in ways:
                yield (changed, above, cost) if is_low else (below, changed, cost)
            if is_low and at == len(row) - 1:
                yield below, (part, *above), 0
            if not is_low and not at:
                yield (*below, part), above, 0
