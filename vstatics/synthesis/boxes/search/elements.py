"""Find the sets of shift elements that can provide a gear for every target.

A combination of elements is usable if its ratio reaches a target. The search branches on the
target with the fewest combinations: a set must contain one of them. If the set still lacks a gear
for another target, a combination for that target is added, as long as there is room.
"""

from __future__ import annotations

from typing import NamedTuple

from vstatics.core.numerics.arrays import Integers
from vstatics.core.numerics.compiled import compiled, compiled_part, put
from vstatics.synthesis.boxes.box import SHAFT_ELEMENTS
from vstatics.synthesis.boxes.search.engaged import Combinations, number_of
from vstatics.synthesis.boxes.search.joining import NO_END, ONE, SetRoom, choose, join
from vstatics.synthesis.boxes.search.matching import matched
from vstatics.synthesis.boxes.search.shifts import shifts_singly


class PortGears(NamedTuple):
    """Gears of a scheme for a choice of input and output."""

    input: int
    output: int
    elements: int
    """Available shift elements, as bits."""
    ratio_of: Integers
    """Index of the ratio of each combination, negative without a ratio, shape (combinations,)."""
    reach: Integers
    """Targets that each ratio reaches, as bits; 0 after the last; shape (combinations,)."""
    useful: Integers
    """Numbers of the combinations that have a ratio, filled up with -1, shape (combinations,)."""
    brakes: int
    """Allowed numbers of brakes in a set, as bits."""
    shifts: Integers
    """Pairs of neighbouring targets between which a single shift is required, shape (shifts, 2)."""
    loaded: Integers
    """Elements in use in each combination, as bits: all elements, or only elements with torque;
    shape (combinations,)."""
    shafts: Integers
    """Elements at each shaft that is neither a port nor part of a gear set, as bits, shape
    (shafts,)."""
    retained: int
    """Elements of the given box that a set must partly retain, as bits."""
    least_kept: int
    """Smallest number of retained elements."""


@compiled_part
def element_sets(table: Combinations, port: PortGears, room: SetRoom) -> int:
    """List all sets of shift elements whose combinations can provide every target.

    Parameters
    ----------
    table : Combinations
    port : PortGears
    room : SetRoom
        `listed` receives the sets.

    Returns
    -------
    int
        Number of sets, or -1 if there is not enough room for them.
    """
    return sets_after(table, port, room, 0, NO_END) if begun(table, port, room) else 0


@compiled
def begun(table: Combinations, port: PortGears, room: SetRoom) -> bool:
    """List the usable combinations and choose the first branch; return False if no set exists."""
    if not _list_gears(table, port, room):
        return False
    room.sets[0] = 0
    room.seen[:] = 0
    room.lacking[0] = len(room.lengths) - 1
    choose(table, room, 0, 0, port.elements)
    return True


@compiled_part
def sets_after(table: Combinations, port: PortGears, room: SetRoom, count: int, last: int) -> int:
    """List further sets, up to the combination number `last`; return the number of sets.

    The list is incomplete if the allowed number of steps is exhausted. `count` sets are already
    listed; -1 is returned if there is not enough room.
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
            choose(table, room, depth, _held(table, port, room, members), port.elements)
            continue
        ratios = find_ratios(table, port, room)
        if (
            room.held[1] == room.sets[depth + 1]
            and matched(room.reach, ratios, room.match)
            and shifts_singly(table, port.shifts, room)
        ):
            if count == len(room.listed):
                return -1
            put(room.chosen, room.listed[count])
            count += 1
    return count


@compiled_part
def _list_gears(table: Combinations, port: PortGears, room: SetRoom) -> bool:
    every = (1 << len(room.lengths)) - 1
    for targets in port.reach:
        every &= ~targets
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


@compiled_part
def _find_commonest(port: PortGears, room: SetRoom) -> None:
    room.often[:] = 0
    for which in port.useful:
        if which < 0:
            break
        room.often[port.ratio_of[which]] += 1
    room.commonest[0] = room.often.argmax()


@compiled_part
def _note_last(table: Combinations, targets: int, which: int, room: SetRoom) -> None:
    """Record each element of a combination as a possible last element of a set."""
    for place in range(table.members.shape[1]):
        bit, others = 1 << table.members[which, place], table.rests[which, place]
        for target in range(len(room.lengths)):
            if (targets >> target) & 1:
                room.rows[others, target] |= bit


@compiled_part
def _find_members(room: SetRoom, depth: int) -> int:
    bits = room.sets[depth]
    element = count = 0
    while bits:
        if bits & 1:
            room.chosen[count] = element
            count += 1
        bits >>= 1
        element += 1
    return count


@compiled_part
def _may_have(table: Combinations, port: PortGears, room: SetRoom, members: int) -> bool:
    """Return whether a partial set can still satisfy the limits on elements.

    The limits are on the number of brakes, on elements per shaft and on retained elements.
    """
    brakes = chosen = 0
    for place in range(members):
        brakes += table.ends[room.chosen[place], 1] < 0
        chosen |= 1 << room.chosen[place]
    others = len(room.chosen) - members
    if _count(port.retained & chosen) + others < port.least_kept:
        return False
    for shaft in port.shafts:
        if _count(shaft & chosen) + others < SHAFT_ELEMENTS:
            return False
    return bool((port.brakes >> brakes) & ((2 << others) - 1))


@compiled_part
def _count(bits: int) -> int:
    count = 0
    while bits:
        bits &= bits - 1
        count += 1
    return count


@compiled_part
def _held(table: Combinations, port: PortGears, room: SetRoom, members: int) -> int:
    """Return the targets that the chosen elements reach, as bits.

    `lacking` receives the number of ratios still missing, without the commonest ratio.
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


@compiled_part
def find_ratios(table: Combinations, port: PortGears, room: SetRoom) -> int:
    """Find the different ratios of the chosen elements; return the number of ratios.

    `held` receives the elements that at least one gear uses.
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
