"""Sample the gearboxes of a choice of ports, to estimate their number and the time; compiled."""

from __future__ import annotations

from typing import NamedTuple

from vstatics.core.numerics.compiled import compiled
from vstatics.synthesis.boxes.search.elements import PortGears, sets_after
from vstatics.synthesis.boxes.search.engaged import Combinations
from vstatics.synthesis.boxes.search.joining import NO_END, ONE, SetRoom
from vstatics.synthesis.boxes.search.kernel import Room, gears_besides, is_box
from vstatics.synthesis.boxes.search.set_ratios import Asked


class Some(NamedTuple):
    """Size of a sample."""

    there: int
    """Number of sets from which the sample is drawn."""
    most: int
    """Approximate size of the sample; all sets if there are fewer than twice as many."""


@compiled
def some_sets(table: Combinations, port: PortGears, room: SetRoom, most: int) -> tuple[int, float]:
    """List the sets that contain a sample of the first combinations.

    Parameters
    ----------
    table : Combinations
    port : PortGears
        Gears with their ratios.
    room : SetRoom
        Prepared by `begun`; `steps` limits the number of attempts.
    most : int
        Approximate number of combinations, evenly spaced; all combinations if there are fewer
        than twice as many.

    Returns
    -------
    int, float
        Number of sets; share of the combinations in the sample.
    """
    if room.branches[0] == ONE:
        count = sets_after(table, port, room, 0, NO_END)
        return len(room.listed) if count < 0 else count, 1.0
    there = room.lengths[room.branches[0]]
    step = max(there // most, 1)
    count = tried = 0
    for first in range(step // 2, there, step):
        room.tried[0] = first
        more = sets_after(table, port, room, count, first + 1)
        tried += 1
        if more < 0:
            return len(room.listed), tried / there
        count = more
        if room.steps[0] >= room.steps[1]:
            break
    return count, tried / there


@compiled
def some_boxes(
    table: Combinations, port: PortGears, asked: Asked, room: Room, some: Some
) -> tuple[int, int]:
    """Examine a sample of the listed sets, evenly spaced, within the limit of `steps`.

    Returns
    -------
    int, int
        Number of gearboxes; number of examined sets.
    """
    step = max(some.there // some.most, 1)
    boxes = tried = 0
    for number in range(step // 2, some.there, step):
        boxes += is_box(table, port, asked, room, room.sets.listed[number])
        tried += 1
        if room.cells.steps[0] >= room.cells.steps[1]:
            break
    return boxes, tried


@compiled
def some_sequences(
    table: Combinations, port: PortGears, asked: Asked, room: Room, some: Some
) -> tuple[int, int]:
    """Examine a sample of the listed sets for gears in addition to the targets."""
    step = max(some.there // some.most, 1)
    boxes = tried = 0
    for number in range(step // 2, some.there, step):
        length, _ = gears_besides(table, port, asked, room, room.sets.listed[number])
        boxes += length > 0
        tried += 1
        if room.sequences.steps[0] >= room.sequences.steps[1]:
            break
    return boxes, tried
