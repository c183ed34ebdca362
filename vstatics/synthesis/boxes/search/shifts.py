"""Whether gears can follow one another so that one element goes and one comes, before any fit."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from vstatics.core.numerics.arrays import Integers
from vstatics.core.numerics.compiled import compiled
from vstatics.synthesis.boxes.search.engaged import Combinations
from vstatics.synthesis.boxes.search.joining import SetRoom


def neighbours(targets: Sequence[float]) -> Integers:
    """Which targets are neighbours, forward and backward, those behind one another in turn.

    Parameters
    ----------
    targets : sequence of float
        [-]

    Returns
    -------
    array, shape (shifts, 2)

    Examples
    --------
    >>> neighbours([1.0, -2.0, 3.0, 2.0, -3.0]).tolist()
    [[2, 3], [3, 0], [4, 1]]
    """
    found = []
    for sign in (1, -1):
        own = [number for number, target in enumerate(targets) if target * sign > 0]
        own.sort(key=lambda number: -abs(targets[number]))
        found += [*pairwise(own)]
    return np.array(found, np.int64).reshape(-1, 2)


@compiled
def shifts_singly(table: Combinations, shifts: Integers, room: SetRoom) -> bool:
    """Whether combinations of the chosen elements can follow one another so.

    Parameters
    ----------
    table : Combinations
    shifts : array, shape (shifts, 2)
        See `neighbours`; where there are none, so it is.
    room : SetRoom
        `targets` tells what the combinations reach; a target goes from those that no chain
        leads to.
    """
    for shift in range(len(shifts)):
        before, after = shifts[shift]
        is_open = False
        for one in range(len(table.places)):
            if (room.targets[one] >> after) & 1:
                is_next = False
                for other in range(len(table.places)):
                    if (room.targets[other] >> before) & 1 and _exchanged(table, one, other) <= 1:
                        is_next = True
                        break
                if not is_next:
                    room.targets[one] ^= 1 << after
                is_open |= is_next
        if not is_open:
            return False
    return True


@compiled
def _exchanged(table: Combinations, one: int, other: int) -> int:
    """So many elements of a combination of places are not in another."""
    count = 0
    for place in table.places[one]:
        count += 1
        for there in table.places[other]:
            if there == place:
                count -= 1
    return count
