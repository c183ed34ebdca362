"""Frequency and decrement of a free vibration that was recorded.

Source: I. S. Tsitovich, V. B. Algin, Vehicle dynamics (1981), appendix 2, (П2.1), (П2.3).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.torsion.tolerances import UNDAMPED

LEAST_EXTREMES = 5
"""Three of them are inner ones with amplitudes, of which two are a period apart."""


class Decay(NamedTuple):
    """A free vibration."""

    omega: float
    """[rad/s]"""
    decrement: float
    """Logarithmic. [-]"""
    mean_line: tuple[float, ...]
    """At the inner extremes, in the unit of the record."""
    amplitudes: tuple[float, ...]
    """Likewise, from the mean line."""


def decay(peaks: Sequence[float], period: float) -> Decay:
    """The vibration of extremes that follow each other.

    The mean line is (M_k-1 + 2 M_k + M_k+1)/4: what is left of the vibration in it is one part of
    all amplitudes, so the decrement is exact, also where the mean drifts evenly.

    Parameters
    ----------
    period : float
        From an extreme to the next but one. [s]

    Raises
    ------
    ValueError
        If these are no extremes, too few of them, or they do not decay.

    Examples
    --------
    >>> made = decay([160, -51.148655, 109.233977, -12.588199, 79.944530, 9.659249], 0.2)
    >>> round(made.decrement, 6), [round(one, 3) for one in made.mean_line]
    (0.55, [41.734, 38.683, 41.001, 39.24])
    """
    if len(peaks) < LEAST_EXTREMES:
        expected = f"expected {LEAST_EXTREMES} at least"
        raise ValueError(f"read {len(peaks)} extremes of a vibration, {expected}")
    values = np.array(peaks, dtype=float)
    with np.errstate(over="ignore"):
        ways = np.sign(np.diff(values))
    if not (ways[1:] * ways[:-1] < 0).all():
        raise ValueError("expected extremes that rise and fall in turn")
    with np.errstate(all="ignore"):
        mean_line = (values[:-2] + 2 * values[1:-1] + values[2:]) / 4
        amplitudes = np.abs(values[1:-1] - mean_line)
        decrement = float(np.mean(np.log(amplitudes[:-2] / amplitudes[2:])))
    if not -UNDAMPED <= decrement < math.inf:
        raise ValueError(f"the decrement is {decrement:g}, expected extremes that decay")
    made = tuple(mean_line.tolist()), tuple(amplitudes.tolist())
    return Decay(2 * math.pi / period, max(decrement, 0.0), *made)


def recorded_decay(times: Floats, values: Floats) -> Decay:
    """The vibration of a record; an extreme is that of the parabola through three samples.

    Parameters
    ----------
    times : ndarray
        Which rise. [s]
    values : ndarray
        In any unit.

    Raises
    ------
    ValueError
        As `decay`.

    Examples
    --------
    >>> times = np.linspace(0, 1, 1001)
    >>> made = recorded_decay(times, 5 + np.exp(-times) * np.cos(20 * times))
    >>> round(made.omega, 3), round(made.decrement / (math.pi / 10), 3)
    (20.0, 1.0)
    """
    ways = np.diff(values)
    moving = np.flatnonzero(ways)
    turns = np.flatnonzero(np.sign(ways[moving[1:]]) != np.sign(ways[moving[:-1]]))
    at = moving[turns] + 1
    first, middle, last = times[at - 1], times[at], times[at + 1]
    slope = ways[at - 1] / (middle - first)
    bend = (ways[at] / (last - middle) - slope) / (last - first)
    top = (first + middle) / 2 - slope / (2 * bend)
    peaks = values[at - 1] + (top - first) * (slope + bend * (top - middle))
    period = 2 * float(np.mean(np.diff(top))) if len(top) > 1 else math.nan
    return decay(peaks.tolist(), period)
