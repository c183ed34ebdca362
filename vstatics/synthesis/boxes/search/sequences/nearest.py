"""The ratios of sets that are told of a sequence that is found: least squares from a grid."""

from __future__ import annotations

import math

from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.compiled import compiled, put
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

MOST_LOOKS = 20_000
"""So many gears of choices are looked at."""
MOST_FITS = 200
"""So many choices are fitted."""
GRID = 3
"""Values of the ratio of each set of which the best is where a fit begins."""


@compiled
def find_nearest(parts: Floats, asked: Asked, room: SequenceRoom) -> None:
    """Of choices that are as good as the best but for their sum of squares note the nearest.

    All that the bounds let be are fitted, each from that point of a grid where it is nearest.
    """
    targets, own, depth, fits = len(asked.targets), room.cell, 0, 0
    length = targets + room.best[0]
    put(room.best_logs, room.fit.logs)
    put(room.best_chosen[:length], room.point.chosen)
    _fit(parts, length, asked, room)
    goal = Goal(targets, len(parts), room.best[0], MOST_LOOKS)
    find_bounds(parts, len(parts), asked, own, room.sums)
    begin_choices(own)
    while fits < MOST_FITS:
        depth = next_choice(room.wanted, goal, depth, own)
        if depth <= 0:
            break
        if depth == length and may_use_all(targets, depth, room.best[1], room):
            fits += 1
            put(own.chosen[:length], room.point.chosen)
            if _is_begun(parts, length, asked, room):
                _fit(parts, length, asked, room)


@compiled
def _fit(parts: Floats, length: int, asked: Asked, room: SequenceRoom) -> None:
    """Fit the choice at the point, and note it if it is the best."""
    squares = fitted_choice(parts, length, asked, room)
    if squares < room.squares[0]:
        find_logs(parts, asked, room)
        note(length, asked, room.best[1], squares, room)


@compiled
def _is_begun(parts: Floats, length: int, asked: Asked, room: SequenceRoom) -> bool:
    """Go to the point of a grid where the choice is nearest; whether there is one."""
    sets, best, least = len(room.best_logs), -1, math.inf
    for number in range(GRID**sets + 1):
        which = number
        if number == GRID**sets:
            which = best
        if which < 0:
            return False
        for one in range(sets):
            place = (which // GRID**one % GRID + 0.5) / GRID
            room.fit.logs[one] = math.log(asked.low) + place * math.log(asked.high / asked.low)
        squares = squares_at(parts, length, asked, room)
        if squares < least:
            best, least = number, squares
    return True
