"""The columns of a run as curves: where each is largest and least, how many instants draw them.

Between two points of integration a column is a polynomial through its values at some instants of a
part. Its bend tells how many chords come near to it, its slope where it turns; what is written is
calculated there anew, so these polynomials choose instants and no numbers.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats, Integers
from vstatics.simulation.tolerances import CHORD, EQUAL_EXTREMES, NO_RANGE

_NEAR_TOP = 0.1
"""Part of its range within which a curve has all of its largest values before it is refined."""
_NEWTON_OF_EXTREMES = 4
_MOST_CHORDS = 1e6
"""Square of the most chords of a part: what bends more has no polynomial."""


class Curves(NamedTuple):
    """Columns over some parts of a run."""

    begins: Floats
    """Of each part. [s]"""
    lengths: Floats
    """[s]"""
    nodes: tuple[float, ...]
    """Where in a part the values are, from 0 to 1."""
    values: Floats
    """Shape (columns, parts, nodes)."""


class CurveRanges(NamedTuple):
    """Of each column over a run; infinite where it does not change but for rounding."""

    least: Floats
    largest: Floats
    size: Floats


def ranges(
    curves: Sequence[Curves], kinds: Sequence[slice], before: CurveRanges | None = None
) -> CurveRanges:
    """The ranges of columns; what is small beside others of its kind does not change.

    Parameters
    ----------
    kinds : sequence of slice
        Columns that measure the same.
    before : CurveRanges, optional
        Of an earlier part of the run, which count too.
    """
    least = np.fmin.reduce([np.fmin.reduce(one.values, axis=(1, 2)) for one in curves])
    largest = np.fmax.reduce([np.fmax.reduce(one.values, axis=(1, 2)) for one in curves])
    if before is not None:
        least, largest = np.fmin(least, before.least), np.fmax(largest, before.largest)
    size = largest - least
    for kind in kinds:
        sizes = np.fmax(np.abs(largest[kind]), np.abs(least[kind]))
        near = NO_RANGE * np.fmax.reduce(sizes, initial=0.0)
        size[kind] = np.where(size[kind] > near, size[kind], np.inf)
    return CurveRanges(least, largest, np.where(np.isfinite(size), size, np.inf))


def drawn_times(curves: Sequence[Curves], of: CurveRanges, most: int) -> list[Floats]:
    """Times of each of `curves` by which chords come near to all columns, without ends [s].

    Where that takes more than `most`, chords are longer.

    Examples
    --------
    A parabola bends everywhere alike:

    >>> nodes = (0.0, 0.3, 0.7, 1.0)
    >>> curve = Curves(np.zeros(1), np.full(1, 2.0), nodes, np.array([[[x**2 for x in nodes]]]))
    >>> [times] = drawn_times([curve], ranges([curve], [slice(None)]), 1000)
    >>> len(times), times[:2].round(3).tolist()
    (17, [0.111, 0.222])
    """
    counts = [_counts(one, of) for one in curves]
    many = sum(int(one.sum()) for one in counts)
    if many > most:
        counts = [np.maximum(1, one * most // many) for one in counts]
    made = []
    for one, count in zip(curves, counts, strict=True):
        ends = np.cumsum(count - 1)
        numbers = np.arange(ends[-1]) - np.repeat(ends - count + 1, count - 1) + 1
        within = numbers / np.repeat(count, count - 1)
        made.append(_times(one, np.repeat(np.arange(len(count)), count - 1), within))
    return made


def _counts(curves: Curves, of: CurveRanges) -> Integers:
    """Into how many equal pieces each part is cut, by the largest bend in it."""
    bends = np.abs(_risen(curves.values) @ _polynomials(curves.nodes).bends.T).max(axis=2)
    chords = np.nan_to_num(bends / (8 * CHORD * of.size[:, None])).max(axis=0, initial=0.0)
    return np.asarray(np.maximum(1, np.ceil(np.sqrt(np.minimum(chords, _MOST_CHORDS)))), dtype=int)


def extreme_times(curves: Sequence[Curves], of: CurveRanges) -> list[Floats]:
    """Times of each of `curves` at which columns are largest or least [s].

    Of equal extremes the first is among them.

    Examples
    --------
    >>> nodes = (0.0, 0.3, 0.7, 1.0)
    >>> values = np.array([[[x * (1 - x) for x in nodes]]])
    >>> curve = Curves(np.zeros(1), np.full(1, 2.0), nodes, values)
    >>> [times] = extreme_times([curve], ranges([curve], [slice(None)]))
    >>> sorted(set(times.round(9).tolist()))
    [0.0, 1.0]
    """
    if not np.isfinite(of.size).any():  # nothing changes
        return [np.zeros(0) for _ in curves]
    tried = [_turns(one, of) for one in curves]
    columns, times, values = (np.concatenate(one) for one in zip(*tried, strict=True))
    owner = np.repeat(np.arange(len(curves)), [len(one.columns) for one in tried])
    near = EQUAL_EXTREMES * of.size
    chosen: list[list[float]] = [[] for _ in curves]
    for column in np.flatnonzero(np.isfinite(of.size)).tolist():
        places = np.flatnonzero(columns == column)
        for heights in (values[places], -values[places]):
            equal = places[heights >= heights.max() - near[column]]
            for place in (places[heights.argmax()], equal[times[equal].argmin()]):
                chosen[owner[place]].append(float(times[place]))
    return [np.array(one) for one in chosen]


class _Turns(NamedTuple):
    """Places of columns that may be extremes."""

    columns: Integers
    times: Floats
    """[s]"""
    values: Floats


def _turns(curves: Curves, of: CurveRanges) -> _Turns:
    """The highest and lowest nodes of columns, and where a column turns near to its extremes."""
    moves, nodes = np.flatnonzero(np.isfinite(of.size)), np.array(curves.nodes)
    values = curves.values[moves]
    flat = values.reshape(len(values), -1)
    ends = [np.nan_to_num(sign * flat, nan=-np.inf).argmax(axis=1) for sign in (1.0, -1.0)]
    parts, at = np.unravel_index(np.concatenate(ends), values.shape[1:])
    twice = np.concatenate([moves, moves])
    found = [_Turns(twice, _times(curves, parts, nodes[at]), curves.values[twice, parts, at])]
    polynomials = _polynomials(curves.nodes)
    risen = _risen(values)
    up = risen @ polynomials.slopes.T > 0
    turns = up[..., :-1] != up[..., 1:]
    if turns.any():
        room = (_NEAR_TOP * of.size[moves])[:, None, None]
        high = values >= of.largest[moves, None, None] - room
        low = values <= of.least[moves, None, None] + room
        extreme = high | low
        turns &= extreme[..., :-1] | extreme[..., 1:]
        column, part, node = np.nonzero(turns)
        powers = risen[column, part] @ polynomials.powers.T
        place = _turning(powers, nodes[node], nodes[node + 1])
        reached = values[column, part, 0] + _along(powers, place)
        found.append(_Turns(moves[column], _times(curves, part, place), reached))
    return _Turns(*(np.concatenate(one) for one in zip(*found, strict=True)))


def _turning(powers: Floats, low: Floats, high: Floats) -> Floats:
    """Where polynomials turn between two places, by Newton's rule."""
    orders = np.arange(1.0, powers.shape[1])
    slopes = powers[:, 1:] * orders
    bends = slopes[:, 1:] * orders[:-1]
    first, last = _along(slopes, low), _along(slopes, high)
    place = low + (high - low) * np.clip(np.nan_to_num(first / (first - last)), 0.0, 1.0)
    for _ in range(_NEWTON_OF_EXTREMES):
        step = np.nan_to_num(_along(slopes, place) / _along(bends, place), posinf=0.0, neginf=0.0)
        place = np.clip(place - step, low, high)
    return np.asarray(place, float)


