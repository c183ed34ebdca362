"""Sets of shift elements that may give a gear for every target, and which target is whose.

A combination of elements is usable if its ratio reaches a target. All combinations of a set
are usable but for a few: there are no more of them than combinations less targets. So sets
grow element by element, and what may come next is told for all elements at once, by bits.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vstatics.numerics.arrays import Floats, Integers
from vstatics.numerics.compiled import compiled, put
from vstatics.synthesis.boxes.engaged import Combinations, GearSpeeds, number_of
from vstatics.synthesis.tolerances import SAME_BOX_RATIO


@compiled
def bits(value: int) -> int:
    """The number of bits that are set.

    >>> bits(0b1011)
    3
    """
    count = 0
    while value:
        value &= value - 1
        count += 1
    return count


class SetRoom(NamedTuple):
    """Room for the search of sets; each array has a row for every depth."""

    rows: Integers
    """With which others some elements together are usable, as bits, shape (rests,)."""
    missing: Integers
    """Elements that so many combinations lack or more, as bits, shape (depths, spare + 1)."""
    coming: Integers
    """Elements still to be tried, as bits, shape (depths,)."""
    gone: Integers
    """Combinations that are of no use, shape (depths,)."""
    counts: Integers
    """Different ratios so far, shape (depths,)."""
    ratios: Floats
    """Shape (depths, combinations of a set). [-]"""
    reach: Integers
    """Targets of the ratios, as bits, shape (depths, combinations of a set)."""
    barred: Integers
    """Elements that no set may have besides, as bits, shape (depths,)."""
    chosen: Integers
    """The elements, shape (depths,)."""
    pairs: Integers
    """The ratio of each target, shape (targets,)."""
    found: Integers
    """Sets that were found, shape (most, size)."""


class PortGears(NamedTuple):
    """What the gears of a scheme are with one choice of its ports."""

    input: int
    output: int
    elements: int
    """The elements that there are, as bits."""
    reach: Integers
    """Targets that gears of some speeds reach, as bits, shape (speeds,)."""
    ratios: Floats
    """Their ratios at a point within, shape (speeds,). [-]"""


def set_room(table: Combinations, targets: int, most: int) -> SetRoom:
    """Room for so many sets of a table."""
    depths, all_of_them = len(table.starts), len(table.places)
    spare = all_of_them - targets

    def zeros(*shape: int) -> Integers:
        return np.zeros(shape, np.int64)

    return SetRoom(
        rows=zeros(int(table.rests.max()) + 1),
        missing=zeros(depths, spare + 1),
        coming=zeros(depths),
        gone=zeros(depths),
        counts=zeros(depths),
        ratios=np.zeros((depths, all_of_them)),
        reach=zeros(depths, all_of_them),
        barred=zeros(depths),
        chosen=zeros(depths),
        pairs=zeros(targets),
        found=zeros(most, depths - 1),
    )


@compiled
def _find_rows(table: Combinations, way: Integers, reach: Integers, rows: Integers) -> None:
    """For some elements together, with which others they are usable."""
    rows[:] = 0
    for which in range(len(way)):
        if reach[way[which]]:
            for place in range(table.members.shape[1]):
                rows[table.rests[which, place]] |= 1 << table.members[which, place]


@compiled
def element_sets(
    table: Combinations,
    gears: GearSpeeds,
    port: PortGears,
    room: SetRoom,
) -> int:
    """All sets of elements whose combinations may give every target; how many.

    Parameters
    ----------
    table : Combinations
    gears : GearSpeeds
    port : PortGears
    room : SetRoom
        `found` takes the sets.

    Returns
    -------
    int
        How many there are; -1 if there is no room for them.
    """
    _find_rows(table, gears.way, port.reach, room.rows)
    size = room.found.shape[1]
    spare = room.missing.shape[1] - 1
    room.missing[0, :] = 0
    if table.places.shape[1] == 1:
        _without(room.missing, 0, ~room.rows[0])
    is_strict = spare < table.places.shape[1]
    room.barred[0] = 0
    room.gone[0] = 0
    room.counts[0] = 0
    room.coming[0] = port.elements & ~room.missing[0, spare]
    depth = count = 0
    while depth >= 0:
        if room.coming[depth] == 0:
            depth -= 1
            continue
        lowest = room.coming[depth] & -room.coming[depth]
        room.coming[depth] ^= lowest
        room.chosen[depth] = bits(lowest - 1)
        if not _one_more(table, gears.way, port, room, depth):
            continue
        if depth + 1 < size:
            depth += 1
            _find_missing(table, room, depth)
            if is_strict:
                _bar(table, gears, room, depth)
            after = port.elements & ~(2 * lowest - 1) & ~room.barred[depth]
            room.coming[depth] = after & ~room.missing[depth, spare - room.gone[depth]]
        elif matched(room.reach[size], room.counts[size], len(room.pairs), room.pairs):
            if count == len(room.found):
                return -1
            put(room.chosen[:size], room.found[count])
            count += 1
    return count


@compiled
def _one_more(
    table: Combinations,
    way: Integers,
    port: PortGears,
    room: SetRoom,
    depth: int,
) -> bool:
    """Note the combinations of the last element; whether enough different ratios are left."""
    spare = room.missing.shape[1] - 1
    gone = room.gone[depth]
    count = room.counts[depth]
    after = depth + 1
    put(room.ratios[depth, :count], room.ratios[after])
    put(room.reach[depth, :count], room.reach[after])
    for subset in range(table.starts[depth], table.starts[after]):
        which = way[number_of(table, room.chosen, subset)]
        if port.reach[which] == 0:
            gone += 1
        else:
            ratio = port.ratios[which]
            same = place_of(ratio, room.ratios[after], count)
            if same < count:
                gone += 1
                room.reach[after, same] |= port.reach[which]
            else:
                room.ratios[after, count] = ratio
                room.reach[after, count] = port.reach[which]
                count += 1
        if gone > spare:
            return False
    room.gone[after] = gone
    room.counts[after] = count
    return True


@compiled
def place_of(ratio: float, ratios: Floats, count: int) -> int:
    """The place of the same ratio among the first ones; their count where there is none."""
    same = 0
    while same < count and abs(ratios[same] - ratio) > SAME_BOX_RATIO * abs(ratio):
        same += 1
    return same


@compiled
def _bar(table: Combinations, gears: GearSpeeds, room: SetRoom, depth: int) -> None:
    """Bar what does not slip in a gear of the elements chosen, so many as `depth`.

    With one more of these a set has as many equal ratios as are engaged, besides the first.
    """
    barred = room.barred[depth - 1]
    for subset in range(table.starts[depth - 1], table.starts[depth]):
        barred |= gears.still[gears.way[number_of(table, room.chosen, subset)]]
    room.barred[depth] = barred


@compiled
def _find_missing(table: Combinations, room: SetRoom, depth: int) -> None:
    """Count for all elements the combinations that they would lack; `depth` are chosen."""
    put(room.missing[depth - 1], room.missing[depth])
    engaged = table.places.shape[1]
    for subset in range(table.starts[depth], table.starts[depth + 1]):
        # of the set with one more, whose place is the last of each of these combinations
        rest = 0
        is_new = engaged == 1
        for place in range(engaged - 1):
            rest += table.ranks[room.chosen[table.places[subset, place]], place + 1]
            is_new |= table.places[subset, place] == depth - 1
        if is_new and engaged > 1:
            _without(room.missing, depth, ~room.rows[rest])


@compiled
def _without(missing: Integers, depth: int, bare: int) -> None:
    """Count one combination more that some elements lack."""
    for level in range(missing.shape[1] - 1, 0, -1):
        missing[depth, level] |= missing[depth, level - 1] & bare
    missing[depth, 0] |= bare


@compiled
def matched(reach: Integers, count: int, targets: int, chosen: Integers) -> bool:
    """Whether each target can have a ratio of its own; `chosen` takes one for each.

    >>> chosen = np.zeros(2, np.int64)
    >>> bool(matched(np.array([1, 3]), 2, 2, chosen)), chosen.tolist()
    (True, [0, 1])
    >>> bool(matched(np.array([1, 1]), 2, 2, chosen))
    False
    """
    chosen[:targets] = -1
    for ratio in range(count):
        _placed(reach, ratio, targets, chosen)
    missing = 0
    for target in range(targets):
        missing += chosen[target] < 0
    return missing == 0


@compiled
def _placed(reach: Integers, ratio: int, targets: int, chosen: Integers) -> bool:
    """Give a ratio a target, moving others along a shortest way; False if none is free."""
    came_from = np.empty(targets, np.int64)
    line = np.empty(targets, np.int64)
    seen = reach[ratio]
    first = last = 0
    for target in range(targets):
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
        for other in range(targets):
            if (new >> other) & 1:
                came_from[other] = target
                line[last] = other
                last += 1
    return False
