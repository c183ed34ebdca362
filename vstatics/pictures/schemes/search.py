"""The arrangement of a board with few crossings, by simulated annealing.

The random numbers are always the same, so a case always looks the same.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from random import Random

from vstatics.pictures.schemes.channels import ABOVE, BELOW, Arrangement, Board

STEPS, MOST_STEPS = 150, 4000
"""Of each attempt, for each item and wire, and in all."""
STARTS = 2
QUICK = 2000
"""Steps of the one attempt where there are many diagrams: a tenth more crossings, in a third of
the time."""
SWEEPS = 10
"""Through all single changes at the end, at most."""
HOT, COLD = 600.0, 6.0
"""Temperatures at the start and at the end, in points of length of wire."""


def arranged(board: Board, *, is_free: bool, is_quick: bool = False) -> Arrangement:
    """An arrangement with few crossings and short wires.

    Wires that are free choose their side; else the variants of the items do.
    """
    most, starts = (QUICK, 1) if is_quick else (MOST_STEPS, STARTS)
    steps = min(STEPS * (len(board.items) + len(board.wires)), most)
    first = _start(board)
    ends = [
        _annealed(board, first, Random(seed), steps, is_free=is_free)  # noqa: S311
        for seed in range(starts)
    ]
    return _settled(board, *min(ends, key=lambda end: end[1]))


def _start(board: Board) -> Arrangement:
    order = tuple(range(len(board.items)))
    sides = {wire: ABOVE if number % 2 else BELOW for number, wire in enumerate(board.wires)}
    ranks = {
        (wire, side): number
        for number, wire in enumerate([*board.wires, 0])
        for side in (ABOVE, BELOW)
    }
    return Arrangement(order, (0,) * len(order), sides, ranks)


def _annealed(
    board: Board, arrangement: Arrangement, chance: Random, steps: int, *, is_free: bool
) -> tuple[Arrangement, float]:
    cost = board.cost(arrangement)
    best = arrangement, cost
    varied = [i for i, item in enumerate(board.items) if len(item.variants) > 1]
    kinds = ["order", "order", "swap", "rank"] + ["side"] * is_free + ["variant"] * 2 * bool(varied)
    for step in range(steps):
        heat = HOT * (COLD / HOT) ** (step / steps)
        other = _moved(board, arrangement, chance.choice(kinds), varied, chance)
        if other is None:
            continue
        value = board.cost(other)
        if value <= cost or chance.random() < math.exp((cost - value) / heat):
            arrangement, cost = other, value
            if cost < best[1]:
                best = arrangement, cost
    return best


def _settled(board: Board, arrangement: Arrangement, cost: float) -> Arrangement:
    """The arrangement after each change of one variant or of two neighbours that helps."""
    for _ in range(SWEEPS):
        before = cost
        for change in _changes(board):
            other = change(arrangement)
            value = board.cost(other)
            if value < cost:
                arrangement, cost = other, value
        if cost == before:
            break
    return arrangement


def _changes(board: Board) -> Iterator[Callable[[Arrangement], Arrangement]]:
    for index, item in enumerate(board.items):
        for variant in range(len(item.variants)):
            yield partial(_varied, index=index, variant=variant)
    for place in range(len(board.items) - 1):
        yield partial(_exchanged, board=board, place=place)


def _varied(arrangement: Arrangement, index: int, variant: int) -> Arrangement:
    variants = (*arrangement.variants[:index], variant, *arrangement.variants[index + 1 :])
    return replace(arrangement, variants=variants)


def _exchanged(arrangement: Arrangement, board: Board, place: int) -> Arrangement:
    one, other = arrangement.order[place : place + 2]
    if None not in {board.items[one].rank, board.items[other].rank}:
        return arrangement
    return replace(
        arrangement, order=(*arrangement.order[:place], other, one, *arrangement.order[place + 2 :])
    )


def _moved(
    board: Board, arrangement: Arrangement, kind: str, varied: Sequence[int], chance: Random
) -> Arrangement | None:
    """A neighbour of an arrangement; None where the move is not allowed."""
    if kind in {"order", "swap"}:
        order = list(arrangement.order)
        a, b = chance.randrange(len(order)), chance.randrange(len(order))
        if kind == "swap":
            order[a], order[b] = order[b], order[a]
        else:
            order.insert(b, order.pop(a))
        ranks = [rank for i in order if (rank := board.items[i].rank) is not None]
        return replace(arrangement, order=tuple(order)) if ranks == sorted(ranks) else None
    if kind == "rank":
        one, wire = chance.choice(list(arrangement.ranks)), chance.choice(list(board.wires))
        other = wire, one[1]  # on the same side, so that no two ranks are the same
        ranks_now = arrangement.ranks
        return replace(
            arrangement, ranks={**ranks_now, one: ranks_now[other], other: ranks_now[one]}
        )
    if kind == "side":
        wire = chance.choice(list(board.wires))
        return replace(arrangement, sides={**arrangement.sides, wire: -arrangement.sides[wire]})
    index = chance.choice(list(varied))
    variants = list(arrangement.variants)
    variants[index] = chance.randrange(len(board.items[index].variants))
    return replace(arrangement, variants=tuple(variants))
