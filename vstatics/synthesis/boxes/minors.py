"""Speeds in gears as polynomials of the ratios: all combinations of shift elements at once.

Engaged elements are covectors on the free speeds. What all of them make zero is one vector,
whose components are minors: with as many rows as free speeds less one, the cross product.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from vstatics.numerics.arrays import Floats, Integers
from vstatics.numerics.compiled import compiled


class GearSpeeds(NamedTuple):
    """The different speeds that gears of a scheme can have."""

    speeds: Floats
    """Polynomials of the ratios: at the corners of the bounds, then at a point within; shape
    (speeds, links, points)."""
    way: Integers
    """Which of them each combination of elements gives, shape (combinations,)."""
    still: Integers
    """The elements that do not slip then, as bits, shape (speeds,)."""


@compiled
def cross_product(rows: Floats, minors: Floats, found: Floats) -> None:
    """The vector that n rows of n + 1 numbers make zero, by minors of the first rows.

    Parameters
    ----------
    rows : array, shape (n, n + 1)
    minors : array, shape (2**(n + 1),)
        Scratch: of the columns that are bits of the index.
    found : array, shape (n + 1,)
        Takes the result.

    Examples
    --------
    >>> found = np.zeros(3)
    >>> cross_product(np.array([[1.0, 2, 0], [0, 1, 1]]), np.zeros(8), found)
    >>> found
    array([ 2., -1.,  1.])
    """
    size = rows.shape[1]
    minors[0] = 1.0
    for columns in range(1, 1 << size):
        height = 0
        for column in range(size):
            height += (columns >> column) & 1
        if height == size:
            continue
        total = 0.0
        sign = 1.0 if height % 2 == 1 else -1.0
        for column in range(size):
            if (columns >> column) & 1:
                total += sign * rows[height - 1, column] * minors[columns ^ (1 << column)]
                sign = -sign
        minors[columns] = total
    every = (1 << size) - 1
    sign = 1.0
    for column in range(size):
        found[column] = sign * minors[every ^ (1 << column)]
        sign = -sign


@compiled
def gear_speeds(
    speeds: Floats,
    factors: Floats,
    ends: Integers,
    members: Integers,
    found: Floats,
) -> None:
    """Speeds of all links with each combination engaged; polynomials, at some points.

    Parameters
    ----------
    speeds, factors : array
        Of `SpeedBases`.
    ends : array, shape (elements, 2)
        The rows of speeds that an element joins; below 0 the housing.
    members : array, shape (combinations, engaged)
        Elements of each combination.
    found : array, shape (combinations, links, points)
        Takes the result: zeros where speeds stay undetermined.
    """
    points, links, free = speeds.shape
    minors = np.zeros(1 << free)
    rows = np.zeros((free - 1, free))
    vector = np.zeros(free)
    for point in range(points):
        for which in range(members.shape[0]):
            for row in range(free - 1):
                first = ends[members[which, row], 0]
                second = ends[members[which, row], 1]
                for column in range(free):
                    rows[row, column] = speeds[point, first, column]
                    if second >= 0:
                        rows[row, column] -= speeds[point, second, column]
            cross_product(rows, minors, vector)
            for link in range(links):
                total = 0.0
                for column in range(free):
                    total += speeds[point, link, column] * vector[column]
                found[which, link, point] = total * factors[point]
