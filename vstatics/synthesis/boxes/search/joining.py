"""What joins a set of shift elements next, where it is to have gears for some targets.

A combination of one target joins it, of that with the least choice. Of the combinations that
a set has for a target the first of the list has joined it, so none comes twice. The last
element is told by bits, for all targets at once.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Integers
from vstatics.core.numerics.compiled import compiled
from vstatics.synthesis.boxes.search.engaged import Combinations
from vstatics.synthesis.boxes.search.matching import MatchRoom, match_room

ONE = -1
"""All targets are reached, or there is room for one element only."""
NO_END = 2**62
"""A number that no count comes to."""


class SetRoom(NamedTuple):
    """Room for the search of sets; depths are of elements and combinations that joined."""

    lists: Integers
    """Combinations that reach each target, as bits, shape (targets, combinations)."""
    lengths: Integers
    """How many there are, shape (targets,)."""
    rows: Integers
    """With which others all but one of those engaged reach a target, as bits, shape (rests,
    targets)."""
    often: Integers
    """So many combinations have each ratio, shape (ratios,)."""
    seldom: Integers
    """With which others all but one of those engaged have another ratio than the commonest, as
    bits, shape (rests,)."""
    levels: Integers
    """Elements with which those chosen have none such ratio, one and so on, as bits, shape
    (targets + 1,)."""
    able: Integers
    """Elements with which those chosen reach each target, as bits, shape (targets,)."""
    sets: Integers
    """The elements so far, as bits, shape (depths,)."""
    branches: Integers
    """Which target's combination joins at a depth, `ONE` for an element, shape (depths,)."""
    tried: Integers
    """So many combinations have been tried, or the elements that have not, shape (depths,)."""
    lacking: Integers
    """So many ratios the elements chosen need beside their own and the commonest, shape (1,)."""
    chosen: Integers
    """The elements as numbers, ascending, shape (size,)."""
    held: Integers
    """How many sets had their ratios found; elements of the last that have one, as bits."""
    commonest: Integers
    """The ratio that most combinations have, shape (1,)."""
    ratios: Integers
    """Different ratios of theirs, shape (combinations of a set,)."""
    reach: Integers
    """Targets of these, as bits, shape (combinations of a set,)."""
    targets: Integers
    """Targets that the combinations of a set reach, as bits, shape (combinations of a set,)."""
    seen: Integers
    """The search in which a ratio was met last, shape (ratios,)."""
    match: MatchRoom
    steps: Integers
    """So often something joined or did not, and so often it may; shape (2,)."""
    found: Integers
    """Sets that were found, shape (most, size)."""


def set_room(table: Combinations, targets: int, most: int) -> SetRoom:
    """Room for so many sets of a table."""
    size, of_set = len(table.starts) - 1, len(table.places)
    rests = int(table.rests.max()) + 1

    def zeros(*shape: int) -> Integers:
        return np.zeros(shape, np.int64)

    return SetRoom(
        lists=zeros(targets, len(table.members)),
        lengths=zeros(targets),
        rows=zeros(rests, targets),
        often=zeros(len(table.members)),
        seldom=zeros(rests),
        levels=zeros(targets + 1),
        able=zeros(targets),
        sets=zeros(size + 1),
        branches=zeros(size + 1),
        tried=zeros(size + 1),
        lacking=zeros(1),
        chosen=zeros(size),
        held=zeros(2),
        commonest=zeros(1),
        ratios=zeros(of_set),
        reach=zeros(of_set),
        targets=zeros(of_set),
        seen=zeros(len(table.members)),
        match=match_room(targets),
        steps=np.array([0, NO_END]),
        found=zeros(most, size),
    )


@compiled
def choose(table: Combinations, room: SetRoom, depth: int, held: int, there: int) -> None:
    """Choose what joins a set.

    Parameters
    ----------
    table : Combinations
    room : SetRoom
        `chosen` has the elements.
    depth : int
    held : int
        Targets that they reach, as bits.
    there : int
        All elements that there are, as bits.
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


@compiled
def _ways_to_join(room: SetRoom, before: int, target: int, left: int, most: int) -> int:
    """So many combinations of a target can join a set; no more than `most` are counted."""
    count = 0
    for number in range(room.lengths[target]):
        rest = room.lists[target, number] & ~before
        for _ in range(left):
            rest &= rest - 1
        count += rest == 0
        if count == most:
            return most
    return count


@compiled
def _last_elements(table: Combinations, room: SetRoom, members: int, there: int, held: int) -> int:
    """The elements that reach all open targets with those chosen, and have ratios enough, as bits.

    Most combinations lock the gearbox: without their one ratio there are seldom enough.
    """
    engaged, targets, lacking = table.places.shape[1], len(room.lengths), room.lacking[0]
    room.able[:] = 0
    room.levels[:] = 0
    room.levels[0] = there
    for subset in range(table.starts[members], table.starts[members + 1]):
        # of the set with one more, whose place is the last of each of these combinations
        rest = 0
        for place in range(engaged - 1):
            rest += table.ranks[room.chosen[table.places[subset, place]], place + 1]
        for target in range(targets):
            room.able[target] |= room.rows[rest, target]
        for level in range(lacking, 0, -1):
            room.levels[level] |= room.levels[level - 1] & room.seldom[rest]
    there = room.levels[max(lacking, 0)]
    for target in range(targets):
        if (held >> target) & 1 == 0:
            there &= room.able[target]
    return there


@compiled
def join(room: SetRoom, depth: int) -> bool:
    """The next set that is one of a depth with what joins it there; whether there is one."""
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
        rest = new
        for _ in range(left):
            rest &= rest - 1
        if rest == 0 and _is_first(room, depth, before | new):
            room.sets[depth + 1] = before | new
            return True
    return False


@compiled
def _is_first(room: SetRoom, depth: int, joined: int) -> bool:
    """Whether a set has nothing that came before what joined it at any depth."""
    for place in range(depth + 1):
        target = room.branches[place]
        if target != ONE:
            for number in range(room.tried[place] - 1):
                if room.lists[target, number] & ~joined == 0:
                    return False
        elif place < depth and joined & ~room.sets[place + 1] & ~room.tried[place]:
            return False
    return True


@compiled
def room_left(room: SetRoom, depth: int) -> int:
    """So many elements a set may still have."""
    left = len(room.chosen)
    rest = room.sets[depth]
    while rest:
        rest &= rest - 1
        left -= 1
    return left
