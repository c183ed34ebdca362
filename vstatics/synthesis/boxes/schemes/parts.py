"""Schemes of two or more parts (groups of gear sets) without a common link.

Lepelletier's gearbox is an example.
"""

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
"""Number of gear sets, and number of links, of a part of a scheme."""


def splits(sets: int, links: int) -> list[tuple[Part, ...]]:
    """Return the possible divisions of sets and links into parts, the largest part last.

    >>> splits(3, 8)
    [((1, 3), (2, 5))]
    """
    return [split for split in _splits(sets, links, (1, 3)) if len(split) > 1]


def _splits(sets: int, links: int, least: Part) -> Iterator[tuple[Part, ...]]:
    """Yield the divisions into ascending parts that are not smaller than `least`."""
    if not sets and not links:
        yield ()
    for number in range(1, sets + 1):
        for part_links in range(number + LEAST_MOBILITY, 2 * number + 2):
            if (number, part_links) >= least and part_links <= links:
                for others in _splits(sets - number, links - part_links, (number, part_links)):
                    yield ((number, part_links), *others)


@cache
def _classes(part: Part) -> list[tuple[int, ...]]:
    sets, links = part
    code_batches = batches(StructureSearch(sets, "sets", links=(links,)))
    return [tuple(row) for batch in code_batches for row in batch.codes.tolist()]


def counts(split: tuple[Part, ...]) -> Integers:
    """Return, for each class of the last part of a scheme, the number of schemes.

    Parts with equal numbers of gear sets and links are in ascending order of their classes.

    >>> counts(((1, 3), (2, 5))), counts(((2, 5), (2, 5)))
    (array([1, 1, 1, 1, 1, 1]), array([1, 2, 3, 4, 5, 6]))
    """
    *others, last = [
        (len(_classes(part)), sum(1 for _ in equal_parts)) for part, equal_parts in groupby(split)
    ]
    ways = math.prod(math.comb(count + times - 1, times) for count, times in others)
    count, times = last
    numbers = [ways * math.comb(row + times - 1, times - 1) for row in range(count)]
    return np.array(numbers, np.int64)


def codes_of(split: tuple[Part, ...], row: int) -> Codes:
    """Return the least codes, ascending, of all schemes whose last part has class number `row`.

    >>> codes_of(((1, 3), (1, 3)), 0)
    array([[0, 1, 2, 3, 4, 5]], dtype=uint8)
    """
    *others, (last, times) = [
        (_classes(part), sum(1 for _ in equal_parts)) for part, equal_parts in groupby(split)
    ]
    choices = [combinations_with_replacement(*part) for part in others]
    choices.append(combinations_with_replacement(last[: row + 1], times - 1))
    codes = [_least([*chain.from_iterable(chosen), last[row]]) for chosen in product(*choices)]
    return np.array(sorted(codes), np.uint8)


def _least(parts: list[tuple[int, ...]]) -> list[int]:
    sets: list[tuple[int, ...]] = []
    start = 0
    for code in parts:
        sets += [tuple(start + link for link in code[at : at + 3]) for at in range(0, len(code), 3)]
        start += 1 + max(code)
    return min(_grown(order) for order in permutations(sets))


def _grown(sets: tuple[tuple[int, ...], ...]) -> list[int]:
    """Assign numbers to the links of gear sets from 0 in the order of first appearance."""
    numbers: dict[int, int] = {}
    return [numbers.setdefault(link, len(numbers)) for members in sets for link in members]
