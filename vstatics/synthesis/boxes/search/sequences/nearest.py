"""Selection of gears and gear-set ratios that fit a sequence of gears best, from a grid."""

from __future__ import annotations

import math

from vstatics.core.numerics.arrays import Floats
from vstatics.synthesis.boxes.search.sequences.bounds import find_bounds
from vstatics.synthesis.boxes.search.sequences.choosing import (
    Goal,
    begin_choices,
    may_use_all,
    next_choice,
)
from vstatics.synthesis.boxes.search.sequences.fitting import fitted_choice, squares_at
from vstatics.synthesis.boxes.search.sequences.point import find_logs, note
from vstatics.synthesis.boxes.search.sequences.room import SequenceRoom
from vstatics.synthesis.boxes.search.set_ratios import Asked
from vstatics.synthesis.compiled import compiled_part, put

MOST_NEAREST_LOOKS = 20_000
"""Largest number of trial assignments of gear ratios to gears."""
MOST_NEAREST_FITS = 200
"""Largest number of choices of gears that are fitted."""
GRID = 3
"""Number of values of each gear-set ratio in the grid of starting points."""


@compiled_part
def find_nearest(parts: Floats, asked: Asked, room: SequenceRoom) -> None:
    """Find the choice of gears with the smallest squared errors among equally long sequences.

    Every choice that the ranges allow is fitted, starting from its best grid point.
    """
    targets, cell, depth, fits = len(asked.targets), room.cell, 0, 0
    length = targets + room.best[0]
    put(room.best_logs, room.fit.logs)
    put(room.best_chosen[:length], room.point.chosen)
    _fit(parts, length, asked, room)
    goal = Goal(targets, len(parts), room.best[0], MOST_NEAREST_LOOKS)
    find_bounds(parts, len(parts), asked, cell, room.sums)
    begin_choices(cell)
    while fits < MOST_NEAREST_FITS:
        depth = next_choice(room.wanted, goal, depth, cell)
        if depth <= 0:
            break
        if depth == length and may_use_all(targets, depth, room.best[1], room):
            fits += 1
            put(cell.chosen[:length], room.point.chosen)
            if _is_begun(parts, length, asked, room):
                _fit(parts, length, asked, room)


@compiled_part
def _fit(parts: Floats, length: int, asked: Asked, room: SequenceRoom) -> None:
    squares = fitted_choice(parts, length, asked, room)
    if squares < room.squares[0]:
        find_logs(parts, asked, room)
        note(length, asked, room.best[1], squares, room)


@compiled_part
def _is_begun(parts: Floats, length: int, asked: Asked, room: SequenceRoom) -> bool:
    """Move to the grid point where a choice fits best; return False if no point fits."""
    sets, best, least = len(room.best_logs), -1, math.inf
    for index in range(GRID**sets + 1):
        which = index
        if index == GRID**sets:
            which = best
        if which < 0:
            return False
        for number in range(sets):
            place = (which // GRID**number % GRID + 0.5) / GRID
            room.fit.logs[number] = math.log(asked.low) + place * math.log(asked.high / asked.low)
        squares = squares_at(parts, length, asked, room)
        if squares < least:
            best, least = index, squares
    return True
