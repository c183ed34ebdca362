"""Brakes and clutches of a scheme, which are engaged together, and the speeds of links then.

Speeds are polynomials of the ratios. Engaged elements are covectors on the free speeds; what
all of them make zero is one vector, whose components are minors: with as many rows as free
speeds less one, the cross product.
"""

from __future__ import annotations

import math
from functools import cache
from itertools import combinations
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats, Integers
from vstatics.core.numerics.compiled import compiled
from vstatics.synthesis.boxes.box import HELD


class Combinations(NamedTuple):
    """Combinations of shift elements that are engaged together, of which sets are made.

    Those of the elements are ordered by their last element, then the one before, and so on:
    the number of one is a sum of binomials. Those of places in a set likewise.
    """

    ends: Integers
    """The links that an element joins, below 0 the housing, shape (elements, 2)."""
    members: Integers
    """Shape (combinations, engaged)."""
    masks: Integers
    """The same as bits, shape (combinations,)."""
    rests: Integers
    """The number of the other members without one, shape (combinations, engaged)."""
    ranks: Integers
    """Binomials of an element and a place counted from 1, shape (elements, engaged + 1)."""
    places: Integers
    """Combinations of the places in a set, shape (combinations of a set, engaged)."""
    starts: Integers
    """So many combinations of places are without a place, shape (size + 1,)."""


@cache
def combinations_table(links: int, engaged: int, size: int) -> Combinations:
    """All brakes, clutches and their combinations, with so many moving links."""
    ends = [(link, HELD) for link in range(links)] + list(combinations(range(links), 2))
    members = _ascending(len(ends), engaged)
    masks = [sum(1 << element for element in one) for one in members]
    number = {one: place for place, one in enumerate(_ascending(len(ends), engaged - 1))}
    rests = [
        [number[one[:place] + one[place + 1 :]] for place in range(engaged)] for one in members
    ]
    ranks = [[math.comb(one, place) for place in range(engaged + 1)] for one in range(len(ends))]
    starts = [math.comb(place, engaged) for place in range(size + 1)]
    places = _ascending(size, engaged)
    arrays = (
        np.array(one, np.int64) for one in (ends, members, masks, rests, ranks, places, starts)
    )
    return Combinations(*arrays)


def _ascending(number: int, size: int) -> list[tuple[int, ...]]:
    """All choices of so many of a number, ordered by the last, then the one before."""
    return sorted(combinations(range(number), size), key=lambda one: one[::-1])


@compiled
def number_of(table: Combinations, chosen: Integers, subset: int) -> int:
    """The number of a combination of a set, whose elements ascend."""
    number = 0
    for place in range(table.places.shape[1]):
        number += table.ranks[chosen[table.places[subset, place]], place + 1]
    return number


class GearSpeeds(NamedTuple):
    """The different speeds that gears of a scheme can have."""

    speeds: Floats
    """Polynomials of the ratios: at the corners of the bounds, then at a point within; shape
    (speeds, links, points)."""
    way: Integers
    """Which of them each combination of elements gives, shape (combinations,)."""


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
