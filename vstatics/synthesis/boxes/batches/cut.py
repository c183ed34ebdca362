"""Division of a search into pieces of equal work, for any number of worker processes.

Schemes grow from stems, which are schemes with one gear set less. The stems are laid end to end on
a line, each as long as its estimated work, and the line is cut into equal pieces. A piece that
covers a fraction of a stem contains this fraction of the choices of input and output (ports) of its
schemes.
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
"""Estimated time of a piece, in a short search and in a long search. [s]"""
MOST_SHORT_PIECES = 2000
"""Largest number of pieces of length `PIECE`. Longer searches have longer pieces."""
SAMPLED_CHOICES = 24
"""Number of choices of input and output in the sample that estimates the total time."""
DEPTH = Depth(firsts=8, sets=12, seconds=0.2)
"""Limits for searching each choice of input and output in the sample."""


def cut(search: BoxSearch) -> int:
    """Return the number of pieces, each with at least one choice of input and output.

    >>> cut(BoxSearch(1, 2, 1, (3.0, 1.0)))
    1
    """
    cost = choices = 0.0
    for drawing in islice(drawn(search), SAMPLED_CHOICES):
        if drawing is not None:
            trial = tried(PortSearch(search, drawing.scheme), *drawing.ports, DEPTH)
            seconds = sum(trial.whole) + scheme_cost(search) / len(drawing.scheme.ports)
            cost += drawing.stands / SAMPLED_CHOICES * seconds
            choices += drawing.stands / SAMPLED_CHOICES
    pieces = max(min(cost / PIECE, MOST_SHORT_PIECES), cost / LONGEST_PIECE)
    return max(int(min(pieces, choices)), 1)


def ranges(search: BoxSearch, piece: int, count: int) -> Iterator[BoxScheme]:
    """Yield the schemes of a piece, each with the choices of input and output in the piece.

    Parameters
    ----------
    search : BoxSearch
    piece : int
        Number of the piece, from 0.
    count : int
        Total number of pieces.

    Examples
    --------
    >>> search = BoxSearch(1, 2, 1, (3.0, 1.0))
    >>> [scheme.ports for piece in range(2) for scheme in ranges(search, piece, 2)]
    [((0, 1), (0, 2), (1, 0)), ((1, 2), (2, 0), (2, 1))]
    """
    search_stems = stems(search)
    first, last = (search_stems.total * number // count for number in (piece, piece + 1))
    stem = search_stems.at(first)
    while (start := search_stems.before(stem)) < last:
        weight = search_stems.before(stem + 1) - start
        if weight:
            yield from _part(search_stems.schemes(stem), first - start, last - start, weight)
        stem += 1


def _part(schemes: list[BoxScheme], first: int, last: int, weight: int) -> Iterator[BoxScheme]:
    """Yield the schemes of a stem, with the choices of ports in a range of the stem's weight."""
    total = sum(len(scheme.ports) for scheme in schemes)
    low, high = (min(max(place, 0), weight) * total // weight for place in (first, last))
    for scheme in schemes:
        ports = scheme.ports[max(low, 0) : max(high, 0)]
        if ports:
            yield scheme._replace(ports=ports)
        low, high = low - len(scheme.ports), high - len(scheme.ports)
