"""Deterministic search for the order of components along the axis.

The search (A*) expands the state with the smallest sum of past cost and weighted estimate of the
remaining cost. A large weight reaches an end sooner. Components that connect neighbouring bars
(lines of links) are added at once, which is never worse.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cache, lru_cache, partial
from heapq import heappop, heappush
from itertools import combinations, count, islice
from operator import attrgetter
from typing import NamedTuple

from vstatics.pictures.schemes.coaxial.planarity import has_half_section
from vstatics.pictures.schemes.coaxial.search.moves import Moves
from vstatics.pictures.schemes.coaxial.search.remainder import can_go_on
from vstatics.pictures.schemes.coaxial.search.stacked import stacked
from vstatics.pictures.schemes.coaxial.search.state import PAIR, SET, OrderStep, SectionState
from vstatics.pictures.schemes.coaxial.search.successors import Successors, thinned
from vstatics.pictures.schemes.coaxial.train import CoaxialTrain


class SearchEffort(NamedTuple):
    """Attempts of a search, each a weight of the estimated cost and a largest number of states."""

    planar: Sequence[tuple[float, int]]
    """Attempts without crossings."""
    crossing: Sequence[tuple[float, int]]
    """Attempts in which at most `MOST_CROSSING` shift elements or shafts may cross links."""
    last: Sequence[tuple[float, int]]
    """Attempts in which every component that can cross links may do so."""
    is_first: bool = False
    """True to take the first arrangement with crossings. False to take the best."""


CROSSING_TRIES = (1000.0, 800), (30.0, 400), (100.0, 400)
LAST_TRIES = (1000.0, 400), (100.0, 800)
FULL = SearchEffort(
    ((3.0, 300), (6.0, 1200), (5.0, 2500), (10.0, 4000)), CROSSING_TRIES, LAST_TRIES
)
QUICK = SearchEffort(((5.0, 400), (10.0, 2500), (3.0, 2500)), CROSSING_TRIES, LAST_TRIES)
"""Effort for a small diagram in a list."""
BRIEF = SearchEffort(
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
BARS_OF_REST = 2
"""Number of bars along each remaining component in the estimate of the remaining cost."""
_Trace = tuple[tuple[OrderStep, ...], tuple[SectionState, "_Trace"] | None]
"""Steps to a state, and the previous state with its trace; None at the start of the axis."""


class ComponentOrder(NamedTuple):
    """Result of a search: the components from left to right."""

    steps: Sequence[OrderStep]
    is_ordered: bool
    """False if gear sets should be in the given order but could not be."""


@lru_cache(maxsize=64)
def component_order(
    train: CoaxialTrain, *, is_ordered: bool = False, effort: SearchEffort = FULL
) -> ComponentOrder:
    """Return the components of a train from left to right.

    Parameters
    ----------
    is_ordered : bool
        True to keep gear sets in the given order, even with crossings, if a way is found soon.
    effort : SearchEffort, optional
        Attempts of the search; if all fail, each link is one line (`stacked`).

    Examples
    --------
    >>> from vstatics.pictures.schemes.coaxial.train import Planes
    >>> train = CoaxialTrain([Planes(3, [(1, 2)])], [], [2], 1, 3)
    >>> [step.kind for step in component_order(train).steps]
    ['set', 'top']
    """
    if len(train.sets) > MOST_SEARCHED_SETS:
        return ComponentOrder(stacked(train), not is_ordered)
    is_planar = has_half_section(train)
    for ordered in (True, False)[not is_ordered :]:
        planar = _found(Moves(train, 0, ordered), effort.planar if is_planar else ())
        arrangement = next(planar, None) or _with_crossings(
            train, effort, is_planar=is_planar, is_ordered=ordered
        )
        if arrangement is not None:
            return ComponentOrder(arrangement.steps, ordered or not is_ordered)
    return ComponentOrder(stacked(train), not is_ordered)


def _with_crossings(
    train: CoaxialTrain, effort: SearchEffort, *, is_planar: bool, is_ordered: bool
) -> _FoundSteps | None:
    """Return the cheapest arrangement with few crossings or, failing that, the first with any.

    With `effort.is_first`, the first arrangement with few crossings is returned.
    """
    few = (
        arrangement
        for crossing in _crossing(train, is_planar=is_planar)
        for arrangement in _found(Moves(train, crossing, is_ordered), effort.crossing)
    )
    ways = [*islice(few, 1 if effort.is_first else None)]
    if ways:
        return min(ways, key=attrgetter("cost"))
    part = min(1.0, LAST_SETS / max(1, len(train.sets))) ** 2
    last = [(weight, int(part * most)) for weight, most in effort.last]
    return next(_found(Moves(train, train.all_bits, is_ordered), last), None)


def _crossing(train: CoaxialTrain, *, is_planar: bool) -> list[int]:
    """Return the smallest sets of connections without which the train is planar, as bit masks.

    If the train is planar, each set contains a single connection. Numbers of connections and of
    sets are limited; the result can be empty.
    """
    bits = [*train.pair_bits, *train.top_bits]
    for number in range(1, MOST_CROSSING + 1):
        ways = (sum(way) for way in combinations(bits, number))
        fit = (way for way in ways if is_planar or has_half_section(train, way))
        choices = list(islice(fit, MOST_CHOICES))
        if choices:
            return choices
    return []


def _found(moves: Moves, attempts: Sequence[tuple[float, int]]) -> Iterator[_FoundSteps]:
    """Yield the steps of successful attempts, which share the calculated successors."""
    successors = Successors(moves)
    for weight, most in attempts:
        arrangement = _attempt(successors, weight, most)
        if arrangement is not None:
            yield arrangement


class _FoundSteps(NamedTuple):
    steps: Sequence[OrderStep]
    cost: int


def _attempt(successors: Successors, weight: float, most: int) -> _FoundSteps | None:  # noqa: C901 - a single loop
    """Return the cheapest steps to the end, unless the search needs too many states.

    A state in the queue has all its bars. It is thinned when it leaves the queue, because most
    states never do. Among equal guesses, the first in the queue leaves first.
    """
    train, crossing = successors.moves.train, successors.moves.crossing
    number, remaining = count(), cache(partial(_remaining, train))
    waiting: list[tuple[float, int, int, int, SectionState, _Trace]] = []
    closed: set[SectionState] = set()

    def add(state: SectionState, cost: int, trace: _Trace) -> None:
        guess = cost + weight * remaining(state.done)
        heappush(waiting, (guess, next(number), -1, cost, state, trace))

    for state, steps, cost in successors.first():
        add(state, cost, (steps, None))
    while waiting and len(closed) < 8 * most:
        guess, order, selection, cost, state, trace = heappop(waiting)
        if selection < 0:
            for place, part in enumerate(thinned(state)):
                # The output is not at the axis.
                more = int(state.done == train.all_bits and bool(part.above))
                heappush(waiting, (guess + more, order, place, cost + more, part, trace))
            continue
        if state in closed:
            continue
        closed.add(state)
        bars = state.below + state.above
        if not can_go_on(train, bars, state.done | crossing):
            continue
        ends = {8 * train.end} if train.end else set()
        if state.done == train.all_bits and set(bars) == ends:
            return _FoundSteps(_unrolled(trace), cost)
        most -= 1
        if most < 0:
            return None
        for following, steps, more in successors.after(state):
            add(following, cost + more, (steps, (state, trace)))
    return None


def _remaining(train: CoaxialTrain, done: int) -> int:
    sets = zip(train.sets, train.carrier_bits, strict=True)
    value = sum(SET * len(planes.wheels) for planes, bit in sets if not done & bit)
    return BARS_OF_REST * (value + PAIR * sum(not done & bit for bit in train.pair_bits))


def _unrolled(trace: _Trace) -> list[OrderStep]:
    steps, before = trace
    all_steps = [*steps]
    while before is not None:
        state, (steps, before) = before
        all_steps[0] = all_steps[0]._replace(before=(state.below, state.above))
        all_steps[:0] = steps
    return all_steps
