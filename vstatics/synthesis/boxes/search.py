"""The boxes that a search finds, in Python: pieces, figures and order in one call."""

from __future__ import annotations

from typing import NamedTuple

from vstatics.errors import CaseError
from vstatics.extras import require
from vstatics.synthesis.boxes.box import EFFICIENCY, BoxSearch
from vstatics.synthesis.boxes.checks import check_box_search
from vstatics.synthesis.boxes.choice import BoxFilter, RankedBox, ranked
from vstatics.synthesis.boxes.figures import measured

ALL = BoxFilter()


class BoxList(NamedTuple):
    """What a search found."""

    searched: int
    """Boxes that were looked at."""
    boxes: tuple[RankedBox, ...]
    """Those that are wanted, in their order."""
    given_up: int
    """Sets of elements that may be boxes, too, but could not be looked at to the end."""


def find_boxes(
    search: BoxSearch, efficiency: float = EFFICIENCY, wanted: BoxFilter = ALL
) -> BoxList:
    """Find all gearboxes whose gears have wanted ratios, in this process.

    Parameters
    ----------
    search : BoxSearch
    efficiency : float
        Of each set with its carrier held, above 0 and up to 1. [-]
    wanted : BoxFilter
        All boxes when not given.

    Raises
    ------
    CaseError
        If the search can't be, or the library that compiles it is missing.

    Examples
    --------
    A set with its ring held makes 1 + p, and direct drive when it is locked in any way:

    >>> found = find_boxes(BoxSearch(1, 2, 1, (3.0, 1.0)))
    >>> found.searched, [list(one.found.elements) for one in found.boxes]
    (36, [['T-L2', 'F-L0-L1'], ['T-L2', 'F-L0-L2'], ['T-L2', 'F-L1-L2']])
    """
    require("boxes", "the search for gearboxes")
    from vstatics.synthesis.boxes.pieces import cut, found_in  # compiles

    low, high = search.bounds
    search = search._replace(targets=tuple(search.targets), bounds=(low, high))
    check_box_search(search)
    if not 0 < efficiency <= 1:
        message = f"read {efficiency:g}, expected a number above 0, up to 1"
        raise CaseError(message, ("efficiency",))
    pieces = [found_in(search, piece) for piece in range(cut(search))]
    boxes = (measured(search, box, efficiency) for piece in pieces for box in piece.boxes)
    searched = sum(piece.searched for piece in pieces)
    given_up = sum(piece.given_up for piece in pieces)
    return BoxList(searched, ranked(search, boxes, wanted), given_up)
