"""States that follow a state of the search, in which neighbouring bars are connected."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import pairwise
from typing import NamedTuple

from vstatics.pictures.schemes.coaxial.search.moves import Moves
from vstatics.pictures.schemes.coaxial.search.set_moves import without_ended
from vstatics.pictures.schemes.coaxial.search.state import (
    PAIR,
    TOP,
    WALL,
    Bars,
    OrderStep,
    SectionState,
)

MOST_FURTHER = 2
"""Largest number of bars at a position in addition to a single bar per link."""
MOST_REMEMBERED = 1000
"""Largest number of states whose successors are remembered, to limit memory."""


class Successor(NamedTuple):
    """State that follows, with all its bars, and the steps that lead to it."""

    state: SectionState
    steps: tuple[OrderStep, ...]
    cost: int
    """Cost of the steps. [-]"""


class Successors:
    """Generator of the states that follow a state; remembers them for the next attempt."""

    def __init__(self, moves: Moves) -> None:
        self.moves = moves
        self.after = lru_cache(MOST_REMEMBERED)(self._after)

    def first(self) -> Iterator[Successor]:
        """Yield the states at the left end of the axis."""
        start = (8 * self.moves.train.start,)
        for below, above in ((start, ()), ((), start)):
            yield self._settled(SectionState(below, above, 0))

    def _after(self, state: SectionState) -> Sequence[Successor]:
        """Return the states that follow a state."""
        following = []
        for move in self.moves.after(state):
            wide = move.length * max(1, len(move.state.below) + len(move.state.above))
            settled, steps, cost = self._settled(move.state)
            following.append(Successor(settled, (move.step, *steps), wide + move.cost + cost))
        return following

    def _settled(self, state: SectionState) -> Successor:
        """Return the state after all neighbouring bars that can be connected are connected."""
        steps: tuple[OrderStep, ...] = ()
        cost = 0
        while True:
            state = without_ended(self.moves.train, state)
            connection = self._next(state)
            if connection is None:
                return Successor(state, steps, cost)
            state, step, length = connection
            steps, cost = (*steps, step), cost + length * len(state.below + state.above)

    def _next(self, state: SectionState) -> tuple[SectionState, OrderStep, int] | None:
        """Return a step that connects neighbouring bars, or the outermost bar to the housing."""
        train, (below, above, done) = self.moves.train, state
        bars, couplings = below + above, train.couplings
        for place, links in enumerate(pairwise([bar >> 3 for bar in bars])):
            if links[0] == links[1] and bars[place] != bars[place + 1]:
                main, other = bars[place : place + 2]
                low, high = (
                    tuple([main if bar == other else bar for bar in row]) for row in (below, above)
                )
                step = OrderStep("wall", links[0], [(below, above)], place)
                return SectionState(low, high, done), step, WALL
            for index, bit in couplings.get(links, ()):
                if not done & bit:
                    step = OrderStep("pair", index, [(below, above)], place)
                    return SectionState(below, above, done | bit), step, PAIR
        for index, bit in train.tops_of.get(bars[-1] >> 3, ()) if bars else ():
            if not done & bit:
                step = OrderStep("top", index, [(below, above)])
                return SectionState(below, above, done | bit), step, TOP
        return None


def thinned(state: SectionState) -> Iterator[SectionState]:
    """Yield a state with all bars, and with a single bar for each connected group of bars."""
    for below, above in _selections(state.below, state.above):
        yield SectionState(*_numbered(below, above), state.done)


def _selections(below: Bars, above: Bars) -> Iterator[tuple[Bars, Bars]]:
    bars, low = below + above, len(below)
    links = {bar >> 3 for bar in bars}
    if len(links) == len(bars):
        yield below, above
        return
    ways = [tuple(range(len(bars)))]
    for bar in dict.fromkeys(bars):
        group = [place for place, other_bar in enumerate(bars) if other_bar == bar]
        if len(group) > 1:
            others = [{*group} - {chosen} for chosen in group]
            ways += [
                tuple(place for place in way if place not in left_out)
                for way in ways
                for left_out in others
            ]
    for way in ways:
        if len(way) - len(links) <= MOST_FURTHER:
            chosen_bars, start = tuple([bars[place] for place in way]), bisect_left(way, low)
            yield chosen_bars[:start], chosen_bars[start:]


def _numbered(below: Bars, above: Bars) -> tuple[Bars, Bars]:
    """Rename the parts of each link by numbers in order of appearance."""
    if not any(bar & 7 for bar in below + above):  # each link has a single part
        return below, above
    names: dict[int, int] = {}
    parts: dict[int, int] = {}
    for bar in below + above:
        if bar not in names:
            link = bar >> 3
            names[bar] = 8 * link + parts.get(link, 0)
            parts[link] = parts.get(link, 0) + 1
    return tuple([names[bar] for bar in below]), tuple([names[bar] for bar in above])
