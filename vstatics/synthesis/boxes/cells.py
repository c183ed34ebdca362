"""Cells of the bounds of ratios: what changes in one, and its halves."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from vstatics.numerics.arrays import Booleans, Floats, Integers
from vstatics.numerics.compiled import compiled, put
from vstatics.synthesis.boxes.engaged import Combinations
from vstatics.synthesis.boxes.ranges import extremes, has_one_sign
from vstatics.synthesis.boxes.set_ratios import Asked, FitRoom, fit_room

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
    chosen: Integers
    """A ratio for each target, shape (targets,)."""
    taken: Booleans
    """Whether a ratio has a target, shape (ratios,)."""
    ratio_of: Integers
    """The ratio of each combination of a set, below 0 of none, shape (combinations of a set,)."""
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
        chosen=np.zeros(targets, np.int64),
        taken=np.zeros(ratios, np.bool_),
        ratio_of=np.zeros(ratios, np.int64),
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
            for ratio in room.chosen:
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
