"""All boxes of a scheme with its ports, compiled: from speeds in gears to fits."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from vstatics.numerics.arrays import Floats, Integers
from vstatics.numerics.compiled import compiled
from vstatics.synthesis.box_cells import CellRoom, solved
from vstatics.synthesis.box_elements import SAME, Combinations, SetRoom, element_sets, number_of
from vstatics.synthesis.box_fit import Asked
from vstatics.synthesis.box_ranges import divide, has_one_sign, reached

ZERO = 1e-11
"""What is smaller, in terms of the largest speed in a gear, is nothing. [-]"""


class Room(NamedTuple):
    """Room for the boxes of a choice of ports."""

    sets: SetRoom
    cells: CellRoom
    found: Integers
    """Sets of elements, shape (most, size)."""
    gears: Integers
    """The combination of places of each target, shape (most, targets)."""
    logs: Floats
    """Logarithms of ring teeth/sun teeth, shape (most, sets). [-]"""
    errors: Floats
    """The largest |ln(i/target)|, shape (most,). [-]"""
    reach: Integers
    """Targets that gears of some speeds reach, as bits, shape (speeds,)."""
    ratios: Floats
    """Their ratios at a point within, shape (speeds,). [-]"""
    lines: Floats
    """See `lines`, shape (corners, sets)."""
    parts: Floats
    """Numerators and denominators of a set, shape (combinations of a set, 2, corners)."""
    ratio_of: Integers
    """The ratio of a combination of a set, below 0 of none, shape (combinations of a set,)."""
    chosen: Integers
    """The ratio of each target, shape (targets,)."""
    came: Integers
    """See `_all_used`, shape (targets + 1, 2**size)."""


@compiled
def boxes_of_ports(
    table: Combinations,
    way: Integers,
    speeds: Floats,
    still: Integers,
    ports: tuple[int, int],
    elements: int,
    asked: Asked,
    room: Room,
) -> tuple[int, int]:
    """All boxes with these ports, into the room.

    Parameters
    ----------
    table : Combinations
    way : array, shape (combinations,)
        The row of speeds that each combination gives.
    speeds : array, shape (speeds, links, points)
        Polynomials at the corners of the bounds, then at a point within.
    still : array, shape (speeds,)
        Elements that do not slip, as bits.
    ports : int, int
        Input and output.
    elements : int
        Those that there are, as bits.
    asked : Asked
    room : Room

    Returns
    -------
    int, int
        How many boxes, and of how many sets of elements; below 0 if there was no room.
    """
    find_reach(speeds, ports, asked, room)
    reach, ratios = room.reach, room.ratios
    count = element_sets(table, way, still, reach, ratios, elements, room.sets, room.found)
    every = room.came.shape[1] - 1
    found = 0
    for number in range(count):
        elements_of = room.found[number]
        different = _different(table, way, speeds, ports, elements_of, room)
        logs, gears = room.logs[found], room.gears[found]
        error = solved(room.parts[:different], asked, room.cells, logs, room.chosen)
        if error < math.inf and _all_used(table, room, every, gears):
            room.errors[found] = error
            for place in range(len(elements_of)):
                room.found[found, place] = elements_of[place]
            found += 1
    return found, count


@compiled
def find_reach(speeds: Floats, ports: tuple[int, int], asked: Asked, room: Room) -> None:
    """Which targets gears of some speeds reach, and their ratios within."""
    corners = speeds.shape[2] - 1
    for which in range(len(speeds)):
        first, last = speeds[which, ports[0]], speeds[which, ports[1]]
        room.reach[which] = 0
        if abs(first[corners]) > ZERO and abs(last[corners]) > ZERO:
            room.ratios[which] = first[corners] / last[corners]
            above, below = first[:corners], last[:corners]
            if not (has_one_sign(above) or has_one_sign(below)):
                room.parts[0, 0] = above
                room.parts[0, 1] = below
                above, below = room.parts[0, 0], room.parts[0, 1]
                divide(above, below, room.lines)
            room.reach[which] = reached(above, below, asked.least, asked.most)


@compiled
def _different(
    table: Combinations,
    way: Integers,
    speeds: Floats,
    ports: tuple[int, int],
    elements: Integers,
    room: Room,
) -> int:
    """The different ratios of a set's combinations; how many."""
    corners = room.parts.shape[2]
    count = 0
    for subset in range(len(table.places)):
        which = way[number_of(table, elements, subset)]
        room.ratio_of[subset] = -1
        if room.reach[which]:
            ratio = room.ratios[which]
            same = 0
            while same < count and abs(room.sets.ratios[0, same] - ratio) > SAME * abs(ratio):
                same += 1
            room.ratio_of[subset] = same
            if same == count:
                room.sets.ratios[0, count] = ratio
                for corner in range(corners):
                    room.parts[count, 0, corner] = speeds[which, ports[0], corner]
                    room.parts[count, 1, corner] = speeds[which, ports[1], corner]
                divide(room.parts[count, 0], room.parts[count, 1], room.lines)
                count += 1
    return count


@compiled
def _all_used(table: Combinations, room: Room, every: int, gears: Integers) -> bool:
    """Whether gears of the chosen ratios can be such that all elements are used.

    Target by target it is noted which elements may be in use, as bits, and how; `gears` takes
    the combination of each target.
    """
    count, subsets = len(room.chosen), len(table.places)
    room.came[:] = -1
    room.came[0, 0] = 0
    for target in range(count):
        for state in range(every + 1):
            if room.came[target, state] >= 0:
                for subset in range(subsets):
                    if room.ratio_of[subset] == room.chosen[target]:
                        after = state
                        for place in range(table.places.shape[1]):
                            after |= 1 << table.places[subset, place]
                        if room.came[target + 1, after] < 0:
                            room.came[target + 1, after] = state * subsets + subset
    if room.came[count, every] < 0:
        return False
    state = every
    for target in range(count - 1, -1, -1):
        step = room.came[target + 1, state]
        gears[target] = step % subsets
        state = step // subsets
    return True
