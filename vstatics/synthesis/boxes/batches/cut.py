"""How a search is cut into pieces: ranges of schemes and their ports, alike for any workers.

Stems stand on a line, each as long as its weight; pieces are equal parts of the line. So much of
a stem as a piece has of its length, so many of its choices of ports are in the piece.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice

from vstatics.synthesis.boxes.batches.ports import PortSearch
from vstatics.synthesis.boxes.batches.tried import Depth, drawn, scheme_cost, tried
from vstatics.synthesis.boxes.box import BoxSearch
from vstatics.synthesis.boxes.schemes.choices import BoxScheme
from vstatics.synthesis.boxes.schemes.stems import stems

PIECE, LONGEST_PIECE = 0.5, 5.0
"""Time that a piece takes by the steps of a search; that of pieces in a long search. [s]"""
MOST_SHORT_PIECES = 2000
"""Number of pieces up to which they are short, so that an interrupted search has finished some."""
TRIED = 24
"""So many choices of ports tell how long all take."""
DEPTH = Depth(firsts=8, sets=12, seconds=0.2)


def cut(search: BoxSearch) -> int:
    """Return the number of pieces, each at least a choice of ports.

    >>> cut(BoxSearch(1, 2, 1, (3.0, 1.0)))
    1
    """
    cost = choices = 0.0
    for one in islice(drawn(search), TRIED):
        if one is not None:
            found = tried(PortSearch(search, one.scheme), *one.ports, DEPTH)
            own = sum(found.whole) + scheme_cost(search) / len(one.scheme.ports)
            cost += one.stands / TRIED * own
            choices += one.stands / TRIED
    pieces = max(min(cost / PIECE, MOST_SHORT_PIECES), cost / LONGEST_PIECE)
    return max(int(min(pieces, choices)), 1)


def ranges(search: BoxSearch, piece: int, count: int) -> Iterator[BoxScheme]:
    """The schemes of a piece, each with those of its ports that are in it.

    Parameters
    ----------
    search : BoxSearch
    piece : int
        From 0.
    count : int
        So many pieces there are.

    Examples
    --------
    >>> search = BoxSearch(1, 2, 1, (3.0, 1.0))
    >>> [one.ports for piece in range(2) for one in ranges(search, piece, 2)]
    [((0, 1), (0, 2), (1, 0)), ((1, 2), (2, 0), (2, 1))]
    """
    found = stems(search)
    first, last = (found.total * number // count for number in (piece, piece + 1))
    stem = found.at(first)
    while (start := found.before(stem)) < last:
        weight = found.before(stem + 1) - start
        if weight:
            yield from _part(found.schemes(stem), first - start, last - start, weight)
        stem += 1


def _part(schemes: list[BoxScheme], first: int, last: int, weight: int) -> Iterator[BoxScheme]:
    """What is from one place of a stem to another; it is as long as its weight."""
    total = sum(len(one.ports) for one in schemes)
    low, high = (min(max(place, 0), weight) * total // weight for place in (first, last))
    for one in schemes:
        ports = one.ports[max(low, 0) : max(high, 0)]
        if ports:
            yield one._replace(ports=ports)
        low, high = low - len(one.ports), high - len(one.ports)
