"""Cells of gear-set ratios, and their reduction to the part where gears meet their targets.

A cell is a range for each gear-set ratio. The ratio of a gear is a quotient whose numerator and
denominator are linear in each gear-set ratio. Their values at the corners of a cell therefore bound
the quotient. The corners also bound the part of a cell, along each gear-set ratio, in which the
gear can meet its target (a wanted ratio). Only parts without solutions are removed.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats, Integers
from vstatics.synthesis.boxes.search.engaged import integers
from vstatics.synthesis.boxes.search.matching import MatchRoom, is_assigned
from vstatics.synthesis.boxes.search.planes import PlaneRoom, plane_room, planes_leave
from vstatics.synthesis.boxes.search.ranges import extremes, has_one_sign, reached
from vstatics.synthesis.boxes.search.set_ratios import Asked
from vstatics.synthesis.compiled import compiled_part, put, shared
from vstatics.synthesis.tolerances import CELL_ROUNDING

NARROW_CELL = 1.001
"""Quotient of the bounds of a gear-set ratio below which a cell is not halved further. [-]"""
MOST_SWEEPS = 4
"""Largest number of passes in which each target reduces a cell once."""
LESS = 0.8
"""Fraction of a cell's width above which the remainder of the cell counts as little reduced. [-]"""


@shared
class RatioCells(NamedTuple):
    """Stack of cells with the next cell on top, and work arrays for the current cell."""

    low: Floats
    """Lower bounds of ring teeth divided by sun teeth, shape (cells, sets). [-]"""
    high: Floats
    reach: Integers
    """Bit mask of the targets that each gear ratio can meet in a cell, shape (cells, ratios)."""
    stages: Integers
    """Number of stages of `solving.SPREADS` at which fits have been tried, shape (cells,)."""
    known: Booleans
    """True if an assignment of combinations to all targets is already known, shape (cells,)."""
    parts: Floats
    """Numerators and denominators of the gear ratios at the corners of the cell, shape (ratios, 2,
    corners). [-]
    """
    shares: Floats
    """Start and end of the cell along each gear-set ratio, as fractions of the range between the
    bounds, shape (sets, 2). [-]
    """
    left: Floats
    """Start and end of the part of the cell in which all targets can be met, in fractions of the
    cell's width, shape (sets, 2). [-]
    """
    slack: Floats
    """Two polynomials that are not negative where a target is met, at the corners, (2, corners).
    [-]
    """
    planes: PlaneRoom


def cells_room(ratios: int, asked: Asked, sets: int) -> RatioCells:
    """Return work arrays for cells, for a number of gear ratios and of gear sets."""
    halvings = math.log2(math.log(asked.high / asked.low) / math.log(NARROW_CELL))
    deep = 2 + len(asked.targets) + sets * math.ceil(max(halvings, 0))
    return RatioCells(
        low=np.zeros((deep, sets)),
        high=np.zeros((deep, sets)),
        reach=integers(deep, ratios),
        stages=integers(deep),
        known=np.zeros(deep, np.bool_),
        parts=np.zeros((ratios, 2, 2**sets)),
        shares=np.zeros((sets, 2)),
        left=np.zeros((sets, 2)),
        slack=np.zeros((2, 2**sets)),
        planes=plane_room(len(asked.targets), sets),
    )


@compiled_part
def is_left(parts: Floats, asked: Asked, cells: RatioCells, match: MatchRoom, top: int) -> bool:
    """Reduce a cell to the part in which all targets can be met; return False if the part is empty.

    First, each gear ratio loses the targets that it cannot meet in the cell. Then each target that
    only one gear ratio can meet reduces the cell.

    Parameters
    ----------
    parts : array, shape (ratios, 2, corners)
        Numerators and denominators of the gear ratios at the corners of the bounds.
    asked : Asked
    cells : RatioCells
    match : MatchRoom
    top : int
        Index of the cell in the stack.
    """
    low, high = cells.low[top], cells.high[top]
    for _ in range(MOST_SWEEPS):
        if not is_assigned(cells.reach[top], len(parts), match):
            return False
        _cut_out(parts, asked, cells, top)
        if _is_less(asked, cells, top) and not is_assigned(cells.reach[top], len(parts), match):
            return False
        for target in range(len(asked.targets)):
            ratio = _only_ratio(cells.reach[top], target)
            cells.planes.only_ratios[target] = ratio
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


