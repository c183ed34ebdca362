"""Brakes and clutches of a scheme, which of them are engaged together, which choice uses all."""

from __future__ import annotations

import math
from functools import cache
from itertools import combinations
from typing import NamedTuple

import numpy as np

from vstatics.numerics.arrays import Integers
from vstatics.numerics.compiled import compiled
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
    number = {one: place for place, one in enumerate(_ascending(len(ends), engaged - 1))}
    rests = [
        [number[one[:place] + one[place + 1 :]] for place in range(engaged)] for one in members
    ]
    ranks = [[math.comb(one, place) for place in range(engaged + 1)] for one in range(len(ends))]
    starts = [math.comb(place, engaged) for place in range(size + 1)]
    places = _ascending(size, engaged)
    arrays = (np.array(one, np.int64) for one in (ends, members, rests, ranks, places, starts))
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


@compiled
def all_used(
    table: Combinations, ratio_of: Integers, chosen: Integers, came: Integers, gears: Integers
) -> bool:
    """Whether gears of the chosen ratios can be such that all elements are used.

    Target by target it is noted which elements may be in use, as bits, and how.

    Parameters
    ----------
    table : Combinations
    ratio_of : array, shape (combinations of a set,)
        The ratio of each, below 0 of none.
    chosen : array, shape (targets,)
        The ratio of each target.
    came : array, shape (targets + 1, 2**size)
        Scratch.
    gears : array, shape (targets,)
        Takes the combination of each target.
    """
    every, count, subsets = came.shape[1] - 1, len(chosen), len(ratio_of)
    came[:] = -1
    came[0, 0] = 0
    for target in range(count):
        for state in range(every + 1):
            if came[target, state] >= 0:
                for subset in range(subsets):
                    if ratio_of[subset] == chosen[target]:
                        after = state
                        for place in range(table.places.shape[1]):
                            after |= 1 << table.places[subset, place]
                        if came[target + 1, after] < 0:
                            came[target + 1, after] = state * subsets + subset
    if came[count, every] < 0:
        return False
    state = every
    for target in range(count - 1, -1, -1):
        step = came[target + 1, state]
        gears[target] = step % subsets
        state = step // subsets
    return True
