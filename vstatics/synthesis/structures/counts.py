"""How many schemes there are.

Classes are counted as they are listed. Schemes whose sets have numbers are counted with few
lists: connected ones are all less those in parts. One of these is sound, or it is one body, or
it is a sound scheme of some of its sets in which bodies of the others stand in the place of
links. So sound ones follow from those of two sets less.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from functools import cache
from math import comb, perm

import numpy as np

from vstatics.core.arguments import refusing
from vstatics.synthesis.structures.arrays import LEAST_MOBILITY, MEMBERS
from vstatics.synthesis.structures.growth import (
    StructureSearch,
    batches,
    check_search,
    counted_by,
    weights,
)

ByLinks = dict[int, int]
LinkSizes = tuple[int, ...]
"""How many members each link of a scheme joins, ascending."""


@refusing()
def count(
    search: StructureSearch, advance: Callable[[int], None] = lambda _: None
) -> dict[int, int]:
    """How many schemes there are, by their number of links.

    Parameters
    ----------
    search : StructureSearch
    advance : callable
        Is told how many more are counted, now and then.

    Returns
    -------
    dict of int to int
        Numbers of schemes by numbers of links.

    Raises
    ------
    ValueError
        If there can be none such.

    Examples
    --------
    >>> count(StructureSearch(2)), count(StructureSearch(2, "sets", ports=True))
    ({4: 18, 5: 9}, {4: 111, 5: 90})
    >>> count(StructureSearch(6))[13] == 3**6 * 13**4  # trees of sets
    True
    """
    check_search(search)
    if search.classes == "none":
        all_of_them = connected(search.sets) if search.unsound else sound(search.sets)
        choices = {links: perm(links, 2) if search.ports else 1 for links in search.wanted}
        return {links: all_of_them[links] * choices[links] for links in search.wanted}
    found = dict.fromkeys(search.wanted, 0)
    for batch in batches(search):
        numbers = weights(search, batch)
        for links in np.unique(batch.links).tolist():
            found[links] += int(numbers[batch.links == links].sum())
        advance(int(numbers.sum()))
    return found


@cache
def labelled(sets: int) -> ByLinks:
    """All schemes, connected or not: a set takes some links that are there, and new ones.

    >>> labelled(2)
    {6: 1, 5: 9, 4: 18, 3: 6}
    """
    if not sets:
        return {0: 1}
    found: Counter[int] = Counter()
    for links, number in labelled(sets - 1).items():
        for new in range(MEMBERS, -1, -1):
            ways = comb(MEMBERS, new) * perm(links, MEMBERS - new)
            if ways:
                found[links + new] += number * ways
    return dict(found)


@cache
def connected(sets: int) -> ByLinks:
    """Those that hang together: all, less those where the first set hangs with fewer.

    >>> connected(2)
    {5: 9, 4: 18, 3: 6}
    """
    found = Counter(labelled(sets))
    for part in range(1, sets):
        for links, number in connected(part).items():
            for others, ways in labelled(sets - part).items():
                found[links + others] -= comb(sets - 1, part - 1) * number * ways
    return {links: number for links, number in found.items() if number}


def sound(sets: int) -> ByLinks:
    """Those in which no group of sets is one body.

    >>> sound(3)
    {7: 189, 6: 864, 5: 1080}
    """
    return _part(sets, is_body=False)


@cache
def _part(sets: int, *, is_body: bool) -> ByLinks:
    """Connected schemes without mixed ones; few links make a body."""
    mixed = _mixed(sets)
    return {
        links: number - mixed[links]
        for links, number in connected(sets).items()
        if (links < sets + LEAST_MOBILITY) == is_body and number > mixed[links]
    }


@cache
def _mixed(sets: int) -> Counter[int]:
    """Connected schemes with a body that has not all of the sets."""
    found: Counter[int] = Counter()
    for outside in range(1, sets - 1):
        for sizes, number in _link_sizes(outside).items():
            for links, ways in _with_bodies(sizes, sets - outside):
                # a scheme of the outer sets without bodies has none of the others
                found[links] += comb(sets, outside) * number * ways
    return found


@cache
def _with_bodies(sizes: LinkSizes, inside: int) -> tuple[tuple[int, int], ...]:
    """The ways to put bodies of so many sets in the place of links.

    A member that the link has had may be joined to any of the links of the body.

    Returns
    -------
    tuple
        Pairs of a number of links, and the ways to have so many.
    """
    if not sizes:
        return () if inside else ((0, 1),)
    found: Counter[int] = Counter()
    for own in (0, *range(2, inside + 1)):
        places = _part(own, is_body=True).items() if own else [(1, 1)]
        for rest, ways in _with_bodies(sizes[1:], inside - own):
            for links, number in places:
                joined = links ** sizes[0] if own else 1
                found[rest + links] += comb(inside, own) * number * joined * ways
    return tuple(found.items())


@cache
def _link_sizes(sets: int) -> dict[LinkSizes, int]:
    """How many sound schemes have links of so many members each."""
    found: Counter[LinkSizes] = Counter()
    search = StructureSearch(sets)
    for batch in batches(counted_by(search)):
        sizes = np.zeros((len(batch.codes), 2 * sets + 1), np.intp)
        rows = np.repeat(np.arange(len(batch.codes)), MEMBERS * sets)
        np.add.at(sizes, (rows, batch.codes.ravel()), 1)
        kinds, which = np.unique(np.sort(sizes), axis=0, return_inverse=True)
        numbers = np.zeros(len(kinds), np.int64)
        np.add.at(numbers, which.ravel(), weights(search, batch))
        for kind, number in zip(kinds.tolist(), numbers.tolist(), strict=True):
            found[tuple(size for size in kind if size)] += number
    return dict(found)
