"""Instants of a run that a page carries: so many that straight lines between them draw it."""

from __future__ import annotations

import heapq
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats, Integers

NEAR = 5e-4
"""Lines come so near to each column, by its range: half of what people see."""


class ChosenInstants(NamedTuple):
    """Some instants of a run."""

    kept: Booleans
    """Which of all."""
    off: float
    """So far lines between them are from the columns at most, by their ranges. [-]"""


def chosen_instants(
    times: Floats, columns: Floats, most: int, must: Floats | tuple[float, ...] = ()
) -> ChosenInstants:
    """The instants that draw columns, the farthest from the lines so far first.

    Ends, jumps, the extremes of each column, and times that must stay are among them. A number
    that does not exist begins and ends there, too.

    Parameters
    ----------
    times : ndarray, shape (instants,)
        In order; an instant of a jump stands twice. [s]
    columns : ndarray, shape (instants, columns)
    most : int
        So many at most, but for those that must stay.
    must : sequence of float
        Times near which the instants stay. [s]

    Examples
    --------
    >>> time = np.linspace(0.0, 1.0, 1001)
    >>> bent = np.column_stack([np.abs(time - 0.25), np.ones(1001)])
    >>> time[chosen_instants(time, bent, 100).kept].tolist()
    [0.0, 0.25, 1.0]
    """
    there = np.isfinite(columns)
    values = np.where(there, columns, 0.0)
    size = np.ptp(values, axis=0)
    size[size == 0] = np.inf
    kept = _needed(times, values, there)
    for one in must:
        kept[np.flatnonzero(times == times[np.abs(times - one).argmin()])] = True
    parts = values / size
    gaps = list(_gaps(np.flatnonzero(kept), times, parts))
    heapq.heapify(gaps)
    count = int(kept.sum())
    while gaps and count < most and -gaps[0][0] > NEAR:
        _, first, place, last = heapq.heappop(gaps)
        kept[place] = True
        count += 1
        for gap in _gaps(np.array([first, place, last]), times, parts):
            heapq.heappush(gaps, gap)
    return ChosenInstants(kept, -gaps[0][0] if gaps else 0.0)


def _needed(times: Floats, values: Floats, there: Booleans) -> Booleans:
    """Ends, jumps, extremes, where numbers begin to exist or cease."""
    kept = np.zeros(len(times), dtype=bool)
    kept[[0, -1]] = True
    edges = (times[1:] == times[:-1]) | (there[1:] != there[:-1]).any(axis=1)
    kept[1:] |= edges
    kept[:-1] |= edges
    kept[values.argmax(axis=0)] = True
    kept[values.argmin(axis=0)] = True
    return kept


_Gap = tuple[float, int, int, int]
"""How far the farthest instant is from its line, with the sign of a heap; the place of the first
instant, of the farthest, of the last."""


def _gaps(kept: Integers, times: Floats, values: Floats) -> Iterator[_Gap]:
    """Between each two instants; none where nothing is between them."""
    for first, last in zip(kept[:-1].tolist(), kept[1:].tolist(), strict=True):
        inner = slice(first + 1, last)
        if last - first < 2 or times[first] == times[last]:
            continue
        part = ((times[inner] - times[first]) / (times[last] - times[first]))[:, None]
        line = values[first] + part * (values[last] - values[first])
        far = np.abs(values[inner] - line).max(axis=1, initial=0.0)
        place = int(far.argmax())
        yield -float(far[place]), first, first + 1 + place, last
