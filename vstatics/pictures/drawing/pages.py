"""Division of the rows of a picture into pages."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
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
