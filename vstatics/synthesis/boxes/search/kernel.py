"""Compiled search for the gearboxes of a scheme, from link speeds to fitted gear-set ratios."""

from __future__ import annotations

import math
from typing import NamedTuple

from vstatics.core.numerics.arrays import Floats, Integers
from vstatics.synthesis.boxes.search.elements import PortGears, begun, find_ratios
from vstatics.synthesis.boxes.search.engaged import Combinations, GearSpeeds, number_of
from vstatics.synthesis.boxes.search.joining import SetRoom
from vstatics.synthesis.boxes.search.ranges import divide, reached
from vstatics.synthesis.boxes.search.sequences.room import SequenceRoom
from vstatics.synthesis.boxes.search.sequences.search import sequence_found
from vstatics.synthesis.boxes.search.set_ratios import Asked
from vstatics.synthesis.boxes.search.solving import CellRoom, solved
from vstatics.synthesis.compiled import compiled, compiled_part, put, shared
from vstatics.synthesis.tolerances import NO_BOX_SPEED, SAME_BOX_RATIO


@shared
class PortRoom(NamedTuple):
    """Work arrays for the gears with a given input and output, and for the element sets."""

    sets: SetRoom
    lines: Floats
    """Interpolation weights of corners of the bounds, shape (corners, sets); see `lines`. [-]"""
    ratios: Floats
    """Numerators and denominators of the different gear ratios, shape (speeds, 2, corners). [-]"""
    within: Floats
    """Values of the different gear ratios at a point within the bounds, shape (speeds,). [-]"""
    kinds: Integers
    """Index of the gear ratio that each row of link speeds gives, shape (speeds,).

    Negative if a row gives no ratio that reaches a target.
    """
    parts: Floats
    """Numerators and denominators of the gear ratios of an element set, shape (combinations of a
    set, 2, corners). [-]
    """


@shared
class FoundRoom(NamedTuple):
    """Gearboxes found with a given input and output. `SetRoom.listed` has their shift elements."""

    lengths: Integers
    """Number of gears of each gearbox in addition to the targets, shape (most,)."""
    gears: Integers
    """Index of the combination engaged in each gear, shape (most, gears)."""
    logs: Floats
    """Logarithms of ring teeth divided by sun teeth, shape (most, sets). [-]"""
    errors: Floats
    """Largest deviation |ln(i/target)| of each gearbox, shape (most,). [-]"""


@shared
class Room(NamedTuple):
    """Work arrays for the search with a given input and output, without a sequence."""

    ports: PortRoom
    cells: CellRoom
    found: FoundRoom


@shared
class RoomOfSequences(NamedTuple):
    """Work arrays for the search with a given input and output, and with a sequence of gears."""

    ports: PortRoom
    cells: SequenceRoom
    found: FoundRoom


class SetSample(NamedTuple):
    """Size of a sample of element sets."""

    there: int
    """Number of element sets from which the sample is drawn."""
    most: int
    """Approximate size of the sample; all element sets if there are fewer than twice as many."""


def boxes_in(
    table: Combinations,
    port: PortGears,
    asked: Asked,
    room: Room | RoomOfSequences,
    sample: SetSample,
) -> tuple[int, int, int]:
    """Find gearboxes among a sample of the listed sets of shift elements.

    Parameters
    ----------
    table : Combinations
    port : PortGears
        Gears with the targets that their ratios reach.
    asked : Asked
        Wanted ratios with tolerances.
    room : Room or RoomOfSequences
        Working arrays, which receive the gearboxes and limit the steps of the search.
    sample : SetSample

    Returns
    -------
    int, int, int
        Numbers of gearboxes, of examined element sets, and of element sets that were given up.
    """
    if isinstance(room, Room):
        return _boxes_in(table, port, asked, room, sample)
    return _sequences_in(table, port, asked, room, sample)


