"""What speeds the links of a scheme can have, as its sets tell alone."""

from __future__ import annotations

from functools import cache
from itertools import combinations, product
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats
from vstatics.synthesis.boxes.box import BoxSearch
from vstatics.synthesis.boxes.schemes.choices import BoxScheme


class SpeedBases(NamedTuple):
    """What speeds the moving links of a scheme can have, at some ratios of its sets."""

    ratios: Floats
    """Internal ratios: all corners of the bounds, set j at its upper bound where bit j of the
    row's number is set, then one point within; shape (points, sets). [-]"""
    speeds: Floats
    """Columns span the speeds, shape (points, moving links, free speeds). [-]"""
    factors: Floats
    """By which minors of `speeds` become polynomials of the ratios, shape (points,)."""
    moving: tuple[int, ...]
    """The link that each row of speeds is of, those without a member of a set last."""


def speed_bases(search: BoxSearch, one: BoxScheme) -> SpeedBases:
    """The speeds that are left by Willis' equations, w_a - K w_b - (1 - K) w_h = 0.

    With the equations as rows of a matrix, its columns are split into some that are solved
    for and the free ones: the determinant of the former is the factor.

    Examples
    --------
    >>> from vstatics.synthesis.boxes.schemes.stems import box_schemes
    >>> search = BoxSearch(1, 1, 1, (3.0,))
    >>> bases = speed_bases(search, next(box_schemes(search)))
    >>> bases.ratios[:2].ravel().tolist(), bases.speeds.shape, bases.moving
    ([-1.4, -5.0], (3, 3, 2), (0, 1, 2))
    """
    links = range(search.moving + bool(search.fixed))
    moving = tuple(link for link in links if link != one.held)
    ratios = _points(search.bounds, one.meshed)
    rows = np.zeros((len(ratios), search.sets, len(links)))
    for number, (sun, carrier, ring) in enumerate(one.scheme.sets):
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
    """A point within the unit cube, where no two ratios agree by chance."""
    return np.asarray(np.sqrt(np.array([2, 3, 5, 7, 11, 13, 17, 19, 23, 29][:sets])) % 1)


def _points(bounds: tuple[float, float], meshed: tuple[bool, ...]) -> Floats:
    """Corners of the bounds, then a point within, shape (points, sets)."""
    low, high = bounds
    ends = [one[::-1] for one in product((low, high), repeat=len(meshed))]
    within = low * (high / low) ** _inner(len(meshed))
    return np.array([*ends, within]) * np.where(meshed, 1.0, -1.0)
