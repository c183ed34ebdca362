"""Check, before any fit, that successive gears can differ by exchange of one shift element."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from vstatics.core.numerics.arrays import Integers
from vstatics.synthesis.boxes.search.engaged import Combinations
from vstatics.synthesis.boxes.search.joining import SetRoom
from vstatics.synthesis.compiled import compiled_part


def neighbours(targets: Sequence[float]) -> Integers:
    """Return pairs of neighbouring targets, separately for forward and reverse gears.

    Parameters
    ----------
    targets : sequence of float
        Wanted ratios. [-]

    Returns
    -------
    array, shape (shifts, 2)
        Indices of pairs of targets, from the largest ratio to the smallest.

    Examples
    --------
    >>> neighbours([1.0, -2.0, 3.0, 2.0, -3.0]).tolist()
    [[2, 3], [3, 0], [4, 1]]
    """
    pairs = []
    for sign in (1, -1):
        numbers = [number for number, target in enumerate(targets) if target * sign > 0]
        numbers.sort(key=lambda number: -abs(targets[number]))
        pairs += [*pairwise(numbers)]
    return np.array(pairs, np.int64).reshape(-1, 2)


@compiled_part
def shifts_singly(table: Combinations, shifts: Integers, room: SetRoom) -> bool:
    """Check that combinations of the chosen elements permit single shifts between targets.

    Parameters
    ----------
    table : Combinations
    shifts : array, shape (shifts, 2)
        Pairs of targets from `neighbours`; without any pair the check succeeds.
    room : SetRoom
        Work arrays; `targets` contains the targets of each combination. A target is removed from a
        combination if no chain of single shifts leads to it.
    """
    for shift in range(len(shifts)):
        before, after = shifts[shift]
        is_open = False
        for combination in range(len(table.places)):
            if (room.targets[combination] >> after) & 1:
                is_next = False
                for other in range(len(table.places)):
                    if (room.targets[other] >> before) & 1 and _exchanged(
                        table, combination, other
                    ) <= 1:
                        is_next = True
                        break
                if not is_next:
                    room.targets[combination] ^= 1 << after
                is_open |= is_next
        if not is_open:
            return False
    return True


@compiled_part
def _exchanged(table: Combinations, combination: int, other: int) -> int:
    count = 0
    for place in table.places[combination]:
        count += 1
        for other_place in table.places[other]:
            if other_place == place:
                count -= 1
    return count
