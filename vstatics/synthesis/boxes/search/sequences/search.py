"""Search for the sequence of gears to report for an element set, and for its gear-set ratios.

A sequence exists if spread, steps and targets are within their ranges at some gear-set ratios. The
reported sequence has first as many gears as possible, then single shifts between neighbours, then
the smallest sum of squared distances from the middles of the ranges. If single shifts are required,
only sequences with single shifts are considered.

The range of gear-set ratios is repeatedly halved to cells. A cell is discarded if its ranges allow
no choice of gears; otherwise the best choice at its middle is recorded. In a small cell, every
possible choice is fitted from the middle; solutions that these fits miss are lost.
"""

from __future__ import annotations

import math

from vstatics.core.numerics.arrays import Floats
from vstatics.synthesis.boxes.search.cells import change_along
from vstatics.synthesis.boxes.search.matching import matched
from vstatics.synthesis.boxes.search.sequences.bounds import find_bounds
from vstatics.synthesis.boxes.search.sequences.choosing import (
    Goal,
    begin_choices,
    may_use_all,
    next_choice,
)
from vstatics.synthesis.boxes.search.sequences.fitting import fitted_choice, squares_at
from vstatics.synthesis.boxes.search.sequences.nearest import find_nearest
from vstatics.synthesis.boxes.search.sequences.point import (
    fewest,
    find_logs,
    find_point,
    is_best,
    is_singly,
    note,
)
from vstatics.synthesis.boxes.search.sequences.room import NARROW_SEQUENCE_CELL, SequenceRoom
from vstatics.synthesis.boxes.search.set_ratios import Asked
from vstatics.synthesis.compiled import compiled_part, fill, put

MOST_CELL_LOOKS = 2000
"""Largest number of trial assignments of gear ratios to gears before a cell is halved."""
MOST_AT_POINT = 50_000
"""Largest number of trial assignments of gear ratios to gears at a point."""
MOST_SEQUENCE_CELLS = 20_000
"""Number of cells of gear-set ratios after which an element set is given up."""
MORE_CELLS = 1000
"""Number of further cells to examine for an equally long sequence with single shifts."""
SMALL = 1.05
"""Quotient of the bounds of each gear-set ratio in a cell, below which choices are fitted. [-]"""
MOST_CELL_FITS = 40
"""Largest number of choices of gears to fit before a cell is halved."""


@compiled_part
def sequence_found(parts: Floats, asked: Asked, room: SequenceRoom) -> tuple[int, bool]:
    """Return the number of gears of the best sequence, and whether the search is incomplete.

    Parameters
    ----------
    parts : array, shape (ratios, 2, corners)
        Numerators and denominators of different gear ratios at the corners of the bounds.
    asked : Asked
        Requirements; the targets are gears in addition to the sequence.
    room : SequenceRoom
        Work arrays; `ratio_of` and `chains.used` describe the combinations, `best_gears` and
        `best_logs` receive the sequence.
    """
    best, count = room.best, len(parts)
    fill(best, 0)
    room.squares[0] = math.inf
    if count < len(asked.targets) + room.wanted.least:
        return 0, False
    room.is_single_left[0] = False
    is_open = _looked(parts, MOST_SEQUENCE_CELLS, asked, room)
    if best[0] > 0 and best[1] == 0:
        room.is_single_left[0] = True
        _looked(parts, MORE_CELLS, asked, room)
    if best[0] > 0:
        find_nearest(parts, asked, room)
    return best[0], bool(is_open and best[0] == 0)


@compiled_part
def _looked(parts: Floats, most: int, asked: Asked, room: SequenceRoom) -> bool:
    """Search for a better choice in at most `most` cells; return whether cells remain."""
    count, top, is_open = len(parts), 1, False
    for ratio in range(count):
        put(parts[ratio, 0], room.parts[0, ratio, 0])
        put(parts[ratio, 1], room.parts[0, ratio, 1])
    fill(room.low[0], asked.low)
    fill(room.high[0], asked.high)
    end = min(room.steps[1], room.steps[0] + most)
    while top > 0 and room.steps[0] < end and not is_best(room):
        top -= 1
        room.steps[0] += 1
        if not _may_be_better(count, top, asked, room):
            continue
        _find_middle(top, room)
        if _is_point_better(parts, asked, room) and not _may_be_better(count, top, asked, room):
            continue
        number = _widest(count, top, room)
        if _is_small(top, room) and _is_settled(parts, top, number, asked, room):
            continue
        if number < 0:
            is_open = True
            continue
        _halve(room, count, top, number)
        top += 2
    return bool(is_open or top > 0)


