"""Arrays for the compiled search: wanted ratios and tolerances, and work arrays."""

from __future__ import annotations

from functools import cache, lru_cache

import numpy as np

from vstatics.core.numerics.arrays import Integers
from vstatics.synthesis.boxes.box import LARGEST_BOX_RATIO, BoxSearch
from vstatics.synthesis.boxes.search.engaged import combinations_table, integers
from vstatics.synthesis.boxes.search.joining import set_room
from vstatics.synthesis.boxes.search.kernel import FoundRoom, PortRoom, Room, RoomOfSequences
from vstatics.synthesis.boxes.search.ranges import lines
from vstatics.synthesis.boxes.search.sequences.room import sequence_of, sequence_room
from vstatics.synthesis.boxes.search.set_ratios import Asked
from vstatics.synthesis.boxes.search.shifts import neighbours
from vstatics.synthesis.boxes.search.solving import cell_room
from vstatics.synthesis.tolerances import TARGET_MARGIN


@cache
def asked_arrays(search: BoxSearch) -> Asked:
    """Return the wanted ratios of a search, their tolerance ranges and the bounds, as arrays."""
    targets = np.array(search.targets, dtype=float)
    widths = np.array(search.widths)
    factors = np.exp(widths + TARGET_MARGIN)
    ends = np.sort([targets / factors, targets * factors], axis=0)
    # The additional target represents the sequence: every forward ratio is in its range.
    if search.sequence is not None:
        ends = np.append(ends, [[1 / LARGEST_BOX_RATIO], [LARGEST_BOX_RATIO]], axis=1)
    return Asked(targets, ends[0], ends[1], widths, *search.bounds)


def single_shifts(search: BoxSearch) -> Integers:
    """Return the pairs of targets (wanted gears) that must differ by a single shift element."""
    in_turn = search.singly and search.sequence is None
    return neighbours(search.targets if in_turn else ())


@lru_cache(maxsize=32)
def room_of(search: BoxSearch, most: int, thread: int) -> Room | RoomOfSequences:  # noqa: ARG001
    """Return the work arrays for one choice of input and output, separate for each thread."""
    table = combinations_table(search.moving, search.engaged, search.elements)
    asked = asked_arrays(search)
    wanted = sequence_of(search.sequence, singly=search.singly)
    targets, sets, speeds = len(asked.targets), search.sets, len(table.members)
    ports = PortRoom(
        sets=set_room(table, targets, most),
        lines=lines(sets),
        ratios=np.zeros((speeds, 2, 2**sets)),
        within=np.zeros(speeds),
        kinds=integers(speeds),
        parts=np.zeros((len(table.places), 2, 2**sets)),
    )
    found = FoundRoom(
        lengths=integers(most),
        gears=integers(most, targets + wanted.most),
        logs=np.zeros((most, sets)),
        errors=np.zeros(most),
    )
    if search.sequence is None:
        return Room(ports, cell_room(table, asked, sets, single_shifts(search)), found)
    return RoomOfSequences(ports, sequence_room(table, asked, wanted, sets), found)
