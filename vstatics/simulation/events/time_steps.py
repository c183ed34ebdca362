"""Time integration between two events: steps of an explicit method with dense output."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import cache, partial
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.system.equations import Equations
from vstatics.simulation.tolerances import BETWEEN_INSTANTS, NO_PROGRESS

_NODES = np.arange(1, 9) / 8
"""Instants of a step at which margins are evaluated, as fractions of the step."""
_RISING, _FALLING = np.array([[1, 1, 2, 2, 3, 3, 4], [0, 1, 1, 2, 2, 3, 3]])[:, :, None]
"""Exponents of x and of 1 - x in the dense output; see `_dense_powers`."""
_SAFETY, _LEAST_GROWTH, _MOST_GROWTH = 0.9, 0.2, 10.0
"""Safety factor of the step control; least and most growth from a step to the next. [-]"""
_BY_ERROR = -1 / 8
"""Exponent of the error in the step control. The error grows with the 8th power of the step."""
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
    next_length: float | None = None
    """Length that the step control suggests for the next step, None if unknown. [s]"""


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
        raise TooSmall  # otherwise the search for a first step would not end
    longest = equations.longest if equations.ports.timed else math.inf
    solver = _RungeKutta(equations, begin, end, tolerances, first, longest)
    number, mark = 0, solver.time
    while solver.time < end:
        start = time, state = solver.time, solver.state
        number += 1
        if number % _STEPS_OF_PROGRESS == 0:
            if time - mark < NO_PROGRESS * equations.system.scenario.span:
                raise TooSmall
            mark = time
        solver.step()
        if not np.isfinite(solver.state).all():
            raise TooSmall
        length, powers = solver.time - time, solver.dense(time, state)
        between = partial(_between, time, state, length, powers)
        times = time + length * _NODES
        times[-1] = solver.time
        states = state[:, None] + powers.dot(_AT_NODES)
        states[:, -1] = solver.state
        exact = partial(_exactly, equations, start, tolerances)
        known = time, solver.time, state, solver.state, between, exact, times, states, _NODES
        yield TimeStep(*known, next_length=solver.length)


def _between(start: float, first: Floats, length: float, powers: Floats, times: Floats) -> Floats:
    """Return the states at times within a step, shape (size, times)."""
    states: Floats = powers.dot(_dense_powers((times - start) / length))
    return states + first[:, None]


def _dense_powers(parts: Floats) -> Floats:
    """Return x, x (1 - x), x^2 (1 - x), ... for fractions x of a step, shape (7, fractions)."""
    powers: Floats = parts**_RISING * (1 - parts) ** _FALLING
    return powers


_AT_NODES = _dense_powers(_NODES)


def _exactly(
    equations: Equations, start: tuple[float, Floats], tolerances: StepTolerances, time: float
) -> Floats:
    if time <= start[0]:
        return start[1]
    solver = _RungeKutta(equations, start, time, tolerances, time - start[0])
    with suppress(TooSmall):
        while solver.time < time:
            solver.step()
    return solver.state


class _Method(NamedTuple):
    """Coefficients of DOP853, by which derivatives at the stages of a step are multiplied."""

    stages: Floats
    """Weights of the earlier derivatives in the state at each stage, shape (stages, stages)."""
    last: Floats
    """Weights of the derivatives in the state at the end of a step."""
    errors: Floats
    """Weights of the derivatives in the errors of orders 5 and 3."""
    dense: Floats
    """Weights of the derivatives in the last four coefficients of the dense output."""
    places: list[float]
    """Time of each stage, as a fraction of the step."""


@cache
def _method() -> _Method:
    from scipy.integrate import DOP853

    stages, more = np.zeros((16, 16)), DOP853.A_EXTRA
    stages[:12, :12], stages[13:] = DOP853.A, more
    places = [*DOP853.C.tolist(), 1.0, *DOP853.C_EXTRA.tolist()]
    return _Method(stages, DOP853.B, np.array([DOP853.E5, DOP853.E3]), DOP853.D, places)


class _RungeKutta:
    """Integrator by the method DOP853, with the step control of scipy.

    In small systems, `scipy.integrate.DOP853` itself takes longer than the derivatives.
    """

    def __init__(  # noqa: PLR0913, PLR0917
        self,
        equations: Equations,
        begin: tuple[float, Floats],
        end: float,
        tolerances: StepTolerances,
        first: float | None,
        longest: float = math.inf,
    ) -> None:
        self.derivative, self.end, self.tolerances = equations.derivative, end, tolerances
        self.time, self.state = begin
        self.longest = longest
        self.change = self.derivative(*begin)
        self.length = first or self._first()
        """Length of the next step, if it is not rejected. [s]"""

    def _first(self) -> float:
        from scipy.integrate import DOP853

        relative, absolute = self.tolerances
        start = self.time, self.state, self.end
        solver = DOP853(
            self.derivative,
            *start,
            max_step=self.longest,
            rtol=relative,
            atol=absolute,  # type: ignore[arg-type] # scipy accepts arrays
        )
        return float(solver.h_abs)

    def step(self) -> None:
        """Advance by one step.

        Raises
        ------
        TooSmall
            If the step would be as short as the spacing of times.
        """
        method, time, state = _method(), self.time, self.state
        least, most = 10 * math.ulp(time), _MOST_GROWTH
        length = max(min(self.length, self.longest), least)
        changes = self.changes = np.empty((16, len(state)))
        changes[0] = self.change
        while True:
            if length < least:
                raise TooSmall
            end = min(time + length, self.end)
            length = end - time
            self._stages(time, state, length, range(1, 12))
            after = state + (length * method.last).dot(changes[:12])
            changes[12] = self.derivative(end, after)
            error = self._error(after, length)
            growth = _SAFETY * error**_BY_ERROR if error else most
            if error < 1:
                break
            length *= max(_LEAST_GROWTH, growth)
            most = 1.0
        self.time, self.state, self.change = end, after, changes[12]
        self.length = length * min(most, growth)

    def _stages(self, time: float, state: Floats, length: float, numbers: range) -> None:
        method, changes = _method(), self.changes
        weights = length * method.stages
        for number in numbers:
            at = state + weights[number, :number].dot(changes[:number])
            changes[number] = self.derivative(time + method.places[number] * length, at)

    def _error(self, after: Floats, length: float) -> float:
        """Return the error of a step, relative to the tolerances."""
        relative, absolute = self.tolerances
        allowed = absolute + relative * np.maximum(np.abs(self.state), np.abs(after))
        fifth, third = _method().errors.dot(self.changes[:13]) / allowed
        square = float(fifth.dot(fifth))
        both = (square + 0.01 * float(third.dot(third))) * len(after)
        return length * square / math.sqrt(both) if both else 0.0

    def dense(self, time: float, state: Floats) -> Floats:
        """Return the dense output of the last step, which began at `time` with `state`."""
        length, changes = self.time - time, self.changes
        self._stages(time, state, length, range(13, 16))
        risen, first, last = self.state - state, length * changes[0], length * self.change
        lowest = [risen, first - risen, 2 * risen - first - last]
        return np.vstack([*lowest, (length * _method().dense).dot(changes)]).T