@compiled_part
def _may_be_better(count: int, top: int, asked: Asked, room: SequenceRoom) -> bool:
    """Return whether a cell can contain a better choice. True if the decision takes too long."""
    cell, targets = room.cell, len(asked.targets)
    forward = find_bounds(room.parts[top], count, asked, cell, room.sums)
    if forward < fewest(room) or not matched(cell.reach, count, room.match):
        return False
    goal, depth = Goal(targets, count, fewest(room), MOST_CELL_LOOKS), 0
    begin_choices(cell)
    while True:
        depth = next_choice(room.wanted, goal, depth, cell)
        if depth <= 0:
            return depth < 0
        if may_use_all(targets, depth, is_singly(room), room):
            return True


@compiled_part
def _find_middle(top: int, room: SequenceRoom) -> None:
    for number in range(room.low.shape[1]):
        room.fit.logs[number] = 0.5 * math.log(room.low[top, number] * room.high[top, number])


@compiled_part
def _is_point_better(parts: Floats, asked: Asked, room: SequenceRoom) -> bool:
    """Record the best choice at the current point; return True for an improvement."""
    find_point(parts, asked, room)
    targets, is_better, depth = len(asked.targets), False, 0
    goal = Goal(targets, len(parts), fewest(room), MOST_AT_POINT)
    begin_choices(room.point)
    while not is_best(room):
        depth = next_choice(room.wanted, goal, depth, room.point)
        if depth <= 0:
            break
        if depth - targets >= fewest(room) and note(depth, asked, is_singly(room), math.inf, room):
            is_better = True
    return is_better


@compiled_part
def _is_settled(parts: Floats, top: int, widest: int, asked: Asked, room: SequenceRoom) -> bool:
    """Fit every possible choice in a small cell; return True if it needs no further halving.

    Halving continues if a gear of a choice has the wrong direction in the middle of the cell,
    unless the cell is narrow.
    """
    targets, cell, depth, fits = len(asked.targets), room.cell, 0, 0
    goal = Goal(targets, len(parts), fewest(room), MOST_CELL_LOOKS)
    begin_choices(cell)
    while fits < MOST_CELL_FITS and not is_best(room):
        depth = next_choice(room.wanted, goal, depth, cell)
        if depth <= 0:
            return depth == 0
        gears = depth - targets
        if gears >= fewest(room) and may_use_all(targets, depth, is_singly(room), room):
            fits += 1
            put(cell.chosen[:depth], room.point.chosen)
            _find_middle(top, room)
            if widest >= 0 and squares_at(parts, depth, asked, room) == math.inf:
                return False
            if fitted_choice(parts, depth, asked, room) < math.inf:
                find_logs(parts, asked, room)
                note(depth, asked, is_singly(room), math.inf, room)
    return is_best(room)


@compiled_part
def _widest(count: int, top: int, room: SequenceRoom) -> int:
    """Return the gear set whose ratio changes the forward gears most; -1 if the cell is narrow."""
    widest, most = -1, 0.0
    for number in range(room.low.shape[1]):
        if room.high[top, number] <= NARROW_SEQUENCE_CELL * room.low[top, number]:
            continue
        total = math.log(room.high[top, number] / room.low[top, number]) * 1e-3
        for ratio in range(count):
            if room.cell.ends[ratio, 0] <= room.cell.ends[ratio, 1]:
                total += change_along(room.parts[top, ratio], number)
        if total > most:
            widest, most = number, total
    return widest


@compiled_part
def _is_small(top: int, room: SequenceRoom) -> bool:
    for number in range(room.low.shape[1]):
        if room.high[top, number] > SMALL * room.low[top, number]:
            return False
    return True


@compiled_part
def _halve(room: SequenceRoom, count: int, top: int, number: int) -> None:
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
