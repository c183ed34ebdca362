"""Estimate of the gearboxes that a search examines and finds, and of its time."""

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
"""Time after which no further choice of input and output is sampled. [s]"""
FEW_SCHEMES, FEW_PORTS = 40, 300
"""Largest numbers of schemes, and of choices of input and output, of a search that is carried out
instead of estimated.
"""
LEAST_WORK = 1e-9
"""Lower limit of the expected time of all samples, to avoid a division by zero. [s]"""
DEPTH = Depth(firsts=16, sets=24, seconds=0.5)
"""Limits for searching each sampled choice of input and output."""


class BoxEstimate(NamedTuple):
    """Estimated size of a search."""

    pieces: int
    boxes: float
    """Number of gearboxes to examine."""
    found: float
    """Number of gearboxes with the wanted ratios."""
    seconds: float
    """Time of the search in a single process. [s]"""
    exact: bool
    """True if the whole search was carried out, so that the numbers of gearboxes are exact."""
    at_least: bool
    """True if sampled searches were aborted for lack of time, so that `seconds` is a lower bound.
    """


def box_estimate(search: BoxSearch) -> BoxEstimate:
    """Estimate the number of gearboxes and the time of a search, in a few seconds.

    Parameters
    ----------
    search : BoxSearch
        Valid search; see `check_box_search`.
    """
    prepare(search)
    return _of_all(search) or _of_some(search)


def _of_all(search: BoxSearch) -> BoxEstimate | None:
    """Carry out a small search completely, and return exact numbers.

    Return None for a large search.
    """
    if stems(search).total > FEW_SCHEMES * UNIT:
        return None
    schemes = [*box_schemes(search)]
    if sum(len(scheme.ports) for scheme in schemes) > FEW_PORTS:
        return None
    began = time.process_time()
    searched, boxes, whole = 0, 0.0, Depth(firsts=NO_END, sets=NO_END, seconds=ENOUGH / 3)
    for scheme in schemes:
        ports = PortSearch(search, scheme)
        for first, last in scheme.ports:
            trial = tried(ports, first, last, whole)
            if not trial.is_whole or time.process_time() - began > ENOUGH / 3:
                return None
            searched, boxes = searched + trial.searched, boxes + trial.found
    seconds = time.process_time() - began
    pieces = max(int(seconds / PIECE), 1)
    return BoxEstimate(pieces, searched, boxes, seconds, exact=True, at_least=False)


def _of_some(search: BoxSearch) -> BoxEstimate:
    """Extrapolate the counts and times from a sample of choices of input and output."""
    began = time.process_time()
    seen: list[tuple[float, Tried]] = []
    count, ready = 0, 0.0
    for drawing in drawn(search):
        count += 1
        if drawing is not None:
            before = time.process_time()
            ports = PortSearch(search, drawing.scheme)
            ready += (time.process_time() - before) * drawing.stands / len(drawing.scheme.ports)
            seen.append((drawing.stands, tried(ports, *drawing.ports, DEPTH)))
        if time.process_time() - began > ENOUGH:
            break
    boxes, with_ratios = (
        sum(stands * getattr(part, name) for stands, part in seen) / count
        for name in ("searched", "found")
    )
    seconds = ready / count
    # Scale the expected time of each stage by the measured speed of this machine.
    for place in range(len(Work._fields)):
        took = sum(part.seconds[place] for _, part in seen)
        pace = took / max(sum(part.spent[place] for _, part in seen), LEAST_WORK)
        seconds += pace * sum(stands * part.whole[place] for stands, part in seen) / count
    choices = sum(stands for stands, _ in seen) / count
    pieces = max(int(min(seconds / PIECE, choices)), 1)
    at_least = not all(part.is_whole for _, part in seen)
    return BoxEstimate(pieces, boxes, with_ratios, seconds, exact=False, at_least=at_least)
