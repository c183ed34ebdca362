"""The pieces of a run, and its columns along them: speeds, slips, torques, heat."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby, pairwise
from typing import NamedTuple

import numpy as np

from vstatics.numerics.arrays import Floats, first_largest
from vstatics.simulation.events.margins import Margins
from vstatics.simulation.events.pieces import TimeStep
from vstatics.simulation.record.account import element_heat
from vstatics.simulation.record.curves import Curves, drawn_times, extreme_times, ranges
from vstatics.simulation.record.motion import Peak
from vstatics.simulation.system.matrices import MotionSystem, between
from vstatics.simulation.tolerances import CHORD

_MOST_BISECTIONS = 20
"""Of an interval in which a column has a corner."""
_STEPS_TOGETHER = 64
"""So many steps have their curves calculated at once: of a long run that is memory."""


class Piece:
    """What is kept of a run while the same things stick and slip."""

    def __init__(self, margins: Margins, state: Floats) -> None:
        self.margins = margins
        self.times = [margins.equations.time]
        """Points of integration, multiples of a step. [s]"""
        self.states = [state]
        self.steps: list[tuple[TimeStep, float]] = []
        """Each with the time up to which it holds."""

    def add(self, time: float, state: Floats) -> None:
        """Keep an instant."""
        self.times.append(time)
        self.states.append(state)


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


class MotionColumns:
    """The columns of a motion, one behind the other."""

    def __init__(self, system: MotionSystem) -> None:
        elements = system.case.shift_elements
        links = len(system.names)
        self.devices = (*system.case.devices, *(one.name for one in system.converters))
        self.rows = system.rows(between(one.first, one.second, links) for one in elements)
        sizes = (links, len(elements), len(self.devices), len(elements))
        ends = np.cumsum((0, *sizes)).tolist()
        self.kinds = [slice(*pair) for pair in pairwise(ends)]
        """Speeds, slips, torques, heat."""
        self.speeds, self.slips, self.torques, self.heat = self.kinds

    def at(self, margins: Margins, times: Floats, states: Floats) -> Floats:
        """All at several times of a piece, shape (columns, times)."""
        speeds = margins.equations.speeds_at(times, states)
        return np.vstack(
            [
                speeds,
                self.rows @ speeds,
                device_torques(margins, times, states),
                element_heat(margins.equations, states),
            ]
        )

    def along(self, pieces: Sequence[Piece], *, hurried: bool) -> tuple[Floats, Floats]:
        """Times of a run and the columns there: what is kept, draws it, or is an extreme.

        Parameters
        ----------
        hurried : bool
            Whether little is added to draw it.
        """
        added: list[list[tuple[Floats, Floats]]] = [[] for _ in pieces]
        for course, times in self._added(pieces, hurried=hurried):
            if len(times):
                added[course.piece].append((times, course.states(times)))
        all_times, all_columns = [], []
        for piece, more in zip(pieces, added, strict=True):
            times = np.concatenate([piece.times, *(one for one, _ in more)])
            states = np.hstack([np.array(piece.states).T, *(one for _, one in more)])
            order = np.argsort(times, kind="stable")
            all_times.append(times[order])
            all_columns.append(self.at(piece.margins, times[order], states[:, order]))
        return np.concatenate(all_times), np.hstack(all_columns)

    def _added(
        self, pieces: Sequence[Piece], *, hurried: bool
    ) -> Iterator[tuple[_SteppedCourse, Floats]]:
        """Times by which columns are drawn, and those of their extremes."""
        courses = [
            _SteppedCourse(number, steps, self._curves(piece.margins, steps))
            for number, piece in enumerate(pieces)
            for steps in _together(piece.steps)
        ]
        if not courses:
            return
        curves = [one.curves for one in courses]
        moves = slice(self.speeds.start, self.slips.stop)
        of = ranges(curves, [moves, self.torques, self.heat])
        for course, *times in zip(
            courses,
            drawn_times(curves, of, hurried=hurried),
            extreme_times(curves, of),
            strict=True,
        ):
            inside, margins = course.inside(np.concatenate(times)), pieces[course.piece].margins
            if margins.shared and not hurried:
                inside = self._with_corners(margins, course, inside, of.size)
            yield course, inside

    def _with_corners(
        self, margins: Margins, course: _SteppedCourse, times: Floats, size: Floats
    ) -> Floats:
        """Times, and those near corners: where redundant elements begin to share otherwise."""
        edges = np.concatenate([course.curves.begins, times, [course.steps[-1][1]]])
        edges.sort()
        low, high = edges[:-1], edges[1:]
        for _ in range(_MOST_BISECTIONS):
            middle = 0.5 * (low + high)
            first, at, last = (
                self.at(margins, one, course.states(one)) for one in (low, middle, high)
            )
            far = (np.abs(at - 0.5 * (first + last)) > CHORD * size[:, None]).any(axis=0)
            if not far.any():
                break
            times = np.concatenate([times, middle[far]])
            low, high = (np.sort(np.concatenate([one[far], middle[far]])) for one in (low, high))
        return course.inside(times)

    def _curves(self, margins: Margins, steps: Sequence[tuple[TimeStep, float]]) -> Curves:
        """The columns of the parts of steps; the last part goes to where the steps end."""
        (first, _), (last, end) = steps[0], steps[-1]
        size = len(first.nodes)
        times = np.concatenate([one.times for one, _ in steps]).reshape(-1, size)
        states = np.hstack([first.first[:, None], *(one.states for one, _ in steps)])
        begins = np.append(first.start, times[:-1, -1])
        parts = max(1, int((begins < end).sum()))
        begins, times, states = begins[:parts], times[:parts], states[:, : parts * size + 1]
        if end < times[-1, -1]:
            times[-1] = begins[-1] + (end - begins[-1]) * first.nodes
            states[:, -size:] = last.between(times[-1])
        values = self.at(margins, np.append(begins[0], times), states)
        nodes = np.arange(parts)[:, None] * size + np.arange(size + 1)
        places = (0.0, *first.nodes.tolist())
        return Curves(begins, times[:, -1] - begins, places, values[:, nodes])


def _together(
    steps: Sequence[tuple[TimeStep, float]],
) -> Iterator[Sequence[tuple[TimeStep, float]]]:
    """Steps with their instants at the same places, not too many at once."""
    for _, some in groupby(steps, lambda one: len(one[0].nodes)):
        alike = [*some]
        for first in range(0, len(alike), _STEPS_TOGETHER):
            yield alike[first : first + _STEPS_TOGETHER]


def peaks(devices: Sequence[str], times: Floats, torques: Floats) -> Mapping[str, Peak]:
    """The largest torque of each device, the first where several are as large."""
    top = first_largest(np.abs(torques))
    return {
        name: Peak(float(torques[place, device]), float(times[place]))
        for device, (name, place) in enumerate(zip(devices, top.tolist(), strict=True))
    }


def device_torques(margins: Margins, times: Floats, states: Floats) -> Floats:
    """Torques of all devices at several times, shape (devices, times) [N*m]."""
    equations = margins.equations
    rates, ports = equations.acting_at(times, states)
    held = margins.split(times, states, rates, ports)
    system, layout = equations.system, equations.layout
    count = len(system.case.devices)
    made = np.zeros((count + len(system.converters), len(times)))
    row_of = {
        one.of: row
        for row, one in enumerate(equations.structure.multipliers)
        if one.kind == "contact"
    }
    for index, contact in enumerate(system.contacts):
        if contact.device is not None:
            row = row_of.get(index)
            made[contact.device] += ports[layout.contacts + index] if row is None else held[row]
    structure = equations.structure
    by_planets = system.rows(mesh.planets for mesh in system.meshes)
    by_planets = by_planets @ structure.free @ structure.accelerations
    for index, mesh in enumerate(system.meshes):
        made[mesh.device] = held[index] + by_planets[index] @ ports
    for index, spring in enumerate(system.springs):
        made[spring.device] += ports[layout.springs + index]
    made[count:] = ports[layout.pumps : layout.pumps + len(system.converters)]
    return made
