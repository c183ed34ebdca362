"""Least squares within bounds by the Levenberg-Marquardt method, from many starting points."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats, Integers
from vstatics.synthesis.tolerances import (
    EQUAL_SUM_OF_SQUARES,
    LEAST_DAMPING,
    LEAST_FIT_STEP,
    LEAST_SCALE,
    NO_SQUARES,
)

MOST_FIT_STEPS = 300
"""Largest number of steps from a starting point."""
LAST_STEPS = 10
"""Number of steps without progress after which a fit has converged."""
LONGEST_STEP = 1.0
"""Largest change of an unknown (a logarithm) in a step. [-]"""

Residuals = Callable[[Floats, Integers], tuple[Floats, Floats]]
"""Function of unknowns, shape (n, unknowns), and of the indices of the n starting points.

It returns residuals, shape (n, residuals), and derivatives with respect to the unknowns; NaN where
undefined.
"""


class Minima(NamedTuple):
    """End points of the fits from all starting points."""

    unknowns: Floats
    """Unknowns at the end points, shape (starts, unknowns)."""
    squares: Floats
    """Sums of squares at the end points, infinite for invalid starts, shape (starts,)."""
    settled: Booleans
    """True if the end point is a minimum, shape (starts,)."""


@np.errstate(all="ignore")
def minimize(
    residuals: Residuals, starts: Floats, low: Floats, high: Floats, steps: int = MOST_FIT_STEPS
) -> Minima:
    """Minimise the sum of squares from each of many starting points.

    In a Levenberg-Marquardt step, an unknown at a bound does not move if the slope points outwards.
    Steps are clipped to the bounds.

    Parameters
    ----------
    residuals : callable
        Function of the type `Residuals`.
    starts, low, high : ndarray, shape (starts, unknowns)
        Starting points and bounds.
    steps : int
        Largest number of steps from each starting point.

    Examples
    --------
    ``x^2 = 4`` from both sides of 2, and with 2 out of bounds:

    >>> def square(x, starts):
    ...     return x**2 - 4, 2 * x[:, :, np.newaxis]
    >>> low, high = np.array([[-9.0], [0.0], [0.0]]), np.array([[0.0], [9.0], [1.5]])
    >>> minimize(square, np.array([[-1.0], [1.0], [1.0]]), low, high).unknowns.round(9)
    array([[-2. ],
           [ 2. ],
           [ 1.5]])
    """
    unknowns = starts.copy()
    count = unknowns.shape[1]
    values, slopes = map(np.array, residuals(unknowns, np.arange(len(unknowns))))
    squares = _squares(values)
    settled = np.zeros(len(unknowns), np.bool_)
    damping = np.full(len(unknowns), 1e-2)
    flat = np.zeros(len(unknowns), np.int64)
    going = np.flatnonzero(np.isfinite(squares))
    for _ in range(steps):
        if not len(going):
            break
        here, least, most = unknowns[going], low[going], high[going]
        steep = slopes[going]
        downhill = -np.einsum("srk,sr->sk", steep, values[going])
        free = ~((here <= least) & (downhill < 0) | (here >= most) & (downhill > 0))
        downhill = np.where(free, downhill, 0.0)
        normal = np.einsum("srk,srl->skl", steep, steep)
        normal *= free[:, :, np.newaxis] & free[:, np.newaxis, :]
        scale = np.maximum(normal.max(axis=(1, 2)), LEAST_SCALE)
        diagonal = damping[going, np.newaxis] * scale[:, np.newaxis] + ~free
        normal[:, range(count), range(count)] += diagonal
        step = np.linalg.solve(normal, downhill[:, :, np.newaxis])[:, :, 0]
        there = np.clip(here + np.clip(step, -LONGEST_STEP, LONGEST_STEP), least, most)
        trial = residuals(there, going)
        reached = _squares(trial[0])
        better = reached <= squares[going] * (1 + EQUAL_SUM_OF_SQUARES)
        flat[going] += better & (reached >= squares[going] * (1 - EQUAL_SUM_OF_SQUARES))
        unknowns[going[better]] = there[better]
        squares[going[better]] = reached[better]
        values[going[better]], slopes[going[better]] = (part[better] for part in trial)
        damping[going] *= np.where(better, 0.1, 8.0)
        np.maximum(damping, LEAST_DAMPING, out=damping)
        stays = np.abs(there - here).max(axis=1) <= LEAST_FIT_STEP
        done = (
            (squares[going] < NO_SQUARES)
            | stays
            | (damping[going] > 1 / LEAST_FIT_STEP)
            | (flat[going] > LAST_STEPS)
        )
        settled[going[done]] = True
        going = going[~done]
    return Minima(unknowns, squares, settled)


def _squares(values: Floats) -> Floats:
    sums = np.square(values).sum(axis=1)
    return np.where(np.isfinite(sums), sums, np.inf)
