"""Grouping of items: by key in order of appearance, or into rows or pages of limited size."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator
from typing import TypeVar

_Key = TypeVar("_Key", bound=Hashable)
_Value = TypeVar("_Value")


def grouped(pairs: Iterable[tuple[_Key, _Value]]) -> dict[_Key, list[_Value]]:
    """Return a list of the values of each key.

    >>> grouped([("a", 1), ("b", 2), ("a", 3)])
    {'a': [1, 3], 'b': [2]}
    """
    groups: dict[_Key, list[_Value]] = {}
    for key, value in pairs:
        groups.setdefault(key, []).append(value)
    return groups


def filled(
    items: Iterable[_Value], room: float, size: Callable[[_Value], float], gap: float = 0.0
) -> Iterator[list[_Value]]:
    """Yield lists of consecutive items that fit in `room` with gaps, or of one item that does not.

    Without items, a single empty list is yielded.

    >>> [*filled([2, 2, 2, 9], 5, float)], [*filled([2, 2, 2], 5, float, gap=2)]
    ([[2, 2], [2], [9]], [[2], [2], [2]])
    """
    row, taken = list[_Value](), 0.0
    for item in items:
        needed = size(item)
        if row and taken + needed > room:
            yield row
            row, taken = [], 0.0
        row.append(item)
        taken += needed + gap
    yield row
