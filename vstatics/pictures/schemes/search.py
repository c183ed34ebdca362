"""The arrangement of a board with few crossings, by simulated annealing.

The random numbers are always the same, so a case always looks the same.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from random import Random

from vstatics.pictures.schemes.board import Board
from vstatics.pictures.schemes.channels import ABOVE, Arrangement

STEPS, MOST_STEPS = 150, 2500
"""Of an attempt, for each item and wire, and in all."""
STARTS = 3
"""Attempts at most, until one is without crossings."""
LARGE, WORK = 120, 480_000
"""Items and wires for one attempt, which starts less hot; their number times steps, at most."""
CHANGE_SWEEPS = 10
"""Through all single changes at the end, at most."""
HOT, MILD, COLD = 300.0, 30.0, 6.0
"""Temperatures at the start, of a large board, and at the end, in points of length of wire."""


def arranged(board: Board) -> Arrangement:
    """An arrangement with few crossings and short wires."""
    size = len(board.items) + len(board.wires)
    steps = min(STEPS * size, MOST_STEPS, WORK // size)
    ends = []
    for seed in range(1 if size > LARGE else STARTS):
        found = _annealed(board, Random(seed), steps)  # noqa: S311
        ends.append(_settled(board, *found))
        if not board.crossings(ends[-1][0]):
            break
    return min(ends, key=lambda end: end[1])[0]


def _start(board: Board) -> Arrangement:
    """Items as they are given, wires above and below by turns."""
    wires, items = max(board.wires, default=0) + 1, len(board.items)
    sides = [ABOVE if wire % 2 == 0 else -ABOVE for wire in range(wires)]
    ranks = [number // 2 for number in range(2 * wires)]
    return Arrangement(range(items), [0] * items, sides, ranks)


def _annealed(board: Board, chance: Random, steps: int) -> tuple[Arrangement, float]:
    """An arrangement after so many steps."""
    hot = HOT if len(board.items) + len(board.wires) <= LARGE else MILD
    arrangement = _start(board)
    cost = board.cost(arrangement)
    best = arrangement, cost
    varied = [i for i, item in enumerate(board.items) if len(item.variants) > 1]
    kinds = ["order", "order", "swap", "rank", "side", *["variant", "variant"] * bool(varied)]
    for step in range(steps):
        heat = hot * (COLD / hot) ** (step / steps)
        other = _moved(board, arrangement, chance.choice(kinds), varied, chance)
        if other is None:
            continue
        value = board.cost(other, cost - heat * math.log(1 - chance.random()))
        if value < math.inf:
            arrangement, cost = other, value
            if cost < best[1]:
                best = arrangement, cost
    return best


def _settled(board: Board, arrangement: Arrangement, cost: float) -> tuple[Arrangement, float]:
    """The arrangement after each change of one variant or of two neighbours that helps."""
    items = list(enumerate(board.items))
    changes = [(index, variant) for index, item in items for variant in range(len(item.variants))]
    for _ in range(CHANGE_SWEEPS):
        before = cost
        for place, variant in [*changes, *((index, -1) for index, _ in items[:-1])]:
            is_exchange = variant < 0
            other = (
                _exchanged(arrangement, place)
                if is_exchange
                else _varied(arrangement, place, variant)
            )
            value = math.inf if other is None else board.cost(other, cost)
            if other is not None and value < cost:
                arrangement, cost = other, value
        if cost == before:
            break
    return arrangement, cost


def _varied(arrangement: Arrangement, index: int, variant: int) -> Arrangement | None:
    if arrangement.variants[index] == variant:
        return None
    variants = [*arrangement.variants]
    variants[index] = variant
    return arrangement._replace(variants=variants)


def _exchanged(arrangement: Arrangement, place: int) -> Arrangement:
    order = [*arrangement.order]
    order[place], order[place + 1] = order[place + 1], order[place]
    return arrangement._replace(order=order)


def _moved(
    board: Board, arrangement: Arrangement, kind: str, varied: Sequence[int], chance: Random
) -> Arrangement | None:
    """A neighbour of an arrangement; None where it is the same."""
    if kind in {"order", "swap"}:
        order = [*arrangement.order]
        a, b = int(chance.random() * len(order)), int(chance.random() * len(order))
        if kind == "swap":
            order[a], order[b] = order[b], order[a]
        else:
            order.insert(b, order.pop(a))
        return arrangement._replace(order=order)
    if kind == "rank":
        ranks = [*arrangement.ranks]
        one = int(chance.random() * len(ranks))
        other = 2 * chance.choice(board.wires) + one % 2  # on the same side
        ranks[one], ranks[other] = ranks[other], ranks[one]
        return arrangement._replace(ranks=ranks)
    if kind == "side":
        sides = [*arrangement.sides]
        sides[chance.choice(board.wires)] *= -1
        return arrangement._replace(sides=sides)
    index = chance.choice(varied)
    return _varied(arrangement, index, int(chance.random() * len(board.items[index].variants)))
