"""Link speeds of a scheme that the equations of the gear sets permit, without shift elements."""

from __future__ import annotations

from functools import cache
from itertools import combinations, product
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.synthesis.boxes.box import BoxSearch
from vstatics.synthesis.boxes.schemes.choices import BoxScheme


class SpeedBases(NamedTuple):
    """Basis of the possible speeds of the moving links, at several points of gear-set ratios."""

    ratios: Floats
    """Basic ratio of each gear set at each point, shape (points, sets): all corners of the bounds,
    then a point within. At corner n, set j has the upper bound if bit j of n is 1. [-]
    """
    speeds: Floats
    """Columns that span the possible link speeds, shape (points, moving links, free speeds). [-]"""
    factors: Floats
    """Factors that turn minors of `speeds` into polynomials of the gear-set ratios, (points,). [-]
    """
    moving: tuple[int, ...]
    """Number of the link of each row of `speeds`. Links without a gear-set member are last."""


def speed_bases(search: BoxSearch, scheme: BoxScheme) -> SpeedBases:
    """Calculate a basis of the speeds that satisfy Willis' equation of each gear set.

    The equation of sun a, ring b and carrier h with basic ratio K is w_a - K w_b - (1 - K) w_h = 0.
    The speeds are split into dependent and free speeds; the factor is the determinant of the
    columns of the dependent speeds.

    Examples
    --------
    >>> from vstatics.synthesis.boxes.schemes.stems import box_schemes
    >>> search = BoxSearch(1, 1, 1, (3.0,))
    >>> bases = speed_bases(search, next(box_schemes(search)))
    >>> bases.ratios[:2].ravel().tolist(), bases.speeds.shape, bases.moving
    ([-1.4, -5.0], (3, 3, 2), (0, 1, 2))
    """
    links = range(search.moving + bool(search.fixed))
    moving = tuple(link for link in links if link != scheme.held)
    ratios = _points(search.bounds, scheme.meshed)
    rows = np.zeros((len(ratios), search.sets, len(links)))
    for number, (sun, carrier, ring) in enumerate(scheme.scheme.sets):
        rows[:, number, sun] = 1
        rows[:, number, ring] = -ratios[:, number]
        rows[:, number, carrier] = ratios[:, number] - 1
    rows = rows[:, :, moving]
    choices = np.array(list(combinations(range(len(moving)), search.sets)))
    determinants = np.linalg.det(rows[:, :, choices].transpose(0, 2, 1, 3))
    solved = choices[np.abs(determinants).min(axis=0).argmax()]
    free = np.setdiff1d(np.arange(len(moving)), solved)
    speeds = np.zeros((len(ratios), len(moving), len(free)))
    speeds[:, free, np.arange(len(free))] = 1
    speeds[:, solved] = -np.linalg.solve(rows[:, :, solved], rows[:, :, free])
    return SpeedBases(ratios, speeds, np.linalg.det(rows[:, :, solved]), moving)


@cache
def _inner(sets: int) -> Floats:
    """Return a point in the unit cube, chosen so that no two gear ratios are equal by chance."""
    return np.asarray(np.sqrt(np.array([2, 3, 5, 7, 11, 13, 17, 19, 23, 29][:sets])) % 1)


def _points(bounds: tuple[float, float], meshed: tuple[bool, ...]) -> Floats:
    """Return the corners of the bounds of the ratios, then a point within, (points, sets)."""
    low, high = bounds
    ends = [corner[::-1] for corner in product((low, high), repeat=len(meshed))]
    within = low * (high / low) ** _inner(len(meshed))
    return np.array([*ends, within]) * np.where(meshed, 1.0, -1.0)
