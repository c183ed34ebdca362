"""Compiled search for the gearboxes of a scheme, from speeds in each gear to fitted ratios."""

from __future__ import annotations

import math
from typing import NamedTuple

from vstatics.core.numerics.arrays import Floats, Integers
from vstatics.core.numerics.compiled import compiled, compiled_part, put
from vstatics.synthesis.boxes.search.elements import PortGears, element_sets, find_ratios
from vstatics.synthesis.boxes.search.engaged import Combinations, GearSpeeds, number_of
from vstatics.synthesis.boxes.search.joining import SetRoom
from vstatics.synthesis.boxes.search.ranges import divide, reached
from vstatics.synthesis.boxes.search.sequences.room import SequenceRoom
from vstatics.synthesis.boxes.search.sequences.search import sequence_found
from vstatics.synthesis.boxes.search.set_ratios import Asked
from vstatics.synthesis.boxes.search.solving import CellRoom, solved
from vstatics.synthesis.tolerances import NO_BOX_SPEED, SAME_BOX_RATIO


class Room(NamedTuple):
    """Work arrays for the gearboxes of a choice of ports."""

    sets: SetRoom
    cells: CellRoom
    sequences: SequenceRoom
    lengths: Integers
    """Number of gears in addition to the targets, shape (most,)."""
    gears: Integers
    """Combination of places in each gear, shape (most, gears)."""
    logs: Floats
    """Logarithms of ring teeth/sun teeth, shape (most, sets). [-]"""
    errors: Floats
    """Largest |ln(i/target)|, shape (most,). [-]"""
    lines: Floats
    """Weights of the corners on lines along each ratio, see `lines`, shape (corners, sets)."""
    ratios: Floats
    """Numerators and denominators of all different ratios, shape (speeds, 2,
    corners)."""
    within: Floats
    """All different ratios, each at the point within the bounds, shape (speeds,). [-]"""
    kinds: Integers
    """Number of the ratio of each row of speeds, negative without a ratio, shape (speeds,)."""
    parts: Floats
    """Numerators and denominators of the ratios of a set, shape (combinations of a set, 2,
    corners)."""


@compiled
def boxes_of_ports(
    table: Combinations, gears: GearSpeeds, port: PortGears, asked: Asked, room: Room
) -> tuple[int, int, int]:
    """Find all gearboxes of a choice of ports.

    Parameters
    ----------
    table : Combinations
    gears : GearSpeeds
    port : PortGears
        Receives the ratios of the gears.
    asked : Asked
    room : Room

    Returns
    -------
    int, int, int
        Number of gearboxes; number of element sets, negative if there was not enough room;
        number of sets that were given up.
    """
    find_gears(table, gears, port, asked, room)
    count = element_sets(table, port, room.sets)
    sets = room.sets.listed
    boxes = given_up = 0
    for number in range(count):
        if is_box(table, port, asked, room, sets[number]):
            room.errors[boxes] = room.cells.best[1]
            put(room.cells.best_gears, room.gears[boxes])
            put(sets[number], sets[boxes])
            put(room.cells.best_logs, room.logs[boxes])
            boxes += 1
        given_up += room.cells.given_up[0]
    return boxes, count, given_up


@compiled
def sequences_of_ports(
    table: Combinations, gears: GearSpeeds, port: PortGears, asked: Asked, room: Room
) -> tuple[int, int, int]:
    """Find all gearboxes with a sequence of gears; results as of `boxes_of_ports`."""
    find_gears(table, gears, port, asked, room)
    count = element_sets(table, port, room.sets)
    sets = room.sets.listed
    boxes = given_up = 0
    for number in range(count):
        length, is_open = gears_besides(table, port, asked, room, sets[number])
        if length > 0:
            room.lengths[boxes] = length
            put(room.sequences.best_gears, room.gears[boxes])
            put(sets[number], sets[boxes])
            put(room.sequences.best_logs, room.logs[boxes])
            boxes += 1
        given_up += length == 0 and is_open
    return boxes, count, given_up


@compiled_part
def is_box(
    table: Combinations, port: PortGears, asked: Asked, room: Room, elements: Integers
) -> bool:
    """Return whether a set of elements is a gearbox; `cells` receives the best ratios."""
    count = _different(table, port, elements, room)
    reach = room.sets.reach[:count]
    return bool(solved(room.parts[:count], reach, asked, room.cells) < math.inf)


@compiled_part
def gears_besides(
    table: Combinations, port: PortGears, asked: Asked, room: Room, elements: Integers
) -> tuple[int, bool]:
    """Return the number of gears in the sequence of a set, and whether more are possible."""
    count = _different(table, port, elements, room)
    put(room.cells.ratio_of, room.sequences.ratio_of)
    put(room.cells.chains.used, room.sequences.chains.used)
    return sequence_found(room.parts[:count], asked, room.sequences)


@compiled
def find_gears(
    table: Combinations, gears: GearSpeeds, port: PortGears, asked: Asked, room: Room
) -> None:
    """Find the ratios with a choice of ports, and the combinations that have a ratio."""
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


@compiled_part
def _find_ratios_of_ports(speeds: Floats, port: PortGears, asked: Asked, room: Room) -> None:
    """Find the different ratios that reach a target within the bounds."""
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
    """Return the elements of a combination that carry torque, as bits.

    An element without torque can be released without changing the ratio: if the input is held
    instead of the element, the output is at rest.
    """
    corners = gears.speeds.shape[2] - 1
    loaded = 0
    for place in range(table.members.shape[1]):
        number = 0
        after = 1  # place of the next member; the brake of the input counts as a member
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
def _different(table: Combinations, port: PortGears, elements: Integers, room: Room) -> int:
    """Find the different ratios of a set; return the number of ratios."""
    put(elements, room.sets.chosen)
    count = find_ratios(table, port, room.sets)
    for number in range(count):
        for half in range(2):
            put(room.ratios[room.sets.ratios[number], half], room.parts[number, half])
    for subset in range(len(table.places)):
        which = number_of(table, elements, subset)
        ratio = port.ratio_of[which]
        room.cells.ratio_of[subset] = -1
        room.cells.chains.used[subset] = 0
        for place in table.places[subset]:
            if (port.loaded[which] >> elements[place]) & 1:
                room.cells.chains.used[subset] |= 1 << place
        for number in range(count):
            if room.sets.ratios[number] == ratio:
                room.cells.ratio_of[subset] = number
    return count
