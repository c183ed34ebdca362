"""Brakes and clutches of a scheme, their combinations, and the link speeds with each engaged.

Speeds are polynomials of the gear-set ratios. Each engaged element is a covector on the free
speeds. The vector of speeds that satisfies all of them consists of minors: it is the generalised
cross product of the rows, which are one fewer than the free speeds.
"""

from __future__ import annotations

import math
from functools import cache
from itertools import combinations
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats, Integers
from vstatics.core.numerics.compiled import compiled, compiled_part
from vstatics.synthesis.boxes.box import HELD


class Combinations(NamedTuple):
    """Combinations of simultaneously engaged shift elements, from which sets are formed.

    Combinations are ordered by their last element, then the second last, and so on, so the number
    of a combination is a sum of binomials. Combinations of places in a set have the same order.
    """

    ends: Integers
    """Two links that each element connects, negative for the housing, shape (elements, 2)."""
    members: Integers
    """Elements of each combination, ascending, shape (combinations, engaged)."""
    masks: Integers
    """Elements of each combination, as bits, shape (combinations,)."""
    rests: Integers
    """Number of the smaller combination that remains without each member, shape (combinations,
    engaged)."""
    ranks: Integers
    """Binomials of an element and a place counted from 1, shape (elements, engaged + 1)."""
    places: Integers
    """Combinations of the places in a set, shape (combinations of a set, engaged)."""
    starts: Integers
    """Number of combinations that only use places before a place, shape (size + 1,)."""


@cache
def combinations_table(links: int, engaged: int, size: int) -> Combinations:
    """Return all brakes and clutches of moving links, and all combinations."""
    ends = [(link, HELD) for link in range(links)] + list(combinations(range(links), 2))
    members = _ascending(len(ends), engaged)
    masks = [sum(1 << element for element in row) for row in members]
    number = {row: place for place, row in enumerate(_ascending(len(ends), engaged - 1))}
    rests = [
        [number[row[:place] + row[place + 1 :]] for place in range(engaged)] for row in members
    ]
    ranks = [
        [math.comb(element, place) for place in range(engaged + 1)] for element in range(len(ends))
    ]
    starts = [math.comb(place, engaged) for place in range(size + 1)]
    places = _ascending(size, engaged)
    arrays = (
        np.array(rows, np.int64) for rows in (ends, members, masks, rests, ranks, places, starts)
    )
    return Combinations(*arrays)


def integers(*shape: int) -> Integers:
    """Return zeros of type int64."""
    return np.zeros(shape, np.int64)


def _ascending(number: int, size: int) -> list[tuple[int, ...]]:
    """Return all choices of `size` numbers, ordered by the last, then the second last."""
    return sorted(combinations(range(number), size), key=lambda choice: choice[::-1])


@compiled_part
def number_of(table: Combinations, chosen: Integers, subset: int) -> int:
    """Return the number of a combination of places in a set with ascending elements."""
    number = 0
    for place in range(table.places.shape[1]):
        number += table.ranks[chosen[table.places[subset, place]], place + 1]
    return number


class GearSpeeds(NamedTuple):
    """Link speeds in the gears of a scheme; equal speeds of several gears are stored once."""

    speeds: Floats
    """Polynomials of the ratios at the corners of the bounds, then at a point within; shape
    (speeds, links, points)."""
    way: Integers
    """Index of the speeds of each combination of elements, shape (combinations,)."""


@compiled_part
def cross_product(rows: Floats, minors: Floats, product: Floats) -> None:
    """Calculate the vector orthogonal to n rows of n + 1 numbers, from minors of the rows.

    Parameters
    ----------
    rows : array, shape (n, n + 1)
    minors : array, shape (2**(n + 1),)
        Work array: minors of the columns given by the bits of the index.
    product : array, shape (n + 1,)
        Receives the result.

    Examples
    --------
    >>> product = np.zeros(3)
    >>> cross_product(np.array([[1.0, 2, 0], [0, 1, 1]]), np.zeros(8), product)
    >>> product
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
        product[column] = sign * minors[every ^ (1 << column)]
        sign = -sign


@compiled
def gear_speeds(
    speeds: Floats,
    factors: Floats,
    ends: Integers,
    members: Integers,
    polynomials: Floats,
) -> None:
    """Calculate the speeds of all links with each combination of elements engaged.

    Parameters
    ----------
    speeds, factors : array
        Fields of `SpeedBases`.
    ends : array, shape (elements, 2)
        Rows of speeds that an element connects, negative for the housing.
    members : array, shape (combinations, engaged)
        Elements of each combination.
    polynomials : array, shape (combinations, links, points)
        Receives the speeds; zeros where they remain undetermined.
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
                polynomials[which, link, point] = total * factors[point]
