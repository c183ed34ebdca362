"""Slopes of torques, and of rates of control values, in a state of the motion."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from vstatics.core.numerics.arrays import Floats, largest
from vstatics.simulation.system.equations import Equations
from vstatics.simulation.tolerances import DIFFERENCE_STEP


def slopes_by_rate(equations: Equations, time: float, state: Floats) -> Floats:
    """Return the derivative of each torque with respect to the rate of the port [N*m*s/rad].

    Feedback torques are left out; `slopes_by_state` contains their derivatives.
    """
    rates, _ = equations.rates(time, state)
    step = DIFFERENCE_STEP * max(1.0, largest(rates))
    slopes = equations.ports.by_rate.copy()
    limited = equations.layout.springs + np.flatnonzero(equations.limited)
    for port in {*equations.ports.bending}.difference(limited.tolist(), equations.coupled):
        near = [rates.copy(), rates.copy()]
        near[0][port] -= step
        near[1][port] += step
        low, high = (equations.torques(time, state, at)[port] for at in near)
        slopes[port] = (high - low) / (2 * step)
    return np.where(np.isfinite(slopes), slopes, 0.0)


def slopes_by_state(equations: Equations, time: float, state: Floats) -> Floats:
    """Return derivatives of feedback torques and of rates of values with respect to the state.

    Returns
    -------
    ndarray, shape (ports + values, size of [q, e, phi, v])
    """
    looks, first = equations.coupled, equations.layout.ports
    slopes = np.zeros((first + len(equations.layout.values), equations.works.start))
    for index, curve in equations.ports.struts:
        twist = equations.twists.start + index
        slopes[equations.layout.springs + index, twist] = curve.strut.slope(float(state[twist]))
    if not looks and not equations.layout.values:
        return slopes

    def seen(at: Floats) -> Floats:
        rates, torques = equations.acting(time, at)
        change = equations.derivative(time, at) if equations.layout.hot else at
        return np.append(torques[looks], equations.changes.at(time, at, rates, torques, change))

    rows = [*looks, *range(first, len(slopes))]
    now, finest = seen(state), equations.ports.finest(equations.rates(time, state)[0])
    for index in range(equations.works.start):
        step = DIFFERENCE_STEP * max(1.0, abs(float(state[index])))
        if index < equations.motions:
            step = min(step, finest)

        def moved(length: float, index: int = index) -> Floats:
            near = state.copy()
            near[index] += length
            return seen(near)

        slopes[rows, index] = _slope_off_jumps(moved, now, step)
    return np.where(np.isfinite(slopes), slopes, 0.0)


def _slope_off_jumps(function: Callable[[float], Floats], now: Floats, step: float) -> Floats:
    """Return the derivatives of functions at 0.

    At a jump or bend, the side with the smaller change gives the derivative, because a difference
    quotient across a jump grows as its step shrinks.

    >>> def function(x):
    ...     return np.array([3 * x + (x > 0), 3 * x + (x > 5e-7), max(x, 0)])
    >>> _slope_off_jumps(function, function(0.0), 1e-6).round(9)
    array([3., 3., 0.])
    """
    below, above = now - function(-step), function(step) - now
    bends = np.abs(below - above) > 0.5 * np.maximum(np.abs(below), np.abs(above))
    smaller = np.where(np.abs(below) < np.abs(above), below, above)
    slopes: Floats = np.where(bends, smaller, 0.5 * (below + above)) / step
    return slopes
