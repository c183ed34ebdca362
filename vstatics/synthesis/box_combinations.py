"""Brakes and clutches of a scheme, and which of them are engaged together."""

from __future__ import annotations

import math
from functools import cache
from itertools import combinations
from typing import NamedTuple

import numpy as np

from vstatics.numerics.arrays import Integers
from vstatics.numerics.compiled import compiled
from vstatics.synthesis.box import HELD


class Combinations(NamedTuple):
    """Combinations of shift elements that are engaged together, of which sets are made.

    Those of the elements are ordered by their last element, then the one before, and so on:
    the number of one is a sum of binomials. Those of places in a set likewise.
    """

    ends: Integers
    """The links that an element joins, below 0 the housing, shape (elements, 2)."""
    members: Integers
    """Shape (combinations, engaged)."""
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
    rests = [
        [_number(one[:place] + one[place + 1 :]) for place in range(engaged)] for one in members
    ]
    ranks = [[math.comb(one, place) for place in range(engaged + 1)] for one in range(len(ends))]
    starts = [math.comb(place, engaged) for place in range(size + 1)]
    places = _ascending(size, engaged)
    arrays = (np.array(one, np.int64) for one in (ends, members, rests, ranks, places, starts))
    return Combinations(*arrays)


def _ascending(number: int, size: int) -> list[tuple[int, ...]]:
    """All choices of so many of a number, ordered by the last, then the one before."""
    return sorted(combinations(range(number), size), key=lambda one: one[::-1])


def _number(chosen: tuple[int, ...]) -> int:
    """Where a choice stands among all."""
    return sum(math.comb(one, place) for place, one in enumerate(chosen, 1))


@compiled
def number_of(table: Combinations, chosen: Integers, subset: int) -> int:
    """The number of a combination of a set, whose elements ascend."""
    number = 0
    for place in range(table.places.shape[1]):
        number += table.ranks[chosen[table.places[subset, place]], place + 1]
    return number
