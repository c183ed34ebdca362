"""The ratios of sets with which a set of elements has all gears, compiled.

The bounds are halved again and again. What is reached in a cell is told from its corners, so
a cell that is left holds no solution; in the others the targets are given to gears, and the
ratios are fitted from the middle.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from vstatics.numerics.arrays import Booleans, Floats, Integers
from vstatics.numerics.compiled import compiled, put
from vstatics.synthesis.boxes.search.engaged import Combinations, all_used
from vstatics.synthesis.boxes.search.matching import MatchRoom, match_room, matched
from vstatics.synthesis.boxes.search.ranges import extremes, has_one_sign, reached
from vstatics.synthesis.boxes.search.set_ratios import Asked, FitRoom, fit_room, fitted
from vstatics.synthesis.tolerances import LEAST_SUM_OF_SQUARES

SPREADS = np.array([0.5, 0.2, 0.06])
"""A fit is tried when ln(i) of all gears chosen spreads by less than the first in a cell, again
below each of the others; what has not been found then is not there. [-]"""
MOST_CELLS = 200_000
"""With more cells a set of elements is given up."""
MOST_WAYS = 24
"""So many ways to give targets to gears are tried in a cell; with more it is halved."""
MOST_LAST_WAYS = 1000
"""So many where it is too narrow for that; with more it is given up."""
MORE_FITS = 12
"""So many fits are made when there is a solution already: another may be better."""


@compiled
def solved(parts: Floats, asked: Asked, room: CellRoom) -> float:
    """The largest |ln(i/target)| of the best fit within tolerance; infinity if there is none.

    Parameters
    ----------
    parts : array, shape (ratios, 2, corners)
        Numerators and denominators of different ratios at the corners of the bounds.
    asked : Asked
    room : CellRoom
        `ratio_of` tells whose ratios they are; `best_logs` and `best_gears` take the fit,
        `given_up` whether there may be one although none was found.
    """
    count = len(parts)
    room.best[:] = math.inf
    room.given_up[0] = False
    room.stages[0] = 0
    for ratio in range(count):  # the bounds are the first cell
        put(parts[ratio, 0], room.parts[0, ratio, 0])
        put(parts[ratio, 1], room.parts[0, ratio, 1])
    room.low[0] = asked.low
    room.high[0] = asked.high
    looked = fits = 0
    top = 1
    while top > 0 and looked < MOST_CELLS:
        top -= 1
        looked += 1
        cell = room.parts[top]
        for ratio in range(count):
            room.reach[ratio] = reached(cell[ratio, 0], cell[ratio, 1], asked.least, asked.most)
        if not matched(room.reach, count, room.match):
            continue
        number = longest(room, top)
        if _is_due(room, top, number):
            fits += 1
            is_last = number < 0
            is_met, are_all = _fits(parts, asked, room, top)
            if room.best[1] < (math.inf if fits > MORE_FITS else LEAST_SUM_OF_SQUARES):
                break
            if is_met or is_last or (are_all and room.stages[top] == len(SPREADS)):
                room.given_up[0] |= not are_all
                continue
        halve(room, count, top, number)
        top += 2
    room.given_up[0] |= top > 0
    room.given_up[0] &= room.best[0] == math.inf
    return float(room.best[0])


@compiled
def _is_due(room: CellRoom, top: int, number: int) -> bool:
    """Whether a fit is to be tried in a cell; it is noted that it was."""
    is_narrow = number < 0
    stage = before = room.stages[top]
    spread = 0.0 if is_narrow else spread_of(room.parts[top], room.match.chosen)
    while stage < len(SPREADS) and spread <= SPREADS[stage]:
        stage += 1
    room.stages[top] = stage
    return bool(is_narrow or stage > before)


@compiled
def _fits(parts: Floats, asked: Asked, room: CellRoom, top: int) -> tuple[bool, bool]:
    """Fit from the middle of a cell, for every way to give targets to ratios.

    The best is noted. Whether one does; whether there were no more ways than may be tried.
    """
    count, ratios = len(asked.targets), len(parts)
    way = room.match.chosen
    most = MOST_LAST_WAYS if longest(room, top) < 0 else MOST_WAYS
    way[:] = -1
    room.taken[:] = False
    is_met = False
    target = ways = 0
    while target >= 0 and ways < most:
        if target == count:
            ways += 1
            is_met |= _fit(parts, asked, room, top)
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
    return is_met, target < 0


@compiled
def _fit(parts: Floats, asked: Asked, room: CellRoom, top: int) -> bool:
    """Fit the chosen ratios; whether all are within tolerance, and all elements used."""
    for number in range(room.low.shape[1]):
        middle = room.low[top, number] * room.high[top, number]
        room.fit.logs[number] = 0.5 * math.log(middle)
    total = fitted(parts, room.match.chosen, asked, room.fit)
    if total == math.inf:
        return False
    largest = outside = 0.0
    for target in range(len(asked.targets)):
        size = abs(room.fit.errors[target])
        outside = max(outside, size)
        largest = max(largest, size * asked.widths[target])
    if outside > 1 or not all_used(
        room.ratio_of, room.used, room.match.chosen, room.came, room.gears
    ):
        return False
    if total < room.best[1]:
        room.best[0] = largest
        room.best[1] = total
        put(room.fit.logs, room.best_logs)
        put(room.gears, room.best_gears)
    return True


NARROW_CELL = 1.05
"""A cell is not halved further along a ratio whose bounds are so near. [-]"""


class CellRoom(NamedTuple):
    """Room for cells and fits; cells are kept one on the other, the next to look at on top."""

    parts: Floats
    """Shape (cells, ratios, 2, corners)."""
    low: Floats
    """Bounds of ring teeth/sun teeth, shape (cells, sets). [-]"""
    high: Floats
    stages: Integers
    """How many of `SPREADS` have been tried, shape (cells,)."""
    reach: Integers
    """Targets that each ratio reaches in the cell, shape (ratios,)."""
    match: MatchRoom
    """A ratio for each target."""
    taken: Booleans
    """Whether a ratio has a target, shape (ratios,)."""
    ratio_of: Integers
    """The ratio of each combination of a set, below 0 of none, shape (combinations of a set,)."""
    used: Integers
    """The places of elements that it uses, as bits, shape (combinations of a set,)."""
    came: Integers
    """Room for `all_used`."""
    gears: Integers
    """A combination for each target, shape (targets,)."""
    given_up: Booleans
    """Whether something was left that might have been a solution, shape (1,)."""
    fit: FitRoom
    best_logs: Floats
    """Logarithms of the best fit within tolerance, shape (sets,). [-]"""
    best_gears: Integers
    """Its combination of elements for each target, shape (targets,)."""
    best: Floats
    """Its largest |ln(i/target)| and its sum of squares; infinity where there is none. [-]"""


def cell_room(table: Combinations, asked: Asked, sets: int) -> CellRoom:
    """Room for the ratios of a set of elements."""
    ratios, size = len(table.places), len(table.starts) - 1
    targets = len(asked.targets)
    halvings = math.log2(math.log(asked.high / asked.low) / math.log(NARROW_CELL))
    deep = 2 + sets * math.ceil(max(halvings, 0))
    return CellRoom(
        parts=np.zeros((deep, ratios, 2, 2**sets)),
        low=np.zeros((deep, sets)),
        high=np.zeros((deep, sets)),
        stages=np.zeros(deep, np.int64),
        reach=np.zeros(ratios, np.int64),
        match=match_room(targets),
        taken=np.zeros(ratios, np.bool_),
        ratio_of=np.zeros(ratios, np.int64),
        used=np.zeros(ratios, np.int64),
        came=np.zeros((targets + 1, 2**size), np.int64),
        gears=np.zeros(targets, np.int64),
        given_up=np.zeros(1, np.bool_),
        fit=fit_room(targets, sets),
        best_logs=np.zeros(sets),
        best_gears=np.zeros(targets, np.int64),
        best=np.zeros(2),
    )


@compiled
def spread_of(cell: Floats, chosen: Integers) -> float:
    """How far ln(i) of the chosen ratios spreads in a cell."""
    found = 0.0
    for ratio in chosen:
        if not (has_one_sign(cell[ratio, 0]) and has_one_sign(cell[ratio, 1])):
            return math.inf
        least, most = extremes(cell[ratio, 0], cell[ratio, 1])
        found = max(found, abs(math.log(most / least)))
    return found


@compiled
def longest(room: CellRoom, top: int) -> int:
    """The set along whose ratio the chosen ratios change most; -1 if the cell is too narrow."""
    best = 0.0
    found = -1
    for number in range(room.low.shape[1]):
        if room.high[top, number] > NARROW_CELL * room.low[top, number]:
            total = 0.0
            for ratio in room.match.chosen:
                total += _change(room.parts[top, ratio], number)
            if total > best:
                best = total
                found = number
    return found


@compiled
def _change(ratio: Floats, number: int) -> float:
    """How much a quotient changes at most along the ratio of a set, from 0 to 1."""
    most = 0.0
    for corner in range(ratio.shape[1]):
        if (corner >> number) & 1 == 0:
            other = corner | (1 << number)
            one = ratio[0, other] * ratio[1, corner]
            two = ratio[0, corner] * ratio[1, other]
            if one != two:
                most = max(most, abs(one - two) / (abs(one) + abs(two)))
    return most


@compiled
def halve(room: CellRoom, count: int, top: int, number: int) -> None:
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
    put(room.low[top], room.low[top + 1])
    put(room.high[top], room.high[top + 1])
    room.high[top, number] = middle
    room.low[top + 1, number] = middle
    room.stages[top + 1] = room.stages[top]
