"""Frequency and logarithmic decrement of a recorded free vibration.

Source: I. S. Tsitovich, V. B. Algin, Vehicle dynamics (1981), appendix 2, (П2.1), (П2.3).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import count_of
from vstatics.core.numerics.arrays import Floats
from vstatics.torsion.tolerances import UNDAMPED

LEAST_EXTREMES = 5
"""Smallest number of extremes: a period needs three inner extremes, which have amplitudes."""


class Decay(NamedTuple):
    """Frequency and decrement of a free vibration with linear damping."""

    omega: float
    """Angular frequency. [rad/s]"""
    decrement: float
    """Logarithmic decrement. [-]"""
    mean_line: tuple[float, ...]
    """Mean line at the inner extremes. [unit of the record]"""
    amplitudes: tuple[float, ...]
    """Amplitudes of the inner extremes, measured from the mean line. [unit of the record]"""


def decay(peaks: Sequence[float], period: float) -> Decay:
    """Return frequency and decrement from successive extremes M_k, (П2.1).

    The mean line is (M_k-1 + 2 M_k + M_k+1)/4. It still contains some of the vibration, but the
    same fraction of all amplitudes. The decrement is therefore exact, even if the mean drifts
    linearly.

    Parameters
    ----------
    period : float
        Time between successive maxima. [s]

    Raises
    ------
    ValueError
        If the values are not extremes, are too few, or do not decay.

    Examples
    --------
    >>> vibration = decay([160, -51.148655, 109.233977, -12.588199, 79.944530, 9.659249], 0.2)
    >>> round(vibration.decrement, 6), [round(mean, 3) for mean in vibration.mean_line]
    (0.55, [41.734, 38.683, 41.001, 39.24])
    """
    if len(peaks) < LEAST_EXTREMES:
        expected = f"expected {LEAST_EXTREMES} at least"
        raise ValueError(f"read {count_of('extreme', len(peaks))} of a vibration, {expected}")
    values = np.array(peaks, dtype=float)
    with np.errstate(over="ignore"):
        directions = np.sign(np.diff(values))
    if not (directions[1:] * directions[:-1] < 0).all():
        raise ValueError("expected extremes that rise and fall in turn")
    with np.errstate(all="ignore"):
        mean_line = (values[:-2] + 2 * values[1:-1] + values[2:]) / 4
        amplitudes = np.abs(values[1:-1] - mean_line)
        decrement = float(np.mean(np.log(amplitudes[:-2] / amplitudes[2:])))
    if not -UNDAMPED <= decrement < math.inf:
        raise ValueError(f"the decrement is {decrement:g}, expected extremes that decay")
    of_extremes = tuple(mean_line.tolist()), tuple(amplitudes.tolist())
    return Decay(2 * math.pi / period, max(decrement, 0.0), *of_extremes)


def recorded_decay(times: Floats, values: Floats) -> Decay:
    """Return frequency and decrement from samples of a record.

    Each extreme is the vertex of a parabola through three samples.

    Parameters
    ----------
    times : ndarray
        Ascending times of the samples. [s]
    values : ndarray
        Samples, in any unit.

    Raises
    ------
    ValueError
        If the record has too few extremes, or they do not decay.

    Examples
    --------
    >>> times = np.linspace(0, 1, 1001)
    >>> vibration = recorded_decay(times, 5 + np.exp(-times) * np.cos(20 * times))
    >>> round(vibration.omega, 3), round(vibration.decrement / (math.pi / 10), 3)
    (20.0, 1.0)
    """
    differences = np.diff(values)
    moving = np.flatnonzero(differences)
    reversals = np.flatnonzero(
        np.sign(differences[moving[1:]]) != np.sign(differences[moving[:-1]])
    )
    middle_places = moving[reversals] + 1
    first, middle, last = times[middle_places - 1], times[middle_places], times[middle_places + 1]
    slope = differences[middle_places - 1] / (middle - first)
    curvature = (differences[middle_places] / (last - middle) - slope) / (last - first)
    vertex_times = (first + middle) / 2 - slope / (2 * curvature)
    peaks = values[middle_places - 1] + (vertex_times - first) * (
        slope + curvature * (vertex_times - middle)
    )
    period = 2 * float(np.mean(np.diff(vertex_times))) if len(vertex_times) > 1 else math.nan
    return decay(peaks.tolist(), period)
