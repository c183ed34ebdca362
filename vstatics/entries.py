"""Entries of linear systems: a value, and the size that tells its rounding error.

The size is the sum of the magnitudes that a value was made from. Its rounding error is
a few units in the last place of its size (running error analysis: Wilkinson 1963), so
an entry that is small against its size is zero.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

Number = Any
"""A float, or an array with a number per variant: the operators are the same for both."""
Entry = tuple[Number, Number]
"""A value and its size."""
Row = dict[int, Entry]
"""Column -> entry of the equation ``sum(a_j x_j) = b``; b stands in column `RIGHT`."""

RIGHT = -1
ZERO = 32 * float(np.finfo(np.float64).eps)
"""An entry is zero when its value is at most this part of its size."""


def is_zero(value: Number, size: Number) -> Any:
    """Whether a value is no more than rounding; not where its size has overflowed."""
    rounding = ZERO * size
    return ((abs(value) <= rounding) & (rounding < math.inf)) | (value == 0)


def quotient(entry: Entry, pivot: Entry) -> Entry:
    """An entry divided by another."""
    value, size = entry
    ratio = value / pivot[0]
    return ratio, size / abs(pivot[0]) + abs(ratio) * (pivot[1] / abs(pivot[0]))


def subtract(row: Row, factor: Entry, other: Row, drops: Callable[[Entry], bool]) -> None:
    """Take ``factor * other`` from `row`, in place, without the entries that `drops`."""
    value, size = factor
    for column, (term, term_size) in other.items():
        old, old_size = row.pop(column, (0.0, 0.0))
        entry = old - value * term, old_size + size * abs(term) + abs(value) * term_size
        if not drops(entry):
            row[column] = entry
