"""All boxes of a scheme with its ports, compiled: from speeds in gears to fits."""

from __future__ import annotations

import math
from typing import NamedTuple

from vstatics.numerics.arrays import Floats, Integers
from vstatics.numerics.compiled import compiled, put
from vstatics.synthesis.boxes.cells import CellRoom
from vstatics.synthesis.boxes.elements import PortGears, SetRoom, element_sets
from vstatics.synthesis.boxes.engaged import Combinations, number_of
from vstatics.synthesis.boxes.minors import GearSpeeds
from vstatics.synthesis.boxes.ranges import divide, has_one_sign, reached
from vstatics.synthesis.boxes.set_ratios import Asked
from vstatics.synthesis.boxes.solving import solved
from vstatics.synthesis.tolerances import NO_BOX_SPEED, SAME_BOX_RATIO


class Room(NamedTuple):
    """Room for the boxes of a choice of ports."""

    sets: SetRoom
    cells: CellRoom
    gears: Integers
    """The combination of places of each target, shape (most, targets)."""
    logs: Floats
    """Logarithms of ring teeth/sun teeth, shape (most, sets). [-]"""
    errors: Floats
    """The largest |ln(i/target)|, shape (most,). [-]"""
    lines: Floats
    """See `lines`, shape (corners, sets)."""
    parts: Floats
    """Numerators and denominators of a set, shape (combinations of a set, 2, corners)."""


@compiled
def boxes_of_ports(
    table: Combinations, gears: GearSpeeds, port: PortGears, asked: Asked, room: Room
) -> tuple[int, int, int]:
    """All boxes with some ports, into the room: their sets stand first.

    Parameters
    ----------
    table : Combinations
    gears : GearSpeeds
    port : PortGears
        Its reach and ratios are found here.
    asked : Asked
    room : Room

    Returns
    -------
    int, int, int
        How many boxes; of how many sets of elements, below 0 if there was no room; how many of
        these were given up.
    """
    _find_reach(gears.speeds, port, asked, room)
    count = element_sets(table, gears, port, room.sets)
    sets = room.sets.found
    found = given_up = 0
    for number in range(count):
        different = _different(table, gears, port, sets[number], room)
        error = solved(table, room.parts[:different], asked, room.cells)
        if error < math.inf:
            room.errors[found] = error
            put(room.cells.best_gears, room.gears[found])
            put(sets[number], sets[found])
            put(room.cells.best_logs, room.logs[found])
            found += 1
        given_up += room.cells.given_up[0]
    return found, count, given_up


@compiled
def _find_reach(speeds: Floats, port: PortGears, asked: Asked, room: Room) -> None:
    """Which targets gears of some speeds reach, and their ratios within."""
    corners = speeds.shape[2] - 1
    for which in range(len(speeds)):
        first, last = speeds[which, port.input], speeds[which, port.output]
        port.reach[which] = 0
        if abs(first[corners]) > NO_BOX_SPEED and abs(last[corners]) > NO_BOX_SPEED:
            port.ratios[which] = first[corners] / last[corners]
            above, below = first[:corners], last[:corners]
            if not (has_one_sign(above) or has_one_sign(below)):
                put(above, room.parts[0, 0])
                put(below, room.parts[0, 1])
                above, below = room.parts[0, 0], room.parts[0, 1]
                divide(above, below, room.lines)
            port.reach[which] = reached(above, below, asked.least, asked.most)


@compiled
def _different(
    table: Combinations, gears: GearSpeeds, port: PortGears, elements: Integers, room: Room
) -> int:
    """The different ratios of a set's combinations; how many."""
    corners = room.parts.shape[2]
    ratios = room.sets.ratios[0]
    count = 0
    for subset in range(len(table.places)):
        which = gears.way[number_of(table, elements, subset)]
        room.cells.ratio_of[subset] = -1
        if port.reach[which]:
            ratio = port.ratios[which]
            same = 0
            while same < count and abs(ratios[same] - ratio) > SAME_BOX_RATIO * abs(ratio):
                same += 1
            room.cells.ratio_of[subset] = same
            if same == count:
                ratios[count] = ratio
                put(gears.speeds[which, port.input, :corners], room.parts[count, 0])
                put(gears.speeds[which, port.output, :corners], room.parts[count, 1])
                divide(room.parts[count, 0], room.parts[count, 1], room.lines)
                count += 1
    return count
