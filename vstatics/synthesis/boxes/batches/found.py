"""Gearboxes found in a piece of a search."""

from __future__ import annotations

from typing import NamedTuple

from vstatics.synthesis.boxes.batches.cut import DEPTH, ranges
from vstatics.synthesis.boxes.batches.ports import PortSearch
from vstatics.synthesis.boxes.batches.tried import tried
from vstatics.synthesis.boxes.box import BoxSearch, FoundBox, WantedSequence


class FoundPiece(NamedTuple):
    """Gearboxes found in a piece of a search."""

    searched: int
    """Number of examined gearboxes."""
    boxes: tuple[FoundBox, ...]
    given_up: int = 0
    """Number of sets of shift elements that were not examined completely, but could give gearboxes.
    """


def found_in(search: BoxSearch, piece: int = 0, count: int = 1) -> FoundPiece:
    """Search a piece for gearboxes.

    Parameters
    ----------
    search : BoxSearch
    piece : int
        Number of the piece, from 0.
    count : int
        Total number of pieces; by default the whole search is one piece.

    Examples
    --------
    A gear set with the ring held gives ratio 3 if p = 2; locked up, it gives ratio 1:

    >>> piece = found_in(BoxSearch(1, 2, 1, (3.0, 1.0)))
    >>> piece.searched, len(piece.boxes)
    (36, 3)
    """
    searched = given_up = 0
    boxes: list[FoundBox] = []
    for scheme in ranges(search, piece, count):
        ports = PortSearch(search, scheme)
        for first, last in scheme.ports:
            boxes += ports.boxes(first, last)
        searched += ports.searched
        given_up += ports.given_up
    return FoundPiece(searched, tuple(boxes), given_up)


def prepare(search: BoxSearch) -> None:
    """Compile the functions of a search, which takes ten seconds or more without a cache."""
    small = BoxSearch(1, 2, 1, (3.0, 1.0))
    if search.sequence is not None:
        gears = WantedSequence(2, 2, (1.0, 9.0), (1.0, 9.0))
        small = small._replace(targets=(), sequence=gears)
    [scheme] = ranges(small, 0, 1)
    ports = PortSearch(small, scheme)
    ports.boxes(0, 1)
    tried(ports, 0, 1, DEPTH)
