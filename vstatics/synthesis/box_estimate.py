"""How long a search for boxes will take: some of its pieces are done, and timed."""

from __future__ import annotations

import time
from typing import NamedTuple

from vstatics.synthesis import box_pieces
from vstatics.synthesis.box import BoxSearch

ENOUGH = 3.0
"""So long pieces are tried. [s]"""
GOLDEN = 0.6180339887498949
"""Multiples of it are spread evenly: so pieces from everywhere come first."""


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
    """Whether all pieces were tried."""


def box_estimate(search: BoxSearch, enough: float = ENOUGH) -> BoxEstimate:
    """About how many boxes there are, and how long they take.

    Parameters
    ----------
    search : BoxSearch
        A sound one, see `check_box_search`.
    enough : float
        So long pieces are tried, one at least. [s]
    """
    pieces = box_pieces.cut(search)
    box_pieces.prepare()
    began = time.perf_counter()
    searched = found = tried = 0
    for piece in _spread(pieces):
        one = box_pieces.found_in(search, piece)
        searched, found, tried = searched + one.searched, found + len(one.boxes), tried + 1
        if time.perf_counter() - began > enough:
            break
    seconds = time.perf_counter() - began
    share = tried / max(pieces, 1) or 1.0
    numbers = searched / share, found / share, seconds / share
    return BoxEstimate(pieces, *numbers, exact=tried == pieces)


def _spread(pieces: int) -> list[int]:
    """All pieces, the first ones from everywhere.

    >>> _spread(8)
    [0, 5, 2, 7, 4, 1, 6, 3]
    """
    return sorted(range(pieces), key=lambda piece: (piece * GOLDEN) % 1.0)
