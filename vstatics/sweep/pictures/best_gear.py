"""Regions of a map in which one gear has a larger value than all other gears."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.pictures.drawing.tolerances import SAME_CURVE

FINE_GRID = 240
"""Smallest number of grid intervals in each direction for the calculation of regions."""


class GearRegion(NamedTuple):
    """Region of a map in which a gear is the best, on a grid."""

    gear: str
    lead: Floats
    """Value of the gear minus the largest value of the other gears, shape (y, x).

    The difference is positive within the region, and NaN where no gear has a value.
    """


def gear_regions(gears: Sequence[str], values: Floats) -> list[GearRegion]:
    """Return the regions of the gears that are best somewhere; of equal gears, the first is best.

    Parameters
    ----------
    gears : sequence of str
    values : ndarray
        Value of each gear on a grid, shape (gears, y, x); NaN where undefined.

    Examples
    --------
    >>> regions = gear_regions(["1", "2"], np.array([[[1.0, np.nan]], [[0.5, 3.0]]]))
    >>> [(region.gear, (region.lead > 0).tolist()) for region in regions]
    [('1', [[True, False]]), ('2', [[False, True]])]
    """
    exists = np.isfinite(values)
    size = float(np.abs(values[exists]).max()) or 1.0
    absent = float(values[exists].min()) - size
    order = np.arange(len(gears))[:, None, None]
    ranked = np.where(exists, values - SAME_CURVE * size * order, absent)
    regions = []
    for number, gear in enumerate(gears):
        others = np.delete(ranked, number, axis=0).max(axis=0, initial=absent)
        lead = np.where(exists.any(axis=0), ranked[number] - others, np.nan)
        if (lead > 0).any():
            regions.append(GearRegion(gear, lead))
    return regions


def refined(x: Floats, y: Floats, values: Floats) -> tuple[Floats, Floats, Floats]:
    """Return a finer grid with bilinear interpolation, so that regions meet without gaps.

    >>> xs, ys, zs = refined(np.array([0.0, 1.0]), np.array([0.0, 2.0]), np.ones((3, 2, 2)))
    >>> xs.shape, ys.shape, zs.shape
    ((241,), (241,), (3, 241, 241))
    """
    for axis in (1, 2):
        points = (y, x)[axis - 1]
        parts = math.ceil(FINE_GRID / (len(points) - 1))
        places = np.linspace(0, len(points) - 1, parts * (len(points) - 1) + 1)
        low = np.minimum(places.astype(int), len(points) - 2)
        share = (places - low).reshape((-1, 1) if axis == 1 else (1, -1))
        before, after = (np.take(values, index, axis=axis) for index in (low, low + 1))
        between = before * (1 - share) + after * share
        values = np.where(share == 0, before, np.where(share == 1, after, between))
        fine = np.interp(places, np.arange(len(points)), points)
        x, y = (x, fine) if axis == 1 else (fine, y)
    return x, y, values


def deepest(inside: Booleans) -> tuple[int, int]:
    """Return the row and column of a point of a region that is far from the edge.

    >>> deepest(np.pad(np.ones((3, 5), bool), 2))
    (3, 4)
    """
    shrunk = np.pad(inside, 1)
    while shrunk.any():
        left = shrunk
        core = left[1:-1, 1:-1]
        around = left[:-2, 1:-1] & left[2:, 1:-1] & left[1:-1, :-2] & left[1:-1, 2:]
        shrunk = np.pad(core & around, 1)
    rows, columns = np.nonzero(left[1:-1, 1:-1])
    place = len(rows) // 2
    return int(rows[place]), int(columns[place])
