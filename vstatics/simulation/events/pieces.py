"""Integration between two events: steps of an explicit method, each with what lies between."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import NamedTuple

import numpy as np

from vstatics.numerics.arrays import Booleans, Floats
from vstatics.simulation.system.equations import Equations

_SAMPLES = 8
"""Instants of a step that are looked at."""
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
    marks: Booleans
    """Which of them are points of integration."""


class TooSmall(Exception):  # noqa: N818 - it never leaves the room
    """A step has become as small as rounding."""


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
    from scipy.integrate import DOP853

    time, state = begin
    if first is not None:
        first = min(first, end - time, equations.longest if equations.ports.timed else np.inf)
    solver = DOP853(
        equations.derivative,
        time,
        state,
        end,
        rtol=tolerances.relative,
        atol=tolerances.absolute,  # type: ignore[arg-type] # it takes arrays
        first_step=first,
        max_step=equations.longest if equations.ports.timed else np.inf,
    )
    while solver.status == "running":
        start, before = solver.t, solver.y
        solver.step()
        if str(solver.status) == "failed" or not np.isfinite(solver.y).all():
            raise TooSmall
        between = solver.dense_output()
        times = np.linspace(start, solver.t, _SAMPLES + 1)[1:]
        states = between(times)
        states[:, -1] = solver.y
        marks = np.arange(_SAMPLES) == _SAMPLES - 1
        exact = partial(_exactly, equations, (start, before), tolerances)
        yield TimeStep(start, solver.t, before, solver.y, between, exact, times, states, marks)


def _exactly(
    equations: Equations, start: tuple[float, Floats], tolerances: StepTolerances, time: float
) -> Floats:
    """The state at a time within a step, as accurate as a step's end."""
    if time <= start[0]:
        return start[1]
    from scipy.integrate import DOP853

    solver = DOP853(
        equations.derivative,
        *start,
        time,
        rtol=tolerances.relative,
        atol=tolerances.absolute,  # type: ignore[arg-type] # it takes arrays
        first_step=time - start[0],
    )
    while solver.status == "running":
        solver.step()
    return solver.y
