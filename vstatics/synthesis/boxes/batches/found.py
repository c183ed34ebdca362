"""What is found in a piece of a search."""

from __future__ import annotations

from typing import NamedTuple

from vstatics.synthesis.boxes.batches.cut import DEPTH, ranges
from vstatics.synthesis.boxes.batches.ports import PortSearch
from vstatics.synthesis.boxes.batches.tried import tried
from vstatics.synthesis.boxes.box import BoxSearch, FoundBox, WantedSequence


class FoundPiece(NamedTuple):
    """What a piece of the search found."""

    searched: int
    """Boxes that there are in it."""
    boxes: tuple[FoundBox, ...]
    given_up: int = 0
    """Sets of elements that may be boxes, too, but could not be looked at to the end."""


def found_in(search: BoxSearch, piece: int = 0, count: int = 1) -> FoundPiece:
    """What is found in a piece.

    Parameters
    ----------
    search : BoxSearch
    piece : int
        From 0.
    count : int
        So many pieces there are; all of the search is one.

    Examples
    --------
    A set with its ring held, where p = 2 makes 3, and one that is locked:

    >>> found = found_in(BoxSearch(1, 2, 1, (3.0, 1.0)))
    >>> found.searched, len(found.boxes)
    (36, 3)
    """
    searched = given_up = 0
    boxes: list[FoundBox] = []
    for one in ranges(search, piece, count):
        ports = PortSearch(search, one)
        for first, last in one.ports:
            boxes += ports.boxes(first, last)
        searched += ports.searched
        given_up += ports.given_up
    return FoundPiece(searched, tuple(boxes), given_up)


def prepare(search: BoxSearch) -> None:
    """Compile what a search needs, which takes ten seconds or more where it has not been kept."""
    small = BoxSearch(1, 2, 1, (3.0, 1.0))
    if search.sequence is not None:
        gears = WantedSequence(2, 2, (1.0, 9.0), (1.0, 9.0))
        small = small._replace(targets=(), sequence=gears)
    [one] = ranges(small, 0, 1)
    ports = PortSearch(small, one)
    ports.boxes(0, 1)
    tried(ports, 0, 1, DEPTH)
