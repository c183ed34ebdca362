"""Whether a set of shift elements gives all targets, and with which ratios of sets.

The bounds are halved again and again. What is reached in a cell is told from its corners, so
a cell that is left holds no solution; in the others the targets are given to gears, and the
ratios are fitted from the middle.
"""

from __future__ import annotations

import math

import numpy as np

from vstatics.numerics.arrays import Floats
from vstatics.numerics.compiled import compiled, put
from vstatics.synthesis.boxes.cells import CellRoom, halve, longest, spread_of
from vstatics.synthesis.boxes.elements import matched
from vstatics.synthesis.boxes.engaged import Combinations, all_used
from vstatics.synthesis.boxes.ranges import reached
from vstatics.synthesis.boxes.set_ratios import Asked, fitted
from vstatics.synthesis.tolerances import LEAST_SUM_OF_SQUARES

SPREADS = np.array([0.5, 0.2, 0.06])
"""A fit is tried when ln(i) of all gears chosen spreads by less than the first in a cell, again
below each of the others; what has not been found then is not there. [-]"""
MOST_CELLS = 200_000
"""With more cells a set of elements is given up."""
MOST_WAYS = 24
"""So many ways to give targets to gears are tried in a cell; with more it is given up."""
MORE_FITS = 12
"""So many fits are made when there is a solution already: another may be better."""


@compiled
def solved(table: Combinations, parts: Floats, asked: Asked, room: CellRoom) -> float:
    """The largest |ln(i/target)| of the best fit within tolerance; infinity if there is none.

    Parameters
    ----------
    table : Combinations
    parts : array, shape (ratios, 2, corners)
        Numerators and denominators of different ratios at the corners of the bounds.
    asked : Asked
    room : CellRoom
        `ratio_of` tells whose ratios they are; `best_logs` and `best_gears` take the fit,
        `given_up` whether there may be one although none was found.
    """
    count = len(parts)
    _begin(parts, asked, room)
    looked = fits = 0
    top = 1
    while top > 0 and looked < MOST_CELLS:
        top -= 1
        looked += 1
        cell = room.parts[top]
        for ratio in range(count):
            room.reach[ratio] = reached(cell[ratio, 0], cell[ratio, 1], asked.least, asked.most)
        if not matched(room.reach, count, len(asked.targets), room.chosen):
            continue
        number = longest(room, top)
        if _is_due(room, top, number):
            fits += 1
            is_met = _fits(table, parts, asked, room, top)
            if room.best[1] < (math.inf if fits > MORE_FITS else LEAST_SUM_OF_SQUARES):
                break
            if is_met or room.stages[top] == len(SPREADS):
                continue
        halve(room, count, top, number)
        top += 2
    room.given_up[0] |= top > 0
    room.given_up[0] &= room.best[0] == math.inf
    return float(room.best[0])


@compiled
def _begin(parts: Floats, asked: Asked, room: CellRoom) -> None:
    """Begin with the bounds as the only cell."""
    room.best[:] = math.inf
    room.given_up[0] = False
    room.stages[0] = 0
    for ratio in range(len(parts)):
        put(parts[ratio, 0], room.parts[0, ratio, 0])
        put(parts[ratio, 1], room.parts[0, ratio, 1])
    room.low[0] = asked.low
    room.high[0] = asked.high


@compiled
def _is_due(room: CellRoom, top: int, number: int) -> bool:
    """Whether a fit is to be tried in a cell; it is noted that it was."""
    is_narrow = number < 0
    stage = before = room.stages[top]
    spread = 0.0 if is_narrow else spread_of(room.parts[top], room.chosen)
    while stage < len(SPREADS) and spread <= SPREADS[stage]:
        stage += 1
    room.stages[top] = stage
    return bool(is_narrow or stage > before)


@compiled
def _fits(table: Combinations, parts: Floats, asked: Asked, room: CellRoom, top: int) -> bool:
    """Fit from the middle of a cell, for every way to give targets to ratios; whether one does.

    The best is noted.
    """
    count, ratios = len(asked.targets), len(parts)
    way = room.chosen
    way[:] = -1
    room.taken[:] = False
    is_met = False
    target = ways = 0
    while target >= 0 and ways < MOST_WAYS:
        if target == count:
            ways += 1
            is_met |= _fit(table, parts, asked, room, top)
            target -= 1
            continue
        ratio = way[target]
        if ratio >= 0:
            room.taken[ratio] = False
        ratio += 1
        while ratio < ratios and (room.taken[ratio] or not (room.reach[ratio] >> target) & 1):
            ratio += 1
        if ratio == ratios:
            way[target] = -1
            target -= 1
        else:
            way[target] = ratio
            room.taken[ratio] = True
            target += 1
    room.given_up[0] |= target >= 0
    return is_met


@compiled
def _fit(table: Combinations, parts: Floats, asked: Asked, room: CellRoom, top: int) -> bool:
    """Fit the chosen ratios; whether all are within tolerance, and all elements used."""
    for number in range(room.low.shape[1]):
        middle = room.low[top, number] * room.high[top, number]
        room.fit.logs[number] = 0.5 * math.log(middle)
    total = fitted(parts, room.chosen, asked, room.fit)
    if total == math.inf:
        return False
    largest = 0.0
    for error in room.fit.errors:
        largest = max(largest, abs(error))
    if largest > asked.tolerance or not all_used(
        table, room.ratio_of, room.chosen, room.came, room.gears
    ):
        return False
    if total < room.best[1]:
        room.best[0] = largest
        room.best[1] = total
        put(room.fit.logs, room.best_logs)
        put(room.gears, room.best_gears)
    return True
