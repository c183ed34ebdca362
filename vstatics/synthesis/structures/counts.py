"""Numbers of schemes by their number of links.

Classes of equal schemes are counted while they are listed. Schemes with numbered gear sets are
counted by recursion. The number of connected schemes is the number of all schemes minus the number
of schemes in parts. A connected scheme is sound, or rotates as one body, or is a mixture: a sound
scheme of some sets in which bodies of the other sets replace links. Therefore the number of sound
schemes follows from the sound schemes with two sets less.
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
"""Numbers of schemes by number of links."""
LinkSizes = tuple[int, ...]
"""Number of gear-set members at each link of a scheme, ascending."""


@refusing()
def count(
    search: StructureSearch, advance: Callable[[int], None] = lambda _: None
) -> dict[int, int]:
    """Count the requested schemes by number of links.

    Parameters
    ----------
    search : StructureSearch
        Requested schemes.
    advance : callable
        Function that is called from time to time with the number of further schemes.

    Returns
    -------
    dict of int to int
        Numbers of schemes by numbers of links.

    Raises
    ------
    ValueError
        If such schemes cannot exist.

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
    numbers_of = dict.fromkeys(search.wanted, 0)
    for batch in batches(search):
        numbers = weights(search, batch)
        for links in np.unique(batch.links).tolist():
            numbers_of[links] += int(numbers[batch.links == links].sum())
        advance(int(numbers.sum()))
    return numbers_of


@cache
def labelled(sets: int) -> ByLinks:
    """Count all schemes with numbered gear sets, connected or not, by number of links.

    >>> labelled(2)
    {6: 1, 5: 9, 4: 18, 3: 6}
    """
    if not sets:
        return {0: 1}
    numbers: Counter[int] = Counter()
    for links, number in labelled(sets - 1).items():
        for new in range(MEMBERS, -1, -1):
            ways = comb(MEMBERS, new) * perm(links, MEMBERS - new)
            if ways:
                numbers[links + new] += number * ways
    return dict(numbers)


@cache
def connected(sets: int) -> ByLinks:
    """Count the connected schemes with numbered gear sets, by number of links.

    Schemes in which the first set is connected to only some of the others are subtracted from all.

    >>> connected(2)
    {5: 9, 4: 18, 3: 6}
    """
    numbers = Counter(labelled(sets))
    for part in range(1, sets):
        for links, number in connected(part).items():
            for others, ways in labelled(sets - part).items():
                numbers[links + others] -= comb(sets - 1, part - 1) * number * ways
    return {links: number for links, number in numbers.items() if number}


def sound(sets: int) -> ByLinks:
    """Count connected schemes with numbered gear sets and no locked-up group, by links.

    >>> sound(3)
    {7: 189, 6: 864, 5: 1080}
    """
    return _part(sets, is_body=False)


@cache
def _part(sets: int, *, is_body: bool) -> ByLinks:
    """Count connected schemes that are sound, or locked up as a whole, by number of links."""
    mixed = _mixed(sets)
    return {
        links: number - mixed[links]
        for links, number in connected(sets).items()
        if (links < sets + LEAST_MOBILITY) == is_body and number > mixed[links]
    }


@cache
def _mixed(sets: int) -> Counter[int]:
    """Count connected schemes with a locked-up body of only some of the gear sets."""
    numbers: Counter[int] = Counter()
    for outside in range(1, sets - 1):
        for sizes, number in _link_sizes(outside).items():
            for links, ways in _with_bodies(sizes, sets - outside):
                numbers[links] += comb(sets, outside) * number * ways
    return numbers


@cache
def _with_bodies(sizes: LinkSizes, inside: int) -> tuple[tuple[int, int], ...]:
    """Count the ways to replace links by locked-up bodies of a number of inner gear sets.

    Each member of a replaced link can be connected to any link of the body.

    Returns
    -------
    tuple
        Pairs: a number of links, and the number of ways that give this number.
    """
    if not sizes:
        return () if inside else ((0, 1),)
    numbers: Counter[int] = Counter()
    for body in (0, *range(2, inside + 1)):
        places = _part(body, is_body=True).items() if body else [(1, 1)]
        for other_links, ways in _with_bodies(sizes[1:], inside - body):
            for links, number in places:
                joined = links ** sizes[0] if body else 1
                numbers[other_links + links] += comb(inside, body) * number * joined * ways
    return tuple(numbers.items())


@cache
def _link_sizes(sets: int) -> dict[LinkSizes, int]:
    """Return the number of sound schemes for each list of member numbers at their links."""
    totals: Counter[LinkSizes] = Counter()
    search = StructureSearch(sets)
    for batch in batches(counted_by(search)):
        sizes = np.zeros((len(batch.codes), 2 * sets + 1), np.intp)
        rows = np.repeat(np.arange(len(batch.codes)), MEMBERS * sets)
        np.add.at(sizes, (rows, batch.codes.ravel()), 1)
        kinds, which = np.unique(np.sort(sizes), axis=0, return_inverse=True)
        numbers = np.zeros(len(kinds), np.int64)
        np.add.at(numbers, which.ravel(), weights(search, batch))
        for kind, number in zip(kinds.tolist(), numbers.tolist(), strict=True):
            totals[tuple(size for size in kind if size)] += number
    return dict(totals)
