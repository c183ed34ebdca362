"""Next components to the right in a half-section: shift elements, shafts, walls, gear sets."""

from __future__ import annotations

from collections.abc import Iterator

from vstatics.pictures.schemes.coaxial.search.set_moves import SetMoves
from vstatics.pictures.schemes.coaxial.search.state import (
    CROSSING,
    FOLD,
    PAIR,
    TOP,
    WALL,
    Bars,
    Move,
    OrderStep,
    SectionState,
    fresh,
    links_of,
)


class Moves(SetMoves):
    """Generator of the components that can follow to the right in a half-section."""

    def after(self, state: SectionState) -> Iterator[Move]:
        """Yield all steps from a state, each with the next state and the cost."""
        yield from self._tops(state)
        yield from self._pairs(state)
        yield from self._walls(state)
        yield from super().after(state)

    def _tops(self, state: SectionState) -> Iterator[Move]:
        """Yield the steps in which a link begins at the housing, or crosses bars to reach it."""
        below, above, done = state
        bars = below + above
        for index, (link, bit) in enumerate(zip(self.train.tops, self.train.top_bits, strict=True)):
            if done & bit:
                continue
            ways: list[tuple[Bars, Bars, int]] = []
            if link not in links_of(bars):
                ways.append((below, (*above, 8 * link), 0))
                ways += [((*below, 8 * link), above, 0)] * (not above)
            elif self.crossing & bit:
                last = max(place for place, bar in enumerate(bars) if bar >> 3 == link)
                over = sum(bar >> 3 != link for bar in bars[last + 1 :])
                ways.append((below, above, CROSSING * over))
            for low, high, cost in ways:
                step = OrderStep("top", index, [(low, high)])
                yield Move(SectionState(low, high, done | bit), TOP, cost, step)

    def _pairs(self, state: SectionState) -> Iterator[Move]:
        """Yield the steps in which a component connects a present link to a new adjacent bar."""
        below, above, done = state
        bars = below + above
        alive = links_of(bars)
        for index, (pair, bit) in enumerate(
            zip(self.train.pairs, self.train.pair_bits, strict=True)
        ):
            if done & bit:
                continue
            ways: list[tuple[Bars, Bars, int]] = []
            for first_link, second_link in (pair, pair[::-1]):
                part = fresh(second_link, bars)
                if first_link in alive and part is not None:
                    again = FOLD * (second_link in alive)
                    adjacent = _adjacent(below, above, first_link, part)
                    ways += [(*both, again) for both in adjacent]
            if self.crossing & bit and alive.issuperset(pair):
                first, second = ([n for n, b in enumerate(bars) if b >> 3 == x] for x in pair)
                over = min(abs(a - b) - 1 for a in first for b in second)
                ways.append((below, above, CROSSING * max(over, 0)))
            for low, high, cost in ways:
                step = OrderStep("pair", index, [(low, high)])
                yield Move(SectionState(low, high, done | bit), PAIR, cost, step)

    def _walls(self, state: SectionState) -> Iterator[Move]:
        """Yield walls: steps in which a bar next to the planets continues on the opposite side."""
        below, above, done = state
        bars = below + above
        ways = []
        if below and bars.count(below[-1]) == 1:
            ways.append((below, (below[-1], *above), below[-1], len(below) - 1))
        if above and bars.count(above[0]) == 1:
            ways.append(((*below, above[0]), above, above[0], len(below)))
        for low, high, bar, place in ways:
            step = OrderStep("wall", bar >> 3, [(low, high)], place)
            yield Move(SectionState(low, high, done), WALL, FOLD, step)


def _adjacent(below: Bars, above: Bars, link: int, part: int) -> Iterator[tuple[Bars, Bars]]:
    """Yield the bars below and above with a new bar, `part`, next to a bar of `link`."""
    bars, low = below + above, len(below)
    places = {n + by for n, bar in enumerate(bars) if bar >> 3 == link for by in (0, 1)}
    for place in sorted(places):
        changed = (*bars[:place], part, *bars[place:])
        if place <= low:
            yield changed[: low + 1], above
        if place >= low:
            yield below, changed[low:]
