"""Sets of shift elements that may give a gear for every target, the rarest target first.

A combination of elements is usable if its ratio reaches a target. One of those that reach the
rarest target is in the set; where it has none for another target, one of these joins it, and so
on, as long as there is room.
"""

from __future__ import annotations

from typing import NamedTuple

from vstatics.core.numerics.arrays import Integers
from vstatics.core.numerics.compiled import compiled, put
from vstatics.synthesis.boxes.box import SHAFT_ELEMENTS
from vstatics.synthesis.boxes.search.engaged import Combinations, number_of
from vstatics.synthesis.boxes.search.joining import NO_END, ONE, SetRoom, choose, join
from vstatics.synthesis.boxes.search.matching import matched
from vstatics.synthesis.boxes.search.shifts import shifts_singly


class PortGears(NamedTuple):
    """What the gears of a scheme are with one choice of its ports."""

    input: int
    output: int
    elements: int
    """The elements that there are, as bits."""
    ratio_of: Integers
    """The number of the ratio of each combination, below 0 of none, shape (combinations,)."""
    reach: Integers
    """Targets that each ratio reaches, as bits, shape (combinations,); 0 behind the last."""
    useful: Integers
    """Combinations that have one come first, shape (combinations,)."""
    brakes: int
    """How many brakes a set may have, as bits."""
    shifts: Integers
    """Targets that are neighbours, between which one element is to change, shape (shifts, 2)."""
    loaded: Integers
    """The elements of each combination that are in use in its gear, as bits: all of them, or
    those that carry torque; shape (combinations,)."""
    shafts: Integers
    """The elements at each shaft that is no port and of no set, as bits, shape (shafts,)."""
    kept: int
    """Elements of which a set is to have some, as bits."""
    least_kept: int
    """So many of them."""


@compiled
def element_sets(table: Combinations, port: PortGears, room: SetRoom) -> int:
    """All sets of elements whose combinations may give every target; how many.

    Parameters
    ----------
    table : Combinations
    port : PortGears
    room : SetRoom
        `found` takes the sets.

    Returns
    -------
    int
        How many there are; -1 if there is no room for them.
    """
    return sets_after(table, port, room, 0, NO_END) if begun(table, port, room) else 0


@compiled
def begun(table: Combinations, port: PortGears, room: SetRoom) -> bool:
    """List what may join sets, and choose what comes first; whether there may be any."""
    if not _list_gears(table, port, room):
        return False
    room.sets[0] = 0
    room.seen[:] = 0
    room.lacking[0] = len(room.lengths) - 1
    choose(table, room, 0, 0, port.elements)
    return True


@compiled
def sets_after(table: Combinations, port: PortGears, room: SetRoom, count: int, last: int) -> int:
    """More sets, after so many: with the combinations that come first before the `last` of them.

    Not all, where the room allows no more steps.
    """
    size, depth = len(room.chosen), 0
    while depth >= 0 and room.steps[0] < room.steps[1]:
        room.steps[0] += 1
        if not join(room, depth):
            depth -= 1
            continue
        if depth == 0 and room.branches[0] != ONE and room.tried[0] > last:
            break
        members = _find_members(room, depth + 1)
        if not _may_have(table, port, room, members):
            continue
        if members < size:
            depth += 1
            held = _held(table, port, room, members)
            choose(table, room, depth, held, port.elements)
            continue
        ratios = find_ratios(table, port, room)
        if (
            room.held[1] == room.sets[depth + 1]
            and matched(room.reach, ratios, room.match)
            and shifts_singly(table, port.shifts, room)
        ):
            if count == len(room.found):
                return -1
            put(room.chosen, room.found[count])
            count += 1
    return count


