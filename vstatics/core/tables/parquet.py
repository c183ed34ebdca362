"""Row groups of Parquet files that are written from many small tables."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TypeVar

T = TypeVar("T")

GROUP = 262_144
"""Number of rows from which a row group is complete."""


def row_groups(tables: Iterable[T], rows: Callable[[T], int]) -> Iterator[list[T]]:
    """Yield lists of consecutive tables. Each but the last is large enough for a row group.

    Parameters
    ----------
    tables : iterable
    rows : callable
        Function that returns the number of rows of a table.
    """
    group, count = list[T](), 0
    for table in tables:
        group.append(table)
        count += rows(table)
        if count >= GROUP:
            yield group
            group, count = [], 0
    if group:
        yield group
