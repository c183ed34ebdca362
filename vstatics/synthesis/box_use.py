"""Which combinations of elements give the ratios chosen, so that no element is left over."""

from __future__ import annotations

from vstatics.numerics.arrays import Integers
from vstatics.numerics.compiled import compiled
from vstatics.synthesis.box_combinations import Combinations


@compiled
def all_used(
    table: Combinations, ratio_of: Integers, chosen: Integers, came: Integers, gears: Integers
) -> bool:
    """Whether gears of the chosen ratios can be such that all elements are used.

    Target by target it is noted which elements may be in use, as bits, and how.

    Parameters
    ----------
    table : Combinations
    ratio_of : array, shape (combinations of a set,)
        The ratio of each, below 0 of none.
    chosen : array, shape (targets,)
        The ratio of each target.
    came : array, shape (targets + 1, 2**size)
        Scratch.
    gears : array, shape (targets,)
        Takes the combination of each target.
    """
    every, count, subsets = came.shape[1] - 1, len(chosen), len(ratio_of)
    came[:] = -1
    came[0, 0] = 0
    for target in range(count):
        for state in range(every + 1):
            if came[target, state] >= 0:
                for subset in range(subsets):
                    if ratio_of[subset] == chosen[target]:
                        after = state
                        for place in range(table.places.shape[1]):
                            after |= 1 << table.places[subset, place]
                        if came[target + 1, after] < 0:
                            came[target + 1, after] = state * subsets + subset
    if came[count, every] < 0:
        return False
    state = every
    for target in range(count - 1, -1, -1):
        step = came[target + 1, state]
        gears[target] = step % subsets
        state = step // subsets
    return True
