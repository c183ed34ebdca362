"""Choices of ports that are tried before a search, in part: how many boxes, how long it takes.

Of the sets of elements of a choice some are listed, and of these some are looked at; what they
take stands for all. It is counted by the steps of the search, which are the same everywhere,
and told in the seconds that they take on the machine on which they were measured.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from itertools import pairwise
from threading import get_ident
from typing import NamedTuple

from vstatics.synthesis.boxes.batches.arrays import asked_arrays, room_of
from vstatics.synthesis.boxes.batches.ports import PortSearch
from vstatics.synthesis.boxes.box import BoxSearch
from vstatics.synthesis.boxes.schemes.choices import BoxScheme, Ports
from vstatics.synthesis.boxes.schemes.stems import stems
from vstatics.synthesis.boxes.search.elements import begun
from vstatics.synthesis.boxes.search.engaged import combinations_table
from vstatics.synthesis.boxes.search.kernel import find_gears
from vstatics.synthesis.boxes.search.trying import Some, some_boxes, some_sequences, some_sets

JOIN, CELL, SEQUENCE_CELL = 0.4e-6, 16e-6, 60e-6
"""What the steps of a search take: something joins a set, a cell is looked at. [s]"""
SET = 2e-6
"""Time to look at a set of elements, in addition to that for its cells. [s]"""
PORT, PORT_GEAR = 0.2e-3, 0.04e-6
"""What a choice of ports takes, and each combination of elements in it. [s]"""
SCHEME, SCHEME_GEAR = 1e-3, 0.45e-6
"""The same of a scheme, whatever its ports. [s]"""
ELEMENT_SETS = 10_000
"""There is room for so many sets of elements."""
GOLDEN = 0.6180339887498949
"""Multiples of it are spread evenly: so what is tried comes from everywhere."""


class Depth(NamedTuple):
    """How far a choice of ports is tried."""

    firsts: int
    """Of the combinations that come first in sets, about so many."""
    sets: int
    """Of the sets that have these, about so many."""
    seconds: float
    """About so long at most, for both. [s]"""


class Work(NamedTuple):
    """How long parts of the work on a choice of ports take [s]."""

    gears: float
    """To find its ratios, and which combinations reach a target."""
    sets: float
    """To list its sets of elements."""
    boxes: float
    """To look at these."""


class Tried(NamedTuple):
    """What is known of a choice of ports that was tried."""

    searched: int
    """Boxes that there are."""
    found: float
    """Boxes with the ratios, about."""
    whole: Work
    """What all of it takes, by its steps."""
    spent: Work
    """What was tried takes, by its steps."""
    seconds: Work
    """That it took."""
    is_whole: bool
    """Whether what was tried was tried to its end; else it takes longer."""


def tried(ports: PortSearch, first: int, last: int, depth: Depth) -> Tried:
    """Try a choice of ports."""
    search, before = ports.search, ports.searched
    port = ports.gears_of(first, last)
    room, table = room_of(search, ELEMENT_SETS, get_ident()), ports.table
    asked = asked_arrays(search)
    cells, cell, some = room.cells.steps, CELL, some_boxes
    if search.sequence is not None:
        cells, cell, some = room.sequences.steps, SEQUENCE_CELL, some_sequences
    joins = room.sets.steps
    joins[:] = 0, depth.seconds / 2 / JOIN
    cells[:] = 0, depth.seconds / 2 / cell
    times = [time.process_time()]
    find_gears(table, ports.gears, port, asked, room)
    may_have = begun(table, port, room.sets)
    times.append(time.process_time())
    count, share = some_sets(table, port, room.sets, depth.firsts) if may_have else (0, 1.0)
    times.append(time.process_time())
    found, looked_at = some(table, port, asked, room, Some(count, depth.sets))
    times.append(time.process_time())
    of_sets = looked_at / count if count else 1.0
    own = PORT + PORT_GEAR * len(table.members)
    spent = Work(own, JOIN * joins[0], SET * looked_at + cell * cells[0])
    return Tried(
        ports.searched - before,
        found / share / of_sets,
        Work(own, spent.sets / share, spent.boxes / share / of_sets),
        spent,
        Work(*(end - begin for begin, end in pairwise(times))),
        bool(joins[0] < joins[1] and cells[0] < cells[1]),
    )


class DrawnPorts(NamedTuple):
    """A choice of ports from somewhere, or none where there are no schemes."""

    scheme: BoxScheme
    ports: Ports
    stands: float
    """For so many choices, where it is the only one that is drawn."""


def drawn(search: BoxSearch) -> Iterator[DrawnPorts | None]:
    """Choices of ports from everywhere, without end: even along the weights of stems."""
    found = stems(search)
    total = found.total
    number = 0
    while True:
        number += 1
        place = int(number * GOLDEN % 1.0 * total)
        stem = found.at(place)
        schemes = found.schemes(stem) if total else []
        choices = sum(len(one.ports) for one in schemes)
        if not choices:
            yield None
            continue
        first = found.before(stem)
        weight = found.before(stem + 1) - first
        chosen = (place - first) * choices // weight
        for one in schemes:
            if chosen < len(one.ports):
                yield DrawnPorts(one, one.ports[chosen], total / weight * choices)
                break
            chosen -= len(one.ports)


def scheme_cost(search: BoxSearch) -> float:
    """What a scheme takes whatever its ports [s], where its speeds in all gears are found."""
    table = combinations_table(search.moving, search.engaged, search.elements)
    return SCHEME + SCHEME_GEAR * len(table.members)
