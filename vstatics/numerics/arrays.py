"""Types of arrays of any shape (importing numpy.typing would cost start-up time); lists in one."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

Floats = np.ndarray[Any, np.dtype[np.float64]]
Integers = np.ndarray[Any, np.dtype[np.integer[Any]]]
Booleans = np.ndarray[Any, np.dtype[np.bool_]]


def counted(lengths: Integers) -> tuple[Integers, Integers]:
    """Of lists one behind the other: the list of each item, and its place there from 0.

    >>> [one.tolist() for one in counted(np.array([2, 0, 3]))]
    [[0, 0, 2, 2, 2], [0, 1, 0, 1, 2]]
    """
    which = np.repeat(np.arange(len(lengths)), lengths)
    return which, np.arange(len(which)) - (np.cumsum(lengths) - lengths)[which]


def portions(lengths: Integers, most: int) -> Iterator[slice]:
    """Which lists are taken together: no more than so many items, and one list at least.

    >>> list(portions(np.array([2, 0, 3, 9, 1]), 5))
    [slice(0, 3, None), slice(3, 4, None), slice(4, 5, None)]
    """
    ends, start, done = np.cumsum(lengths), 0, 0
    while start < len(ends):
        end = max(int(np.searchsorted(ends, done + most, "right")), start + 1)
        yield slice(start, end)
        start, done = end, int(ends[end - 1])
