"""Speeds that the links of a scheme can have under the equations of its gear sets alone."""

from __future__ import annotations

from functools import cache
from itertools import combinations, product
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.synthesis.boxes.box import BoxSearch
from vstatics.synthesis.boxes.schemes.choices import BoxScheme


class SpeedBases(NamedTuple):
    """Bases of the possible speeds of moving links, at given ratios of the gear sets."""

    ratios: Floats
    """Basic ratios: all corners of the bounds, where set j is at its upper bound if bit j of the
    row number is set, then one point within; shape (points, sets). [-]"""
    speeds: Floats
    """Columns that span the possible speeds, shape (points, moving links, free speeds). [-]"""
    factors: Floats
    """Factors that make minors of `speeds` polynomials of the ratios, shape (points,)."""
    moving: tuple[int, ...]
    """Link of each row of speeds; links without a member of a gear set are last."""


def speed_bases(search: BoxSearch, scheme: BoxScheme) -> SpeedBases:
    """Calculate the speeds that Willis' equations permit, w_a - K w_b - (1 - K) w_h = 0.

    The columns of the equations are split into dependent and free speeds; the determinant of the
    dependent columns is the factor.

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
    """Return a point within the unit cube where no two ratios are equal by chance."""
    return np.asarray(np.sqrt(np.array([2, 3, 5, 7, 11, 13, 17, 19, 23, 29][:sets])) % 1)


def _points(bounds: tuple[float, float], meshed: tuple[bool, ...]) -> Floats:
    """Return the corners of the bounds, then a point within, shape (points, sets)."""
    low, high = bounds
    ends = [corner[::-1] for corner in product((low, high), repeat=len(meshed))]
    within = low * (high / low) ** _inner(len(meshed))
    return np.array([*ends, within]) * np.where(meshed, 1.0, -1.0)
