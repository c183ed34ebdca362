"""Grids of maps, and levels of their contours."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.tri import LinearTriInterpolator, Triangulation

from vstatics.core.errors import CaseError
from vstatics.core.numerics.arrays import Floats
from vstatics.pictures.drawing.labels import ticks

MAP_LEVELS = 9
"""Approximate number of contours."""
MOST_LEVELS = 16
"""Number of levels at equal steps that is tried if `MAP_LEVELS` levels leave a crowded band.
"""
CROWDED_BAND = 0.35
"""Fraction of all values in a band above which levels follow quantiles, not equal steps. [-]"""
LEAST_BAND = 0.02
"""Smallest width of a band, relative to the range of values. [-]"""
FEW_LEVELS = 5
"""Smallest number of levels near quantiles; if there are fewer, levels have equal steps."""
LEAST_FILLED = 0.5
"""Smallest fraction of filled grid points at which points count as a rectangular grid. [-]"""
GRID_OF_POINTS = 121
"""Number of interpolated points in each direction, for points that do not form a grid."""


def grid_of(x: Floats, y: Floats, z: Floats) -> tuple[Floats, Floats, Floats]:
    """Return the axes of a grid through points, and the values on the grid, interpolated if needed.

    Raises
    ------
    CaseError
        If the points lie on a line.
    """
    known = np.isfinite(x) & np.isfinite(y)
    x, y, z = x[known], y[known], z[known]
    xs, column = np.unique(x, return_inverse=True)
    ys, row = np.unique(y, return_inverse=True)
    if min(len(xs), len(ys)) < 2:
        raise CaseError("E434", "a map needs two numbers that vary: use --kind curves")
    if len(x) >= LEAST_FILLED * len(xs) * len(ys):
        table = np.full((len(ys), len(xs)), np.nan)
        table[row, column] = z
        return xs, ys, table
    xs, ys = (np.linspace(points.min(), points.max(), GRID_OF_POINTS) for points in (x, y))
    exists = np.isfinite(z)
    try:
        net = Triangulation(x[exists], y[exists])
        drawn = LinearTriInterpolator(net, z[exists])(*np.meshgrid(xs, ys))
    except (ValueError, RuntimeError):
        raise CaseError("E434", "the points of the sweep span no area to draw a map on") from None
    return xs, ys, np.ma.filled(drawn, np.nan)


def even_levels(low: float, high: float, count: int) -> list[float]:
    """Return about `count` multiples of a round step between two numbers.

    >>> even_levels(0.0, 3.0, 10), len(even_levels(0.0, 3.0, 15))
    ([0.2, 0.4, 0.6, 0.8, 1.0, 1.2, 1.4, 1.6, 1.8, 2.0, 2.2, 2.4, 2.6, 2.8], 14)
    """
    if not low < high:
        return []
    unit = 10.0 ** math.floor(math.log10((high - low) / (count + 1)))
    choices = []
    for step in (unit, 2 * unit, 5 * unit, 10 * unit):
        multiples = range(math.floor(low / step), math.ceil(high / step) + 1)
        levels = dict.fromkeys(float(f"{number * step:.12g}") for number in multiples)
        choices.append([level for level in levels if low < level < high])
    return min(choices, key=lambda levels: abs(len(levels) - count))


def contour_levels(values: Floats) -> list[float]:
    """Return round contour levels: at equal steps, or near quantiles of the values.

    Quantiles are used if most values would be in one band. If the levels near quantiles are few, a
    tenth of the values at one end is left out, and steps are equal. So efficiencies from 0.9 to
    0.97 stay visible even if an efficiency of 0.5 occurs in a corner.

    >>> contour_levels(np.linspace(0.0, 10.0, 101))
    [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]
    >>> contour_levels(1 - 0.5 * np.linspace(0.0, 1.0, 1001) ** 8)
    [0.8, 0.82, 0.84, 0.86, 0.88, 0.9, 0.92, 0.94, 0.96, 0.98]
    """
    low, high = float(values.min()), float(values.max())
    for most in (MAP_LEVELS, MOST_LEVELS):
        even = [tick for tick in ticks(low, high, most + 1) if low < tick < high]
        between, _ = np.histogram(values, [-math.inf, *even, math.inf])
        if between.max() <= CROWDED_BAND * len(values):
            return even
    quantiles = np.quantile(values, np.linspace(0.0, 1.0, MAP_LEVELS + 2)).tolist()
    levels: list[float] = []
    for before, quantile, after in zip(quantiles, quantiles[1:], quantiles[2:], strict=False):
        gap = min(quantile - before, after - quantile)
        if gap > LEAST_BAND * (high - low):
            unit = 10.0 ** math.floor(math.log10(gap))
            step = max(digit * unit for digit in (1, 2, 5) if digit * unit <= gap)
            level = float(f"{round(quantile / step) * step:.12g}")
            if before < level < after and level not in levels:
                levels.append(level)
    if len(levels) >= FEW_LEVELS:
        return levels
    is_low = quantiles[1] - low > high - quantiles[-2]
    least, largest = (quantiles[1], high) if is_low else (low, quantiles[-2])
    return even_levels(least, largest, MAP_LEVELS) or levels
