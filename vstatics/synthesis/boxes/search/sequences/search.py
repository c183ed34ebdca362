"""The sequence of gears that is told of a set of elements, and the ratios of its sets.

A sequence is found where some ratios of the sets leave its spread and steps, and the targets
besides, within their ranges. What is told of it is, first, as many gears as there can be, then
such whose neighbours differ by one element's change, then what is nearest to the middles of the
ranges: the least squares, with the choices of ratios at a grid of points. Where single shifts are
asked for, only such sequences are looked for, so as many gears as can be shifted so.

The bounds are halved again and again. A cell is left where no choice is possible by the bounds of
its steps; in its middle the best is looked for; where it is small, what is possible in it is fitted
from its middle, and what is not found then is not there.
"""

from __future__ import annotations

import math

from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.compiled import compiled, fill, put
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
from vstatics.synthesis.boxes.search.sequences.room import NARROW, SequenceRoom
from vstatics.synthesis.boxes.search.set_ratios import Asked

MOST_LOOKS = 2000
"""So many gears of choices are looked at in a cell, before it is halved."""
MOST_AT_POINT = 50_000
"""And at a point."""
MOST_CELLS = 20_000
"""With more cells a set of elements is given up."""
MORE_CELLS = 1000
"""So many are looked at for as many gears that shift singly."""
SMALL = 1.05
"""All that is possible in a cell is fitted where no ratio of a set has bounds farther apart. [-]"""
MOST_FITS = 40
"""So many choices are fitted in a cell, before it is halved."""


@compiled
def sequence_found(parts: Floats, asked: Asked, room: SequenceRoom) -> tuple[int, bool]:
    """The gears of the sequence that is told; whether there may be one where none is found.

    Parameters
    ----------
    parts : array, shape (ratios, 2, corners)
        Numerators and denominators of different ratios at the corners of the bounds.
    asked : Asked
        Its targets are gears besides.
    room : SequenceRoom
        `ratio_of` and `chains.used` tell whose ratios they are; `best_gears` and `best_logs`
        take what is found.
    """
    best, count = room.best, len(parts)
    fill(best, 0)
    room.squares[0] = math.inf
    if count < len(asked.targets) + room.wanted.least:
        return 0, False
    room.is_single_left[0] = False
    is_open = _looked(parts, MOST_CELLS, asked, room)
    if best[0] > 0 and best[1] == 0:
        room.is_single_left[0] = True
        _looked(parts, MORE_CELLS, asked, room)
    if best[0] > 0:
        find_nearest(parts, asked, room)
    return best[0], bool(is_open and best[0] == 0)


@compiled
def _looked(parts: Floats, most: int, asked: Asked, room: SequenceRoom) -> bool:
    """Look for what is better in so many cells; whether there may be more."""
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


@compiled
def _may_be_better(count: int, top: int, asked: Asked, room: SequenceRoom) -> bool:
    """Whether something better may be in a cell; of long searches that is taken for granted."""
    own, targets = room.cell, len(asked.targets)
    forward = find_bounds(room.parts[top], count, asked, own, room.sums)
    if forward < fewest(room) or not matched(own.reach, count, room.match):
        return False
    goal, depth = Goal(targets, count, fewest(room), MOST_LOOKS), 0
    begin_choices(own)
    while True:
        depth = next_choice(room.wanted, goal, depth, own)
        if depth <= 0:
            return depth < 0
        if may_use_all(targets, depth, is_singly(room), room):
            return True


@compiled
def _find_middle(top: int, room: SequenceRoom) -> None:
    """The middle of a cell, as logarithms of the ratios of sets."""
    for number in range(room.low.shape[1]):
        room.fit.logs[number] = 0.5 * math.log(room.low[top, number] * room.high[top, number])


@compiled
def _is_point_better(parts: Floats, asked: Asked, room: SequenceRoom) -> bool:
    """Whether something better is at the point; then it is noted."""
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


@compiled
def _is_settled(parts: Floats, top: int, widest: int, asked: Asked, room: SequenceRoom) -> bool:
    """Whether all that is possible in a small cell was fitted, so nothing better is left in it.

    It was not where a gear of a choice turns the other way in the middle, but in a narrow one.
    """
    targets, own, depth, fits = len(asked.targets), room.cell, 0, 0
    goal = Goal(targets, len(parts), fewest(room), MOST_LOOKS)
    begin_choices(own)
    while fits < MOST_FITS and not is_best(room):
        depth = next_choice(room.wanted, goal, depth, own)
        if depth <= 0:
            return depth == 0
        gears = depth - targets
        if gears >= fewest(room) and may_use_all(targets, depth, is_singly(room), room):
            fits += 1
            put(own.chosen[:depth], room.point.chosen)
            _find_middle(top, room)
            if widest >= 0 and squares_at(parts, depth, asked, room) == math.inf:
                return False
            if fitted_choice(parts, depth, asked, room) < math.inf:
                find_logs(parts, asked, room)
                note(depth, asked, is_singly(room), math.inf, room)
    return is_best(room)


@compiled
def _widest(count: int, top: int, room: SequenceRoom) -> int:
    """The set along whose ratio forward gears change most in a cell; -1 if it is narrow."""
    found, most = -1, 0.0
    for number in range(room.low.shape[1]):
        if room.high[top, number] <= NARROW * room.low[top, number]:
            continue
        total = math.log(room.high[top, number] / room.low[top, number]) * 1e-3
        for ratio in range(count):
            if room.cell.ends[ratio, 0] <= room.cell.ends[ratio, 1]:
                total += change_along(room.parts[top, ratio], number)
        if total > most:
            found, most = number, total
    return found


@compiled
def _is_small(top: int, room: SequenceRoom) -> bool:
    """Whether a cell is so small that what is possible in it is fitted."""
    for number in range(room.low.shape[1]):
        if room.high[top, number] > SMALL * room.low[top, number]:
            return False
    return True


@compiled
def _halve(room: SequenceRoom, count: int, top: int, number: int) -> None:
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
