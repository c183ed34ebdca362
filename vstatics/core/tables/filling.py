"""Division of items into rows, columns or pages of limited size."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TypeVar

_Item = TypeVar("_Item")


def filled(
    items: Iterable[_Item], room: float, size: Callable[[_Item], float], gap: float = 0.0
) -> Iterator[list[_Item]]:
    """Yield lists of consecutive items, as many as fit in `room` with gaps, but at least one.

    Without items, a single empty list is yielded.

    >>> [*filled([2, 2, 2, 9], 5, float)], [*filled([2, 2, 2], 5, float, gap=2)]
    ([[2, 2], [2], [9]], [[2], [2], [2]])
    """
    row, taken = list[_Item](), 0.0
    for item in items:
        needed = size(item)
        if row and taken + needed > room:
            yield row
            row, taken = [], 0.0
        row.append(item)
        taken += needed + gap
    yield row
