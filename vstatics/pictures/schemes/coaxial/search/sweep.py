"""Deterministic search for the order of components along the axis.

The search (A*) expands the state with the smallest sum of past cost and weighted estimate of the
remaining cost; a large weight reaches an end sooner. Components that connect neighbouring bars
(lines of links) are added at once, which is never worse.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator, Sequence
from functools import lru_cache
from heapq import heappop, heappush
from itertools import combinations, count, islice, pairwise
from operator import attrgetter
from typing import NamedTuple

from vstatics.pictures.schemes.coaxial.planarity import has_half_section
from vstatics.pictures.schemes.coaxial.search.moves import Moves
from vstatics.pictures.schemes.coaxial.search.remainder import can_go_on
from vstatics.pictures.schemes.coaxial.search.set_moves import without_ended
from vstatics.pictures.schemes.coaxial.search.stacked import stacked
from vstatics.pictures.schemes.coaxial.search.state import (
    PAIR,
    SET,
    TOP,
    WALL,
    Bars,
    SectionState,
    SweepStep,
)
from vstatics.pictures.schemes.coaxial.train import CoaxialTrain


class SweepEffort(NamedTuple):
    """Attempts of a search, each a weight of the estimated cost and a largest number of states."""

    planar: Sequence[tuple[float, int]]
    """Attempts without crossings."""
    crossing: Sequence[tuple[float, int]]
    """Attempts in which at most `MOST_CROSSING` shift elements or shafts may cross links."""
    last: Sequence[tuple[float, int]]
    """Attempts in which every component that can cross links may do so."""
    is_first: bool = False
    """True to take the first arrangement with crossings; False to take the best."""


CROSSING_TRIES = (1000.0, 800), (30.0, 400), (100.0, 400)
LAST_TRIES = (1000.0, 400), (100.0, 800)
FULL = SweepEffort(((3.0, 300), (6.0, 1200), (5.0, 2500), (10.0, 4000)), CROSSING_TRIES, LAST_TRIES)
QUICK = SweepEffort(((5.0, 400), (10.0, 2500), (3.0, 2500)), CROSSING_TRIES, LAST_TRIES)
"""Effort for a small diagram in a list."""
BRIEF = SweepEffort(
    ((5.0, 150), (3.0, 150), (6.0, 800)), ((1000.0, 100),), ((1000.0, 400),), is_first=True
)
"""Effort for a picture with boxes."""
MOST_SEARCHED_SETS = 20
"""Largest number of gear sets for which the search is tried at all."""
LAST_SETS = 6
"""Number of gear sets above which `last` attempts have fewer states, to save time."""
MOST_CROSSING = 2
"""Largest number of shift elements and shafts that may cross links simultaneously."""
MOST_CHOICES = 12
"""Largest number of choices of crossing components that are tried, in the order of the train."""
MOST_FURTHER = 2
"""Largest number of bars at a position in addition to a single bar per link."""
BARS_OF_REST = 2
"""Number of bars along each remaining component in the estimate of the remaining cost."""
_Trace = tuple[tuple[SweepStep, ...], "_Trace | None"]


class Swept(NamedTuple):
    """Result of a search: the components from left to right."""

    steps: Sequence[SweepStep]
    is_ordered: bool = True
    """False if gear sets should be in the given order but could not be."""


@lru_cache(maxsize=64)
def swept(train: CoaxialTrain, *, is_ordered: bool = False, effort: SweepEffort = FULL) -> Swept:
    """Return the components of a train from left to right.

    Parameters
    ----------
    is_ordered : bool
        True to keep gear sets in the given order, even with crossings, if a way is found soon.
    effort : SweepEffort, optional
        Attempts of the search; if all fail, each link is one line (`stacked`).

    Examples
    --------
    >>> from vstatics.pictures.schemes.coaxial.train import Planes
    >>> train = CoaxialTrain([Planes(3, [(1, 2)])], [], [2], 1, 3)
    >>> [step.kind for step in swept(train).steps]
    ['set', 'top']
    """
    if len(train.sets) > MOST_SEARCHED_SETS:
        return Swept(stacked(train), not is_ordered)
    is_planar = has_half_section(train)
    for ordered in (True, False)[not is_ordered :]:
        planar = (
            _SweepSearch(Moves(train, 0, ordered), weight).found(most)
            for weight, most in (effort.planar if is_planar else ())
        )
        arrangement = next(filter(None, planar), None) or _with_crossings(
            train, effort, is_planar=is_planar, is_ordered=ordered
        )
        if arrangement is not None:
            return Swept(arrangement.steps, ordered or not is_ordered)
    return Swept(stacked(train), not is_ordered)


def _with_crossings(
    train: CoaxialTrain, effort: SweepEffort, *, is_planar: bool, is_ordered: bool
) -> _FoundSteps | None:
    """Return the cheapest arrangement with few crossings or, failing that, the first with any.

    With `effort.is_first`, the first arrangement with few crossings is returned.
    """
    tried = (
        _SweepSearch(Moves(train, crossing, is_ordered), weight).found(most)
        for crossing in _crossing(train, is_planar=is_planar)
        for weight, most in effort.crossing
    )
    ways = [*islice(filter(None, tried), 1 if effort.is_first else None)]
    if ways:
        return min(ways, key=attrgetter("cost"))
    every, part = (
        Moves(train, train.all_bits, is_ordered),
        min(1.0, LAST_SETS / max(1, len(train.sets))) ** 2,
    )
    last = (_SweepSearch(every, weight).found(int(part * most)) for weight, most in effort.last)
    return next(filter(None, last), None)


def _crossing(train: CoaxialTrain, *, is_planar: bool) -> list[int]:
    """Return choices of the fewest components that leave a planar remainder, as bit masks."""
    bits = [*train.pair_bits, *train.top_bits]
    for number in range(1, MOST_CROSSING + 1):
        ways = (sum(way) for way in combinations(bits, number))
        fit = (way for way in ways if is_planar or has_half_section(train, way))
        choices = list(islice(fit, MOST_CHOICES))
        if choices:
            return choices
    return []


class _FoundSteps(NamedTuple):
    steps: Sequence[SweepStep]
    cost: int


class _SweepSearch(NamedTuple):
    moves: Moves
    weight: float

    def found(self, most: int) -> _FoundSteps | None:  # noqa: C901 - a single loop
        """Return the cheapest steps to the end, unless the search needs too many states."""
        train, number = self.moves.train, count()
        waiting: list[tuple[float, int, int, SectionState, _Trace]] = []
        best: dict[SectionState, int] = {}
        closed: set[SectionState] = set()

        def add(state: SectionState, cost: int, trace: _Trace) -> None:
            # The output is not at the axis.
            cost += state.done == train.all_bits and bool(state.above)
            if state not in closed and best.get(state, cost + 1) > cost:
                best[state] = cost
                guess = cost + self.weight * self._rest(state.done)
                heappush(waiting, (guess, next(number), cost, state, trace))

        for below, above in (((8 * train.start,), ()), ((), (8 * train.start,))):
            for state, steps, cost in self._settled(SectionState(below, above, 0)):
                add(state, cost, (steps, None))
        while waiting and len(closed) < 8 * most:
            _, _, cost, state, trace = heappop(waiting)
            if state in closed:
                continue
            closed.add(state)
            bars = state.below + state.above
            if not can_go_on(train, bars, state.done | self.moves.crossing):
                continue
            ends = {8 * train.end} if train.end else set()
            if state.done == train.all_bits and set(bars) == ends:
                return _FoundSteps(_unrolled(trace), cost)
            most -= 1
            if most < 0:
                return None
            for move in self.moves.after(state):
                step = move.step._replace(before=(state.below, state.above))
                wide = move.length * max(1, len(move.state.below) + len(move.state.above))
                for settled, steps, more in self._settled(move.state):
                    add(settled, cost + wide + move.cost + more, ((step, *steps), trace))
        return None

    def _rest(self, done: int) -> int:
        train = self.moves.train
        sets = zip(train.sets, train.carrier_bits, strict=True)
        value = sum(SET * len(planes.wheels) for planes, bit in sets if not done & bit)
        return BARS_OF_REST * (value + PAIR * sum(not done & bit for bit in train.pair_bits))

    def _settled(
        self, state: SectionState
    ) -> Iterator[tuple[SectionState, tuple[SweepStep, ...], int]]:
        """Yield the states after neighbouring bars are connected, also without redundant bars."""
        steps: tuple[SweepStep, ...] = ()
        cost = 0
        while True:
            state = without_ended(self.moves.train, state)
            connection = self._next(state)
            if connection is None:
                break
            state, step, length = connection
            steps, cost = (*steps, step), cost + length * len(state.below + state.above)
        for below, above in _thinned(state.below, state.above):
            yield SectionState(*_numbered(below, above), state.done), steps, cost

    def _next(self, state: SectionState) -> tuple[SectionState, SweepStep, int] | None:
        """Return a step that connects neighbouring bars, or the outermost bar to the housing."""
        train, (below, above, done) = self.moves.train, state
        bars, here = below + above, [(below, above)]
        for place, (low_bar, high_bar) in enumerate(pairwise(bars)):
            if low_bar >> 3 == high_bar >> 3 and low_bar != high_bar:
                low, high = (
                    tuple(low_bar if b == high_bar else b for b in row) for row in (below, above)
                )
                return (
                    SectionState(low, high, done),
                    SweepStep("wall", low_bar >> 3, here, place),
                    WALL,
                )
            for index, bit in train.couplings.get((low_bar >> 3, high_bar >> 3), ()):
                if not done & bit:
                    step = SweepStep("pair", index, here, place)
                    return state._replace(done=done | bit), step, PAIR
        for index, (link, bit) in enumerate(zip(train.tops, train.top_bits, strict=True)):
            if bars and not done & bit and link == bars[-1] >> 3:
                return state._replace(done=done | bit), SweepStep("top", index, here), TOP
        return None


def _unrolled(trace: _Trace | None) -> list[SweepStep]:
    all_steps: list[SweepStep] = []
    while trace is not None:
        steps, trace = trace
        all_steps[:0] = steps
    return all_steps


def _thinned(below: Bars, above: Bars) -> Iterator[tuple[Bars, Bars]]:
    """Yield all bars, and selections with a single bar for each connected group of bars."""
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
