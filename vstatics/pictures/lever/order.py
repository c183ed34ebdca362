"""Order and orientation of levers that keep their connections short."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import combinations, pairwise
from operator import itemgetter

from vstatics.core.model.transmission import HOUSING, Transmission
from vstatics.pictures.drawing.tolerances import SAME_LEVER_COST
from vstatics.pictures.lever.gear import LeverTie, joins, spots_of, ties_of
from vstatics.pictures.lever.points import Lever

LEVER_SEARCH_ROUNDS = 20
"""Largest number of moves in a search. Further moves improve little."""
MOVES = 60
"""A lever moves by at most this number divided by the number of levers, plus 2 places."""
CROSSING_COST = 2.0
"""Cost of two lines that cross in all gears, in heights of a lever. [-]"""
Order = tuple[int, ...]
"""Indices of the levers from left to right, or the orientation of each lever."""
Move = Callable[[Order], Order]
"""Change of an order."""


def ordered(case: Transmission, drawn: Sequence[Lever]) -> list[Lever]:
    """Return levers from left to right: input left, output right, connected levers close together.

    Levers stay in the order of the case unless a change shortens connections.
    """
    spots, gear = spots_of(drawn), case.gears[0]
    links = [{place for place, _ in some} for link, some in spots.items() if link != HOUSING]
    clutches = [item.links for item in case.shift_elements if HOUSING not in item.links]
    tied = [*clutches, *(pair for spring in case.springs for pair in pairwise(spring.form))]
    ties = [
        [(start, end) for start, _ in spots[first] for end, _ in spots[second]]
        for first, second in tied
        if first in spots and second in spots
    ]
    first, last = (spots[link][0][0] for link in (case.gear_input(gear), case.gear_output(gear)))

    def cost(order: Order) -> float:
        at = {place: number for number, place in enumerate(order)}
        spans = sum(
            max(map(at.__getitem__, at_link)) - min(map(at.__getitem__, at_link))
            for at_link in links
        )
        near = sum(max(1, min(abs(at[a] - at[b]) for a, b in pairs)) for pairs in ties)
        return spans + 0.6 * near + 0.3 * (at[first] > at[last]) + 0.1 * (at[first] - at[last])

    start = tuple(range(len(drawn)))
    reach = MOVES // len(start) + 2  # with many levers, only short moves are tried
    pairs = [(low, high) for low, high in combinations(start, 2) if high - low <= reach]
    moves = [move for pair in pairs for move in _moves(*pair)]
    return [drawn[place] for place in _best(start, moves, cost)]


def _moves(low: int, high: int) -> list[Move]:
    """Return the changes of an order between two positions: swap, shift left or right, reverse."""
    return [
        lambda o: (*o[:low], o[high], *o[low + 1 : high], o[low], *o[high + 1 :]),
        lambda o: (*o[:low], *o[low + 1 : high + 1], o[low], *o[high + 1 :]),
        lambda o: (*o[:low], o[high], *o[low:high], *o[high + 1 :]),
        lambda o: (*o[:low], *o[low : high + 1][::-1], *o[high + 1 :]),
    ]


def _best(start: Order, moves: Sequence[Move], cost: Callable[[Order], float]) -> Order:
    reached, least = start, cost(start)
    for _ in range(LEVER_SEARCH_ROUNDS):
        costs = {tried: cost(tried) for tried in {move(reached): None for move in moves}}
        best = min(costs, key=costs.__getitem__, default=reached)
        if not costs or costs[best] >= least - SAME_LEVER_COST:
            break
        reached, least = best, costs[best]
    return reached


def every(case: Transmission, drawn: Sequence[Lever]) -> list[LeverTie]:
    """Return all connections that gears can have by clutches and springs."""
    return list(ties_of(case, case.shift_elements, spots_of(drawn)))


def heights(case: Transmission, drawn: Sequence[Lever]) -> list[list[float]]:
    """Return the height of each point of each lever, from 0 to 1. Some levers are turned over.

    A lever is turned over to remove crossings or, with equal crossings, to shorten lines. Shafts
    are at the mean height of their connections.
    """
    both = [(upward, [1 - tie for tie in upward]) for upward in map(_heights, drawn)]
    ties = [
        (tie, weight)
        for some, weight in ((joins(drawn), 1.0), (every(case, drawn), 0.4))
        for tie in some
    ]
    spots, always = spots_of(drawn), list(joins(drawn))
    engaged = dict.fromkeys(gear.carrying for gear in case.gears)
    elements = list(map(case.elements_at, engaged))
    in_gears = [[*always, *ties_of(case, some, spots)] for some in elements]

    def cost(turned: Order) -> float:
        heights = [pair[turn] for pair, turn in zip(both, turned, strict=True)]
        rises = sum(
            weight * abs(heights[a][m] - heights[b][n])
            for tie, weight in ties
            for (a, m), (b, n) in (tie.ends,)
        )
        crossings = sum(crossings_of(heights, some) for some in in_gears)
        return rises + CROSSING_COST * crossings / len(in_gears)

    turns = [_turn(place) for place, lever in enumerate(drawn) if len(lever.nodes) > 1]
    best = _best((0,) * len(drawn), turns, cost)
    chosen = [pair[turn] for pair, turn in zip(both, best, strict=True)]
    for place, lever in enumerate(drawn):
        if not lever.devices:
            near = [
                chosen[b][n]
                for tie, _ in ties
                for (a, _), (b, n) in (tie.ends, tie.ends[::-1])
                if a == place
            ]
            chosen[place] = [sum(near) / len(near) if near else 0.5]
    return chosen


def crossings_of(heights: Sequence[Sequence[float]], ties: Sequence[LeverTie]) -> int:
    """Return the number of crossings of lines between levers whose points have given heights.

    >>> ties = [LeverTie("", 1, ((0, 0), (1, 1))), LeverTie("", 2, ((0, 1), (1, 0)))]
    >>> crossings_of([[0.0, 1.0], [0.0, 1.0]], ties), crossings_of([[0.0, 1.0], [1.0, 0.0]], ties)
    (1, 0)
    """
    gaps: dict[int, list[tuple[float, float, bool]]] = {}
    for tie in ties:
        (a, m), (b, n) = tie.ends
        start, end = heights[a][m], heights[b][n]
        if b - a < 2:
            gaps.setdefault(a, []).append((start, end, a == b))
            continue
        lane = (start + end) / 2
        gaps.setdefault(a, []).append((start, lane, False))
        gaps.setdefault(b - 1, []).append((lane, end, False))
    return sum(_cross(*pair) for here in gaps.values() for pair in combinations(here, 2))


def _cross(first: tuple[float, float, bool], second: tuple[float, float, bool]) -> bool:
    """Return whether two lines cross in a gap, given the heights at both ends."""
    (*ends, is_back), (start, end, are_both_back) = sorted((first, second), key=itemgetter(2))[::-1]
    low, high = sorted(ends)
    if is_back:
        return sum(low < y < high for y in (start, end)[: 1 + are_both_back]) == 1
    return (start - ends[0]) * (end - ends[1]) < 0


def _turn(place: int) -> Move:
    return lambda turned: (*turned[:place], 1 - turned[place], *turned[place + 1 :])


def _heights(lever: Lever) -> list[float]:
    low, high = lever.ends
    # A gear pair is drawn as a box, on which distances have no meaning.
    if lever.ratio is not None:
        turning = [node for node in lever.nodes if node.link != HOUSING]
        return [0.25 if node is turning[0] else 0.75 for node in lever.nodes]
    if low == high:
        return [0.5 for _ in lever.nodes]
    return [(node.position - low) / (high - low) for node in lever.nodes]
