"""Matching of targets and gear ratios in a bipartite graph, one ratio for each target."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Integers
from vstatics.synthesis.compiled import compiled_part, fill, shared


@shared
class MatchRoom(NamedTuple):
    """Work arrays for matchings of targets and gear ratios, each of shape (targets,)."""

    chosen: Integers
    """Index of the gear ratio that is assigned to each target."""
    came_from: Integers
    """Previous target on an augmenting path."""
    line: Integers
    """Queue of targets still to be explored."""
    after: Integers
    """Targets that can pass on their ratio to this target along a path, as bits."""


def match_room(targets: int) -> MatchRoom:
    """Return work arrays for a number of targets."""
    return MatchRoom(*np.zeros((4, targets), np.int64))


@compiled_part
def matched(reach: Integers, count: int, room: MatchRoom) -> bool:
    """Return whether each target can have a separate gear ratio; store a matching in `chosen`.

    Parameters
    ----------
    reach : array, shape (ratios,)
        Targets that each gear ratio reaches, as bits.
    count : int
        Number of gear ratios to use, from the start of `reach`.
    room : MatchRoom

    Examples
    --------
    >>> room = match_room(2)
    >>> bool(matched(np.array([1, 3]), 2, room)), room.chosen.tolist()
    (True, [0, 1])
    >>> bool(matched(np.array([1, 1]), 2, room))
    False
    """
    fill(room.chosen, -1)
    spare = count - len(room.chosen)
    for ratio in range(count):
        if spare < 0:
            return False
        spare -= not _placed(reach, ratio, room)
    return spare >= 0


@compiled_part
def _placed(reach: Integers, ratio: int, room: MatchRoom) -> bool:
    """Assign a target to a gear ratio along a shortest augmenting path, if possible."""
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


@compiled_part
def is_assigned(reach: Integers, count: int, room: MatchRoom) -> bool:
    """Remove from each gear ratio the targets that no complete matching assigns to it.

    An assignment is in some complete matching if the target that loses its ratio can take another
    ratio, and so on, up to a free ratio or around a cycle. This is Regin's filter for all-different
    (AAAI 1994).

    Parameters
    ----------
    reach, count, room
        As for `matched`.

    Returns
    -------
    bool
        Whether each target can have its own gear ratio.

    Examples
    --------
    The first ratio can only meet target 0, which is therefore removed from the other ratios:

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
    fill(after, 0)
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


@compiled_part
def _free(reach: Integers, count: int, room: MatchRoom) -> int:
    """Return the targets that some unassigned gear ratio can meet, as bits."""
    targets = 0
    for ratio in range(count):
        is_free = True
        for holder in room.chosen:
            is_free &= holder != ratio
        if is_free:
            targets |= reach[ratio]
    return targets
