"""Time integration between two events: steps of an explicit method with dense output."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.system.equations import Equations
from vstatics.simulation.tolerances import BETWEEN_INSTANTS, NO_PROGRESS

if TYPE_CHECKING:
    from scipy.integrate import DOP853

_NODES = np.arange(1, 9) / 8
"""Instants of a step at which margins are evaluated, as fractions of the step."""
Between = Callable[[Floats], Floats]
"""Dense output: function from times within a step, shape (n,), to states, shape (size, n)."""


class StepTolerances(NamedTuple):
    """Tolerances of the integration."""

    relative: float
    absolute: Floats
    """Absolute tolerance of each state variable."""


class TimeStep(NamedTuple):
    """Time step with dense output."""

    start: float
    end: float
    first: Floats
    """State at the start."""
    last: Floats
    """State at the end."""
    between: Between
    exact: Callable[[float], Floats]
    """Function from a time within the step to the state, as accurate as the state at the end."""
    times: Floats
    """Instants of the step at which margins are evaluated, including the end. [s]"""
    states: Floats
    """States at `times`, shape (size, instants)."""
    nodes: Floats
    """Instants in each of the equal parts of a step, as fractions of the part, from above 0 to 1.
    """
    accuracy: float = BETWEEN_INSTANTS
    """Error of `between`, relative to the largest value in the step."""


_STEPS_OF_PROGRESS = 1000
"""Number of steps between checks of progress."""


class TooSmall(Exception):  # noqa: N818 - never raised to callers
    """Signal that steps are as small as rounding errors, or too small for progress."""


def steps(
    equations: Equations,
    begin: tuple[float, Floats],
    end: float,
    tolerances: StepTolerances,
    first: float | None,
) -> Iterator[TimeStep]:
    """Yield time steps up to a time, by the Runge-Kutta method DOP853.

    Raises
    ------
    TooSmall
    """
    if first is None and not np.isfinite(equations.derivative(*begin)).all():
        raise TooSmall  # otherwise the solver would search for a first step without end
    longest = equations.longest if equations.ports.timed else np.inf
    if first is not None:
        first = min(first, end - begin[0], longest)
    solver = _solver(equations, begin, end, tolerances, first, longest)
    number, mark = 0, solver.t
    while solver.status == "running":
        start = solver.t, solver.y
        number += 1
        if number % _STEPS_OF_PROGRESS == 0:
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

    solver = DOP853(
        equations.derivative,
        *begin,
        end,
        rtol=tolerances.relative,
        atol=tolerances.absolute,  # type: ignore[arg-type] # scipy accepts arrays
        first_step=first,
        max_step=longest,
    )
    solver.fun = equations.derivative  # without scipy's two wrappers, which count and convert
    return solver
