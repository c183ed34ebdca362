"""Cells of the ratios of sets, and what is left of one where gears are to meet their targets.

Numerators and denominators are linear in each ratio, so what a gear can have in a cell is told
from its corners; and so is how far a ratio of a set may go along an edge before the gear is
beyond its target wherever the others are. What is cut off holds no solution.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from vstatics.numerics.arrays import Booleans, Floats, Integers
from vstatics.numerics.compiled import compiled, put
from vstatics.synthesis.boxes.search.ranges import extremes, has_one_sign
from vstatics.synthesis.boxes.search.set_ratios import Asked

NARROW_CELL = 1.05
"""A cell is not halved further along a ratio whose bounds are so near. [-]"""
MOST_SWEEPS = 4
"""So often a cell is made less by all targets in turn."""
LESS = 0.8
"""It goes on where less than this share of it is left along a ratio. [-]"""
ROUNDING = 1e-12
"""A share that is cut off is so much less. [-]"""


class RatioCells(NamedTuple):
    """Cells one on the other, the next to look at on top; and room for the one looked at."""

    low: Floats
    """Bounds of ring teeth/sun teeth, shape (cells, sets). [-]"""
    high: Floats
    reach: Integers
    """Targets that each ratio may have there, as bits, shape (cells, ratios)."""
    stages: Integers
    """How many kinds of fits have been tried, shape (cells,)."""
    known: Booleans
    """Whether it is known that the gears can have elements as wanted, shape (cells,)."""
    parts: Floats
    """Numerators and denominators at its corners, shape (ratios, 2, corners)."""
    ends: Floats
    """What one gear leaves along each ratio, as shares of the cell, shape (sets, 2)."""
    hull: Floats
    """What all gears that a target may have leave, shape (sets, 2)."""
    left: Floats
    """What all targets leave, shape (sets, 2)."""
    slack: Floats
    """How far each corner is within the one end of a range, and the other, shape (2, corners)."""


def cells_room(ratios: int, asked: Asked, sets: int) -> RatioCells:
    """Room for so many ratios."""
    halvings = math.log2(math.log(asked.high / asked.low) / math.log(NARROW_CELL))
    deep = 2 + len(asked.targets) + sets * math.ceil(max(halvings, 0))
    return RatioCells(
        low=np.zeros((deep, sets)),
        high=np.zeros((deep, sets)),
        reach=np.zeros((deep, ratios), np.int64),
        stages=np.zeros(deep, np.int64),
        known=np.zeros(deep, np.bool_),
        parts=np.zeros((ratios, 2, 2**sets)),
        ends=np.zeros((sets, 2)),
        hull=np.zeros((sets, 2)),
        left=np.zeros((sets, 2)),
        slack=np.zeros((2, 2**sets)),
    )


@compiled
def is_left(parts: Floats, asked: Asked, cells: RatioCells, top: int) -> bool:
    """Make a cell less by all targets; whether something of it is left.

    A target with one ratio has it for its own.

    Parameters
    ----------
    parts : array, shape (ratios, 2, corners)
        At the corners of the bounds.
    asked : Asked
    cells : RatioCells
    top : int
        The number of the cell.
    """
    low, high = cells.low[top], cells.high[top]
    for _ in range(MOST_SWEEPS):
        _cut_out(parts, asked, cells, top)
        cells.left[:, 0] = 0.0
        cells.left[:, 1] = 1.0
        for target in range(len(asked.targets)):
            if not _has_target(target, asked, cells, top):
                return False
        share = 1.0
        for number in range(len(low)):
            first, last = cells.left[number]
            share = min(share, last - first)
            width = high[number] - low[number]
            high[number] = low[number] + last * width
            low[number] += first * width
        if share > LESS:
            break
    return True


@compiled
def _cut_out(parts: Floats, asked: Asked, cells: RatioCells, top: int) -> None:
    """Numerators and denominators at the corners of a cell, of ratios with a target."""
    width = asked.high - asked.low
    for ratio in range(len(parts)):
        if cells.reach[top, ratio] == 0:
            continue
        for half in range(2):
            here = cells.parts[ratio, half]
            put(parts[ratio, half], here)
            for number in range(cells.low.shape[1]):
                first = (cells.low[top, number] - asked.low) / width
                last = (cells.high[top, number] - asked.low) / width
                bit = 1 << number
                for corner in range(len(here)):
                    if corner & bit == 0:
                        value, slope = here[corner], here[corner | bit] - here[corner]
                        here[corner] = value + first * slope
                        here[corner | bit] = value + last * slope


@compiled
def _has_target(target: int, asked: Asked, cells: RatioCells, top: int) -> bool:
    """Whether some ratio may have a target in what is left of a cell; it is made less."""
    reach, hull, left = cells.reach[top], cells.hull, cells.left
    hull[:, 0] = 1.0
    hull[:, 1] = 0.0
    count, only = 0, -1
    for ratio in range(len(reach)):
        if (reach[ratio] >> target) & 1 == 0:
            continue
        if not _leaves(cells.parts[ratio], asked.least[target], asked.most[target], cells):
            reach[ratio] ^= 1 << target
            continue
        count, only = count + 1, ratio
        for number in range(len(hull)):
            hull[number, 0] = min(hull[number, 0], cells.ends[number, 0])
            hull[number, 1] = max(hull[number, 1], cells.ends[number, 1])
    if count == 1:
        reach[only] = 1 << target
    for number in range(len(left)):
        left[number, 0] = max(left[number, 0], hull[number, 0])
        left[number, 1] = min(left[number, 1], hull[number, 1])
        if left[number, 0] > left[number, 1]:
            return False
    return count > 0


@compiled
def _leaves(part: Floats, least: float, most: float, cells: RatioCells) -> bool:
    """What a gear that is to be within a range leaves of a cell, into `ends`; whether there is any.

    The quotient is within where two polynomials are not below 0. Along the ratio of a set the
    greatest of what they are at the other corners is convex: where it is below 0, at an end of the
    cell, it is so up to the first zero of one of them.
    """
    ends, slack = cells.ends, cells.slack
    ends[:, 0] = 0.0
    ends[:, 1] = 1.0
    if has_one_sign(part[1]):
        sign = math.copysign(1.0, part[1, 0])
    elif has_one_sign(part[0]):
        sign = math.copysign(1.0, part[0, 0] * most)
    else:
        return True
    for corner in range(part.shape[1]):
        slack[0, corner] = sign * (part[0, corner] - least * part[1, corner])
        slack[1, corner] = sign * (most * part[1, corner] - part[0, corner])
    for number in range(len(ends)):
        for half in range(2):
            first, last = _positive(slack[half], 1 << number)
            ends[number, 0] = max(ends[number, 0], first)
            ends[number, 1] = min(ends[number, 1], last)
        if ends[number, 0] > ends[number, 1]:
            return False
    return True


@compiled
def _positive(slack: Floats, bit: int) -> tuple[float, float]:
    """Between which shares of an edge of a cell all that is not below 0 is; else 1 and 0."""
    here = there = -math.inf
    for corner in range(len(slack)):
        if corner & bit:
            there = max(there, slack[corner])
        else:
            here = max(here, slack[corner])
    first, last = 0.0, 1.0
    if here < 0:
        if there < 0:
            return 1.0, 0.0
        first = 1.0
        for corner in range(len(slack)):
            if corner & bit and slack[corner] >= 0:
                other = slack[corner ^ bit]
                first = min(first, other / (other - slack[corner]))
        first = max(first - ROUNDING, 0.0)
    elif there < 0:
        last = 0.0
        for corner in range(len(slack)):
            if corner & bit and slack[corner ^ bit] >= 0:
                other = slack[corner ^ bit]
                last = max(last, other / (other - slack[corner]))
        last = min(last + ROUNDING, 1.0)
    return first, last


@compiled
def spread_in(cells: RatioCells, top: int) -> float:
    """How far ln(i) of what may have a target spreads in a cell."""
    found = 0.0
    for ratio in range(cells.parts.shape[0]):
        if cells.reach[top, ratio]:
            part = cells.parts[ratio]
            if not (has_one_sign(part[0]) and has_one_sign(part[1])):
                return math.inf
            least, most = extremes(part[0], part[1])
            found = max(found, abs(math.log(most / least)))
    return found


@compiled
def longest(cells: RatioCells, top: int) -> int:
    """The set along whose ratio gears change most; -1 if the cell is too narrow."""
    best = 0.0
    found = -1
    for number in range(cells.low.shape[1]):
        if cells.high[top, number] > NARROW_CELL * cells.low[top, number]:
            total = 0.0
            for ratio in range(cells.parts.shape[0]):
                if cells.reach[top, ratio]:
                    total += change_along(cells.parts[ratio], number)
            if total > best:
                best = total
                found = number
    return found


@compiled
def change_along(part: Floats, number: int) -> float:
    """How much a quotient changes at most along the ratio of a set, from 0 to 1."""
    most = 0.0
    for corner in range(part.shape[1]):
        if (corner >> number) & 1 == 0:
            other = corner | (1 << number)
            one = part[0, other] * part[1, corner]
            two = part[0, corner] * part[1, other]
            if one != two:
                most = max(most, abs(one - two) / (abs(one) + abs(two)))
    return most


@compiled
def double(cells: RatioCells, top: int) -> None:
    """Put the same cell on top of a cell."""
    put(cells.low[top], cells.low[top + 1])
    put(cells.high[top], cells.high[top + 1])
    put(cells.reach[top], cells.reach[top + 1])
    cells.stages[top + 1] = cells.stages[top]
    cells.known[top + 1] = cells.known[top]


@compiled
def halve(cells: RatioCells, top: int, number: int) -> None:
    """Halve a cell, along the ratio of a set: the lower half stays there, the other is next."""
    double(cells, top)
    middle = math.sqrt(cells.low[top, number] * cells.high[top, number])
    cells.high[top, number] = middle
    cells.low[top + 1, number] = middle