@compiled
def _boxes_in(
    table: Combinations, port: PortGears, asked: Asked, room: Room, sample: SetSample
) -> tuple[int, int, int]:
    cells, found, sets = room.cells, room.found, room.ports.sets.listed
    step = max(sample.there // sample.most, 1)
    boxes = tried = given_up = 0
    for number in range(step // 2, sample.there, step):
        count = _find_different(
            table, port, sets[number], room.ports, (cells.ratio_of, cells.chains.used)
        )
        reach = room.ports.sets.reach[:count]
        if solved(room.ports.parts[:count], reach, asked, cells) < math.inf:
            found.errors[boxes] = cells.best[1]
            put(cells.best_gears, found.gears[boxes])
            put(sets[number], sets[boxes])
            put(cells.best_logs, found.logs[boxes])
            boxes += 1
        given_up += cells.given_up[0]
        tried += 1
        if cells.steps[0] >= cells.steps[1]:
            break
    return boxes, tried, given_up


@compiled
def _sequences_in(
    table: Combinations, port: PortGears, asked: Asked, room: RoomOfSequences, sample: SetSample
) -> tuple[int, int, int]:
    cells, found, sets = room.cells, room.found, room.ports.sets.listed
    step = max(sample.there // sample.most, 1)
    boxes = tried = given_up = 0
    for number in range(step // 2, sample.there, step):
        count = _find_different(
            table, port, sets[number], room.ports, (cells.ratio_of, cells.chains.used)
        )
        length, is_open = sequence_found(room.ports.parts[:count], asked, cells)
        if length > 0:
            found.lengths[boxes] = length
            put(cells.best_gears, found.gears[boxes])
            put(sets[number], sets[boxes])
            put(cells.best_logs, found.logs[boxes])
            boxes += 1
        given_up += length == 0 and is_open
        tried += 1
        if cells.steps[0] >= cells.steps[1]:
            break
    return boxes, tried, given_up


@compiled
def find_gears(
    table: Combinations, gears: GearSpeeds, port: PortGears, asked: Asked, room: PortRoom
) -> bool:
    """Find the gear ratios with a given input and output, and the combinations with a ratio.

    Parameters
    ----------
    table : Combinations
    gears : GearSpeeds
    port : PortGears
        Receives the ratios of the gears.
    asked : Asked
    room : PortRoom

    Returns
    -------
    bool
        False if no element set can reach all targets; `some_sets` lists element sets.
    """
    _find_ratios_of_ports(gears.speeds, port, asked, room)
    way = gears.way
    useful = 0
    for which in range(len(way)):
        there = table.masks[which] & ~port.elements == 0
        port.ratio_of[which] = room.kinds[way[which]] if there else -1
        if port.ratio_of[which] >= 0:
            port.useful[useful] = which
            useful += 1
            port.loaded[which] = table.masks[which]
            if len(port.shafts):
                port.loaded[which] = _loaded(table, gears, port, which)
    if useful < len(way):
        port.useful[useful] = -1
    return begun(table, port, room.sets)


@compiled_part
def _find_ratios_of_ports(speeds: Floats, port: PortGears, asked: Asked, room: PortRoom) -> None:
    """Find the different gear ratios that reach a target within the bounds of gear-set ratios."""
    corners = speeds.shape[2] - 1
    count = 0
    for which in range(len(speeds)):
        first, last = speeds[which, port.input], speeds[which, port.output]
        room.kinds[which] = -1
        if abs(first[corners]) <= NO_BOX_SPEED or abs(last[corners]) <= NO_BOX_SPEED:
            continue
        ratio = first[corners] / last[corners]
        same = 0
        while same < count and abs(room.within[same] - ratio) > SAME_BOX_RATIO * abs(ratio):
            same += 1
        if same == count:
            above, below = room.ratios[count]
            put(first[:corners], above)
            put(last[:corners], below)
            divide(above, below, room.lines)
            port.reach[count] = reached(above, below, asked.least, asked.most)
            if port.reach[count] == 0:
                continue
            room.within[count] = ratio
            count += 1
        room.kinds[which] = same


@compiled_part
def _loaded(table: Combinations, gears: GearSpeeds, port: PortGears, which: int) -> int:
    """Return the shift elements of a combination that carry torque, as bits.

    An element without torque can be released without changing the ratio. If it is released and the
    input is held instead, the output is still at rest.
    """
    corners = gears.speeds.shape[2] - 1
    loaded = 0
    for place in range(table.members.shape[1]):
        number = 0
        after = 1  # index of the next member; the brake that holds the input counts as a member
        brake = port.input
        for other in range(table.members.shape[1]):
            member = table.members[which, other]
            if other != place:
                if 0 <= brake < member:
                    number += table.ranks[brake, after]
                    after += 1
                    brake = -1
                number += table.ranks[member, after]
                after += 1
        if brake >= 0:
            number += table.ranks[brake, after]
        if abs(gears.speeds[gears.way[number], port.output, corners]) > NO_BOX_SPEED:
            loaded |= 1 << table.members[which, place]
    return loaded


@compiled_part
def _find_different(
    table: Combinations,
    port: PortGears,
    elements: Integers,
    room: PortRoom,
    of_places: tuple[Integers, Integers],
) -> int:
    """Find and count the different gear ratios of an element set.

    `of_places` receives, for each combination of positions in the element set, the index of its
    ratio, and the used positions as bits.
    """
    ratio_of, used = of_places
    put(elements, room.sets.chosen)
    count = find_ratios(table, port, room.sets)
    for number in range(count):
        for half in range(2):
            put(room.ratios[room.sets.ratios[number], half], room.parts[number, half])
    for subset in range(len(table.places)):
        which = number_of(table, elements, subset)
        ratio = port.ratio_of[which]
        ratio_of[subset] = -1
        used[subset] = 0
        for place in table.places[subset]:
            if (port.loaded[which] >> elements[place]) & 1:
                used[subset] |= 1 << place
        for number in range(count):
            if room.sets.ratios[number] == ratio:
                ratio_of[subset] = number
    return count
