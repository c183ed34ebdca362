"""Choice of the instants that draw the columns of a run: extremes, and ends of chords.

In each part of a time step a column is approximated by the polynomial through its values at some
nodes. The second derivative gives the number of straight lines (chords) that draw it, and the first
derivative gives the extremes. The polynomials only choose instants; the values drawn at the
instants are calculated from states.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from vstatics.core.groups import grouped
from vstatics.core.numerics.arrays import Floats, Integers
from vstatics.simulation.tolerances import CHORD, EQUAL_EXTREMES, NO_RANGE

_NEAR_TOP = 0.1
"""Height below the highest node (or above the lowest) in which turning points are candidates.

The height is relative to the range of the column. [-]
"""
_NEWTON_OF_EXTREMES = 4
_MOST_CHORDS = 1e6
"""Square of the largest number of chords of a part; more would only draw a wild polynomial."""


class Curves(NamedTuple):
    """Columns of a run as polynomials over consecutive time intervals (parts)."""

    begins: Floats
    """Start times of the parts. [s]"""
    lengths: Floats
    """Durations of the parts. [s]"""
    nodes: tuple[float, ...]
    """Instants of the values, as fractions of the part, from 0 to 1."""
    values: Floats
    """Values at the nodes, shape (columns, parts, nodes)."""


def joined_curves(curves: Sequence[Curves]) -> list[Curves]:
    """Return curves in which the parts of all curves with the same nodes are joined."""
    by_nodes = grouped((curve.nodes, curve) for curve in curves)
    return [
        Curves(
            np.concatenate([part.begins for part in same]),
            np.concatenate([part.lengths for part in same]),
            nodes,
            np.concatenate([part.values for part in same], axis=1),
        )
        for nodes, same in by_nodes.items()
    ]


class CurveRanges(NamedTuple):
    """Least and largest value of each column; `size` is infinite for constant columns."""

    least: Floats
    largest: Floats
    size: Floats


def ranges(
    curves: Sequence[Curves], kinds: Sequence[slice], before: CurveRanges | None = None
) -> CurveRanges:
    """Return the ranges of columns; a column with negligible changes counts as constant.

    Parameters
    ----------
    kinds : sequence of slice
        Groups of columns of the same quantity.
    before : CurveRanges, optional
        Ranges of an earlier part of the run, which the result includes.
    """
    least = np.fmin.reduce([np.fmin.reduce(part.values, axis=(1, 2)) for part in curves])
    largest = np.fmax.reduce([np.fmax.reduce(part.values, axis=(1, 2)) for part in curves])
    if before is not None:
        least, largest = np.fmin(least, before.least), np.fmax(largest, before.largest)
    size = largest - least
    for kind in kinds:
        sizes = np.fmax(np.abs(largest[kind]), np.abs(least[kind]))
        near = NO_RANGE * np.fmax.reduce(sizes, initial=0.0)
        size[kind] = np.where(size[kind] > near, size[kind], np.inf)
    return CurveRanges(least, largest, np.where(np.isfinite(size), size, np.inf))


def drawn_times(curves: Sequence[Curves], column_ranges: CurveRanges, most: int) -> list[Floats]:
    """Return, for each curve, the times whose chords approximate all columns [s].

    The ends of parts are left out. If more than `most` times are needed, fewer are returned.

    Examples
    --------
    The second derivative of a parabola is constant:

    >>> nodes = (0.0, 0.3, 0.7, 1.0)
    >>> curve = Curves(np.zeros(1), np.full(1, 2.0), nodes, np.array([[[x**2 for x in nodes]]]))
    >>> [times] = drawn_times([curve], ranges([curve], [slice(None)]), 1000)
    >>> len(times), times[:2].round(3).tolist()
    (17, [0.111, 0.222])
    """
    counts = [_counts(curve, column_ranges) for curve in curves]
    total = sum(int(count.sum()) for count in counts)
    if total > most:
        counts = [np.maximum(1, count * most // total) for count in counts]
    times = []
    for curve, count in zip(curves, counts, strict=True):
        ends = np.cumsum(count - 1)
        numbers = np.arange(ends[-1]) - np.repeat(ends - count + 1, count - 1) + 1
        within = numbers / np.repeat(count, count - 1)
        times.append(_times(curve, np.repeat(np.arange(len(count)), count - 1), within))
    return times


def _counts(curves: Curves, column_ranges: CurveRanges) -> Integers:
    """Return the number of equal chords in each part, from the largest second derivative."""
    bends = np.abs(_risen(curves.values) @ _polynomials(curves.nodes).bends.T).max(axis=2)
    chords = np.fmax.reduce(bends / (8 * CHORD * column_ranges.size[:, None]), initial=0.0)
    return np.asarray(np.maximum(1, np.ceil(np.sqrt(np.minimum(chords, _MOST_CHORDS)))), dtype=int)


def extreme_times(
    curves: Sequence[Curves], together: Sequence[Curves], column_ranges: CurveRanges
) -> Floats:
    """Return the times at which columns are largest or least [s].

    The first of several equal extremes is included.

    Parameters
    ----------
    together : sequence of Curves
        Result of `joined_curves`.

    Examples
    --------
    >>> nodes = (0.0, 0.3, 0.7, 1.0)
    >>> values = np.array([[[x * (1 - x) for x in nodes]]])
    >>> curves = [Curves(np.zeros(1), np.full(1, 2.0), nodes, values)]
    >>> times = extreme_times(curves, joined_curves(curves), ranges(curves, [slice(None)]))
    >>> sorted(set(times.round(9).tolist()))
    [0.0, 1.0]
    """
    moving = np.flatnonzero(np.isfinite(column_ranges.size))
    if not len(moving):  # all columns are constant
        return np.zeros(0)
    candidates = [_outermost(curve, moving) for curve in curves]
    candidates += [_turns(curve, moving, column_ranges) for curve in together]
    columns, times, values = (np.concatenate(parts) for parts in zip(*candidates, strict=True))
    order = np.argsort(columns, kind="stable")
    columns, times, values = columns[order], times[order], values[order]
    starts, places = np.searchsorted(columns, moving), np.arange(len(times))
    counts, near = np.diff(starts, append=len(times)), EQUAL_EXTREMES * column_ranges.size[columns]
    chosen = []
    for heights in (values, -values):
        top = np.repeat(np.maximum.reduceat(heights, starts), counts)
        highest = np.minimum.reduceat(np.where(heights >= top, places, len(places)), starts)
        equal = np.where(heights >= top - near, times, np.inf)
        chosen += [times[highest], np.minimum.reduceat(equal, starts)]
    return np.concatenate(chosen)


class _Turns(NamedTuple):
    """Candidates for extremes: index of the column, time and value."""

    columns: Integers
    times: Floats
    """Time of each candidate. [s]"""
    values: Floats


def _outermost(curves: Curves, moving: Integers) -> _Turns:
    """Return the highest and lowest nodes of columns."""
    nodes, values = np.array(curves.nodes), curves.values[moving]
    flat = values.reshape(len(values), -1)
    highest, lowest = flat.argmax(axis=1), flat.argmin(axis=1)
    unknown = np.isnan(flat)
    if unknown.any():
        highest = np.where(unknown, -np.inf, flat).argmax(axis=1)
        lowest = np.where(unknown, np.inf, flat).argmin(axis=1)
    parts, at = np.divmod(np.concatenate([highest, lowest]), len(nodes))
    twice = np.concatenate([moving, moving])
    return _Turns(twice, _times(curves, parts, nodes[at]), curves.values[twice, parts, at])


def _turns(curves: Curves, moving: Integers, column_ranges: CurveRanges) -> _Turns:
    """Return the turning points of columns that are nearly as high or low as the extremes."""
    nodes, values = np.array(curves.nodes), curves.values[moving]
    polynomials = _polynomials(curves.nodes)
    rises = _risen(values)
    up = rises @ polynomials.slopes.T > 0
    turns = up[..., :-1] != up[..., 1:]
    room = (_NEAR_TOP * column_ranges.size[moving])[:, None, None]
    high = values >= column_ranges.largest[moving, None, None] - room
    low = values <= column_ranges.least[moving, None, None] + room
    extreme = high | low
    turns &= extreme[..., :-1] | extreme[..., 1:]
    column, part, node = np.nonzero(turns)
    powers = rises[column, part] @ polynomials.powers.T
    place = _turning(powers, nodes[node], nodes[node + 1])
    reached = values[column, part, 0] + _values_at(powers, place)
    return _Turns(moving[column], _times(curves, part, place), reached)


def _turning(powers: Floats, low: Floats, high: Floats) -> Floats:
    """Return the turning point of each polynomial between `low` and `high`, by Newton's method."""
    orders = np.arange(1.0, powers.shape[1])
    slopes = powers[:, 1:] * orders
    bends = slopes[:, 1:] * orders[:-1]
    first, last = _values_at(slopes, low), _values_at(slopes, high)
    place = low + (high - low) * np.fmin(np.fmax(first / (first - last), 0.0), 1.0)
    for _ in range(_NEWTON_OF_EXTREMES):
        monomials = place[:, None] ** np.arange(slopes.shape[1])
        slope = (slopes * monomials).sum(axis=1)
        bend = (bends * monomials[:, :-1]).sum(axis=1)
        place = np.minimum(np.maximum(place - _finite(slope / bend), low), high)
    return np.asarray(place, float)


