"""Rainflow counting of the cycles of a record, ASTM E1049-85, 5.4.4."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.core.tables.answer import json_keys


@json_keys("range", "mean", count="counted")
class LoadCycle(NamedTuple):
    """Cycle of a record, with the number of its repetitions."""

    range: float
    """Largest minus smallest value in the cycle, in the unit of the record."""
    mean: float
    counted: float
    """Number of equal cycles; a range that is not closed counts 0.5."""

    @property
    def amplitude(self) -> float:
        """Half the range."""
        return self.range / 2


def extremes(values: Floats) -> Floats:
    """Return the turning points of a record, including both ends.

    A constant record has no turning points.

    >>> extremes(np.array([0.0, 1, 1, 2, 2, -1, 0])).tolist()
    [0.0, 2.0, -1.0, 0.0]
    """
    changed = values[np.append(True, np.diff(values) != 0)] if len(values) else values
    if len(changed) < 2:
        return changed[:0]
    turns = np.diff(np.sign(np.diff(changed))) != 0
    turning: Floats = changed[np.concatenate([[True], turns, [True]])]
    return turning


def rainflow(values: Floats) -> list[LoadCycle]:
    """Return the cycles of a record, sorted by range, with equal cycles combined.

    Examples
    --------
    In the example of the standard, ranges 3, 4, 6, 8, 9 are counted 0.5, 1.5, 0.5, 1, 0.5 times.

    >>> [(c.range, c.counted) for c in rainflow(np.array([-2.0, 1, -3, 5, -1, 3, -4, 4, -2]))]
    [(3.0, 0.5), (4.0, 0.5), (4.0, 1.0), (6.0, 0.5), (8.0, 0.5), (8.0, 0.5), (9.0, 0.5)]
    """
    counts = defaultdict[tuple[float, float], float](float)
    for first, second, count in _counted(extremes(values).tolist()):
        counts[abs(second - first), (first + second) / 2] += count
    return [LoadCycle(*key, count) for key, count in sorted(counts.items())]


def _counted(turning: Iterable[float]) -> Iterator[tuple[float, float, float]]:
    """Yield the first and last value of each range, and its count: 1 if closed, otherwise 0.5."""
    open_: list[float] = []
    for value in turning:
        open_.append(value)
        while len(open_) > 2:
            start, end, last = open_[-3:]
            if abs(last - end) < abs(end - start):
                break
            if len(open_) == 3:  # the range contains the first point of the record
                yield start, end, 0.5
                del open_[0]
            else:
                yield start, end, 1.0
                del open_[-3:-1]
    yield from ((start, end, 0.5) for start, end in pairwise(open_))
