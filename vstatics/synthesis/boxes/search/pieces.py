"""The search for boxes, cut into pieces that can be done apart, and how long they will take."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from functools import cache, lru_cache
from threading import get_ident
from typing import NamedTuple

import numpy as np

from vstatics.numerics.arrays import Integers
from vstatics.synthesis.boxes.box import HELD, LARGEST_RATIO, BoxSearch, FoundBox
from vstatics.synthesis.boxes.chosen_gears import set_ratios
from vstatics.synthesis.boxes.schemes import BoxScheme, SpeedBases, box_schemes, speed_bases
from vstatics.synthesis.boxes.search.elements import PortGears
from vstatics.synthesis.boxes.search.engaged import (
    Combinations,
    GearSpeeds,
    combinations_table,
    gear_speeds,
)
from vstatics.synthesis.boxes.search.joining import set_room
from vstatics.synthesis.boxes.search.kernel import Room, boxes_of_ports, sequences_of_ports
from vstatics.synthesis.boxes.search.ranges import lines
from vstatics.synthesis.boxes.search.sequences.room import sequence_of, sequence_room
from vstatics.synthesis.boxes.search.set_ratios import Asked
from vstatics.synthesis.boxes.search.shifts import neighbours
from vstatics.synthesis.boxes.search.solving import cell_room
from vstatics.synthesis.ratios.fitting import deviation
from vstatics.synthesis.tolerances import SAME_BOX_SPEED, TARGET_MARGIN

PORTS_AT_ONCE = 100
"""So many choices of ports a piece has at most: a few seconds of work."""
FURTHER_WORK = 50
"""Where more than three elements are open in every gear, each makes about so much more."""
FIRST_ELEMENT_SETS = 4096
"""So many sets of elements there is room for at first."""


def prepare() -> None:
    """Compile what searches need, which takes ten seconds or more where it has not been kept."""
    found_in(BoxSearch(1, 2, 1, (3.0, 1.0)), 0)


class FoundPiece(NamedTuple):
    """What a piece of the search found."""

    searched: int
    """Boxes that there are in it."""
    boxes: tuple[FoundBox, ...]
    given_up: int = 0
    """Sets of elements that may be boxes, too, but could not be looked at to the end."""


def cut(search: BoxSearch) -> int:
    """The number of pieces, each of schemes of its own.

    >>> cut(BoxSearch(1, 2, 1, (3.0, 1.0)))
    1
    """
    return len(_pieces(search))


def found_in(search: BoxSearch, piece: int) -> FoundPiece:
    """What is found in a piece.

    Parameters
    ----------
    search : BoxSearch
    piece : int
        From 0.

    Examples
    --------
    A set with its ring held, where p = 2 makes 3, and one that is locked:

    >>> found = found_in(BoxSearch(1, 2, 1, (3.0, 1.0)), 0)
    >>> found.searched, len(found.boxes)
    (36, 3)
    """
    searched = given_up = 0
    boxes: list[FoundBox] = []
    for one in _pieces(search)[piece]:
        ports = _PortSearch(search, one)
        for first, last in one.ports:
            boxes += ports.boxes(first, last)
        searched += ports.searched
        given_up += ports.given_up
    return FoundPiece(searched, tuple(boxes), given_up)


@lru_cache(maxsize=4)
def _pieces(search: BoxSearch) -> list[list[BoxScheme]]:
    """The schemes of each piece; the ports of one may be in several."""
    further = max(search.elements - search.engaged - 3, 0)
    most = max(PORTS_AT_ONCE // FURTHER_WORK**further, 1)
    pieces: list[list[BoxScheme]] = []
    room = 0
    for one in box_schemes(search):
        start = 0
        while start < len(one.ports):
            if room == 0:
                pieces.append([])
                room = most
            some = one.ports[start : start + room]
            pieces[-1].append(one._replace(ports=some))
            room -= len(some)
            start += len(some)
    return pieces


class _PortSearch:
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
        self.shifts = _shifts(search)
        self.shafts = _at_shafts(search, self.table)
        self.kept = _kept(search, self.bases, self.table)
        self.searched = self.given_up = 0

    def boxes(self, first: int, last: int) -> list[FoundBox]:
        """All boxes with these links as input and output."""
        search, table = self.search, self.table
        ports = self.bases.moving.index(first), self.bases.moving.index(last)
        ends = enumerate(table.ends.tolist())
        there = {number for number, (one, other) in ends if other >= 0 or one not in ports}
        there |= self.kept
        least_kept = 0 if search.kept is None else len(self.kept) - search.kept.free
        for kept in range(max(least_kept, 0), min(len(self.kept), search.elements) + 1):
            others = math.comb(len(there - self.kept), search.elements - kept)
            self.searched += math.comb(len(self.kept), kept) * others
        bits, count = sum(1 << number for number in there), len(table.members)
        ratio_of, reach, useful, loaded = np.zeros((4, count), np.int64)
        kept_bits = sum(1 << number for number in self.kept)
        port = PortGears(
            *ports,
            bits,
            ratio_of,
            reach,
            useful,
            self.brakes,
            self.shifts,
            loaded,
            self.shafts,
            kept_bits,
            least_kept,
        )
        most = FIRST_ELEMENT_SETS
        while True:
            room = _room(search, most, get_ident())
            within = boxes_of_ports if search.sequence is None else sequences_of_ports
            found, count, given_up = within(table, self.gears, port, _asked(search), room)
            if count >= 0:
                self.given_up += int(given_up)
                return [self._box(room, row, first, last) for row in range(found)]
            most *= 4

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


@cache
def _asked(search: BoxSearch) -> Asked:
    """What is asked, as arrays."""
    targets = np.array(search.targets, dtype=float)
    widths = np.array(search.widths)
    factors = np.exp(widths + TARGET_MARGIN)
    ends = np.sort([targets / factors, targets * factors], axis=0)
    if search.sequence is not None:  # one target more in which all forward ratios are
        ends = np.append(ends, [[1 / LARGEST_RATIO], [LARGEST_RATIO]], axis=1)
    return Asked(targets, ends[0], ends[1], widths, *search.bounds)


def _shifts(search: BoxSearch) -> Integers:
    """The targets between which one element is to change."""
    in_turn = search.singly and search.sequence is None
    return neighbours(search.targets if in_turn else ())


@lru_cache(maxsize=32)
def _room(search: BoxSearch, most: int, thread: int) -> Room:  # noqa: ARG001
    """Room for the boxes of a choice of ports; each thread of a worker has its own."""
    table = combinations_table(search.moving, search.engaged, search.elements)
    asked = _asked(search)
    wanted = sequence_of(search.sequence, singly=search.singly)
    targets, sets, speeds = len(asked.targets), search.sets, len(table.members)
    return Room(
        sets=set_room(table, targets, most),
        cells=cell_room(table, asked, sets, _shifts(search)),
        sequences=sequence_room(table, asked, wanted, sets),
        lengths=np.zeros(most, np.int64),
        gears=np.zeros((most, targets + wanted.most), np.int64),
        logs=np.zeros((most, sets)),
        errors=np.zeros(most),
        lines=lines(sets),
        ratios=np.zeros((speeds, 2, 2**sets)),
        within=np.zeros(speeds),
        kinds=np.zeros(speeds, np.int64),
        parts=np.zeros((len(table.places), 2, 2**sets)),
    )


ENOUGH = 3.0
"""So long choices of ports are tried, one at least. [s]"""
FEW = 10_000
"""Of so many choices of ports all may be tried."""
GOLDEN = 0.6180339887498949
"""Multiples of it are spread evenly: so ports from everywhere come first."""


class BoxEstimate(NamedTuple):
    """What is known of a search before it."""

    pieces: int
    boxes: float
    """That will be looked at."""
    found: float
    """Of them, boxes with the ratios."""
    seconds: float
    """In one process."""
    exact: bool
    """Whether all of it was tried."""


def box_estimate(search: BoxSearch) -> BoxEstimate:
    """About how many boxes there are, and how long they take.

    Parameters
    ----------
    search : BoxSearch
        A sound one, see `check_box_search`.
    """
    schemes = [one for piece in _pieces(search) for one in piece]
    ends = np.cumsum([len(one.ports) for one in schemes], dtype=np.int64)
    total = int(ends[-1]) if schemes else 0
    prepare()
    began = time.process_time()
    searched = found = tried = 0
    ready = 0.0
    for number in _spread(total):
        before = time.process_time()
        which = int(np.searchsorted(ends, number, side="right"))
        ports = _PortSearch(search, schemes[which])
        ready += time.process_time() - before
        found += len(ports.boxes(*schemes[which].ports[number - int(ends[which])]))
        searched, tried = searched + ports.searched, tried + 1
        if time.process_time() - began > ENOUGH:
            break
    share = tried / total if total else 1.0
    seconds = (time.process_time() - began - ready) / share
    seconds += ready / max(tried, 1) * len(schemes)
    numbers = searched / share, found / share, seconds
    return BoxEstimate(cut(search), *numbers, exact=tried == total)


def _spread(total: int) -> Iterator[int]:
    """Numbers below a total, the first ones from everywhere; of many some may come twice.

    >>> list(_spread(8))
    [0, 5, 2, 7, 4, 1, 6, 3]
    """
    if total <= FEW:
        yield from sorted(range(total), key=lambda number: (number * GOLDEN) % 1.0)
    else:
        yield from (int(number * GOLDEN % 1.0 * total) for number in range(total - 1))