def _times(curves: Curves, parts: Integers, within: Floats) -> Floats:
    return curves.begins[parts] + within * curves.lengths[parts]


def _risen(values: Floats) -> Floats:
    return _finite(values - values[..., :1])


def _finite(values: Floats) -> Floats:
    is_finite = np.isfinite(values)
    return values if is_finite.all() else np.where(is_finite, values, 0.0)


def _values_at(powers: Floats, places: Floats) -> Floats:
    values: Floats = (powers * places[:, None] ** np.arange(powers.shape[1])).sum(axis=1)
    return values


class _Polynomials(NamedTuple):
    """Matrices from values at nodes to coefficients (`powers`), and to derivatives there."""

    powers: Floats
    slopes: Floats
    """Matrix to first derivatives at the nodes."""
    bends: Floats
    """Matrix to second derivatives at the nodes."""


@lru_cache(maxsize=8)
def _polynomials(nodes: tuple[float, ...]) -> _Polynomials:
    places, orders = np.array(nodes), np.arange(len(nodes))
    values = places[:, None] ** orders
    powers = np.linalg.inv(values)
    slopes = np.zeros_like(values)
    slopes[:, 1:] = values[:, :-1] * orders[1:]
    bends = np.zeros_like(values)
    bends[:, 1:] = slopes[:, :-1] * orders[1:]
    return _Polynomials(powers, slopes @ powers, bends @ powers)
