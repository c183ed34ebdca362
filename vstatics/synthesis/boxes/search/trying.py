"""Some of the boxes of a choice of ports, compiled: for an idea of how many, and how long."""

from __future__ import annotations

from typing import NamedTuple

from vstatics.numerics.compiled import compiled
from vstatics.synthesis.boxes.search.elements import PortGears, begun, sets_after
from vstatics.synthesis.boxes.search.engaged import Combinations, GearSpeeds
from vstatics.synthesis.boxes.search.joining import NO_END, ONE, SetRoom
from vstatics.synthesis.boxes.search.kernel import Room, find_gears, gears_besides, is_box
from vstatics.synthesis.boxes.search.set_ratios import Asked


class Trial(NamedTuple):
    """How much of a choice of ports is tried, in which room."""

    room: Room
    firsts: int
    """About so many of the combinations that come first in a set; all if there are not twice as
    many."""
    sets: int
    """Likewise of the sets that have one of these."""


@compiled
def some_boxes(
    table: Combinations, gears: GearSpeeds, port: PortGears, asked: Asked, trial: Trial
) -> tuple[int, float, float]:
    """Look at some sets of elements, as many `steps` as there may be.

    Parameters
    ----------
    table : Combinations
    gears : GearSpeeds
    port : PortGears
    asked : Asked
    trial : Trial
        What is tried is taken at equal steps.

    Returns
    -------
    int, float, float
        How many boxes; the share of combinations that came first; the share of sets with these
        that were looked at.
    """
    room = trial.room
    find_gears(table, gears, port, asked, room)
    count, share = _some_sets(table, port, room.sets, trial.firsts)
    step = max(count // trial.sets, 1)
    found = tried = 0
    for number in range(step // 2, count, step):
        found += is_box(table, port, asked, room, room.sets.found[number])
        tried += 1
        if room.cells.steps[0] >= room.cells.steps[1]:
            break
    return found, share, tried / count if count else 1.0


@compiled
def some_sequences(
    table: Combinations, gears: GearSpeeds, port: PortGears, asked: Asked, trial: Trial
) -> tuple[int, float, float]:
    """The same where gears besides the targets are wanted."""
    room = trial.room
    find_gears(table, gears, port, asked, room)
    count, share = _some_sets(table, port, room.sets, trial.firsts)
    step = max(count // trial.sets, 1)
    found = tried = 0
    for number in range(step // 2, count, step):
        length, _ = gears_besides(table, port, asked, room, room.sets.found[number])
        found += length > 0
        tried += 1
        if room.sequences.steps[0] >= room.sequences.steps[1]:
            break
    return found, share, tried / count if count else 1.0


@compiled
def _some_sets(table: Combinations, port: PortGears, room: SetRoom, most: int) -> tuple[int, float]:
    """Sets that have some of the combinations that come first; which share of these it is."""
    if not begun(table, port, room):
        return 0, 1.0
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
