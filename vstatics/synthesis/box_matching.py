"""Which wanted ratio is whose: a matching of targets and ratios that gears have."""

from __future__ import annotations

import numpy as np

from vstatics.numerics.arrays import Integers
from vstatics.numerics.compiled import compiled


@compiled
def matched(reach: Integers, count: int, targets: int, chosen: Integers) -> bool:
    """Whether each target can have a ratio of its own; `chosen` takes one for each.

    >>> chosen = np.zeros(2, np.int64)
    >>> bool(matched(np.array([1, 3]), 2, 2, chosen)), chosen.tolist()
    (True, [0, 1])
    >>> bool(matched(np.array([1, 1]), 2, 2, chosen))
    False
    """
    chosen[:targets] = -1
    for ratio in range(count):
        _placed(reach, ratio, targets, chosen)
    missing = 0
    for target in range(targets):
        missing += chosen[target] < 0
    return missing == 0


@compiled
def _placed(reach: Integers, ratio: int, targets: int, chosen: Integers) -> bool:
    """Give a ratio a target, moving others along a shortest way; False if none is free."""
    came_from = np.empty(targets, np.int64)
    line = np.empty(targets, np.int64)
    seen = reach[ratio]
    first = last = 0
    for target in range(targets):
        if (seen >> target) & 1:
            came_from[target] = -1
            line[last] = target
            last += 1
    while first < last:
        target = line[first]
        first += 1
        holder = chosen[target]
        if holder < 0:
            while target >= 0:
                before = came_from[target]
                chosen[target] = ratio if before < 0 else chosen[before]
                target = before
            return True
        new = reach[holder] & ~seen
        seen |= new
        for other in range(targets):
            if (new >> other) & 1:
                came_from[other] = target
                line[last] = other
                last += 1
    return False