@compiled
def _list_gears(table: Combinations, port: PortGears, room: SetRoom) -> bool:
    """List the combinations that reach each target; whether all are reached."""
    every = (1 << len(room.lengths)) - 1
    for one in port.reach:
        every &= ~one
    if every:
        return False
    room.lengths[:] = 0
    room.rows[:] = 0
    room.seldom[:] = 0
    _find_commonest(port, room)
    for which in port.useful:
        if which < 0:
            break
        ratio = port.ratio_of[which]
        for target in range(len(room.lengths)):
            if (port.reach[ratio] >> target) & 1:
                room.lists[target, room.lengths[target]] = table.masks[which]
                room.lengths[target] += 1
        _note_last(table, port.reach[ratio], which, room)
        if ratio != room.commonest[0]:
            for place in range(table.members.shape[1]):
                room.seldom[table.rests[which, place]] |= 1 << table.members[which, place]
    is_empty = False
    for length in room.lengths:
        is_empty |= length == 0
    return not is_empty


@compiled
def _find_commonest(port: PortGears, room: SetRoom) -> None:
    """The ratio that most combinations have: as a rule that of the direct drive."""
    room.often[:] = 0
    for which in port.useful:
        if which < 0:
            break
        room.often[port.ratio_of[which]] += 1
    room.commonest[0] = room.often.argmax()


@compiled
def _note_last(table: Combinations, targets: int, which: int, room: SetRoom) -> None:
    """Note each element of a combination as the last one, with its others."""
    for place in range(table.members.shape[1]):
        bit, rest = 1 << table.members[which, place], table.rests[which, place]
        for target in range(len(room.lengths)):
            if (targets >> target) & 1:
                room.rows[rest, target] |= bit


@compiled
def _find_members(room: SetRoom, depth: int) -> int:
    """The elements of a set as numbers; how many."""
    rest = room.sets[depth]
    element = count = 0
    while rest:
        if rest & 1:
            room.chosen[count] = element
            count += 1
        rest >>= 1
        element += 1
    return count


@compiled
def _may_have(table: Combinations, port: PortGears, room: SetRoom, members: int) -> bool:
    """Whether so many chosen elements can be of a set with a number of brakes that is wanted.

    And whether the others are enough for the shafts, and for what is to be kept.
    """
    brakes = chosen = 0
    for place in range(members):
        brakes += table.ends[room.chosen[place], 1] < 0
        chosen |= 1 << room.chosen[place]
    others = len(room.chosen) - members
    if _count(port.kept & chosen) + others < port.least_kept:
        return False
    for shaft in port.shafts:
        if _count(shaft & chosen) + others < SHAFT_ELEMENTS:
            return False
    return bool((port.brakes >> brakes) & ((2 << others) - 1))


@compiled
def _count(bits: int) -> int:
    """How many bits there are."""
    count = 0
    while bits:
        bits &= bits - 1
        count += 1
    return count


@compiled
def _held(table: Combinations, port: PortGears, room: SetRoom, members: int) -> int:
    """The targets that so many chosen elements reach, as bits; how many ratios they lack is noted.

    The commonest is not counted among them.
    """
    held, lacking = 0, len(room.lengths) - 1
    room.held[0] += 1
    for subset in range(table.starts[members]):
        ratio = port.ratio_of[number_of(table, room.chosen, subset)]
        if ratio >= 0:
            held |= port.reach[ratio]
            if ratio != room.commonest[0] and room.seen[ratio] != room.held[0]:
                room.seen[ratio] = room.held[0]
                lacking -= 1
    room.lacking[0] = lacking
    return held & ((1 << len(room.lengths)) - 1)


@compiled
def find_ratios(table: Combinations, port: PortGears, room: SetRoom) -> int:
    """The different ratios of the chosen elements and what they reach; how many.

    `held` takes the elements that are in use with one of them.
    """
    count = used = 0
    room.held[0] += 1
    for subset in range(len(table.places)):
        which = number_of(table, room.chosen, subset)
        ratio = port.ratio_of[which]
        room.targets[subset] = 0
        if ratio >= 0:
            room.targets[subset] = port.reach[ratio]
            used |= port.loaded[which]
            if room.seen[ratio] != room.held[0]:
                room.seen[ratio] = room.held[0]
                room.ratios[count] = ratio
                room.reach[count] = port.reach[ratio]
                count += 1
    room.held[1] = used
    return count
