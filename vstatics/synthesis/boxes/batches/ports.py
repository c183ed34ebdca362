"""The search for boxes in one scheme, with any of its ports."""

from __future__ import annotations

import math
from threading import get_ident

import numpy as np

from vstatics.core.numerics.arrays import Integers
from vstatics.synthesis.boxes.batches.arrays import asked_arrays, room_of, single_shifts
from vstatics.synthesis.boxes.box import HELD, BoxSearch, FoundBox
from vstatics.synthesis.boxes.chosen_gears import set_ratios
from vstatics.synthesis.boxes.schemes.choices import BoxScheme
from vstatics.synthesis.boxes.schemes.speeds import SpeedBases, speed_bases
from vstatics.synthesis.boxes.search.elements import PortGears
from vstatics.synthesis.boxes.search.engaged import (
    Combinations,
    GearSpeeds,
    combinations_table,
    gear_speeds,
)
from vstatics.synthesis.boxes.search.kernel import Room, boxes_of_ports, sequences_of_ports
from vstatics.synthesis.ratios.fitting import deviation
from vstatics.synthesis.tolerances import SAME_BOX_SPEED

FIRST_ELEMENT_SETS = 4096
"""So many sets of elements there is room for at first."""


class PortSearch:
    """The search in one scheme, for any of its ports."""

    def __init__(self, search: BoxSearch, one: BoxScheme) -> None:
        """Find the speeds in all gears that there may be."""
        self.search = search
        self.scheme = one
        self.bases = speed_bases(search, one)
        self.table = combinations_table(len(self.bases.moving), search.engaged, search.elements)
        self.gears = _gears(self.bases, self.table)
        counts = search.brake_counts
        every = range(search.elements + 1)
        self.brakes = sum(1 << number for number in (every if counts is None else counts))
        self.shifts = single_shifts(search)
        self.shafts = _at_shafts(search, self.table)
        self.kept = _kept(search, self.bases, self.table)
        self.searched = self.given_up = 0

    def boxes(self, first: int, last: int) -> list[FoundBox]:
        """All boxes with these links as input and output."""
        port, search = self.gears_of(first, last), self.search
        most = FIRST_ELEMENT_SETS
        while True:
            room = room_of(search, most, get_ident())
            within = boxes_of_ports if search.sequence is None else sequences_of_ports
            found, count, given_up = within(
                self.table, self.gears, port, asked_arrays(search), room
            )
            if count >= 0:
                self.given_up += int(given_up)
                return [self._box(room, row, first, last) for row in range(found)]
            most *= 4

    def gears_of(self, first: int, last: int) -> PortGears:
        """What is to be known of these links as ports; their boxes are counted as searched."""
        search, table = self.search, self.table
        ports = self.bases.moving.index(first), self.bases.moving.index(last)
        ends = enumerate(table.ends.tolist())
        there = {number for number, (one, other) in ends if other >= 0 or one not in ports}
        there |= self.kept
        least_kept = 0 if search.kept is None else len(self.kept) - search.kept.free
        for kept in range(max(least_kept, 0), min(len(self.kept), search.elements) + 1):
            others = math.comb(len(there - self.kept), search.elements - kept)
            self.searched += math.comb(len(self.kept), kept) * others
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
            sum(1 << number for number in self.kept),
            least_kept,
        )

    def _box(self, room: Room, row: int, first: int, last: int) -> FoundBox:
        """A box of a row of the results; its brakes stand first."""
        moving = self.bases.moving
        signs = np.where(self.scheme.meshed, 1.0, -1.0)
        numbers = room.sets.found[row].tolist()
        elements = tuple(
            (moving[one], moving[other] if other >= 0 else HELD)
            for one, other in self.table.ends[numbers].tolist()
        )
        count = len(self.search.targets) + int(room.lengths[row])
        gears = room.gears[row, :count].tolist()
        found = FoundBox(
            self.scheme.scheme,
            self.scheme.held,
            first,
            last,
            elements,
            tuple((signs * np.exp(room.logs[row])).tolist()),
            tuple(tuple(self.table.places[one].tolist()) for one in gears),
            float(room.errors[row]),
        )
        if self.search.sequence is None:
            return found
        ratios = set_ratios(found, found.gears).tolist()
        errors = map(deviation, ratios, self.search.targets)
        return found._replace(error=max(errors, default=0.0))


def _at_shafts(search: BoxSearch, table: Combinations) -> Integers:
    """The elements at each shaft that is no port and of no set, as bits; they are the last."""
    shafts = range(search.moving - search.shafts, search.moving)
    found = [
        sum(1 << number for number, ends in enumerate(table.ends.tolist()) if shaft in ends)
        for shaft in shafts
    ]
    return np.array(found, np.int64)


def _kept(search: BoxSearch, bases: SpeedBases, table: Combinations) -> set[int]:
    """The numbers of the elements of which most are to be kept."""
    if search.kept is None:
        return set()
    row = {link: place for place, link in enumerate(bases.moving)} | {HELD: HELD}
    numbers = {(one, other): number for number, (one, other) in enumerate(table.ends.tolist())}
    return {numbers[row[one], row[other]] for one, other in search.kept.elements}


def _gears(bases: SpeedBases, table: Combinations) -> GearSpeeds:
    """The different speeds that gears can have, and which of them each combination gives.

    They are compared at the point within; only the different ones are found at the corners.
    """
    points, links, _ = bases.speeds.shape
    within = np.zeros((len(table.members), links, 1))
    gear_speeds(bases.speeds[-1:], bases.factors[-1:], table.ends, table.members, within)
    sizes = np.abs(within).max(axis=1)
    sizes[sizes < SAME_BOX_SPEED] = np.inf
    keys = np.round(np.abs(within[:, :, 0] / sizes @ _KEYS[:links]) / SAME_BOX_SPEED)
    alike = keys[:, 0] + 1j * keys[:, 1]
    _, which, way = np.unique(alike, return_index=True, return_inverse=True)
    found = np.zeros((len(which), links, points))
    gear_speeds(bases.speeds, bases.factors, table.ends, table.members[which], found)
    found /= sizes[which, :, None]
    return GearSpeeds(found, way.astype(np.int64).reshape(-1))


_KEYS = np.sqrt(np.arange(2, 66)).reshape(-1, 2) % 1 - 0.3
"""Weights of links in two sums that tell speeds apart."""
