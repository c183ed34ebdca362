"""Times at which quantities of a motion first reach target values within a time step."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.simulation.events.location import minima
from vstatics.simulation.events.time_steps import TimeStep


def first_reached(
    step: TimeStep, values: Floats, value_at: Callable[[float], float], target: float, near: float
) -> float | None:
    """Return the first time in a step at which a quantity reaches a target, if any [s].

    Parameters
    ----------
    step : TimeStep
    values : ndarray, shape (1 + instants,)
        Values at the start and at the instants of the step.
    value_at : callable
        Function from a time within the step to the value.
    target : float
    near : float
        Difference that counts as rounding error. A quantity that is held at its target can have
        such an error, of either sign.
    """
    side = -1.0 if values[0] < target else 1.0

    def height(time: float) -> float:
        return side * (value_at(time) - target)

    heights, times = side * (values - target), np.append(step.start, step.times).tolist()
    reached = np.flatnonzero(heights <= near).tolist()
    if 0 in reached:
        return step.start
    gap = reached[0] - 1 if reached else len(step.times) - 1
    bracket = (times[gap], times[gap + 1]) if reached else None
    for number, _, time in minima(step, heights[None]):
        if number <= gap and height(time) <= near:
            bracket = times[number], time
            break
    if bracket is None or height(bracket[1]) >= 0:
        return bracket and bracket[1]
    from scipy.optimize import brentq

    return float(brentq(height, *bracket))
