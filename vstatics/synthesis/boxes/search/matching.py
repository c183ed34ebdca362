"""Whether each target can have a ratio of its own: a matching in a bipartite graph."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Integers
from vstatics.core.numerics.compiled import compiled


class MatchRoom(NamedTuple):
    """Room for matchings; each array has a number for every target."""

    chosen: Integers
    """Its ratio."""
    came_from: Integers
    """The target before it on a way."""
    line: Integers
    """Targets still to go on from."""
    after: Integers
    """Targets from which a ratio can come when others move on, as bits."""


def match_room(targets: int) -> MatchRoom:
    """Room for so many targets."""
    return MatchRoom(*np.zeros((4, targets), np.int64))


@compiled
def matched(reach: Integers, count: int, room: MatchRoom) -> bool:
    """Whether each target can have a ratio of its own; `chosen` takes one for each.

    Parameters
    ----------
    reach : array, shape (ratios,)
        Targets that each ratio reaches, as bits.
    count : int
        So many ratios come first.
    room : MatchRoom

    Examples
    --------
    >>> room = match_room(2)
    >>> bool(matched(np.array([1, 3]), 2, room)), room.chosen.tolist()
    (True, [0, 1])
    >>> bool(matched(np.array([1, 1]), 2, room))
    False
    """
    room.chosen[:] = -1
    spare = count - len(room.chosen)
    for ratio in range(count):
        if spare < 0:
            return False
        spare -= not _placed(reach, ratio, room)
    return spare >= 0


@compiled
def _placed(reach: Integers, ratio: int, room: MatchRoom) -> bool:
    """Give a ratio a target, moving others along a shortest way; False if none is free."""
    chosen, came_from, line = room.chosen, room.came_from, room.line
    seen = reach[ratio]
    first = last = 0
    for target in range(len(chosen)):
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
        for other in range(len(chosen)):
            if (new >> other) & 1:
                came_from[other] = target
                line[last] = other
                last += 1
    return False


@compiled
def is_assigned(reach: Integers, count: int, room: MatchRoom) -> bool:
    """Take from each ratio the targets that it can't have while each has one of its own.

    An edge is in some matching where the target that loses its ratio gets another one, and so on,
    up to a free ratio or in a ring (Regin's filter of all-different).

    Parameters
    ----------
    reach, count, room
        Of `matched`.

    Returns
    -------
    bool
        Whether each target can have a ratio of its own.

    Examples
    --------
    The first can only have target 0, so the others have not:

    >>> reach = np.array([1, 3, 7])
    >>> bool(is_assigned(reach, 3, match_room(3))), reach.tolist()
    (True, [1, 2, 4])
    >>> reach = np.array([1, 3, 7, 7])
    >>> bool(is_assigned(reach, 4, match_room(3))), reach.tolist()
    (True, [1, 3, 7, 7])
    """
    if not matched(reach, count, room):
        return False
    targets, after = len(room.chosen), room.after
    after[:] = 0
    free = _free(reach, count, room)
    for target in range(targets):
        can_have = reach[room.chosen[target]]
        for other in range(targets):
            after[other] |= ((can_have >> other) & 1) << target
    for between in range(targets):
        for target in range(targets):
            if (after[target] >> between) & 1:
                after[target] |= after[between]
    for target in range(targets):
        if (after[target] | 1 << target) & free == 0:
            reach[room.chosen[target]] &= after[target]
    return True


@compiled
def _free(reach: Integers, count: int, room: MatchRoom) -> int:
    """The targets that some ratio without a target can have, as bits."""
    found = 0
    for ratio in range(count):
        is_free = True
        for one in room.chosen:
            is_free &= one != ratio
        if is_free:
            found |= reach[ratio]
    return found
