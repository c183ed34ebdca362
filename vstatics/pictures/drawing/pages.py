"""Division of the parts of a picture into rows, and of rows into pages."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from operator import itemgetter
from typing import TypeVar

Row = TypeVar("Row")


def pages_of(
    groups: Iterable[Sequence[Row]], room: float, high: Callable[[Sequence[Row]], float]
) -> Iterator[list[Row]]:
    """Yield the rows of each page. The rows of a group are on the same page if possible.

    Parameters
    ----------
    room : float
        Height of a page. [pt]
    high : callable
        Function that returns the height of rows below each other. [pt]

    Examples
    --------
    >>> [*pages_of([[3.0], [2.0, 2.0], [6.0, 6.0]], 8.0, sum)]
    [[3.0, 2.0, 2.0], [6.0], [6.0]]
    """
    page: list[Row] = []
    for group in groups:
        if page and high([*page, *group]) > room:
            yield page
            page = []
        for row in group:
            if page and high([*page, row]) > room:
                yield page
                page = []
            page.append(row)
    yield page


def divided(ends: Iterable[int], cost: Callable[[int, int], float]) -> list[range]:
    """Divide consecutive items into rows of the least total cost.

    Parameters
    ----------
    ends : iterable of int
        Numbers of items after which a row can end, ascending; the last is the number of all items.
    cost : callable
        Function that returns the cost of a row, from the index of its first item and the index
        after its last item.

    Examples
    --------
    >>> divided([1, 2, 3, 4], lambda start, end: 2 + (end - start) ** 2)
    [range(0, 2), range(2, 4)]
    >>> divided([1, 4], lambda start, end: 2 + (end - start) ** 2)
    [range(0, 1), range(1, 4)]
    """
    best, end = {0: (0.0, list[range]())}, 0
    for end in ends:
        ways = (
            (least + cost(start, end), [*rows, range(start, end)])
            for start, (least, rows) in best.items()
        )
        best[end] = min(ways, key=itemgetter(0))
    return best[end][1]
