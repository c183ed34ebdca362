"""Integration between two events: steps of an explicit method, each with what lies between."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.system.equations import Equations
from vstatics.simulation.tolerances import NO_PROGRESS

if TYPE_CHECKING:
    from scipy.integrate import DOP853

_NODES: Floats = np.arange(1, 9) / 8
"""Instants of a step that are looked at, by its length."""
Between = Callable[[Floats], Floats]
"""Times within a step, shape (n,) -> states, shape (size, n)."""


class StepTolerances(NamedTuple):
    """Of integration."""

    relative: float
    absolute: Floats
    """For each part of the state."""


class TimeStep(NamedTuple):
    """A step."""

    start: float
    end: float
    first: Floats
    """State at the start."""
    last: Floats
    """State at the end."""
    between: Between
    exact: Callable[[float], Floats]
    """The state at a time, as accurate as at the end."""
    times: Floats
    """Instants of it that are looked at, the last is its end. [s]"""
    states: Floats
    """There, shape (size, instants)."""
    nodes: Floats
    """Where they are in each of its equal parts, by the length of a part; the last is 1."""


_PATIENCE = 1000
"""Steps after which it is asked whether they lead anywhere."""


class TooSmall(Exception):  # noqa: N818 - it never leaves the room
    """Steps have become as small as rounding, or so small that they lead nowhere."""


def steps(
    equations: Equations,
    begin: tuple[float, Floats],
    end: float,
    tolerances: StepTolerances,
    first: float | None,
) -> Iterator[TimeStep]:
    """Steps up to a time.

    Raises
    ------
    TooSmall
    """
    if not np.isfinite(equations.derivative(*begin)).all():
        raise TooSmall  # the solver would look for a first step without end
    longest = equations.longest if equations.ports.timed else np.inf
    if first is not None:
        first = min(first, end - begin[0], longest)
    solver = _solver(equations, begin, end, tolerances, first, longest)
    number, mark = 0, solver.t
    while solver.status == "running":
        start = solver.t, solver.y
        number += 1
        if number % _PATIENCE == 0:
            if solver.t - mark < NO_PROGRESS * equations.system.scenario.span:
                raise TooSmall
            mark = solver.t
        solver.step()
        if str(solver.status) == "failed" or not np.isfinite(solver.y).all():
            raise TooSmall
        between = solver.dense_output()
        times = start[0] + (solver.t - start[0]) * _NODES
        times[-1] = solver.t
        states = between(times)
        states[:, -1] = solver.y
        exact = partial(_exactly, equations, start, tolerances)
        yield TimeStep(
            start[0], solver.t, start[1], solver.y, between, exact, times, states, _NODES
        )


def _exactly(
    equations: Equations, start: tuple[float, Floats], tolerances: StepTolerances, time: float
) -> Floats:
    """The state at a time within a step, as accurate as a step's end."""
    if time <= start[0]:
        return start[1]
    solver = _solver(equations, start, time, tolerances, time - start[0])
    while solver.status == "running":
        solver.step()
    return solver.y


def _solver(  # noqa: PLR0913, PLR0917
    equations: Equations,
    begin: tuple[float, Floats],
    end: float,
    tolerances: StepTolerances,
    first: float | None,
    longest: float = np.inf,
) -> DOP853[np.float64]:
    from scipy.integrate import DOP853

    return DOP853(
        equations.derivative,
        *begin,
        end,
        rtol=tolerances.relative,
        atol=tolerances.absolute,  # type: ignore[arg-type] # it takes arrays
        first_step=first,
        max_step=longest,
    )
