"""Cells of the ratios of sets, and what is left of one where gears are to meet their targets.

Numerators and denominators are linear in each ratio, so what a gear can have in a cell is told
from its corners; and so is how far a ratio of a set may go along an edge before the gear is
beyond its target wherever the others are. What is cut off holds no solution.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats, Integers
from vstatics.core.numerics.compiled import compiled, put
from vstatics.synthesis.boxes.search.matching import MatchRoom, is_assigned
from vstatics.synthesis.boxes.search.planes import PlaneRoom, plane_room, planes_leave
from vstatics.synthesis.boxes.search.ranges import extremes, has_one_sign, reached
from vstatics.synthesis.boxes.search.set_ratios import Asked
from vstatics.synthesis.tolerances import CELL_ROUNDING

NARROW_CELL = 1.001
"""A cell is not halved further along a ratio whose bounds are so near. [-]"""
MOST_SWEEPS = 4
"""So often a cell is made less by all targets in turn."""
LESS = 0.8
"""It goes on where less than this share of it is left along a ratio. [-]"""


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
    shares: Floats
    """Where a cell begins and ends within the bounds, shape (sets, 2)."""
    left: Floats
    """What all targets leave, shape (sets, 2)."""
    slack: Floats
    """How far each corner is within the one end of a range, and the other, shape (2, corners)."""
    planes: PlaneRoom


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
        shares=np.zeros((sets, 2)),
        left=np.zeros((sets, 2)),
        slack=np.zeros((2, 2**sets)),
        planes=plane_room(len(asked.targets), sets),
    )


@compiled
def is_left(parts: Floats, asked: Asked, cells: RatioCells, match: MatchRoom, top: int) -> bool:
    """Make a cell less by all targets; whether something of it is left.

    First by which ratios may have which targets; then by those that have one of their own.

    Parameters
    ----------
    parts : array, shape (ratios, 2, corners)
        At the corners of the bounds.
    asked : Asked
    cells : RatioCells
    match : MatchRoom
    top : int
        The number of the cell.
    """
    low, high = cells.low[top], cells.high[top]
    for _ in range(MOST_SWEEPS):
        if not is_assigned(cells.reach[top], len(parts), match):
            return False
        _cut_out(parts, asked, cells, top)
        if _is_less(asked, cells, top) and not is_assigned(cells.reach[top], len(parts), match):
            return False
        cells.left[:, 0] = 0.0
        cells.left[:, 1] = 1.0
        for target in range(len(asked.targets)):
            ratio = _own(cells.reach[top], target)
            cells.planes.own[target] = ratio
            if ratio >= 0:
                part = cells.parts[ratio]
                if not _leaves(part, asked.least[target], asked.most[target], cells):
                    return False
        if not planes_leave(cells.parts, asked.least, asked.most, cells.planes, cells.left):
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
    sets, shares = cells.low.shape[1], cells.shares
    width = asked.high - asked.low
    for number in range(sets):
        shares[number, 0] = (cells.low[top, number] - asked.low) / width
        shares[number, 1] = (cells.high[top, number] - asked.low) / width
    for ratio in range(len(parts)):
        if cells.reach[top, ratio] == 0:
            continue
        for half in range(2):
            here = cells.parts[ratio, half]
            put(parts[ratio, half], here)
            for number in range(sets):
                first, last = shares[number]
                bit = 1 << number
                for block in range(0, len(here), 2 * bit):
                    for corner in range(block, block + bit):
                        value = here[corner]
                        slope = here[corner + bit] - value
                        here[corner] = value + first * slope
                        here[corner + bit] = value + last * slope


@compiled
def _is_less(asked: Asked, cells: RatioCells, top: int) -> bool:
    """Take from each ratio the targets that it is beyond everywhere in a cell; whether any is."""
    reach = cells.reach[top]
    found = False
    for ratio in range(len(reach)):
        if reach[ratio]:
            over, under = cells.parts[ratio]
            before = reach[ratio]
            reach[ratio] &= reached(over, under, asked.least, asked.most)
            found |= reach[ratio] != before
    return found


@compiled
def _own(reach: Integers, target: int) -> int:
    """The one ratio that may have a target; -1 where there are several."""
    found = -1
    for ratio in range(len(reach)):
        if (reach[ratio] >> target) & 1:
            if found >= 0:
                return -1
            found = ratio
    return found


@compiled
def _leaves(part: Floats, least: float, most: float, cells: RatioCells) -> bool:
    """What a gear that is to be within a range leaves of a cell, into `left`; whether there is any.

    The quotient is within where two polynomials are not below 0. Along the ratio of a set the
    greatest of what they are at the other corners is convex: where it is below 0, at an end of the
    cell, it is so up to the first zero of one of them.
    """
    left, slack = cells.left, cells.slack
    if has_one_sign(part[1]):
        sign = math.copysign(1.0, part[1, 0])
    elif has_one_sign(part[0]):
        sign = math.copysign(1.0, part[0, 0] * most)
    else:
        return True
    for corner in range(part.shape[1]):
        slack[0, corner] = sign * (part[0, corner] - least * part[1, corner])
        slack[1, corner] = sign * (most * part[1, corner] - part[0, corner])
    for number in range(len(left)):
        for half in range(2):
            first, last = _positive(slack[half], 1 << number)
            left[number, 0] = max(left[number, 0], first)
            left[number, 1] = min(left[number, 1], last)
        if left[number, 0] > left[number, 1]:
            return False
    return True


@compiled
def _positive(slack: Floats, bit: int) -> tuple[float, float]:
    """Between which shares of an edge of a cell all that is not below 0 is; else 1 and 0."""
    here = there = -math.inf
    for block in range(0, len(slack), 2 * bit):
        for corner in range(block, block + bit):
            here = max(here, slack[corner])
            there = max(there, slack[corner + bit])
    first, last = 0.0, 1.0
    if here < 0:
        if there < 0:
            return 1.0, 0.0
        first = 1.0
        for corner in range(len(slack)):
            if corner & bit and slack[corner] >= 0:
                other = slack[corner ^ bit]
                first = min(first, other / (other - slack[corner]))
        first = max(first - CELL_ROUNDING, 0.0)
    elif there < 0:
        last = 0.0
        for corner in range(len(slack)):
            if corner & bit and slack[corner ^ bit] >= 0:
                other = slack[corner ^ bit]
                last = max(last, other / (other - slack[corner]))
        last = min(last + CELL_ROUNDING, 1.0)
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
