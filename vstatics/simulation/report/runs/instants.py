"""Choice of the instants of a run on a page, so that straight lines between them are accurate."""

from __future__ import annotations

import heapq
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats, Integers

NEAR = 5e-4
"""Allowed deviation of straight lines from a column, relative to the column's range.

This is half of a visible difference.
"""


class ChosenInstants(NamedTuple):
    """Chosen instants of a run."""

    mask: Booleans
    """True for each chosen instant."""
    off: float
    """Largest deviation of the lines from a column, relative to the column's range. [-]"""


def chosen_instants(
    times: Floats, columns: Floats, most: int, must: Floats | tuple[float, ...] = ()
) -> ChosenInstants:
    """Choose instants between which straight lines draw the columns, largest deviation first.

    Always chosen are ends, jumps, extremes of each column, required times, and both neighbours of
    undefined values.

    Parameters
    ----------
    times : ndarray, shape (instants,)
        Sorted times; an instant of a jump appears twice. [s]
    columns : ndarray, shape (instants, columns)
    most : int
        Largest number of instants, exceeded only by instants that are always chosen.
    must : sequence of float
        Times whose nearest instants are required. [s]

    Examples
    --------
    >>> time = np.linspace(0.0, 1.0, 1001)
    >>> bent = np.column_stack([np.abs(time - 0.25), np.ones(1001)])
    >>> time[chosen_instants(time, bent, 100).mask].tolist()
    [0.0, 0.25, 1.0]
    """
    is_finite = np.isfinite(columns)
    values = np.where(is_finite, columns, 0.0)
    size = np.ptp(values, axis=0)
    size[size == 0] = np.inf
    chosen = np.zeros(len(times), dtype=bool)
    chosen[[0, -1]] = True
    edges = (times[1:] == times[:-1]) | (is_finite[1:] != is_finite[:-1]).any(axis=1)
    chosen[1:] |= edges
    chosen[:-1] |= edges
    chosen[values.argmax(axis=0)] = True
    chosen[values.argmin(axis=0)] = True
    for required in must:
        chosen[np.flatnonzero(times == times[np.abs(times - required).argmin()])] = True
    parts = values / size
    gaps = list(_gaps(np.flatnonzero(chosen), times, parts))
    heapq.heapify(gaps)
    count = int(chosen.sum())
    while gaps and count < most and -gaps[0][0] > NEAR:
        _, first, place, last = heapq.heappop(gaps)
        chosen[place] = True
        count += 1
        for gap in _gaps(np.array([first, place, last]), times, parts):
            heapq.heappush(gaps, gap)
    return ChosenInstants(chosen, -gaps[0][0] if gaps else 0.0)


_Gap = tuple[float, int, int, int]
"""Interval: minus its largest deviation, and indices of its first, farthest and last instant."""


def _gaps(chosen: Integers, times: Floats, values: Floats) -> Iterator[_Gap]:
    """Yield the intervals between consecutive chosen instants, if they contain other instants."""
    for first, last in zip(chosen[:-1].tolist(), chosen[1:].tolist(), strict=True):
        inner = slice(first + 1, last)
        if last - first < 2 or times[first] == times[last]:
            continue
        part = ((times[inner] - times[first]) / (times[last] - times[first]))[:, None]
        line = values[first] + part * (values[last] - values[first])
        far = np.abs(values[inner] - line).max(axis=1, initial=0.0)
        place = int(far.argmax())
        yield -float(far[place]), first, first + 1 + place, last
