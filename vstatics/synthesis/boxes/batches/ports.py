"""Search for the gearboxes of a single scheme, with each choice of input and output."""

from __future__ import annotations

import math
from threading import get_ident

import numpy as np

from vstatics.synthesis.boxes.batches.arrays import asked_arrays, room_of, single_shifts
from vstatics.synthesis.boxes.box import HELD, BoxSearch, FoundBox
from vstatics.synthesis.boxes.chosen_gears import set_ratios
from vstatics.synthesis.boxes.schemes.choices import BoxScheme
from vstatics.synthesis.boxes.schemes.speeds import SpeedBases, speed_bases
from vstatics.synthesis.boxes.search.elements import PortGears, some_sets
from vstatics.synthesis.boxes.search.engaged import (
    Combinations,
    GearSpeeds,
    combinations_table,
    gear_speeds,
    speed_room,
)
from vstatics.synthesis.boxes.search.joining import NO_END
from vstatics.synthesis.boxes.search.kernel import (
    Room,
    RoomOfSequences,
    SetSample,
    boxes_in,
    find_gears,
)
from vstatics.synthesis.ratios.fitting import deviation
from vstatics.synthesis.tolerances import SAME_BOX_SPEED

FIRST_ELEMENT_SETS = 4096
"""Number of sets of shift elements for which work arrays have room at first; increased on demand.
"""


class PortSearch:
    """Search of a scheme; the link speeds in all gears serve every choice of input and output."""

    def __init__(self, search: BoxSearch, scheme: BoxScheme) -> None:
        """Calculate the speeds of links with each combination of engaged shift elements."""
        self.search = search
        self.scheme = scheme
        self.bases = speed_bases(search, scheme)
        self.table = combinations_table(len(self.bases.moving), search.engaged, search.elements)
        self.gears = _gears(self.bases, self.table)
        counts = search.brake_counts
        every = range(search.elements + 1)
        self.brakes = sum(1 << number for number in (every if counts is None else counts))
        self.shifts = single_shifts(search)
        shafts = range(search.moving - search.shafts, search.moving)
        masks = [
            sum(
                1 << number for number, ends in enumerate(self.table.ends.tolist()) if shaft in ends
            )
            for shaft in shafts
        ]
        self.shafts = np.array(masks, np.int64)
        self.retained = _retained(search, self.bases, self.table)
        self.searched = self.given_up = 0

    def boxes(self, first: int, last: int) -> list[FoundBox]:
        """Return all gearboxes of the scheme with input link `first` and output link `last`."""
        port, search = self.gears_of(first, last), self.search
        most = FIRST_ELEMENT_SETS
        while True:
            room = room_of(search, most, get_ident())
            asked, sets = asked_arrays(search), 0
            if find_gears(self.table, self.gears, port, asked, room.ports):
                sets, _ = some_sets(self.table, port, room.ports.sets, NO_END)
            if sets >= 0:
                every = SetSample(sets, NO_END)
                count, _, given_up = boxes_in(self.table, port, asked, room, every)
                self.given_up += int(given_up)
                return [self._box(room, row, first, last) for row in range(count)]
            most *= 4

    def gears_of(self, first: int, last: int) -> PortGears:
        """Return work arrays for an input and an output link, and add to the count `searched`."""
        search, table = self.search, self.table
        ports = self.bases.moving.index(first), self.bases.moving.index(last)
        ends = enumerate(table.ends.tolist())
        there = {
            number
            for number, (first_end, second_end) in ends
            if second_end >= 0 or first_end not in ports
        }
        there |= self.retained
        least_retained = 0 if search.kept is None else len(self.retained) - search.kept.free
        for count in range(max(least_retained, 0), min(len(self.retained), search.elements) + 1):
            others = math.comb(len(there - self.retained), search.elements - count)
            self.searched += math.comb(len(self.retained), count) * others
        ratio_of, reach, useful, loaded = np.zeros((4, len(table.members)), np.int64)
        return PortGears(
            *ports,
            sum(1 << number for number in there),
            ratio_of,
            reach,
            useful,
            self.brakes,
            self.shifts,
            loaded,
            self.shafts,
            sum(1 << number for number in self.retained),
            least_retained,
        )

    def _box(self, room: Room | RoomOfSequences, row: int, first: int, last: int) -> FoundBox:
        moving = self.bases.moving
        signs = np.where(self.scheme.meshed, 1.0, -1.0)
        numbers = room.ports.sets.listed[row].tolist()
        elements = tuple(
            (moving[first_end], moving[second_end] if second_end >= 0 else HELD)
            for first_end, second_end in self.table.ends[numbers].tolist()
        )
        count = len(self.search.targets) + int(room.found.lengths[row])
        gears = room.found.gears[row, :count].tolist()
        box = FoundBox(
            self.scheme.scheme,
            self.scheme.held,
            first,
            last,
            elements,
            tuple((signs * np.exp(room.found.logs[row])).tolist()),
            tuple(tuple(self.table.places[gear].tolist()) for gear in gears),
            float(room.found.errors[row]),
        )
        if self.search.sequence is None:
            return box
        ratios = set_ratios(box, box.gears).tolist()
        error = max(map(deviation, ratios, self.search.targets), default=0.0)
        return box._replace(error=error)


def _retained(search: BoxSearch, bases: SpeedBases, table: Combinations) -> set[int]:
    if search.kept is None:
        return set()
    row = {link: place for place, link in enumerate(bases.moving)} | {HELD: HELD}
    numbers = {
        (first, second): number for number, (first, second) in enumerate(table.ends.tolist())
    }
    return {numbers[row[first], row[second]] for first, second in search.kept.elements}


def _gears(bases: SpeedBases, table: Combinations) -> GearSpeeds:
    """Calculate the link speeds with each combination of engaged shift elements.

    Combinations with equal speeds at a point within the bounds of the ratios share one calculation
    at the corners of the bounds.
    """
    points, links, free = bases.speeds.shape
    room = speed_room(free)
    within = np.zeros((len(table.members), links, 1))
    gear_speeds(bases.speeds[-1:], table.ends, table.members, room, within)
    within *= bases.factors[-1:]
    sizes = np.abs(within).max(axis=1)
    sizes[sizes < SAME_BOX_SPEED] = np.inf
    keys = np.round(np.abs(within[:, :, 0] / sizes @ _KEYS[:links]) / SAME_BOX_SPEED)
    alike = keys[:, 0] + 1j * keys[:, 1]
    _, which, way = np.unique(alike, return_index=True, return_inverse=True)
    speeds = np.zeros((len(which), links, points))
    gear_speeds(bases.speeds, table.ends, table.members[which], room, speeds)
    speeds *= bases.factors
    speeds /= sizes[which, :, None]
    return GearSpeeds(speeds, way.astype(np.int64).reshape(-1))


_KEYS = np.sqrt(np.arange(2, 66)).reshape(-1, 2) % 1 - 0.3
"""Weights for two weighted sums of link speeds. Equal sums mean equal speeds."""
