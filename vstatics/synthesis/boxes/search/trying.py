"""Some of the boxes of a choice of ports, compiled: for an idea of how many, and how long."""

from __future__ import annotations

from typing import NamedTuple

from vstatics.core.numerics.compiled import compiled
from vstatics.synthesis.boxes.search.elements import PortGears, sets_after
from vstatics.synthesis.boxes.search.engaged import Combinations
from vstatics.synthesis.boxes.search.joining import NO_END, ONE, SetRoom
from vstatics.synthesis.boxes.search.kernel import Room, gears_besides, is_box
from vstatics.synthesis.boxes.search.set_ratios import Asked


class Some(NamedTuple):
    """How much is tried of what there is."""

    there: int
    most: int
    """About so many; all if there are not twice as many."""


@compiled
def some_sets(table: Combinations, port: PortGears, room: SetRoom, most: int) -> tuple[int, float]:
    """List sets that have some of the combinations that come first.

    Parameters
    ----------
    table : Combinations
    port : PortGears
        With its ratios.
    room : SetRoom
        With what may join; it takes as many `steps` as there may be.
    most : int
        About so many combinations, at equal steps; all if there are not twice as many.

    Returns
    -------
    int, float
        How many sets; which share of the combinations these are.
    """
    if room.branches[0] == ONE:
        count = sets_after(table, port, room, 0, NO_END)
        return len(room.found) if count < 0 else count, 1.0
    there = room.lengths[room.branches[0]]
    step = max(there // most, 1)
    count = tried = 0
    for first in range(step // 2, there, step):
        room.tried[0] = first
        more = sets_after(table, port, room, count, first + 1)
        tried += 1
        if more < 0:
            return len(room.found), tried / there
        count = more
        if room.steps[0] >= room.steps[1]:
            break
    return count, tried / there


@compiled
def some_boxes(
    table: Combinations, port: PortGears, asked: Asked, room: Room, some: Some
) -> tuple[int, int]:
    """Look at some of the listed sets, at equal steps, as many `steps` as there may be.

    Returns
    -------
    int, int
        How many boxes; how many sets were looked at.
    """
    step = max(some.there // some.most, 1)
    found = tried = 0
    for number in range(step // 2, some.there, step):
        found += is_box(table, port, asked, room, room.sets.found[number])
        tried += 1
        if room.cells.steps[0] >= room.cells.steps[1]:
            break
    return found, tried


@compiled
def some_sequences(
    table: Combinations, port: PortGears, asked: Asked, room: Room, some: Some
) -> tuple[int, int]:
    """The same where gears besides the targets are wanted."""
    step = max(some.there // some.most, 1)
    found = tried = 0
    for number in range(step // 2, some.there, step):
        length, _ = gears_besides(table, port, asked, room, room.sets.found[number])
        found += length > 0
        tried += 1
        if room.sequences.steps[0] >= room.sequences.steps[1]:
            break
    return found, tried
