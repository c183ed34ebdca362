"""The instants by which a run is drawn: some steps at a time, and fewer where they get too many."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats, first_largest
from vstatics.simulation.events.time_steps import TimeStep
from vstatics.simulation.record.beside import Tables, beside, chosen, joined
from vstatics.simulation.record.curves import (
    CurveRanges,
    Curves,
    drawn_times,
    extreme_times,
    ranges,
)
from vstatics.simulation.record.segments import MotionColumns, Piece
from vstatics.simulation.system.matrices import MotionSystem
from vstatics.simulation.tolerances import CHORD

_MOST_BISECTIONS = 20
"""Of an interval in which a column has a corner."""
_MOST_NEAR_CORNERS = 2000
"""Instants of some steps that are added there: with more there are no corners, but rounding."""
_MOST_DRAWN, _MOST_HURRIED = (200_000, 8_000_000), (20_000, 500_000)
"""Instants of a run, and numbers of all columns there; with more its chords would be shorter."""


class _SteppedCourse(NamedTuple):
    """Steps of a piece that follow each other, with the columns along them as curves."""

    piece: int
    steps: Sequence[tuple[TimeStep, float]]
    curves: Curves

    def inside(self, times: Floats) -> Floats:
        """Those of some times that lie within steps, in order."""
        ends = np.array([self.curves.begins[0], *(end for _, end in self.steps)])
        kept = (times > ends[0]) & (times < ends[-1]) & ~np.isin(times, ends)
        return np.unique(times[kept])

    def states(self, times: Floats) -> Floats:
        """The states at times, which are in order."""
        ends = [end for _, end in self.steps]
        of = np.minimum(np.searchsorted(ends, times), len(ends) - 1)
        return np.hstack([self.steps[n][0].between(times[of == n]) for n in np.unique(of)])


class DrawnRun:
    """Times and columns of a run so far.

    Parameters
    ----------
    system : MotionSystem
    every : float, optional
        Its multiples are never left out. [s]
    asked : mapping of str to sequence of str
        Rows of tables that somebody asks for.
    """

    def __init__(
        self, system: MotionSystem, every: float | None, asked: Mapping[str, Sequence[str]]
    ) -> None:
        self.table, self.every = MotionColumns(system, asked), every
        self.times: Floats = np.zeros(0)
        self.columns: Floats = np.zeros((self.table.heat.stop, 0))
        self.beside: Tables = {}
        """What is known at these times besides; no time is kept for its sake."""
        self._of: CurveRanges | None = None
        self._parts, self._is_thin = 0, False

    def add(self, pieces: Sequence[Piece], *, hurried: bool = False) -> None:
        """Add what was kept, what draws it, and its extremes.

        Parameters
        ----------
        hurried : bool
            Whether somebody waits, and few instants have to do.
        """
        instants, numbers = _MOST_HURRIED if hurried else _MOST_DRAWN
        most = min(instants, numbers // len(self.columns))
        added: list[list[tuple[Floats, Floats]]] = [[] for _ in pieces]
        for course, times in self._added(pieces, most, hurried=hurried):
            if len(times):
                added[course.piece].append((times, course.states(times)))
        all_times, all_columns = [self.times], [self.columns]
        all_beside = [self.beside] if self.beside else []
        for piece, more in zip(pieces, added, strict=True):
            times = np.concatenate([piece.times, *(one for one, _ in more)])
            states = np.hstack([np.array(piece.states).T, *(one for _, one in more)])
            order = np.argsort(times, kind="stable")
            all_times.append(times[order])
            all_columns.append(self.table.at(piece, times[order], states[:, order]))
            all_beside.append(beside(piece.motion, times[order], states[:, order]))
        self.times, self.columns = np.concatenate(all_times), np.hstack(all_columns)
        self.beside = joined(all_beside)
        if len(self.times) > most:
            self._thin(most if hurried else most // 2)
            self._is_thin = True

    def _thin(self, most: int) -> None:
        """Leave out instants at equal distances, down to so many; none that has to stay."""
        kept = self._needed()
        others = np.flatnonzero(~kept)
        room = max(1, most - int(kept.sum()))
        kept[others[:: -(-len(others) // room) or 1]] = True
        self.times, self.columns = self.times[kept], self.columns[:, kept]
        self.beside = chosen(self.beside, kept)

    def _needed(self) -> Booleans:
        """Ends, extremes, where something begins or jumps, multiples of the step."""
        times, columns = self.times, self.columns.T
        kept = np.zeros(len(times), dtype=bool)
        kept[[0, -1]] = True
        twice = np.flatnonzero(times[1:] == times[:-1])
        kept[twice] = kept[twice + 1] = True
        if self.every:
            kept |= times == np.rint(times / self.every) * self.every
        kept[first_largest(columns - np.fmin.reduce(columns))] = True
        kept[first_largest(np.fmax.reduce(columns) - columns)] = True
        return kept

    def _added(
        self, pieces: Sequence[Piece], most: int, *, hurried: bool
    ) -> Iterator[tuple[_SteppedCourse, Floats]]:
        """Times by which columns are drawn, and those of their extremes."""
        courses = [
            _SteppedCourse(number, steps, self.table.curves(piece, steps))
            for number, piece in enumerate(pieces)
            for steps in _alike(piece.steps)
        ]
        if not courses:
            return
        curves = [one.curves for one in courses]
        table = self.table
        moves = slice(table.speeds.start, table.slips.stop)
        of = self._of = ranges(curves, [moves, *table.kinds[2:]], self._of)
        parts = sum(len(one.begins) for one in curves)
        self._parts += parts
        room = most * parts // self._parts if self._is_thin else most - len(self.times)
        drawn, extremes = drawn_times(curves, of, room), extreme_times(curves, of)
        for course, *times in zip(courses, drawn, extremes, strict=True):
            inside, piece = course.inside(np.concatenate(times)), pieces[course.piece]
            if piece.margins.shared and not hurried:
                inside = self._with_corners(piece, course, inside, of.size)
            yield course, inside

    def _with_corners(
        self, piece: Piece, course: _SteppedCourse, times: Floats, size: Floats
    ) -> Floats:
        """Times, and those near corners: where redundant elements begin to share otherwise."""
        edges = np.concatenate([course.curves.begins, times, [course.steps[-1][1]]])
        edges.sort()
        low, high = edges[:-1], edges[1:]
        for _ in range(_MOST_BISECTIONS):
            middle = 0.5 * (low + high)
            first, at, last = (
                self.table.at(piece, one, course.states(one)) for one in (low, middle, high)
            )
            far = (np.abs(at - 0.5 * (first + last)) > CHORD * size[:, None]).any(axis=0)
            if not far.any() or len(times) > _MOST_NEAR_CORNERS:
                break
            times = np.concatenate([times, middle[far]])
            low, high = (np.sort(np.concatenate([one[far], middle[far]])) for one in (low, high))
        return course.inside(times)


def _alike(
    steps: Sequence[tuple[TimeStep, float]],
) -> Iterator[Sequence[tuple[TimeStep, float]]]:
    """Steps that follow each other with their instants at the same places."""
    for _, some in groupby(steps, lambda one: len(one[0].nodes)):
        yield [*some]
