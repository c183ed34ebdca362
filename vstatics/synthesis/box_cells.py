"""Where in the bounds of the ratios a set of shift elements may give all targets.

The bounds are halved again and again. What is reached in a cell is told from its corners, so
a cell that is left holds no solution; in the others the targets are given to gears, and the
ratios are fitted from the middle.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from vstatics.numerics.arrays import Booleans, Floats, Integers
from vstatics.numerics.compiled import compiled
from vstatics.synthesis.box_elements import matched
from vstatics.synthesis.box_fit import NOTHING, Asked, FitRoom, fit_room, fitted
from vstatics.synthesis.box_ranges import has_one_sign, reached

SPREADS = np.array([0.5, 0.2, 0.06])
"""A fit is tried when ln(i) of all gears chosen spreads by less than the first in a cell, again
below each of the others; what has not been found then is not there. [-]"""
NARROW = 1.05
"""A cell is not halved further along a ratio whose bounds are so near. [-]"""
MOST_CELLS = 200_000
"""Cells of one set of elements, where ratios are such that nothing can be told."""
MOST_WAYS = 24
"""So many ways to give targets to gears are tried in a cell."""
DEEPEST = 60
"""So often is a cell halved."""
MORE_FITS = 12
"""So many fits are made when there is a solution already: another may be better."""


class CellRoom(NamedTuple):
    """Room for cells and fits; cells are kept one on the other, the next to look at on top."""

    parts: Floats
    """Shape (cells, ratios, 2, corners)."""
    low: Floats
    """Bounds of ring teeth/sun teeth, shape (cells, sets). [-]"""
    high: Floats
    stages: Integers
    """How many of `SPREADS` have been tried, shape (cells,)."""
    depths: Integers
    """How often it was halved, shape (cells,)."""
    reach: Integers
    """Targets that each ratio reaches in the cell, shape (ratios,)."""
    chosen: Integers
    """A ratio for each target, shape (targets,)."""
    start: Floats
    """Logarithms of ring teeth/sun teeth, shape (sets,). [-]"""
    taken: Booleans
    """Whether a ratio has a target, shape (ratios,)."""
    fit: FitRoom


def cell_room(ratios: int, targets: int, sets: int) -> CellRoom:
    """Room for so many ratios."""
    return CellRoom(
        parts=np.zeros((DEEPEST + 2, ratios, 2, 2**sets)),
        low=np.zeros((DEEPEST + 2, sets)),
        high=np.zeros((DEEPEST + 2, sets)),
        stages=np.zeros(DEEPEST + 2, np.int64),
        depths=np.zeros(DEEPEST + 2, np.int64),
        reach=np.zeros(ratios, np.int64),
        chosen=np.zeros(targets, np.int64),
        start=np.zeros(sets),
        taken=np.zeros(ratios, np.bool_),
        fit=fit_room(targets, sets),
    )


@compiled
def solved(
    parts: Floats, asked: Asked, room: CellRoom, best_logs: Floats, best_chosen: Integers
) -> float:
    """The largest |ln(i/target)| of the best fit within tolerance; infinity if there is none.

    Parameters
    ----------
    parts : array, shape (ratios, 2, corners)
        Numerators and denominators of different ratios at the corners of the bounds.
    asked : Asked
    room : CellRoom
    best_logs, best_chosen : array, shape (sets,) and (targets,)
        Take the logarithms of the ratios, and the ratio of each target.
    """
    sets = len(best_logs)
    count = len(parts)
    room.stages[0] = 0
    room.depths[0] = 0
    for ratio in range(count):
        for corner in range(parts.shape[2]):
            room.parts[0, ratio, 0, corner] = parts[ratio, 0, corner]
            room.parts[0, ratio, 1, corner] = parts[ratio, 1, corner]
    for number in range(sets):
        room.low[0, number] = asked.low
        room.high[0, number] = asked.high
    best = least = math.inf
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
        stage = room.stages[top]
        spread = _spread(cell, room.chosen)
        number = _longest(cell, room.chosen, sets, room.low[top], room.high[top])
        if number < 0:
            stage, spread = 0, 0.0
        if stage < len(SPREADS) and spread <= SPREADS[stage]:
            while stage < len(SPREADS) and spread <= SPREADS[stage]:
                stage += 1
            room.stages[top] = stage
            for number in range(sets):
                middle = room.low[top, number] * room.high[top, number]
                room.start[number] = 0.5 * math.log(middle)
            fits += 1
            error, total = _fits(parts, asked, room, least, best_logs, best_chosen)
            if total < least:
                least, best = total, error
            if best < math.inf and (fits > MORE_FITS or least < NOTHING):
                return best
            if error < math.inf or stage == len(SPREADS):
                continue
        if room.depths[top] < DEEPEST:
            _halve(room, count, top, number)
            top += 2
    return best


@compiled
def _spread(cell: Floats, chosen: Integers) -> float:
    """How far ln(i) of the chosen ratios spreads in a cell."""
    found = 0.0
    for ratio in chosen:
        if not (has_one_sign(cell[ratio, 0]) and has_one_sign(cell[ratio, 1])):
            return math.inf
        least = most = cell[ratio, 0, 0] / cell[ratio, 1, 0]
        for corner in range(1, cell.shape[2]):
            value = cell[ratio, 0, corner] / cell[ratio, 1, corner]
            least = min(least, value)
            most = max(most, value)
        found = max(found, abs(math.log(most / least)))
    return found


@compiled
def _longest(cell: Floats, chosen: Integers, sets: int, low: Floats, high: Floats) -> int:
    """The set along whose ratio the chosen ratios change most; -1 if the cell is too narrow."""
    best = 0.0
    found = -1
    for number in range(sets):
        if high[number] < NARROW * low[number]:
            continue
        total = 0.0
        for ratio in chosen:
            most = 0.0
            for corner in range(cell.shape[2]):
                if (corner >> number) & 1 == 0:
                    other = corner | (1 << number)
                    one = cell[ratio, 0, other] * cell[ratio, 1, corner]
                    two = cell[ratio, 0, corner] * cell[ratio, 1, other]
                    if one != two:
                        most = max(most, abs(one - two) / (abs(one) + abs(two)))
            total += most
        if total > best:
            best = total
            found = number
    return found


@compiled
def _halve(room: CellRoom, count: int, top: int, number: int) -> None:
    """Halve the cell on top, along one ratio: the lower half stays there, the other is next."""
    low, high = room.low[top, number], room.high[top, number]
    middle = math.sqrt(low * high)
    part = (middle - low) / (high - low)
    bit = 1 << number
    for ratio in range(count):
        for half in range(2):
            here = room.parts[top, ratio, half]
            there = room.parts[top + 1, ratio, half]
            for corner in range(len(here)):
                if corner & bit == 0:
                    last = here[corner | bit]
                    value = here[corner] + (last - here[corner]) * part
                    here[corner | bit] = value
                    there[corner] = value
                    there[corner | bit] = last
    for other in range(room.low.shape[1]):
        room.low[top + 1, other] = room.low[top, other]
        room.high[top + 1, other] = room.high[top, other]
    room.high[top, number] = middle
    room.low[top + 1, number] = middle
    room.depths[top] += 1
    room.depths[top + 1] = room.depths[top]
    room.stages[top + 1] = room.stages[top]


@compiled
def _fits(
    parts: Floats,
    asked: Asked,
    room: CellRoom,
    least: float,
    best_logs: Floats,
    best_chosen: Integers,
) -> tuple[float, float]:
    """Fit from one point, for every way to give targets to ratios; largest error and sum.

    Both are infinite if no fit is within tolerance and below the sum `least`.
    """
    count, ratios = len(asked.targets), len(parts)
    way = room.chosen
    way[:] = -1
    room.taken[:] = False
    best = worst = math.inf
    target = ways = 0
    while target >= 0 and ways < MOST_WAYS:
        if target == count:
            ways += 1
            room.fit.logs[:] = room.start
            total = fitted(parts, way, asked, room.fit)
            if total < min(least, best):
                largest = np.abs(room.fit.errors).max()
                if largest <= asked.tolerance:
                    best, worst = total, largest
                    best_logs[:] = room.fit.logs
                    best_chosen[:] = way
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
    return worst, best
