"""Choice of the next shift elements to join a partial element set, until it reaches all targets.

The search branches on the missing target with the fewest combinations (elements engaged in a gear),
and adds one of these. A combination is only added if the set contains no earlier combination of the
list, so that no set is found twice. The last element is found by bit operations for all targets at
once.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Integers
from vstatics.synthesis.boxes.search.engaged import Combinations, integers
from vstatics.synthesis.boxes.search.matching import MatchRoom, match_room
from vstatics.synthesis.compiled import compiled_part, fill, shared

ONE = -1
"""Branch that adds a single element: all targets are reached, or only one element can still be
added.
"""
NO_END = 2**62
"""Limit of the number of attempts that is never reached."""


@shared
class SetRoom(NamedTuple):
    """Work arrays of the search for element sets. The depth is the number of additions.

    Sets of elements or targets given "as bits" are bit masks.
    """

    lists: Integers
    """Shift elements of the combinations that reach each target, as bits, (targets, combinations).
    """
    lengths: Integers
    """Number of combinations that reach each target, shape (targets,)."""
    rows: Integers
    """Elements that complete a rest (a combination less an element) to a combination that reaches a
    target, as bits, shape (rests, targets).
    """
    often: Integers
    """Number of combinations with each ratio, shape (ratios,)."""
    seldom: Integers
    """Elements that complete a rest (a combination less an element) to a combination with a ratio
    other than the commonest, as bits, shape (rests,).
    """
    levels: Integers
    """Row n: elements that add at least n ratios other than the commonest, as bits."""
    able: Integers
    """Elements that complete a combination for each target with the chosen elements, as bits, shape
    (targets,).
    """
    sets: Integers
    """Shift elements of the partial set at each depth, as bits, shape (depths,)."""
    branches: Integers
    """Target for which a combination is added at each depth, or `ONE`, shape (depths,)."""
    tried: Integers
    """Number of combinations tried at each depth, shape (depths,).

    In the branch `ONE`, elements not yet tried, as bits.
    """
    lacking: Integers
    """Number of different ratios still missing, not counting the commonest ratio, shape (1,)."""
    chosen: Integers
    """Shift elements of the partial set, as ascending indices, shape (size,)."""
    held: Integers
    """Number of evaluated sets, and elements used in the gears of the last set, as bits, shape
    (2,).
    """
    commonest: Integers
    """Index of the ratio that most combinations have, shape (1,)."""
    ratios: Integers
    """Indices of the different ratios of the chosen elements, shape (combinations of a set,)."""
    reach: Integers
    """Bit mask of the targets that each of the `ratios` reaches, shape (combinations of a set,)."""
    targets: Integers
    """Bit mask of the targets that each combination in an element set reaches, shape (combinations
    of a set,).
    """
    seen: Integers
    """Number of the last evaluated set in which each ratio occurred, shape (ratios,)."""
    match: MatchRoom
    steps: Integers
    """Number of attempts to add elements, and the limit, shape (2,)."""
    listed: Integers
    """Shift elements of each complete element set, shape (largest number of sets, size)."""


def set_room(table: Combinations, targets: int, most: int) -> SetRoom:
    """Return work arrays for the search of at most `most` element sets."""
    size, of_set = len(table.starts) - 1, len(table.places)
    rests = int(table.rests.max()) + 1

    return SetRoom(
        lists=integers(targets, len(table.members)),
        lengths=integers(targets),
        rows=integers(rests, targets),
        often=integers(len(table.members)),
        seldom=integers(rests),
        levels=integers(targets + 1),
        able=integers(targets),
        sets=integers(size + 1),
        branches=integers(size + 1),
        tried=integers(size + 1),
        lacking=integers(1),
        chosen=integers(size),
        held=integers(2),
        commonest=integers(1),
        ratios=integers(of_set),
        reach=integers(of_set),
        targets=integers(of_set),
        seen=integers(len(table.members)),
        match=match_room(targets),
        steps=np.array([0, NO_END]),
        listed=integers(most, size),
    )


@compiled_part
def choose(table: Combinations, room: SetRoom, depth: int, held: int, there: int) -> None:
    """Choose the branch at a depth: a target whose combinations are added, or single elements.

    Parameters
    ----------
    table : Combinations
    room : SetRoom
        Work arrays; `chosen` contains the elements of the partial set.
    depth : int
    held : int
        Targets that the elements of the partial set reach, as a bit mask.
    there : int
        All possible shift elements, as a bit mask.
    """
    left = room_left(room, depth)
    members = len(room.chosen) - left
    room.tried[depth] = 0
    room.branches[depth] = ONE
    if left == 1 or held == (1 << len(room.lengths)) - 1:
        room.tried[depth] = there & ~room.sets[depth]
    if left == 1:
        room.tried[depth] = _last_elements(table, room, members, room.tried[depth], held)
    elif room.tried[depth] == 0:
        least = len(table.masks) + 1
        for target in range(len(room.lengths)):
            if (held >> target) & 1 == 0:
                count = _ways_to_join(room, room.sets[depth], target, left, least)
                if count < least:
                    least = count
                    room.branches[depth] = target


@compiled_part
def _ways_to_join(room: SetRoom, before: int, target: int, left: int, most: int) -> int:
    count = 0
    for number in range(room.lengths[target]):
        missing = room.lists[target, number] & ~before
        for _ in range(left):
            missing &= missing - 1
        count += missing == 0
        if count == most:
            return most
    return count


@compiled_part
def _last_elements(table: Combinations, room: SetRoom, members: int, there: int, held: int) -> int:
    """Return the elements that complete a set, with all targets and enough ratios, as a bit mask.

    The number of ratios is checked because many combinations share the ratio 1 (locked up).
    """
    engaged, targets, lacking = table.places.shape[1], len(room.lengths), room.lacking[0]
    fill(room.able, 0)
    fill(room.levels, 0)
    room.levels[0] = there
    for subset in range(table.starts[members], table.starts[members + 1]):
        # The new element is the last of these combinations, so only the others are looked up.
        others = 0
        for place in range(engaged - 1):
            others += table.ranks[room.chosen[table.places[subset, place]], place + 1]
        for target in range(targets):
            room.able[target] |= room.rows[others, target]
        for level in range(lacking, 0, -1):
            room.levels[level] |= room.levels[level - 1] & room.seldom[others]
    there = room.levels[max(lacking, 0)]
    for target in range(targets):
        if (held >> target) & 1 == 0:
            there &= room.able[target]
    return there


@compiled_part
def join(room: SetRoom, depth: int) -> bool:
    """Extend the partial set at a depth by the next candidate; return False without a candidate."""
    before, target = room.sets[depth], room.branches[depth]
    if target == ONE:
        while room.tried[depth]:
            joined = before | (room.tried[depth] & -room.tried[depth])
            room.tried[depth] &= room.tried[depth] - 1
            if _is_first(room, depth, joined):
                room.sets[depth + 1] = joined
                return True
        return False
    left = room_left(room, depth)
    while room.tried[depth] < room.lengths[target]:
        new = room.lists[target, room.tried[depth]] & ~before
        room.tried[depth] += 1
        missing = new
        for _ in range(left):
            missing &= missing - 1
        if missing == 0 and _is_first(room, depth, before | new):
            room.sets[depth + 1] = before | new
            return True
    return False


@compiled_part
def _is_first(room: SetRoom, depth: int, joined: int) -> bool:
    """Return whether the set contains no candidate that was tried earlier, at any depth."""
    for place in range(depth + 1):
        target = room.branches[place]
        if target != ONE:
            for number in range(room.tried[place] - 1):
                if room.lists[target, number] & ~joined == 0:
                    return False
        elif place < depth and joined & ~room.sets[place + 1] & ~room.tried[place]:
            return False
    return True


@compiled_part
def room_left(room: SetRoom, depth: int) -> int:
    """Return the number of elements that can still be added to the partial set."""
    left = len(room.chosen)
    bits = room.sets[depth]
    while bits:
        bits &= bits - 1
        left -= 1
    return left
