"""About how many boxes a search looks at and finds, and how long it takes."""

from __future__ import annotations

import time
from typing import NamedTuple

from vstatics.synthesis.boxes.batches.cut import PIECE
from vstatics.synthesis.boxes.batches.found import prepare
from vstatics.synthesis.boxes.batches.ports import PortSearch
from vstatics.synthesis.boxes.batches.tried import Depth, Tried, Work, drawn, tried
from vstatics.synthesis.boxes.box import BoxSearch
from vstatics.synthesis.boxes.schemes.stems import UNIT, box_schemes, stems
from vstatics.synthesis.boxes.search.joining import NO_END

ENOUGH = 3.0
"""So long choices of ports are tried. [s]"""
FEW_SCHEMES, FEW_PORTS = 40, 300
"""Of so many all are tried, as long as that takes less than a third of it."""
LEAST_WORK = 1e-9
"""Less than any step takes. [s]"""
DEPTH = Depth(firsts=16, sets=24, seconds=0.5)


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
    at_least: bool
    """Whether some of it takes so long that it was not tried to its end."""


def box_estimate(search: BoxSearch) -> BoxEstimate:
    """About how many boxes there are, and how long they take, in some seconds of a processor.

    Parameters
    ----------
    search : BoxSearch
        A sound one, see `check_box_search`.
    """
    prepare(search)
    return _of_all(search) or _of_some(search)


def _of_all(search: BoxSearch) -> BoxEstimate | None:
    """What a small search gives, as it gives that; nothing of one that takes long."""
    if stems(search).total > FEW_SCHEMES * UNIT:
        return None
    schemes = [*box_schemes(search)]
    if sum(len(one.ports) for one in schemes) > FEW_PORTS:
        return None
    began = time.process_time()
    searched, found, whole = 0, 0.0, Depth(firsts=NO_END, sets=NO_END, seconds=ENOUGH / 3)
    for one in schemes:
        ports = PortSearch(search, one)
        for first, last in one.ports:
            seen = tried(ports, first, last, whole)
            if not seen.is_whole or time.process_time() - began > ENOUGH / 3:
                return None
            searched, found = searched + seen.searched, found + seen.found
    seconds = time.process_time() - began
    pieces = max(int(seconds / PIECE), 1)
    return BoxEstimate(pieces, searched, found, seconds, exact=True, at_least=False)


def _of_some(search: BoxSearch) -> BoxEstimate:
    """What some choices of ports tell of all; those of a scheme share what it takes alone."""
    began = time.process_time()
    seen: list[tuple[float, Tried]] = []
    count, ready = 0, 0.0
    for one in drawn(search):
        count += 1
        if one is not None:
            before = time.process_time()
            ports = PortSearch(search, one.scheme)
            ready += (time.process_time() - before) * one.stands / len(one.scheme.ports)
            seen.append((one.stands, tried(ports, *one.ports, DEPTH)))
        if time.process_time() - began > ENOUGH:
            break
    boxes, found = (
        sum(stands * getattr(part, name) for stands, part in seen) / count
        for name in ("searched", "found")
    )
    seconds = ready / count
    for place in range(len(Work._fields)):  # each has a pace of its own on this machine
        took = sum(part.seconds[place] for _, part in seen)
        pace = took / max(sum(part.spent[place] for _, part in seen), LEAST_WORK)
        seconds += pace * sum(stands * part.whole[place] for stands, part in seen) / count
    choices = sum(stands for stands, _ in seen) / count
    pieces = max(int(min(seconds / PIECE, choices)), 1)
    at_least = not all(part.is_whole for _, part in seen)
    return BoxEstimate(pieces, boxes, found, seconds, exact=False, at_least=at_least)
