"""Integration between two events: steps of an explicit method, each with what lies between."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from vstatics.numerics.arrays import Floats
from vstatics.simulation.equations import Equations

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


class TooSmall(Exception):  # noqa: N818 - it never leaves the room
    """A step has become as small as rounding."""


def steps(
    equations: Equations, state: Floats, end: float, tolerances: StepTolerances, first: float | None
) -> Iterator[TimeStep]:
    """Steps up to a time.

    Raises
    ------
    TooSmall
    """
    from scipy.integrate import DOP853

    time = equations.time
    if first is not None:
        first = min(first, end - time)
    solver = DOP853(
        equations.derivative,
        time,
        state,
        end,
        rtol=tolerances.relative,
        atol=tolerances.absolute,  # type: ignore[arg-type] # it takes arrays
        first_step=first,
    )
    while solver.status == "running":
        start, before = solver.t, solver.y
        solver.step()
        if str(solver.status) == "failed" or not np.isfinite(solver.y).all():
            raise TooSmall
        yield TimeStep(start, solver.t, before, solver.y, solver.dense_output())


def exactly(
    equations: Equations, step: TimeStep, time: float, tolerances: StepTolerances
) -> Floats:
    """The state at a time within a step, as accurate as a step's end."""
    if time <= step.start:
        return step.first
    from scipy.integrate import DOP853

    solver = DOP853(
        equations.derivative,
        step.start,
        step.first,
        time,
        rtol=tolerances.relative,
        atol=tolerances.absolute,  # type: ignore[arg-type] # it takes arrays
        first_step=time - step.start,
    )
    while solver.status == "running":
        solver.step()
    return solver.y
