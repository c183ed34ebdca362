"""Combinations of engaged brakes and clutches of a scheme, and the link speeds with each.

Each engaged shift element gives a linear equation of the free speeds. There is one equation less
than free speeds, so the solution is the generalised cross product of the equations. It consists of
minors, which are polynomials of the gear-set ratios.
"""

from __future__ import annotations

import math
from functools import cache
from itertools import combinations
from typing import NamedTuple

import numpy as np

from vstatics.core.numerics.arrays import Floats, Integers
from vstatics.synthesis.boxes.box import HELD
from vstatics.synthesis.compiled import compiled, compiled_part, shared


@shared
class Combinations(NamedTuple):
    """Combinations of simultaneously engaged shift elements, from which element sets are formed.

    Combinations are ordered by their last element, then the second last, and so on. The index of a
    combination is therefore a sum of binomial coefficients. Combinations of positions within an
    element set are ordered in the same way.
    """

    ends: Integers
    """Two links of each shift element, shape (elements, 2); negative for the housing."""
    members: Integers
    """Shift elements of each combination, ascending, shape (combinations, engaged)."""
    masks: Integers
    """Shift elements of each combination, as bits, shape (combinations,)."""
    rests: Integers
    """Index of the smaller combination without each member, shape (combinations, engaged)."""
    ranks: Integers
    """Binomial coefficients for the index of a combination, by element and by its position from 1,
    shape (elements, engaged + 1).
    """
    places: Integers
    """All combinations of positions in an element set, shape (combinations of a set, engaged)."""
    starts: Integers
    """Number of combinations that use only positions before each position, shape (size + 1,)."""


@cache
def combinations_table(links: int, engaged: int, size: int) -> Combinations:
    """Return all combinations of brakes and clutches of moving links, with additional tables."""
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
    """Return an array of zeros of type int64."""
    return np.zeros(shape, np.int64)


def _ascending(number: int, size: int) -> list[tuple[int, ...]]:
    """Return all ascending choices of `size` numbers, ordered by the last, then the second last."""
    return sorted(combinations(range(number), size), key=lambda choice: choice[::-1])


@compiled_part
def number_of(table: Combinations, chosen: Integers, subset: int) -> int:
    """Return the index of the combination that consists of some positions of an element set."""
    number = 0
    for place in range(table.places.shape[1]):
        number += table.ranks[chosen[table.places[subset, place]], place + 1]
    return number


@shared
class GearSpeeds(NamedTuple):
    """Link speeds of a scheme with each combination. Equal speeds are stored only once."""

    speeds: Floats
    """Link speeds as polynomials of the ratios, at the corners of the bounds and a point within,
    shape (speeds, links, points). [-]
    """
    way: Integers
    """Index in `speeds` of the link speeds with each combination, shape (combinations,)."""


@compiled_part
def cross_product(rows: Floats, minors: Floats, product: Floats) -> None:
    """Calculate the vector that is orthogonal to n rows of n + 1 numbers, from the minors.

    Parameters
    ----------
    rows : array, shape (n, n + 1)
    minors : array, shape (2**(n + 1),)
        Work array: the minor of the columns that are the bits of the index.
    product : array, shape (n + 1,)
        Receives the orthogonal vector.

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


@shared
class SpeedRoom(NamedTuple):
    """Work arrays for link speeds with f free speeds."""

    rows: Floats
    """Coefficients of the equation of each engaged element, shape (f - 1, f)."""
    minors: Floats
    """Minors of `rows`, see `cross_product`, shape (2**f,)."""
    vector: Floats
    """Free speeds that satisfy the equations, shape (f,)."""


def speed_room(free: int) -> SpeedRoom:
    """Return work arrays for a number of free speeds."""
    return SpeedRoom(np.zeros((free - 1, free)), np.zeros(2**free), np.zeros(free))


@compiled
def gear_speeds(
    speeds: Floats, ends: Integers, members: Integers, room: SpeedRoom, polynomials: Floats
) -> None:
    """Calculate the speeds of all links with each combination of shift elements engaged.

    Parameters
    ----------
    speeds : array
        Possible speeds of the links; see `SpeedBases.speeds`.
    ends : array, shape (elements, 2)
        Links (rows of `speeds`) that each element connects; negative for the housing.
    members : array, shape (combinations, engaged)
        Elements of each combination.
    room : SpeedRoom
    polynomials : array, shape (combinations, links, points)
        Receives the speeds, not divided by the factors of `SpeedBases`; zeros if undetermined.
    """
    points, links, free = speeds.shape
    for point in range(points):
        for which in range(members.shape[0]):
            for row in range(free - 1):
                first = ends[members[which, row], 0]
                second = ends[members[which, row], 1]
                for column in range(free):
                    room.rows[row, column] = speeds[point, first, column]
                    if second >= 0:
                        room.rows[row, column] -= speeds[point, second, column]
            cross_product(room.rows, room.minors, room.vector)
            for link in range(links):
                total = 0.0
                for column in range(free):
                    total += speeds[point, link, column] * room.vector[column]
                polynomials[which, link, point] = total
