"""Schemes in parts: two or more that have no link in common, as in Lepelletier's gearbox."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cache
from itertools import chain, combinations_with_replacement, groupby, permutations, product

import numpy as np

from vstatics.core.numerics.arrays import Integers
from vstatics.synthesis.structures.arrays import LEAST_MOBILITY, Codes
from vstatics.synthesis.structures.growth import StructureSearch, batches

Part = tuple[int, int]
"""Its number of sets, and of links."""


def splits(sets: int, links: int) -> list[tuple[Part, ...]]:
    """Of which parts a scheme with so many sets and links may be, the largest part last.

    >>> splits(3, 8)
    [((1, 3), (2, 5))]
    """
    return [one for one in _splits(sets, links, (1, 3)) if len(one) > 1]


def _splits(sets: int, links: int, least: Part) -> Iterator[tuple[Part, ...]]:
    """Parts in ascending order, none below the least."""
    if not sets and not links:
        yield ()
    for number in range(1, sets + 1):
        for own in range(number + LEAST_MOBILITY, 2 * number + 2):
            if (number, own) >= least and own <= links:
                for rest in _splits(sets - number, links - own, (number, own)):
                    yield ((number, own), *rest)


@cache
def _classes(part: Part) -> list[tuple[int, ...]]:
    """The least codes of all classes of such a part."""
    sets, links = part
    found = batches(StructureSearch(sets, "sets", links=(links,)))
    return [tuple(row) for batch in found for row in batch.codes.tolist()]


def counts(split: tuple[Part, ...]) -> Integers:
    """How many schemes have each class as their last part, of alike ones the greatest.

    >>> counts(((1, 3), (2, 5))), counts(((2, 5), (2, 5)))
    (array([1, 1, 1, 1, 1, 1]), array([1, 2, 3, 4, 5, 6]))
    """
    *others, last = [(len(_classes(one)), sum(1 for _ in of)) for one, of in groupby(split)]
    ways = math.prod(math.comb(count + times - 1, times) for count, times in others)
    count, times = last
    found = [ways * math.comb(row + times - 1, times - 1) for row in range(count)]
    return np.array(found, np.int64)


def codes_of(split: tuple[Part, ...], row: int) -> Codes:
    """The least codes of all schemes with a class as their last part, ascending.

    >>> codes_of(((1, 3), (1, 3)), 0)
    array([[0, 1, 2, 3, 4, 5]], dtype=uint8)
    """
    *others, (last, times) = [(_classes(one), sum(1 for _ in of)) for one, of in groupby(split)]
    choices = [combinations_with_replacement(*one) for one in others]
    choices.append(combinations_with_replacement(last[: row + 1], times - 1))
    found = [_least([*chain.from_iterable(chosen), last[row]]) for chosen in product(*choices)]
    return np.array(sorted(found), np.uint8)


def _least(parts: list[tuple[int, ...]]) -> list[int]:
    """The least code of schemes that stand side by side."""
    sets: list[tuple[int, ...]] = []
    start = 0
    for code in parts:
        sets += [tuple(start + link for link in code[at : at + 3]) for at in range(0, len(code), 3)]
        start += 1 + max(code)
    return min(_grown(order) for order in permutations(sets))


def _grown(sets: tuple[tuple[int, ...], ...]) -> list[int]:
    """The restricted growth string of sets in this order."""
    numbers: dict[int, int] = {}
    return [numbers.setdefault(link, len(numbers)) for one in sets for link in one]