def _times(curves: Curves, parts: Integers, within: Floats) -> Floats:
    times: Floats = curves.begins[parts] + within * curves.lengths[parts]
    return times


def _risen(values: Floats) -> Floats:
    """Values less that at the begin of the part; 0 where there is none."""
    return np.nan_to_num(values - values[..., :1], posinf=0.0, neginf=0.0)


def _along(powers: Floats, places: Floats) -> Floats:
    """Polynomials, each at a place of its own."""
    made: Floats = (powers * places[:, None] ** np.arange(powers.shape[1])).sum(axis=1)
    return made


class _Polynomials(NamedTuple):
    """By values at nodes."""

    powers: Floats
    slopes: Floats
    """At the nodes."""
    bends: Floats
    """At the nodes."""


@lru_cache(maxsize=8)
def _polynomials(nodes: tuple[float, ...]) -> _Polynomials:
    """Through values at these places."""
    places, orders = np.array(nodes), np.arange(len(nodes))
    values = places[:, None] ** orders
    powers = np.linalg.inv(values)
    slopes = np.zeros_like(values)
    slopes[:, 1:] = values[:, :-1] * orders[1:]
    bends = np.zeros_like(values)
    bends[:, 1:] = slopes[:, :-1] * orders[1:]
    return _Polynomials(powers, slopes @ powers, bends @ powers)
