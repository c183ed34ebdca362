"""Partial search of some choices of input and output (ports), to estimate a search and its time.

Only a sample of the sets of shift elements is listed and examined, and the results are scaled to
all sets. Work is counted in steps, equal on every machine, and converted to seconds by the
constants below, which were measured on one machine.
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
from vstatics.synthesis.boxes.search.elements import some_sets
from vstatics.synthesis.boxes.search.engaged import combinations_table
from vstatics.synthesis.boxes.search.kernel import SetSample, boxes_in, find_gears

JOIN, CELL, SEQUENCE_CELL = 0.4e-6, 16e-6, 60e-6
"""Times for an attempt to add elements to a set of shift elements, and for examining a cell (ranges
of gear-set ratios) for wanted ratios or for a sequence of gears. [s]
"""
SET = 2e-6
"""Time to examine a set of shift elements, in addition to the time for the cells of ratios. [s]"""
PORT, PORT_GEAR = 0.2e-3, 0.04e-6
"""Times to prepare a choice of input and output: a constant, and per combination of elements. [s]
"""
SCHEME, SCHEME_GEAR = 1e-3, 0.45e-6
"""Times to prepare a scheme without the ports: a constant, and per combination of elements. [s]"""
ELEMENT_SETS = 10_000
"""Number of sets of shift elements for which the work arrays have room."""
GOLDEN = 0.6180339887498949
"""Golden ratio minus 1; its multiples modulo 1 are evenly spread from 0 to 1.
"""


class Depth(NamedTuple):
    """Limits of the partial search of a choice of input and output."""

    firsts: int
    """Approximate number of first combinations from which sets of shift elements are built."""
    sets: int
    """Approximate number of the listed sets of shift elements that are examined."""
    seconds: float
    """Approximate limit of the total time to list and examine sets. [s]"""


class Work(NamedTuple):
    """Times of the stages of searching a choice of input and output [s]."""

    gears: float
    """Time to calculate the ratios, and the targets (wanted ratios) that each reaches."""
    sets: float
    """Time to list the sets of shift elements."""
    boxes: float
    """Time to examine the sets of shift elements."""


class Tried(NamedTuple):
    """Result of the partial search of a choice of input and output."""

    searched: int
    """Number of gearboxes that a full search would examine for this input and output."""
    found: float
    """Estimated number of gearboxes with the wanted ratios."""
    whole: Work
    """Expected time of the full search, from the number of steps."""
    spent: Work
    """Expected time of the partial search, from the number of steps."""
    seconds: Work
    """Measured time of the partial search."""
    is_whole: bool
    """True if the partial search was completed; otherwise `whole` is too small."""


def tried(ports: PortSearch, first: int, last: int, depth: Depth) -> Tried:
    """Search a choice of input and output partially, within limits."""
    search, before = ports.search, ports.searched
    port = ports.gears_of(first, last)
    room, table = room_of(search, ELEMENT_SETS, get_ident()), ports.table
    asked = asked_arrays(search)
    cell = CELL if search.sequence is None else SEQUENCE_CELL
    sets, joins, cells = room.ports.sets, room.ports.sets.steps, room.cells.steps
    joins[:] = 0, depth.seconds / 2 / JOIN
    cells[:] = 0, depth.seconds / 2 / cell
    times = [time.process_time()]
    may_have = find_gears(table, ports.gears, port, asked, room.ports)
    times.append(time.process_time())
    count, share = some_sets(table, port, sets, depth.firsts) if may_have else (0, 1.0)
    if count < 0:
        count = ELEMENT_SETS
    times.append(time.process_time())
    boxes, looked_at, _ = boxes_in(table, port, asked, room, SetSample(count, depth.sets))
    times.append(time.process_time())
    of_sets = looked_at / count if count else 1.0
    ports_time = PORT + PORT_GEAR * len(table.members)
    spent = Work(ports_time, JOIN * joins[0], SET * looked_at + cell * cells[0])
    return Tried(
        ports.searched - before,
        boxes / share / of_sets,
        Work(ports_time, spent.sets / share, spent.boxes / share / of_sets),
        spent,
        Work(*(end - begin for begin, end in pairwise(times))),
        bool(joins[0] < joins[1] and cells[0] < cells[1]),
    )


class DrawnPorts(NamedTuple):
    """Choice of input and output drawn for a sample."""

    scheme: BoxScheme
    ports: Ports
    stands: float
    """Number of choices that the drawn choice represents."""


def drawn(search: BoxSearch) -> Iterator[DrawnPorts | None]:
    """Yield an endless sample of choices of input and output, spread evenly over the schemes.

    None marks a stem (scheme with one gear set less) that has no schemes.
    """
    search_stems = stems(search)
    total = search_stems.total
    number = 0
    while True:
        number += 1
        place = int(number * GOLDEN % 1.0 * total)
        stem = search_stems.at(place)
        schemes = search_stems.schemes(stem) if total else []
        choices = sum(len(scheme.ports) for scheme in schemes)
        if not choices:
            yield None
            continue
        first = search_stems.before(stem)
        weight = search_stems.before(stem + 1) - first
        chosen = (place - first) * choices // weight
        for scheme in schemes:
            if chosen < len(scheme.ports):
                yield DrawnPorts(scheme, scheme.ports[chosen], total / weight * choices)
                break
            chosen -= len(scheme.ports)


def scheme_cost(search: BoxSearch) -> float:
    """Return the time to calculate the link speeds in all gears of a scheme, for all ports [s]."""
    table = combinations_table(search.moving, search.engaged, search.elements)
    return SCHEME + SCHEME_GEAR * len(table.members)