@compiled_part
def _cut_out(parts: Floats, asked: Asked, cells: RatioCells, top: int) -> None:
    sets, shares = cells.low.shape[1], cells.shares
    width = asked.high - asked.low
    for number in range(sets):
        shares[number, 0] = (cells.low[top, number] - asked.low) / width
        shares[number, 1] = (cells.high[top, number] - asked.low) / width
        cells.left[number, 0] = 0.0
        cells.left[number, 1] = 1.0
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


@compiled_part
def _is_less(asked: Asked, cells: RatioCells, top: int) -> bool:
    """Remove the targets that a gear ratio misses in the whole cell; return True if any."""
    reach = cells.reach[top]
    is_any = False
    for ratio in range(len(reach)):
        if reach[ratio]:
            over, under = cells.parts[ratio]
            before = reach[ratio]
            reach[ratio] &= reached(over, under, asked.least, asked.most)
            is_any |= reach[ratio] != before
    return is_any


@compiled_part
def _only_ratio(reach: Integers, target: int) -> int:
    """Return the index of the only gear ratio that can meet a target; -1 if none or several can."""
    single = -1
    for ratio in range(len(reach)):
        if (reach[ratio] >> target) & 1:
            if single >= 0:
                return -1
            single = ratio
    return single


@compiled_part
def _leaves(part: Floats, least: float, most: float, cells: RatioCells) -> bool:
    """Reduce `left` to the part of a cell where the ratio of a gear can be within a range.

    The quotient is within the range where two polynomials are non-negative. Along one gear-set
    ratio, the maximum of such a polynomial over the other ratios is convex. If it is negative at an
    end of the cell, it is negative up to the first zero along any edge.

    The result is False if no part remains.
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


@compiled_part
def _positive(slack: Floats, bit: int) -> tuple[float, float]:
    """Return the range of a gear-set ratio in a cell where a polynomial can be non-negative.

    The range is in fractions of the cell's width; (1, 0) if the polynomial is negative everywhere.
    """
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


@compiled_part
def spread_in(cells: RatioCells, top: int) -> float:
    """Return the largest variation of ln(i) in a cell, over all gear ratios i with a target.

    The result is infinite if such a ratio has a zero or a pole in the cell.
    """
    spread = 0.0
    for ratio in range(cells.parts.shape[0]):
        if cells.reach[top, ratio]:
            part = cells.parts[ratio]
            if not (has_one_sign(part[0]) and has_one_sign(part[1])):
                return math.inf
            least, most = extremes(part[0], part[1])
            spread = max(spread, abs(math.log(most / least)))
    return spread


@compiled_part
def longest(cells: RatioCells, top: int) -> int:
    """Return the gear set whose ratio changes the gear ratios most; -1 if the cell is narrow."""
    best = 0.0
    longest_set = -1
    for number in range(cells.low.shape[1]):
        if cells.high[top, number] > NARROW_CELL * cells.low[top, number]:
            total = 0.0
            for ratio in range(cells.parts.shape[0]):
                if cells.reach[top, ratio]:
                    total += change_along(cells.parts[ratio], number)
            if total > best:
                best = total
                longest_set = number
    return longest_set


@compiled_part
def change_along(part: Floats, number: int) -> float:
    """Return the largest relative change of a gear ratio along a gear-set ratio, from 0 to 1."""
    most = 0.0
    for corner in range(part.shape[1]):
        if (corner >> number) & 1 == 0:
            other = corner | (1 << number)
            first = part[0, other] * part[1, corner]
            second = part[0, corner] * part[1, other]
            if first != second:
                most = max(most, abs(first - second) / (abs(first) + abs(second)))
    return most


@compiled_part
def double(cells: RatioCells, top: int) -> None:
    """Push a copy of a cell onto the stack."""
    put(cells.low[top], cells.low[top + 1])
    put(cells.high[top], cells.high[top + 1])
    put(cells.reach[top], cells.reach[top + 1])
    cells.stages[top + 1] = cells.stages[top]
    cells.known[top + 1] = cells.known[top]


@compiled_part
def halve(cells: RatioCells, top: int, number: int) -> None:
    """Halve a cell along the ratio of a gear set, and push the upper half onto the stack."""
    double(cells, top)
    middle = math.sqrt(cells.low[top, number] * cells.high[top, number])
    cells.high[top, number] = middle
    cells.low[top + 1, number] = middle
