"""Search for the element sets (shift elements of a gearbox) that can reach all targets.

A combination (shift elements engaged in a gear) is usable if its ratio reaches a target (a wanted
ratio). The search branches on the target with the fewest combinations: an element set must contain
one of them. If the set still lacks a gear for another target, a combination for that target is
added, as long as the number of elements permits.
"""

from __future__ import annotations

from typing import NamedTuple

from vstatics.core.numerics.arrays import Integers
from vstatics.synthesis.boxes.box import SHAFT_ELEMENTS
from vstatics.synthesis.boxes.search.engaged import Combinations, number_of
from vstatics.synthesis.boxes.search.joining import NO_END, ONE, SetRoom, choose, join
from vstatics.synthesis.boxes.search.matching import matched
from vstatics.synthesis.boxes.search.shifts import shifts_singly
from vstatics.synthesis.compiled import compiled, compiled_part, fill, put, shared


@shared
class PortGears(NamedTuple):
    """Gears of a scheme with a given input and output."""

    input: int
    output: int
    elements: int
    """Possible shift elements, as bits."""
    ratio_of: Integers
    """Index of the ratio of each combination, shape (combinations,); negative without a ratio."""
    reach: Integers
    """Targets that each ratio reaches, as bits, shape (combinations,); 0 after the last ratio."""
    useful: Integers
    """Indices of the combinations that have a ratio, padded with -1, shape (combinations,)."""
    brakes: int
    """Permitted numbers of brakes in an element set, as bits."""
    shifts: Integers
    """Pairs of targets that must differ by a single shift, shape (shifts, 2)."""
    loaded: Integers
    """Shift elements that count as used in each combination, as bits: all, or only elements with
    torque, shape (combinations,).
    """
    shafts: Integers
    """Shift elements at each shaft that is neither input, output nor in a gear set, as bits,
    (shafts,).
    """
    retained: int
    """Shift elements of an existing gearbox, some of which must be retained, as bits."""
    least_kept: int
    """Smallest number of the elements in `retained` in an element set."""


@compiled_part
def begun(table: Combinations, port: PortGears, room: SetRoom) -> bool:
    """List the usable combinations and choose the first branch; return False if no set exists."""
    if not _list_gears(table, port, room):
        return False
    room.sets[0] = 0
    fill(room.seen, 0)
    room.lacking[0] = len(room.lengths) - 1
    choose(table, room, 0, 0, port.elements)
    return True


@compiled
def some_sets(table: Combinations, port: PortGears, room: SetRoom, most: int) -> tuple[int, float]:
    """List the element sets whose combinations can reach all targets, or a sample of the sets.

    The sample consists of the element sets that contain one of a sample of the first combinations.

    Parameters
    ----------
    table : Combinations
    port : PortGears
        Gears with the targets that their ratios reach.
    room : SetRoom
        Work arrays prepared by `begun`; `listed` receives the sets, `steps` limits the attempts.
    most : int
        Approximate number of first combinations in the sample, evenly spaced; all of them if there
        are fewer than twice as many. With `NO_END` all sets are listed.

    Returns
    -------
    int, float
        Number of sets, or -1 if `listed` is too small; fraction of the first combinations that the
        sample contains.
    """
    if room.branches[0] == ONE or most == NO_END:
        return sets_after(table, port, room, 0, NO_END), 1.0
    there = room.lengths[room.branches[0]]
    step = max(there // most, 1)
    count = tried = 0
    for first in range(step // 2, there, step):
        room.tried[0] = first
        count = sets_after(table, port, room, count, first + 1)
        tried += 1
        if count < 0 or room.steps[0] >= room.steps[1]:
            break
    return count, tried / there


@compiled_part
def sets_after(table: Combinations, port: PortGears, room: SetRoom, count: int, last: int) -> int:
    """List further element sets that begin with combinations up to `last`; return the total number.

    `count` sets are already listed. The list is incomplete if the permitted number of steps is
    exhausted. The result is -1 if `listed` is too small.
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
    _clear(room)
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
def _clear(room: SetRoom) -> None:
    fill(room.lengths, 0)
    fill(room.seldom, 0)
    for row in room.rows:
        fill(row, 0)


@compiled_part
def _find_commonest(port: PortGears, room: SetRoom) -> None:
    fill(room.often, 0)
    for which in port.useful:
        if which < 0:
            break
        room.often[port.ratio_of[which]] += 1
    room.commonest[0] = 0
    for ratio in range(len(room.often)):
        if room.often[ratio] > room.often[room.commonest[0]]:
            room.commonest[0] = ratio


@compiled_part
def _note_last(table: Combinations, targets: int, which: int, room: SetRoom) -> None:
    """Record in `rows` each element of a combination, under the index of the other elements."""
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
    """Return whether a partial element set can still satisfy the limits on shift elements.

    The limits are the number of brakes, elements at each shaft, and retained elements.
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
    """Return the targets that combinations of the chosen elements reach, as bits.

    `lacking` receives the number of different ratios that are still missing, not counting the
    commonest ratio.
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
    """Find and count the different ratios that combinations of the chosen elements have.

    `held` receives the elements that at least one of the combinations uses.
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
