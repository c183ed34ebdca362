"""Search for an unknown number of each gear at which a surplus is 0, at all points at once.

The unknown number is a torque that balances a battery, or the speed ratio of a converter. The
surplus (of power or torque) is a nearly piecewise linear function of the number, calculated on a
grid of trial numbers. The root in an interval with a sign change is found by the Illinois rule
(Dowell, Jarratt 1971) and bisection.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import NamedTuple, Protocol, Self, TypeVar

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats, Integers
from vstatics.core.numerics.tolerances import EPSILON, SAME_TRIAL
from vstatics.core.statics.points.laws import Followed
from vstatics.core.statics.points.paths import CaseNumber, Columns
from vstatics.core.statics.results import Results

EDGE_STEPS = 50
"""Number of bisections for the trial number beyond which a gear has no torques."""
MOST_ROOT_STEPS = 100
"""Largest number of iterations for a root."""
MOST_POINTS_AT_ONCE = 100_000
"""Largest number of points calculated together, to limit memory."""

Follow = Callable[[Columns, int], Followed]
"""Function that calculates points, from the varied numbers and the number of points."""


class Unknown(Protocol):
    """Unknown number of a gear."""

    @property
    def gear(self) -> int:
        """Index of the gear."""

    @property
    def number(self) -> CaseNumber:
        """Key of the unknown number in the columns of varied numbers."""

    def surplus(self, results: Results) -> Floats:
        """Return the quantity that is 0 at a root, shape (points,); NaN without torques."""

    def size(self, results: Results) -> Floats:
        """Return the magnitude to which the surplus is compared, shape (points,)."""

    def at(self, points: Integers) -> Self:
        """Return the unknown for the points with the indices `points`."""


U = TypeVar("U", bound=Unknown)


class Roots(NamedTuple):
    """Roots of an unknown number."""

    values: Floats
    """Roots in the order of the grid, shape (roots, points), padded with NaN."""
    has_surplus: Booleans
    """Flags of points at which the surplus exists for some trial number, shape (points,)."""

    @property
    def first(self) -> Floats:
        """First root at each point; NaN without roots."""
        place = np.argmax(np.isfinite(self.values), axis=0)
        first: Floats = np.take_along_axis(self.values, place[None], axis=0)[0]
        return first

    @property
    def number(self) -> Integers:
        """Number of roots at each point."""
        number: Integers = np.isfinite(self.values).sum(axis=0)
        return number


def find_roots(  # noqa: PLR0913
    grids: Mapping[U, Floats],
    columns: Columns,
    follow: Follow,
    *,
    most: int,
    agreed: float,
    enough: float = 2 * EPSILON,
) -> dict[U, Roots]:
    """Return the roots of each unknown number.

    Parameters
    ----------
    grids : mapping of Unknown to ndarray, shape (trials, points)
        Trial numbers in ascending or descending order, equally many for all unknowns.
    columns : mapping
        Varied numbers.
    follow : callable
        Function that calculates points with known numbers.
    most : int
        Largest number of sign changes in which a root is searched for.
    agreed : float
        Largest relative surplus at a root. A sign change with a larger surplus is a jump. [-]
    enough : float
        Relative surplus at which the search for a root ends. [-]
    """
    surplus = _surpluses(grids, columns, follow)
    tried = _with_edges(grids, columns, surplus, follow)
    found: dict[U, list[Floats]] = {unknown: [] for unknown in grids}
    for turn in range(most):
        searches = {unknown: _RootSearch(*_ends(*tried[unknown], turn)) for unknown in grids}
        if turn and not any(search.is_there.any() for search in searches.values()):
            break
        while any(search.is_there.any() for search in searches.values()):
            _iterate(searches, columns, follow, enough)
            for unknown, search in searches.items():
                found[unknown].append(np.where(search.stands(agreed), search.best, np.nan))
            searches = {unknown: search.beyond_gap() for unknown, search in searches.items()}
    return {
        unknown: Roots(
            np.array([*roots, np.full(grids[unknown].shape[1], np.nan)]),
            np.asarray(np.isfinite(surplus[unknown]).any(axis=0)),
        )
        for unknown, roots in found.items()
    }


def _surpluses(grids: Mapping[U, Floats], columns: Columns, follow: Follow) -> dict[U, Floats]:
    """Return the surplus of each unknown for all trial numbers, shape (trials, points)."""
    trials, variants = next(iter(grids.values())).shape
    at_once = max(1, MOST_POINTS_AT_ONCE // variants)
    surpluses: dict[U, list[Floats]] = {unknown: [] for unknown in grids}
    for start in range(0, trials, at_once):
        parts = {unknown: grid[start : start + at_once] for unknown, grid in grids.items()}
        count = len(next(iter(parts.values())))
        many = {number: np.tile(column, count) for number, column in columns.items()}
        many |= {unknown.number: part.ravel() for unknown, part in parts.items()}
        results = follow(many, variants * count).results
        points = np.tile(np.arange(variants), count)
        for unknown in grids:
            left = unknown.at(points).surplus(results)
            surpluses[unknown].append(left.reshape(count, variants))
    return {unknown: np.concatenate(parts) for unknown, parts in surpluses.items()}


class Edges(NamedTuple):
    """Intervals between two trials of which only one has a surplus."""

    cell: Integers
    """Index of the first trial of each interval."""
    point: Integers
    known: Floats
    """Trial value at the end of each interval where the surplus exists."""
    beyond: Floats
    """Trial value at the end of each interval where the surplus does not exist (NaN)."""
    last: Floats
    """Surpluses at `known`."""

    @classmethod
    def of(cls, trials: Floats, surplus: Floats) -> Edges:
        """Return the intervals among trials, which have the shape (trials, points)."""
        lacks = np.isnan(surplus)
        wide = np.abs(trials[1:] - trials[:-1]) > SAME_TRIAL * np.abs(trials[1:])
        cell, point = np.nonzero((lacks[1:] != lacks[:-1]) & wide)
        second = lacks[cell, point]
        ends = trials[cell + second, point], trials[cell + ~second, point]
        return cls(cell, point, *ends, surplus[cell + second, point])

    @property
    def middle(self) -> Floats:
        """Trial values in the middle of the intervals."""
        middle: Floats = (self.known + self.beyond) / 2
        return middle

    def halved(self, surplus: Floats) -> Edges:
        """Return the halves at one end of which no surplus exists, from surpluses at the middle."""
        lacks, middle = np.isnan(surplus), self.middle
        return self._replace(
            known=np.where(lacks, self.known, middle),
            beyond=np.where(lacks, middle, self.beyond),
            last=np.where(lacks, self.last, surplus),
        )

    def inserted(self, trials: Floats, surplus: Floats) -> tuple[Floats, Floats]:
        """Insert a row after each row of trials and surplus, both of shape (trials, points).

        The new row contains the trial at the end of an interval where the surplus exists, and its
        surplus. Without an interval, the new row repeats the row before.
        """
        trials, values = (np.repeat(array, 2, axis=0)[:-1] for array in (trials, surplus))
        place = 2 * self.cell + 1, self.point
        trials[place], values[place] = self.known, self.last
        return trials, values


def _with_edges(
    grids: Mapping[U, Floats], columns: Columns, surplus: Mapping[U, Floats], follow: Follow
) -> dict[U, tuple[Floats, Floats]]:
    """Insert the limits up to which torques exist into trials and surplus.

    If a gear is self-locking at only one of two neighbouring trials, a sign change before this
    limit is then not missed.
    """
    edges = {unknown: Edges.of(grid, surplus[unknown]) for unknown, grid in grids.items()}
    together = sum(len(edge.cell) for edge in edges.values()) <= MOST_POINTS_AT_ONCE
    for group in [[*edges]] if together else [[unknown] for unknown in edges]:
        edges |= _limits({unknown: edges[unknown] for unknown in group}, columns, follow)
    return {
        unknown: edge.inserted(grids[unknown], surplus[unknown]) for unknown, edge in edges.items()
    }


def _limits(edges: Mapping[U, Edges], columns: Columns, follow: Follow) -> dict[U, Edges]:
    """Bisect intervals of several gears at once, to the limits up to which torques exist."""
    found = dict(edges)
    point = np.concatenate([edge.point for edge in edges.values()])
    ends = np.cumsum([len(edge.point) for edge in edges.values()]).tolist()
    parts = dict(zip(edges, map(slice, [0, *ends], ends), strict=False))
    at_points = {number: column[point] for number, column in columns.items()}
    for _ in range(EDGE_STEPS if len(point) else 0):
        tried = dict(at_points)
        for unknown, part in parts.items():
            tried[unknown.number] = at_points[unknown.number].copy()
            tried[unknown.number][part] = found[unknown].middle
        results = follow(tried, len(point)).results
        for unknown, part in parts.items():
            surplus = unknown.at(point).surplus(results)[part]
            found[unknown] = found[unknown].halved(surplus)
    return found


def _ends(
    trials: Floats, surplus: Floats, turn: int
) -> tuple[Floats, Floats, Floats, Floats, Booleans]:
    """Return trials and surpluses before and after a sign change, and flags of existence.

    `turn` is the number of the sign change at each point, from 0.
    """
    signs = np.sign(surplus)
    change = (signs[1:] * signs[:-1] < 0) | ((signs[1:] == 0) & (signs[:-1] != 0))
    change[0] |= signs[0] == 0
    place = np.argmax(np.cumsum(change, axis=0) == turn + 1, axis=0)
    is_there = change.sum(axis=0) > turn
    at = np.arange(surplus.shape[1])
    low, high = trials[place, at], trials[place + 1, at]
    return low, high, surplus[place, at], surplus[place + 1, at], is_there


def _iterate(
    searches: Mapping[U, _RootSearch], columns: Columns, follow: Follow, enough: float
) -> None:
    for step in range(MOST_ROOT_STEPS):
        guess = {unknown: search.guess(halve=step % 4 == 3) for unknown, search in searches.items()}
        tried = {**columns, **{unknown.number: trial for unknown, trial in guess.items()}}
        results = follow(tried, len(next(iter(guess.values())))).results
        for unknown, trial in guess.items():
            searches[unknown].take(trial, unknown.surplus(results), unknown.size(results))
        if all(search.done(enough) for search in searches.values()):
            break


class _RootSearch:
    """Search for roots between two numbers (the ends), at all points at once.

    The Illinois rule is a regula falsi that halves the surplus of an end that stays twice. Every
    fourth step is a bisection. A trial number without torques counts as beyond the root if `beyond`
    is true, else as before the root.
    """

    def __init__(  # noqa: PLR0913
        self,
        low: Floats,
        high: Floats,
        at_low: Floats,
        at_high: Floats,
        is_there: Booleans,
        *,
        beyond: bool = True,
    ) -> None:
        self.ends = low, high, at_low, at_high
        self.beyond, self.gap = beyond, np.zeros(low.shape, np.bool_)
        self.low, self.high = low, high
        self.at_low, self.at_high = at_low, at_high
        self.is_there = is_there
        self.best = np.where(at_high == 0, high, low)
        self.left = np.where(at_high == 0, 0.0, np.inf)
        self.sign = np.sign(at_low)
        self.side = np.zeros(low.shape, np.int8)
        """End that was moved last: 1 low, -1 high."""

    def guess(self, *, halve: bool) -> Floats:
        """Return the next trial number, by bisection (`halve`) or by regula falsi."""
        halves: Floats = (self.low + self.high) / 2
        if halve:
            return halves
        straight = self.low - self.at_low * (self.high - self.low) / (self.at_high - self.at_low)
        inside = (straight - self.low) * (straight - self.high) <= 0
        trial: Floats = np.where(inside, straight, halves)
        return trial

    def take(self, trial: Floats, surplus: Floats, size: Floats) -> None:
        """Move an end to a trial number; halve the surplus of an end that stays twice."""
        left = np.nan_to_num(np.abs(surplus / size), nan=np.inf)
        self.best = np.where(left < self.left, trial, self.best)
        self.left = np.minimum(left, self.left)
        locked = np.isnan(surplus)
        self.gap |= locked
        same = np.where(locked, not self.beyond, np.sign(surplus) == self.sign)
        self.at_high = np.where(same, self.at_high / np.where(self.side > 0, 2, 1), surplus)
        self.at_low = np.where(same, surplus, self.at_low / np.where(self.side < 0, 2, 1))
        self.low, self.high = np.where(same, trial, self.low), np.where(same, self.high, trial)
        self.side = np.where(same, 1, -1).astype(np.int8)

    def done(self, enough: float) -> bool:
        """Return whether every root is accurate to `enough` or cannot be improved."""
        width = np.abs(self.high - self.low)
        narrow = width <= 4 * EPSILON * np.maximum(np.abs(self.low), np.abs(self.high))
        return bool((~self.is_there | narrow | (self.left <= enough)).all())

    def beyond_gap(self) -> _RootSearch:
        """Return a search for roots beyond the numbers that have no torques."""
        return _RootSearch(*self.ends, self.is_there & self.gap & self.beyond, beyond=False)

    def stands(self, agreed: float) -> Booleans:
        """Return flags that mark points at which `best` is a root, not a jump."""
        is_root: Booleans = self.is_there & (self.left <= agreed)
        return is_root
