"""Choice of the instants of a run that draw all columns; excess instants are removed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats, first_largest
from vstatics.simulation.events.time_steps import TimeStep
from vstatics.simulation.record.curves import (
    CurveRanges,
    Curves,
    drawn_times,
    extreme_times,
    joined_curves,
    ranges,
)
from vstatics.simulation.record.moments import Moments
from vstatics.simulation.record.picture_tables import PictureTables, Tables, chosen, joined
from vstatics.simulation.record.segments import MotionColumns, Piece
from vstatics.simulation.system.matrices import MotionSystem
from vstatics.simulation.tolerances import CHORD

_MOST_BISECTIONS = 20
"""Largest number of bisections in the search for corners of columns."""
_MOST_NEAR_CORNERS = 2000
"""Largest number of instants added at corners; more corners would be rounding noise."""
_MOST_DRAWN, _MOST_HURRIED = (200_000, 8_000_000), (20_000, 500_000)
"""Largest numbers of instants and of column values in a run; smaller if a user waits."""


class _SteppedCourse(NamedTuple):
    """Consecutive time steps between two events, with their columns as curves."""

    piece: int
    steps: Sequence[tuple[TimeStep, float]]
    curves: Curves

    def inside(self, times: Floats) -> Floats:
        """Return the sorted, distinct times that are strictly inside the time steps."""
        ends = np.array([self.curves.begins[0], *(end for _, end in self.steps)])
        inner = times[(times > ends[0]) & (times < ends[-1])]
        return np.unique(inner[ends[np.searchsorted(ends, inner)] != inner])

    def states(self, times: Floats) -> Floats:
        """Return the states at sorted times, shape (size, times)."""
        ends = [end for _, end in self.steps[:-1]]
        of_steps = np.split(times, np.searchsorted(times, ends, "right"))
        return np.hstack(
            [
                step.between(within)
                for (step, _), within in zip(self.steps, of_steps, strict=True)
                if len(within)
            ]
        )


class DrawnRun:
    """Times and columns of a run up to the simulated time.

    Parameters
    ----------
    system : MotionSystem
    every : float, optional
        Spacing of instants that are never removed. [s]
    asked : mapping of str to sequence of str
        Requested rows of additional tables.
    """

    def __init__(
        self, system: MotionSystem, every: float | None, asked: Mapping[str, Sequence[str]]
    ) -> None:
        self.table, self.every = MotionColumns(system, asked), every
        self.times: Floats = np.zeros(0)
        self.columns: Floats = np.zeros((self.table.heat.stop, 0))
        self._earlier: Tables = {}
        """Tables for pictures of the run before `_moments`."""
        self._moments: list[Moments] = []
        """Moments of the pieces added last, whose tables for pictures are not yet calculated."""
        self._ranges: CurveRanges | None = None
        self._parts, self._is_thin = 0, False

    def add(self, pieces: Sequence[Piece], *, hurried: bool = False) -> None:
        """Add pieces of the run, at instants that draw the columns and their extremes.

        Parameters
        ----------
        hurried : bool
            Choose fewer instants, as a user is waiting.
        """
        instants, numbers = _MOST_HURRIED if hurried else _MOST_DRAWN
        most = min(instants, numbers // len(self.columns))
        added: list[list[tuple[Floats, Floats]]] = [[] for _ in pieces]
        for course, times in self._added(pieces, most, hurried=hurried):
            if len(times):
                added[course.piece].append((times, course.states(times)))
        all_times, all_columns = [self.times], [self.columns]
        if self._moments:
            self._earlier, self._moments = joined(self._earlier, self._moments), []
        for piece, additions in zip(pieces, added, strict=True):
            times = np.concatenate([piece.times, *(added_times for added_times, _ in additions)])
            states = np.hstack(
                [np.array(piece.states).T, *(added_states for _, added_states in additions)]
            )
            order = np.argsort(times, kind="stable")
            all_times.append(times[order])
            moments = self.table.moments(piece, times[order], states[:, order])
            all_columns.append(self.table.at(moments))
            self._moments.append(moments)
        self.times, self.columns = np.concatenate(all_times), np.hstack(all_columns)
        if len(self.times) > most:
            self._thin(most if hurried else most // 2)
            self._is_thin = True

    def picture_tables(self, selected: Booleans) -> PictureTables:
        """Return the tables for pictures at the selected times."""
        return PictureTables(self._earlier, self._moments, selected)

    def _thin(self, most: int) -> None:
        """Remove instants evenly until `most` remain, except needed instants."""
        # Ends, extremes, both sides of jumps and multiples of `every` are needed.
        times, columns = self.times, self.columns.T
        remaining = np.zeros(len(times), dtype=bool)
        remaining[[0, -1]] = True
        twice = np.flatnonzero(times[1:] == times[:-1])
        remaining[twice] = remaining[twice + 1] = True
        if self.every:
            remaining |= times == np.rint(times / self.every) * self.every
        remaining[first_largest(columns - np.fmin.reduce(columns))] = True
        remaining[first_largest(np.fmax.reduce(columns) - columns)] = True
        others = np.flatnonzero(~remaining)
        room = max(1, most - int(remaining.sum()))
        remaining[others[:: -(-len(others) // room) or 1]] = True
        self.times, self.columns = self.times[remaining], self.columns[:, remaining]
        self._earlier = chosen(joined(self._earlier, self._moments), remaining)
        self._moments = []

    def _added(
        self, pieces: Sequence[Piece], most: int, *, hurried: bool
    ) -> Iterator[tuple[_SteppedCourse, Floats]]:
        """Yield groups of consecutive similar time steps, with times that draw their columns."""
        courses = [
            _SteppedCourse(number, steps, self.table.curves(piece, steps))
            for number, piece in enumerate(pieces)
            # `Curves` needs the same number of nodes in each part.
            for _, equal in groupby(piece.steps, lambda step: len(step[0].nodes))
            for steps in [[*equal]]
        ]
        if not courses:
            return
        curves = [course.curves for course in courses]
        table, together = self.table, joined_curves(curves)
        moves = slice(table.speeds.start, table.slips.stop)
        column_ranges = self._ranges = ranges(together, [moves, *table.kinds[2:]], self._ranges)
        parts = sum(len(curve.begins) for curve in curves)
        self._parts += parts
        room = most * parts // self._parts if self._is_thin else most - len(self.times)
        drawn, extremes = (
            drawn_times(together, column_ranges, room),
            extreme_times(curves, together, column_ranges),
        )
        times = np.concatenate([*drawn, extremes])
        for course in courses:
            inside, piece = course.inside(times), pieces[course.piece]
            if piece.margins.shared and not hurried:
                inside = self._with_corners(piece, course, inside, column_ranges.size)
            yield course, inside

    def _with_corners(
        self, piece: Piece, course: _SteppedCourse, times: Floats, size: Floats
    ) -> Floats:
        """Add times near corners of columns, where the split of redundant torques changes."""

        def points(at: Floats) -> Floats:
            columns = self.table.at(self.table.moments(piece, at, course.states(at)))
            return np.concatenate([at[None, :], columns])

        ends = np.append(course.curves.begins, course.steps[-1][1])
        edges = np.sort(np.concatenate([ends, times]))
        halves = np.empty(2 * len(edges) - 1)
        halves[::2], halves[1::2] = edges, 0.5 * (edges[:-1] + edges[1:])
        known = points(halves)
        low, middle, high = known[:, :-1:2], known[:, 1::2], known[:, 2::2]
        for _ in range(_MOST_BISECTIONS):
            apart = np.abs(middle - 0.5 * (low + high))[1:]
            far = (apart > CHORD * size[:, None]).any(axis=0)
            if not far.any() or len(times) > _MOST_NEAR_CORNERS:
                break
            times = np.concatenate([times, middle[0, far]])
            low, middle, high = low[:, far], middle[:, far], high[:, far]
            low, high = np.hstack([low, middle]), np.hstack([middle, high])
            order = low[0].argsort()
            low, high = low[:, order], high[:, order]
            middle = points(0.5 * (low[0] + high[0]))
        return course.inside(times)
